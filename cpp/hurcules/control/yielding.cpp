#include "hurcules/control/yielding.hpp"

#include <algorithm>

namespace hurcules {

namespace {

// the share of this velocity that stays within its side of the window
double share_within(double velocity, double lower, double upper) {
  if (velocity > upper) return upper > 0.0 ? upper / velocity : 0.0;
  if (velocity < lower) return lower < 0.0 ? lower / velocity : 0.0;
  return 1.0;
}

}  // namespace

bool give_way(const RateWindow& window, VectorRef velocity) {
  double share = 1.0;
  for (Index i = 0; i < velocity.size(); ++i) {
    share = std::min(share, share_within(velocity[i], window.lower[i], window.upper[i]));
  }
  if (share == 1.0) return false;
  velocity = (share * velocity).cwiseMax(window.lower).cwiseMin(window.upper);
  return true;
}

}  // namespace hurcules
