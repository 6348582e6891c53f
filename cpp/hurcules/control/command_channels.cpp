#include "hurcules/control/command_channels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace hurcules {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

void require_free_actuator(const Channel& channel, const ActuatorControl& control,
                           const JointServo& servo) {
  for (Index i = 0; i < servo.size(); ++i) {
    require(servo.actuator(i).actuator != control.actuator,
            "channel '" + channel.name() + "' leads the control of '" + channel.actuator() +
                "', which the servo of joint '" + servo.actuator(i).joint +
                "' commands: it wants a JointRate, or a task");
  }
}

}  // namespace

CommandChannels::CommandChannels(std::vector<Channel> channels,
                                 const std::vector<NamedStack>& stacks, const Robot& plan,
                                 const JointServo& servo, bool has_tracks, double dt)
    : dt_(dt), channels_(std::move(channels)), led_(static_cast<std::size_t>(servo.size()), false) {
  std::vector<std::string> names;
  for (const Channel& channel : channels_) names.push_back(channel.name());
  require_distinct(names, "channels");
  for (const Channel& channel : channels_) {
    Reach& reach = reach_.emplace_back();
    reach.row = static_cast<Index>(names_.size());
    for (const std::string& entry : channel.entries()) names_.push_back(entry);
    require(channel.kind() != ChannelKind::Drive || has_tracks,
            "channel '" + channel.name() + "' drives: the controller wants options for its tracks");
    find_joints(channel, servo, reach);
    if (channel.kind() == ChannelKind::Control) {
      reach.control = actuator_control(*plan.model(), channel.actuator());
      require_free_actuator(channel, reach.control, servo);
    }
    Task* const task = channel.task();
    if (!task) continue;
    for (const NamedStack& stack : stacks) reach.stacks.push_back(stack.stack.holds(*task));
    require(
        std::find(reach.stacks.begin(), reach.stacks.end(), true) != reach.stacks.end(),
        "channel '" + channel.name() + "' moves task '" + task->name() + "', which is in no stack");
    if (channel.kind() == ChannelKind::Twist) add_target_rate(channel, reach.row);
    if (channel.kind() != ChannelKind::Delta) continue;
    reach.twin = task->clone();
    if (!sensed_) sensed_ = std::make_unique<Robot>(plan.model(), plan.coordinate_names());
  }
  scale_ = command_ = rates_ = delta_ = Vector::Zero(static_cast<Index>(names_.size()));
  for (std::size_t i = 0; i < channels_.size(); ++i)
    scale_.segment(reach_[i].row, channels_[i].size()) = channels_[i].scale();
}

void CommandChannels::find_joints(const Channel& channel, const JointServo& servo, Reach& reach) {
  const bool moves = channel.kind() == ChannelKind::Joints;
  for (const std::string& name : channel.joint_names()) {
    const Index joint = servo.find(name);
    require(moves || servo.coordinate_of(joint) < 0,
            "channel '" + channel.name() + "' moves joint '" + name +
                "', which the tasks move: it wants a task");
    require(servo.actuator(joint).part < 0, "channel '" + channel.name() + "' moves '" + name +
                                                "', a part of a ball joint: it wants a task");
    reach.joints.push_back(joint);
    if (moves) {
      moved_.push_back(joint);
    } else {
      led_[static_cast<std::size_t>(joint)] = true;
    }
  }
}

void CommandChannels::add_target_rate(const Channel& channel, Index row) {
  for (const TargetRate& one : target_rates_)
    if (one.task == channel.task()) return;
  target_rates_.push_back({channel.task(), row, channel.size(), false});
}

void CommandChannels::apply(const Vector* command, bool first, const RobotState& state,
                            const Movers& movers) {
  add_up_twists();
  for (TargetRate& rate : target_rates_)
    rate.moves = !rates_.segment(rate.row, rate.size).isZero(0.0);
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const Index row = reach_[i].row, size = channel.size();
    auto part = command_.segment(row, size);
    const bool given = command && !std::isnan((*command)[row]) && reaches(i, movers) &&
                       (first || !channel.acts_once());
    if (given) {
      const auto scale = scale_.segment(row, size);
      part = command->segment(row, size).cwiseMax(-scale).cwiseMin(scale);
    } else {
      part.setConstant(channel.sets() ? kNothing : 0.0);
    }
    apply(channel, reach_[i], part, given, state, movers);
  }
  add_up_twists();
  for (const TargetRate& one : target_rates_) {
    // a twist that rests leaves a target that somebody else moves alone
    const auto rate = rates_.segment(one.row, one.size);
    if (one.moves || !rate.isZero(0.0)) one.task->advance(rate, 0.0);  // it moves in move_targets
  }
}

// of all channels of a task
void CommandChannels::add_up_twists() {
  rates_.setZero();
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    if (channels_[i].kind() != ChannelKind::Twist) continue;
    const Index size = channels_[i].size();
    for (const TargetRate& one : target_rates_)
      if (channels_[i].task() == one.task)
        rates_.segment(one.row, size) += command_.segment(reach_[i].row, size);
  }
}

