// How warm the motors' windings are: one thermal mass a motor.
//
//   tau dT/dt = T_ambient - T + R r F^2
//
// r F^2 [W] is the heat of motor.hpp. R [K/W] is such that a motor which gives `continuous` of its
// peak torque for ever ends at its limit: the rating that motor.hpp reckons with.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/motor.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

// Assumed: insulation class B, and the time constant of a frameless motor of some kilogrammes.
struct MotorThermalOptions {
  double ambient = 25.0;        // [deg C]
  double limit = 130.0;         // [deg C] of the insulation
  double continuous = 0.6;      // share of the peak torque that a motor bears for ever
  double time_constant = 60.0;  // [s]
};

class MotorThermalModel {
 public:
  // every actuator of a joint is a motor; dt [s] from one call of warm to the next; throws Error for
  // options out of range
  MotorThermalModel(const mjModel_* model, const MotorLosses& losses, double dt,
                    const MotorThermalOptions& options = {});
  void reset();  // all at the ambient temperature
  // after a tick: dt of the heat that the motors give now
  void warm(const mjData_* data);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }  // of joints, (m)
  [[nodiscard]] const Vector& temperature() const { return temperature_; }        // [deg C] (m)
  [[nodiscard]] const MotorThermalOptions& options() const { return options_; }
  void save(StateWriter& writer) const { writer.put(temperature_); }
  void restore(StateReader& reader) { reader.get(temperature_); }

 private:
  struct Motor {
    int actuator = 0;
    double gear = 1.0;
    MotorPower power;
    double resistance = 0.0;  // [K/W]
  };
  MotorThermalOptions options_;
  double share_;  // of the way to where it ends, in dt
  std::vector<Motor> motors_;
  std::vector<std::string> names_;
  Vector temperature_;
};

}  // namespace hurcules
