#include "hurcules/tasks/posture_task.hpp"

namespace hurcules {

PostureTask::PostureTask(std::string name, const Robot& robot,
                         const std::vector<std::string>& coordinates)
    : ValueTask(std::move(name),
                coordinates.empty() ? robot.size() - robot.root_size()
                                    : static_cast<Index>(coordinates.size()),
                robot) {
  for (const std::string& coordinate : coordinates)
    selected_.push_back(robot.coordinate(coordinate));
  for (Index i = robot.root_size(); coordinates.empty() && i < robot.size(); ++i)
    selected_.push_back(i);
  for (Index row = 0; row < rows(); ++row) jacobian_(row, selected_[row]) = 1;
  max_speed_ = 1.0;
  PostureTask::hold(robot);
}

void PostureTask::measure(const Robot& robot) {
  for (Index row = 0; row < rows(); ++row) value_[row] = robot.configuration()[selected_[row]];
}

}  // namespace hurcules
