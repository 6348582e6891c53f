// The working sets of the last solve, from which the next one starts where the pattern of levels is
// the same.
#pragma once

#include <span>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/solver/optimality/level_record.hpp"
#include "hurcules/solver/problem/row_table.hpp"

namespace hurcules {

// A row of the last solve's working sets.
struct KeptRow {
  int held_by = 0;
  int row = 0;  // in the table
  Side side = Side::Upper;
  Role role = Role::Violation;
};

class WorkingSetCache {
 public:
  void reserve(Index levels, Index rows);
  void clear();
  // before a solve: forgets the rows where they do not fit the present ones
  void check(const RowTable& rows);
  // those that level k held
  [[nodiscard]] std::span<const KeptRow> of(int k) const {
    return {kept_.data() + begin_[k], kept_.data() + begin_[k + 1]};
  }
  // after a solve: the rows that the first `final_levels` levels held; `active` lists them, too
  void keep(const RowTable& rows, std::span<const LevelRecord> records,
            const std::vector<HeldRow>& held, int final_levels, std::vector<ActiveRow>& active);

  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  ActiveRow* list_active(const RowTable& rows, const LevelRecord& record,
                         const std::vector<HeldRow>& held, int k, ActiveRow* active);
  KeptRow* keep_roles(const LevelRecord& record, const std::vector<HeldRow>& held, int k,
                      KeptRow* kept);

  std::vector<KeptRow> kept_;  // by level
  std::vector<int> begin_;     // where those of each level begin
  bool restored_ = false;      // they come from a snapshot
  std::vector<char> listed_;   // (rows)
};

}  // namespace hurcules
