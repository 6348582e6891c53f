// Rate limits for tests of what keeps them.
#pragma once

#include "hurcules/control/rate_interval.hpp"

namespace hurcules_test {

inline hurcules::RateLimits usual() {
  hurcules::RateLimits limits;
  limits.dt = 1e-3;
  limits.horizon = 0.05;
  limits.max_velocity = 2.0;
  limits.max_acceleration = 20.0;
  limits.return_speed = 0.2;
  return limits;
}

}  // namespace hurcules_test
