#include "hurcules/tasks/posture_task.hpp"

#include <algorithm>
#include <iterator>

#include "hurcules/base/pose.hpp"

namespace hurcules {

namespace {

std::string unit_of(const Robot& robot, const std::vector<Index>& selected) {
  const auto slides = std::count_if(selected.begin(), selected.end(), [&](Index i) {
    return robot.coordinates()[static_cast<std::size_t>(i)].unit == "m";
  });
  if (slides == 0) return "rad";
  return slides == std::ssize(selected) ? "m" : "m and rad";
}

}  // namespace

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
  unit_ = unit_of(robot, selected_);
  max_speed_ = 1.0;
  PostureTask::hold(robot);
}

void PostureTask::measure(const Robot& robot) {
  for (Index row = 0; row < rows(); ++row) value_[row] = robot.configuration()[selected_[row]];
  for (const RotationVector& rotation : robot.rotations()) {
    const Vector3 r = robot.configuration().segment<3>(rotation.first);
    const Vector3 w = robot.velocity().segment<3>(rotation.first);
    const Matrix3 rate = right_jacobian_inverse(r);
    const Vector3 drift = left_jacobian_inverse_rate(-r, -rate * w, w);
    for (Index row = 0; row < rows(); ++row) {
      const Index part = selected_[row] - rotation.first;
      if (part < 0 || part >= 3) continue;
      jacobian_.row(row).segment<3>(rotation.first) = rate.row(part);
      drift_[row] = drift[part];
    }
  }
}

}  // namespace hurcules
