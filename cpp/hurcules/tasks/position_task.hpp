// The origin of a frame at a target position: hand, pelvis, or one hand relative to the other.
//
//   s = A p_RF(q) [m], J = A J_RF                                        [T §4.3.2]: g_lhpos, g_pel
// Values, axes and reference: point_task.hpp. No singularity of its own.
#pragma once

#include "hurcules/tasks/point_task.hpp"

namespace hurcules {

using PositionTaskOptions = PointTaskOptions;

class PositionTask : public PointTask {
 public:
  // throws Error for a frame that does not exist, or that no coordinate moves against its reference
  PositionTask(std::string name, const Robot& robot, const std::string& frame,
               PositionTaskOptions options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<PositionTask>(*this);
  }

 private:
  void measure_point(const Robot& robot, PointMotion& point) override {
    point.measure(robot, frame_);
  }

  Frame frame_;
};

}  // namespace hurcules
