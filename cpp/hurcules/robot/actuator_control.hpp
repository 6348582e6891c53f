// The control of an actuator by its name: a gripper on tendons, a suction cup, a muscle.
#pragma once

#include <string>

#include "hurcules/base/types.hpp"

struct mjModel_;

namespace hurcules {

struct ActuatorControl {
  int actuator = 0;
  double lower = 0.0, upper = 0.0;  // its ctrlrange, -inf and inf without
};

// throws Error with the names that exist
[[nodiscard]] ActuatorControl actuator_control(const mjModel_& model, const std::string& name);
// Within its range what holds the actuator where it is at qpos (nq): the control at which one with a
// stiffness (a position servo) gives nothing, 0 for others.
[[nodiscard]] double resting_control(const mjModel_& model, const ActuatorControl& control,
                                     const Vector& qpos);

}  // namespace hurcules
