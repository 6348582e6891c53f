// The orientation of a frame at a target orientation.
//
//   e = log(R_RF R_des^T) [rad] (3), |e| <= pi: the turn from target to frame, in the axes of R
//   J = Jl^-1(e) J_w,RF (3, n),  velocity_des = Jr^-1(e) w_des           [T §4.3.2], its g_lhor
//   acceleration_des = Jr^-1(e) dw_des/dt, exact where the frame is at its target
// R is the reference: the world, or a frame of the robot. The Jacobian is exact for large errors
// too (pose.hpp), so de/dt = J qdot - velocity_des holds everywhere but at |e| = pi, where e jumps
// to -e (all numbers stay bounded). Cameras: x along the line of sight, z up in the image.
#pragma once

#include "hurcules/tasks/max_lead.hpp"
#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct OrientationTaskOptions {
  std::string reference = "";  // frame in which the orientation is measured, "" = the world
};

class OrientationTask : public Task {
 public:
  // throws Error for a frame that does not exist, or that no coordinate moves against its reference
  OrientationTask(std::string name, const Robot& robot, const std::string& frame,
                  const OrientationTaskOptions& options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<OrientationTask>(*this);
  }

  void update(const Robot& robot) override;
  [[nodiscard]] std::optional<Frame> reference_frame() const override { return reference_.frame(); }
  void hold(const Robot& robot) override;
  // turns the target by exp(velocity dt); angular velocity in the axes of R [rad/s], (3)
  void advance(const ConstVectorRef& velocity, double dt) override;
  [[nodiscard]] Index target_size() const override { return 3; }
  // keeps `advance` from leading the target further than this from the frame [rad]; inf, the
  // default: anywhere; see MaxLead
  void set_max_lead(double max_lead) { max_lead_.set(max_lead, name_); }
  [[nodiscard]] double max_lead() const { return max_lead_.value(); }
  void assign_target(const ConstVectorRef& target) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] const Matrix3& target() const { return target_; }  // R_des in the reference
  // at rest; seen at the next update; throws Error unless it is a rotation
  void set_target(const Matrix3& target);
  // where a trajectory is now: R_des, w_des [rad/s] and its rate [rad/s^2] in the axes of R, (3) each,
  // fed forward until the next call that moves the target
  void set_reference(const Matrix3& target, const ConstVectorRef& velocity,
                     const ConstVectorRef& acceleration);
  // R_RF at the last update
  [[nodiscard]] const Matrix3& orientation() const { return rotation_.orientation; }

 private:
  void feed_forward();

  Frame frame_;
  Reference reference_;
  RotationMotion rotation_;
  Matrix3 target_ = Matrix3::Identity();
  Vector3 turn_ = Vector3::Zero();       // w_des [rad/s], in the axes of the reference
  Vector3 turn_rate_ = Vector3::Zero();  // its rate [rad/s^2]
  MaxLead max_lead_;
};

}  // namespace hurcules
