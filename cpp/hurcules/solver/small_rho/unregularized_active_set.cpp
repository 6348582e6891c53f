#include "hurcules/solver/small_rho/unregularized_active_set.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/problem/tolerances.hpp"

namespace hurcules {

namespace {

// a set of the last solve that is wrong in more places takes longer to mend than a cold start
constexpr Index kMostMended = 8;

}  // namespace

void UnregularizedActiveSet::reserve(Index unknowns, Index rows) {
  step_.reserve(unknowns, rows);
  for (auto& group : group_) group.reserve(rows);
  ignored_.reserve(rows);
  for (PaddedVector* v : {&x_, &target_}) v->reserve(padded(unknowns) + 4);
}

void UnregularizedActiveSet::start(const RowTable& rows, const NullspaceBasis& nullspace,
                                   LevelProblem& level, Candidates& candidates,
                                   const double* x_above, const double* x, double x_scale) {
  rows_ = &rows;
  level_ = &level;
  candidates_ = &candidates;
  x_above_ = x_above;
  step_.start(rows, nullspace, level, x_above, by_rows_);
  x_scale_ = x_scale;
  remembered_ = x == x_above;
  size_ = x_scale;
  std::copy_n(x, rows.stride(), x_.data());
  rows.values(level.level() + 1, x, candidates.value.data());
  if (worst_above(x_scale) > 0.0) {
    std::copy_n(x_above, rows.stride(), x_.data());
    rows.values(level.level() + 1, x_above, candidates.value.data());
  }
  for (auto& group : group_) group.clear();
  ignored_.clear();
  for (int d = rows.equalities(level.level()); d < rows.equalities(level.level() + 1); ++d) {
    const int i = rows.row_of_dense(d);
    group_[kOwn].push_back({i, Side::Upper, rows[i].upper, 0.0, 0.0, 0.0, false});
  }
}

// by how much `value` breaks rows above, beyond what rounding does
double UnregularizedActiveSet::worst_above(double x_scale) const {
  const int level = level_->level();
  if (!level_->has_slacks()) {
    return kernels::chosen->worst_excess(rows_->candidates(level + 1), candidates_->value.data(),
                                         candidates_->limits(*rows_), tolerance::kBroken * x_scale,
                                         0.0);
  }
  double worst = 0.0;
  for (int i = 0; i < rows_->begin(level); ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality) continue;
    const double value = candidates_->value[row.candidate];
    const double excess = std::max(value - candidates_->upper(row.candidate),
                                   candidates_->lower(row.candidate) - value);
    worst = std::max(worst, excess - tolerance::kBroken * x_scale * row.norm);
  }
  return worst;
}

void UnregularizedActiveSet::hold(RowGroup group, int row, Side side, bool pinned) {
  const Index c = (*rows_)[row].candidate;
  const double lower = candidates_->lower(c), upper = candidates_->upper(c);
  const double limit = side == Side::Upper ? upper : lower;
  if (std::isinf(limit)) return;  // no limit there, or held already
  group_[group].push_back({row, side, limit, lower, upper, 0.0, pinned});
  candidates_->set(c, -kAbsent, kAbsent);
}

void UnregularizedActiveSet::hold(int row, Side side, Role role) {
  if (role == Role::Idle) return;
  const bool own = (*rows_)[row].level == level_->level();
  hold(role == Role::SmallestStep ? kSmallest : (own ? kOwn : kLimits), row, side, false);
}

void UnregularizedActiveSet::let_go(RowGroup group, Index i) {
  const GroupedRow& held = group_[group][i];
  candidates_->set((*rows_)[held.row].candidate, held.lower, held.upper);
  group_[group].erase(group_[group].begin() + i);
}

void UnregularizedActiveSet::release() {
  for (const auto* rows : {&group_[kLimits], &group_[kOwn], &group_[kSmallest], &ignored_}) {
    for (const GroupedRow& held : *rows) {
      const Row& row = (*rows_)[held.row];
      if (!row.equality) candidates_->set(row.candidate, held.lower, held.upper);
    }
  }
}

double UnregularizedActiveSet::allowed(int row) const {
  return tolerance::kBroken * size_ * (*rows_)[row].norm;
}

double UnregularizedActiveSet::beyond(const GroupedRow& held) const {
  return held.sign() * (candidates_->target[(*rows_)[held.row].candidate] - held.limit);
}

// holds own rows that are violated at x; true when there were any
bool UnregularizedActiveSet::hold_violated() {
  const int level = level_->level();
  const std::size_t before = group_[kOwn].size();
  if (!level_->has_slacks()) return false;
  for (int i = rows_->begin(level); i < rows_->begin(level + 1); ++i) {
    const Row& row = (*rows_)[i];
    if (row.equality) continue;
    const double value = candidates_->value[row.candidate];
    if (value > candidates_->upper(row.candidate) + allowed(i)) hold(kOwn, i, Side::Upper, false);
    if (value < candidates_->lower(row.candidate) - allowed(i)) hold(kOwn, i, Side::Lower, false);
  }
  return group_[kOwn].size() > before;
}

void UnregularizedActiveSet::answer(double rho) {
  step_.solve(group_, rho, target_.data());
  rows_->values(level_->level() + 1, target_.data(), candidates_->target.data());
}

// A limit that is held, depends on the others and is broken where they are met. Rows that were held
// in another problem may do that, and mending such a set takes longer than a cold start.
bool UnregularizedActiveSet::contradictory() const {
  for (Index i = 0; i < step_.end(kLimits); ++i) {
    if (beyond(step_.rows()[i]) > allowed(step_.rows()[i].row)) return true;
  }
  return false;
}

