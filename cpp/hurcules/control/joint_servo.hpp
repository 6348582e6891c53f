// The joint servos: one robust PID (joint_pid.hpp) at every joint that has an actuator.
//
// The joints of a coordinate follow it, each on its own:  reference = factor q* + offset. A joint of
// no coordinate (a gripper, a bed, a belt) holds its place until it is moved. A ball joint has three,
// which turn it straight from where it is to where it shall be. A torque goes no
// further than the motor at its present speed, and none is given behind a brake that is shut.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "hurcules/control/joint_pid.hpp"
#include "hurcules/control/torque_scaling.hpp"
#include "hurcules/robot/joint_actuators.hpp"

namespace hurcules {

// What a joint's servo reckons with (triple_pole in joint_pid.hpp).
struct ServoGains {
  std::string joint;
  double inertia = 0.0;    // [kg m^2], of a slide [kg], that it turns, rotor included
  double bandwidth = 0.0;  // [rad/s]
};

// Gains for any robot, one row a joint with an actuator. Over its ranges, sampled, a joint feels
// inertias from 1 / (M^-1)_ii (all others free) to M_ii (all others held). The rated inertia is
// their geometric mean, so that a triple pole, stable from a ninth of it upwards, covers them; the
// bandwidth is 30 rad/s, less where the smallest inertia would make the loop too fast for dt. Where
// the servos are decoupled, the joints feel nothing of each other: dt alone bounds it, and joints that
// are left out, by as much as they loosen the coordinates (loose_joints.hpp). A driven
// wheel may hang in the air or roll the robot (JointActuator::rolling_inertia).
[[nodiscard]] std::vector<ServoGains> default_servo_gains(const Robot& robot, double dt,
                                                          bool decoupled = false);

// the rows that the model says for its joints: JointActuator::servo_inertia
[[nodiscard]] std::vector<ServoGains> model_servo_gains(
    const std::vector<JointActuator>& actuators);

// What the drive of an actuator can do at the moment.
struct ActuatorStatus {
  EffortRange range;        // [N m] or [N] at the joint, by its motor at its speed
  bool braked = false;      // its brake is shut
  double brake_load = 0.0;  // [N m] that the brake bears
};

// What is sensed of the robot, and what its drives can do.
struct RobotState {
  const Vector& qpos;                            // (nq)
  const Vector& qvel;                            // (nv)
  const std::vector<ActuatorStatus>& actuators;  // (nu)
  const double* sensors = nullptr;               // (nsensordata) of the model
};

class JointServo {
 public:
  // throws Error for a joint without a row in the table, a row out of range, or an actuator that
  // cannot be made to give an effort
  JointServo(const Robot& robot, const std::vector<ServoGains>& table, double dt);

