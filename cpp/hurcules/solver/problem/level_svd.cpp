#include "hurcules/solver/problem/level_svd.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"

namespace hurcules {

namespace {

// columns are orthogonal: their product relative to their lengths, a few roundings
constexpr double kOrthogonal = 1e-15;
// convergence is quadratic: five to eight are usual
constexpr int kMostSweeps = 30;

}  // namespace

void LevelSvd::reserve(Index unknowns, Index most_own) {
  const Index own = std::min(unknowns, most_own);
  image_.reserve(own, most_own);
  right_.reserve(own, own);
  sigma_.reserve(own);
  inverse_.reserve(own * own);
}

void LevelSvd::start(const RowTable& rows, const NullspaceBasis& nullspace, int level) {
  rows_ = &rows;
  nullspace_ = &nullspace;
  level_ = level;
  first_ = nullspace.rank_before(level);
  own_ = nullspace.rank_before(level + 1) - first_;
  count_ = rows.equalities(level + 1) - rows.equalities(level);
  dependent_ = own_ < std::min(count_, nullspace.unknowns() - first_);
  decomposed_ = false;
  bound_ = -1.0;
}

double LevelSvd::bound_below() {
  if (bound_ >= 0.0) return bound_;
  // row i of T^-1, T lower triangular: (e_i - sum_j<i T(i, j) row j) / T(i, i)
  double sum = 0.0;
  for (Index i = 0; i < own_; ++i) {
    const double* t = nullspace_->equality_coordinates(nullspace_->pivot(first_ + i)) + first_;
    double* row = inverse_.data() + i * own_;
    std::fill_n(row, own_, 0.0);
    row[i] = 1.0;
    for (Index j = 0; j < i; ++j) {
      const double* before = inverse_.data() + j * own_;
      for (Index l = 0; l <= j; ++l) row[l] -= t[j] * before[l];
    }
    for (Index l = 0; l <= i; ++l) {
      row[l] /= t[i];
      sum += row[l] * row[l];
    }
  }
  return bound_ = 1.0 / std::sqrt(sum);
}

bool LevelSvd::all_at_least(double bound) {
  if (own_ == 0 || bound_below() >= bound) return true;
  decompose();
  return *std::min_element(sigma_.data(), sigma_.data() + own_) >= bound;
}

double LevelSvd::smallest() {
  if (dependent_ || own_ == 0) return 0.0;
  decompose();
  return *std::min_element(sigma_.data(), sigma_.data() + own_);
}

bool LevelSvd::rotate(Index i, Index j) {
  const kernels::Table& kernel = *kernels::chosen;
  const Index size = image_.stride();
  double *a = image_.row(i), *b = image_.row(j);
  const double alpha = kernel.dot(size, a, a), beta = kernel.dot(size, b, b);
  const double gamma = kernel.dot(size, a, b);
  if (!(std::abs(gamma) > kOrthogonal * std::sqrt(alpha * beta))) return false;
  const double zeta = (beta - alpha) / (2.0 * gamma);
  const double tangent = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
  const double cosine = 1.0 / std::hypot(1.0, tangent);
  kernel.rotate(size, cosine, -cosine * tangent, a, b);
  kernel.rotate(right_.stride(), cosine, -cosine * tangent, right_.row(i), right_.row(j));
  return true;
}

void LevelSvd::decompose() {
  if (decomposed_) return;
  decomposed_ = true;
  image_.shape(count_);
  right_.shape(own_);
  image_.set_zero(own_);
  right_.set_zero(own_);
  for (Index j = 0; j < own_; ++j) right_.row(j)[j] = 1.0;
  for (Index i = 0; i < count_; ++i) {
    const double* l = nullspace_->equality_coordinates(rows_->equalities(level_) + i) + first_;
    for (Index j = 0; j < own_; ++j) image_.row(j)[i] = l[j];
  }
  bool turned = true;
  for (int sweep = 0; turned && sweep < kMostSweeps; ++sweep) {
    turned = false;
    for (Index i = 0; i + 1 < own_; ++i) {
      for (Index j = i + 1; j < own_; ++j) turned |= rotate(i, j);
    }
  }
  for (Index j = 0; j < own_; ++j) {
    sigma_[j] = std::sqrt(kernels::chosen->dot(image_.stride(), image_.row(j), image_.row(j)));
  }
}

}  // namespace hurcules
