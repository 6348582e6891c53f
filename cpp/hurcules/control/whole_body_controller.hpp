// The controller of a whole robot: named commands in, controls of the actuators out.
//
//   command -> targets of the tasks          channel.hpp
//   plan    -> errors, Jacobians, hierarchy  the tasks, measured at the reference robot
//   solve   -> qdot* (or qddot*), no faster than the motors can hold    torque_scaling.hpp
//   q* += qdot* dt                           [T 4.3.7]
//   q*      -> torques                       joint_servo.hpp; tracks: track_drive.hpp
//
// The plan is a robot of its own that stands at the reference: q* is integrated from the solver's
// answers, not from what was sensed, and the real robot follows it by its joint servos alone. Limits
// of position, velocity and acceleration come first in every stack. There may be several stacks, by
// velocities or by accelerations, of which one rules at a time; joints may also be moved one by one.
// From one to the other the velocity goes on, within the acceleration limit, and the servos keep
// their integrals. While a stack by torques rules, the plan is the robot as it is sensed, and its
// drives get what inverse dynamics says.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/control/command_channels.hpp"
#include "hurcules/control/controller_options.hpp"
#include "hurcules/control/feed_forward.hpp"
#include "hurcules/control/force_readings.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/control/motion_law.hpp"
#include "hurcules/control/track_drive.hpp"
#include "hurcules/control/yielding_targets.hpp"
#include "hurcules/robot/actuator_control.hpp"
#include "hurcules/robot/trees.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace hurcules {

class WholeBodyController {
 public:
  // Starts at the robot's configuration; targets that somebody has set stay. The tasks of the stacks
  // stay those of the caller, who keeps them alive. Throws Error for two stacks or channels of one
  // name, and a channel whose task stands in no stack.
  WholeBodyController(const Robot& robot, std::vector<NamedStack> stacks,
                      std::vector<Channel> channels = {}, WholeBodyControllerOptions options = {});
  // the same on tasks of its own, for another simulation; `robot` has the same model or one of the
  // same names and shapes
  [[nodiscard]] std::unique_ptr<WholeBodyController> clone(const Robot& robot) const;

  // a task, or limits, that live as long as the controller
  void keep(std::unique_ptr<Task> task) { kept_.push_back(std::move(task)); }
  void keep(std::unique_ptr<JointLimits> limits) { kept_limits_.push_back(std::move(limits)); }

  // Starts anew at a whole configuration (nq) at rest: the first stack rules, all tasks hold, or all
  // whose target nobody has set.
  void reset(const Vector& qpos, bool keep_targets = false);
  // the targets of all tasks come to where the plan is
  void hold_targets();
  // which stack rules from the next tick on; throws Error with the names that exist
  void use(const std::string& stack);
  // Where a joint with an actuator shall be from now on [rad], and its velocity there [rad/s], which
  // is fed forward; no stack rules until `use`. To a place that is far off it goes as fast as its
  // motor can; beyond its range it squeezes, as a finger does.
  void move(const std::string& joint, double position, double velocity);
  // the same for all of them, in the order of the servo: (m) each
  void move(const Vector& position, const Vector& velocity);
  // No stack rules until `use`: joints stop within the acceleration limit, and stay; channels of
  // joints move them.
  void move_joints();
  // The plan stands on another body, where it is now: what it takes is told anew, and the integrals
  // of the servos take over the difference, so that no torque jumps (decoupled servos: it may, by
  // what the plan's weight and inertia differ). Until `reset`.
  void stand_on(const std::string& body);
  // A force task that reads the deflection of a spring, or a row of the model's sensors, or three of
  // them in the axes of a site: force_readings.hpp. With a low-pass of 3 ms (not of a spring): a
  // servo's damping times the compliance is the gain of a loop with a tick of delay, which may swing.
  // Throws Error for a task that stands in no stack, and rows that no sensor has.
  void sense(ForceTask& task, std::unique_ptr<SpringForce> spring);
  void sense(ForceTask& task, int sensor_row, double sign = 1.0);
  void sense(ForceTask& task, int sensor_row, Frame site, double sign = 1.0);
  [[nodiscard]] bool feeds(const ForceTask& task) const { return forces_.feed(task); }

  // One tick of a loop of one's own: from what is sensed, qpos (nq) and qvel (nv), to the controls
  // (nu) of the actuators, whose motors give what the model says. Command and `first` as for `apply`;
  // `sensors` (nsensordata) of the model where force tasks read them, else null. A simulation calls
  // the stages below instead. Throws Error, and changes nothing, for other sizes, numbers that are not
  // finite, in the first tick a robot that is not where the plan starts, and later a joint that is
  // elsewhere than a tick ago by more than 0.05 rad (or m) and 100 rad/s.
  void tick(const ConstVectorRef& qpos, const ConstVectorRef& qvel, const Vector* command,
            bool first, VectorRef ctrl, const double* sensors = nullptr);
  // One tick in its stages. command (k) or null: every target holds, drives stand; a channel of NaN
  // alone does so. `first`: the command is new, so that what it sets once (Delta, Target, Force) is.
  void kinematics(const RobotState& state);
  void apply(const Vector* command, bool first, const RobotState& state);
  // of its size, each channel finite or all NaN, not all of them
  [[nodiscard]] bool takes(const ConstVectorRef& command) const { return commands_.takes(command); }
  // throws Error for what it does not take
  void require_command(const Vector& command) const { commands_.require_fit(command); }
  // a second command upon one's own: see CommandChannels::add
  void add_commands(const Vector& own, const Vector& command, bool first, Vector& sum) const {
    commands_.add(own, command, first, sum);
  }
  void measure();
  void solve(const RobotState& state);
  void actuate(const RobotState& state, VectorRef ctrl);
  // in place of actuate, where there is no plant: the references of the servos follow, and the
  // profiles of the tracks go on
  void lead(const RobotState& state);
  // the reference stays where it is, the servos hold it
  void hold();
  // the servo of a joint no longer follows its encoder; no joint with a servo: nothing
  void distrust(const std::string& joint, bool speed_too);
  // which loop calls the stages, so that it sees when another one has taken the controller since
  void serve(const void* loop) { loop_ = loop; }
  [[nodiscard]] bool serves(const void* loop) const { return loop_ == loop; }

