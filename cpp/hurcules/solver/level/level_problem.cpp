#include "hurcules/solver/level/level_problem.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/kernels/triangularize.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// normal equations lose no more than the square of this
constexpr double kMostCondition = 100.0;
// of a level that is not factored yet
constexpr double kNoRho = -1.0;

// f with a size that the compiler knows where it is a usual one, 0 where it is another: so the
// inner loops keep all in registers
template <class F>
void with_size(Index size, F f) {
  switch (size) {
    case 1:
      return f(std::integral_constant<int, 1>());
    case 2:
      return f(std::integral_constant<int, 2>());
    case 3:
      return f(std::integral_constant<int, 3>());
    default:
      return f(std::integral_constant<int, 0>());
  }
}

}  // namespace

void LevelProblem::reserve(Index unknowns, Index rows, Index most_own) {
  const Index own = std::min(unknowns, most_own);
  stacked_.reserve(rows + own, own + 1);
  work_.reserve(rows + own + padded(own + 1));
  R_.reserve(own * own);
  for (PaddedVector* v : {&inverse_, &c_, &t_, &t_free_}) v->reserve(padded(unknowns) + 4);
  r_.reserve(rows + 4);
}

void LevelProblem::start(const RowTable& rows, const NullspaceBasis& nullspace, int level,
                         const double* x_above) {
  rows_ = &rows;
  nullspace_ = &nullspace;
  level_ = level;
  first_ = nullspace.rank_before(level);
  own_ = nullspace.rank_before(level + 1) - first_;
  free_ = nullspace.unknowns() - first_;
  equalities_ = rows.equalities(level + 1) - rows.equalities(level);
  const Index count = rows.begin(level + 1) - rows.begin(level);
  // a row of a Bounds level has the slack of its place there
  const bool bounds = count > equalities_ && rows[rows.begin(level)].bound;
  slacks_ = bounds ? count : rows.inequalities(level + 1) - rows.inequalities(level);
  lead_ = first_ % 4;
  body_ = nullspace.stride() - (first_ - lead_);
  const double* norms = rows.dense_norms() + rows.equalities(level);
  own_norm_ = 0.0;
  for (Index i = 0; i < equalities_; ++i) own_norm_ = std::max(own_norm_, norms[i]);
  if (slacks_ > 0) {
    const RowTable::Range own = rows.own_candidates(level);
    const double* last = rows.norms() + own.first + own.count;
    own_norm_ = std::max(own_norm_, *std::max_element(rows.norms() + own.first, last));
  }
  find_residual(x_above);
  rho_ = kNoRho;
  x_above_ = x_above;
}

double LevelProblem::least_settling(double largest_multiplier, double x_scale) const {
  return std::max(tolerance::kSettling * largest_multiplier,
                  tolerance::kNoForce * own_norm_ * own_norm_ * x_scale);
}

void LevelProblem::find_residual(const double* x) {
  const int first = rows_->equalities(level_);
  const double* target = rows_->targets() + first;
  kernels::chosen->dots(rows_->dense_row(first), equalities_, rows_->stride(), x, r_.data());
  for (Index i = 0; i < equalities_; ++i) r_[i] = target[i] - r_[i];
}

bool LevelProblem::equalities_met(double x_scale) const {
  const int first = rows_->equalities(level_);
  for (Index i = 0; i < equalities_; ++i) {
    const double scale =
        rows_->dense_norms()[first + i] * x_scale + std::abs(rows_->targets()[first + i]);
    if (std::abs(r_[i]) > tolerance::kZeroResidual * scale) return false;
  }
  return true;
}

double LevelProblem::largest_coordinate() const {
  double largest = 0.0;
  for (Index i = 0; i < equalities_; ++i) {
    const double* e = equality_row(i);
    for (Index j = 0; j < own_; ++j) largest = std::max(largest, std::abs(e[j]));
  }
  return largest;
}

template <int fixed>
void LevelProblem::factor_by_cholesky() {
  constexpr int kSize = fixed > 0 ? fixed : 1;
  double square[kSize * kSize], sums[kSize];
  double *R = fixed > 0 ? square : R_.data(), *c = fixed > 0 ? sums : c_.data();
  const Index q = fixed > 0 ? fixed : own_;
  for (Index j = 0; j < q; ++j) {
    for (Index l = j; l < q; ++l) R[j * q + l] = j == l ? rho_ * rho_ : 0.0;
    c[j] = 0.0;
  }
  for (Index i = 0; i < equalities_; ++i) {
    const double* e = equality_row(i);
    const double r = r_[i];
    for (Index j = 0; j < q; ++j) {
      c[j] += e[j] * r;
      for (Index l = j; l < q; ++l) R[j * q + l] += e[j] * e[l];
    }
  }
  for (Index j = 0; j < q; ++j) {
    double* row = R + j * q;
    const double root = std::sqrt(row[j]), inverse = 1.0 / root;
    row[j] = root;
    inverse_[j] = inverse;
    // R' c = Lk' r, row by row
    c[j] *= inverse;
    for (Index l = j + 1; l < q; ++l) {
      row[l] *= inverse;
      c[l] -= row[l] * c[j];
    }
    for (Index l = j + 1; l < q; ++l) {
      for (Index h = l; h < q; ++h) R[l * q + h] -= row[l] * row[h];
    }
  }
  if (fixed == 0) return;
  for (Index j = 0; j < q; ++j) {
    c_[j] = c[j];
    for (Index l = j; l < q; ++l) R_[j * q + l] = R[j * q + l];
  }
}

