#include "hurcules/solver/working_set.hpp"

#include <cmath>
#include <limits>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

constexpr double kAbsent = std::numeric_limits<double>::infinity();

}  // namespace

void WorkingSet::reserve(Index rows, Index dimension) {
  factor_.reserve(std::min(rows, dimension) + 1, dimension);
  slots_.reserve(rows + 1);
  for (PaddedVector* v : {&norm2_, &room_, &g_, &work_}) v->reserve(rows + dimension + 4);
}

void WorkingSet::start(const RowTable& rows, const LevelProblem& problem, Candidates& candidates,
                       const double* x_free) {
  rows_ = &rows;
  problem_ = &problem;
  candidates_ = &candidates;
  x_free_ = x_free;
  slots_.clear();
  factor_.start(0, problem.dimension());
}

void WorkingSet::hold(int row, Side side) {
  const Index c = (*rows_)[row].candidate;
  const double lower = candidates_->lower(c), upper = candidates_->upper(c);
  slots_.push_back({row, side, side == Side::Upper ? upper : lower, lower, upper, 0.0, false});
  candidates_->set(c, -kAbsent, kAbsent);
}

void WorkingSet::release(const ActiveSlot& slot) {
  candidates_->set((*rows_)[slot.row].candidate, slot.lower, slot.upper);
}

double WorkingSet::room(const ActiveSlot& slot) const {
  return static_cast<double>(slot.side) * (slot.limit - rows_->dot(slot.row, x_free_));
}

double WorkingSet::fill_image(int row, Side side, double* m) const {
  const double norm2 = problem_->image((*rows_)[row], m);
  if (side == Side::Lower) {
    for (Index j = 0; j < problem_->dimension(); ++j) m[j] = -m[j];
  }
  return norm2;
}

void WorkingSet::plan(int row, Side side) {
  const Row& r = (*rows_)[row];
  const double limit =
      side == Side::Upper ? candidates_->upper(r.candidate) : candidates_->lower(r.candidate);
  if (std::isinf(limit) || size() == problem_->dimension()) return;
  const bool lost = problem_->free_part(r) <= tolerance::kLost * tolerance::kLost * r.norm * r.norm;
  if (r.norm == 0.0 || (lost && !problem_->has_slack(r))) return;
  hold(row, side);
}

void WorkingSet::factor() {
  const Index count = size();
  factor_.start(count, problem_->dimension());
  for (Index i = 0; i < count; ++i) {
    norm2_[i] = fill_image(slots_[i].row, slots_[i].side, factor_.row(i));
    room_[i] = room(slots_[i]);
  }
  factor_.run(0, count, norm2_.data(), tolerance::kDependent);
  if (factor_.rank() == count) return;
  // some depend on others: one by one, so that slots and directions stay in step
  for (ActiveSlot& slot : slots_) release(slot);
  factor_.start(0, problem_->dimension());
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    const ActiveSlot slot = slots_[i];
    const double norm2 = fill_image(slot.row, slot.side, factor_.row(factor_.rank()));
    if (!factor_.append(norm2, tolerance::kDependent)) continue;
    slots_[kept] = slot;
    room_[kept++] = room(slot);
  }
  slots_.resize(kept);
  for (const ActiveSlot& slot : slots_) {
    candidates_->set((*rows_)[slot.row].candidate, -kAbsent, kAbsent);
  }
}

bool WorkingSet::add(int row, Side side) {
  const Index slot = size();
  if (slot == problem_->dimension()) return false;
  const double norm2 = fill_image(row, side, factor_.row(slot));
  if (!factor_.append(norm2, tolerance::kDependent)) return false;
  hold(row, side);
  room_[slot] = room(slots_.back());
  return true;
}

void WorkingSet::drop(Index slot) {
  release(slots_[slot]);
  factor_.remove(slot);
  slots_.erase(slots_.begin() + slot);
  std::copy(room_.data() + slot + 1, room_.data() + size() + 1, room_.data() + slot);
}

bool WorkingSet::fix(int row, Side side, double limit) {
  if (!add(row, side)) return false;
  ActiveSlot& slot = slots_.back();
  slot.limit = limit;
  slot.fixed = true;
  room_[size() - 1] = room(slot);
  return true;
}

void WorkingSet::unfactor() {
  factor_.start(0, problem_->dimension());
}

void WorkingSet::clear() {
  for (const ActiveSlot& slot : slots_) release(slot);
  slots_.clear();
  factor_.start(0, problem_->dimension());
}

void WorkingSet::solve(double* y) {
  const Index count = size();
  std::copy_n(room_.data(), count, g_.data());
  factor_.solve(g_.data());
  std::fill_n(y, factor_.stride(), 0.0);
  kernels::chosen->axpys(factor_.direction(0), count, factor_.stride(), g_.data(), y);
  factor_.solve_transposed(g_.data());
  for (Index i = 0; i < count; ++i) slots_[i].multiplier = -g_[i];
}

void WorkingSet::correct(double* change, double* y) const {
  for (Index i = 0; i < size(); ++i) change[i] *= static_cast<double>(slots_[i].side);
  factor_.solve(change);
  kernels::chosen->axpys(factor_.direction(0), size(), factor_.stride(), change, y);
}

double WorkingSet::explain(int row, Side side, double* rest, double* r, double& norm2) const {
  norm2 = fill_image(row, side, rest);
  const double left = factor_.project(rest, r, norm2);
  factor_.solve_transposed(r);
  return left;
}

Index WorkingSet::most_negative() const {
  double largest = 0.0;
  for (const ActiveSlot& a : slots_) largest = std::max(largest, std::abs(a.multiplier));
  double worst = -tolerance::kNegative * largest;
  Index found = -1;
  for (Index i = 0; i < size(); ++i) {
    if (slots_[i].fixed || slots_[i].multiplier >= worst) continue;
    worst = slots_[i].multiplier;
    found = i;
  }
  return found;
}

}  // namespace hurcules
