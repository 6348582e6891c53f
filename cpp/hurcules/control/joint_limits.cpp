#include "hurcules/control/joint_limits.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = 1e20;  // from here on a side is infinite

}  // namespace

JointLimits::JointLimits(std::string name, const Robot& robot)
    : name_(std::move(name)),
      identity_(robot.identity()),
      coordinates_(robot.coordinate_names()),
      robot_lower_(robot.size()),
      robot_upper_(robot.size()),
      robot_velocity_(robot.size()),
      configuration_(robot.configuration()) {
  for (Index i = 0; i < robot.size(); ++i) {
    const Coordinate& coordinate = robot.coordinates()[static_cast<std::size_t>(i)];
    of_root_.push_back(i < robot.root_size());
    of_ball_.push_back(i >= robot.root_size() && coordinate.joints.front().part >= 0);
    robot_lower_[i] = of_ball_.back() ? -kNone : coordinate.lower;
    robot_upper_[i] = of_ball_.back() ? kNone : coordinate.upper;
    robot_velocity_[i] = coordinate.max_velocity;
  }
  max_velocity_ = robot_velocity_;
  reset_ranges();
}

void JointLimits::update(const Robot& robot) {
  if (robot.identity() != identity_)
    throw Error("limits '" + name_ + "' were made for another robot: " + robot.differs(identity_));
  configuration_ = robot.configuration();
}

void JointLimits::save(StateWriter& writer) const {
  for (const Vector* vector : {&lower_, &upper_, &max_velocity_}) writer.put(*vector);
}

void JointLimits::restore(StateReader& reader) {
  for (Vector* vector : {&lower_, &upper_, &max_velocity_}) reader.get(*vector);
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
  require_size(lower.size(), "lower sides");
  require_size(upper.size(), "upper sides");
  for (Index i = 0; i < size(); ++i) require_range(i, lower[i], upper[i]);
  lower_ = lower;
  upper_ = upper;
}

void JointLimits::set_max_velocity(const std::string& coordinate, double limit) {
  const Index i = index(coordinate);
  if (!(limit > 0))
    throw Error("velocity limit of coordinate '" + coordinate + "' wants to be above 0, " +
                std::to_string(limit) + " came");
  max_velocity_[i] = limit == kNone ? kNone : std::min(limit, robot_velocity_[i]);
}

void JointLimits::set_max_velocities(const ConstVectorRef& limits) {
  require_size(limits.size(), "velocity limits");
  for (Index i = 0; i < size(); ++i)
    set_max_velocity(coordinates_[static_cast<std::size_t>(i)], limits[i]);
}

RateState JointLimits::state(Index i, double velocity) const {
  return {lower_[i] - configuration_[i], upper_[i] - configuration_[i], velocity};
}

RateLimits JointLimits::rates(Index i, const RateLimits& controller) const {
  RateLimits rates = controller;
  rates.max_velocity = max_velocity_[i];
  if (of_root_[static_cast<std::size_t>(i)]) rates.max_acceleration = kNone;
  return rates;
}

double JointLimits::held_step(Index i, double step) const {
  return std::clamp(step, std::min(lower_[i] - configuration_[i], 0.0),
                    std::max(upper_[i] - configuration_[i], 0.0));
}

void JointLimits::add_held_step(const std::vector<RotationVector>& rotations, Vector& step,
                                VectorRef q) const {
  for (Index i = 0; i < size(); ++i) step[i] = held_step(i, step[i]);
  add_step(rotations, step, q);
  hold_ranges(rotations, configuration_, q);
}

Index JointLimits::index(const std::string& coordinate) const {
  const auto found = std::find(coordinates_.begin(), coordinates_.end(), coordinate);
  if (found == coordinates_.end())
    throw Error(unknown_name("coordinate", coordinate, coordinates_));
  return found - coordinates_.begin();
}

void JointLimits::require_size(Index size, const char* what) const {
  if (size == lower_.size()) return;
  throw Error(std::string(what) + " of '" + name_ + "' want " + std::to_string(lower_.size()) +
              " values, " + std::to_string(size) + " came");
}

void JointLimits::require_range(Index i, double lower, double upper) const {
  require(!of_ball_[static_cast<std::size_t>(i)] || (lower == -kNone && upper == kNone),
          "'" + coordinates_[static_cast<std::size_t>(i)] +
              "' is one of three coordinates of a ball joint and has no range of its own");
  const bool holds_numbers = lower < kNoNumber && upper > -kNoNumber;
  if (robot_lower_[i] <= lower && lower <= upper && upper <= robot_upper_[i] && holds_numbers)
    return;
  throw Error("range of coordinate '" + coordinates_[static_cast<std::size_t>(i)] +
              "' wants lower <= upper within " + std::to_string(robot_lower_[i]) + " .. " +
              std::to_string(robot_upper_[i]) + " of the robot, " + std::to_string(lower) + " .. " +
              std::to_string(upper) + " came");
}

}  // namespace hurcules
