#include "hurcules/control/acceleration_interval.hpp"

#include <algorithm>
#include <cmath>

namespace hurcules {

double next_speed(double distance, double velocity, const RateLimits& limits) {
  const double T = limits.horizon, a = limits.max_acceleration, half = 0.5 * limits.dt;
  const double left = distance - velocity * half;  // w half of it is still to come
  // passed, or to be passed: back, no faster than it may return
  if (left < 0.0) {
    const double back = std::min(limits.return_speed, limits.max_velocity);
    return std::max(left / (T + half), -back);
  }
  if (!std::isfinite(a) || left <= a * T * (T + half)) return left / (T + half);
  return std::sqrt(a * a * half * half + 2.0 * a * left - a * a * T * T) - a * half;
}

AccelerationInterval acceleration_interval(const RateState& state, const RateLimits& limits) {
  const double v = state.velocity;
  // position first: two limits so close that they exclude each other leave the upper one
  const double limit_upper = next_speed(state.to_upper, v, limits);
  const double limit_lower = std::min(-next_speed(-state.to_lower, -v, limits), limit_upper);
  // then velocity
  const double slowest = std::clamp(limit_lower, -limits.max_velocity, limits.max_velocity);
  const double fastest = std::clamp(limit_upper, -limits.max_velocity, limits.max_velocity);
  // what a step cannot reach is given up
  const double a = limits.max_acceleration;
  AccelerationInterval interval;
  interval.lower = std::clamp((slowest - v) / limits.dt, -a, a);
  interval.upper = std::clamp((fastest - v) / limits.dt, -a, a);
  interval.lower_is_limit = slowest == limit_lower && interval.lower > -a;
  interval.upper_is_limit = fastest == limit_upper && interval.upper < a;
  return interval;
}

}  // namespace hurcules
