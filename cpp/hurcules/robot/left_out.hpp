// What a robot leaves as it is although it could move.
#pragma once

#include <string>
#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// Equality constraints on the trees that the coordinates move, which these do not keep: connect,
// weld, tendon, and joints coupled by a curve. By name, else by what they tie. None where the model
// says by tuples what its coordinates are.
[[nodiscard]] std::vector<std::string> unkept_constraints(const Robot& robot);
// Tendons with limits of length that the coordinates move: no level keeps these.
[[nodiscard]] std::vector<std::string> unkept_tendon_limits(const Robot& robot);
// In words: both, and joints of these trees that belong to no coordinate (but the free joint of a
// root); where the model names its coordinates, joints with actuators beside them. "" where there is
// nothing.
[[nodiscard]] std::string left_out(const Robot& robot);
// of these joints those that a tendon drives or no spring holds, and that do not carry all of the
// robot, for who did not choose them; "" where there is none, and where the model names its
// coordinates
[[nodiscard]] std::string held_joints(const Robot& robot);

}  // namespace hurcules
