// How x moves with the numbers of the hierarchy: the exact derivative on the active piece.
//
// The optimality conditions of each level (level_kkt_system.hpp) are differentiated with the
// working set held, and chained from the first level to the last:
//     rho^2 dt + V'(V dt - right) + force + C'dmu = 0,   C dt = dd - dC t
//     right = db - dV x - V dx_above,   force = dV'e + dC'mu + 2 rho drho t
// Where weak directions were handed over, the directions B that each level is left move too
// (nullspace_derivative.hpp): x = x_above + B t,
//     dx = dx_above + dB t + B dt,   the equations above for C B, V B and dt
// and rho moves with them where it follows the smallest singular value. It is the derivative
// wherever a small change leaves the working set and the ranks alone. Rows of one level that depend
// on each other and conflict have derivatives in A of size 1 / rho^2; those carry rounding of that
// size.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/solver/sensitivity/level_sensitivity.hpp"
#include "hurcules/solver/sensitivity/nullspace_derivative.hpp"

namespace hurcules {

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
  // what the changes do to the directions behind level k, dB of those that it has
  [[nodiscard]] DirectionsChange directions_change(int k, const std::vector<LevelChange>& changes,
                                                   const Matrix& dB) const;
  void add_directions_gradient(int k, const DirectionsChange& bar,
                               std::vector<LevelChange>& gradient) const;

  std::shared_ptr<const SolvedHierarchy> solved_;
  std::vector<LevelKktSystem> pieces_;
  // of each level; empty where neither x nor rho needs them
  std::vector<NullspaceDerivative> directions_;
  std::vector<Receiver> receivers_;
};

}  // namespace hurcules
