// The ways to the answer of one level that has limits in its way.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/lexicographic.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

bool Lexicographic::solve(Way way, double rho, int k) {
  chain_->complete(rows_);
  if (way >= Way::Careful) return solve_carefully(way == Way::Careful ? rho : 0.0);
  return regularized(rho) ? solve_regularized(way, rho, k) : solve_settled(way, rho, k);
}

bool Lexicographic::solve_kept(double rho, int k) {
  const std::span kept(kept_.data() + kept_begin_[k], kept_.data() + kept_begin_[k + 1]);
  if (!kept_level_.solve(rows_, problem_, candidates_, rho, above_scale_, kept, x_)) return false;
  kept_level_.keep(rho * rho, held_);
  begin_norm_ = static_cast<int>(held_.size());
  return values_known_ = true;
}

bool Lexicographic::solve_regularized(Way way, double rho, int k) {
  if (way == Way::Warm) return solve_kept(rho, k);
  active_set_.start(rows_, problem_, candidates_, rho, x_above_, above_scale_);
  if (!find_cold()) {
    take(active_set_.x_feasible());
    return false;
  }
  take_refined();
  keep_held(rho * rho);
  begin_norm_ = static_cast<int>(held_.size());
  return true;
}

bool Lexicographic::solve_settled(Way way, double rho, int k) {
  if (way == Way::Warm) return settle_kept(rho, k);
  if (problem_.own_norm() == 0.0) {
    take(x_above_);
    return true;
  }
  const double epsilon = std::max(rho, tolerance::kProximal * problem_.own_norm());
  active_set_.start(rows_, problem_, candidates_, epsilon, x_above_, above_scale_);
  if (find_cold()) return settle_held(rho, epsilon);
  take(active_set_.x_feasible());
  return false;
}

bool Lexicographic::solve_carefully(double rho) {
  ++solution_.factorizations;
  careful_level_.start(rows_, *chain_, problem_, x_above_, above_scale_);
  return careful_level_.solve(rho, budget_, x_, held_, begin_norm_);
}

bool Lexicographic::settle_kept(double rho, int k) {
  settled_level_.start(rows_, *chain_, problem_, candidates_, x_above_, x_above_, above_scale_);
  for (int h = kept_begin_[k]; h < kept_begin_[k + 1]; ++h) {
    settled_level_.hold(kept_[h].row, kept_[h].side, kept_[h].role);
  }
  return settled_level_.solve(rho, budget_, x_, held_, begin_norm_);
}

bool Lexicographic::settle_held(double rho, double epsilon) {
  double largest = 0.0;
  const double scale = epsilon * epsilon;
  for (const ActiveSlot& slot : active_set_.slots()) {
    largest = std::max(largest, scale * slot.multiplier);
  }
  const double least = problem_.least_settling(largest, above_scale_);
  found_.clear();
  for (const ActiveSlot& slot : active_set_.slots()) {
    const bool settles = scale * slot.multiplier > least || problem_.has_slack(rows_[slot.row]);
    found_.push_back({0, slot.row, slot.side, settles ? Role::Violation : Role::SmallestStep});
  }
  ++solution_.factorizations;
  active_set_.clear();
  settled_level_.start(rows_, *chain_, problem_, candidates_, x_above_, active_set_.x(),
                       above_scale_);
  for (const KeptRow& row : found_) settled_level_.hold(row.row, row.side, row.role);
  return settled_level_.solve(rho, budget_, x_, held_, begin_norm_);
}

bool Lexicographic::find_cold() {
  // it ends where steps of length zero might repeat a set
  return active_set_.primal(budget_, static_cast<int>(3 * (unknowns_ + rows_.size())));
}

void Lexicographic::take_refined() {
  active_set_.refine();
  take(active_set_.x());
  values_known_ = true;
}

void Lexicographic::keep_held(double scale) {
  for (const ActiveSlot& slot : active_set_.slots()) {
    held_.push_back({slot.row, slot.side, scale * slot.multiplier, Role::Violation});
  }
}

}  // namespace hurcules
