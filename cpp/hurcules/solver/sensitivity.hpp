// How x moves with the numbers of the hierarchy: the exact derivative on the active piece.
//
// The optimality conditions of each level (level_piece.hpp) are differentiated with the working set
// held, and chained from the first level to the last:
//     rho^2 dt + V'(V dt - right) + force + C'dmu = 0,   C dt = dd - dC t
//     right = db - dV x - V dx_above,   force = dV'e + dC'mu + 2 rho drho t
// It is the derivative wherever a small change leaves the working set and the ranks alone. Rows of
// one level that depend on each other and conflict have derivatives in A of size 1 / rho^2; those
// carry rounding of that size.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/solver/level_piece.hpp"

namespace hurcules {

// A change of the numbers of one level, or the gradient of a function in them. An array of size
// zero is no change.
struct LevelChange {
  Matrix A;             // (m, n); empty for simple bounds
  Vector lower, upper;  // (m); an equality row moves with the mean of both
  double rho = 0.0;
};

class Sensitivity {
 public:
  // throws Error unless every level is optimal
  explicit Sensitivity(std::shared_ptr<const SolvedHierarchy> solved);

  // dx (n) of a change a level; fewer changes than levels: the rest stay
  [[nodiscard]] Vector forward(const std::vector<LevelChange>& changes) const;
  // the gradient of a function of x in all numbers, from its gradient x_bar (n) in x
  [[nodiscard]] std::vector<LevelChange> transposed(const ConstVectorRef& x_bar) const;

 private:
  void check(const std::vector<LevelChange>& changes) const;

  std::shared_ptr<const SolvedHierarchy> solved_;
  std::vector<LevelPiece> pieces_;
};

}  // namespace hurcules
