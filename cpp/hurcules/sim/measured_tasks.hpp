// The tasks of a controller at the robot as it is, with the targets that they have now. Each is
// measured when somebody looks.
#pragma once

#include <memory>
#include <vector>

#include "hurcules/control/whole_body_controller.hpp"

namespace hurcules {

class MeasuredTasks {
 public:
  explicit MeasuredTasks(const WholeBodyController& controller);

  void forget() { fresh_.assign(fresh_.size(), false); }  // the robot has moved
  // throws Error for a number that there is not
  const Task& at(std::size_t number, const Robot& world);
  void measure(const Robot& world);  // all of them

  [[nodiscard]] const std::vector<const Task*>& planned() const { return planned_; }
  [[nodiscard]] const std::vector<const Task*>& all() const { return measured_; }

 private:
  std::vector<std::unique_ptr<Task>> own_;
  std::vector<const Task*> planned_, measured_;
  std::vector<bool> fresh_;
  std::vector<double> scratch_;
};

}  // namespace hurcules
