// The zero moment point stays in a polygon: what the robot does in the air does not tip it over.
//
// About the line t_i through corner p_i of side i, gravity and inertia have the moment, a kilogram of
// the robot,
//   tau_i = u_i . (g - cddot) - t_i . Ldot / m  [m^2/s^2],   u_i = t_i x (c - p_i)
// positive while it presses the robot onto its polygon. With cddot = J_c qddot + Jdot_c qdot and L the
// angular momentum about c that is a row of qddot, an inequality a side, the only one of the tasks that
// bounds accelerations under both laws:
//   margin |g| <= tau_i
// c: centre of mass of the whole tree, g: gravity of the model. A robot without free root has no
// ground to tip over on; the row is the same.
#pragma once

#include <optional>

#include "hurcules/tasks/convex_polygon.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct ZeroMomentTaskOptions {
  Matrix polygon;              // (k, 2) [m] corners of a convex polygon, in either turn
  double margin = 0.03;        // [m] that the zero moment point keeps from the sides
  double height = 0.0;         // [m] of the polygon, z in the axes of the reference
  std::string reference = "";  // frame whose axes the corners are in, "" = the world
};

class ZeroMomentTask : public Task {
 public:
  // throws Error for a polygon that is not convex, numbers that are not finite, a model without
  // gravity
  ZeroMomentTask(std::string name, const Robot& robot, const ZeroMomentTaskOptions& options);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<ZeroMomentTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "m^2/s^2"; }

  // at the robot's configuration and velocity; error() is tau at constant velocity
  void update(const Robot& robot) override;
  // there is no target: hold and advance change nothing
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }
  [[nodiscard]] bool rows_apart() const override { return true; }
  [[nodiscard]] bool commands_acceleration() const override { return true; }
  [[nodiscard]] bool is_limit() const override { return true; }

 private:
  ConvexPolygon polygon_;
  double height_;
  std::optional<Frame> reference_;
  Matrix com_, spin_;  // (3, n) Jacobians
};

}  // namespace hurcules
