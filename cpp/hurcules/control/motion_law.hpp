// How a stack becomes motion: by velocities or by accelerations. One face for both controllers, so
// that a whole-body controller goes from one to the other.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "hurcules/control/acceleration_controller.hpp"
#include "hurcules/control/velocity_controller.hpp"

namespace hurcules {

// What the unknowns of a stack are, and what the robot is told: velocities and accelerations are
// integrated to references of the joint servos; by torques the accelerations are those of the robot
// as it is sensed, and its drives get what inverse dynamics says.
enum class ControlOrder { Velocity, Acceleration, Torque };

// A stack that may rule.
struct NamedStack {
  std::string name;
  Stack stack;
  ControlOrder order = ControlOrder::Velocity;
};

class MotionLaw {
 public:
  virtual ~MotionLaw() = default;
  // measures the tasks at the plan, which moves at this velocity (n) [rad/s]: tasks -> hierarchy
  virtual void measure(Robot& plan, const Vector& velocity) = 0;
  virtual void solve() = 0;
  // no faster than the motors can hold; true when that changed the answer
  virtual bool scale(const VelocityBounds& bounds, const Vector& velocity) = 0;
  // q* and qdot* one period further, (n) each
  virtual void integrate(Vector& q, Vector& velocity) const = 0;
  // what qdot* will be after integrate, (n); of the last solve and scale
  [[nodiscard]] virtual const Vector& next_velocity(const Vector& velocity) = 0;
  // goes on at this velocity, cold
  virtual void take_over(const Vector& velocity) = 0;
  virtual void reset() = 0;
  virtual void save(StateWriter& writer) const = 0;
  virtual void restore(StateReader& reader) = 0;

  // what the drives must give, (n) [N m]; by torques only
  virtual void torque(const Robot& /*plan*/, VectorRef torque) const { torque.setZero(); }
  // F in W [N] that the last solution wants of a contact of the stack; by torques only
  [[nodiscard]] virtual Vector3 contact_force(const Task& /*contact*/) const {
    return Vector3::Zero();
  }
  [[nodiscard]] virtual ControlOrder order() const = 0;
  [[nodiscard]] virtual const Stack& stack() const = 0;
  [[nodiscard]] virtual const Hierarchy& hierarchy() const = 0;
  [[nodiscard]] virtual const Solution& solution() const = 0;
  [[nodiscard]] virtual const Eigen::VectorXi& active_limits() const = 0;
  [[nodiscard]] virtual const JointLimits* limits() const = 0;
  // [1/s] at which an error of a task vanishes
  [[nodiscard]] virtual double rate() const = 0;
  [[nodiscard]] virtual double max_acceleration() const = 0;  // [rad/s^2] of every coordinate
  [[nodiscard]] virtual std::vector<LevelDiagnostics> diagnostics(const Robot& plan) const = 0;
};

[[nodiscard]] std::unique_ptr<MotionLaw> make_law(const Robot& robot, const Stack& stack,
                                                  const VelocityControllerOptions& options);
[[nodiscard]] std::unique_ptr<MotionLaw> make_law(const Robot& robot, const Stack& stack,
                                                  const AccelerationControllerOptions& options);
[[nodiscard]] std::unique_ptr<MotionLaw> make_torque_law(
    const Robot& robot, const Stack& stack, const AccelerationControllerOptions& options);

}  // namespace hurcules
