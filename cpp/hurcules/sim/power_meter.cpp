#include "hurcules/sim/power_meter.hpp"

#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/coordinates.hpp"

namespace hurcules {

PowerMeter::PowerMeter(const mjModel* m, const PowerOptions& options) : options_(options) {
  require(std::isfinite(options.standby) && options.standby >= 0.0,
          "standby wants a power >= 0 [W]");
  const DriveTrain train(m);
  for (int actuator = 0; actuator < m->nu; ++actuator) {
    if (m->actuator_trntype[actuator] != mjTRN_JOINT) continue;
    const MotorLimits limits =
        train.exists(actuator) ? train.motor(actuator) : read_motor_limits(m, actuator);
    drives_.push_back({actuator, gear_of(*m, actuator), MotorPower(limits, options.motors)});
  }
}

void PowerMeter::read(const mjData* d, const Brakes& brakes, const DriveTrain& train) {
  mechanical_ = motors_ = 0.0;
  for (const Motor& motor : drives_) {
    const double effort = d->actuator_force[motor.actuator] * motor.gear;
    const double velocity = d->actuator_velocity[motor.actuator] / motor.gear;
    mechanical_ += effort * velocity;
    // what the transmission loses the motor must give, and only the rest of braking reaches it
    const double ratio = train.ratio(motor.actuator), share = train.efficiency(motor.actuator);
    const double torque = effort / ratio * (effort * velocity > 0.0 ? 1.0 / share : share);
    motors_ += motor.power.at(torque, velocity * ratio);
  }
  total_ = motors_ + brakes.power() + options_.standby;
}

}  // namespace hurcules
