// What a solved level leaves behind, for its proof and for what is asked later.
#pragma once

#include "hurcules/solver/kernels/padded.hpp"
#include "hurcules/solver/solution.hpp"

namespace hurcules {

// what a solved level leaves behind
struct LevelRecord {
  double rho = 0.0;              // that was used
  double asked_rho = 0.0;        // of the level as it came; of levels without an answer, too
  double own_norm = 0.0;         // largest |a| of its rows
  PaddedVector x;                // (n), after this level
  double worsened = 0.0;         // by how much rows above got worse, relative to |a| max(1, |x|)
  int first_held = 0, held = 0;  // its rows in the list of held rows
  int first_norm = 0, norm = 0;  // rows that hold only the smallest step (rho = 0)
};

// What a held row does for its level. Only rho = 0 knows other roles than Violation.
enum class Role : char {
  Violation,     // it takes part in the smallest violation
  SmallestStep,  // it only keeps the step from being smaller
  Idle,          // it is touched and does neither, or it is listed a second time
};

// a row that pushes back in a level's problem
struct HeldRow {
  int row = 0;  // in the table
  Side side = Side::Upper;
  double multiplier = 0.0;
  Role role = Role::Violation;
};

}  // namespace hurcules
