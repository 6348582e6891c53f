// The drive train of a belt: motor, centrifugal variable transmission, sprocket [T §4.2.2].
//
// The transmission has the ratio i of motor to sprocket speed, 3 at rest and 1 at full speed. Its
// weights swing out as the motor turns and shift so as to keep the motor at its governed speed:
//   i_steady = clamp(w_governed / |w|, i_high, i_low),   di/dt = (i_steady - i) / lag
// with w the belt's speed. The motor, referred to i = 1, then gives the belt
//   |F| <= i F_motor(i w),   and takes the power F w / efficiency while it drives.
// A step clamps the control of the drive to that, and only for the time of the step. The motor's
// rotor is in the belt's armature with the ratio of the lowest gear, always: at full speed that is
// 0.4 kg m^2 a side too much, 6 % of the robot's inertia at the belts.
#pragma once

#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/base/types.hpp"
#include "hurcules/robot/motor.hpp"

struct mjModel_;
struct mjData_;

namespace hurcules {

// Numbers of the numeric `transmission_JOINT` of a model, in this order.
struct Transmission {
  double low = 1.0;         // ratio at rest, >= high
  double high = 1.0;        // at full speed, > 0
  double lag = 0.0;         // [s] of the shift
  double efficiency = 1.0;  // of the power that it passes on, 0 to 1
  double governed = 1.0;    // motor speed that it keeps, over the motor's peak speed

  // of a belt that has turned at this speed [rad/s] for long; `peak` [rad/s] at the highest ratio
  [[nodiscard]] double steady(double speed, double peak) const;
};

class DriveTrain {
 public:
  // A transmission at every actuator whose joint has the numeric; the others pass on unchanged.
  // Throws Error for numbers out of range.
  explicit DriveTrain(const mjModel_* model);
  void reset(const mjData_* data);  // in the gear of the present speed

  // before mj_step2: no control asks for more than the motor has; after it: as it was asked, and on
  void limit(mjData_* data);
  void advance(mjData_* data);

  [[nodiscard]] bool empty() const { return drives_.empty(); }
  [[nodiscard]] bool exists(int actuator) const { return find(actuator) != nullptr; }
  // of the actuator's transmission, 1 without one
  [[nodiscard]] double ratio(int actuator) const { return ratio_[actuator]; }
  [[nodiscard]] double efficiency(int actuator) const;
  // [N m] at the joint at this speed [rad/s], in the present gear
  [[nodiscard]] EffortRange range(int actuator, double speed) const;
  // of the motor before the transmission: speed [rad/s] and torque [N m] as at ratio 1
  [[nodiscard]] const MotorLimits& motor(int actuator) const;
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Drive {
    int actuator = -1, dof = -1;
    double gear = 1.0;
    Transmission transmission;
    MotorLimits motor;
  };
  [[nodiscard]] const Drive* find(int actuator) const;

  double dt_;
  std::vector<Drive> drives_;
  Vector ratio_;               // (nu)
  std::vector<double> asked_;  // controls of drives_ while a step lasts
};

}  // namespace hurcules
