// One angle of an axis that is fixed in a frame: its elevation (pitch of a lower arm, of the
// pelvis) or its heading (the torso looks forward).
//
//   a = R_RF axis;  elevation s = atan2(a_z, |(a_x, a_y)|),  heading s = atan2(a_y, a_x)  [rad]
//   e = s - s_des, heading wrapped to [-pi, pi]                          [T §4.4], its g_hpitch
//   J = ds/da [-a]x J_w,RF (1, n)
// R is the reference: the world, whose z is up, or a frame of the robot. Singular where the axis is
// along z of R: there the heading has no value and the elevation turns back; within 1.1 degrees of
// it J fades to zero.
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

enum class AngleKind { Elevation, Heading };

struct AngleTaskOptions {
  AngleKind kind = AngleKind::Elevation;
  Vector3 axis = Vector3::UnitX();  // in the frame; made a unit vector
  std::string reference = "";       // frame in which the angle is measured, "" = the world
};

class AngleTask : public ValueTask {
 public:
  // throws Error for a frame that does not exist, or that no coordinate moves against its reference
  AngleTask(std::string name, const Robot& robot, const std::string& frame,
            const AngleTaskOptions& options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<AngleTask>(*this);
  }
  [[nodiscard]] std::optional<Frame> reference_frame() const override { return reference_.frame(); }

 private:
  void measure(const Robot& robot) override;

  AngleKind kind_;
  Vector3 axis_;
  Frame frame_;
  Reference reference_;
  RotationMotion rotation_;
  PointMotion direction_;
};

}  // namespace hurcules
