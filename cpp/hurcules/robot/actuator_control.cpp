#include "hurcules/robot/actuator_control.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

namespace {

double length_at(const mjModel& m, int actuator, const Vector& qpos) {
  const std::unique_ptr<mjData, void (*)(mjData*)> data(mj_makeData(&m), mj_deleteData);
  require(data != nullptr, "no memory for a model's data");
  std::copy(qpos.begin(), qpos.end(), data->qpos);
  mj_fwdPosition(&m, data.get());
  return data->actuator_length[actuator];
}

}  // namespace

ActuatorControl actuator_control(const mjModel& m, const std::string& name) {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const int id = find_object(m, mjOBJ_ACTUATOR, name);
  if (!m.actuator_ctrllimited[id]) return {id, -kNone, kNone};
  return {id, m.actuator_ctrlrange[2 * id], m.actuator_ctrlrange[2 * id + 1]};
}

double resting_control(const mjModel& m, const ActuatorControl& control, const Vector& qpos) {
  const mjtNum* const bias = m.actuator_biasprm + mjNBIAS * control.actuator;
  const double gain = m.actuator_gainprm[mjNGAIN * control.actuator];
  const bool stiff = m.actuator_gaintype[control.actuator] == mjGAIN_FIXED && gain != 0.0 &&
                     m.actuator_biastype[control.actuator] == mjBIAS_AFFINE && bias[1] != 0.0;
  const double rest =
      stiff ? -(bias[0] + bias[1] * length_at(m, control.actuator, qpos)) / gain : 0.0;
  return std::clamp(rest, control.lower, control.upper);
}

}  // namespace hurcules
