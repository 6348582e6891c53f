#include "hurcules/tasks/pose_task.hpp"

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

constexpr double kTurnShare = 3.0;  // 1.5 rad/s beside 0.5 m/s

}  // namespace

PoseTask::PoseTask(std::string name, const Robot& robot, const std::string& frame,
                   const PoseTaskOptions& options)
    : Task(std::move(name), 6, robot),
      frame_(robot.frame(frame)),
      reference_(robot, options.reference),
      point_(robot),
      rotation_(robot) {
  reference_.require_moved(robot, frame, name_);
  max_speed_ = 0.5;
  speed_shares_.tail<3>().setConstant(kTurnShare);
  PoseTask::hold(robot);
}

void PoseTask::update(const Robot& robot) {
  require_robot(robot);
  reference_.measure(robot);
  point_.measure(robot, frame_);
  rotation_.measure(robot, frame_);
  reference_.express(point_);
  reference_.express(rotation_);

  error_.head<3>() = point_.position - p_des_;
  jacobian_.topRows<3>() = point_.jacobian;
  drift_.head<3>() = point_.drift;

  const Vector3 e = rotation_log(rotation_.orientation * R_des_.transpose());
  const Matrix3 gain = left_jacobian_inverse(e);
  const Vector3 rate = gain * rotation_.velocity;
  error_.tail<3>() = e;
  jacobian_.bottomRows<3>().noalias() = gain.lazyProduct(rotation_.jacobian);
  drift_.tail<3>() =
      gain * rotation_.drift + left_jacobian_inverse_rate(e, rate, rotation_.velocity);
  feed_turn_forward();
}

void PoseTask::feed_turn_forward() {
  const Matrix3 gain = right_jacobian_inverse(error_.tail<3>());
  velocity_des_.tail<3>() = gain * turn_;
  acceleration_des_.tail<3>() = gain * turn_rate_;
}

void PoseTask::hold(const Robot& robot) {
  turn_.setZero();
  turn_rate_.setZero();
  velocity_des_.setZero();
  acceleration_des_.setZero();
  update(robot);
  p_des_ = point_.position;
  R_des_ = rotation_.orientation;
  target_is_set_ = false;
  update(robot);
}

void PoseTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  turn_ = velocity.tail<3>() * max_turn_.share(error_.tail<3>(), velocity.tail<3>());
  velocity_des_.head<3>() =
      velocity.head<3>() * max_lead_.share(error_.head<3>(), velocity.head<3>());
  turn_rate_.setZero();
  acceleration_des_.setZero();
  feed_turn_forward();
  p_des_ += velocity_des_.head<3>() * dt;
  // normalised, or an hour of small turns would stretch it; at rest it keeps its bits
  if (turn_.squaredNorm() == 0) return;
  R_des_ = Eigen::Quaterniond(rotation_exp(turn_ * dt) * R_des_).normalized().toRotationMatrix();
}

void PoseTask::set_max_lead(double max_lead) {
  max_lead_.set(max_lead, name_);
  max_turn_.set(kTurnShare * max_lead, name_);
}

void PoseTask::back_calculate(double share) {
  p_des_ += share * error_.head<3>();
}

void PoseTask::lead_target(const ConstVectorRef& step, double dt) {
  velocity_des_ << step / dt, Vector3::Zero();
  advance(velocity_des_, dt);
}

void PoseTask::set_target(const Vector3& position, const Matrix3& orientation) {
  const Eigen::Matrix<double, 6, 1> rest = Eigen::Matrix<double, 6, 1>::Zero();
  set_reference(position, orientation, rest, rest);
}

void PoseTask::set_reference(const Vector3& position, const Matrix3& orientation,
                             const ConstVectorRef& velocity, const ConstVectorRef& acceleration) {
  require_values(position, "target");
  if (!is_rotation(orientation))
    throw Error("target of task '" + name_ + "' wants a rotation matrix");
  require_rows(velocity, "velocity");
  require_rows(acceleration, "acceleration");
  p_des_ = position;
  R_des_ = orientation;
  target_is_set_ = true;
  turn_ = velocity.tail<3>();
  turn_rate_ = acceleration.tail<3>();
  velocity_des_.head<3>() = velocity.head<3>();
  acceleration_des_.head<3>() = acceleration.head<3>();
  feed_turn_forward();
}

void PoseTask::assign_target(const ConstVectorRef& target) {
  require_size("target of task '" + name_ + "'", target.size(), target_size());
  set_target(target.head<3>(), rotation_exp(Vector3(target.tail<3>())));
}

void PoseTask::save(StateWriter& writer) const {
  Task::save(writer);
  writer.put(p_des_);
  for (Index i = 0; i < 9; ++i) writer.put(R_des_(i));
  writer.put(turn_);
  writer.put(turn_rate_);
}

void PoseTask::restore(StateReader& reader) {
  Task::restore(reader);
  reader.get(p_des_);
  for (Index i = 0; i < 9; ++i) R_des_(i) = reader.get();
  reader.get(turn_);
  reader.get(turn_rate_);
}

}  // namespace hurcules
