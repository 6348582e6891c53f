#include "hurcules/solver/careful_basis.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/wide.hpp"

namespace hurcules {

namespace {

// enough, also for what is left of a nearly dependent row
constexpr int kCleanings = 3;
// a cleaning that left more than this part was the last that is needed: its rounding is twice that
// of the row at most (Daniel, Gragg, Kaufman, Stewart 1976)
constexpr double kClean = 0.5;

template <class Scalar>
Scalar norm(Index size, const Scalar* v) {
  using std::sqrt;
  Scalar sum = 0.0L;
  for (Index c = 0; c < size; ++c) sum += v[c] * v[c];
  return sqrt(sum);
}

}  // namespace

template <class Scalar>
void CarefulBasis<Scalar>::reserve(Index columns, Index rows) {
  const std::size_t directions = static_cast<std::size_t>(std::min(columns, rows));
  const std::size_t width = static_cast<std::size_t>(columns);
  directions_.resize(std::max(directions_.size(), directions * width));
  parts_.resize(std::max(parts_.size(), directions * width));
  rest_.resize(std::max(rest_.size(), width));
  mark_.resize(std::max(mark_.size(), directions));
}

template <class Scalar>
void CarefulBasis<Scalar>::start(Index columns) {
  columns_ = columns;
  size_ = 0;
  weakest_ = 1.0L;
}

template <class Scalar>
Scalar CarefulBasis<Scalar>::dot(Index j, const Scalar* v) const {
  const Scalar* b = direction(j);
  Scalar sum = 0.0L;
  for (Index c = 0; c < columns_; ++c) sum += b[c] * v[c];
  return sum;
}

template <class Scalar>
Scalar CarefulBasis<Scalar>::remove(const Scalar* row, Scalar* rest, Scalar* parts) const {
  std::copy_n(row, columns_, rest);
  std::fill_n(parts, size_, Scalar(0.0L));
  Scalar left = norm(columns_, row);
  for (int pass = 0; pass < kCleanings && size_ > 0; ++pass) {
    for (Index j = 0; j < size_; ++j) {
      const Scalar part = dot(j, rest);
      const Scalar* b = direction(j);
      for (Index c = 0; c < columns_; ++c) rest[c] -= part * b[c];
      parts[j] += part;
    }
    const Scalar before = left;
    left = norm(columns_, rest);
    if (left > Scalar(kClean) * before) break;
  }
  return left;
}

template <class Scalar>
bool CarefulBasis<Scalar>::add(const Scalar* row, Index mark, Scalar least) {
  if (size_ == columns_ || size_ == static_cast<Index>(mark_.size())) return false;
  Scalar* parts = &parts_[size_ * columns_];
  const Scalar left = remove(row, rest_.data(), parts);
  if (!(left > least)) return false;
  Scalar* b = &directions_[size_ * columns_];
  for (Index c = 0; c < columns_; ++c) b[c] = rest_[c] / left;
  parts[size_] = left;
  mark_[size_] = mark;
  weakest_ = std::min(weakest_, left);
  ++size_;
  return true;
}

template <class Scalar>
void CarefulBasis<Scalar>::solve(Index end, Scalar* b) const {
  for (Index i = 0; i < end; ++i) {
    const Scalar* l = &parts_[i * columns_];
    for (Index j = 0; j < i; ++j) b[i] -= l[j] * b[j];
    b[i] /= l[i];
  }
}

template <class Scalar>
void CarefulBasis<Scalar>::solve_transposed(Index end, Scalar* b) const {
  for (Index i = end - 1; i >= 0; --i) {
    const Scalar* l = &parts_[i * columns_];
    b[i] /= l[i];
    for (Index j = 0; j < i; ++j) b[j] -= l[j] * b[i];
  }
}

template class CarefulBasis<long double>;
template class CarefulBasis<Wide>;

}  // namespace hurcules
