#include "hurcules/mission/variation.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace hurcules {

void vary_place(const Variation& variation, Random& random, VectorRef pose) {
  pose[0] += variation.scale * variation.place * random.symmetric();
  pose[1] += variation.scale * variation.place * random.symmetric();
  const double yaw = variation.scale * variation.yaw * random.symmetric();
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw, Vector3::UnitZ()));
  const Eigen::Quaterniond turned = turn * Eigen::Quaterniond(pose[3], pose[4], pose[5], pose[6]);
  pose.segment<4>(3) << turned.w(), turned.vec();
}

void vary_posture(const Variation& variation, Random& random, const Ranges& ranges, VectorRef q) {
  for (Index i = 0; i < q.size(); ++i) {
    const double change = variation.scale * variation.posture * random.symmetric();
    // a start beyond a limit stays where it is
    const double low = std::min(ranges.lower[i], q[i]), high = std::max(ranges.upper[i], q[i]);
    q[i] = std::clamp(q[i] + change, low, high);
  }
}

}  // namespace hurcules
