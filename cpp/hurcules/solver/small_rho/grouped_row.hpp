// A row that is held by the active set of a level whose regularisation is nothing, or small against
// its rows.
#pragma once

#include <array>
#include <vector>

#include "hurcules/solver/solution.hpp"

namespace hurcules {

enum RowGroup { kLimits, kOwn, kSmallest, kRowGroups };

// a row that is held in one of the groups
struct GroupedRow {
  int row;  // in the table
  Side side;
  double limit;
  double lower, upper;  // what the row allows when it is let go
  double multiplier;
  bool pinned;  // it came back from the last group once

  // which way it pushes
  [[nodiscard]] double sign() const { return static_cast<double>(side); }
};
using GroupedRows = std::array<std::vector<GroupedRow>, kRowGroups>;

}  // namespace hurcules
