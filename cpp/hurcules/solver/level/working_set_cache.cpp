#include "hurcules/solver/level/working_set_cache.hpp"

#include <algorithm>

namespace hurcules {

namespace {

// more rows than a solver of kMostUnknowns can hold are no snapshot of one
constexpr Index kMostKept = 1'000'000;
constexpr Index kSides = 2, kRoles = 3;

// a row as one whole number
double packed(const KeptRow& kept) {
  const Index place = kept.held_by * kMostKept + kept.row;
  const Index side = kept.side == Side::Upper ? 1 : 0;
  return static_cast<double>((place * kSides + side) * kRoles + static_cast<Index>(kept.role));
}

KeptRow unpacked(Index number) {
  const Index role = number % kRoles, side = number / kRoles % kSides;
  const Index place = number / (kRoles * kSides);
  return {static_cast<int>(place / kMostKept), static_cast<int>(place % kMostKept),
          side == 1 ? Side::Upper : Side::Lower, static_cast<Role>(role)};
}

}  // namespace

void WorkingSetCache::reserve(Index levels, Index rows) {
  kept_.reserve(2 * levels * rows);
  begin_.reserve(levels + 1);
  listed_.resize(rows);
}

void WorkingSetCache::clear() {
  kept_.clear();
  std::fill(begin_.begin(), begin_.end(), 0);
}

void WorkingSetCache::check(const RowTable& rows) {
  const int levels = rows.levels();
  // the rows were refused, for numbers that are none, in the solve that brought this pattern
  const bool unread = static_cast<int>(begin_.size()) != levels + 1;
  if (rows.same_pattern() && !restored_ && !unread) return;
  const auto fits = [&](const KeptRow& kept) {
    return kept.held_by < levels && kept.row < rows.size() && !rows[kept.row].equality;
  };
  const auto above = [](const KeptRow& a, const KeptRow& b) { return a.held_by < b.held_by; };
  // a snapshot may hold anything
  if (!rows.alike() || !std::all_of(kept_.begin(), kept_.end(), fits) ||
      !std::is_sorted(kept_.begin(), kept_.end(), above)) {
    kept_.clear();
  }
  std::erase_if(kept_, [&](const KeptRow& kept) { return rows[kept.row].unlimited; });
  restored_ = false;
  begin_.assign(levels + 1, 0);
  for (const KeptRow& kept : kept_) ++begin_[kept.held_by + 1];
  for (int k = 0; k < levels; ++k) begin_[k + 1] += begin_[k];
}

void WorkingSetCache::keep(const RowTable& rows, std::span<const LevelRecord> records,
                           const std::vector<HeldRow>& held, int final_levels,
                           std::vector<ActiveRow>& active) {
  kept_.resize(held.size());
  active.resize(held.size());
  KeptRow* kept = kept_.data();
  ActiveRow* listed = active.data();
  for (int k = 0; k < rows.levels(); ++k) {
    begin_[k + 1] = static_cast<int>(kept - kept_.data());
    if (k >= final_levels) continue;
    const LevelRecord& record = records[k];
    if (record.norm == 0) {
      // without a list of the smallest step every row is listed once
      for (int h = record.first_held; h < record.first_held + record.held; ++h) {
        const Row& row = rows[held[h].row];
        *listed++ = {row.level, row.row, held[h].side, k, held[h].multiplier};
        *kept++ = {k, held[h].row, held[h].side, held[h].role};
      }
    } else {
      listed = list_active(rows, record, held, k, listed);
      kept = keep_roles(record, held, k, kept);
    }
    begin_[k + 1] = static_cast<int>(kept - kept_.data());
  }
  kept_.resize(kept - kept_.data());
  active.resize(listed - active.data());
}

// every row once, with what it does against the violations
ActiveRow* WorkingSetCache::list_active(const RowTable& rows, const LevelRecord& record,
                                        const std::vector<HeldRow>& held, int k,
                                        ActiveRow* active) {
  std::fill(listed_.begin(), listed_.end(), 0);
  const int end_held = record.first_held + record.held;
  for (int h = record.first_held; h < record.first_norm + record.norm; ++h) {
    const Row& row = rows[held[h].row];
    if (listed_[held[h].row]) continue;
    listed_[held[h].row] = 1;
    *active++ = {row.level, row.row, held[h].side, k, h < end_held ? held[h].multiplier : 0.0};
  }
  return active;
}

// a row that has a role is not listed again as idle
KeptRow* WorkingSetCache::keep_roles(const LevelRecord& record, const std::vector<HeldRow>& held,
                                     int k, KeptRow* kept) {
  std::fill(listed_.begin(), listed_.end(), 0);
  for (const bool idle : {false, true}) {
    for (int h = record.first_held; h < record.first_norm + record.norm; ++h) {
      const HeldRow& row = held[h];
      if (listed_[row.row] || (row.role == Role::Idle) != idle) continue;
      listed_[row.row] = 1;
      *kept++ = {k, row.row, row.side, row.role};
    }
  }
  return kept;
}

void WorkingSetCache::save(StateWriter& writer) const {
  writer.put(static_cast<double>(kept_.size()));
  for (const KeptRow& kept : kept_) writer.put(packed(kept));
}

void WorkingSetCache::restore(StateReader& reader) {
  kept_.resize(static_cast<std::size_t>(reader.get_count(kMostKept)));
  for (KeptRow& kept : kept_) {
    kept = unpacked(reader.get_count(kMostKept * kMostKept * kSides * kRoles - 1));
  }
  restored_ = true;
}

}  // namespace hurcules
