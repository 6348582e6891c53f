#include "hurcules/tasks/gaze_task.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "hurcules/base/values.hpp"
#include "hurcules/tasks/angle.hpp"

namespace hurcules {
namespace {

// unit vector of given yaw and pitch, x ahead and z up
Vector3 direction(double yaw, double pitch) {
  return {std::cos(pitch) * std::cos(yaw), std::cos(pitch) * std::sin(yaw), std::sin(pitch)};
}

}  // namespace

GazeTask::GazeTask(std::string name, const Robot& robot, const std::string& frame)
    : Task(std::move(name), 2, robot),
      frame_(robot.frame(frame)),
      camera_(robot, frame_),
      seen_(robot) {
  Reference(robot, "").require_moved(robot, frame, name_);
  GazeTask::reset(robot);
}

void GazeTask::reset(const Robot& robot) {
  target_ = robot.position(frame_) + robot.view_orientation(frame_).col(0);
  target_is_set_ = false;
  velocity_des_.setZero();
  GazeTask::update(robot);
  error_.setZero();
}

void GazeTask::update(const Robot& robot) {
  require_robot(robot);
  camera_.measure(robot);
  position_ = robot.position(frame_);
  orientation_ = robot.view_orientation(frame_);
  seen_.rest_at(target_);
  camera_.express(seen_);

  const Angle yaw = azimuth(seen_), pitch = elevation(seen_);
  error_ << -yaw.value, -pitch.value;
  drift_ << -yaw.drift, -pitch.drift;
  jacobian_.row(0).noalias() = -yaw.gradient.transpose().lazyProduct(seen_.jacobian);
  jacobian_.row(1).noalias() = -pitch.gradient.transpose().lazyProduct(seen_.jacobian);
}

void GazeTask::hold(const Robot& robot) {
  require_robot(robot);
  const double distance = std::max((target_ - robot.position(frame_)).norm(), kShort);
  target_ = robot.position(frame_) + distance * robot.view_orientation(frame_).col(0);
  target_is_set_ = false;
  velocity_des_.setZero();
  update(robot);
}

void GazeTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  velocity_des_ = velocity;
  turn(velocity[0] * dt, velocity[1] * dt);
}

void GazeTask::back_calculate(double share) {
  turn(share * error_[0], share * error_[1]);
}

// the target around the camera of the last update, by these angles [rad]
void GazeTask::turn(double by_yaw, double by_pitch) {
  const Vector3 seen = orientation_.transpose() * (target_ - position_);
  const double yaw = std::atan2(seen.y(), seen.x()) + by_yaw;
  const double pitch = std::atan2(seen.z(), std::hypot(seen.x(), seen.y())) + by_pitch;
  // beyond the zenith the target would come back on the other side
  constexpr double kQuarter = std::numbers::pi / 2;
  const double held = std::clamp(pitch, -kQuarter, kQuarter);
  target_ = position_ + seen.norm() * (orientation_ * direction(yaw, held));
}

void GazeTask::lead_target(const ConstVectorRef& step, double /*dt*/) {
  target_ += step;
  velocity_des_.setZero();
}

void GazeTask::assign_target(const ConstVectorRef& target) {
  require_size("target of task '" + name_ + "'", target.size(), target_size());
  set_target(Vector3(target));
}

void GazeTask::set_target(const Vector3& target) {
  require_values(target, "target");
  target_ = target;
  target_is_set_ = true;
  velocity_des_.setZero();
}

void GazeTask::save(StateWriter& writer) const {
  Task::save(writer);
  writer.put(target_);
  writer.put(position_);
  for (Index i = 0; i < 9; ++i) writer.put(orientation_(i));
}

void GazeTask::restore(StateReader& reader) {
  Task::restore(reader);
  reader.get(target_);
  reader.get(position_);
  for (Index i = 0; i < 9; ++i) orientation_(i) = reader.get();
}

}  // namespace hurcules
