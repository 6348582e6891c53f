#include "hurcules/solver/kernels/orthogonal_factor.hpp"

#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

constexpr int kMostCleanings = 3;
// a row that keeps this part in a cleaning is clean (squared)
constexpr double kEnough = 0.1;
// what is left is noise altogether (squared)
constexpr double kNothing = 1e-36;
// what is left of a row that depends on others is the rounding of its parts (squared)
constexpr double kRounding = 1e-30;

// v of |v|^2 = norm2 minus its parts along the rows of Q; what is left, squared. Where that is
// `least` or less no second pass is needed.
double remove_parts(const PaddedRows& Q, Index rank, double* v, double* part, double norm2,
                    double least) {
  const kernels::Table& kernel = *kernels::chosen;
  std::fill_n(part, padded(rank), 0.0);
  double left = norm2;
  for (int pass = 0; pass < kMostCleanings && rank > 0; ++pass) {
    const double before = left;
    left = kernel.project(Q.row(0), rank, Q.stride(), v, part);
    // twice is enough, unless nearly nothing was left
    if (left >= kEnough * before || left <= least) break;
  }
  return left;
}

}  // namespace

void OrthogonalFactor::reserve(Index rows, Index columns) {
  rest_.reserve(rows + 3, columns);
  Q_.reserve(columns + 3, columns);
  L_.reserve(rows + 3, columns);
  part_.reserve(2 * padded(columns) + 4);
  pivot_.resize(std::max<std::size_t>(pivot_.size(), columns));
}

void OrthogonalFactor::start(Index rows, Index columns) {
  rows_ = rows;
  columns_ = columns;
  rank_ = 0;
  for (PaddedRows* r : {&rest_, &Q_, &L_}) r->shape(columns);
  // what stands behind the last row is read and written four rows at a time
  std::fill_n(rest_.row(rows), 3 * rest_.stride(), 0.0);
}

double OrthogonalFactor::project(double* v, double* part, double norm2) const {
  return remove_parts(Q_, rank_, v, part, norm2, kNothing * norm2);
}

void OrthogonalFactor::run(Index first, Index end, const double* norm2, double tolerance,
                           double* side, double clean) {
  kernels::Directions d = {rest_.row(0), Q_.row(0), L_.row(0), norm2, pivot_.data(),
                           rows_,        columns_,  stride(),  rank_, side};
  Index i = first;
  while (true) {
    i = kernels::chosen->take_directions(d, i, end, clean);
    rank_ = d.rank;
    if (i == end || rank_ == columns_) break;
    take_cleaned(i, norm2[i], tolerance, side);
    d.rank = rank_;
    ++i;
  }
}

void OrthogonalFactor::clear_unknown(Index first, Index end) {
  Index known = pivots_before(first);
  for (Index row = first; row < end; ++row) {
    if (known < rank_ && pivot_[known] == row) ++known;
    for (Index j = known; j < rank_; ++j) L_.row(row)[j] = 0.0;
  }
}

Index OrthogonalFactor::pivots_before(Index row) const {
  Index j = rank_;
  while (j > 0 && pivot_[j - 1] >= row) --j;
  return j;
}

void OrthogonalFactor::take_cleaned(Index i, double norm2, double tolerance, double* side) {
  double *v = rest_.row(i), *l = L_.row(i), *part = part_.data() + padded(columns_);
  // a row that depends on the others is known to rounding after one pass
  const double least = tolerance * tolerance * norm2;
  const double before = kernels::chosen->dot(stride(), v, v);
  if (before <= std::min(least, kRounding * norm2)) return;
  const double left = remove_parts(Q_, rank_, v, part, before, least);
  for (Index j = 0; j < rank_; ++j) {
    l[j] += part[j];
    if (side) side[i] -= part[j] * side[pivot_[j]];
  }
  if (!(left > least)) return;
  const double length = std::sqrt(left), scale = 1.0 / length;
  l[rank_] = length;
  double* q = Q_.row(rank_);
  for (Index j = 0; j < stride(); ++j) q[j] = scale * v[j];
  kernels::chosen->eliminate(v, scale, rest_.row(i + 1), rows_ - i - 1, stride(),
                             L_.row(i + 1) + rank_);
  if (side) {
    side[i] *= scale;
    for (Index r = i + 1; r < rows_; ++r) side[r] -= L_.row(r)[rank_] * side[i];
  }
  pivot_[rank_++] = i;
}

bool OrthogonalFactor::append(double norm2, double tolerance) {
  if (rank_ == columns_) return false;
  double *v = rest_.row(rank_), *l = L_.row(rank_), *q = Q_.row(rank_);
  const double left = project(v, l, norm2);
  if (!(left > tolerance * tolerance * norm2)) return false;
  const double length = std::sqrt(left), scale = 1.0 / length;
  for (Index j = 0; j < stride(); ++j) q[j] = scale * v[j];
  l[rank_] = length;
  pivot_[rank_] = rank_;
  ++rank_;
  return true;
}

void OrthogonalFactor::remove(Index slot, double* g) {
  const kernels::Table& kernel = *kernels::chosen;
  for (Index i = slot; i + 1 < rank_; ++i) {
    // row i + 1 moves up; a rotation of columns i, i + 1 makes L lower triangular again
    std::copy_n(L_.row(i + 1), i + 2, L_.row(i));
    const double a = L_.row(i)[i], b = L_.row(i)[i + 1];
    const double length = std::sqrt(a * a + b * b), c = a / length, s = b / length;
    L_.row(i)[i] = length;
    L_.row(i)[i + 1] = 0.0;
    for (Index below = i + 2; below < rank_; ++below) {
      double* l = L_.row(below);
      const double p = l[i], q = l[i + 1];
      l[i] = c * p + s * q;
      l[i + 1] = c * q - s * p;
    }
    kernel.rotate(stride(), c, s, Q_.row(i), Q_.row(i + 1));
    const double p = g[i], q = g[i + 1];
    g[i] = c * p + s * q;
    g[i + 1] = c * q - s * p;
  }
  --rank_;
}

void OrthogonalFactor::solve(double* b) const {
  for (Index i = 0; i < rank_; ++i) {
    const double* l = L_.row(i);
    double sum = b[i];
    for (Index j = 0; j < i; ++j) sum -= l[j] * b[j];
    b[i] = sum / l[i];
  }
}

void OrthogonalFactor::solve_transposed(double* b, double noise) const {
  for (Index i = rank_ - 1; i >= 0; --i) {
    const double* l = L_.row(i);
    b[i] = std::abs(b[i]) > noise ? b[i] / l[i] : 0.0;
    for (Index j = 0; j < i; ++j) b[j] -= l[j] * b[i];
  }
}

void OrthogonalFactor::find_multipliers(const double* g, double* multiplier) const {
  double largest = 0.0;
  for (Index i = 0; i < rank_; ++i) {
    multiplier[i] = -g[i];
    largest = std::max(largest, std::abs(g[i]));
  }
  solve_transposed(multiplier, tolerance::kNoise * largest);
}

void OrthogonalFactor::correct(double* change, double* y) const {
  solve(change);
  kernels::chosen->axpys(direction(0), rank_, stride(), change, y);
}

}  // namespace hurcules
