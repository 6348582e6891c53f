#include "hurcules/tasks/rotation_target.hpp"

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

void RotationTarget::measure(const Robot& robot, Frame frame, const Reference& reference) {
  motion_.measure(robot, frame);
  reference.express(motion_);
}

void RotationTarget::find_rows(VectorRef error, MatrixRef jacobian, VectorRef drift) const {
  const Vector3 e = rotation_log(motion_.orientation * target_.transpose());
  const Matrix3 gain = left_jacobian_inverse(e);
  const Vector3 rate = gain * motion_.velocity;
  error = e;
  jacobian.noalias() = gain.lazyProduct(motion_.jacobian);
  drift = gain * motion_.drift + left_jacobian_inverse_rate(e, rate, motion_.velocity);
}

void RotationTarget::feed_forward(const Vector3& error, VectorRef velocity,
                                  VectorRef acceleration) const {
  const Matrix3 gain = right_jacobian_inverse(error);
  velocity = gain * turn_;
  acceleration = gain * turn_rate_;
}

void RotationTarget::rest() {
  turn_.setZero();
  turn_rate_.setZero();
}

void RotationTarget::take() {
  target_ = motion_.orientation;
}

void RotationTarget::advance(const Vector3& error, const Vector3& velocity, double dt) {
  turn_ = velocity * max_lead.share(error, velocity);
  turn_rate_.setZero();
  // normalised, or an hour of small turns would stretch it; at rest it keeps its bits
  if (turn_.squaredNorm() == 0) return;
  target_ = Eigen::Quaterniond(rotation_exp(turn_ * dt) * target_).normalized().toRotationMatrix();
}

void RotationTarget::set(const Matrix3& target, const Vector3& velocity,
                         const Vector3& acceleration, const std::string& task) {
  if (!is_rotation(target)) throw Error("target of task '" + task + "' wants a rotation matrix");
  target_ = target;
  turn_ = velocity;
  turn_rate_ = acceleration;
}

void RotationTarget::save(StateWriter& writer) const {
  for (Index i = 0; i < 9; ++i) writer.put(target_(i));
  writer.put(turn_);
  writer.put(turn_rate_);
}

void RotationTarget::restore(StateReader& reader) {
  for (Index i = 0; i < 9; ++i) target_(i) = reader.get();
  reader.get(turn_);
  reader.get(turn_rate_);
}

}  // namespace hurcules
