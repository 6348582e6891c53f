#include "hurcules/robot/trees.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cassert>

#include "hurcules/base/error.hpp"

namespace hurcules {

int body_of(const mjModel& m, Frame frame) {
  const int i = frame.id;
  switch (frame.type) {
    case mjOBJ_SITE:
      assert(i >= 0 && i < m.nsite);
      return m.site_bodyid[i];
    case mjOBJ_CAMERA:
      assert(i >= 0 && i < m.ncam);
      return m.cam_bodyid[i];
    case mjOBJ_GEOM:
      assert(i >= 0 && i < m.ngeom);
      return m.geom_bodyid[i];
    default:
      assert(frame.type == mjOBJ_BODY && i >= 0 && i < m.nbody);
      return i;
  }
}

std::vector<bool> joints_of_coordinates(const Robot& robot) {
  std::vector<bool> found(static_cast<std::size_t>(robot.model()->njnt), false);
  for (const Coordinate& coordinate : robot.coordinates())
    for (const DrivenJoint& joint : coordinate.joints)
      found[static_cast<std::size_t>(joint.joint)] = true;
  return found;
}

bool in_trees(const mjModel& m, int body, const std::vector<int>& roots) {
  return std::find(roots.begin(), roots.end(), m.body_rootid[body]) != roots.end();
}

bool in_own_tree(const Robot& robot, int body) {
  return in_trees(*robot.model(), body, robot.root_bodies());
}

bool joint_in_own_tree(const Robot& robot, int joint) {
  return in_own_tree(robot, robot.model()->jnt_bodyid[joint]);
}

bool may_move(const mjModel& m, int body) {
  while (body != 0 && m.body_jntnum[body] == 0 && m.body_mocapid[body] < 0)
    body = m.body_parentid[body];
  return body != 0;
}

std::vector<CarryingJoint> carrying_joints(const Robot& robot) {
  const mjModel& m = *robot.model();
  const std::vector<bool> moved = joints_of_coordinates(robot);
  std::vector<CarryingJoint> found;
  int body = robot.root_body(), next = body;
  while (next >= 0) {  // down the tree, as long as it has one branch and no coordinate
    body = next;
    for (int j = m.body_jntadr[body]; j < m.body_jntadr[body] + m.body_jntnum[body]; ++j) {
      if (moved[static_cast<std::size_t>(j)]) return found;
      if (m.jnt_type[j] == mjJNT_HINGE || m.jnt_type[j] == mjJNT_SLIDE)
        found.push_back({m.jnt_qposadr[j], m.jnt_dofadr[j]});
    }
    next = -1;
    for (int b = body + 1; b < m.nbody; ++b) {
      if (m.body_parentid[b] != body) continue;
      if (next >= 0) return found;
      next = b;
    }
  }
  return found;
}

void require_one_tree(const Robot& robot, const std::string& task) {
  const mjModel& m = *robot.model();
  for (const Coordinate& coordinate : robot.coordinates())
    require(m.body_rootid[m.jnt_bodyid[coordinate.joints.front().joint]] == robot.root_body(),
            "task '" + task + "' wants the coordinates of one robot, '" +
                robot.coordinates().front().name + "' and '" + coordinate.name +
                "' move bodies of two trees: Robot(model, joints=[...]) names those of one");
}

}  // namespace hurcules
