// The joint servos: one robust PID for every joint that the coordinates drive, both knees on their
// own, and for every other motor, which holds its place: the drives brake. A torque goes no further
// than the motor at its present speed, and none is given behind a brake that is shut.
#pragma once

#include <string>
#include <vector>

#include "hurcules/control/joint_pid.hpp"
#include "hurcules/control/yielding.hpp"
#include "hurcules/mission/robot_tables.hpp"
#include "hurcules/robot/robot.hpp"
#include "hurcules/sim/brakes.hpp"
#include "hurcules/sim/motor.hpp"

struct mjData_;

namespace hurcules {

class Servo {
 public:
  // throws Error for a motor without a row in the table, or with gains of its own
  Servo(const Robot& robot, const std::vector<ServoRow>& table, double dt);

  // reads the joints of `data` and writes its ctrl; reference of the coordinates [rad], [rad/s],
  // (n)
  struct Reference {
    const Vector& position;
    const Vector& velocity;
  };
  void act(const Reference& reference, mjData_* data);
  // the same, acting on what sensors say of the joints; the motors' limits go by the real speed
  struct Sensed {
    const Vector& qpos;  // (nq)
    const Vector& qvel;  // (nv)
  };
  void act(const Reference& reference, const Sensed& sensed, mjData_* data);
  // velocities of the coordinates from this reference on, at which act asks no motor for more than
  // its peak; no side where it rests behind a brake, the middle where two joints of one coordinate
  // exclude each other
  const RateWindow& find_window(const Vector& q_des, const Sensed& sensed);
  // before act: a motor whose brake is shut rests; one whose brake opens takes over what it bore
  void mind(const Brakes& brakes);
  // at rest and without memory; the motors that no coordinate drives hold where `data` has them
  void reset(const mjData_* data);

  [[nodiscard]] const std::vector<std::string>& names() const {
    return names_;
  }  // of the joints, (m)
  [[nodiscard]] std::size_t coordinate_joints() const {
    return coordinate_joints_;
  }  // they come first
  [[nodiscard]] const Vector& torque() const { return pid_.torque(); }  // [N m], (m)
  [[nodiscard]] const Vector& demand() const {
    return pid_.demand();
  }  // [N m], (m), before saturation
  [[nodiscard]] const JointError& error() const { return error_; }  // [rad], [rad/s], (m)
  [[nodiscard]] const JointPid& pid() const { return pid_; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Motor {
    int actuator = 0;
    int qpos = 0, dof = 0;  // addresses
    double gear = 1.0;
    Index coordinate = -1;  // -1: holds its place
    double factor = 1.0;    // joint = factor * coordinate
    MotorLimits limits = {};
  };
  struct Rest {
    bool on = false;      // the brake holds, the motor is without power
    bool over = false;    // this tick the motor takes over
    double torque = 0.0;  // [N m] at the joint, what it takes over
  };
  void act(const Reference& reference, const double* qpos, const double* qvel, mjData_* data);
  void measure(const Reference& reference, const double* qpos, const double* qvel);
  void set_limits(const mjData_* data);

  std::vector<Motor> motors_;
  std::vector<std::string> names_;
  std::size_t coordinate_joints_ = 0;
  JointPid pid_;
  JointError error_;
  RateWindow window_;        // (n)
  Vector place_;             // [rad], (m): what a motor without a coordinate holds
  std::vector<Rest> rests_;  // (m)
};

}  // namespace hurcules
