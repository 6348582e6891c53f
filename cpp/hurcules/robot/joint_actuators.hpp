// The actuators of a model that drive a joint, and how to make each of them give an effort.
//
// MuJoCo's actuator gives  gain ctrl + b_0 + b_1 l + b_2 dl/dt  with l = gear q the length of its
// transmission: a motor has b = 0, a position or velocity servo has not. Whichever it is, the
// control that makes it give an effort tau at the joint is
//   ctrl = (tau / gear - b_0 - b_1 l - b_2 dl/dt) / gain.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hurcules/robot/motor.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

struct JointActuator {
  int actuator = 0;
  std::string joint;  // its name
  int joint_id = 0;
  int qpos = 0, dof = 0;  // addresses
  double gear = 1.0;
  double gain = 1.0;
  std::array<double, 3> bias = {};
  bool is_motor = true;             // gain 1, no bias
  double lower = 0.0, upper = 0.0;  // [rad] or [m] range of the joint, -inf and inf without
  MotorLimits limits = {};

  // control for an effort [N m] or [N] at the joint, at its position and velocity
  [[nodiscard]] double control(double effort, double position, double velocity) const {
    if (is_motor) return effort / gear;
    const double length = gear * position, rate = gear * velocity;
    return (effort / gear - bias[0] - bias[1] * length - bias[2] * rate) / gain;
  }
};

// All of them, in the model's order. Throws Error for an actuator of a joint whose force is no
// affine function of its control (muscles, actuators with a state of their own).
[[nodiscard]] std::vector<JointActuator> joint_actuators(const Robot& robot);

}  // namespace hurcules
