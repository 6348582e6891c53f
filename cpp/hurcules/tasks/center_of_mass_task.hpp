// The centre of mass of the whole tree at a target, for instance over the tracks.
//
//   s = A p_RC(q) [m], J = A J_RC; own, not in the thesis
// Values, axes and reference: point_task.hpp. No singularity of its own.
#pragma once

#include "hurcules/tasks/point_task.hpp"

namespace hurcules {

using CenterOfMassTaskOptions = PointTaskOptions;

class CenterOfMassTask : public PointTask {
 public:
  CenterOfMassTask(std::string name, const Robot& robot, CenterOfMassTaskOptions options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<CenterOfMassTask>(*this);
  }

 private:
  void measure_point(const Robot& robot, PointMotion& point) override { point.measure_com(robot); }
};

}  // namespace hurcules
