// From a stack to coordinate velocities: the first-order closed-loop inverse kinematics of [T §4.3.1].
//
//   y_k = -K g_k + ds_des/dt                       [T 4.3.2]
//   J qdot <= (s_upper - s) / T                    [T 4.3.9], horizon T as a gain (solver.md §7)
//   qdot* = lexicographic minimum of the levels    [T 4.3.3]
//   q*(t + dt) = q*(t) + qdot* dt                  [T 4.3.7]
#pragma once

#include "hurcules/control/stack.hpp"
#include "hurcules/solver/solver.hpp"

namespace hurcules {

struct VelocityControllerOptions {
  double dt = 1e-3;        // [s] control period
  double gain = 5.0;       // [1/s] K of [T 4.3.2]
  double horizon = 0.05;   // [s] T of [T 4.3.9]: a limit is approached no faster than distance / horizon
  double max_acceleration = 20.0;  // [rad/s^2] of every coordinate; inf for none
  SolverOptions solver;
};

class VelocityController {
 public:
  VelocityController(const Robot& robot, VelocityControllerOptions options = {});
  // takes over another stack; the memory for its hierarchy is made here, never in compute
  void set_stack(const Stack& stack);
  // measures the tasks at the robot's configuration, builds the levels, solves: qdot* (n) [rad/s]
  const Vector& compute(const Robot& robot);
  // the three parts of compute, for those who time them
  void measure(const Robot& robot);      // tasks -> hierarchy
  const Vector& solve();                 // hierarchy -> qdot*

  [[nodiscard]] const Stack& stack() const;
  [[nodiscard]] const Hierarchy& hierarchy() const;
  [[nodiscard]] const Solution& solution() const;
  [[nodiscard]] const Vector& velocity() const;  // the last qdot*
  [[nodiscard]] const VelocityControllerOptions& options() const;
  void reset();  // at rest, cold
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);
};

}  // namespace hurcules
