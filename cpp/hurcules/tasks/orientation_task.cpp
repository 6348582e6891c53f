#include "hurcules/tasks/orientation_task.hpp"

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
  rotation_.measure(robot, frame_, reference_);
  rotation_.find_rows(error_, jacobian_, drift_);
  rotation_.feed_forward(error_, velocity_des_, acceleration_des_);
}

void OrientationTask::hold(const Robot& robot) {
  rotation_.rest();
  update(robot);
  rotation_.take();
  target_is_set_ = false;
  update(robot);
}

void OrientationTask::advance(const ConstVectorRef& velocity, double dt) {
  require_rows(velocity, "velocity");
  require_time(dt);
  rotation_.advance(error_, velocity, dt);
  rotation_.feed_forward(error_, velocity_des_, acceleration_des_);
}

void OrientationTask::set_target(const Matrix3& target) {
  set_reference(target, Vector3::Zero(), Vector3::Zero());
}

void OrientationTask::set_reference(const Matrix3& target, const ConstVectorRef& velocity,
                                    const ConstVectorRef& acceleration) {
  require_rows(velocity, "velocity");
  require_rows(acceleration, "acceleration");
  rotation_.set(target, velocity, acceleration, name_);
  target_is_set_ = true;
  rotation_.feed_forward(error_, velocity_des_, acceleration_des_);
}

void OrientationTask::assign_target(const ConstVectorRef& target) {
  require_size("target of task '" + name_ + "'", target.size(), target_size());
  set_target(rotation_exp(Vector3(target)));
}

void OrientationTask::save(StateWriter& writer) const {
  Task::save(writer);
  rotation_.save(writer);
}

void OrientationTask::restore(StateReader& reader) {
  Task::restore(reader);
  rotation_.restore(reader);
}

}  // namespace hurcules
