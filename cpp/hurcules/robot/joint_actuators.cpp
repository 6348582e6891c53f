#include "hurcules/robot/joint_actuators.hpp"

#include <mujoco/mujoco.h>

#include <limits>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

std::string name_of(const mjModel* m, int type, int id) {
  const char* const name = mj_id2name(m, type, id);
  return name ? name : "";
}

void require_affine(const mjModel* m, int actuator, const std::string& joint) {
  const bool affine = m->actuator_gaintype[actuator] == mjGAIN_FIXED &&
                      m->actuator_dyntype[actuator] == mjDYN_NONE &&
                      (m->actuator_biastype[actuator] == mjBIAS_NONE ||
                       m->actuator_biastype[actuator] == mjBIAS_AFFINE) &&
                      m->actuator_gainprm[mjNGAIN * actuator] != 0.0;
  require(affine,
          "the actuator '" + name_of(m, mjOBJ_ACTUATOR, actuator) + "' of joint '" + joint +
              "' wants to be a motor, or a position or velocity servo without a state of its "
              "own (muscle, filter, integrator): the joint servo commands effort. Take the "
              "actuator out of the model, and hurcules.with_motors gives the joint a motor");
}

JointActuator read(const mjModel* m, int a) {
  JointActuator found;
  found.actuator = a;
  found.joint_id = m->actuator_trnid[2 * a];
  found.joint = name_of(m, mjOBJ_JOINT, found.joint_id);
  require_affine(m, a, found.joint);
  found.qpos = m->jnt_qposadr[found.joint_id];
  found.dof = m->jnt_dofadr[found.joint_id];
  found.gear = m->actuator_gear[6 * a];
  found.gain = m->actuator_gainprm[mjNGAIN * a];
  if (m->actuator_biastype[a] == mjBIAS_AFFINE) {
    for (int i = 0; i < 3; ++i)
      found.bias[static_cast<std::size_t>(i)] = m->actuator_biasprm[mjNBIAS * a + i];
  }
  found.is_motor = found.gain == 1.0 && found.bias == std::array<double, 3>{};
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const bool limited = m->jnt_limited[found.joint_id] != 0;
  found.lower = limited ? m->jnt_range[2 * found.joint_id] : -kNone;
  found.upper = limited ? m->jnt_range[2 * found.joint_id + 1] : kNone;
  found.limits = read_motor_limits(m, a);
  return found;
}

}  // namespace

std::vector<JointActuator> joint_actuators(const Robot& robot) {
  const mjModel* const m = robot.model().get();
  std::vector<JointActuator> found;
  for (int a = 0; a < m->nu; ++a) {
    const int kind = m->actuator_trntype[a];
    if (kind != mjTRN_JOINT && kind != mjTRN_JOINTINPARENT) continue;
    const int type = m->jnt_type[m->actuator_trnid[2 * a]];
    if (type == mjJNT_HINGE || type == mjJNT_SLIDE) found.push_back(read(m, a));
  }
  return found;
}

}  // namespace hurcules
