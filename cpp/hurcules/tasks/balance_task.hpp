// The centre of mass stays over a polygon, and can be stopped there: an inequality a side.
//
//   e_i = n_i . (c - p_i) [m] (k),   J = n_i' J_com (k, n);   margin <= e_i
// c: centre of mass of the whole tree, p_i: corners, n_i: level inward normals, both in the axes of
// the reference (the world, or the body that the robot stands on). A limit that is approached no faster
// than edot = -omega (e - margin), omega = sqrt(g / h): so the capture point c + cdot / omega keeps the
// margin as well, and what stops the robot keeps its zero moment point there (zero_moment_task.hpp).
#pragma once

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct BalanceTaskOptions {
  Matrix polygon;              // (k, 2) [m] corners of a convex polygon, in either turn
  double margin = 0.05;        // [m] kept from its sides
  double height = 0.0;         // [m] of the polygon, z in the axes of the reference
  std::string reference = "";  // frame whose axes the corners are in, "" = the world
  Index room = 0;              // a row each for so many corners of later polygons, at least k
};

class BalanceTask : public Task {
 public:
  BalanceTask(std::string name, const Robot& robot, const BalanceTaskOptions& options);
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<BalanceTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "m"; }

  void update(const Robot& robot) override;
  [[nodiscard]] std::optional<Frame> reference_frame() const override { return reference_.frame(); }
  // another polygon from the next update on, after a step say: (k', 2), k' <= rows; the rows that
  // are left over ask for nothing
  void set_polygon(const Matrix& corners);
  [[nodiscard]] Index sides() const { return sides_; }  // k'
  // there is no target: hold and advance change nothing
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override;
  void restore(StateReader& reader) override;
  [[nodiscard]] bool rows_apart() const override { return true; }
  [[nodiscard]] bool is_limit() const override { return true; }

 private:
  Index sides_ = 0;
  Matrix corners_, normals_;  // (rows, 2), 0 beyond the sides
  Reference reference_;
  PointMotion com_;
};

}  // namespace hurcules
