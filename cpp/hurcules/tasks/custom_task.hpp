// A task whose value somebody else measures: a function of the robot.
//
//   e = s(q) - s_des (m),  J = ds/dq (m, n),  drift = Jdot qdot (m), 0 where the function leaves it
#pragma once

#include <functional>

#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

class CustomTask : public ValueTask {
 public:
  // fills value (m), Jacobian (m, n) and drift (m) at the robot's configuration and velocity; all three
  // come as zeros. Copies of the task (the measured robot, batches on threads) call copies of it: what it
  // captures by reference they share.
  using Measure =
      std::function<void(const Robot& robot, VectorRef value, MatrixRef jacobian, VectorRef drift)>;
  // unit: of the value, told in diagnostics; throws Error without rows or without a function
  CustomTask(std::string name, const Robot& robot, Index rows, Measure measure,
             std::string unit = "");
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<CustomTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return unit_; }

 private:
  void measure(const Robot& robot) override;

  Measure measure_;
  std::string unit_;
};

}  // namespace hurcules
