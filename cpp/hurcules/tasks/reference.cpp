#include "hurcules/tasks/reference.hpp"

#include <Eigen/Geometry>

#include "hurcules/base/error.hpp"
#include "hurcules/robot/left_out.hpp"

namespace hurcules {

namespace {

// what the coordinates never move: the support of a root that they do not move either
bool stands(const Robot& robot, Frame frame) {
  return frame == robot.support() && robot.root_qpos() >= 0 && !robot.floating();
}

}  // namespace

void PointMotion::measure(const Robot& robot, Frame frame) {
  position = robot.position(frame);
  robot.position_jacobian(frame, jacobian);
  velocity.noalias() = jacobian * robot.velocity();
  drift = robot.position_drift(frame);
}

void PointMotion::measure_com(const Robot& robot) {
  position = robot.com();
  robot.com_jacobian(jacobian);
  velocity.noalias() = jacobian * robot.velocity();
  drift = robot.com_drift();
}

void PointMotion::rest_at(const Vector3& point) {
  position = point;
  velocity.setZero();
  drift.setZero();
  jacobian.setZero();
}

void RotationMotion::measure(const Robot& robot, Frame frame) {
  orientation = robot.view_orientation(frame);
  robot.rotation_jacobian(frame, jacobian);
  velocity.noalias() = jacobian * robot.velocity();
  drift = robot.rotation_drift(frame);
}

void RotationMotion::direction(const Vector3& axis, PointMotion& result) const {
  const Vector3 a = orientation * axis;
  result.position = a;
  result.velocity = velocity.cross(a);
  result.drift = drift.cross(a) + velocity.cross(result.velocity);
  for (Index i = 0; i < jacobian.cols(); ++i)
    result.jacobian.col(i) = Vector3(jacobian.col(i)).cross(a);
}

Reference::Reference(const Robot& robot, const std::string& name)
    : origin_(robot), rotation_(robot) {
  if (!name.empty()) frame_ = robot.frame(name);
}

Reference::Reference(const Robot& robot, Frame frame)
    : frame_(frame), origin_(robot), rotation_(robot) {}

void Reference::require_moved(const Robot& robot, const std::string& frame,
                              const std::string& task) const {
  const Frame moved = robot.frame(frame);
  if (frame_ ? robot.moves(moved, *frame_) : robot.moves(moved)) return;
  std::string text = "task '" + task + "' wants a frame that the coordinates move, none moves '";
  text += frame + (frame_ ? "' against its reference" : "'");
  if (const std::string held = left_out(robot); !held.empty()) text += "; " + held;
  throw Error(text);
}

void Reference::measure(const Robot& robot) {
  if (!frame_) return;
  if (stands(robot, *frame_)) {
    origin_.rest_at(robot.position(*frame_));
    rotation_.orientation = robot.view_orientation(*frame_);
    rotation_.velocity.setZero();
    rotation_.drift.setZero();
    rotation_.jacobian.setZero();
    return;
  }
  origin_.measure(robot, *frame_);
  rotation_.measure(robot, *frame_);
}

Vector3 Reference::point_in_world(const Vector3& p_R) const {
  return frame_ ? Vector3(origin_.position + rotation_.orientation * p_R) : p_R;
}

Matrix3 Reference::rotation_in_world(const Matrix3& R_R) const {
  return frame_ ? Matrix3(rotation_.orientation * R_R) : R_R;
}

void Reference::express_state(PointMotion& point) const {
  if (!frame_) return;
  const Matrix3 R = rotation_.orientation.transpose();
  const Vector3& w = rotation_.velocity;
  const Vector3 r = point.position - origin_.position;
  const Vector3 v = point.velocity - origin_.velocity;
  const Vector3 a = point.drift - origin_.drift;
  // r in turning axes: Euler, Coriolis and centrifugal terms
  point.drift = R * (a - rotation_.drift.cross(r) - 2 * w.cross(v) + w.cross(w.cross(r)));
  point.velocity = R * (v - w.cross(r));
  point.position = R * r;
}

void Reference::express(PointMotion& point) const {
  if (!frame_) return;
  const Matrix3 R = rotation_.orientation.transpose();
  const Vector3 r = point.position - origin_.position;
  express_state(point);
  for (Index i = 0; i < point.jacobian.cols(); ++i) {
    const Vector3 turn = rotation_.jacobian.col(i);
    const Vector3 shift = point.jacobian.col(i) - origin_.jacobian.col(i);
    point.jacobian.col(i) = R * (shift - turn.cross(r));
  }
}

void Reference::express(RotationMotion& rotation) const {
  if (!frame_) return;
  const Matrix3 R = rotation_.orientation.transpose();
  const Vector3& w = rotation_.velocity;
  rotation.drift = R * (rotation.drift - rotation_.drift - w.cross(rotation.velocity));
  rotation.velocity = R * (rotation.velocity - w);
  rotation.orientation = R * rotation.orientation;
  for (Index i = 0; i < rotation.jacobian.cols(); ++i) {
    const Vector3 turn = rotation.jacobian.col(i) - rotation_.jacobian.col(i);
    rotation.jacobian.col(i) = R * turn;
  }
}

}  // namespace hurcules
