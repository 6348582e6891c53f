#include "hurcules/robot/trees.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/base/state.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

struct Frames {
  Index count = 0;
  const int* bodies = nullptr;  // that carry them, null where they are the bodies
};

Frames frames_of(const mjModel& m, int type) {
  switch (type) {
    case mjOBJ_SITE:
      return {m.nsite, m.site_bodyid};
    case mjOBJ_CAMERA:
      return {m.ncam, m.cam_bodyid};
    case mjOBJ_GEOM:
      return {m.ngeom, m.geom_bodyid};
    case mjOBJ_BODY:
      return {m.nbody};
    default:
      return {};
  }
}

}  // namespace

int body_of(const mjModel& m, Frame frame) {
  const Frames frames = frames_of(m, frame.type);
  if (frame.id < 0 || frame.id >= frames.count) {
    throw Error(
        "frame " + std::to_string(frame.id) + " of MuJoCo's type " + std::to_string(frame.type) +
        ": wanted a site, body, camera or geom of the model, as Robot::frame(name) finds it");
  }
  return frames.bodies ? frames.bodies[frame.id] : frame.id;
}

std::uint64_t structure_of(const mjModel& m) {
  std::uint64_t hash = kHashOfNothing;
  const auto add = [&](const std::string& text) { hash = hash_of(text + ";", hash); };
  for (int b = 0; b < m.nbody; ++b) {
    add(name_of(m, mjOBJ_BODY, b) + " on " + std::to_string(m.body_parentid[b]));
  }
  for (int j = 0; j < m.njnt; ++j) {
    add(name_of(m, mjOBJ_JOINT, j) + " of type " + std::to_string(m.jnt_type[j]) + " on " +
        std::to_string(m.jnt_bodyid[j]));
  }
  for (int i = 0; i < m.nsite; ++i) {
    add(name_of(m, mjOBJ_SITE, i) + " on " + std::to_string(m.site_bodyid[i]));
  }
  for (int a = 0; a < m.nu; ++a) {
    add(std::to_string(m.actuator_trntype[a]) + " " + std::to_string(m.actuator_trnid[2 * a]));
  }
  return hash;
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
