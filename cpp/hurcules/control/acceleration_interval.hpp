// The interval of accelerations in which a coordinate keeps its position, velocity and acceleration
// limits, now and later.
//
// One step of dt at the acceleration u ends at the velocity w = v + u dt and (v + w) dt / 2
// further. There w shall be at most the approach speed of rate_interval.hpp,
//     w <= V(d - (v + w) dt / 2),   V(d) = d / T  for d <= a T^2,  sqrt(2 a d - a^2 T^2) beyond,
// so that the position is inside its limit after the step [T 5.6.50] and can be braked with a
// before it from there on. [T 5.6.52-53] alone lets a coordinate run up to its limit at full speed
// and then asks for any acceleration. A coordinate that once keeps V finds a u that keeps it again,
// of magnitude a at most: at the profile itself it brakes with a beyond a T^2, with v / (T + dt/2)
// nearer.
#pragma once

#include "hurcules/control/rate_interval.hpp"

namespace hurcules {

struct AccelerationInterval {
  double lower = 0.0;           // [rad/s^2]
  double upper = 0.0;           // [rad/s^2], >= lower always
  bool lower_is_limit = false;  // the position limit sets this end
  bool upper_is_limit = false;
};

// the largest w that keeps w <= V(d - (v + w) dt / 2); distance d, v and w towards the limit
[[nodiscard]] double next_speed(double distance, double velocity, const RateLimits& limits);

// Never empty, and never beyond max_acceleration: a coordinate that cannot stop in time (its range
// was narrowed, or somebody pushed it) brakes as hard as it may.
[[nodiscard]] AccelerationInterval acceleration_interval(const RateState& state,
                                                         const RateLimits& limits);

}  // namespace hurcules
