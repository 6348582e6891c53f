// The seeded differences between runs: where the casualty lies, how the robot stands at first.
#pragma once

#include "hurcules/base/random.hpp"
#include "hurcules/base/types.hpp"

namespace hurcules {

struct Variation {
  double scale = 1.0;
  double place = 0.03;     // [m] casualty, both ways in x and y
  double yaw = 0.05;       // [rad] casualty, both ways
  double posture = 0.002;  // [rad] each coordinate, both ways
};

// moves the pose of a free joint, (7) position and quaternion, over the ground
void vary_place(const Variation& variation, Random& random, VectorRef pose);
// moves coordinates (n) [rad], but no further than their limits
struct Ranges {
  const Vector& lower;
  const Vector& upper;
};
void vary_posture(const Variation& variation, Random& random, const Ranges& ranges, VectorRef q);

}  // namespace hurcules
