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
  // throws Error without rows or without a function
  CustomTask(std::string name, const Robot& robot, Index rows, Measure measure);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<CustomTask>(*this);
  }

 private:
  void measure(const Robot& robot) override;

  Measure measure_;
};

}  // namespace hurcules
