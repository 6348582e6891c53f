// The interval of velocities in which a coordinate keeps its position, velocity and acceleration
// limits, now and later.
//
// With distance d to a limit, horizon T and acceleration a the speed towards the limit is at most
//     d / T                   for d <= a T^2 [T 4.3.9]: the approach slows down exponentially
//     sqrt(2 a d - a^2 T^2)   beyond: it can be braked with a before the exponential part begins
// so a coordinate that keeps it can always brake in time, and never passes the limit.
#pragma once

namespace hurcules {

struct RateLimits {
  double dt = 1e-3;               // [s]
  double horizon = 0.05;          // [s] T, at least dt
  double max_velocity = 0.0;      // [rad/s] inf for none
  double max_acceleration = 0.0;  // [rad/s^2] inf for none
  double return_speed = 0.0;      // [rad/s] at which a coordinate outside its range is driven back
};

// Where a coordinate stands: signed distances and the velocity that it was last given.
struct RateState {
  double to_lower = 0.0;  // [rad] lower - q: negative inside the range
  double to_upper = 0.0;  // [rad] upper - q: positive inside the range
  double velocity = 0.0;  // [rad/s]
};

struct RateInterval {
  double lower = 0.0;  // [rad/s]
  double upper = 0.0;  // [rad/s], >= lower always
  double least = 0.0;  // [rad/s] the same without the acceleration limit
  double most = 0.0;
  bool lower_is_limit = false;  // the position limit sets this end, not velocity or acceleration
  bool upper_is_limit = false;
};

// the largest velocity towards a limit at this distance; negative (away from it) when it was passed
[[nodiscard]] double approach_speed(double distance, const RateLimits& limits);

// Never empty. Where the three cannot be met together the position limit wins, then velocity,
// which is braked for where it was lowered below the present one.
[[nodiscard]] RateInterval rate_interval(const RateState& state, const RateLimits& limits);

}  // namespace hurcules
