#include "hurcules/sim/motor_thermal_model.hpp"

#include <mujoco/mujoco.h>

#include <cmath>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/coordinates.hpp"
#include "hurcules/robot/object_names.hpp"

namespace hurcules {

MotorThermalModel::MotorThermalModel(const mjModel* m, const MotorLosses& losses, double dt,
                                     const MotorThermalOptions& options)
    : options_(options), share_(-std::expm1(-dt / options.time_constant)) {
  require(std::isfinite(options.ambient) && std::isfinite(options.limit) &&
              options.limit > options.ambient,
          "windings: limit wants a temperature above ambient [deg C]");
  require(options.continuous > 0.0 && options.continuous <= 1.0,
          "windings: continuous wants a share above 0 and up to 1");
  require(std::isfinite(options.time_constant) && options.time_constant > 0.0,
          "windings: time_constant wants a time above 0 [s]");
  for (int actuator = 0; actuator < m->nu; ++actuator) {
    if (m->actuator_trntype[actuator] != mjTRN_JOINT) continue;
    const MotorLimits limits = read_motor_limits(m, actuator);
    Motor motor{actuator, gear_of(*m, actuator), MotorPower(limits, losses), 0.0};
    // no heat, no warmth: a motor without limits or losses stays cold
    const double heat =
        std::isfinite(limits.peak) ? motor.power.heat(options.continuous * limits.peak) : 0.0;
    if (heat > 0.0) motor.resistance = (options.limit - options.ambient) / heat;
    motors_.push_back(motor);
    names_.push_back(name_of(*m, mjOBJ_JOINT, m->actuator_trnid[2 * actuator]));
  }
  temperature_ = Vector::Constant(static_cast<Index>(motors_.size()), options.ambient);
}

void MotorThermalModel::reset() {
  temperature_.setConstant(options_.ambient);
}

void MotorThermalModel::warm(const mjData* d) {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const Motor& motor = motors_[i];
    const double heat = motor.power.heat(d->actuator_force[motor.actuator] * motor.gear);
    double& temperature = temperature_[static_cast<Index>(i)];
    temperature += share_ * (options_.ambient + motor.resistance * heat - temperature);
  }
}

}  // namespace hurcules
