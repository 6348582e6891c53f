// The swivel angle of an arm: how far its plane (shoulder, elbow, wrist) is turned about the line
// from shoulder to wrist, against a reference plane through that line and a direction of the torso.
//
//   w, e = wrist and elbow from the shoulder, d = the direction, all in the axes of the torso
//   s = atan2(|w| w.(d x e), |w|^2 d.e - (w.d)(w.e))  [rad]              [T §4.3.2], its g_swivel
//   e = s - s_des wrapped to [-pi, pi], J = ds/de J_e + ds/dw J_w (1, n)
// s = 0: the elbow lies on the side of d; with d down and the arm forward, s > 0 lifts a left elbow
// outward and a right elbow inward. Singular where the arm is straight (no plane), w is along d (no
// reference plane) or w = 0: within 1.1 degrees of it J fades to zero, so that the arm lets go of
// it.
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

// Names of frames. The torso is a frame that the shoulder is mounted on.
struct SwivelTaskOptions {
  std::string shoulder = "", elbow = "", wrist = "", torso = "";
  Vector3 direction = -Vector3::UnitZ();  // d in the axes of the torso; made a unit vector
};

class SwivelTask : public ValueTask {
 public:
  SwivelTask(std::string name, const Robot& robot, const SwivelTaskOptions& options);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<SwivelTask>(*this);
  }

 private:
  void measure(const Robot& robot) override;

  Frame shoulder_frame_, elbow_frame_, wrist_frame_;
  Reference torso_;
  PointMotion shoulder_, elbow_, wrist_;
  Vector3 direction_;
};

}  // namespace hurcules
