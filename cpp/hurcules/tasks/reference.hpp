// How points and frames move, seen from the world or from a frame of the robot.
//
// The Jacobians belong to the coordinates, the drift is the part of the acceleration that remains
// when the coordinates do not accelerate.
#pragma once

#include <optional>

#include "hurcules/robot/robot.hpp"

namespace hurcules {

// A point or a direction (then without unit).
struct PointMotion {
  explicit PointMotion(const Robot& robot) : jacobian(Matrix::Zero(3, robot.size())) {}
  void measure(const Robot& robot, Frame frame);  // the origin of a frame, in W
  void measure_com(const Robot& robot);           // the centre of mass, in W
  void rest_at(const Vector3& point);             // a point fixed in W

  Vector3 position = Vector3::Zero();  // [m]
  Vector3 velocity = Vector3::Zero();  // [m/s]
  Vector3 drift = Vector3::Zero();     // [m/s^2]
  Matrix jacobian;                     // [m/rad], (3, n)
};

struct RotationMotion {
  explicit RotationMotion(const Robot& robot) : jacobian(Matrix::Zero(3, robot.size())) {}
  void measure(const Robot& robot, Frame frame);
  // the direction R * axis of an axis that is fixed in the frame
  void direction(const Vector3& axis, PointMotion& result) const;

  Matrix3 orientation = Matrix3::Identity();  // R
  Vector3 velocity = Vector3::Zero();         // [rad/s]
  Vector3 drift = Vector3::Zero();            // [rad/s^2]
  Matrix jacobian;                            // (3, n)
};

// The frame in which motions are expressed. Measure it, then express what was measured in W.
class Reference {
 public:
  // "" is the world
  Reference(const Robot& robot, const std::string& name);
  Reference(const Robot& robot, Frame frame);

  // throws Error where no coordinate moves the frame against this one
  void require_moved(const Robot& robot, const std::string& frame, const std::string& task) const;

  [[nodiscard]] const std::optional<Frame>& frame() const { return frame_; }
  void measure(const Robot& robot);
  void express(PointMotion& point) const;
  // position, velocity and drift alone: the Jacobian stays in W
  void express_state(PointMotion& point) const;
  void express(RotationMotion& rotation) const;
  [[nodiscard]] const RotationMotion& rotation() const { return rotation_; }  // in W
  // from R, where it was measured last, to W
  [[nodiscard]] Vector3 point_in_world(const Vector3& p_R) const;  // [m]
  [[nodiscard]] Matrix3 rotation_in_world(const Matrix3& R_R) const;

 private:
  std::optional<Frame> frame_;
  PointMotion origin_;
  RotationMotion rotation_;
};

}  // namespace hurcules
