// The pose of a frame at a target pose: position and orientation in one.
//
//   e = [p_RF - p_des; e_r]  [m], [rad] (6),  J = [J_RF; J_r] (6, n)      [T 4.3.2]
// e_r and J_r: rotation_target.hpp.
// R is the reference: the world, or a frame of the robot, which may move too: a hand in the other
// hand, say (RelativePoseTask). Rows and signs are those of PositionTask and OrientationTask; turns
// are three times as fast [rad/s] as max_speed [m/s].
#pragma once

#include "hurcules/tasks/max_lead.hpp"
#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/rotation_target.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct PoseTaskOptions {
  std::string reference = "";  // frame in which the pose is measured, "" = the world
};

class PoseTask : public Task {
 public:
  // throws Error for a frame that does not exist, or that no coordinate moves against its reference
  PoseTask(std::string name, const Robot& robot, const std::string& frame,
           const PoseTaskOptions& options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<PoseTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "m and rad"; }

  void update(const Robot& robot) override;
  [[nodiscard]] std::optional<Frame> reference_frame() const override { return reference_.frame(); }
  void hold(const Robot& robot) override;
  // moves the target by velocity dt: [m/s] (3), then [rad/s] (3), in the axes of R
  void advance(const ConstVectorRef& velocity, double dt) override;
  // of the way of the position; the target's orientation stays
  void back_calculate(double share) override;
  [[nodiscard]] ConstVectorRef yielding_target() const override { return p_des_; }
  void lead_target(const ConstVectorRef& step, double dt) override;
  [[nodiscard]] Index target_size() const override { return 6; }
  // keeps `advance` from leading the target further than this from the frame: [m], and three times
  // as many [rad]; inf, the default: anywhere; see MaxLead
  void set_max_lead(double max_lead);
  [[nodiscard]] double max_lead() const { return max_lead_.value(); }
  void assign_target(const ConstVectorRef& target) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] const Vector3& target_position() const { return p_des_; }  // [m] in R
  [[nodiscard]] const Matrix3& target_orientation() const {                // in R
    return rotation_.target();
  }
  // at rest; seen at the next update; throws Error unless finite, and a rotation
  void set_target(const Vector3& position, const Matrix3& orientation);
  // where a trajectory is now: the pose, its velocity ([m/s], [rad/s]) and its acceleration, (6) in
  // the axes of R, fed forward until the next call that moves the target
  void set_reference(const Vector3& position, const Matrix3& orientation,
                     const ConstVectorRef& velocity, const ConstVectorRef& acceleration);
  // p_RF [m], R_RF at the last update
  [[nodiscard]] const Vector3& position() const { return point_.position; }
  [[nodiscard]] const Matrix3& orientation() const { return rotation_.orientation(); }
  // the frame and its target in W, where R was at the last update: [m], R_W
  [[nodiscard]] Vector3 world_position() const {
    return reference_.point_in_world(point_.position);
  }
  [[nodiscard]] Vector3 world_target() const { return reference_.point_in_world(p_des_); }
  [[nodiscard]] Matrix3 world_target_orientation() const {
    return reference_.rotation_in_world(rotation_.target());
  }

 private:
  void feed_turn_forward();

  Frame frame_;
  Reference reference_;
  PointMotion point_;
  RotationTarget rotation_;
  Vector3 p_des_ = Vector3::Zero();
  MaxLead max_lead_;  // [m]
};

// the pose of a frame in another frame of the robot
class RelativePoseTask : public PoseTask {
 public:
  RelativePoseTask(std::string name, const Robot& robot, const std::string& frame,
                   const std::string& reference)
      : PoseTask(std::move(name), robot, frame, {reference}) {}
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<RelativePoseTask>(*this);
  }
};

}  // namespace hurcules
