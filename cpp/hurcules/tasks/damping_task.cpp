#include "hurcules/tasks/damping_task.hpp"

namespace hurcules {

DampingTask::DampingTask(std::string name, const Robot& robot,
                         const std::vector<std::string>& coordinates)
    : Task(std::move(name),
           coordinates.empty() ? robot.size() : static_cast<Index>(coordinates.size()), robot) {
  for (Index row = 0; row < rows(); ++row) {
    const bool all = coordinates.empty();
    jacobian_(row, all ? row : robot.coordinate(coordinates[static_cast<std::size_t>(row)])) = 1.0;
  }
  max_speed_ = 1.0;
}

void DampingTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  velocity_des_ = velocity;
}

}  // namespace hurcules
