#include "hurcules/solver/settled_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/tolerances.hpp"
#include "hurcules/solver/triangularize.hpp"

namespace hurcules {

namespace {

constexpr double kAbsent = std::numeric_limits<double>::infinity();

}  // namespace

void SettledLevel::reserve(Index unknowns, Index rows) {
  factor_.reserve(rows, unknowns);
  for (auto& group : planned_) group.reserve(rows);
  all_.reserve(rows);
  if (block_.rows() < rows + 2 * unknowns || block_.cols() < unknowns + 1) {
    block_.resize(rows + 2 * unknowns, unknowns + 1);
  }
  norm2_.reserve(rows);
  for (PaddedVector* v : {&y_, &t_, &force_, &push_}) v->reserve(padded(unknowns) + 4);
}

void SettledLevel::start(const RowTable& rows, const Chain& chain, const LevelProblem& level,
                         Candidates& candidates, const double* x_above) {
  rows_ = &rows;
  chain_ = &chain;
  level_ = &level;
  candidates_ = &candidates;
  x_above_ = x_above;
  for (auto& group : planned_) group.clear();
  for (int d = rows.equalities(level.level()); d < rows.equalities(level.level() + 1); ++d) {
    const int i = rows.row_of_dense(d);
    planned_[kOwn].push_back({i, Side::Upper, rows[i].upper, 0.0});
  }
}

void SettledLevel::plan(int row, Side side, double limit, Role role) {
  if (std::isinf(limit) || role == Role::Idle) return;
  const bool own = (*rows_)[row].level == level_->level();
  const Group group = role == Role::SmallestStep ? kSmallest : (own ? kOwn : kLimits);
  planned_[group].push_back({row, side, limit, 0.0});
}

void SettledLevel::factor() {
  all_.clear();
  for (int g = 0; g < kGroups; ++g) {
    all_.insert(all_.end(), planned_[g].begin(), planned_[g].end());
    end_[g] = static_cast<Index>(all_.size());
  }
  const Index columns = level_->free();
  factor_.start(end_[kSmallest], columns);
  for (Index i = 0; i < end_[kSmallest]; ++i) {
    const Row& row = (*rows_)[all_[i].row];
    const double* e =
        (row.equality ? chain_->equality_coordinates(row.dense) : chain_->coordinates(row)) +
        level_->first();
    // an equality row has no part behind its own directions
    const Index known = row.equality ? level_->own() : columns;
    double* r = factor_.row(i);
    std::copy_n(e, known, r);
    std::fill(r + known, r + factor_.stride(), 0.0);
    norm2_[i] = row.norm * row.norm;
  }
  for (const Group group : {kLimits, kOwn, kSmallest}) {
    factor_.run(begin(group), end_[group], norm2_.data(), tolerance::kRank);
    factor_.clear_unknown(begin(group), end_[group]);
    rank_[group] = factor_.rank();
  }
}

void SettledLevel::meet(Group group) {
  for (Index j = first(group); j < rank_[group]; ++j) {
    const Planned& row = all_[factor_.pivot(j)];
    const double* l = factor_.coordinates(factor_.pivot(j));
    double rest = row.limit - rows_->dot(row.row, x_above_);
    for (Index i = 0; i < j; ++i) rest -= l[i] * y_[i];
    y_[j] = rest / l[j];
  }
}

void SettledLevel::least_squares(double rho) {
  const Index first = this->first(kOwn), columns = rank_[kOwn] - first;
  Index count = 0;
  const auto add = [&](double scale, const double* l, double rest) {
    for (Index j = 0; j < columns; ++j) block_(count, j) = scale * l[first + j];
    block_(count++, columns) = scale * rest;
  };
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const double* l = factor_.coordinates(i);
    double rest = all_[i].limit - rows_->dot(all_[i].row, x_above_);
    for (Index j = 0; j < first; ++j) rest -= l[j] * y_[j];
    add(1.0, l, rest);
  }
  if (rho > 0.0) {
    for (Index j = 0; j < columns; ++j, ++count) {
      block_.row(count).head(columns + 1).setZero();
      block_(count, j) = rho;
    }
    // the rows of the last group move with these: their part of the step, L_SS^-1 (rest - L_SO y_O)
    const Index begin_last = count;
    for (Index s = rank_[kOwn]; s < rank_[kSmallest]; ++s, ++count) {
      const Planned& row = all_[factor_.pivot(s)];
      const double* l = factor_.coordinates(factor_.pivot(s));
      double rest = row.limit - rows_->dot(row.row, x_above_);
      for (Index j = 0; j < first; ++j) rest -= l[j] * y_[j];
      for (Index j = 0; j < columns; ++j) block_(count, j) = rho * l[first + j];
      block_(count, columns) = rho * rest;
      for (Index b = rank_[kOwn]; b < s; ++b) {
        block_.row(count).head(columns + 1) -=
            l[b] * block_.row(begin_last + b - rank_[kOwn]).head(columns + 1);
      }
      block_.row(count).head(columns + 1) /= l[s];
    }
  }
  triangularize(block_, count, columns);
  for (Index j = columns - 1; j >= 0; --j) {
    double sum = block_(j, columns);
    for (Index l = j + 1; l < columns; ++l) sum -= block_(j, l) * y_[first + l];
    y_[first + j] = sum / block_(j, j);
  }
}

