#include "hurcules/tasks/orientation_task.hpp"

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

OrientationTask::OrientationTask(std::string name, const Robot& robot, const std::string& frame,
                                 const OrientationTaskOptions& options)
    : Task(std::move(name), 3, robot),
      frame_(robot.frame(frame)),
      reference_(robot, options.reference),
      rotation_(robot) {
  reference_.require_moved(robot, frame, name_);
  OrientationTask::hold(robot);
}

void OrientationTask::update(const Robot& robot) {
  require_robot(robot);
  reference_.measure(robot);
  rotation_.measure(robot, frame_);
  reference_.express(rotation_);

  const Vector3 e = rotation_log(rotation_.orientation * target_.transpose());
  const Matrix3 gain = left_jacobian_inverse(e);
  const Vector3 rate = gain * rotation_.velocity;
  error_ = e;
  jacobian_.noalias() = gain.lazyProduct(rotation_.jacobian);
  drift_ = gain * rotation_.drift + left_jacobian_inverse_rate(e, rate, rotation_.velocity);
  feed_forward();
}

void OrientationTask::feed_forward() {
  const Matrix3 gain = right_jacobian_inverse(error_);
  velocity_des_ = gain * turn_;
  acceleration_des_ = gain * turn_rate_;
}

void OrientationTask::hold(const Robot& robot) {
  turn_.setZero();
  turn_rate_.setZero();
  update(robot);
  target_ = rotation_.orientation;
  target_is_set_ = false;
  update(robot);
}

void OrientationTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  turn_ = velocity * max_lead_.share(error_, velocity);
  turn_rate_.setZero();
  feed_forward();
  // normalised, or an hour of small turns would stretch it; at rest it keeps its bits
  if (turn_.squaredNorm() == 0) return;
  target_ = Eigen::Quaterniond(rotation_exp(turn_ * dt) * target_).normalized().toRotationMatrix();
}

void OrientationTask::set_target(const Matrix3& target) {
  set_reference(target, Vector3::Zero(), Vector3::Zero());
}

void OrientationTask::set_reference(const Matrix3& target, const ConstVectorRef& velocity,
                                    const ConstVectorRef& acceleration) {
  if (!is_rotation(target)) throw Error("target of task '" + name_ + "' wants a rotation matrix");
  require_rows(velocity, "velocity");
  require_rows(acceleration, "acceleration");
  target_ = target;
  target_is_set_ = true;
  turn_ = velocity;
  turn_rate_ = acceleration;
  feed_forward();
}

void OrientationTask::assign_target(const ConstVectorRef& target) {
  require_size("target of task '" + name_ + "'", target.size(), target_size());
  set_target(rotation_exp(Vector3(target)));
}

void OrientationTask::save(StateWriter& writer) const {
  Task::save(writer);
  for (Index i = 0; i < 9; ++i) writer.put(target_(i));
  writer.put(turn_);
  writer.put(turn_rate_);
}

void OrientationTask::restore(StateReader& reader) {
  Task::restore(reader);
  for (Index i = 0; i < 9; ++i) target_(i) = reader.get();
  reader.get(turn_);
  reader.get(turn_rate_);
}

}  // namespace hurcules
