// What a level could do: its rank and singular values in the directions that it was left, and its
// violation split into what no x could avoid and what its regularisation costs.
#pragma once

#include <vector>

#include "hurcules/solver/sensitivity/solved_hierarchy.hpp"

namespace hurcules {

struct LevelReport {
  double rho = 0.0;  // the regularisation that was used
  Index rank = 0;    // directions that its equality rows take from the levels below
  // of its equality rows on the directions left by the equality rows above, largest first  [T
  // 3.3.37]
  Vector singular_values;
  // of each of these directions the part w that the levels below get: 0 where the level keeps it,
  // 1 where it sees nothing, between them by smooth rank transition only; the rank counts it all
  // the same
  Vector handed_over;
  // violation = infeasible + regularized, (m) each  [T 3.3.76]
  Vector infeasible;   // v_k: against the rows above and the limits that it meets  [T 3.3.78]
  Vector regularized;  // u_k: zero for rho = 0  [T 3.3.80]
};

// one a final level
[[nodiscard]] std::vector<LevelReport> level_reports(const SolvedHierarchy& solved);

}  // namespace hurcules