void LevelProblem::factor_by_householder() {
  stacked_.shape(own_ + 1);
  Index count = 0;
  for (; count < equalities_; ++count) {
    std::copy_n(equality_row(count), own_, stacked_.row(count));
    stacked_.row(count)[own_] = r_[count];
  }
  for (Index j = 0; rho_ > 0.0 && j < own_; ++j, ++count) {
    std::fill_n(stacked_.row(count), own_ + 1, 0.0);
    stacked_.row(count)[j] = rho_;
  }
  triangularize(stacked_, count, own_, work_.data());
  for (Index j = 0; j < own_; ++j) {
    const double* row = stacked_.row(j);
    for (Index l = j; l < own_; ++l) R_[j * own_ + l] = row[l];
    c_[j] = row[own_];
    inverse_[j] = 1.0 / row[j];
  }
}

template <int fixed>
void LevelProblem::solve_triangular(double scale, const double* b) {
  const double* R = R_.data();
  double* t = t_.data();
  const Index q = fixed > 0 ? fixed : own_;
  for (Index j = q - 1; j >= 0; --j) {
    double sum = scale * b[j];
    for (Index l = j + 1; l < q; ++l) sum -= R[j * q + l] * t[l];
    t[j] = sum * inverse_[j];
  }
}

void LevelProblem::solve_triangular(double scale, const double* b) {
  if (own_ > 0) with_size(own_, [&](auto size) { solve_triangular<size>(scale, b); });
}

template <int fixed>
void LevelProblem::solve_transposed(double scale, double* own) const {
  const double* R = R_.data();
  const Index q = fixed > 0 ? fixed : own_;
  for (Index j = 0; j < q; ++j) {
    double sum = scale * own[j];
    for (Index l = 0; l < j; ++l) sum -= R[l * q + j] * own[l];
    own[j] = sum * inverse_[j];
  }
}

void LevelProblem::factor(double rho) {
  if (rho == rho_) return;
  rho_ = rho;
  per_rho_ = rho > 0.0 ? 1.0 / rho : 0.0;
  target_size_ = 0.0;
  if (own_ == 0) return;
  // no coordinate is larger than its row
  if (rho > 0.0 &&
      (own_norm_ < kMostCondition * rho || largest_coordinate() < kMostCondition * rho)) {
    with_size(own_, [&](auto size) { factor_by_cholesky<size>(); });
  } else {
    factor_by_householder();
  }
  for (Index j = 0; j < own_; ++j) target_size_ = std::max(target_size_, std::abs(c_[j]));
  if (rho > 0.0) target_size_ /= rho;
  solve_triangular(1.0, c_.data());
  std::copy_n(t_.data(), own_, t_free_.data());
}

void LevelProblem::solve_free(double rho, double* x_free) {
  factor(rho);
  std::copy_n(x_above_, rows_->stride(), x_free);
  kernels::chosen->axpys(nullspace_->direction(first_), own_, rows_->stride(), t_free_.data(),
                         x_free);
}

Index LevelProblem::slack_of(const Row& row) const {
  if (row.bound) return row.row;
  return row.dense - rows_->equalities() - rows_->inequalities(level_);
}

void LevelProblem::image(const Row& row, double sign, double* m) const {
  kernels::chosen->scale(body_, sign, nullspace_->coordinates(row) + (first_ - lead_), m);
  // at most three zeros in front and behind
  const Index end = lead_ + free_;
  if (lead_ > 0) m[0] = 0.0;
  if (lead_ > 1) m[1] = 0.0;
  if (lead_ > 2) m[2] = 0.0;
  if (end < body_) m[end] = 0.0;
  if (end + 1 < body_) m[end + 1] = 0.0;
  if (end + 2 < body_) m[end + 2] = 0.0;
  if (own_ > 0) with_size(own_, [&](auto size) { solve_transposed<size>(rho_, m + lead_); });
  if (slacks_ == 0) return;
  std::fill_n(m + body_, padded(slacks_), 0.0);
  if (has_slack(row)) m[body_ + slack_of(row)] = sign * rho_;
}

bool LevelProblem::lost(const Row& row) const {
  const double* e = nullspace_->coordinates(row) + first_;
  const double least = tolerance::kLost * row.norm;
  double sum = 0.0;
  for (Index j = 0; j < free_; ++j) {
    sum += e[j] * e[j];
    if (sum > least * least) return false;
  }
  return true;
}

void LevelProblem::step(const double* y, const double* x_free, double* x) {
  // t_1 = rho R^-1 y_1
  solve_triangular(rho_, y + lead_);
  std::copy(y + lead_ + own_, y + lead_ + free_, t_.data() + own_);
  std::copy_n(x_free, rows_->stride(), x);
  kernels::chosen->axpys(nullspace_->direction(first_), free_, rows_->stride(), t_.data(), x);
}

void LevelProblem::step(const double* y, double* x) {
  solve_triangular(rho_, y + lead_);
  for (Index j = 0; j < own_; ++j) t_[j] += t_free_[j];
  std::copy(y + lead_ + own_, y + lead_ + free_, t_.data() + own_);
  std::copy_n(x_above_, rows_->stride(), x);
  kernels::chosen->axpys(nullspace_->direction(first_), free_, rows_->stride(), t_.data(), x);
}

}  // namespace hurcules
