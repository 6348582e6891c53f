// Where a body would rest on level ground.
#pragma once

#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// The lowest points of the collision geoms of a body, and of what is welded to it, as the robot
// stands: within 3 mm of the lowest, the outermost four at most; the lowest alone where these are less
// than 5 cm apart, as on a round foot. [m] in the body's frame (k).
// Throws Error for what is no body, and for a body without collision geoms.
[[nodiscard]] std::vector<Vector3> sole_points(const Robot& robot, const std::string& body);

}  // namespace hurcules
