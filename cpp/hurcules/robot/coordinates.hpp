// Which joints the controller moves, read from names in the MJCF.
//
//   <custom>
//     <tuple name="coordinate_KN"> <element objtype="joint" objname="LKN" prm="1"/> ... </tuple>
//     <numeric name="velocity_limit_LKN" data="0.6"/>
//   </custom>
// A prefix that `attach` put in front of these names goes in front of NAME and JOINT.
#pragma once

#include <string>
#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// Where no tuples say it, joints that equality constraints couple linearly are one coordinate, named
// after the joint that leads.
//
// A ball joint is three: NAME_rx, ry, rz. The coordinates in the order of their tuples, else of their joints. Throws Error for a tuple of
// something else than hinge and slide joints, a factor 0, a joint of two coordinates, ranges of
// coupled joints that do not meet, and two coordinates of one name.
// With names: these alone, in this order, each a tuple's coordinate or a joint that is not free; of a ball
// joint its own name or all three. Throws Error for a name that does not exist.
// With `floating`, or with their names, the six coordinates of the free joint that their tree has at
// its root come first: NAME_x, y, z, rx, ry, rz. Throws Error where it has none.
[[nodiscard]] std::vector<Coordinate> find_coordinates(const mjModel_& model,
                                                       const std::vector<std::string>& names = {},
                                                       bool floating = false);

// What an equality constraint says of two hinges or slides: first = slope * second + shift.
struct Coupling {
  int first = 0, second = 0;            // joints
  int first_qpos = 0, second_qpos = 0;  // their addresses
  double slope = 1.0, shift = 0.0;
};
[[nodiscard]] Coupling turned_round(const Coupling& coupling);
// those of the linear ones that are active from the start
[[nodiscard]] std::vector<Coupling> find_couplings(const mjModel_& model);

// Parts of a free joint: three places, then three turns; a ball joint has the turns alone.
inline constexpr int kTurns = 3, kParts = 6;

// the first actuator that drives a joint, -1 for none
[[nodiscard]] int actuator_of(const mjModel_& model, int joint);
// the axis of its body (0, 1, 2) about which an actuator turns a ball joint, -1 for an oblique one
[[nodiscard]] int axis_of(const mjModel_& model, int actuator);
// of an actuator of a joint: length of its transmission per position [1] or [1/m], of a ball joint about
// the actuator's own axis
[[nodiscard]] double gear_of(const mjModel_& model, int actuator);
// "NAME_rx", say
[[nodiscard]] std::string part_name(const mjModel_& model, int joint, int part);
// its name, or its number
[[nodiscard]] std::string joint_name(const mjModel_& model, int joint);

// the model has tuples that say what its coordinates are
[[nodiscard]] bool names_coordinates(const mjModel_& model);

}  // namespace hurcules
