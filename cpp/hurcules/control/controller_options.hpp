// What a whole-body controller is made with.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hurcules/control/joint_servo.hpp"
#include "hurcules/control/motion_law.hpp"
#include "hurcules/control/track_drive.hpp"

namespace hurcules {

// Where the plan's support stands.
enum class BaseSource {
  // Where it stood at the start: the commanded motion follows from the command alone.
  Held,
  // Where it is now, and 1 / K ahead of it at its present velocity: targets in the world then stay
  // where they are while the robot drives or gives way.
  Sensed,
};

struct WholeBodyControllerOptions {
  double dt = 1e-3;                         // [s] control period; also of all others
  VelocityControllerOptions velocity = {};  // of stacks by velocities; their dt is not read
  AccelerationControllerOptions acceleration = {};
  // of stacks by torques: a foot that the ground stops at once must be able to
  AccelerationControllerOptions torque = {.max_acceleration = 200.0};
  std::string support = "";  // body that stands, "" for the root
  BaseSource base = BaseSource::Held;
  // of the joints that are left out those of the model (model_servo_gains), else default_servo_gains
  std::vector<ServoGains> servo = {};
  // servos are told what the plan takes: inertia, gravity, Coriolis, springs of the model. Without it
  // whatever the robot carries is a disturbance to them.
  bool feed_forward = true;
  // what the servos ask for as accelerations is given by the mass matrix, so that no joint's motion
  // disturbs another; wants feed_forward; not given: where the gains of all coordinates are reckoned
  // and no wheel is driven (the mass matrix does not know what a wheel on the ground moves)
  std::optional<bool> decoupled = {};
  // the motion slows down where a motor would be asked for more than its peak
  bool torque_scaling = true;
  std::optional<TrackDriveOptions> drive = {};  // tracks, where a Drive channel is to move them
};

// The same with a row of gains for every joint with an actuator, `decoupled` and `support` decided,
// and one dt. Throws Error for gains of a joint that has no actuator.
[[nodiscard]] WholeBodyControllerOptions completed(const Robot& robot,
                                                   WholeBodyControllerOptions options);

}  // namespace hurcules
