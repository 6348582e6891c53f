#include "hurcules/solver/settled_level.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

namespace {

constexpr double kAbsent = std::numeric_limits<double>::infinity();
// a set of the last solve that is wrong in more places takes longer to mend than a cold start
constexpr Index kMostMended = 8;

double sign(Side side) {
  return static_cast<double>(side);
}

}  // namespace

void SettledLevel::reserve(Index unknowns, Index rows) {
  factor_.reserve(rows, unknowns);
  for (auto& group : group_) group.reserve(rows);
  all_.reserve(rows);
  ignored_.reserve(rows);
  if (block_.rows() < rows + 2 * unknowns || block_.cols() < unknowns + 1) {
    block_.resize(rows + 2 * unknowns, unknowns + 1);
  }
  norm2_.reserve(rows);
  for (PaddedVector* v : {&y_, &t_, &force_, &push_, &x_, &target_}) {
    v->reserve(padded(unknowns) + 4);
  }
}

void SettledLevel::start(const RowTable& rows, const Chain& chain, const LevelProblem& level,
                         Candidates& candidates, const double* x_above, const double* x,
                         double x_scale) {
  rows_ = &rows;
  chain_ = &chain;
  level_ = &level;
  candidates_ = &candidates;
  x_above_ = x_above;
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
double SettledLevel::worst_above(double x_scale) const {
  double worst = 0.0;
  const int level = level_->level();
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

void SettledLevel::hold(Group group, int row, Side side, bool pinned) {
  const Index c = (*rows_)[row].candidate;
  const double lower = candidates_->lower(c), upper = candidates_->upper(c);
  const double limit = side == Side::Upper ? upper : lower;
  if (std::isinf(limit)) return;  // no limit there, or held already
  group_[group].push_back({row, side, limit, lower, upper, 0.0, pinned});
  candidates_->set(c, -kAbsent, kAbsent);
}

void SettledLevel::hold(int row, Side side, Role role) {
  if (role == Role::Idle) return;
  const bool own = (*rows_)[row].level == level_->level();
  hold(role == Role::SmallestStep ? kSmallest : (own ? kOwn : kLimits), row, side, false);
}

void SettledLevel::let_go(Group group, Index i) {
  const Held& held = group_[group][i];
  candidates_->set((*rows_)[held.row].candidate, held.lower, held.upper);
  group_[group].erase(group_[group].begin() + i);
}

void SettledLevel::release() {
  for (const auto* rows : {&group_[kLimits], &group_[kOwn], &group_[kSmallest], &ignored_}) {
    for (const Held& held : *rows) {
      const Row& row = (*rows_)[held.row];
      if (!row.equality) candidates_->set(row.candidate, held.lower, held.upper);
    }
  }
}

double SettledLevel::allowed(int row) const {
  return tolerance::kBroken * size_ * (*rows_)[row].norm;
}

double SettledLevel::beyond(const Held& held) const {
  return sign(held.side) * (candidates_->target[(*rows_)[held.row].candidate] - held.limit);
}

// holds own rows that are violated at x; true when there were any
bool SettledLevel::hold_violated() {
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

void SettledLevel::answer(double rho) {
  gather();
  factor();
  meet(kLimits);
  least_squares(rho);
  meet(kSmallest);
  step();
  rows_->values(level_->level() + 1, target_.data(), candidates_->target.data());
}

void SettledLevel::keep(double rho, std::vector<HeldRow>& held, int& begin_norm) const {
  const auto is_limit = [&](const Held& row) { return !(*rows_)[row.row].equality; };
  for (Index i = 0; i < end_[kLimits]; ++i) {
    const Held& row = all_[i];
    held.push_back({row.row, row.side, sign(row.side) * row.multiplier, Role::Violation});
  }
  for (Index i = begin(kSmallest); rho > 0.0 && i < end_[kSmallest]; ++i) {
    const Held& row = all_[i];
    const double push = rho * rho * sign(row.side) * row.multiplier;
    held.push_back({row.row, row.side, push, Role::SmallestStep});
  }
  for (Index i = begin(kOwn); i < end_[kOwn]; ++i) {
    const Held& row = all_[i];
    if (!is_limit(row)) continue;
    held.push_back({row.row, row.side, std::max(0.0, beyond(row)), Role::Violation});
  }
  begin_norm = static_cast<int>(held.size());
  // the step against the rows that keep it from being smaller; what is settled may push either way
  for (Index j = factor_.rank() - 1; j >= 0; --j) {
    const Held& row = all_[factor_.pivot(j)];
    if (!is_limit(row)) continue;
    held.push_back({row.row, row.side, sign(row.side) * push_[j],
                    j >= rank_[kOwn] && rho == 0.0 ? Role::SmallestStep : Role::Idle});
  }
}

bool SettledLevel::solve(double rho, Budget& budget, double* x, std::vector<HeldRow>& held,
                         int& begin_norm) {
  bool found = false;
  // every round changes the held rows; a set met twice is rounding, and ends here, too
  const Index most = remembered_ ? kMostMended : 4 * (level_->free() + 8);
  for (Index round = 0; round < most && !budget.spent(); ++round) {
    answer(rho);
    size_ = std::max(x_scale_, kernels::chosen->largest(rows_->stride(), target_.data()));
    if (!std::isfinite(size_) || (remembered_ && contradictory())) break;
    if (mend_unmet() || advance(budget) || mend_own()) continue;
    balance_violation(rho);
    if (mend_weak()) continue;
    balance_step();
    if (drop_negative(budget)) continue;
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
