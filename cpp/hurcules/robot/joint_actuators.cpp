#include "hurcules/robot/joint_actuators.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

void require_affine(const mjModel* m, int actuator, const std::string& joint) {
  const bool affine = m->actuator_gaintype[actuator] == mjGAIN_FIXED &&
                      m->actuator_dyntype[actuator] == mjDYN_NONE &&
                      (m->actuator_biastype[actuator] == mjBIAS_NONE ||
                       m->actuator_biastype[actuator] == mjBIAS_AFFINE) &&
                      m->actuator_gainprm[mjNGAIN * actuator] != 0.0;
  require(affine,
          "the actuator '" + name_of(*m, mjOBJ_ACTUATOR, actuator) + "' of joint '" + joint +
              "' wants to be a motor, or a position or velocity servo without a state of its "
              "own (muscle, filter, integrator): the joint servo commands effort. Take the "
              "actuator out of the model, and hurcules.with_motors gives the joint a motor");
}

JointActuator read(const mjModel* m, int a) {
  JointActuator found;
  found.actuator = a;
  found.joint_id = m->actuator_trnid[2 * a];
  found.joint = name_of(*m, mjOBJ_JOINT, found.joint_id);
  require_affine(m, a, found.joint);
  found.qpos = m->jnt_qposadr[found.joint_id];
  found.dof = m->jnt_dofadr[found.joint_id];
  found.gear = gear_of(*m, a);
  found.gain = m->actuator_gainprm[mjNGAIN * a];
  if (m->actuator_biastype[a] == mjBIAS_AFFINE) {
    for (int i = 0; i < 3; ++i)
      found.bias[static_cast<std::size_t>(i)] = m->actuator_biasprm[mjNBIAS * a + i];
  }
  found.is_motor = found.gain == 1.0 && found.bias == std::array<double, 3>{};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const bool bounded = m->actuator_ctrllimited[a] != 0;
  found.least_control = bounded ? m->actuator_ctrlrange[2 * a] : -kNone;
  found.most_control = bounded ? m->actuator_ctrlrange[2 * a + 1] : kNone;
  const bool ball = m->jnt_type[found.joint_id] == mjJNT_BALL;
  if (ball) {
    const int axis = axis_of(*m, a);
    require(axis >= 0, "the actuator '" + name_of(*m, mjOBJ_ACTUATOR, a) + "' of ball joint '" +
                           found.joint + "' wants a gear about one axis of its body: 1 0 0, " +
                           "0 1 0 or 0 0 1, and joint instead of jointinparent");
    found.part = kTurns + axis;
    found.dof += axis;
    found.joint = part_name(*m, found.joint_id, found.part);
  }
  const bool limited = m->jnt_limited[found.joint_id] != 0 && !ball;
  found.lower = limited ? m->jnt_range[2 * found.joint_id] : -kNone;
  found.upper = limited ? m->jnt_range[2 * found.joint_id + 1] : kNone;
  found.limits = read_motor_limits(m, a);
  found.least_inertia = 1.0 / m->dof_invweight0[found.dof];
  found.most_inertia = m->dof_M0[found.dof];
  return found;
}

// [m] of a shape that is round about a line through the origin of its body (whose axes these are);
// 0: it is not. By the box about the shape, which is square then.
double radius_about(const mjModel* m, int geom, const Vector3& point, const Vector3& axis) {
  constexpr double kRound = 0.02, kAlong = 0.999;
  if (m->geom_type[geom] == mjGEOM_BOX || m->geom_type[geom] == mjGEOM_PLANE) return 0.0;
  const Matrix3 R = rotation_of(m->geom_quat + 4 * geom);
  const Vector3 own = R.transpose() * axis;
  Index along = 0;
  if (own.cwiseAbs().maxCoeff(&along) < kAlong && m->geom_type[geom] != mjGEOM_SPHERE) return 0.0;
  const Eigen::Map<const Vector3> box(m->geom_aabb + 6 * geom), half(m->geom_aabb + 6 * geom + 3);
  const double r = half[(along + 1) % 3];
  const Vector3 middle = R * box + Eigen::Map<const Vector3>(m->geom_pos + 3 * geom) - point;
  const bool round = std::abs(half[(along + 2) % 3] - r) < kRound * r &&
                     (middle - middle.dot(axis) * axis).norm() < kRound * r;
  return round ? r : 0.0;
}

