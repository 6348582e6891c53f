#include "hurcules/control/controller_options.hpp"

#include <algorithm>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

// Rows that are given, those of the model, and reckoned ones for the other joints. A table that is whole
// may name joints of another form of the robot; one that is not may have a name mistyped.
std::vector<ServoGains> all_gains(const Robot& robot, std::vector<ServoGains> given,
                                  const std::vector<ServoGains>& of_model,
                                  const std::vector<JointActuator>& actuators, double dt,
                                  bool decoupled) {
  const auto has = [&given](const std::string& joint) {
    return std::any_of(given.begin(), given.end(),
                       [&joint](const ServoGains& row) { return row.joint == joint; });
  };
  const auto whole = [&] {
    return std::all_of(actuators.begin(), actuators.end(),
                       [&](const JointActuator& actuator) { return has(actuator.joint); });
  };
  if (whole()) return given;
  std::vector<std::string> joints;
  for (const JointActuator& actuator : actuators) joints.push_back(actuator.joint);
  for (const ServoGains& row : given) {
    if (std::find(joints.begin(), joints.end(), row.joint) == joints.end())
      throw Error(unknown_name("joint with an actuator", row.joint, joints));
  }
  for (const ServoGains& row : of_model)
    if (!has(row.joint)) given.push_back(row);
  if (whole()) return given;
  for (const ServoGains& row : default_servo_gains(robot, dt, decoupled))
    if (!has(row.joint)) given.push_back(row);
  return given;
}

}  // namespace

WholeBodyControllerOptions completed(const Robot& robot, WholeBodyControllerOptions options) {
  options.velocity.dt = options.acceleration.dt = options.torque.dt = options.dt;
  const std::vector<JointActuator> actuators = joint_actuators(robot);
  const bool rolls =
      std::any_of(actuators.begin(), actuators.end(),
                  [](const JointActuator& actuator) { return actuator.rolling_inertia > 0.0; });
  const std::vector<ServoGains> of_model = model_servo_gains(actuators);
  const auto has_row = [&](const JointActuator& actuator) {
    const auto is_it = [&](const ServoGains& row) { return row.joint == actuator.joint; };
    return std::any_of(options.servo.begin(), options.servo.end(), is_it) ||
           std::any_of(of_model.begin(), of_model.end(), is_it);
  };
  const bool reckoned =
      std::none_of(actuators.begin(), actuators.end(), [&](const JointActuator& actuator) {
        return coordinate_of(robot, actuator).number >= 0 && has_row(actuator);
      });
  options.decoupled = options.decoupled.value_or(reckoned && options.feed_forward && !rolls);
  require(!*options.decoupled || options.feed_forward, "decoupled servos want feed_forward");
  options.servo =
      all_gains(robot, options.servo, of_model, actuators, options.dt, *options.decoupled);
  if (options.support.empty()) options.support = robot.support_name();
  if (options.drive) options.drive->drive.dt = options.dt;
  return options;
}

}  // namespace hurcules
