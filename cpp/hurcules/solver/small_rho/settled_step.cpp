#include "hurcules/solver/small_rho/settled_step.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/kernels.hpp"
#include "hurcules/solver/kernels/triangularize.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

void SettledStep::reserve(Index unknowns, Index rows) {
  const Index most = rows + unknowns;
  held_.reserve(most, unknowns + 1);
  mirror_.reserve(unknowns, unknowns + 1);
  block_.reserve(most, unknowns + 1);
  work_.reserve(most + padded(unknowns + 1));
  for (PaddedVector* v : {&asked_, &violation_}) v->reserve(most + 4);
  for (PaddedVector* v : {&y_, &t_, &force_, &wide_}) v->reserve(padded(unknowns + 1));
  pivot_.resize(std::max<std::size_t>(pivot_.size(), unknowns));
}

void SettledStep::start(const RowTable& rows, const NullspaceBasis& nullspace, LevelProblem& level,
                        const double* x_above) {
  rows_ = &rows;
  nullspace_ = &nullspace;
  level_ = &level;
  x_above_ = x_above;
  condensed_ = false;
}

const double* SettledStep::solve(const Held& held) {
  const kernels::Table& kernel = *kernels::chosen;
  columns_ = level_->own() + held.settled;
  rank_ = 0;
  for (PaddedRows* rows : {&held_, &mirror_}) rows->shape(columns_ + 1);
  reduce_limits(held);
  meet_limits(held);
  if (rank_ < columns_) least_squares(held);
  std::fill_n(t_.data(), mirror_.stride(), 0.0);
  std::copy_n(y_.data(), columns_, t_.data());
  for (Index j = rank_ - 1; j >= 0; --j) {
    const double* v = mirror_.row(j);
    kernel.axpy(mirror_.stride(), -kernel.dot(mirror_.stride(), v, t_.data()), v, t_.data());
  }
  return t_.data();
}

double SettledStep::rest(const GroupedRow& row) const {
  return row.limit - rows_->dot(row.row, x_above_);
}

// an own row: no part beside the own directions
void SettledStep::add(const double* e) {
  double* row = held_.row(count_++);
  std::copy_n(e, level_->own(), row);
  std::fill(row + level_->own(), row + held_.stride(), 0.0);
}

void SettledStep::add(const Held& held, Index i) {
  add(nullspace_->coordinates((*rows_)[held.rows[i].row]) + level_->first());
  std::copy_n(held.beside.coordinates(i), held.settled, held_.row(count_ - 1) + level_->own());
}

void SettledStep::end_rows() {
  // rows are taken four at a time
  std::fill_n(held_.row(count_), 3 * held_.stride(), 0.0);
}

void SettledStep::reduce_limits(const Held& held) {
  count_ = 0;
  for (Index i = 0; i < held.limits; ++i) add(held, i);
  end_rows();
  for (Index i = 0; i < held.limits && rank_ < columns_; ++i) {
    double *row = held_.row(i), *v = mirror_.row(rank_);
    std::fill_n(v, rank_, 0.0);
    std::copy(row + rank_, row + columns_, v + rank_);
    std::fill(v + columns_, v + mirror_.stride(), 0.0);
    const double length = std::sqrt(kernels::chosen->dot(mirror_.stride(), v, v));
    if (!(length > tolerance::kRank * (*rows_)[held.rows[i].row].norm)) continue;
    const double alpha = v[rank_] > 0.0 ? -length : length;
    v[rank_] -= alpha;
    kernels::chosen->scale(mirror_.stride(), 1.0 / std::sqrt(std::abs(alpha * v[rank_])), v, v);
    reflect(v, i + 1);
    row[rank_] = alpha;
    pivot_[rank_++] = i;
  }
}

// the rows from `first` on by 1 - v v'; what each has along v is written behind its coordinates
void SettledStep::reflect(const double* v, Index first) {
  kernels::chosen->eliminate(v, 1.0, held_.row(first), count_ - first, held_.stride(),
                             held_.row(first) + columns_);
}

void SettledStep::meet_limits(const Held& held) {
  for (Index j = 0; j < rank_; ++j) {
    const double* l = held_.row(pivot_[j]);
    double left = rest(held.rows[pivot_[j]]);
    for (Index i = 0; i < j; ++i) left -= l[i] * y_[i];
    y_[j] = left / l[j];
  }
}

