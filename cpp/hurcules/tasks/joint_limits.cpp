#include "hurcules/tasks/joint_limits.hpp"

#include <algorithm>

#include "hurcules/base/error.hpp"

namespace hurcules {

JointLimits::JointLimits(std::string name, const Robot& robot)
    : Task(std::move(name), robot.size(), robot),
      coordinates_(robot.coordinate_names()),
      robot_lower_(robot.size()),
      robot_upper_(robot.size()),
      max_velocity_(robot.size()) {
  for (Index i = 0; i < robot.size(); ++i) {
    robot_lower_[i] = robot.coordinates()[i].lower;
    robot_upper_[i] = robot.coordinates()[i].upper;
    max_velocity_[i] = robot.coordinates()[i].max_velocity;
  }
  jacobian_.setIdentity();
  reset_ranges();
  JointLimits::update(robot);
}

void JointLimits::update(const Robot& robot) {
  require_robot(robot);
  error_ = robot.configuration();
}

void JointLimits::advance(const ConstVectorRef& velocity, double /*dt*/) {
  require_rows(velocity, "velocity");
}

void JointLimits::set_range(const std::string& coordinate, double lower, double upper) {
  const Index i = index(coordinate);
  require_range(i, lower, upper);
  lower_[i] = lower;
  upper_[i] = upper;
}

void JointLimits::reset_ranges() {
  lower_ = robot_lower_;
  upper_ = robot_upper_;
}

void JointLimits::set_interval(const ConstVectorRef& lower, const ConstVectorRef& upper) {
  if (lower.size() == rows() && upper.size() == rows())
    for (Index i = 0; i < rows(); ++i) require_range(i, lower[i], upper[i]);
  Task::set_interval(lower, upper);
}

void JointLimits::set_max_velocity(const std::string& coordinate, double limit) {
  const Index i = index(coordinate);
  if (!(limit > 0))
    throw Error("velocity limit of coordinate '" + coordinate + "' wants to be above 0, " +
                std::to_string(limit) + " came");
  max_velocity_[i] = limit;
}

void JointLimits::set_max_velocities(const ConstVectorRef& limits) {
  if (limits.size() != rows())
    throw Error("velocity limits of '" + name_ + "' want " + std::to_string(rows()) + " values, " +
                std::to_string(limits.size()) + " came");
  for (Index i = 0; i < rows(); ++i)
    set_max_velocity(coordinates_[static_cast<std::size_t>(i)], limits[i]);
}

Index JointLimits::index(const std::string& coordinate) const {
  const auto found = std::find(coordinates_.begin(), coordinates_.end(), coordinate);
  if (found == coordinates_.end())
    throw Error(unknown_name("coordinate", coordinate, coordinates_));
  return found - coordinates_.begin();
}

void JointLimits::require_range(Index i, double lower, double upper) const {
  if (robot_lower_[i] <= lower && lower <= upper && upper <= robot_upper_[i]) return;
  throw Error("range of coordinate '" + coordinates_[i] + "' wants lower <= upper within " +
              std::to_string(robot_lower_[i]) + " .. " + std::to_string(robot_upper_[i]) +
              " of the robot, " + std::to_string(lower) + " .. " + std::to_string(upper) + " came");
}

void JointLimits::save(StateWriter& writer) const {
  Task::save(writer);
  writer.put(max_velocity_);
}

void JointLimits::restore(StateReader& reader) {
  Task::restore(reader);
  reader.get(max_velocity_);
}

}  // namespace hurcules
