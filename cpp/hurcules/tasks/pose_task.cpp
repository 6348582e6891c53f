#include "hurcules/tasks/pose_task.hpp"

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
  rotation_.measure(robot, frame_, reference_);
  reference_.express(point_);

  error_.head<3>() = point_.position - p_des_;
  jacobian_.topRows<3>() = point_.jacobian;
  drift_.head<3>() = point_.drift;

  rotation_.find_rows(error_.tail<3>(), jacobian_.bottomRows<3>(), drift_.tail<3>());
  feed_turn_forward();
}

void PoseTask::feed_turn_forward() {
  rotation_.feed_forward(error_.tail<3>(), velocity_des_.tail<3>(), acceleration_des_.tail<3>());
}

void PoseTask::hold(const Robot& robot) {
  rotation_.rest();
  velocity_des_.setZero();
  acceleration_des_.setZero();
  update(robot);
  p_des_ = point_.position;
  rotation_.take();
  target_is_set_ = false;
  update(robot);
}

void PoseTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  velocity_des_.head<3>() =
      velocity.head<3>() * max_lead_.share(error_.head<3>(), velocity.head<3>());
  acceleration_des_.setZero();
  rotation_.advance(error_.tail<3>(), velocity.tail<3>(), dt);
  feed_turn_forward();
  p_des_ += velocity_des_.head<3>() * dt;
}

void PoseTask::set_max_lead(double max_lead) {
  max_lead_.set(max_lead, name_);
  rotation_.max_lead.set(kTurnShare * max_lead, name_);
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
  require_rows(velocity, "velocity");
  require_rows(acceleration, "acceleration");
  rotation_.set(orientation, velocity.tail<3>(), acceleration.tail<3>(), name_);
  p_des_ = position;
  target_is_set_ = true;
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
  rotation_.save(writer);
}

void PoseTask::restore(StateReader& reader) {
  Task::restore(reader);
  reader.get(p_des_);
  rotation_.restore(reader);
}

}  // namespace hurcules
