// What the whole robot takes from its battery: motors, open brakes, and what is always on.
#pragma once

#include <vector>

#include "hurcules/robot/motor.hpp"
#include "hurcules/sim/brakes.hpp"
#include "hurcules/sim/drive_train.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

struct PowerOptions {
  MotorLosses motors;
  double standby = 300.0;  // [W] three computers, sensors, radio; assumed
};

class PowerMeter {
 public:
  // Every actuator of a joint is a motor, behind its transmission if it has one. Throws Error for
  // options out of range.
  explicit PowerMeter(const mjModel_* model, const PowerOptions& options = {});
  // after a step: what it took, reckoned with the speeds at its beginning
  void read(const mjData_* data, const Brakes& brakes, const DriveTrain& train);

  [[nodiscard]] double mechanical() const { return mechanical_; }  // [W] of all motors, at joints
  [[nodiscard]] double motors() const { return motors_; }          // [W] electric
  [[nodiscard]] double total() const { return total_; }            // [W] with brakes and standby

 private:
  struct Motor {
    int actuator = 0;
    double gear = 1.0;
    MotorPower power;
  };

  PowerOptions options_;
  std::vector<Motor> drives_;
  double mechanical_ = 0.0, motors_ = 0.0, total_ = 0.0;
};

}  // namespace hurcules
