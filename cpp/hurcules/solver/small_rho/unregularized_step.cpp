#include "hurcules/solver/small_rho/unregularized_step.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels/triangularize.hpp"
#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// rounding of a row, relative to |a|, where nothing magnifies it
constexpr double kOwnRounding = 1e-15;
// own directions from which on a level is large
constexpr Index kLarge = 16;

}  // namespace

void UnregularizedStep::reserve(Index unknowns, Index rows) {
  factor_.reserve(rows, unknowns);
  settled_.reserve(unknowns, rows);
  all_.reserve(rows);
  block_.reserve(rows + 2 * unknowns, unknowns + 1);
  work_.reserve(rows + 3 * unknowns + 4);
  norm2_.reserve(rows);
  for (PaddedVector* v : {&y_, &t_, &force_, &push_}) v->reserve(padded(unknowns) + 4);
}

void UnregularizedStep::start(const RowTable& rows, const NullspaceBasis& nullspace,
                              LevelProblem& level, const double* x_above, bool by_rows) {
  rows_ = &rows;
  nullspace_ = &nullspace;
  level_ = &level;
  x_above_ = x_above;
  by_rows_ = by_rows;
  settled_.start(rows, nullspace, level, x_above);
}

void UnregularizedStep::solve(const GroupedRows& groups, double rho, double* x) {
  large_ =
      !by_rows_ && rho == 0.0 && level_->own() >= kLarge && level_->equalities() > level_->own();
  gather(groups);
  factor();
  std::copy_n(x_above_, rows_->stride(), x);
  if (large_) return solve_large(x);
  meet(kLimits, x);
  least_squares(rho);
  meet(kSmallest, x);
  step(level_->first(), x);
}

void UnregularizedStep::solve_large(double* x) {
  const Index own = level_->own();
  const double* t = settled_.solve(settled());
  kernels::chosen->axpys(nullspace_->direction(level_->first()), own, rows_->stride(), t, x);
  std::copy_n(t + own, rank_[kOwn], y_.data());
  meet(kSmallest, x);
  step(level_->first() + own, x);
}

void UnregularizedStep::gather(const GroupedRows& groups) {
  all_.clear();
  for (int g = 0; g < kRowGroups; ++g) {
    const Index left_out = large_ && g == kOwn ? level_->equalities() : 0;
    all_.insert(all_.end(), groups[g].begin() + left_out, groups[g].end());
    end_[g] = static_cast<Index>(all_.size());
  }
}

void UnregularizedStep::factor() {
  const Index own = large_ ? level_->own() : 0, columns = level_->free() - own;
  factor_.start(end_[kSmallest], columns);
  for (Index i = 0; i < end_[kSmallest]; ++i) {
    const Row& row = (*rows_)[all_[i].row];
    const double* e = (row.equality ? nullspace_->equality_coordinates(row.dense)
                                    : nullspace_->coordinates(row)) +
                      level_->first() + own;
    // an equality row has no part behind its own directions
    const Index known = row.equality ? level_->own() : columns;
    double* r = factor_.row(i);
    std::copy_n(e, known, r);
    std::fill(r + known, r + factor_.stride(), 0.0);
    norm2_[i] = row.norm * row.norm;
  }
  const double* norm2 = norm2_.data();
  if (!large_) factor_.run(0, end_[kLimits], norm2, tolerance::kRank);
  rank_[kLimits] = factor_.rank();
  double weakest = 1.0;
  Index seen = 0;
  for (Index i = large_ ? 0 : begin(kOwn); i < end_[kOwn]; ++i) {
    factor_.run(i, i + 1, norm2, own_rank(weakest, seen));
  }
  rank_[kOwn] = factor_.rank();
  factor_.run(begin(kSmallest), end_[kSmallest], norm2, tolerance::kRank);
  rank_[kSmallest] = factor_.rank();
  factor_.clear_unknown(0, end_[kSmallest]);
}

// What is left of an own row outside the rows before it is rounding below this. A row that stands
// out from those before it by a part of its length leaves rounding as many times larger; limits
// carry more of it than own rows, whose directions are those of the basis. `weakest` such part,
// squared, of the directions that are `seen`.
double UnregularizedStep::own_rank(double& weakest, Index& seen) {
  for (; seen < factor_.rank(); ++seen) {
    const Index i = factor_.pivot(seen);
    const double part = factor_.coordinates(i)[seen];
    weakest = std::min(weakest, part * part / norm2_[i]);
  }
  if (seen == rank_[kLimits]) limits_rank_ = tolerance::kOwnRank / std::sqrt(weakest);
  return std::min(tolerance::kRank, std::max(limits_rank_, kOwnRounding / std::sqrt(weakest)));
}

void UnregularizedStep::meet(RowGroup group, const double* x) {
  for (Index j = first(group); j < rank_[group]; ++j) {
    const GroupedRow& row = all_[factor_.pivot(j)];
    const double* l = factor_.coordinates(factor_.pivot(j));
    double rest = row.limit - rows_->dot(row.row, x);
    for (Index i = 0; i < j; ++i) rest -= l[i] * y_[i];
    y_[j] = rest / l[j];
  }
}

