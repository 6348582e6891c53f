// What a motor behind its gear can give at a joint, and what that costs in electric power.
//
//   driving, F v > 0:  |F| <= min(peak, P / |v|), fading out from the peak speed to no-load speed
//   braking, F v < 0:  |F| <= peak: only the current limits it
//   electric power:    F v / efficiency + r F^2   (F v > 0),   regeneration F v + r F^2   (F v < 0)
//
// r F^2 is the heat in the windings: a motor that only holds a load takes power too, a brake none.
// F is a torque [N m] at a hinge, a force [N] at a slide; v is [rad/s] or [m/s]. Dry friction,
// damping and the rotor's inertia behind the gear are the model's: frictionloss, damping, armature.
#pragma once

#include <string>

struct mjModel_;

namespace hurcules {

// What a drive can give at the moment.
struct EffortRange {
  double lower = 0.0;  // [N m] or [N], <= 0
  double upper = 0.0;  // >= 0
};

struct MotorLimits {
  double peak = 0.0;   // [N m] or [N], > 0; inf for none
  double speed = 0.0;  // [rad/s] or [m/s], > 0: up to here P is there; inf for none
  double power = 0.0;  // [W] at the joint, > 0; inf for none

  [[nodiscard]] EffortRange at(double velocity) const;
};

struct MotorLosses {
  double efficiency = 0.9;    // of gear motor and inverter, 0 to 1, friction apart
  double regeneration = 0.0;  // share of braking power that comes back; 0: a resistor burns it
  // heat at peak torque over the motor's peak power: 10 % of it at 0.6 of the peak torque, which
  // the motor bears for ever
  double heat_at_peak = 0.3;
};

// number of the numeric MARKERjoint of the model, whatever prefix stands before both; -1 without one
[[nodiscard]] int find_numeric(const mjModel_* model, const std::string& marker,
                               const std::string& joint);

// [N m] or [N] that the actuator can give at its joint both ways: from its forcerange, the joint's
// actuatorfrcrange and, of a plain motor, from its ctrlrange; inf for none
[[nodiscard]] double peak_effort(const mjModel_* model, int actuator);

// The limits of the actuator's joint, which may have no others: peak_effort, speed and power from the
// model's numerics velocity_limit_JOINT and power_limit_JOINT. Without the latter the power is that of
// peak and speed together. Throws Error for numbers that are not above 0.
[[nodiscard]] MotorLimits read_motor_limits(const mjModel_* model, int actuator);

class MotorPower {
 public:
  // throws Error for an efficiency outside (0, 1], a regeneration outside [0, 1], or negative heat
  explicit MotorPower(const MotorLimits& limits, const MotorLosses& losses = {});
  // [W] taken from the supply, negative when power comes back; braking joints never take extra
  [[nodiscard]] double at(double effort, double velocity) const;
  // [W] in the windings; 0 for a motor without limits
  [[nodiscard]] double heat(double effort) const { return resistance_ * effort * effort; }

 private:
  MotorLosses losses_;
  double resistance_ = 0.0;  // [W/(N m)^2]
};

}  // namespace hurcules
