// From a stack to coordinate accelerations: second-order closed-loop inverse kinematics, for joint
// servos (integrated) or for drives that take torques (inverse dynamics) [T §5.3].
//
//   y_k = L (v_k - J qdot) + d2s_des/dt2 - dJ/dt qdot               [T 5.3.17], its dot restored
//   v_k = -(K / L) g_k + ds_des/dt, bounded                         task_speed.hpp, dead_zone.hpp
//   qddot* = lexicographic minimum of the levels                    [T 5.3.18]
//   qdot* += qddot* dt,  q* += qdot* dt + qddot* dt^2 / 2           [T 5.6.50]
//
// The limits of the coordinates become simple bounds that brake in time
// (acceleration_interval.hpp). A task that commands accelerations has a law of its own: torque
// limits, force control. With `rest` D the unknown is qddot + D qdot: what regularisation takes
// from a weak direction, and a direction that no task holds, then brakes as exp(-D t) instead of
// going on at its speed. A row with a side above or below asks for  -L dg/dt + K (side - g):
// critically damped, it comes from inside to its side without passing it. Contacts in the stack bring
// their forces and the torque limits along (contact_forces.hpp): then the robot is the real one.
#pragma once

#include <optional>
#include <vector>

#include "hurcules/control/acceleration_interval.hpp"
#include "hurcules/control/contact_forces.hpp"
#include "hurcules/control/dead_zone.hpp"
#include "hurcules/control/level_diagnostics.hpp"
#include "hurcules/control/rate_changes.hpp"
#include "hurcules/control/stack_problem.hpp"
#include "hurcules/control/task_speed.hpp"
#include "hurcules/control/torque_scaling.hpp"
#include "hurcules/tasks/joint_ranges.hpp"

namespace hurcules {

struct AccelerationControllerOptions {
  double dt = 1e-3;                // [s] control period
  double stiffness = 100;          // [1/s^2] K of [T 5.3.13]
  double damping = 20;             // [1/s] L of [T 5.3.13]; 2 sqrt(K) is critical
  double horizon = 0.05;           // [s] T of acceleration_interval.hpp
  double max_acceleration = 20.0;  // [rad/s^2] of every coordinate; inf for none
  // position, velocity and acceleration limits of all coordinates come before all levels, also where
  // a stack names no JointLimits; false: only where it names them
  bool enforce_limits = true;
  double return_speed = 0.2;  // [rad/s] of a coordinate that is driven back into its limits
  double rest = 10.0;         // [1/s] D above; sqrt(K) stops a swing, 0 as in the thesis
  // share of the model's dry friction (0 to 1) that torque adds, the way that qdot + qddot / L leads
  double friction = 1.0;
  // Thesis: wants rest = 0 and solver.handover = Smooth, so that the acceleration does not jump
  // where a task loses a direction. Arrive wants Strict.
  Law law = Law::Arrive;
  SolverOptions solver = {};
};

class AccelerationController {
 public:
  AccelerationController(const Robot& robot, AccelerationControllerOptions options = {});
  // takes over another stack; the memory for its hierarchy is made here, never in compute. False, and
  // nothing changes, where it is the one that it has.
  bool set_stack(const Stack& stack);
  // measures the tasks at the robot's configuration and velocity, builds the levels, solves:
  // qddot* (n) [rad/s^2]. The robot is the reference (servos) or the real one (torques).
  const Vector& compute(const Robot& robot);
  // the two parts of compute, for those who time them
  void measure(const Robot& robot);  // tasks -> hierarchy
  const Vector& solve();             // hierarchy -> qddot*
  // after solve: a velocity (n) that, one dt further, is within what the motors can hold
  // (torque_scaling.hpp), sooner than accelerations but no sooner than velocity limits; true when it
  // changed qddot*
  bool scale_velocity(const VelocityBounds& bounds, const Vector& velocity);
  // one dt further, (n) [rad], (n) [rad/s], ball joints turn; rounding never carries a coordinate over
  // its limit; throws Error for a robot that floats
  void integrate(VectorRef q, VectorRef velocity) const;
  // inverse dynamics: what the drives must give for qddot* and, in contact, against the forces that
  // the stack's force tasks read, beside what its contacts carry, and dry friction on the way to
  // the velocity v that the levels want: M qddot* + h + J' f - E lambda + c sgn(v), (n) [N m]; within
  // the torque limits of the stack, also where limits above them ask for more (diagnostics)
  void torque(const Robot& robot, VectorRef torque) const;
  // F in W [N] that the last solution wants of a contact of the stack
  [[nodiscard]] Vector3 contact_force(const Task& contact) const {
    return contacts_.force(contact);
  }