  // where the coordinates shall be at the end of this period, (n) [rad], (n) [rad/s]
  void follow(const Vector& q, const Vector& velocity);
  // where one joint shall be then, whatever its coordinate says
  void move(Index joint, double position, double velocity);
  // What the model couples to a joint that no coordinate moves:
  //   q_follower = slope q_joint + shift
  struct Tie {
    Index follower = -1;  // the joint, -1: it has no servo
    int qpos = 0;         // its address
    double slope = 1.0, shift = 0.0;
  };
  [[nodiscard]] const std::vector<Tie>& ties(Index joint) const {
    return ties_[static_cast<std::size_t>(joint)];
  }
  // What a joint squeezes it lets go where it is led the other way, at `velocity` [rad/s]: its
  // reference is where the joint is, its integral 0. It squeezes while it stands, and its reference
  // is further beyond it than a servo that is free to follow ever is.
  void let_go(Index joint, double velocity, const RobotState& state);
  // From now on an encoder that cannot be believed is not followed: the motor gives what is fed
  // forward, and brakes by the joint's speed unless it is that which is wrong. Until `reset`.
  void distrust(Index joint, bool speed_too);
  // an actuator that somebody else commands from now on: no control is written for it
  void leave(Index joint) { left_[static_cast<std::size_t>(joint)] = true; }
  // from here on a coordinate's joints keep the distance from it that they have now; q and velocity
  // (n) are set to those of the first joints
  void release(VectorRef q, VectorRef velocity);
  // velocities of the coordinates from this reference on at which no motor is asked for more than
  // its peak; no side where it rests behind a brake, the middle where two joints of one coordinate
  // exclude each other. A motor is asked for growth (n, null: 1) times its own feedback, and for what
  // is fed forward.
  // Where a push asks for more, the coordinate goes with it: no faster than its joint is seen to go,
  // or `qd` (n) says, by more than `most` [rad/s]. It may always stand.
  const VelocityBounds& velocity_bounds(const Vector& q, const Vector& qd, const RobotState& state,
                                        double most, const Vector* growth);
  // What a model says the coordinates take, (n) [N m]; their joints share it by their factors.
  // friction: and beside it, towards where their references go, what dry friction of the model takes
  // and their motors have left
  void feed_forward(const Vector& efforts, bool friction);
  // as much more effort of the coordinates from now on, (n) [N m], for feed-forward that falls away
  void add(const Vector& efforts);
  // what the servos are about to give the coordinates beside it, (n) [N m], and the accelerations
  // that it would be at their rated inertias, (n) [rad/s^2]
  void feedback(const RobotState& state, VectorRef efforts, VectorRef acceleration);
  // its integrals begin anew, joints stand as their coordinates say
  void forget();
  // writes the controls of its actuators, ctrl (nu)
  void compute(const RobotState& state, VectorRef ctrl);
  // at rest at a configuration (nq), without memory and feed-forward
  void reset(const Vector& qpos);

  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }  // of joints, (m)
  [[nodiscard]] Index size() const { return pid_.size(); }                        // m
  // index of a joint; throws Error with the names that exist
  [[nodiscard]] Index find(const std::string& joint) const;
  // the joints of coordinates come first: how many there are
  [[nodiscard]] Index coordinate_joints() const { return coordinate_joints_; }
  [[nodiscard]] const JointActuator& actuator(Index joint) const {
    return motors_[static_cast<std::size_t>(joint)].actuator;
  }
  // that the coordinates' joints are rated for, (n) [kg m^2]
  void rated_inertia(VectorRef inertia) const;
  // of a joint's motion over that of its coordinate; 1 without one
  [[nodiscard]] double factor(Index joint) const {
    return motors_[static_cast<std::size_t>(joint)].factor;
  }
  [[nodiscard]] Index coordinate_of(Index joint) const {  // -1 for none
    return motors_[static_cast<std::size_t>(joint)].coordinate;
  }
  [[nodiscard]] const Vector& position() const { return position_; }  // [rad] (m) reference
  // writes a joint's reference where it belongs in qpos (nq), and what it takes along without a servo
  void place(Index joint, VectorRef qpos) const;
  [[nodiscard]] const Vector& velocity() const { return velocity_; }    // [rad/s] (m) reference
  [[nodiscard]] const Vector& torque() const { return pid_.torque(); }  // [N m], (m)
  // [N m], (m), before saturation
  [[nodiscard]] const Vector& demand() const { return pid_.demand(); }
  // "torque limit of NAME" of each joint that is asked for about all that its motor has
  [[nodiscard]] std::vector<std::string> at_peak() const;
  [[nodiscard]] const JointError& error() const { return error_; }  // [rad], [rad/s], (m)
  [[nodiscard]] const JointPid& pid() const { return pid_; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  struct Motor {
    JointActuator actuator;
    Index coordinate = -1;                   // -1: holds its place
    double factor = 1.0;                     // joint = factor * coordinate
    double share = 1.0;                      // of the coordinate's effort
    double inertia = 0.0;                    // rated
    std::vector<DryFriction> friction = {};  // its share of what the coordinate meets
    bool idle = false;  // its joint follows coordinates (closures.hpp), which bear all of it
    std::array<Index, 3> ball = {};  // the motors of its ball joint, where it has one
  };
  struct Rest {
    bool on = false;    // the brake holds, the motor is without power
    bool over = false;  // this tick the motor takes over what the brake bore
  };
  void find_ties(const mjModel_& model);
  void read_brakes(const RobotState& state);
  void follow_readings(const RobotState& state);
  // from where the joints are to where those references (m) are now, which are so far ahead [s]
  void find_position_error(const Vector& reference, double ahead, const Vector& qpos);
  // [rad/s] that a joint is seen to go with since the last call: one reading that is wrong, of its
  // place or its speed, does not move it
  double seen_speed(Index joint, const RobotState& state);
  // [N m] for dry friction where its reference goes: no more than its motor has left
  [[nodiscard]] double overcome(Index joint, const EffortRange& range) const;
  // of a ball joint with this motor: the rotation of references (m)
  [[nodiscard]] Matrix3 rotation(Index joint, const Vector& reference) const;

  std::vector<Motor> motors_;
  std::vector<std::vector<Tie>> ties_;  // of each joint
  std::vector<std::string> names_;
  Index coordinate_joints_ = 0;
  JointPid pid_;
  JointError error_;
  VelocityBounds bounds_;       // (n)
  Vector position_, velocity_;  // (m) reference
  Vector feed_forward_;         // [N m] (m)
  bool friction_ = false;       // fed forward too
  Vector beside_;               // [N m] (m) scratch: both
  Vector reference_;            // [rad] (m) scratch
  Vector seen_;                 // [rad] (m) joints, when bounds were last asked for
  Vector offset_;               // [rad] (m) of a joint against its coordinate
  std::vector<Rest> rests_;     // (m)
  enum class Trust { All, Speed, None };
  std::vector<Trust> trust_;  // (m) of the encoder
  std::vector<bool> left_;    // (m) to somebody else
};

}  // namespace hurcules
