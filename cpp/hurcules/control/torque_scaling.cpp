#include "hurcules/control/torque_scaling.hpp"

#include <algorithm>

namespace hurcules {

namespace {

// the share of this velocity that stays within its side of the bounds
double share_within(double velocity, double lower, double upper) {
  if (velocity > upper) return upper > 0.0 ? upper / velocity : 0.0;
  if (velocity < lower) return lower < 0.0 ? lower / velocity : 0.0;
  return 1.0;
}

}  // namespace

bool scale_velocity(const VelocityBounds& bounds, VectorRef velocity) {
  double share = 1.0;
  for (Index i = 0; i < velocity.size(); ++i) {
    share = std::min(share, share_within(velocity[i], bounds.lower[i], bounds.upper[i]));
  }
  if (share == 1.0) return false;
  velocity = (share * velocity).cwiseMax(bounds.lower).cwiseMin(bounds.upper);
  return true;
}

}  // namespace hurcules
