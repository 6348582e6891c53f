// Coordinates at chosen positions.
//
//   e = q_selected - q_des [rad] or [m] (m),  J = rows of the identity (m, n)    [T 4.3.2]
// Linear: exact everywhere, without drift. Of a rotation vector r (ball joint, free root) rdot = Jr^-1(r) w
// stands in place of the identity; e jumps where the joint turns beyond pi.
#pragma once

#include <vector>

#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

class PostureTask : public ValueTask {
 public:
  // coordinates by name, in this order; none = all of the robot but those of a free root
  PostureTask(std::string name, const Robot& robot,
              const std::vector<std::string>& coordinates = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<PostureTask>(*this);
  }

  [[nodiscard]] bool rows_apart() const override { return true; }
  [[nodiscard]] std::string unit() const override { return unit_; }

 private:
  void measure(const Robot& robot) override;

  std::vector<Index> selected_;
  std::string unit_;
};

}  // namespace hurcules
