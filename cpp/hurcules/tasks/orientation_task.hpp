// The orientation of a frame at a target orientation: the rows of rotation_target.hpp. Cameras: x
// along the line of sight, z up in the image.
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/rotation_target.hpp"
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
  void set_max_lead(double max_lead) { rotation_.max_lead.set(max_lead, name_); }
  [[nodiscard]] double max_lead() const { return rotation_.max_lead.value(); }
  void assign_target(const ConstVectorRef& target) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;

  [[nodiscard]] const Matrix3& target() const { return rotation_.target(); }  // R_des in R
  // at rest; seen at the next update; throws Error unless it is a rotation
  void set_target(const Matrix3& target);
  // where a trajectory is now: R_des, w_des [rad/s] and its rate [rad/s^2] in the axes of R, (3) each,
  // fed forward until the next call that moves the target
  void set_reference(const Matrix3& target, const ConstVectorRef& velocity,
                     const ConstVectorRef& acceleration);
  // R_RF at the last update
  [[nodiscard]] const Matrix3& orientation() const { return rotation_.orientation(); }

 private:
  Frame frame_;
  Reference reference_;
  RotationTarget rotation_;
};

}  // namespace hurcules
