#include "hurcules/tasks/swivel_task.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/angle.hpp"

namespace hurcules {
namespace {

VectorJet between(const PointMotion& from, const PointMotion& to) {
  return {to.position - from.position, to.velocity - from.velocity, to.drift - from.drift};
}

VectorJet cross(const Vector3& a, const VectorJet& b) {
  return {a.cross(b.value), a.cross(b.rate), a.cross(b.acceleration)};
}

// The angle and its gradients along elbow and wrist.
struct Swivel {
  Jet angle;
  Vector3 by_elbow, by_wrist;  // [rad/m]
};

Swivel swivel(const Vector3& d, const VectorJet& e, const VectorJet& w) {
  const VectorJet direction{d, Vector3::Zero(), Vector3::Zero()};
  const double reach = std::max(w.value.norm(), kShort);
  const double least = kFade * reach * reach * std::max(e.value.norm(), kShort);
  const Jet square = dot(w, w), length = root(square, kShort);
  const Jet triple = dot(w, cross(d, e));
  const Jet de = dot(direction, e), wd = dot(w, direction), we = dot(w, e);
  const Jet y = length * triple, x = square * de - wd * we;

  // gradients of y and x, then of atan2(y, x)
  const Vector3 y_e = length.value * w.value.cross(d);
  const Vector3 y_w = triple.value / reach * w.value + length.value * d.cross(e.value);
  const Vector3 x_e = square.value * d - wd.value * w.value;
  const Vector3 x_w = 2 * de.value * w.value - we.value * d - wd.value * e.value;
  const double size = std::max(x.value * x.value + y.value * y.value, least * least);
  return {arc_tangent(y, x, least), (x.value * y_e - y.value * x_e) / size,
          (x.value * y_w - y.value * x_w) / size};
}

}  // namespace

SwivelTask::SwivelTask(std::string name, const Robot& robot, const SwivelTaskOptions& options)
    : ValueTask(std::move(name), 1, robot, true),
      shoulder_frame_(robot.frame(options.shoulder)),
      elbow_frame_(robot.frame(options.elbow)),
      wrist_frame_(robot.frame(options.wrist)),
      torso_(robot, robot.frame(options.torso)),
      shoulder_(robot),
      elbow_(robot),
      wrist_(robot),
      direction_(options.direction.normalized()) {
  require(direction_.allFinite() && direction_.norm() > 0.5,
          "direction of task '" + name_ + "' wants to be finite and not zero");
  SwivelTask::hold(robot);
}

void SwivelTask::measure(const Robot& robot) {
  torso_.measure(robot);
  shoulder_.measure(robot, shoulder_frame_);
  elbow_.measure(robot, elbow_frame_);
  wrist_.measure(robot, wrist_frame_);
  const Vector3 to_elbow = elbow_.position - shoulder_.position;
  const Vector3 to_wrist = wrist_.position - shoulder_.position;
  for (PointMotion* point : {&shoulder_, &elbow_, &wrist_}) torso_.express_state(*point);

  const Swivel now = swivel(direction_, between(shoulder_, elbow_), between(shoulder_, wrist_));
  value_[0] = now.angle.value;
  drift_[0] = now.angle.acceleration;
  // the gradients in W, and what the turning torso takes away
  const RotationMotion& torso = torso_.rotation();
  const Vector3 by_elbow = torso.orientation * now.by_elbow;
  const Vector3 by_wrist = torso.orientation * now.by_wrist;
  const Vector3 by_shoulder = -by_elbow - by_wrist;
  const Vector3 by_turn = -to_elbow.cross(by_elbow) - to_wrist.cross(by_wrist);
  for (Index i = 0; i < jacobian_.cols(); ++i)
    jacobian_(0, i) = by_elbow.dot(elbow_.jacobian.col(i)) + by_wrist.dot(wrist_.jacobian.col(i)) +
                      by_shoulder.dot(shoulder_.jacobian.col(i)) +
                      by_turn.dot(torso.jacobian.col(i));
}

}  // namespace hurcules
