// The ranges of joints that are no coordinate of their own: those that follow the coordinates in loops
// (robot/closures.hpp), and the angles of ball joints.
//
//   e = q_f [rad] or [m],  J = row of G (n),  lower <= q_f <= upper
//   e = |r|^2 / 2R [rad],  J = r' / R,  e <= R / 2     r: rotation vector of a ball joint, R: its range
// At the limit of a ball joint e moves as its angle does, and unlike the angle it is smooth at 0.
// There is no target: hold and advance change nothing.
#pragma once

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class JointRanges : public Task {
 public:
  // of the joints that have a range; no row for a robot without such joints
  JointRanges(std::string name, const Robot& robot);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<JointRanges>(*this);
  }

  void update(const Robot& robot) override;
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }
  [[nodiscard]] bool is_limit() const override { return true; }
  [[nodiscard]] std::string row_name(const Robot& robot, Index row) const override;

 private:
  void update_ball(const Robot& robot, Index row, const RotationVector& ball);

  std::vector<Index> followers_;       // their rows come first
  std::vector<RotationVector> balls_;  // then theirs
};

}  // namespace hurcules
