#include "hurcules/solver/level/working_set.hpp"

#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

void WorkingSet::reserve(Index rows, Index dimension) {
  factor_.reserve(std::min(rows, dimension) + 1, dimension);
  slots_.reserve(rows + 1);
  for (PaddedVector* v : {&norm2_, &g_, &work_}) v->reserve(rows + dimension + 4);
}

void WorkingSet::start(const RowTable& rows, const LevelProblem& problem, Candidates& candidates,
                       const double* x_free) {
  rows_ = &rows;
  problem_ = &problem;
  candidates_ = &candidates;
  x_free_ = x_free;
  slots_.clear();
  started_ = false;
}

void WorkingSet::hold(int row, Side side) {
  const Index c = (*rows_)[row].candidate;
  const double lower = candidates_->lower(c), upper = candidates_->upper(c);
  slots_.push_back({row, side, side == Side::Upper ? upper : lower, lower, upper, 0.0});
  candidates_->set(c, -kAbsent, kAbsent);
}

void WorkingSet::release(const ActiveSlot& slot) {
  candidates_->set((*rows_)[slot.row].candidate, slot.lower, slot.upper);
}

double WorkingSet::room(const ActiveSlot& slot) const {
  return static_cast<double>(slot.side) * (slot.limit - rows_->dot(slot.row, x_free_));
}

double WorkingSet::fill_image(int row, Side side, double* m) const {
  problem_->image((*rows_)[row], static_cast<double>(side), m);
  return kernels::chosen->dot(padded(problem_->width()), m, m);
}

void WorkingSet::start_factor(Index rows) {
  started_ = true;
  factor_.start(rows, problem_->width());
}

void WorkingSet::plan(int row, Side side) {
  const Row& r = (*rows_)[row];
  const double limit =
      side == Side::Upper ? candidates_->upper(r.candidate) : candidates_->lower(r.candidate);
  if (std::isinf(limit) || size() == problem_->dimension()) return;
  hold(row, side);
}

void WorkingSet::factor() {
  const Index count = size();
  start_factor(count);
  for (Index i = 0; i < count; ++i) {
    problem_->image((*rows_)[slots_[i].row], static_cast<double>(slots_[i].side), factor_.row(i));
    g_[i] = room(slots_[i]);
  }
  if (count == 0) return;
  kernels::chosen->norms2(factor_.row(0), count, factor_.stride(), norm2_.data());
  // rows that nothing here can move are left out
  for (Index i = 0; i < count; ++i) {
    if (lost(slots_[i].row, norm2_[i])) norm2_[i] = kAbsent;
  }
  factor_.run(0, count, norm2_.data(), tolerance::kDependent, g_.data());
  if (factor_.rank() == count) return;
  // some depend on others: one by one, so that slots and directions stay in step
  for (ActiveSlot& slot : slots_) release(slot);
  start_factor(0);
  Index kept = 0;
  for (Index i = 0; i < count; ++i) {
    const ActiveSlot slot = slots_[i];
    const double norm2 = fill_image(slot.row, slot.side, factor_.row(factor_.rank()));
    if (lost(slot.row, norm2) || !factor_.append(norm2, tolerance::kDependent)) continue;
    slots_[kept] = slot;
    append_room(kept++);
  }
  slots_.resize(kept);
  for (const ActiveSlot& slot : slots_) {
    candidates_->set((*rows_)[slot.row].candidate, -kAbsent, kAbsent);
  }
}

void WorkingSet::append_room(Index slot) {
  const double* l = factor_.coordinates(slot);
  double rest = room(slots_[slot]);
  for (Index j = 0; j < slot; ++j) rest -= l[j] * g_[j];
  g_[slot] = rest / l[slot];
}

bool WorkingSet::add(int row, Side side) {
  const Index slot = size();
  if (slot == problem_->dimension()) return false;
  if (!started_) start_factor(0);
  const double norm2 = fill_image(row, side, factor_.row(slot));
  if (!factor_.append(norm2, tolerance::kDependent)) return false;
  hold(row, side);
  append_room(slot);
  return true;
}

void WorkingSet::drop(Index slot) {
  release(slots_[slot]);
  factor_.remove(slot, g_.data());
  slots_.erase(slots_.begin() + slot);
}

bool WorkingSet::lost(int row, double norm2) const {
  const Row& r = (*rows_)[row];
  const double least = tolerance::kLost * tolerance::kLost * r.norm * r.norm;
  // an image is never longer than the free part of its row
  return norm2 == 0.0 || (norm2 <= least && !problem_->has_slack(r) && problem_->lost(r));
}

void WorkingSet::clear() {
  for (const ActiveSlot& slot : slots_) release(slot);
  slots_.clear();
  started_ = false;
}

void WorkingSet::solve(double* y) {
  if (!started_) start_factor(0);
  std::fill_n(y, factor_.stride(), 0.0);
  kernels::chosen->axpys(factor_.direction(0), size(), factor_.stride(), g_.data(), y);
}

void WorkingSet::add_newest(double* y) const {
  const Index slot = size() - 1;
  kernels::chosen->axpy(factor_.stride(), g_[slot], factor_.direction(slot), y);
}

void WorkingSet::find_multipliers() {
  factor_.find_multipliers(g_.data(), work_.data());
  for (Index i = 0; i < size(); ++i) slots_[i].multiplier = work_[i];
}

void WorkingSet::correct(double* change, double* y) {
  for (Index i = 0; i < size(); ++i) change[i] *= static_cast<double>(slots_[i].side);
  factor_.correct(change, y);
  for (Index i = 0; i < size(); ++i) g_[i] += change[i];
}

Index WorkingSet::most_negative(double tolerance) const {
  double largest = 0.0;
  for (const ActiveSlot& a : slots_) largest = std::max(largest, std::abs(a.multiplier));
  double worst = -tolerance * largest;
  Index found = -1;
  for (Index i = 0; i < size(); ++i) {
    if (slots_[i].multiplier >= worst) continue;
    worst = slots_[i].multiplier;
    found = i;
  }
  return found;
}

}  // namespace hurcules
