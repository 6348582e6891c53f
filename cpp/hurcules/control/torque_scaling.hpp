// Torque-limited scaling: a reference that slows down where the motors would be asked for too much,
// so that it does not run away from a robot that is blocked.
//
//   lower <= qdot <= upper (n): where no servo is asked for more than its motor gives
//   qdot = s qdot*, the largest s in 0 .. 1 that keeps every coordinate within, as a path is
//          followed more slowly where its torques would pass their limits
// Where no s does, 0 lies outside: the robot is pushed harder than a motor bears. It stands then
// (s = 0), and the coordinates that are pushed follow the push. One s for all, so that a hand that
// is blocked is not driven on by the joints behind it. A motion that leads back is never held.
#pragma once

#include "hurcules/base/types.hpp"

namespace hurcules {

// Never empty.
struct VelocityBounds {
  Vector lower, upper;  // [rad/s], (n), -inf and inf for no side
};

// leaves a velocity within the bounds as it is, to the last bit; true when it changed it
bool scale_velocity(const VelocityBounds& bounds, VectorRef velocity);

}  // namespace hurcules
