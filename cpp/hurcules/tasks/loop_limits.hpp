// The ranges of joints that follow the coordinates in loops (robot/closures.hpp).
//
//   e = q_f [rad] or [m] (m),  J = rows of G (m, n),  lower <= q_f <= upper
// There is no target: hold and advance change nothing.
#pragma once

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class LoopLimits : public Task {
 public:
  // of the joints that have a range; no row for a robot without such joints
  LoopLimits(std::string name, const Robot& robot);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<LoopLimits>(*this);
  }

  void update(const Robot& robot) override;
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }
  [[nodiscard]] bool is_limit() const override { return true; }
  [[nodiscard]] std::string row_name(const Robot& robot, Index row) const override;

 private:
  std::vector<Index> followers_;  // (m)
};

}  // namespace hurcules
