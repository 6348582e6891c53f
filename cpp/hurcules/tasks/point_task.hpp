// A point of the robot at a target: the common part of PositionTask and CenterOfMassTask.
//
//   e = A p_RF - s_des [m] (m),  J = A J_RF (m, n)                       [T 4.3.2]
// p_RF is the point in the axes of the reference R (the world, or a frame of the robot that may
// move too), A picks 1 to 3 directions.
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/value_task.hpp"

namespace hurcules {

struct PointTaskOptions {
  std::string reference = "";  // frame in which the point is measured, "" = the world
  Matrix axes = Matrix3::
      Identity();  // A (m, 3), m = 1 to 3: rows in the axes of the reference, of any length
};

class PointTask : public ValueTask {
 public:
  // p_RF [m] at the last update, all three components
  [[nodiscard]] const Vector3& position() const { return point_.position; }
  // [m] in W where the point was at the last update, and the nearest one that meets the target
  [[nodiscard]] Vector3 world_position() const;
  [[nodiscard]] Vector3 world_target() const;
  [[nodiscard]] std::string unit() const override { return "m"; }
  [[nodiscard]] double lever() const final;
  [[nodiscard]] std::optional<Frame> reference_frame() const override { return reference_.frame(); }

 protected:
  PointTask(std::string name, const Robot& robot, PointTaskOptions options);
  // the point in W
  virtual void measure_point(const Robot& robot, PointMotion& point) = 0;

  [[nodiscard]] const Reference& reference() const { return reference_; }
  // other directions from now on, (m, 3) of length 1 in the axes of the reference; the value stays
  void turn_axes(const Matrix& axes);
  void save_axes(StateWriter& writer) const;
  void restore_axes(StateReader& reader);

 private:
  void measure(const Robot& robot) final;

  Matrix axes_;
  Vector shift_;  // [m] (m) of the value, by axes that were turned
  Reference reference_;
  PointMotion point_;
};

}  // namespace hurcules