  [[nodiscard]] const Stack& stack() const { return problem_.stack(); }
  [[nodiscard]] const Hierarchy& hierarchy() const { return problem_.hierarchy(); }
  [[nodiscard]] const Solution& solution() const { return solver_.solution(); }
  [[nodiscard]] const Vector& acceleration() const { return acceleration_; }  // the last qddot*
  // qdot, a period after the last solve (n) [rad/s]
  [[nodiscard]] Vector velocity() const { return speed_ + options_.dt * acceleration_; }
  [[nodiscard]] const AccelerationControllerOptions& options() const { return options_; }
  // -1, 0, 1 a coordinate: held back by its lower position limit, by none, by its upper one; (n)
  [[nodiscard]] const Eigen::VectorXi& active_limits() const { return active_limits_; }
  // the coordinate limits that hold, null when none do; to narrow a range, say
  [[nodiscard]] const JointLimits* limits() const { return problem_.limits(); }
  [[nodiscard]] JointLimits* limits() { return problem_.limits(); }
  // what each level fell short of at the last compute, and why; makes its texts when asked
  [[nodiscard]] std::vector<LevelDiagnostics> diagnostics(const Robot& robot) const {
    return level_diagnostics({robot, problem_, solver_.solution(), reports_of(solver_),
                              active_limits_, has_zone_ ? &dead_zone_ : nullptr});
  }
  void reset();  // cold
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void fill_bounds(const Robot& robot, const JointLimits& limits, Level& level);
  void fill_rates(std::size_t k);
  void fill_rows(const Robot& robot, const StackLevel& source, Level& level);
  void add_friction(const Robot& robot, VectorRef torque) const;
  // J' f of the stack's force tasks in contact (n) [N m]
  void add_borne(VectorRef torque) const;

  AccelerationControllerOptions options_;
  RateLimits rates_;  // of a row, which has no speed limit
  std::vector<RotationVector> rotations_;
  bool floating_;             // its root is a coordinate
  JointLimits own_limits_;    // those of the robot
  JointRanges joint_ranges_;  // the same
  StackProblem problem_;
  ContactForces contacts_;
  Solver solver_;
  TorqueScaling scaling_;
  std::vector<double> weights_;  // w of each level, of the last measure (task_speed.hpp)
  std::vector<double> gains_;    // K / max(1, F) [1/s] of each level, the same
  bool has_zone_ = false;        // by the law that arrives, where no contacts hold the robot
  RateChanges changes_;
  DeadZone dead_zone_;
  std::optional<SaddleProbe> probe_;  // by the law that arrives
  Vector acceleration_;
  Vector next_;                                  // [rad/s] scratch, one dt further
  mutable Vector step_;                          // [rad] scratch
  Vector braked_, speed_;                        // D qdot and qdot, of the last measure
  Vector rate_;                                  // scratch, de/dt of a level
  std::vector<AccelerationInterval> intervals_;  // (n), of the last measure
  std::vector<TorqueLimits*> torque_limits_;     // of the stack
  Vector borne_;                                 // [N m] (n) scratch
  mutable Matrix inertia_;                       // scratch (n, n)
  Eigen::VectorXi active_limits_;
};

}  // namespace hurcules
