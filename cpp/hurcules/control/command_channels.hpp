// What a command moves: the numbers of all channels, one after the other.
//
// A twist moves the target of its task through the whole period, and tells the task so before; twists
// of one task add up. The rest is set at the beginning of the period.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "hurcules/base/state.hpp"
#include "hurcules/control/channel.hpp"
#include "hurcules/control/joint_motion.hpp"
#include "hurcules/control/joint_servo.hpp"
#include "hurcules/control/motion_law.hpp"
#include "hurcules/control/track_drive.hpp"
#include "hurcules/robot/actuator_control.hpp"

namespace hurcules {

class CommandChannels {
 public:
  // Throws Error for two channels of one name, a task that is in no stack, a joint or an actuator that
  // something else commands, and tracks where the controller has none.
  CommandChannels(std::vector<Channel> channels, const std::vector<NamedStack>& stacks,
                  const Robot& plan, const JointServo& servo, bool has_tracks, double dt);

  // who does what a command says
  struct Movers {
    std::optional<std::size_t> stack;  // that rules, none while joints are moved
    JointServo& servo;
    JointMotion& joints;
    std::optional<TrackDrive>& drive;
  };
  // A command (k), or null: nothing, every target holds, tracks stand; a channel of NaN alone does so.
  // `first`: it is new, so that what it sets once (Delta, Target, Force) is.
  void apply(const Vector* command, bool first, const RobotState& state, const Movers& movers);
  // `command` upon `own`, (k) each: rates are added, what is set takes the place of what is set, and
  // what counts from the measured place does so in the first tick alone
  void add(const Vector& own, const Vector& command, bool first, Vector& sum) const;
  // targets that a twist moves, to where they are at the end of the period
  void move_targets() const;
  void write_controls(VectorRef ctrl) const;  // of Control channels, into ctrl (nu)
  void hold();                                // the command before is forgotten
  void reset(const mjModel_& model, const Vector& qpos);

  // of its size, each channel finite or all NaN, not all of them
  [[nodiscard]] bool takes(const ConstVectorRef& command) const;
  void require_fit(const Vector& command) const;  // throws Error for what it does not take

  [[nodiscard]] const std::vector<Channel>& channels() const { return channels_; }
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }  // (k)
  [[nodiscard]] const Vector& scale() const { return scale_; }                    // (k)
  [[nodiscard]] const Vector& command() const { return command_; }                // (k) as applied
  [[nodiscard]] const std::vector<Index>& moved_joints() const { return moved_; }
  void save(StateWriter& writer) const;
  void restore(StateReader& reader);

 private:
  // what a channel reaches
  struct Reach {
    Index row = 0;               // of its first number
    std::vector<bool> stacks;    // its task stands in
    std::unique_ptr<Task> twin;  // of Delta: its task, where the robot is sensed
    std::vector<Index> joints;   // of the servo
    ActuatorControl control = {};
    double value = 0.0;  // of that
  };
  // how fast the twists of a task move its target
  struct TargetRate {
    Task* task = nullptr;
    Index row = 0, size = 0;  // in rates_
    bool moves = false;       // since the tick before
  };
  void find_joints(const Channel& channel, const JointServo& servo, Reach& reach);
  void add_target_rate(const Channel& channel, Index row);
  void add_up_twists();
  [[nodiscard]] bool reaches(std::size_t channel, const Movers& movers) const;
  void apply(const Channel& channel, Reach& reach, const ConstVectorRef& command, bool given,
             const RobotState& state, const Movers& movers);
  void set_delta(const Channel& channel, Reach& reach, const ConstVectorRef& delta,
                 const RobotState& state);
  void move_free_joint(const Channel& channel, Index joint, double rate, const RobotState& state,
                       JointServo& servo) const;

  double dt_;
  std::vector<Channel> channels_;
  std::vector<Reach> reach_;  // of each
  std::vector<std::string> names_;
  std::vector<Index> moved_;       // joints of Joints channels
  std::vector<bool> led_;          // (joints of the servo) by a Joint channel
  std::unique_ptr<Robot> sensed_;  // for Delta channels; null without one
  Vector scale_, command_, rates_;
  std::vector<TargetRate> target_rates_;
  Vector delta_;                 // scratch
  std::vector<double> scratch_;  // the same
};

}  // namespace hurcules