void SettledLevel::step(double* x) {
  const kernels::Table& kernel = *kernels::chosen;
  std::fill_n(t_.data(), padded(level_->free()), 0.0);
  kernel.axpys(factor_.direction(0), factor_.rank(), factor_.stride(), y_.data(), t_.data());
  std::copy_n(x_above_, rows_->stride(), x);
  kernel.axpys(chain_->direction(level_->first()), level_->free(), rows_->stride(), t_.data(), x);
}

bool SettledLevel::holds(const double* x, double x_scale) {
  const auto allowed = [&](int i) { return tolerance::kBroken * x_scale * (*rows_)[i].norm; };
  // held rows stand at their limits, violated rows beyond them
  for (Index i = 0; i < end_[kSmallest]; ++i) {
    const Planned& row = all_[i];
    if ((*rows_)[row.row].equality) continue;
    const double beyond = rows_->dot(row.row, x) - row.limit;
    const bool own = i >= begin(kOwn) && i < end_[kOwn];
    if (own ? static_cast<double>(row.side) * beyond <= allowed(row.row)
            : std::abs(beyond) > allowed(row.row)) {
      return false;
    }
  }
  // all others are within theirs
  rows_->values(level_->level() + 1, x, candidates_->target.data());
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const Row& row = (*rows_)[all_[i].row];
    if (!row.equality) candidates_->set(row.candidate, -kAbsent, kAbsent);
  }
  const double excess = kernels::chosen->worst_excess(
      rows_->candidates(level_->level() + 1), candidates_->target.data(),
      candidates_->limits(*rows_), tolerance::kBroken * x_scale, 0.0);
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const Row& row = (*rows_)[all_[i].row];
    if (!row.equality) candidates_->set(row.candidate, row.lower, row.upper);
  }
  return excess <= 0.0;
}

void SettledLevel::balance_violation(double rho, const double* x) {
  // the gradient in the coordinates of the factor
  std::fill_n(force_.data(), padded(factor_.rank()), 0.0);
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const double violation = rows_->violation(all_[i].row, rows_->dot(all_[i].row, x));
    const double* l = factor_.coordinates(i);
    for (Index j = 0; j < rank_[kOwn]; ++j) force_[j] += violation * l[j];
  }
  for (Index j = 0; j < factor_.rank(); ++j) force_[j] += rho * rho * y_[j];
  for (Planned& row : all_) row.multiplier = 0.0;
  const auto balance = [&](Group group) {
    for (Index j = rank_[group] - 1; j >= first(group); --j) {
      const double* l = factor_.coordinates(factor_.pivot(j));
      const double push = -force_[j] / l[j];
      all_[factor_.pivot(j)].multiplier = push;
      for (Index i = 0; i < j; ++i) force_[i] += push * l[i];
    }
  };
  if (rho > 0.0) balance(kSmallest);
  balance(kLimits);
}

