// The actuators of a model that drive a joint, and how to make each of them give an effort.
//
// MuJoCo's actuator gives  gain ctrl + b_0 + b_1 l + b_2 dl/dt  with l = gear q the length of its
// transmission: a motor has b = 0, a position or velocity servo has not. Whichever it is, the
// control that makes it give an effort tau at the joint is
//   ctrl = (tau / gear - b_0 - b_1 l - b_2 dl/dt) / gain.
// A ball joint has three, one about each axis of its body; q is that part of its rotation vector.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "hurcules/robot/motor.hpp"
#include "hurcules/robot/robot.hpp"

namespace hurcules {

struct JointActuator {
  int actuator = 0;
  std::string joint;  // its name, of a ball joint that of the coordinate: NAME_rx
  int joint_id = 0;
  int part = -1;          // 3 to 5 of a ball joint, else -1
  int qpos = 0, dof = 0;  // addresses, in qpos of a ball joint that of its quaternion
  double gear = 1.0;
  double gain = 1.0;
  std::array<double, 3> bias = {};
  bool is_motor = true;                            // gain 1, no bias
  double least_control = 0.0, most_control = 0.0;  // its range, -inf and inf without
  double lower = 0.0, upper = 0.0;  // [rad] or [m] range of the joint, -inf and inf without
  MotorLimits limits = {};
  // [kg m^2] or [kg] that it turns in the model's initial posture, where all other joints give way
  // and where they hold
  double least_inertia = 0.0, most_inertia = 0.0;
  // [kg m^2] that a driven wheel turns where it rolls: its share of the robot's mass; 0: no wheel. A
  // wheel has a hinge without a range, on a robot that can move; it bears no other body, and its
  // shapes are round about the axis
  double rolling_inertia = 0.0;
  // [kg m^2] or [kg], [rad/s] what its servo shall reckon with, as the model's numeric servo_JOINT
  // says; 0 without one
  double servo_inertia = 0.0, servo_bandwidth = 0.0;

  // [rad] or [m] where it is, in all of qpos (nq)
  [[nodiscard]] double position(const Vector& all) const;
  // control for an effort [N m] or [N] at the joint, at its position and velocity
  [[nodiscard]] double control(double effort, double position, double velocity) const {
    if (is_motor) return effort / gear;
    return std::clamp((effort / gear - bias_at(position, velocity)) / gain, least_control,
                      most_control);
  }
  // efforts at the joint that its controls can give, at a position and velocity; what a motor gives
  // stands in its limits
  [[nodiscard]] EffortRange efforts(double position, double velocity) const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    if (is_motor || !std::isfinite(least_control)) return {-kNone, kNone};
    const double at_rest = gear * bias_at(position, velocity);
    const double a = at_rest + gear * gain * least_control;
    const double b = at_rest + gear * gain * most_control;
    return {std::min(a, b), std::max(a, b)};
  }

 private:
  [[nodiscard]] double bias_at(double position, double velocity) const {
    return bias[0] + bias[1] * gear * position + bias[2] * gear * velocity;
  }
};

// All of them, in the model's order. Throws Error for an actuator of a joint whose force is no
// affine function of its control (muscles, actuators with a state of their own), for a ball joint that
// has others than one about each axis of its body, and for a servo_JOINT that is no two numbers above 0.
[[nodiscard]] std::vector<JointActuator> joint_actuators(const Robot& robot);
// the coordinate that its joint belongs to, and how far the joint goes for a unit of it
struct CoordinateOfJoint {
  Index number = -1;  // none
  double factor = 1.0;
};
[[nodiscard]] CoordinateOfJoint coordinate_of(const Robot& robot, const JointActuator& actuator);
// joints of a model that are driven wheels, see JointActuator::rolling_inertia; of any actuators
[[nodiscard]] std::vector<int> driven_wheels(const mjModel_& model);

}  // namespace hurcules