  [[nodiscard]] double dt() const { return options_.dt; }
  [[nodiscard]] const WholeBodyControllerOptions& options() const { return options_; }
  [[nodiscard]] const Robot& plan() const { return plan_; }
  // the plan as a scratch robot on the support, to find the start that `reset` then takes
  [[nodiscard]] Robot& plan_to_place() { return plan_; }
  [[nodiscard]] const Vector& q_des() const { return q_; }    // [rad] (n)
  [[nodiscard]] const Vector& qd_des() const { return qd_; }  // [rad/s] (n)
  // (k) what it did in the last tick, as held to scale: 0 for nothing, of Target and Force NaN.
  // Given again tick by tick it gives the same bits.
  [[nodiscard]] const Vector& command() const { return commands_.command(); }
  [[nodiscard]] const Vector& scale() const { return commands_.scale(); }  // (k)
  [[nodiscard]] const std::vector<std::string>& command_names() const { return commands_.names(); }
  [[nodiscard]] const std::vector<Channel>& channels() const { return commands_.channels(); }
  [[nodiscard]] const std::vector<NamedStack>& stacks() const { return stacks_; }
  [[nodiscard]] std::size_t active() const { return active_; }       // of the stacks
  [[nodiscard]] bool moves_joints() const { return moves_joints_; }  // no stack rules
  [[nodiscard]] bool by_torques() const {                            // so goes the stack that rules
    return stacks_[active_].order == ControlOrder::Torque;
  }
  [[nodiscard]] const MotionLaw& law() const { return *laws_[active_]; }
  // throws Error for a number that no stack has
  [[nodiscard]] const MotionLaw& law(std::size_t stack) const;
  // all tasks of all stacks but the limits, each once
  [[nodiscard]] const std::vector<Task*>& tasks() const { return tasks_; }
  [[nodiscard]] Task& task(const std::string& name) const;  // throws Error with the names
  [[nodiscard]] const JointServo& servo() const { return servo_; }
  [[nodiscard]] const std::optional<TrackDrive>& drive() const { return drive_; }
  [[nodiscard]] std::optional<TrackDrive>& drive() { return drive_; }
  // what each level falls short of and why; targets that gave way to torques too
  [[nodiscard]] std::vector<LevelDiagnostics> diagnostics() const;
  // the last tick was slowed down by what the motors can hold
  [[nodiscard]] bool scaled() const { return scaled_; }
  [[nodiscard]] const Vector& held_back() const { return held_back_; }  // [rad] (n) by that so far
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  void require_member(const ForceTask& task) const;
  void require_rows(int first, int count) const;  // of the model's sensors
  void collect_tasks();
  void miss_readings();
  void require_near(const Vector& qpos) const;
  void take_over();
  void refer();
  void tell_servos(const RobotState* state);

  WholeBodyControllerOptions options_;
  Robot plan_;
  std::vector<std::unique_ptr<Task>> kept_;
  std::vector<std::unique_ptr<JointLimits>> kept_limits_;
  std::vector<NamedStack> stacks_;
  std::vector<std::unique_ptr<MotionLaw>> laws_;
  std::vector<Task*> tasks_;             // of all stacks
  std::vector<JointLimits*> limits_;     // that they name
  std::vector<CarryingJoint> carrying_;  // no coordinate moves them
  double names_ = 0.0;                   // hash of those of coordinates, tasks, stacks and commands
  ForceReadings forces_;
  std::vector<std::vector<ForceTask*>> force_tasks_;  // (stacks)
  JointServo servo_;
  JointMotion joints_;
  CommandChannels commands_;
  std::vector<ActuatorStatus> motors_;  // (nu) for `tick`
  std::optional<TrackDrive> drive_;
  std::size_t active_ = 0;
  bool moves_joints_ = false, scaled_ = false;
  bool begun_ = false;  // `tick` was called since the start
  const void* loop_ = nullptr;
  Vector q_, qd_, held_back_;
  YieldingTargets yielding_;
  FeedForward feed_forward_;
  Vector start_;                           // (nq) where the plan stands
  Vector seen_;                            // (m) joints in the last `tick`
  Vector ahead_;                           // (nq) scratch
  Vector qpos_, qvel_;                     // as read in this tick of a loop of one's own
  Vector wished_, efforts_, step_, next_;  // (n) scratch
  Frame support_;
};

}  // namespace hurcules
