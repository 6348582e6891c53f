// What the drives of the coordinates can give, as rows of a level: for controllers of acceleration.
//
//   lower <= M qddot + h <= upper  [N m] or [N] (n)        M qddot + h: Robot::inverse_dynamics
// jacobian = M, drift = h. Contacts beside the support are in it where `bear` says so, dry friction is not.
#pragma once

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class TorqueLimits : public Task {
 public:
  // starts with the efforts of the robot's coordinates, inf where it has none
  TorqueLimits(std::string name, const Robot& robot);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<TorqueLimits>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "N m"; }

  // at the robot's configuration and velocity; error() is the torque at constant velocity, h
  void update(const Robot& robot) override;
  // what the drives give beside, (n) [N m] or [N], until the next update
  void bear(const ConstVectorRef& efforts) { drift_ += efforts; }
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  [[nodiscard]] bool commands_acceleration() const override { return true; }
  [[nodiscard]] std::string row_name(const Robot& robot, Index row) const override {
    return robot.coordinates()[static_cast<std::size_t>(row)].name + " torque limit";
  }
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }

 private:
  Vector still_;  // (n) zero
};

}  // namespace hurcules
