#include "hurcules/solver/settled_level.hpp"

#include <algorithm>
#include <cmath>

#include "hurcules/solver/kernels.hpp"
#include "hurcules/solver/tolerances.hpp"

namespace hurcules {

void SettledLevel::reserve(Index unknowns, Index rows) {
  table_.reserve(2 * rows, kGroups);
  chain_.reserve(unknowns, 2 * rows + 1, kGroups);
  problem_.reserve(unknowns, 2 * rows);
  original_.reserve(2 * rows);
  side_.reserve(2 * rows);
  force_.resize(unknowns);
  if (multiplier_.size() < 2 * rows) multiplier_.resize(2 * rows);
}

void SettledLevel::hold(const RowTable& rows, int i, Side side, double limit) {
  Row row = rows[i];
  row.equality = true;
  row.lower = row.upper = limit;
  table_.add(row);
  original_.push_back(i);
  side_.push_back(side);
}

void SettledLevel::collect(const RowTable& rows, const LevelProblem& level, int k,
                           const std::vector<KeptRow>& kept) {
  table_.clear();
  original_.clear();
  side_.clear();
  const auto limit = [&](int i, Side side) {
    return side == Side::Upper ? level.upper(i) : level.lower(i);
  };
  const auto hold_kept = [&](bool own, Role role) {
    for (const KeptRow& row : kept) {
      if (row.held_by != k || row.role != role) continue;
      if (role == Role::Violation && level.own(row.row) != own) continue;
      hold(rows, row.row, row.side, limit(row.row, row.side));
    }
  };
  for (int i = 0; i < rows.begin(k); ++i) {
    if (rows[i].equality) hold(rows, i, Side::Upper, rows[i].upper);
  }
  table_.end_level();
  hold_kept(false, Role::Violation);
  table_.end_level();
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
    if (rows[i].equality) hold(rows, i, Side::Upper, rows[i].upper);
  }
  hold_kept(true, Role::Violation);
  table_.end_level();
  hold_kept(false, Role::SmallestStep);
  table_.end_level();
}

void SettledLevel::balance(Group group) {
  // L' mu = -Q force, from the last direction back to the first of the group
  const Index first = chain_.rank_before(group), end = chain_.rank_before(kGroups);
  multiplier_.setZero();
  for (Index j = end - 1; j >= first; --j) {
    double sum = -kernels::dot(force_.size(), chain_.direction(j), force_.data());
    for (Index l = j + 1; l < end; ++l) {
      sum -= chain_.coordinates(chain_.pivot_row(l))[j] * multiplier_[chain_.pivot_row(l)];
    }
    multiplier_[chain_.pivot_row(j)] = sum / chain_.coordinates(chain_.pivot_row(j))[j];
  }
}

bool SettledLevel::holds(const RowTable& rows, const LevelProblem& level, int k,
                         const Vector& x) const {
  const double scale = std::max(1.0, x.lpNorm<Eigen::Infinity>());
  const auto allowed = [&](int i) { return tolerance::kBroken * scale * rows[i].norm; };
  // held rows stand at their limits, violated rows beyond them
  for (int r = table_.begin(kLimits); r < table_.size(); ++r) {
    const int i = original_[r];
    const double beyond = rows.dot(i, x) - table_[r].upper;
    if (rows[i].equality) continue;
    const bool own = r >= table_.begin(kOwn) && r < table_.begin(kSmallest);
    if (own ? static_cast<double>(side_[r]) * beyond <= allowed(i)
            : std::abs(beyond) > allowed(i)) {
      return false;
    }
  }
  // all others are within theirs
  for (int i = 0; i < rows.begin(k + 1); ++i) {
    if (rows[i].equality) continue;
    const double value = rows.dot(i, x);
    if (value <= level.upper(i) + allowed(i) && value >= level.lower(i) - allowed(i)) continue;
    bool violated = false;
    for (int r = table_.begin(kOwn); r < table_.begin(kSmallest); ++r)
      violated |= original_[r] == i;
    if (!violated) return false;
  }
  return true;
}

bool SettledLevel::keep(const RowTable& rows, const LevelProblem& level, const Vector& x,
                        Group group, std::vector<HeldRow>& held) const {
  double largest = 0.0;
  for (int r = table_.begin(group); r < table_.begin(group + 1); ++r) {
    largest = std::max(largest, std::abs(multiplier_[r]));
  }
  for (int r = table_.begin(group); r < table_.begin(group + 1); ++r) {
    const double push = static_cast<double>(side_[r]) * multiplier_[r];
    // a limit that hardly pushes may not settle anything: the long way decides
    const double least =
        group == kLimits ? level.least_settling(largest) : -tolerance::kNegative * largest;
    if (push < least) return false;
    held.push_back(
        {original_[r], side_[r], push, group == kLimits ? Role::Violation : Role::SmallestStep});
  }
  if (group != kLimits) return true;
  for (int r = table_.begin(kOwn); r < table_.begin(kSmallest); ++r) {
    const int i = original_[r];
    if (!rows[i].equality)
      held.push_back({i, side_[r], std::abs(rows.violation(i, rows.dot(i, x)))});
  }
  return true;
}

bool SettledLevel::solve(const RowTable& rows, const LevelProblem& level, int k,
                         const Vector& x_above, const std::vector<KeptRow>& kept, Vector& x,
                         std::vector<HeldRow>& held, int& begin_norm) {
  collect(rows, level, k, kept);
  chain_.build(table_);
  x = x_above;
  for (int group = kLimits; group < kGroups; ++group) {
    problem_.start(table_, chain_, group, x);
    problem_.solve_free(table_, chain_, 0.0, x, x);
  }
  if (!x.allFinite() || !holds(rows, level, k, x)) return false;
  const std::size_t begin = held.size();
  // the violations of the level against the held limits
  force_.setZero();
  for (int i = rows.begin(k); i < rows.begin(k + 1); ++i) {
    rows.add_to(i, rows.violation(i, rows.dot(i, x)), force_);
  }
  balance(kLimits);
  bool proven = keep(rows, level, x, kLimits, held);
  begin_norm = static_cast<int>(held.size());
  // the step against the rows that keep it from being smaller; what is settled may push either way
  force_ = x - x_above;
  balance(kLimits);
  proven = proven && keep(rows, level, x, kSmallest, held);
  if (!proven) {
    held.resize(begin);
    return false;
  }
  for (int r = table_.begin(kLimits); r < table_.begin(kSmallest); ++r) {
    if (!rows[original_[r]].equality) {
      held.push_back({original_[r], Side::Upper, multiplier_[r], Role::Idle});
    }
  }
  return true;
}

}  // namespace hurcules
