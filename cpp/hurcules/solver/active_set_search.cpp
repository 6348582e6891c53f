// The two ways to the right working set: primal from a feasible point, dual from any set.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/active_set.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

void ActiveSet::hold_violated() {
  const int level = problem_->level();
  for (int i = rows_->begin(level); i < rows_->begin(level + 1); ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality || row.norm == 0.0) continue;
    const double allowed = relative_ * row.norm + absolute_,
                 value = candidates_->value[row.candidate];
    if (value > row.upper + allowed) set_.plan(i, Side::Upper);
    if (value < row.lower - allowed) set_.plan(i, Side::Lower);
  }
  set_.factor();
}

bool ActiveSet::primal(Budget& budget, int most_changes) {
  std::copy_n(x_above_, rows_->stride(), x_.data());
  std::copy_n(candidates_->above.data(), count_, candidates_->value.data());
  if (problem_->has_slacks()) hold_violated();
  double *value = candidates_->value.data(), *target = candidates_->target.data();
  const int end = std::min(budget.most, budget.used + most_changes);
  solve();
  while (true) {
    // how far it is to where the working set wants to go
    const kernels::Blocking blocking = kernels::chosen->first_blocking(
        count_, value, target, candidates_->limits(*rows_), relative_, absolute_);
    if (blocking.candidate >= 0) {
      const int row = rows_->row_of_candidate(blocking.candidate);
      if (lost((*rows_)[row])) {
        ignore((*rows_)[row]);
        continue;
      }
      if (budget.used >= end) return false;
      kernels::chosen->advance(rows_->stride(), blocking.way, target_.data(), x_.data());
      kernels::chosen->advance(count_, blocking.way, target, value);
      const bool up = target[blocking.candidate] > candidates_->upper(blocking.candidate);
      ++budget.used;
      if (set_.add(row, up ? Side::Upper : Side::Lower)) {
        set_.add_newest(y_.data());
        evaluate();
      } else {  // a row that depends on the set cannot stop a move inside it: rounding
        ignore((*rows_)[row]);
      }
      continue;
    }
    std::copy_n(target_.data(), rows_->stride(), x_.data());
    std::copy_n(target, count_, value);
    set_.find_multipliers();
    const Index slot = set_.most_negative(tolerance::kNegative);
    if (slot < 0) return true;
    if (budget.used >= end) return false;
    set_.drop(slot);
    restore_ignored();
    ++budget.used;
    solve();
  }
}

bool ActiveSet::drop_negative(Budget& budget) {
  for (Index slot = set_.most_negative(tolerance::kNegative); slot >= 0;
       slot = set_.most_negative(tolerance::kNegative)) {
    if (budget.spent()) return false;
    set_.drop(slot);
    ++budget.used;
    set_.find_multipliers();
  }
  return true;
}

int ActiveSet::most_broken(double slack, Side& side) const {
  double worst = slack;
  int found = -1;
  for (Index c = 0; c < count_; ++c) {
    const double value = candidates_->target[c];
    const double over = value - candidates_->upper(c), under = candidates_->lower(c) - value;
    const double excess = std::max(over, under);
    if (!(excess > 0.0)) continue;
    const double relative = excess / (relative_ * rows_->norms()[c] + absolute_);
    if (relative <= worst) continue;
    worst = relative;
    side = over > under ? Side::Upper : Side::Lower;
    found = rows_->row_of_candidate(c);
  }
  return found;
}

bool ActiveSet::raise(int row, Side side, Budget& budget) {
  const double sign = static_cast<double>(side);
  const Index c = (*rows_)[row].candidate;
  const double limit = side == Side::Upper ? candidates_->upper(c) : candidates_->lower(c);
  double broken = sign * (candidates_->target[c] - limit);
  while (!budget.spent()) {
    double norm2 = 0.0;
    const double left = set_.explain(row, side, rest_.data(), r_.data(), norm2);
    const bool dependent = left <= tolerance::kDependent * tolerance::kDependent * norm2;
    // the step at which the row holds, and the first at which a multiplier vanishes
    const double full = dependent ? kNever : std::max(0.0, broken) / left;
    double partial = kNever;
    Index vanishing = -1;
    std::vector<ActiveSlot>& slots = set_.slots();
    for (Index i = 0; i < set_.size(); ++i) {
      if (r_[i] <= 0.0) continue;
      const double way = std::max(0.0, slots[i].multiplier) / r_[i];
      if (way >= partial) continue;
      partial = way;
      vanishing = i;
    }
    const double step = std::min(full, partial);
    if (step == kNever) {  // dependent and nothing to swap it for: rounding
      ignore((*rows_)[row]);
      return true;
    }
    for (Index i = 0; i < set_.size(); ++i) slots[i].multiplier -= step * r_[i];
    if (!dependent) broken -= step * left;
    ++budget.used;
    if (full <= partial) {
      if (!set_.add(row, side)) ignore((*rows_)[row]);
      return true;
    }
    set_.drop(vanishing);
  }
  return false;
}

bool ActiveSet::dual(Budget& budget, bool& raised) {
  const int before = budget.used;
  set_.find_multipliers();
  if (!drop_negative(budget)) return false;
  double slack = 1.0;
  const int dimension = static_cast<int>(problem_->dimension());
  int next_raise = 2 * dimension + 30;
  while (true) {
    // the ladder: a tolerance that grows tenfold, so that rounding cannot keep two rows swapping
    // for ever
    if (budget.used - before > next_raise) {
      slack *= 10.0;
      next_raise += dimension / 2 + 1;
      raised = true;
    }
    solve();
    Side side = Side::Upper;
    const int row = most_broken(slack, side);
    if (row < 0) return true;
    if (lost((*rows_)[row])) {
      ignore((*rows_)[row]);
      continue;
    }
    if (!raise(row, side, budget)) return false;
    set_.find_multipliers();
    // rounding may leave a multiplier below zero after a swap
    if (!drop_negative(budget)) return false;
  }
}

}  // namespace hurcules
