// From a stack to coordinate velocities: the first-order closed-loop inverse kinematics of [T
// §4.3.1].
//
//   y_k = -K g_k + ds_des/dt, bounded              [T 4.3.2], task_speed.hpp, dead_zone.hpp
//   J qdot <= (s_upper - s) / T                    [T 4.3.9], horizon T as a gain
//   qdot* = lexicographic minimum of the levels    [T 4.3.3]
//   q*(t + dt) = q*(t) + qdot* dt                  [T 4.3.7]
//
// A level made of one task that bounds the coordinates becomes simple bounds, together with the
// velocity and acceleration limits (rate_interval.hpp). All other levels are rows with the gain K
// on both sides of their interval; those that bound accelerations (Task::bounds_acceleration) bound how
// J qdot changes.
#pragma once

#include <optional>
#include <vector>

#include "hurcules/control/dead_zone.hpp"
#include "hurcules/control/level_diagnostics.hpp"
#include "hurcules/control/limit_rows.hpp"
#include "hurcules/control/rate_changes.hpp"
#include "hurcules/control/rate_interval.hpp"
#include "hurcules/control/stack_problem.hpp"
#include "hurcules/control/task_speed.hpp"
#include "hurcules/control/torque_scaling.hpp"
#include "hurcules/tasks/joint_ranges.hpp"

namespace hurcules {

struct VelocityControllerOptions {
  double dt = 1e-3;       // [s] control period
  double gain = 5.0;      // [1/s] K of [T 4.3.2]
  double horizon = 0.05;  // [s] T of [T 4.3.9]: a limit is approached at distance / T at most
  double max_acceleration = 20.0;  // [rad/s^2] of every coordinate; inf for none
  // position, velocity and acceleration limits of all coordinates come before all levels, also where
  // a stack names no JointLimits; false: only where it names them
  bool enforce_limits = true;
  double return_speed = 0.2;  // [rad/s] of a coordinate that is driven back into its limits
  // [s] after set_stack or take_over in motion: what the velocity was, less what the new stack asks
  // for, fades out in this time, inside the limits; meanwhile it disturbs every task. 0: none, the
  // velocity then changes as fast as max_acceleration lets it, at once where no level has limits.
  double transition = 0.2;
  // Thesis: wants solver.handover = Smooth, so that the velocity does not jump where a task loses a
  // direction. Arrive does not jump by itself, and wants Strict.
  Law law = Law::Arrive;
  SolverOptions solver = {};
};

class VelocityController {
 public:
  VelocityController(const Robot& robot, VelocityControllerOptions options = {});
  // takes over another stack, in motion too (transition); the memory for its hierarchy is made
  // here, never in compute. False, and nothing changes, where it is the one that it has.
  bool set_stack(const Stack& stack);
  // measures the tasks at the robot's configuration, builds the levels, solves: qdot* (n) [rad/s]
  const Vector& compute(const Robot& robot);
  // the two parts of compute, for those who time them
  void measure(const Robot& robot);  // tasks -> hierarchy
  const Vector& solve();             // hierarchy -> qdot*
  // after solve: qdot* within what the motors can hold (torque_scaling.hpp), but no sooner than position
  // and velocity limits; true when it changed. Under Law::Arrive it slows down no faster than
  // accelerations and the limits of the first levels allow: a robot that stops at once tips over. A
  // coordinate that is pushed follows at once.
  bool scale_velocity(const VelocityBounds& window);
  // q* += qdot* dt, (n) [rad], ball joints turn; rounding never carries a coordinate over its limit
  void integrate(VectorRef q) const;  // [T 4.3.7]
  // compute, then moves the robot by one period, q* = integrate(q*): (n) [rad]
  const Vector& step(Robot& robot);

  [[nodiscard]] const Stack& stack() const { return problem_.stack(); }
  [[nodiscard]] const Hierarchy& hierarchy() const { return problem_.hierarchy(); }
  [[nodiscard]] const Solution& solution() const { return solver_.solution(); }
  [[nodiscard]] const Vector& velocity() const { return velocity_; }  // the last qdot*
  [[nodiscard]] const VelocityControllerOptions& options() const { return options_; }
  // what each level fell short of at the last compute, and why; makes its texts when asked
  [[nodiscard]] std::vector<LevelDiagnostics> diagnostics(const Robot& robot) const;
  // -1, 0, 1 a coordinate: held back by its lower position limit, by none, by its upper one; (n)
  [[nodiscard]] const Eigen::VectorXi& active_limits() const { return active_limits_; }
  // the coordinate limits that hold, null when none do; to narrow a range, say
  [[nodiscard]] const JointLimits* limits() const { return problem_.limits(); }
  [[nodiscard]] JointLimits* limits() { return problem_.limits(); }
  void reset();  // at rest, cold
  // goes on at this velocity (n), cold, with a transition
  void take_over(const Vector& velocity);
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void fill_bounds(const JointLimits& limits, Level& level);
  void fill_rows(std::size_t k);
  void hold_limits();
  void brake();
  [[nodiscard]] double reach_time() const;
  void begin_transition();
  void add_transition();

  VelocityControllerOptions options_;
  RateLimits rates_;  // of a row, which has no speed limit
  std::vector<RotationVector> rotations_;
  JointLimits own_limits_;    // those of the robot
  JointRanges joint_ranges_;  // the same
  StackProblem problem_;
  Reachable reachable_;  // by the limits of the coordinates
  Solver solver_;
  TorqueScaling scaling_;
  std::size_t leading_limits_ = 0;  // levels from the first on that are limits
  std::vector<double> weights_;     // w of each level, of the last measure (task_speed.hpp)
  std::vector<double> gains_;       // K / max(1, F) [1/s] of each level, the same
  RateChanges changes_;
  DeadZone dead_zone_;
  std::optional<SaddleProbe> probe_;  // by the law that arrives
  Vector velocity_;
  Vector next_;          // [rad], (n): q* after a step
  mutable Vector step_;  // scratch, (n)
  Vector offset_;        // [rad/s] (n) of the transition, at its start
  double age_ = -1.0;    // [s] of the transition; < 0: it begins with the next solve
  bool fading_ = false;
  Vector lower_, upper_;                 // scratch for hold_limits, as many as a level has rows
  std::vector<RateInterval> intervals_;  // (n), of the last measure
  Eigen::VectorXi active_limits_;
};

}  // namespace hurcules
