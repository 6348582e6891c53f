// One named input of a whole-body controller: what a command moves, and how much of it is full scale.
//
//   Twist   the target of a task, as a velocity [m/s] or [rad/s]; zero holds it
//   Delta   the target of a task, from the measured value [m] or [rad]; zero leaves the target
//   Target  the target of a task itself [m] or [rad]; an orientation as a rotation vector, of a gaze
//           the point [m]
//   Force   the reference of a force task [N]
//   Drive   speed [m/s] and yaw rate [rad/s] of the tracks
//   Joint   the place of a joint that no coordinate moves (gripper, bed), as a velocity
//   Joints  the places of joints while no stack rules, as velocities
//   Control the control of an actuator that no servo commands (a gripper on tendons), as a rate
#pragma once

#include <string>
#include <vector>

#include "hurcules/tasks/task.hpp"

namespace hurcules {

enum class ChannelKind { Twist, Delta, Target, Force, Drive, Joint, Joints, Control };

class Channel {
 public:
  // `scale`: the largest magnitude, one number or one a component; a command is held to it, inf for
  // none. Throws Error for a task that has no such target, or a scale that is not above 0.
  Channel(std::string name, ChannelKind kind, Task& task, Vector scale,
          std::vector<std::string> components = {});
  static Channel drive(std::string name, double speed, double yaw_rate);
  static Channel joint(std::string name, std::string joint, double scale);
  static Channel joints(std::string name, std::vector<std::string> joints, double scale);
  static Channel control(std::string name, std::string actuator, double scale);

  [[nodiscard]] const std::string& name() const { return name_; }
  [[nodiscard]] ChannelKind kind() const { return kind_; }
  // a value is set, and zero would be one of its own: what is not given stays
  [[nodiscard]] bool sets() const {
    return kind_ == ChannelKind::Target || kind_ == ChannelKind::Force;
  }
  // in the first tick of a call alone
  [[nodiscard]] bool acts_once() const { return sets() || kind_ == ChannelKind::Delta; }
  [[nodiscard]] Index size() const { return scale_.size(); }
  [[nodiscard]] const Vector& scale() const { return scale_; }  // (size)
  [[nodiscard]] Task* task() const { return task_; }            // null where it moves none
  [[nodiscard]] const std::vector<std::string>& joint_names() const { return joints_; }
  [[nodiscard]] const std::string& actuator() const { return actuator_; }  // of Control
  // "hand_x", "hand_y", ...: one a number; the name itself for a single one
  [[nodiscard]] std::vector<std::string> entries() const;
  // the same for another task of the same kind, that of a copied controller
  [[nodiscard]] Channel with_task(Task& task) const;

 private:
  Channel(std::string name, ChannelKind kind, Vector scale, std::vector<std::string> components);

  std::string name_;
  ChannelKind kind_;
  Task* task_ = nullptr;
  std::vector<std::string> joints_;
  std::string actuator_;
  Vector scale_;
  std::vector<std::string> components_;
};

}  // namespace hurcules