// limits of the last group that the rows before it leave broken, or inside
bool UnregularizedActiveSet::mend_unmet() {
  bool moved = false;
  for (Index i = static_cast<Index>(group_[kSmallest].size()) - 1; i >= 0; --i) {
    const GroupedRow held = group_[kSmallest][i];
    const double miss = beyond(held);
    if (std::abs(miss) <= allowed(held.row)) continue;
    moved = true;
    let_go(kSmallest, i);
    if (miss <= 0.0) continue;
    // it does push against the level, then
    const bool own = (*rows_)[held.row].level == level_->level();
    hold(own ? kOwn : kLimits, held.row, held.side, true);
  }
  return moved;
}

// from x towards the target, until a limit is in the way: it is held then
bool UnregularizedActiveSet::advance(Budget& budget) {
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
bool UnregularizedActiveSet::mend_own() {
  for (Index i = 0; i < static_cast<Index>(group_[kOwn].size()); ++i) {
    const GroupedRow held = group_[kOwn][i];
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
bool UnregularizedActiveSet::mend_weak() {
  double largest = 0.0;
  for (const GroupedRow& held : step_.rows())
    largest = std::max(largest, std::abs(held.multiplier));
  const double least = level_->least_settling(largest, size_);
  bool moved = false;
  for (Index i = step_.end(kLimits) - 1; i >= 0; --i) {
    const GroupedRow held = group_[kLimits][i];
    if (held.pinned || std::abs(step_.rows()[i].multiplier) >= least) continue;
    let_go(kLimits, i);
    hold(kSmallest, held.row, held.side, false);
    moved = true;
  }
  return moved;
}

// Then what they push against the step is not one set of numbers but many.
bool UnregularizedActiveSet::crowded() const {
  const std::size_t held = group_[kLimits].size() + group_[kSmallest].size();
  return static_cast<Index>(held) > level_->free() - level_->own();
}

// lets the limit go that pulls most: against the violations first, then against the step
bool UnregularizedActiveSet::drop_negative(Budget& budget, bool fixed) {
  for (const RowGroup group : {kLimits, kSmallest}) {
    if (group == kSmallest && fixed) continue;
    double largest = 0.0;
    for (Index i = step_.begin(group); i < step_.end(group); ++i) {
      largest = std::max(largest, std::abs(step_.rows()[i].multiplier));
    }
    double worst = -tolerance::kNegative * largest;
    Index found = -1;
    for (Index i = step_.begin(group); i < step_.end(group); ++i) {
      const double push = step_.rows()[i].sign() * step_.rows()[i].multiplier;
      if (push >= worst) continue;
      worst = push;
      found = i - step_.begin(group);
    }
    if (found < 0) continue;
    let_go(group, found);
    ++budget.used;
    return true;
  }
  return false;
}

void UnregularizedActiveSet::keep(double rho, std::vector<HeldRow>& held, int& begin_norm) const {
  const auto is_limit = [&](const GroupedRow& row) { return !(*rows_)[row.row].equality; };
  const std::vector<GroupedRow>& rows = step_.rows();
  for (Index i = 0; i < step_.end(kLimits); ++i) {
    held.push_back(
        {rows[i].row, rows[i].side, rows[i].sign() * rows[i].multiplier, Role::Violation});
  }
  for (Index i = step_.begin(kSmallest); rho > 0.0 && i < step_.end(kSmallest); ++i) {
    const double push = rho * rho * rows[i].sign() * rows[i].multiplier;
    held.push_back({rows[i].row, rows[i].side, push, Role::SmallestStep});
  }
  for (Index i = step_.begin(kOwn); i < step_.end(kOwn); ++i) {
    if (!is_limit(rows[i])) continue;
    held.push_back({rows[i].row, rows[i].side, std::max(0.0, beyond(rows[i])), Role::Violation});
  }
  begin_norm = static_cast<int>(held.size());
  // the step against the rows that keep it from being smaller; what is settled may push either way
  for (Index j = step_.directions() - 1; j >= 0; --j) {
    const GroupedRow& row = step_.row_of(j);
    if (!is_limit(row)) continue;
    held.push_back({row.row, row.side, row.sign() * step_.push(j),
                    step_.is_smallest(j) && rho == 0.0 ? Role::SmallestStep : Role::Idle});
  }
}

bool UnregularizedActiveSet::solve(double rho, Budget& budget, double* x,
                                   std::vector<HeldRow>& held, int& begin_norm) {
  bool found = false;
  // every round changes the held rows; a set met twice is rounding, and ends here, too
  const Index most = remembered_ ? kMostMended : 4 * (level_->free() + 8);
  for (Index round = 0; round < most && !budget.spent(); ++round) {
    answer(rho);
    size_ = std::max(x_scale_, kernels::chosen->largest(rows_->stride(), target_.data()));
    if (!std::isfinite(size_) || (remembered_ && contradictory())) break;
    if (mend_unmet() || advance(budget) || mend_own()) continue;
    step_.balance_violation(rho, target_.data(), candidates_->target.data());
    // where more rows of the last solve hold than there are directions they fix the step, whatever
    // they push: which of them settle the violation is known, and the proof finds the rest
    const bool fixed = remembered_ && round == 0 && crowded();
    if (!fixed && mend_weak()) continue;
    step_.balance_step();
    if (drop_negative(budget, fixed)) continue;
    found = true;
    break;
  }
  // interrupted, it is the best point so far
  std::copy_n(found ? target_.data() : x_.data(), rows_->stride(), x);
  if (found) keep(rho, held, begin_norm);
  release();
  return found;
}

}  // namespace hurcules
