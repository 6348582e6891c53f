// The ways to the answer of one level that has limits in its way.
#include <algorithm>
#include <cmath>

#include "hurcules/solver/lexicographic.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

// proximal steps of a level with rho = 0; one to four are usual
constexpr int kMaxProximalSteps = 40;

}  // namespace

bool Lexicographic::solve(Way way, double rho, int k) {
  chain_.complete(rows_);
  return rho >= tolerance::kSmall * problem_.own_norm() ? solve_regularized(way, rho, k)
                                                        : solve_settled(way, rho, k);
}

bool Lexicographic::solve_regularized(Way way, double rho, int k) {
  active_set_.start(rows_, problem_, candidates_, rho, x_above_, x_scale_);
  const bool done = way == Way::Warm ? find_warm(k) : find_cold();
  if (!done) {
    take(way == Way::Warm ? x_above_ : active_set_.x_feasible());
    return false;
  }
  if (way == Way::Careful) return settle_held(rho, rho);
  take_refined();
  keep_held(rho * rho, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return true;
}

bool Lexicographic::solve_settled(Way way, double rho, int k) {
  if (way == Way::Warm) return settle_kept(rho, k);
  if (problem_.own_norm() == 0.0) {
    take(x_above_);
    return true;
  }
  if (way == Way::Careful) return solve_carefully(rho, k);
  const double epsilon = std::max(rho, tolerance::kProximal * problem_.own_norm());
  active_set_.start(rows_, problem_, candidates_, epsilon, x_above_, x_scale_);
  if (find_cold()) return settle_held(rho, epsilon);
  take(active_set_.x_feasible());
  return false;
}

bool Lexicographic::solve_carefully(double rho, int k) {
  const bool tiny = rho < tolerance::kTiny * problem_.own_norm();
  const double epsilon = tiny ? tolerance::kProximal * problem_.own_norm() : rho;
  active_set_.start(rows_, problem_, candidates_, epsilon, x_above_, x_scale_);
  if (!find_cold()) {
    take(active_set_.x_feasible());
    return false;
  }
  take_refined();
  if (tiny && !proximal_steps(epsilon)) return false;
  keep_held(epsilon * epsilon, Role::Violation);
  begin_norm_ = static_cast<int>(held_.size());
  return !tiny || smallest_step(k);
}

bool Lexicographic::settle_kept(double rho, int k) {
  settled_level_.start(rows_, chain_, problem_, candidates_, x_above_, x_above_, x_scale_);
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
  const double least = problem_.least_settling(largest, x_scale_);
  found_.clear();
  for (const ActiveSlot& slot : active_set_.slots()) {
    const bool settles = scale * slot.multiplier > least || problem_.has_slack(rows_[slot.row]);
    found_.push_back({0, slot.row, slot.side, settles ? Role::Violation : Role::SmallestStep});
  }
  ++solution_.factorizations;
  active_set_.clear();
  settled_level_.start(rows_, chain_, problem_, candidates_, x_above_, active_set_.x(), x_scale_);
  for (const KeptRow& row : found_) settled_level_.hold(row.row, row.side, row.role);
  return settled_level_.solve(rho, budget_, x_, held_, begin_norm_);
}

bool Lexicographic::proximal_steps(double epsilon) {
  double last = 0.0;
  std::copy_n(x_above_, rows_.stride(), centre_.data());
  for (int pass = 0; pass < kMaxProximalSteps; ++pass) {
    double moved = 0.0;
    for (Index j = 0; j < unknowns_; ++j) moved = std::max(moved, std::abs(x_[j] - centre_[j]));
    const double scale = std::max(1.0, kernels::chosen->largest(rows_.stride(), x_));
    std::copy_n(x_, rows_.stride(), centre_.data());
    if (!std::isfinite(moved)) return true;  // the proof will say so
    if (moved < 1e-11 * scale || (pass > 0 && moved < 1e-8 * scale && moved > 0.5 * last)) break;
    last = moved;
    // the next pass starts from this one's set
    active_set_.restart(epsilon, centre_.data());
    if (!active_set_.warm() && !find_by_dual()) {
      take(centre_.data());
      return false;
    }
    take_refined();
  }
  return true;
}

bool Lexicographic::smallest_step(int k) {
  double largest = 0.0;
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    largest = std::max(largest, std::abs(held_[h].multiplier));
  }
  const double least = problem_.least_settling(largest, x_scale_);
  active_set_.clear();
  problem_.start_smallest(rows_, chain_, k);
  if (problem_.dimension() == 0) return true;
  active_set_.start_smallest(rows_, problem_, candidates_, x_, x_above_, x_scale_);
  for (std::size_t h = begin_held_; h < held_.size(); ++h) {
    HeldRow& held = held_[h];
    if (held.multiplier > least) {
      active_set_.fix(held.row, held.side);
    } else {
      held.role = Role::Idle;
    }
  }
  ++solution_.factorizations;
  const bool done = active_set_.primal(budget_, budget_.left());
  if (done) {
    take_refined();
  } else {
    take(active_set_.x_feasible());
    values_known_ = false;
  }
  keep_held(1.0, Role::SmallestStep);
  return done;
}

bool Lexicographic::find_by_dual() {
  return active_set_.dual(budget_, raised_);
}

bool Lexicographic::find_warm(int k) {
  for (int h = kept_begin_[k]; h < kept_begin_[k + 1]; ++h) {
    active_set_.plan(kept_[h].row, kept_[h].side);
  }
  return active_set_.warm() || find_by_dual();
}

bool Lexicographic::find_cold() {
  // from the centre, which is feasible and monotone; it hands over where zero steps might cycle
  const int most = static_cast<int>(3 * (unknowns_ + rows_.size()));
  return active_set_.primal(budget_, most) || (!budget_.spent() && find_by_dual());
}

void Lexicographic::take_refined() {
  active_set_.refine();
  take(active_set_.x());
  values_known_ = true;
}

void Lexicographic::keep_held(double scale, Role unfixed) {
  for (const ActiveSlot& slot : active_set_.slots()) {
    held_.push_back(
        {slot.row, slot.side, scale * slot.multiplier, slot.fixed ? Role::Idle : unfixed});
  }
}

}  // namespace hurcules
