#include "hurcules/tasks/value_task.hpp"

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"

namespace hurcules {

ValueTask::ValueTask(std::string name, Index rows, const Robot& robot, bool wraps)
    : Task(std::move(name), rows, robot),
      value_(Vector::Zero(rows)),
      target_(Vector::Zero(rows)),
      wraps_(wraps) {}

void ValueTask::update(const Robot& robot) {
  require_robot(robot);
  measure(robot);
  error_ = value_ - target_;
  for (Index row = 0; wraps_ && row < rows(); ++row) error_[row] = wrap_angle(error_[row]);
}

void ValueTask::hold(const Robot& robot) {
  require_robot(robot);
  measure(robot);
  target_ = value_;
  target_is_set_ = false;
  error_.setZero();
  velocity_des_.setZero();
  acceleration_des_.setZero();
}

void ValueTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  velocity_des_ = velocity;
  if (const double share = max_lead_.share(error_, velocity); share < 1.0) velocity_des_ *= share;
  acceleration_des_.setZero();
  target_ += velocity_des_ * dt;
}

void ValueTask::back_calculate(double share) {
  target_ += share * error_;
}

void ValueTask::lead_target(const ConstVectorRef& step, double dt) {
  velocity_des_ = step / dt;
  advance(velocity_des_, dt);
}

void ValueTask::set_target(const ConstVectorRef& target) {
  require_rows(target, "target");
  target_ = target;
  target_is_set_ = true;
  velocity_des_.setZero();
  acceleration_des_.setZero();
}

void ValueTask::set_reference(const ConstVectorRef& target, const ConstVectorRef& velocity,
                              const ConstVectorRef& acceleration) {
  require_rows(target, "target");
  require_rows(velocity, "velocity");
  require_rows(acceleration, "acceleration");
  target_ = target;
  target_is_set_ = true;
  velocity_des_ = velocity;
  acceleration_des_ = acceleration;
}

void ValueTask::save(StateWriter& writer) const {
  Task::save(writer);
  writer.put(target_);
}

void ValueTask::restore(StateReader& reader) {
  Task::restore(reader);
  reader.get(target_);
}

}  // namespace hurcules
