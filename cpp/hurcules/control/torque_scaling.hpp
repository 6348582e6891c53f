// Torque-limited scaling: a reference that slows down where the motors would be asked for too much,
// so that it does not run away from a robot that is blocked.
//
//   lower <= qdot <= upper (n): where no servo is asked for more than its motor gives
//   qdot = s qdot*, the largest s in 0 .. 1 that keeps every coordinate within, as a path is
//          followed more slowly where its torques would pass their limits
// Where no s does, 0 lies outside: the robot is pushed harder than a motor bears. It stands then
// (s = 0), and the coordinates that are pushed follow the push. One s for all that a task or an
// active limit ties together, so that a hand that is blocked is not driven on by the joints behind
// it; a finger that squeezes holds up none but itself. A motion that leads back is never held.
#pragma once

#include <vector>

#include "hurcules/base/types.hpp"
#include "hurcules/solver/hierarchy.hpp"

namespace hurcules {

// Never empty.
struct VelocityBounds {
  Vector lower, upper;  // [rad/s], (n), -inf and inf for no side
};

class TorqueScaling {
 public:
  explicit TorqueScaling(Index coordinates);
  // Leaves a velocity (n) [rad/s] within the bounds as it is, to the last bit; true when it changed
  // it. levels: what was solved for x, whose first n numbers are the coordinates' rates.
  bool apply(const VelocityBounds& bounds, const Hierarchy& levels, const Vector& x,
             VectorRef velocity);

 private:
  void tie(const Hierarchy& levels, const Vector& x);
  [[nodiscard]] Index part_of(Index i) const;  // a coordinate that stands for all tied to i

  std::vector<Index> next_;  // (n) on the way to that one
  Vector share_;             // (n) of a part's velocity, at that one
};

}  // namespace hurcules
