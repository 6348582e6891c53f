#include "hurcules/tasks/custom_task.hpp"

#include <algorithm>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

CustomTask::CustomTask(std::string name, const Robot& robot, Index rows, Measure measure,
                       std::string unit)
    : ValueTask(std::move(name), std::max(rows, Index{0}), robot),
      measure_(std::move(measure)),
      unit_(std::move(unit)) {
  require_number(rows > 0, "rows of task '" + name_ + "' want a number >= 1",
                 static_cast<double>(rows));
  require(static_cast<bool>(measure_), "task '" + name_ + "' wants a function that measures");
  CustomTask::hold(robot);
}

void CustomTask::measure(const Robot& robot) {
  value_.setZero();
  jacobian_.setZero();
  drift_.setZero();
  measure_(robot, value_, jacobian_, drift_);
}

}  // namespace hurcules
