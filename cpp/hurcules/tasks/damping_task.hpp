// Coordinates at rest: a level that takes up what is left without pulling anywhere.
//
//   e = 0 [rad] or [m] (m),  J = rows of the identity (m, n):  0 = qdot
#pragma once

#include <vector>

#include "hurcules/tasks/task.hpp"

namespace hurcules {

class DampingTask : public Task {
 public:
  // coordinates by name; none = all of the robot
  DampingTask(std::string name, const Robot& robot,
              const std::vector<std::string>& coordinates = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<DampingTask>(*this);
  }

  void update(const Robot& robot) override { require_robot(robot); }
  // there is no target: hold changes nothing
  void hold(const Robot& robot) override { update(robot); }
  // the velocity that is asked for instead of rest, until the next call
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }
  [[nodiscard]] bool rows_apart() const override { return true; }
};

}  // namespace hurcules