void UnregularizedStep::least_squares(double rho) {
  const Index first = this->first(kOwn), columns = rank_[kOwn] - first;
  Index count = 0;
  block_.shape(columns + 1);
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i, ++count) {
    const double* l = factor_.coordinates(i);
    double rest = all_[i].limit - rows_->dot(all_[i].row, x_above_);
    for (Index j = 0; j < first; ++j) rest -= l[j] * y_[j];
    std::copy_n(l + first, columns, block_.row(count));
    block_.row(count)[columns] = rest;
  }
  if (rho > 0.0) {
    for (Index j = 0; j < columns; ++j, ++count) {
      std::fill_n(block_.row(count), columns + 1, 0.0);
      block_.row(count)[j] = rho;
    }
    add_smallest(rho, count);
  }
  triangularize(block_, count, columns, work_.data());
  solve_triangular(block_, columns, y_.data() + first);
}

// rows of the last group move with the own ones: their part of the step, L_SS^-1 (rest - L_SO y_O)
void UnregularizedStep::add_smallest(double rho, Index& count) {
  const Index first = this->first(kOwn), columns = rank_[kOwn] - first, begin_last = count;
  for (Index s = rank_[kOwn]; s < rank_[kSmallest]; ++s, ++count) {
    const GroupedRow& row = all_[factor_.pivot(s)];
    const double* l = factor_.coordinates(factor_.pivot(s));
    double rest = row.limit - rows_->dot(row.row, x_above_);
    for (Index j = 0; j < first; ++j) rest -= l[j] * y_[j];
    double* out = block_.row(count);
    for (Index j = 0; j < columns; ++j) out[j] = rho * l[first + j];
    out[columns] = rho * rest;
    for (Index b = rank_[kOwn]; b < s; ++b) {
      const double* before = block_.row(begin_last + b - rank_[kOwn]);
      for (Index j = 0; j <= columns; ++j) out[j] -= l[b] * before[j];
    }
    for (Index j = 0; j <= columns; ++j) out[j] /= l[s];
  }
}

void UnregularizedStep::step(Index first, double* x) {
  const kernels::Table& kernel = *kernels::chosen;
  const Index columns = factor_.columns();
  std::fill_n(t_.data(), padded(columns), 0.0);
  kernel.axpys(factor_.direction(0), factor_.rank(), factor_.stride(), y_.data(), t_.data());
  kernel.axpys(nullspace_->direction(first), columns, rows_->stride(), t_.data(), x);
}

// multipliers of the limits against the violations (and the regularisation): L' mu = -gradient
void UnregularizedStep::balance_violation(double rho, const double* x, const double* values) {
  for (GroupedRow& held : all_) held.multiplier = 0.0;
  if (large_) return settled_.balance(settled(), x, values);
  std::fill_n(force_.data(), padded(factor_.rank()), 0.0);
  double noise = 0.0;
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const Row& row = (*rows_)[all_[i].row];
    const double violation = row.equality ? rows_->dot(all_[i].row, x) - row.upper
                                          : rows_->violation(all_[i].row, values[row.candidate]);
    const double* l = factor_.coordinates(i);
    for (Index j = 0; j < rank_[kOwn]; ++j) force_[j] += violation * l[j];
    noise += tolerance::kNoise * std::abs(violation) * row.norm;
  }
  for (Index j = 0; j < factor_.rank(); ++j) force_[j] += rho * rho * y_[j];
  const auto balance = [&](RowGroup group) {
    for (Index j = rank_[group] - 1; j >= first(group); --j) {
      const double* l = factor_.coordinates(factor_.pivot(j));
      // divided by a short row, rounding would not be told from a push
      const double push = std::abs(force_[j]) > noise ? -force_[j] / l[j] : 0.0;
      all_[factor_.pivot(j)].multiplier = push;
      for (Index i = 0; i < j; ++i) force_[i] += push * l[i];
    }
  };
  if (rho > 0.0) balance(kSmallest);
  balance(kLimits);
}

// multipliers of all held rows against the step, L' nu = -y; those of the last group are theirs
void UnregularizedStep::balance_step() {
  double largest = 0.0;
  for (Index j = 0; j < factor_.rank(); ++j) {
    push_[j] = -y_[j];
    largest = std::max(largest, std::abs(y_[j]));
  }
  for (Index j = factor_.rank() - 1; j >= 0; --j) {
    const double* l = factor_.coordinates(factor_.pivot(j));
    push_[j] = std::abs(push_[j]) > tolerance::kNoise * largest ? push_[j] / l[j] : 0.0;
    for (Index i = 0; i < j; ++i) push_[i] -= push_[j] * l[i];
  }
  for (Index j = rank_[kOwn]; j < rank_[kSmallest]; ++j) {
    all_[factor_.pivot(j)].multiplier = push_[j];
  }
}

}  // namespace hurcules
