// Three rows that turn a frame to a target orientation.
//
//   e = log(R_RF R_des^T) [rad] (3), |e| <= pi: the turn from target to frame, in the axes of R
//   J = Jl^-1(e) J_w,RF (3, n),  velocity_des = Jr^-1(e) w_des           [T §4.3.2], its g_lhor
//   acceleration_des = Jr^-1(e) dw_des/dt, exact where the frame is at its target
// R is the reference: the world, or a frame of the robot. The Jacobian is exact for large errors
// too (pose.hpp), so de/dt = J qdot - velocity_des holds everywhere but at |e| = pi, where e jumps
// to -e (all numbers stay bounded).
#pragma once

#include <string>

#include "hurcules/base/state.hpp"
#include "hurcules/tasks/max_lead.hpp"
#include "hurcules/tasks/reference.hpp"

namespace hurcules {

class RotationTarget {
 public:
  explicit RotationTarget(const Robot& robot) : motion_(robot) {}

  void measure(const Robot& robot, Frame frame, const Reference& reference);
  // rows of what was measured last: e, (3, n), and the drift of de/dt [rad/s^2]
  void find_rows(VectorRef error, MatrixRef jacobian, VectorRef drift) const;
  // velocity_des [rad/s] and acceleration_des [rad/s^2] at this error
  void feed_forward(const Vector3& error, VectorRef velocity, VectorRef acceleration) const;

  // stays where it is
  void rest();
  // to what was measured last
  void take();
  // turns by exp(velocity dt), less far where max_lead holds it; [rad/s] in the axes of R
  void advance(const Vector3& error, const Vector3& velocity, double dt);
  // R_des, w_des [rad/s] and its rate [rad/s^2] in the axes of R; throws Error, with the task's name,
  // unless it is a rotation
  void set(const Matrix3& target, const Vector3& velocity, const Vector3& acceleration,
           const std::string& task);

  [[nodiscard]] const Matrix3& target() const { return target_; }                   // R_des
  [[nodiscard]] const Matrix3& orientation() const { return motion_.orientation; }  // R_RF
  MaxLead max_lead;                                                                 // [rad]
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  RotationMotion motion_;
  Matrix3 target_ = Matrix3::Identity();
  Vector3 turn_ = Vector3::Zero();       // w_des [rad/s], in the axes of R
  Vector3 turn_rate_ = Vector3::Zero();  // its rate [rad/s^2]
};

}  // namespace hurcules
