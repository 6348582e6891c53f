// Which body carries a frame, which belong to the trees that the coordinates move, which others may
// move.
#pragma once

#include <string>
#include <vector>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// that carries it; throws Error for a frame that the model has not
[[nodiscard]] int body_of(const mjModel_& model, Frame frame);
// hash of its bodies, joints, sites and what its actuators drive: mjModel.signature is 0 in a file of MuJoCo's own (.mjb)
[[nodiscard]] std::uint64_t structure_of(const mjModel_& model);
// (njnt) whether some coordinate has that joint
[[nodiscard]] std::vector<bool> joints_of_coordinates(const Robot& robot);
// whether a body lies in a tree with one of these roots
[[nodiscard]] bool in_trees(const mjModel_& model, int body, const std::vector<int>& roots);
[[nodiscard]] bool in_own_tree(const Robot& robot, int body);
[[nodiscard]] bool joint_in_own_tree(const Robot& robot, int joint);
// it, or a body below it, has a joint or is moved by mocap
[[nodiscard]] bool may_move(const mjModel_& model, int body);
// Hinges and slides that no coordinate moves and that carry all of one's tree: a base on slides, say.
struct CarryingJoint {
  int qpos = 0, dof = 0;  // addresses
};
[[nodiscard]] std::vector<CarryingJoint> carrying_joints(const Robot& robot);
// throws Error where the coordinates are of several trees, of which a task knows the first alone
void require_one_tree(const Robot& robot, const std::string& task);

}  // namespace hurcules
