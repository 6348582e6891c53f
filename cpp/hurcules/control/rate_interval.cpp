#include "hurcules/control/rate_interval.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

double approach_speed(double distance, const RateLimits& limits) {
  const double T = limits.horizon;
  if (distance < 0.0) {
    return -std::min({-distance / T, limits.return_speed, limits.max_velocity});
  }
  // in steps of dt the profile brakes up to 1 + 2 dt/T harder than its continuous form: so much
  // less is asked
  const double a = limits.max_acceleration / (1.0 + 2.0 * limits.dt / T);
  if (!std::isfinite(a) || distance <= a * T * T) return distance / T;  // [T 4.3.9], T as a gain
  return std::sqrt(2.0 * a * distance - a * a * T * T);
}

RateInterval rate_interval(const RateState& state, const RateLimits& limits) {
  // position first: two limits so close that they exclude each other leave the upper one
  const double limit_upper = approach_speed(state.to_upper, limits);
  const double limit_lower = std::min(-approach_speed(-state.to_lower, limits), limit_upper);

  // then velocity: never empty, since a coordinate is driven back no faster than max_velocity; one
  // that is faster than a limit which was lowered brakes
  const double change = limits.max_acceleration * limits.dt;
  const double lower =
      std::max(limit_lower, std::min(-limits.max_velocity, state.velocity + change));
  const double upper =
      std::min(limit_upper, std::max(limits.max_velocity, state.velocity - change));

  // acceleration last: what it cannot reach within a step is given up
  RateInterval interval;
  interval.least = lower;
  interval.most = upper;
  interval.lower = std::clamp(state.velocity - change, lower, upper);
  interval.upper = std::clamp(state.velocity + change, lower, upper);
  interval.lower_is_limit = interval.lower == limit_lower;
  interval.upper_is_limit = interval.upper == limit_upper;
  return interval;
}

}  // namespace hurcules
