// The two ways to the right working set: primal from a feasible point, dual from any set.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/least_distance.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// a row that moves by less than this part of |m| |p| does not move, nor does a point by less than
// this part of |z|
constexpr double kStill = 1e-14;
// `ignored`: for the whole level, or until the next row is dropped
constexpr char kIgnoredForNow = 2;

}  // namespace

// the row that stops a move of `direction_` from `from_` first; ties go to the fastest
int LeastDistance::first_blocking(double& step, Side& side) const {
  const double* p = direction_.data();
  const double length = std::sqrt(kernels::dot(dimension_, p, p));
  int blocking = -1;
  if (length <= kStill * std::sqrt(kernels::dot(dimension_, z.data(), z.data()))) return blocking;
  double fastest = 0.0;
  for (int c = 0; c < candidates_; ++c) {
    if (held_[c] || ignored[c]) continue;
    const double speed = kernels::dot(dimension_, row(c), p);
    const double norm = std::sqrt(kernels::dot(dimension_, row(c), row(c)));
    if (std::abs(speed) <= kStill * norm * length) continue;
    const double room =
        (speed > 0.0 ? upper[c] : lower[c]) - kernels::dot(dimension_, row(c), from_.data());
    if (std::isinf(room)) continue;
    const double way = std::max(0.0, room / speed);
    const double relative = std::abs(speed) / norm;
    if (way > step || (way == step && (blocking < 0 || relative <= fastest))) continue;
    step = way;
    fastest = relative;
    side = speed > 0.0 ? Side::Upper : Side::Lower;
    blocking = c;
  }
  return blocking;
}

bool LeastDistance::solve_primal(int& changes, int changes_left) {
  while (changes_left-- > 0) {
    // where the working set wants to go, and how far it can
    from_.head(dimension_) = z.head(dimension_);
    solve_on_active();
    direction_.head(dimension_) = z.head(dimension_) - from_.head(dimension_);
    double step = 1.0;
    Side side = Side::Upper;
    const int blocking = first_blocking(step, side);
    if (blocking >= 0 && step < 1.0) {
      z.head(dimension_) = from_.head(dimension_) + step * direction_.head(dimension_);
      ++changes;
      // a row that depends on the set cannot stop a move inside it: rounding
      if (!add(blocking, side)) ignored[blocking] = kIgnoredForNow;
      continue;
    }
    const int slot = most_negative();
    if (slot < 0) return true;
    drop(slot);
    std::replace(ignored.begin(), ignored.begin() + candidates_, kIgnoredForNow, '\0');
    ++changes;
  }
  return false;
}

void LeastDistance::drop_negative(int& changes) {
  solve_on_active();
  for (int slot = most_negative(); slot >= 0; slot = most_negative()) {
    drop(slot);
    ++changes;
    solve_on_active();
  }
}

// Raises the multiplier of a broken row until it holds, dropping the rows whose multipliers vanish
// on the way.
bool LeastDistance::raise(int candidate, Side side, int& changes, int changes_left) {
  const double sign = static_cast<double>(side);
  double raised = 0.0;
  while (changes_left-- > 0) {
    const double left = explain(candidate, side, r_);
    const double norm2 = kernels::dot(dimension_, row(candidate), row(candidate));
    const bool dependent = left <= tolerance::kDependent * tolerance::kDependent * norm2;
    // the step at which the row holds, and the first at which a multiplier vanishes
    const double broken = sign * (value(candidate) - limit(candidate, side));
    const double full = dependent ? kNever : std::max(0.0, broken) / left;
    double partial = kNever;
    Index vanishing = -1;
    for (Index i = 0; i < static_cast<Index>(active_.size()); ++i) {
      if (active_[i].fixed || r_[i] <= 0.0) continue;
      const double way = std::max(0.0, active_[i].multiplier) / r_[i];
      if (way < partial) {
        partial = way;
        vanishing = i;
      }
    }
    const double step = std::min(full, partial);
    if (step == kNever) {  // dependent and nothing to swap it for: rounding
      ignored[candidate] = 1;
      return true;
    }
    for (std::size_t i = 0; i < active_.size(); ++i) active_[i].multiplier -= step * r_[i];
    raised += step;
    if (!dependent) z.head(dimension_) -= step * direction_.head(dimension_);
    ++changes;
    if (full <= partial) {
      if (!add(candidate, side)) ignored[candidate] = 1;
      solve_on_active();
      return true;
    }
    drop(vanishing);
  }
  return false;
}

bool LeastDistance::solve_dual(int& changes, int changes_left, bool& raised) {
  const int before = changes;
  drop_negative(changes);
  double slack = 1.0;
  int next_raise = static_cast<int>(2 * dimension_) + 30;
  while (changes - before < changes_left) {
    // the ladder: a tolerance that grows tenfold, so that rounding cannot keep two rows swapping
    // for ever
    if (changes - before > next_raise) {
      slack *= 10.0;
      next_raise += static_cast<int>(dimension_) / 2 + 1;
      raised = true;
    }
    Side side = Side::Upper;
    const int candidate = most_broken(side, slack);
    if (candidate < 0) return true;
    if (!raise(candidate, side, changes, changes_left)) return false;
    // rounding may leave a multiplier below zero after a swap
    if (most_negative() >= 0) drop_negative(changes);
  }
  return false;
}

}  // namespace hurcules
