// A body that keeps its place on what it stands on, and the forces that this may take: for
// controllers of acceleration.
//
//   J qddot + Jdot qdot = -L J qdot        its points neither slide nor lift; there is no target (m)
//   F_p = sum_e lambda_pe e, lambda >= 0   e: the edges of a pyramid inside the friction cone
//   torque = M qddot + h - sum_p J_p' F_p  what the drives give beside it (acceleration_controller.hpp)
// Three points or more hold the body in 6-D, one or two hold themselves. The forces are unknowns
// of the hierarchy; a controller adds its columns where it finds a ContactTask in a stack.
#pragma once

#include <string>
#include <vector>

#include "hurcules/tasks/reference.hpp"
#include "hurcules/tasks/task.hpp"

namespace hurcules {

struct ContactTaskOptions {
  // [m] in the body's frame; none: its sole_points as the robot stands, drawn in by a tenth so that
  // it does not tip over its edge
  std::vector<Vector3> points = {};
  double friction = 0.6;              // Coulomb's coefficient
  Vector3 normal = Vector3::UnitZ();  // in W, out of what it stands on
};

class ContactTask : public Task {
 public:
  static constexpr Index kEdges = 4;  // of a pyramid

  // throws Error for a friction that is not positive, a normal or points that are not finite
  ContactTask(std::string name, const Robot& robot, const std::string& body,
              ContactTaskOptions options = {});
  [[nodiscard]] std::unique_ptr<Task> clone() const override {
    return std::make_unique<ContactTask>(*this);
  }
  [[nodiscard]] std::string unit() const override { return "m/s^2"; }

  void update(const Robot& robot) override;
  void hold(const Robot& robot) override { update(robot); }
  void advance(const ConstVectorRef& velocity, double dt) override;
  void save(StateWriter& writer) const override { Task::save(writer); }
  void restore(StateReader& reader) override { Task::restore(reader); }

  [[nodiscard]] const ContactTaskOptions& options() const { return options_; }
  // f: how many edges all its points have
  [[nodiscard]] Index edges() const { return kEdges * static_cast<Index>(options_.points.size()); }
  // J_p' e: efforts of the coordinates for a force of 1 N along each edge, (n, f), of the last update
  [[nodiscard]] const Matrix& efforts() const { return efforts_; }
  // F in W [N] of lambda (f), over all points
  [[nodiscard]] Vector3 force(const ConstVectorRef& lambda) const;

 private:
  ContactTask(std::string name, const Robot& robot, Frame body, ContactTaskOptions options);

  ContactTaskOptions options_;  // complete
  Frame body_;
  Vector3 centre_ = Vector3::Zero();        // [m] of the points, in the body's frame
  Eigen::Matrix<double, 3, kEdges> along_;  // edges in W
  Matrix efforts_, point_;                  // (n, f); scratch (3, n)
};

}  // namespace hurcules