void SettledStep::gather_own(const Held& held) {
  count_ = held.limits;
  Index asked = 0;
  if (condensed_) {
    level_->factor(0.0);
    for (; asked < level_->own(); ++asked) {
      add(level_->condensed_row(asked));
      std::fill_n(held_.row(count_ - 1), asked, 0.0);
      asked_[asked] = level_->condensed_target(asked);
    }
  } else {
    for (; asked < level_->equalities(); ++asked) {
      add(level_->equality_row(asked));
      asked_[asked] = level_->equality_rest(asked);
    }
  }
  for (Index i = held.limits; i < static_cast<Index>(held.rows.size()); ++i, ++asked) {
    add(held, i);
    asked_[asked] = rest(held.rows[i]);
  }
  end_rows();
  // R is worth its while from the second set on
  condensed_ = true;
}

void SettledStep::least_squares(const Held& held) {
  gather_own(held);
  for (Index j = 0; j < rank_; ++j) reflect(mirror_.row(j), held.limits);
  const Index columns = columns_ - rank_, count = count_ - held.limits;
  block_.shape(columns + 1);
  for (Index i = 0; i < count; ++i) {
    const double* e = held_.row(held.limits + i);
    double left = asked_[i];
    for (Index j = 0; j < rank_; ++j) left -= e[j] * y_[j];
    std::copy_n(e + rank_, columns, block_.row(i));
    block_.row(i)[columns] = left;
  }
  triangularize(block_, count, columns, work_.data());
  solve_triangular(block_, columns, y_.data() + rank_);
}

// of the violations at x, in the directions of (t_1, u); returns what of it is rounding
double SettledStep::find_force(const Held& held, const double* x, const double* values) {
  const kernels::Table& kernel = *kernels::chosen;
  const Index equalities = level_->equalities(), own = level_->own();
  const int first = rows_->equalities(level_->level());
  double noise = 0.0;
  kernel.dots(rows_->dense_row(first), equalities, rows_->stride(), x, violation_.data());
  for (Index i = 0; i < equalities; ++i) {
    violation_[i] -= rows_->targets()[first + i];
    noise += tolerance::kNoise * std::abs(violation_[i]) * rows_->dense_norms()[first + i];
  }
  std::fill_n(wide_.data(), nullspace_->stride(), 0.0);
  kernel.axpys(nullspace_->equality_coordinates(first), equalities, nullspace_->stride(),
               violation_.data(), wide_.data());
  std::fill_n(force_.data(), mirror_.stride(), 0.0);
  std::copy_n(wide_.data() + level_->first(), own, force_.data());
  for (Index i = held.limits; i < static_cast<Index>(held.rows.size()); ++i) {
    const Row& row = (*rows_)[held.rows[i].row];
    const double violation = rows_->violation(held.rows[i].row, values[row.candidate]);
    const double* e = nullspace_->coordinates(row) + level_->first();
    const double* beside = held.beside.coordinates(i);
    for (Index j = 0; j < own; ++j) force_[j] += violation * e[j];
    for (Index j = 0; j < held.settled; ++j) force_[own + j] += violation * beside[j];
    noise += tolerance::kNoise * std::abs(violation) * row.norm;
  }
  return noise;
}

// L' mu = -force in the directions of the limits
void SettledStep::balance(const Held& held, const double* x, const double* values) {
  const kernels::Table& kernel = *kernels::chosen;
  const double noise = find_force(held, x, values);
  for (Index j = 0; j < rank_; ++j) {
    const double* v = mirror_.row(j);
    kernel.axpy(mirror_.stride(), -kernel.dot(mirror_.stride(), v, force_.data()), v,
                force_.data());
  }
  for (Index j = rank_ - 1; j >= 0; --j) {
    const double* l = held_.row(pivot_[j]);
    // divided by a short row, rounding would not be told from a push
    const double push = std::abs(force_[j]) > noise ? -force_[j] / l[j] : 0.0;
    held.rows[pivot_[j]].multiplier = push;
    for (Index i = 0; i < j; ++i) force_[i] += push * l[i];
  }
}

}  // namespace hurcules