void SettledLevel::balance_step() {
  for (Index j = 0; j < factor_.rank(); ++j) push_[j] = -y_[j];
  for (Index j = factor_.rank() - 1; j >= 0; --j) {
    const double* l = factor_.coordinates(factor_.pivot(j));
    push_[j] /= l[j];
    for (Index i = 0; i < j; ++i) push_[i] -= push_[j] * l[i];
  }
}

void SettledLevel::keep_own(const double* x, std::vector<HeldRow>& held) const {
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const Planned& row = all_[i];
    if ((*rows_)[row.row].equality) continue;
    const double violation = rows_->violation(row.row, rows_->dot(row.row, x));
    held.push_back({row.row, row.side, std::abs(violation), Role::Violation});
  }
}

bool SettledLevel::keep_regularized(const double* x, std::vector<HeldRow>& held) const {
  double largest = 0.0;
  for (const Planned& row : all_) largest = std::max(largest, std::abs(row.multiplier));
  for (const Group group : {kLimits, kSmallest}) {
    for (Index i = begin(group); i < end_[group]; ++i) {
      const double push = static_cast<double>(all_[i].side) * all_[i].multiplier;
      if (push < -tolerance::kNegative * largest) return false;
      held.push_back({all_[i].row, all_[i].side, push, Role::Violation});
    }
  }
  keep_own(x, held);
  return true;
}

bool SettledLevel::keep(double x_scale, const double* x, std::vector<HeldRow>& held,
                        int& begin_norm) {
  double largest = 0.0;
  for (const Planned& row : all_) largest = std::max(largest, std::abs(row.multiplier));
  // a limit that hardly pushes may not settle anything: the long way decides
  const double least = level_->least_settling(largest, x_scale);
  for (Index i = begin(kLimits); i < end_[kLimits]; ++i) {
    const double push = static_cast<double>(all_[i].side) * all_[i].multiplier;
    if (push < least) return false;
    held.push_back({all_[i].row, all_[i].side, push, Role::Violation});
  }
  keep_own(x, held);
  begin_norm = static_cast<int>(held.size());
  // the step against the rows that keep it from being smaller; what is settled may push either way
  balance_step();
  double largest_push = 0.0;
  for (Index j = rank_[kOwn]; j < rank_[kSmallest]; ++j) {
    largest_push = std::max(largest_push, std::abs(push_[j]));
  }
  for (Index j = factor_.rank() - 1; j >= 0; --j) {
    const Planned& row = all_[factor_.pivot(j)];
    const bool smallest = j >= rank_[kOwn];
    const double push = static_cast<double>(row.side) * push_[j];
    if (smallest && push < -tolerance::kNegative * largest_push) return false;
    if ((*rows_)[row.row].equality) continue;
    held.push_back({row.row, row.side, push, smallest ? Role::SmallestStep : Role::Idle});
  }
  return true;
}

bool SettledLevel::solve(double rho, double x_scale, double* x, std::vector<HeldRow>& held,
                         int& begin_norm) {
  factor();
  meet(kLimits);
  least_squares(rho);
  meet(kSmallest);
  step(x);
  double largest = x_scale;
  for (Index j = 0; j < rows_->stride(); ++j) {
    if (!std::isfinite(x[j])) return false;
    largest = std::max(largest, std::abs(x[j]));
  }
  if (!holds(x, largest)) return false;
  balance_violation(rho, x);
  const std::size_t before = held.size();
  const bool proven = rho > 0.0 ? keep_regularized(x, held) : keep(x_scale, x, held, begin_norm);
  if (rho > 0.0) begin_norm = static_cast<int>(held.size());
  if (!proven) held.resize(before);
  return proven;
}

}  // namespace hurcules
