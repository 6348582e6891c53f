// What a robot leaves as it is although it could move.
#pragma once

#include <string>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// Joints of the trees that the coordinates move which belong to no coordinate (but the free joint of
// a root), and equality constraints on these trees that the coordinates do not keep: connect, weld,
// tendon, and joints coupled by a curve. "" where there is neither, or the model says by tuples what
// its coordinates are.
[[nodiscard]] std::string left_out(const Robot& robot);

}  // namespace hurcules
