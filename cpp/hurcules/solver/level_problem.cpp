#include "hurcules/solver/level_problem.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"
#include "hurcules/solver/triangularize.hpp"

namespace hurcules {

namespace {

// normal equations lose no more than the square of this
constexpr double kMostCondition = 100.0;

}  // namespace

void LevelProblem::reserve(Index unknowns, Index rows, Index most_own) {
  const Index stacked = std::min(rows, most_own) + std::min(unknowns, most_own);
  if (R_.rows() < stacked) R_.resize(stacked, std::min(unknowns, most_own) + 1);
  for (PaddedVector* v : {&inverse_, &c_, &t_}) v->reserve(padded(unknowns) + 4);
  r_.reserve(rows + 4);
}

void LevelProblem::start(const RowTable& rows, const Chain& chain, int level, Index first,
                         Index own) {
  rows_ = &rows;
  chain_ = &chain;
  level_ = level;
  first_ = first;
  own_ = own;
  free_ = chain.unknowns() - first_;
  equalities_ = slacks_ = 0;
}

void LevelProblem::start_smallest(const RowTable& rows, const Chain& chain, int level) {
  start(rows, chain, level, chain.rank_before(level + 1), 0);
}

void LevelProblem::start(const RowTable& rows, const Chain& chain, int level) {
  const Index first = chain.rank_before(level);
  start(rows, chain, level, first, chain.rank_before(level + 1) - first);
  equalities_ = rows.equalities(level + 1) - rows.equalities(level);
  slacks_ = rows.begin(level + 1) - rows.begin(level) - equalities_;
  own_norm_ = 0.0;
  for (int i = rows.begin(level); i < rows.begin(level + 1); ++i) {
    own_norm_ = std::max(own_norm_, rows[i].norm);
  }
  largest_ = 0.0;
  for (Index i = 0; i < equalities_; ++i) {
    const double* e = chain.equality_coordinates(rows.equalities(level) + i) + first_;
    for (Index j = 0; j < own_; ++j) largest_ = std::max(largest_, std::abs(e[j]));
  }
}

double LevelProblem::least_settling(double largest_multiplier, double x_scale) const {
  return std::max(tolerance::kSettling * largest_multiplier,
                  tolerance::kNoForce * own_norm_ * own_norm_ * x_scale);
}

void LevelProblem::residual(const double* x) {
  const int first = rows_->equalities(level_);
  kernels::chosen->dots(rows_->dense_row(first), equalities_, rows_->stride(), x, r_.data());
  for (Index i = 0; i < equalities_; ++i) {
    r_[i] = (*rows_)[rows_->row_of_dense(first + static_cast<int>(i))].lower - r_[i];
  }
}

double LevelProblem::relative_residual(const double* x) {
  residual(x);
  double x_size = 1.0, worst = 0.0;
  for (Index j = 0; j < rows_->stride(); ++j) x_size = std::max(x_size, std::abs(x[j]));
  const int first = rows_->equalities(level_);
  for (Index i = 0; i < equalities_; ++i) {
    const Row& row = (*rows_)[rows_->row_of_dense(first + static_cast<int>(i))];
    const double scale = row.norm * x_size + std::abs(row.lower);
    if (r_[i] != 0.0) worst = std::max(worst, std::abs(r_[i]) / scale);
  }
  return worst;
}

void LevelProblem::factor_by_cholesky() {
  for (Index j = 0; j < own_; ++j) {
    c_[j] = 0.0;
    for (Index l = j; l < own_; ++l) R_(j, l) = j == l ? rho_ * rho_ : 0.0;
  }
  for (Index i = 0; i < equalities_; ++i) {
    const double* e =
        chain_->equality_coordinates(rows_->equalities(level_) + i) + first_;
    for (Index j = 0; j < own_; ++j) {
      c_[j] += e[j] * r_[i];
      for (Index l = j; l < own_; ++l) R_(j, l) += e[j] * e[l];
    }
  }
  for (Index j = 0; j < own_; ++j) {
    const double root = std::sqrt(R_(j, j));
    inverse_[j] = 1.0 / root;
    R_(j, j) = root;
    for (Index l = j + 1; l < own_; ++l) R_(j, l) *= inverse_[j];
    for (Index l = j + 1; l < own_; ++l) {
      for (Index h = l; h < own_; ++h) R_(l, h) -= R_(j, l) * R_(j, h);
    }
    // R' c = Lk' r, row by row
    c_[j] *= inverse_[j];
    for (Index l = j + 1; l < own_; ++l) c_[l] -= R_(j, l) * c_[j];
  }
}

void LevelProblem::factor_by_householder() {
  Index count = 0;
  for (; count < equalities_; ++count) {
    const double* e =
        chain_->equality_coordinates(rows_->equalities(level_) + count) + first_;
    for (Index j = 0; j < own_; ++j) R_(count, j) = e[j];
    R_(count, own_) = r_[count];
  }
  if (rho_ > 0.0) {
    for (Index j = 0; j < own_; ++j, ++count) {
      R_.row(count).head(own_ + 1).setZero();
      R_(count, j) = rho_;
    }
  }
  triangularize(R_, count, own_);
  for (Index j = 0; j < own_; ++j) {
    c_[j] = R_(j, own_);
    inverse_[j] = 1.0 / R_(j, j);
  }
}

void LevelProblem::solve_free(double rho, const double* centre, double* x_free) {
  rho_ = rho;
  residual(centre);
  if (rho > 0.0 && largest_ < kMostCondition * rho) {
    factor_by_cholesky();
  } else {
    factor_by_householder();
  }
  target_size_ = 0.0;
  for (Index j = own_ - 1; j >= 0; --j) {
    target_size_ = std::max(target_size_, std::abs(c_[j]));
    double sum = c_[j];
    for (Index l = j + 1; l < own_; ++l) sum -= R_(j, l) * t_[l];
    t_[j] = sum * inverse_[j];
  }
  if (rho > 0.0) target_size_ /= rho;
  std::copy_n(centre, rows_->stride(), x_free);
  kernels::chosen->axpys(chain_->direction(first_), own_, rows_->stride(), t_.data(), x_free);
}

Index LevelProblem::slack_of(const Row& row) const {
  if (row.bound) return row.row;
  return row.dense - rows_->equalities() - rows_->inequalities(level_);
}

double LevelProblem::image(const Row& row, double* m) const {
  const double* e = chain_->coordinates(row) + first_;
  const Index size = padded(dimension());
  // rho R^-T e_1
  for (Index j = 0; j < own_; ++j) {
    double sum = rho_ * e[j];
    for (Index l = 0; l < j; ++l) sum -= R_(l, j) * m[l];
    m[j] = sum * inverse_[j];
  }
  for (Index j = own_; j < free_; ++j) m[j] = e[j];
  for (Index j = free_; j < size; ++j) m[j] = 0.0;
  if (has_slack(row)) m[free_ + slack_of(row)] = rho_;
  return kernels::chosen->dot(size, m, m);
}

double LevelProblem::free_part(const Row& row) const {
  const double* e = chain_->coordinates(row) + first_;
  double sum = 0.0;
  for (Index j = 0; j < free_; ++j) sum += e[j] * e[j];
  return sum;
}

void LevelProblem::project(const double* v, double* part) {
  const kernels::Table& kernel = *kernels::chosen;
  kernel.dots(chain_->direction(first_), free_, rows_->stride(), v, t_.data());
  std::fill_n(part, rows_->stride(), 0.0);
  kernel.axpys(chain_->direction(first_), free_, rows_->stride(), t_.data(), part);
}

void LevelProblem::step(const double* y, const double* x_free, double* x) {
  // t_1 = rho R^-1 y_1
  for (Index j = own_ - 1; j >= 0; --j) {
    double sum = rho_ * y[j];
    for (Index l = j + 1; l < own_; ++l) sum -= R_(j, l) * t_[l];
    t_[j] = sum * inverse_[j];
  }
  for (Index j = own_; j < free_; ++j) t_[j] = y[j];
  std::copy_n(x_free, rows_->stride(), x);
  kernels::chosen->axpys(chain_->direction(first_), free_, rows_->stride(), t_.data(), x);
}

}  // namespace hurcules
