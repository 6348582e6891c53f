// The tracks of a robot as one actuator: what the drive controller measures, taken from the sensed
// state, and its torques, written to the controls of both drives.
#pragma once

#include <string>

#include "hurcules/control/drive_controller.hpp"
#include "hurcules/control/joint_servo.hpp"

namespace hurcules {

struct TrackDriveOptions {
  std::string left = "L_lower_belt";  // joints of the driven belts
  std::string right = "R_lower_belt";
  DriveOptions drive = {};
};

class TrackDrive {
 public:
  // The pose is that of the root body. Throws Error for belts without an actuator, or a robot
  // without a free root.
  TrackDrive(const Robot& robot, const TrackDriveOptions& options);

  // what belts, gyro and localisation tell
  [[nodiscard]] DriveState measure(const RobotState& state) const;
  // one period of the controller; writes two entries of ctrl (nu)
  void compute(const RobotState& state, VectorRef ctrl);
  // the same without controls: the profiles go on
  void follow(const RobotState& state);

  // What an ideal robot does with the last command: its root moves over level ground, turning about
  // a point in W, and its belts turn as the profiles ask for; qpos (nq), dt [s]
  void roll(VectorRef qpos, const Vector3& centre, double dt) const;

  [[nodiscard]] DriveController& controller() { return controller_; }
  [[nodiscard]] const DriveController& controller() const { return controller_; }
  [[nodiscard]] bool braked() const { return braked_; }  // both brakes want to be shut
  [[nodiscard]] const JointActuator& left() const { return left_; }
  [[nodiscard]] const JointActuator& right() const { return right_; }
  // whether a state can be one of its model
  [[nodiscard]] bool fits(const Vector& qpos, const Vector& qvel) const {
    return qpos.size() == qpos_size_ && qvel.size() >= dofs_;
  }
  void reset();
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  DriveController controller_;
  JointActuator left_, right_;
  int root_qpos_, root_dof_;
  Index qpos_size_, dofs_ = 0;
  bool braked_ = true;
};

}  // namespace hurcules
