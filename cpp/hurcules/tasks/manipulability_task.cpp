#include "hurcules/tasks/manipulability_task.hpp"

#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

namespace {

constexpr double kDelta = 1e-3;  // [m/rad] least singular value that is told apart from 0
// [rad] of differences of fourth order: the Jacobian is right to 1e-8, the drift to 1e-6
constexpr double kStep = 2e-4;

}  // namespace

ManipulabilityTask::ManipulabilityTask(std::string name, const Robot& robot,
                                       const std::string& frame, ManipulabilityTaskOptions options)
    : ValueTask(std::move(name), 1, robot),
      frame_(robot.frame(frame)),
      axes_(std::move(options.axes)),
      turns_(options.turns),
      probe_(robot.model(), robot.coordinate_names()),
      linear_(Matrix::Zero(3, robot.size())),
      angular_(Matrix::Zero(3, robot.size())),
      q_(robot.size()),
      step_(robot.size()) {
  require(axes_.cols() == 3 && axes_.rows() >= 1 && axes_.rows() <= 3 && axes_.allFinite(),
          "axes of task '" + name_ + "' want shape (1 to 3, 3) and finite values");
  require(robot.moves(frame_),
          "task '" + name_ + "': no coordinate moves the frame '" + frame + "'");
  const Index m = axes_.rows() + (turns_ ? 3 : 0);
  rows_.setZero(m, robot.size());
  gram_.setIdentity(m, m);
  factor_.compute(gram_);
  max_speed_ = 0.1;
  ManipulabilityTask::hold(robot);
}

ManipulabilityTask::ManipulabilityTask(const ManipulabilityTask& other)
    : ValueTask(other),
      frame_(other.frame_),
      axes_(other.axes_),
      turns_(other.turns_),
      probe_(other.probe_.model(), other.probe_.coordinate_names()),
      linear_(other.linear_),
      angular_(other.angular_),
      rows_(other.rows_),
      gram_(other.gram_),
      factor_(other.factor_),
      q_(other.q_),
      step_(other.step_) {}

double ManipulabilityTask::volume(const Robot& robot) {
  robot.position_jacobian(frame_, linear_);
  robot.rotation_jacobian(frame_, angular_);
  rows_.topRows(axes_.rows()).noalias() = axes_.lazyProduct(linear_);
  if (turns_) rows_.bottomRows<3>() = angular_;
  gram_.noalias() = rows_.lazyProduct(rows_.transpose());
  gram_.diagonal().array() += kDelta * kDelta;
  factor_.compute(gram_);
  return factor_.matrixLLT().diagonal().prod();
}

double ManipulabilityTask::volume_at(const Vector& q) {
  probe_.set_configuration(q);
  return volume(probe_);
}

void ManipulabilityTask::measure(const Robot& robot) {
  probe_.set_qpos(robot.qpos());
  if (probe_.support() != robot.support()) probe_.stand_on(robot.support());
  // all else depends on the Jacobians as they are now
  jacobian_.setZero();
  value_[0] = volume(robot);
  for (Index i = 0; i < q_.size(); ++i)
    jacobian_(0, i) = linear_.col(i).squaredNorm() + angular_.col(i).squaredNorm();
  const Vector& q = robot.configuration();
  for (Index i = 0; i < q.size(); ++i) {
    if (jacobian_(0, i) == 0.0) continue;  // it does not move the frame
    const auto at = [&](double steps) {
      q_ = q;
      step_.setZero();
      step_[i] = steps * kStep;
      add_step(robot.rotations(), step_, q_);
      return volume_at(q_);
    };
    jacobian_(0, i) = (8 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12 * kStep);
  }
  drift_.setZero();
  const double speed = robot.velocity().norm();
  if (speed == 0.0) return;
  const double h = kStep / speed;  // [s]
  const auto at = [&](double steps) {
    q_ = q;
    step_ = steps * h * robot.velocity();
    add_step(robot.rotations(), step_, q_);
    return volume_at(q_);
  };
  drift_[0] = (16 * (at(1) + at(-1)) - 30 * value_[0] - (at(2) + at(-2))) / (12 * h * h);
}

}  // namespace hurcules
