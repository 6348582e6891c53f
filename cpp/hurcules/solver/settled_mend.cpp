// What is wrong with the held rows of a settled level, and its mending, one row at a time.
#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/settled_level.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

constexpr double kAbsent = std::numeric_limits<double>::infinity();

double sign(Side side) {
  return static_cast<double>(side);
}

}  // namespace

// A limit that is held, depends on the others and is broken where they are met. Rows that were held
// in another problem may do that, and mending such a set takes longer than a cold start.
bool SettledLevel::contradictory() const {
  for (Index i = 0; i < end_[kLimits]; ++i) {
    if (beyond(all_[i]) > allowed(all_[i].row)) return true;
  }
  return false;
}

// a limit of the last group that the rows before it leave broken, or inside
bool SettledLevel::mend_unmet() {
  for (Index i = 0; i < static_cast<Index>(group_[kSmallest].size()); ++i) {
    const Held held = group_[kSmallest][i];
    const double miss = beyond(held);
    if (std::abs(miss) <= allowed(held.row)) continue;
    let_go(kSmallest, i);
    // it does push against the level, then
    if (miss > 0.0) {
      const bool own = (*rows_)[held.row].level == level_->level();
      hold(own ? kOwn : kLimits, held.row, held.side, true);
    }
    return true;
  }
  return false;
}

// from x towards the target, until a limit is in the way: it is held then
bool SettledLevel::advance(Budget& budget) {
  const Index count = rows_->candidates(level_->level() + 1);
  double *value = candidates_->value.data(), *target = candidates_->target.data();
  const kernels::LimitArrays limits = candidates_->limits(*rows_);
  const double relative = tolerance::kBroken * size_;
  const bool inside = kernels::chosen->worst_excess(count, target, limits, relative, 0.0) <= 0.0;
  if (!inside && hold_violated()) return true;
  const kernels::Blocking blocking =
      inside ? kernels::Blocking()
             : kernels::chosen->first_blocking(count, value, target, limits, relative, 0.0);
  const double way = blocking.candidate < 0 ? 1.0 : blocking.way;
  kernels::chosen->advance(rows_->stride(), way, target_.data(), x_.data());
  if (blocking.candidate < 0) {
    std::copy_n(target, count, value);
    return false;
  }
  kernels::chosen->advance(count, way, target, value);
  const int i = rows_->row_of_candidate(blocking.candidate);
  const Row& row = (*rows_)[i];
  const bool up = target[blocking.candidate] > candidates_->upper(blocking.candidate);
  if (level_->lost(row)) {
    // nothing here can move it: rounding
    ignored_.push_back({i, Side::Upper, 0.0, candidates_->lower(row.candidate),
                        candidates_->upper(row.candidate), 0.0, false});
    candidates_->set(row.candidate, -kAbsent, kAbsent);
    return true;
  }
  hold(row.level == level_->level() ? kOwn : kLimits, i, up ? Side::Upper : Side::Lower, false);
  ++budget.used;
  return true;
}

// an own row that is met only holds the step; one that is inside its limits does nothing
bool SettledLevel::mend_own() {
  for (Index i = 0; i < static_cast<Index>(group_[kOwn].size()); ++i) {
    const Held held = group_[kOwn][i];
    if ((*rows_)[held.row].equality) continue;
    const double miss = beyond(held), room = allowed(held.row);
    if (miss > room || (held.pinned && miss >= -room)) continue;
    let_go(kOwn, i);
    if (miss >= -room) hold(kSmallest, held.row, held.side, false);
    return true;
  }
  return false;
}

// limits that hardly push settle nothing, they can only hold the step: they go to the last group
bool SettledLevel::mend_weak() {
  double largest = 0.0;
  for (const Held& held : all_) largest = std::max(largest, std::abs(held.multiplier));
  const double least = level_->least_settling(largest, size_);
  bool moved = false;
  for (Index i = end_[kLimits] - 1; i >= 0; --i) {
    const Held held = group_[kLimits][i];
    if (held.pinned || std::abs(all_[i].multiplier) >= least) continue;
    let_go(kLimits, i);
    hold(kSmallest, held.row, held.side, false);
    moved = true;
  }
  return moved;
}

// lets the limit go that pulls most: against the violations first, then against the step
bool SettledLevel::drop_negative(Budget& budget) {
  for (const Group group : {kLimits, kSmallest}) {
    double largest = 0.0;
    for (Index i = begin(group); i < end_[group]; ++i) {
      largest = std::max(largest, std::abs(all_[i].multiplier));
    }
    double worst = -tolerance::kNegative * largest;
    Index found = -1;
    for (Index i = begin(group); i < end_[group]; ++i) {
      const double push = sign(all_[i].side) * all_[i].multiplier;
      if (push >= worst) continue;
      worst = push;
      found = i - begin(group);
    }
    if (found < 0) continue;
    let_go(group, found);
    ++budget.used;
    return true;
  }
  return false;
}

}  // namespace hurcules
