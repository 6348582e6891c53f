#include "hurcules/solver/level/active_set.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

void ActiveSet::reserve(Index unknowns, Index most_rows, Index most_own) {
  const Index dimension = padded(unknowns) + most_own;
  set_.reserve(most_rows, dimension);
  for (PaddedVector* v : {&x_, &x_free_, &target_}) v->reserve(padded(unknowns));
  y_.reserve(padded(dimension));
  change_.reserve(most_rows + dimension + 4);
  ignored_.reserve(most_rows);
}

void ActiveSet::start(const RowTable& rows, LevelProblem& problem, Candidates& candidates,
                      double rho, const double* x_above, double x_scale) {
  rows_ = &rows;
  problem_ = &problem;
  candidates_ = &candidates;
  problem.solve_free(rho, x_free_.data());
  relative_ = tolerance::kBroken * x_scale;
  absolute_ = tolerance::kBrokenTarget * problem.target_size();
  count_ = rows.candidates(problem.level() + 1);
  x_above_ = x_above;
  ignored_.clear();
  set_.start(rows, problem, candidates, x_free_.data());
}

void ActiveSet::clear() {
  restore_ignored();
  set_.clear();
}

bool ActiveSet::free_is_feasible() {
  rows_->values(problem_->level() + 1, x_free_.data(), candidates_->target.data());
  // x_free holds more digits than a target of size |r| / rho: none of its rounding is allowed for
  if (kernels::chosen->worst_excess(count_, candidates_->target.data(), candidates_->limits(*rows_),
                                    relative_, 0.0) > 0.0) {
    return false;
  }
  std::swap(candidates_->value, candidates_->target);
  return true;
}

void ActiveSet::evaluate() {
  problem_->step(y_.data(), x_free_.data(), target_.data());
  rows_->values(problem_->level() + 1, target_.data(), candidates_->target.data());
}

void ActiveSet::solve() {
  set_.solve(y_.data());
  evaluate();
}

bool ActiveSet::lost(const Row& row) const {
  if (row.norm == 0.0) return true;
  return !problem_->has_slack(row) && problem_->lost(row);
}

void ActiveSet::ignore(const Row& row) {
  ignored_.push_back(
      {row.candidate, candidates_->lower(row.candidate), candidates_->upper(row.candidate)});
  candidates_->set(row.candidate, -kAbsent, kAbsent);
}

void ActiveSet::restore_ignored() {
  for (const Ignored& i : ignored_) candidates_->set(i.candidate, i.lower, i.upper);
  ignored_.clear();
}

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

double ActiveSet::largest_miss(double* change) const {
  double worst = 0.0;
  for (Index s = 0; s < set_.size(); ++s) {
    const ActiveSlot& slot = set_.slots()[s];
    const Row& row = (*rows_)[slot.row];
    const double slack = problem_->has_slack(row) ? problem_->slack(row, y_.data()) : 0.0;
    change[s] = slot.limit - (candidates_->target[row.candidate] + slack);
    worst = std::max(worst, std::abs(change[s]));
  }
  return worst;
}

void ActiveSet::refine() {
  const double x_size = std::max(1.0, kernels::chosen->largest(rows_->stride(), target_.data()));
  for (int pass = 0; pass < 2; ++pass) {
    if (largest_miss(change_.data()) <= tolerance::kMiss * x_size) break;
    set_.correct(change_.data(), y_.data());
    evaluate();
  }
  std::swap(candidates_->value, candidates_->target);
}

}  // namespace hurcules
