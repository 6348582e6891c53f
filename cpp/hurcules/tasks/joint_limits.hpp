// The ranges of the coordinates, first of all priorities.
//
//   e = q [rad] or [m] (n),  J = I (n, n),  lower <= q <= upper           [T 4.3.8]: g_joint
// There is no target: hold and advance change nothing. A controller that sees bounds_coordinates()
// turns the interval and max_velocity() into simple bounds of its unknowns.
#pragma once

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class JointLimits : public Task {
 public:
  // starts with the ranges and the velocity limits of the robot, inf where it has none
  JointLimits(std::string name, const Robot& robot);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<JointLimits>(*this);
  }

  void update(const Robot& robot) override;
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] bool bounds_coordinates() const override { return true; }

  // a narrower range of one coordinate, for a mode of work; [rad] or [m]
  void set_range(const std::string& coordinate, double lower, double upper);
  // the ranges of the robot again
  void reset_ranges();
  // throws Error unless within the ranges of the robot
  void set_interval(const ConstVectorRef& lower, const ConstVectorRef& upper) override;

  [[nodiscard]] const Vector& max_velocity() const { return max_velocity_; }  // [rad/s], (n)
  void set_max_velocity(const std::string& coordinate, double limit);         // [rad/s] or [m/s]
  void set_max_velocities(const ConstVectorRef& limits);  // of all, (n); inf for none

 private:
  [[nodiscard]] Index index(const std::string& coordinate) const;
  void require_range(Index i, double lower, double upper) const;

  std::vector<std::string> coordinates_;
  Vector robot_lower_, robot_upper_;  // [rad] or [m], (n)
  Vector max_velocity_;
};

}  // namespace hurcules
