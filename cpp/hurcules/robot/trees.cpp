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

bool in_own_tree(const Robot& robot, int body) {
  const mjModel& m = *robot.model();
  const std::vector<Coordinate>& all = robot.coordinates();
  return std::any_of(all.begin(), all.end(), [&](const Coordinate& coordinate) {
    const std::vector<DrivenJoint>& joints = coordinate.joints;
    return std::any_of(joints.begin(), joints.end(), [&](const DrivenJoint& joint) {
      return m.body_rootid[m.jnt_bodyid[joint.joint]] == m.body_rootid[body];
    });
  });
}

bool may_move(const mjModel& m, int body) {
  while (body != 0 && m.body_jntnum[body] == 0 && m.body_mocapid[body] < 0)
    body = m.body_parentid[body];
  return body != 0;
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
