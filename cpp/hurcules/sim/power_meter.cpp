#include "hurcules/sim/power_meter.hpp"

#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/base/error.hpp"

namespace hurcules {

PowerMeter::PowerMeter(const mjModel* m, const PowerOptions& options) : options_(options) {
  require(std::isfinite(options.standby) && options.standby >= 0.0,
          "standby wants a power >= 0 [W]");
  for (int actuator = 0; actuator < m->nu; ++actuator) {
    if (m->actuator_trntype[actuator] != mjTRN_JOINT) continue;
    drives_.push_back({actuator, m->actuator_gear[6 * actuator],
                       MotorPower(read_motor_limits(m, actuator), options.motors)});
  }
}

void PowerMeter::read(const mjData* d, const Brakes& brakes) {
  mechanical_ = motors_ = 0.0;
  for (const Motor& motor : drives_) {
    const double effort = d->actuator_force[motor.actuator] * motor.gear;
    const double velocity = d->actuator_velocity[motor.actuator] / motor.gear;
    mechanical_ += effort * velocity;
    motors_ += motor.power.at(effort, velocity);
  }
  total_ = motors_ + brakes.power() + options_.standby;
}

}  // namespace hurcules
