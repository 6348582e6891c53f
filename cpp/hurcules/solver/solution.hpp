// What a solve returns.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/types.hpp"

namespace hurcules {

enum class SolverStatus {
  Solved,           // every level optimal, to the tolerances of NOTATION.md
  ReducedAccuracy,  // ended, but not all levels are proven: see optimality
  IterationLimit,   // max_changes met: x is feasible for all levels above, final_levels says which
                    // are optimal
  LostPrecision,    // numbers beyond double arithmetic: x is that of the levels above final_levels
  InvalidInput,     // NaN, lower > upper or a wrong shape: x is zero, nothing was solved
};
[[nodiscard]] std::string to_string(SolverStatus status);

enum class Side { Lower = -1, Upper = 1 };

// A row that holds x back at the end of a solve.
struct ActiveRow {
  int level = 0;  // level that the row belongs to
  int row = 0;    // its row there
  Side side = Side::Upper;
  int held_by = 0;          // level that pushes against it
  double multiplier = 0.0;  // >= 0, of that level's problem; 0: holds only the smallest step
};

struct Solution {
  Vector x;  // (n)
  SolverStatus status = SolverStatus::Solved;
  std::vector<Vector> violations;      // a level (m): A x - clip(A x, lower, upper)
  std::vector<ActiveRow> working_set;  // by level that pushes
  int factorizations = 0;              // at least one a non-empty level
  int changes = 0;                     // working-set changes
  int final_levels = 0;                // levels known to be optimal
  double optimality = 0.0;  // worst relative residual of the optimality conditions of all levels;
                            // NaN when no proof was asked for
};

}  // namespace hurcules