// [m] of a wheel, see JointActuator::rolling_inertia; 0: none
double wheel_radius(const mjModel* m, int joint) {
  const int body = m->jnt_bodyid[joint], root = m->body_rootid[body];
  if (m->jnt_type[joint] != mjJNT_HINGE || m->jnt_limited[joint] || root == body ||
      m->body_dofnum[root] == 0)
    return 0.0;
  for (int b = body + 1; b < m->nbody; ++b)
    if (m->body_parentid[b] == body) return 0.0;
  const Eigen::Map<const Vector3> point(m->jnt_pos + 3 * joint), axis(m->jnt_axis + 3 * joint);
  double radius = 0.0;
  for (int g = m->body_geomadr[body]; g < m->body_geomadr[body] + m->body_geomnum[body]; ++g) {
    if (m->geom_contype[g] == 0 && m->geom_conaffinity[g] == 0) continue;
    const double r = radius_about(m, g, point, axis);
    if (r == 0.0) return 0.0;
    radius = std::max(radius, r);
  }
  return radius;
}

// the mass of each robot is shared out among its driven wheels
void read_wheels(const mjModel* m, std::vector<JointActuator>& actuators) {
  const std::vector<int> wheels = driven_wheels(*m);
  const auto root_of = [m](int joint) { return m->body_rootid[m->jnt_bodyid[joint]]; };
  for (JointActuator& own : actuators) {
    const int root = root_of(own.joint_id);
    if (std::find(wheels.begin(), wheels.end(), own.joint_id) == wheels.end()) continue;
    const auto shares = static_cast<double>(std::count_if(
        wheels.begin(), wheels.end(), [&](int other) { return root_of(other) == root; }));
    const double r = wheel_radius(m, own.joint_id);
    own.rolling_inertia = own.most_inertia + m->body_subtreemass[root] * r * r / shares;
  }
}

void read_servos(const mjModel* m, std::vector<JointActuator>& actuators) {
  for (JointActuator& own : actuators) {
    const int numeric = find_numeric(m, "servo_", own.joint);
    if (numeric < 0) continue;
    const mjtNum* const data = m->numeric_data + m->numeric_adr[numeric];
    require(m->numeric_size[numeric] == 2 && data[0] > 0.0 && data[1] > 0.0,
            "numeric '" + name_of(*m, mjOBJ_NUMERIC, numeric) +
                "' wants two numbers above 0: the inertia that joint '" + own.joint +
                "' turns and the bandwidth of its servo");
    own.servo_inertia = data[0];
    own.servo_bandwidth = data[1];
  }
}

// where a ball joint has one, it has three
void require_three(const mjModel* m, const std::vector<JointActuator>& actuators) {
  for (const JointActuator& own : actuators) {
    if (own.part < 0) continue;
    std::array<int, kParts> count = {};
    for (const JointActuator& one : actuators)
      if (one.joint_id == own.joint_id) ++count[static_cast<std::size_t>(one.part)];
    const std::string name = name_of(*m, mjOBJ_JOINT, own.joint_id);
    for (int part = kTurns; part < kParts; ++part)
      require(count[static_cast<std::size_t>(part)] == 1,
              "ball joint '" + name + "' wants three actuators, one about each axis of its " +
                  "body (gear 1 0 0, 0 1 0 and 0 0 1); for '" + part_name(*m, own.joint_id, part) +
                  "' it has " + std::to_string(count[static_cast<std::size_t>(part)]));
  }
}

}  // namespace

double JointActuator::position(const Vector& all) const {
  if (part < 0) return all[qpos];
  return rotation_log(rotation_of(all.data() + qpos))[part - kTurns];
}

CoordinateOfJoint coordinate_of(const Robot& robot, const JointActuator& actuator) {
  const std::vector<Coordinate>& all = robot.coordinates();
  for (std::size_t k = 0; k < all.size(); ++k) {
    for (const DrivenJoint& joint : all[k].joints) {
      if (joint.dof == actuator.dof) return {static_cast<Index>(k), joint.factor};
    }
  }
  return {};
}

std::vector<int> driven_wheels(const mjModel& m) {
  std::vector<int> found;
  for (int joint = 0; joint < m.njnt; ++joint)
    if (actuator_of(m, joint) >= 0 && wheel_radius(&m, joint) > 0.0) found.push_back(joint);
  return found;
}

std::vector<JointActuator> joint_actuators(const Robot& robot) {
  const mjModel* const m = robot.model().get();
  std::vector<JointActuator> found;
  for (int a = 0; a < m->nu; ++a) {
    const int kind = m->actuator_trntype[a];
    if (kind != mjTRN_JOINT && kind != mjTRN_JOINTINPARENT) continue;
    const int type = m->jnt_type[m->actuator_trnid[2 * a]];
    if (type != mjJNT_FREE) found.push_back(read(m, a));
  }
  require_three(m, found);
  read_wheels(m, found);
  read_servos(m, found);
  return found;
}

}  // namespace hurcules