// a rate moves what the stack that rules measures, nothing else
bool CommandChannels::reaches(std::size_t channel, const Movers& movers) const {
  const ChannelKind kind = channels_[channel].kind();
  if (kind != ChannelKind::Twist && kind != ChannelKind::Delta) return true;
  return movers.stack && reach_[channel].stacks[*movers.stack];
}

void CommandChannels::apply(const Channel& channel, Reach& reach, const ConstVectorRef& command,
                            bool given, const RobotState& state, const Movers& movers) {
  switch (channel.kind()) {
    case ChannelKind::Twist:
      return;  // all of a task together
    case ChannelKind::Delta:
      if (given && (command.array() != 0.0).any()) set_delta(channel, reach, command, state);
      return;
    case ChannelKind::Target:
      if (given) channel.task()->assign_target(command);
      return;
    case ChannelKind::Force:
      if (given) static_cast<ForceTask*>(channel.task())->set_force(command[0]);
      return;
    case ChannelKind::Drive:
      return movers.drive->controller().drive({command[0], command[1]});
    case ChannelKind::Joint:
      return move_free_joint(channel, reach.joints.front(), command[0], state, movers.servo);
    case ChannelKind::Joints:
      for (std::size_t i = 0; i < reach.joints.size() && !movers.stack; ++i)
        movers.joints.lead(reach.joints[i], command[static_cast<Index>(i)], movers.servo);
      return;
    case ChannelKind::Control:
      reach.value =
          std::clamp(reach.value + command[0] * dt_, reach.control.lower, reach.control.upper);
      return;
  }
}

// the target where the task is measured to be, and from there by delta
void CommandChannels::set_delta(const Channel& channel, Reach& reach, const ConstVectorRef& delta,
                                const RobotState& state) {
  sensed_->set_qpos(state.qpos);
  reach.twin->hold(*sensed_);
  auto velocity = delta_.head(delta.size());
  velocity = delta / dt_;
  reach.twin->advance(velocity, dt_);
  velocity.setZero();
  reach.twin->advance(velocity, dt_);
  copy_memory(*reach.twin, *channel.task(), scratch_);
}

// one that no coordinate moves, and what is tied to it
void CommandChannels::move_free_joint(const Channel& channel, Index joint, double rate,
                                      const RobotState& state, JointServo& servo) const {
  const JointActuator& actuator = servo.actuator(joint);
  // more than half of full scale opens a grip; less may be what keeps its force
  if (std::abs(rate) > 0.5 * channel.scale()[0]) servo.let_go(joint, rate, state);
  const double place = servo.position()[joint] + rate * dt_;
  const double held = std::clamp(place, actuator.lower, actuator.upper);
  const double velocity = held == place ? rate : 0.0;
  servo.move(joint, held, velocity);
  for (const JointServo::Tie& tie : servo.ties(joint)) {
    if (tie.follower >= 0 && !led_[static_cast<std::size_t>(tie.follower)])
      servo.move(tie.follower, tie.slope * held + tie.shift, tie.slope * velocity);
  }
}

void CommandChannels::add(const Vector& own, const Vector& command, bool first, Vector& sum) const {
  sum = own;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Channel& channel = channels_[i];
    const auto part = command.segment(reach_[i].row, channel.size());
    if (std::isnan(part[0]) || (channel.kind() == ChannelKind::Delta && !first)) continue;
    auto whole = sum.segment(reach_[i].row, channel.size());
    if (channel.sets()) {
      whole = part;
    } else {
      whole += part;
    }
  }
}

void CommandChannels::move_targets() const {
  for (const TargetRate& one : target_rates_) {
    const auto rate = rates_.segment(one.row, one.size);
    if (!rate.isZero(0.0)) one.task->advance(rate, dt_);
  }
}

void CommandChannels::write_controls(VectorRef ctrl) const {
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].kind() == ChannelKind::Control)
      ctrl[reach_[i].control.actuator] = reach_[i].value;
}

void CommandChannels::hold() {
  command_.setZero();
  rates_.setZero();
}

void CommandChannels::reset(const mjModel_& model, const Vector& qpos) {
  hold();
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].kind() == ChannelKind::Control)
      reach_[i].value = resting_control(model, reach_[i].control, qpos);
}

bool CommandChannels::takes(const ConstVectorRef& command) const {
  if (command.size() != scale_.size()) return false;
  if (command.size() > 0 && command.array().isNaN().all()) return false;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const auto part = command.segment(reach_[i].row, channels_[i].size()).array();
    if (!part.isNaN().all() && !part.isFinite().all()) return false;
  }
  return true;
}

void CommandChannels::require_fit(const Vector& command) const {
  if (takes(command)) return;
  throw Error("a command wants " + std::to_string(scale_.size()) + " finite numbers, got " +
              std::to_string(command.size()) + (command.allFinite() ? "" : ", not all finite"));
}

void CommandChannels::save(StateWriter& writer) const {
  writer.put(Vector(command_.array().isNaN().select(0.0, command_)));
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].kind() == ChannelKind::Control) writer.put(reach_[i].value);
}

void CommandChannels::restore(StateReader& reader) {
  reader.get(command_);
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].kind() == ChannelKind::Control) reach_[i].value = reader.get();
}

}  // namespace hurcules
