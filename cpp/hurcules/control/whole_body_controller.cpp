#include "hurcules/control/whole_body_controller.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/base/values.hpp"

namespace hurcules {

namespace {

constexpr Index kMostBodies = 1'000'000;  // no snapshot names a later one

const std::string& name_of(const NamedStack& stack) {
  return stack.name;
}

const std::string& name_of(const Channel& channel) {
  return channel.name();
}

const std::string& name_of(const Task* task) {
  return task->name();
}

template <class Named>
void require_distinct(const std::vector<Named>& all, const char* kind) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (name_of(all[i]) != name_of(all[k])) continue;
      std::string text = "two ";  // appended: GCC 12 takes a sum for an overlap
      text.append(kind).append(" are called '").append(name_of(all[i])).append("'");
      throw Error(text);
    }
  }
}

// Rows that are given, those of the model, and reckoned ones for the other joints. A table that is whole
// may name joints of another form of the robot; one that is not may have a name mistyped.
std::vector<ServoGains> all_gains(const Robot& robot, std::vector<ServoGains> given,
                                  const std::vector<ServoGains>& of_model,
                                  const std::vector<JointActuator>& actuators, double dt,
                                  bool decoupled) {
  const auto has = [&given](const std::string& joint) {
    return std::any_of(given.begin(), given.end(),
                       [&joint](const ServoGains& row) { return row.joint == joint; });
  };
  const auto whole = [&] {
    return std::all_of(actuators.begin(), actuators.end(),
                       [&](const JointActuator& actuator) { return has(actuator.joint); });
  };
  if (whole()) return given;
  std::vector<std::string> joints;
  for (const JointActuator& actuator : actuators) joints.push_back(actuator.joint);
  for (const ServoGains& row : given) {
    if (std::find(joints.begin(), joints.end(), row.joint) == joints.end())
      throw Error(unknown_name("joint with an actuator", row.joint, joints));
  }
  for (const ServoGains& row : of_model)
    if (!has(row.joint)) given.push_back(row);
  if (whole()) return given;
  for (const ServoGains& row : default_servo_gains(robot, dt, decoupled))
    if (!has(row.joint)) given.push_back(row);
  return given;
}

WholeBodyControllerOptions completed(const Robot& robot, WholeBodyControllerOptions options) {
  options.velocity.dt = options.acceleration.dt = options.torque.dt = options.dt;
  const std::vector<JointActuator> actuators = joint_actuators(robot);
  const bool rolls =
      std::any_of(actuators.begin(), actuators.end(),
                  [](const JointActuator& actuator) { return actuator.rolling_inertia > 0.0; });
  const std::vector<ServoGains> of_model = model_servo_gains(actuators);
  const auto has_row = [&](const JointActuator& actuator) {
    const auto is_it = [&](const ServoGains& row) { return row.joint == actuator.joint; };
    return std::any_of(options.servo.begin(), options.servo.end(), is_it) ||
           std::any_of(of_model.begin(), of_model.end(), is_it);
  };
  const bool reckoned =
      std::none_of(actuators.begin(), actuators.end(), [&](const JointActuator& actuator) {
        return coordinate_of(robot, actuator).number >= 0 && has_row(actuator);
      });
  options.decoupled = options.decoupled.value_or(reckoned && options.feed_forward && !rolls);
  require(!*options.decoupled || options.feed_forward, "decoupled servos want feed_forward");
  options.servo =
      all_gains(robot, options.servo, of_model, actuators, options.dt, *options.decoupled);
  if (options.support.empty()) options.support = robot.support_name();
  if (options.drive) options.drive->drive.dt = options.dt;
  return options;
}

std::unique_ptr<MotionLaw> law_of(const Robot& plan, const NamedStack& stack,
                                  const WholeBodyControllerOptions& options) {
  if (stack.order == ControlOrder::Torque)
    return make_torque_law(plan, stack.stack, options.torque);
  require(!plan.floating(), "no reference can lead the free root of the robot: stack '" +
                                stack.name + "' wants the order 'torque'");
  if (stack.order == ControlOrder::Velocity) return make_law(plan, stack.stack, options.velocity);
  return make_law(plan, stack.stack, options.acceleration);
}

std::unique_ptr<JointLimits> copy_of(const JointLimits& limits) {
  return std::make_unique<JointLimits>(limits);
}

// one copy of each that is asked for
template <class T>
struct Copies {
  std::vector<std::unique_ptr<T>> kept;
  std::map<const T*, T*> copies;
  T* of(const T* one) {
    T*& copy = copies[one];
    if (!copy) {
      kept.push_back(copy_of(*one));
      copy = kept.back().get();
    }
    return copy;
  }
};

template <class T>
bool contains(const std::vector<T*>& all, const T* one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

template <class T>
void add_once(T* one, std::vector<T*>& all) {
  if (!contains(all, one)) all.push_back(one);
}

// all tasks of a stack, in its order
std::vector<Task*> tasks_of(const Stack& stack) {
  std::vector<Task*> all;
  for (const StackLevel& level : stack.levels()) {
    all.insert(all.end(), level.tasks.begin(), level.tasks.end());
  }
  return all;
}

}  // namespace

WholeBodyController::WholeBodyController(const Robot& robot, std::vector<NamedStack> stacks,
                                         std::vector<Channel> channels,
                                         WholeBodyControllerOptions options)
    : options_(completed(robot, std::move(options))),
      plan_(robot.model(), robot.coordinate_names()),
      stacks_(std::move(stacks)),
      channels_(std::move(channels)),
      servo_(robot, options_.servo, options_.dt),
      motors_(static_cast<std::size_t>(robot.nu())) {
  require(!stacks_.empty(), "a controller wants at least one stack");
  plan_.set_qpos(robot.qpos());
  if (!options_.support.empty()) plan_.stand_on(options_.support);
  support_ = plan_.support();
  if (options_.drive) {
    drive_.emplace(plan_, *options_.drive);
    servo_.leave(servo_.find(options_.drive->left));
    servo_.leave(servo_.find(options_.drive->right));
  }
  require_distinct(stacks_, "stacks");
  for (const NamedStack& stack : stacks_) {
    laws_.push_back(law_of(plan_, stack, options_));
  }
  collect_tasks();
  check_channels();
  std::vector<std::string> task_names;
  for (const Task* task : tasks_) task_names.push_back(task->name());
  const std::vector<std::string> coordinates = plan_.coordinate_names();
  std::vector<std::string> stack_names;
  for (const NamedStack& stack : stacks_)
    stack_names.push_back(stack.name + std::to_string(static_cast<int>(stack.order)));
  names_ = hash_of_names({&coordinates, &task_names, &command_names_, &stack_names});
  scale_ = command_ = rates_ = Vector::Zero(static_cast<Index>(command_names_.size()));
  Index row = 0;
  for (const Channel& channel : channels_) {
    scale_.segment(row, channel.size()) = channel.scale();
    row += channel.size();
  }
  q_ = qd_ = held_back_ = wished_ = efforts_ = step_ = next_ = Vector::Zero(plan_.size());
  feed_forward_ = FeedForward(servo_, plan_.size(), *options_.decoupled, options_.dt);
  delta_ = Vector::Zero(scale_.size());
  seen_ = Vector::Zero(servo_.size());
  carrying_ = carrying_joints(plan_);
  for (const NamedStack& stack : stacks_) {
    force_tasks_.emplace_back();
    for (Task* const task : tasks_of(stack.stack))
      if (auto* const force = dynamic_cast<ForceTask*>(task)) force_tasks_.back().push_back(force);
  }
  reset(robot.qpos(), true);
}

void WholeBodyController::collect_tasks() {
  for (const NamedStack& stack : stacks_) {
    for (Task* const task : tasks_of(stack.stack)) {
      add_once(task, tasks_);
    }
    for (const StackLevel& level : stack.stack.levels()) {
      if (level.limits) add_once(level.limits, limits_);
    }
  }
  require_distinct(tasks_, "tasks");
  twins_.resize(tasks_.size());
  yielding_ = YieldingTargets(tasks_);
}

void WholeBodyController::check_channels() {
  require_distinct(channels_, "channels");
  led_.assign(static_cast<std::size_t>(servo_.size()), false);
  stopping_ = led_;
  for (const Channel& channel : channels_) {
    for (const std::string& entry : channel.entries()) command_names_.push_back(entry);
    if (channel.kind() == ChannelKind::Drive) {
      require(drive_.has_value(), "channel '" + channel.name() +
                                      "' drives: the controller wants options for its tracks");
    }
    measured_.emplace_back();
    for (const NamedStack& stack : stacks_) {
      const std::vector<Task*> tasks = tasks_of(stack.stack);
      measured_.back().push_back(contains(tasks, channel.task()));
    }
    moved_.emplace_back();
    for (const std::string& name : channel.joint_names()) {
      const Index joint = servo_.find(name);
      require(channel.kind() == ChannelKind::Joints || servo_.coordinate_of(joint) < 0,
              "channel '" + channel.name() + "' moves joint '" + name +
                  "', which the tasks move: it wants a task");
      require(servo_.actuator(joint).part < 0, "channel '" + channel.name() + "' moves '" + name +
                                                   "', a part of a ball joint: it wants a task");
      moved_.back().push_back(joint);
      if (channel.kind() == ChannelKind::Joint) led_[static_cast<std::size_t>(joint)] = true;
    }
    if (channel.kind() == ChannelKind::Control) add_led_control(channel);
    if (channel.kind() == ChannelKind::Twist) add_target_rate(channel);
    if (!channel.task()) continue;
    const auto found = std::find(tasks_.begin(), tasks_.end(), channel.task());
    require(found != tasks_.end(), "channel '" + channel.name() + "' moves task '" +
                                       channel.task()->name() + "', which is in no stack");
    if (channel.kind() != ChannelKind::Delta) continue;
    twins_[static_cast<std::size_t>(found - tasks_.begin())] = channel.task()->clone();
    if (!sensed_) sensed_ = std::make_unique<Robot>(plan_.model(), plan_.coordinate_names());
  }
}

// its names are the last ones by then
void WholeBodyController::add_target_rate(const Channel& channel) {
  for (const TargetRate& one : target_rates_)
    if (one.task == channel.task()) return;
  const Index row = static_cast<Index>(command_names_.size()) - channel.size();
  target_rates_.push_back({channel.task(), row, channel.size(), false});
}

void WholeBodyController::add_led_control(const Channel& channel) {
  const ActuatorControl control = actuator_control(*plan_.model(), channel.actuator());
  for (Index i = 0; i < servo_.size(); ++i) {
    require(servo_.actuator(i).actuator != control.actuator,
            "channel '" + channel.name() + "' leads the control of '" + channel.actuator() +
                "', which the servo of joint '" + servo_.actuator(i).joint +
                "' commands: it wants a JointRate, or a task");
  }
  led_controls_.push_back({&channel, control});
}

std::vector<LevelDiagnostics> WholeBodyController::diagnostics() const {
  constexpr double kTold = 1e-3;  // [unit]
  std::vector<LevelDiagnostics> levels = law().diagnostics(plan_);
  for (std::size_t k = 0; k < levels.size() && !moves_joints_; ++k) {
    for (const Task* const task : law().stack().levels()[k].tasks) {
      const double by = yielding_.given_way(*task);
      if (!(by > kTold)) continue;
      std::vector<std::string> held = servo_.at_peak();
      if (held.empty()) held = {"a torque limit before"};
      levels[k].shortfalls.push_back(gave_way(*task, by, std::move(held)));
    }
  }
  return levels;
}

Task& WholeBodyController::task(const std::string& name) const {
  std::vector<std::string> names;
  for (Task* const task : tasks_) {
    if (task->name() == name) return *task;
    names.push_back(task->name());
  }
  throw Error(unknown_name("task", name, names));
}

std::unique_ptr<WholeBodyController> WholeBodyController::clone(const Robot& robot) const {
  Copies<Task> tasks;
  Copies<JointLimits> limits;
  std::vector<NamedStack> stacks;
  for (const NamedStack& stack : stacks_) {
    std::vector<StackLevel> levels = stack.stack.levels();
    for (StackLevel& level : levels) {
      for (Task*& task : level.tasks) task = tasks.of(task);
      if (level.limits) level.limits = limits.of(level.limits);
    }
    stacks.push_back({stack.name, Stack(std::move(levels)), stack.order});
  }
  std::vector<Channel> channels;
  for (const Channel& channel : channels_) {
    channels.push_back(channel.task() ? channel.with_task(*tasks.of(channel.task())) : channel);
  }
  auto copy = std::make_unique<WholeBodyController>(robot, std::move(stacks), std::move(channels),
                                                    options_);
  copy->forces_ =
      forces_.of([&](ForceTask& task) { return static_cast<ForceTask*>(tasks.of(&task)); });
  copy->kept_ = std::move(tasks.kept);
  copy->kept_limits_ = std::move(limits.kept);
  return copy;
}

void WholeBodyController::reset(const Vector& qpos, bool keep_targets) {
  if (!options_.support.empty()) plan_.stand_on(options_.support);
  support_ = plan_.support();
  plan_.set_qpos(qpos);
  start_ = ahead_ = qpos_ = plan_.qpos();
  qvel_ = Vector::Zero(plan_.nv());
  q_ = plan_.configuration();
  qd_.setZero();
  plan_.set_velocity(qd_);
  held_back_.setZero();
  yielding_.forget();
  command_.setZero();
  rates_.setZero();
  active_ = 0;
  moves_joints_ = scaled_ = begun_ = false;
  stopping_.assign(stopping_.size(), false);
  for (Task* const task : tasks_) {
    if (keep_targets && task->target_is_set()) {
      task->update(plan_);
    } else {
      task->reset(plan_);
    }
    auto* const force = dynamic_cast<ForceTask*>(task);
    if (!force) continue;
    force->set_force(force->options().force_des);
    force->restart_tare();
  }
  for (const auto& law : laws_) law->reset();
  if (drive_) drive_->reset();
  feed_forward_.reset();
  servo_.reset(start_);
  for (LedControl& led : led_controls_)
    led.value = resting_control(*plan_.model(), led.control, start_);
  tell_servos(nullptr);
}

void WholeBodyController::hold_targets() {
  yielding_.forget();
  for (Task* const task : tasks_) task->hold(plan_);
}

// with the accelerations that a law or a move commands
void WholeBodyController::tell_servos(const RobotState* state) {
  if (!options_.feed_forward) return;
  const bool commanded = moves_joints_ || (law().order() == ControlOrder::Acceleration && !scaled_);
  feed_forward_.tell(plan_, qd_, commanded, state, servo_);
}

void WholeBodyController::use(const std::string& name) {
  for (std::size_t i = 0; i < stacks_.size(); ++i) {
    if (stacks_[i].name != name) continue;
    if (i == active_ && !moves_joints_) return;
    const bool torques = by_torques() || stacks_[i].order == ControlOrder::Torque;
    active_ = i;
    if (moves_joints_) take_over();
    if (torques) servo_.forget();  // what its integrals bear, the model knows
    laws_[active_]->take_over(qd_);
    return;
  }
  std::vector<std::string> names;
  for (const NamedStack& stack : stacks_) names.push_back(stack.name);
  throw Error(unknown_name("stack", name, names));
}

// from joints that were moved one by one: the plan stands where they are, the tasks hold there
void WholeBodyController::take_over() {
  moves_joints_ = false;
  plan_.set_qpos(ahead_);
  plan_.set_configuration(q_);
  start_ = plan_.qpos();
  hold_targets();
}

void WholeBodyController::move_joints() {
  if (moves_joints_) return;
  moves_joints_ = true;
  std::fill_n(stopping_.begin(), servo_.coordinate_joints(), true);
  for (const std::vector<Index>& joints : moved_)
    for (const Index joint : joints) stopping_[static_cast<std::size_t>(joint)] = false;
}

void WholeBodyController::move(const std::string& joint, double position, double velocity) {
  const Index place = servo_.find(joint);
  require(std::isfinite(position) && std::isfinite(velocity),
          "move wants a finite position and velocity of joint '" + joint + "', " +
              number_text(position) + " and " + number_text(velocity) + " came");
  move_joints();
  servo_.move(place, position, velocity);
  stopping_[static_cast<std::size_t>(place)] = false;
}

void WholeBodyController::move(const Vector& position, const Vector& velocity) {
  require(position.size() == servo_.size() && velocity.size() == servo_.size() &&
              position.allFinite() && velocity.allFinite(),
          "move wants " + std::to_string(servo_.size()) + " finite positions and velocities, " +
              std::to_string(position.size()) + " and " + std::to_string(velocity.size()) +
              " came");
  move_joints();
  for (Index i = 0; i < servo_.size(); ++i) servo_.move(i, position[i], velocity[i]);
  stopping_.assign(stopping_.size(), false);
}

void WholeBodyController::stand_on(const std::string& body) {
  plan_.set_configuration(q_);
  plan_.set_velocity(qd_);
  feed_forward_.note(plan_);
  plan_.stand_on(body);
  support_ = plan_.support();
  start_ = plan_.qpos();
  if (options_.feed_forward && !*options_.decoupled) servo_.add(feed_forward_.noted_beyond(plan_));
}

void WholeBodyController::sense(ForceTask& task, std::unique_ptr<SpringForce> spring) {
  require_member(task);
  forces_.add(task, std::move(spring));
}

void WholeBodyController::sense(ForceTask& task, int sensor_row, double sign) {
  require_member(task);
  require_rows(sensor_row, 1);
  forces_.add(task, sensor_row, sign);
}

void WholeBodyController::sense(ForceTask& task, int sensor_row, Frame site, double sign) {
  require_member(task);
  require_rows(sensor_row, 3);
  forces_.add(task, sensor_row, sign, site);
}

void WholeBodyController::require_rows(int first, int count) const {
  if (first >= 0 && first + count <= plan_.sensor_rows()) return;
  throw Error("sense wants " + std::to_string(count) + " of " +
              std::to_string(plan_.sensor_rows()) + " rows of sensors, from row " +
              std::to_string(first) + " there are none");
}

void WholeBodyController::require_member(const ForceTask& task) const {
  require(contains(tasks_, static_cast<const Task*>(&task)),
          "force task '" + task.name() + "' is in no stack of the controller");
}

void WholeBodyController::tick(const ConstVectorRef& qpos, const ConstVectorRef& qvel,
                               const Vector* command, bool first, VectorRef ctrl,
                               const double* sensors) {
  require_values("qpos", qpos, start_.size());
  require_values("qvel", qvel, plan_.nv());
  require_size("ctrl", ctrl.size(), plan_.nu());
  if (command) require_command(*command);
  require(sensors || !forces_.want_sensors(),
          "a force task reads a sensor of the model, and no sensors came");
  qpos_ = qpos;
  qvel_ = qvel;
  require_near(qpos_);
  begun_ = true;
  for (Index i = 0; i < servo_.size(); ++i) seen_[i] = servo_.actuator(i).position(qpos_);
  loop_ = nullptr;
  for (Index i = 0; i < servo_.size(); ++i) {
    const JointActuator& one = servo_.actuator(i);
    motors_[static_cast<std::size_t>(one.actuator)].range = one.limits.at(qvel_[one.dof]);
  }
  const RobotState state{qpos_, qvel_, motors_, sensors};
  kinematics(state);
  apply(command, first, state);
  measure();
  solve(state);
  actuate(state, ctrl);
}

// A robot that stands elsewhere than the plan would jump there; one that is elsewhere than a tick ago
// was moved, or is misread.
void WholeBodyController::require_near(const Vector& qpos) const {
  constexpr double kFar = 0.05, kFast = 100.0;  // [rad] or [m], a second
  if (!begun_ && by_torques()) return;
  const double far = begun_ ? kFar + kFast * dt() : kFar;
  for (Index i = 0; i < servo_.size(); ++i) {
    const double there = servo_.actuator(i).position(qpos);
    const double here = begun_ ? seen_[i] : servo_.position()[i];
    if (!(std::abs(there - here) > far)) continue;
    std::string text = "joint '" + servo_.actuator(i).joint + "' is at " + number_text(there);
    text += begun_ ? ", in the tick before at " : ", the plan starts at ";
    text += number_text(here);
    if (std::abs(std::abs(there - here) - 2.0 * std::numbers::pi) < far) {
      text += ": a turn away, angles want to go on beyond it";
    } else {
      text +=
          begun_ ? ": a wrong reading, or it was moved: then reset(qpos)" : ": reset(qpos) first";
    }
    throw Error(text);
  }
}

void WholeBodyController::kinematics(const RobotState& state) {
  if (moves_joints_) {
    ahead_ = state.qpos;  // where a stack will find the robot
    return;
  }
  if (by_torques()) {
    plan_.set_qpos(state.qpos);
    q_ = plan_.configuration();
    plan_.velocities_of(state.qvel, qd_);
    return;
  }
  if (options_.base == BaseSource::Sensed) {
    // what carries the robot 1 / K further: -K e then contains its velocity
    const double lead = law().rate() > 0.0 ? 1.0 / law().rate() : 0.0;
    ahead_ = state.qpos;
    for (const CarryingJoint& joint : carrying_) ahead_[joint.qpos] += lead * state.qvel[joint.dof];
    plan_.set_qpos(ahead_);
    if (plan_.root_qpos() >= 0) {  // the support, and all that stands on it
      const Twist twist = plan_.twist(support_, state.qvel);
      const Vector3 p = plan_.position(support_);
      const Matrix3 turn = rotation_exp(lead * twist.angular);
      auto root = ahead_.segment<7>(plan_.root_qpos());
      const Vector3 moved = p + lead * twist.linear + turn * (Vector3(root.head<3>()) - p);
      const Eigen::Quaterniond turned =
          Eigen::Quaterniond(turn) * Eigen::Quaterniond(root[3], root[4], root[5], root[6]);
      root << moved, turned.w(), turned.vec();
      plan_.set_qpos(ahead_);
    }
  }
  plan_.set_configuration(q_);
}

// what was told a force before, and none since the last tick, has read nothing
void WholeBodyController::miss_readings() {
  if (moves_joints_) return;
  for (ForceTask* const task : force_tasks_[active_]) {
    if (task->take_reading() || !task->is_told()) continue;
    task->sense(plan_, std::numeric_limits<double>::quiet_NaN());
    (void)task->take_reading();
  }
}

void WholeBodyController::apply(const Vector* command, bool first, const RobotState& state) {
  forces_.tell(plan_, state.qpos, state.qvel, state.sensors);
  miss_readings();
  add_up_twists();
  for (TargetRate& rate : target_rates_)
    rate.moves = !rates_.segment(rate.row, rate.size).isZero(0.0);
  Index row = 0;
  for (std::size_t i = 0; i < channels_.size(); ++i) {
    const Index size = channels_[i].size();
    const ChannelKind kind = channels_[i].kind();
    auto part = command_.segment(row, size);
    const bool given = command && !std::isnan((*command)[row]) && reaches(i) &&
                       (first || !channels_[i].acts_once());
    if (given) {
      const auto scale = scale_.segment(row, size);
      part = command->segment(row, size).cwiseMax(-scale).cwiseMin(scale);
    } else {
      part.setConstant(channels_[i].sets() ? std::numeric_limits<double>::quiet_NaN() : 0.0);
    }
    row += size;
    if (kind == ChannelKind::Joints) {
      if (moves_joints_) lead_joints(moved_[i], part);
    } else {
      apply(channels_[i], part, given, state);
    }
  }
  add_up_twists();
  for (const TargetRate& one : target_rates_) {
    // a twist that rests leaves a target that somebody else moves alone
    const auto rate = rates_.segment(one.row, one.size);
    if (one.moves || !rate.isZero(0.0)) one.task->advance(rate, 0.0);  // it moves in move_targets
  }
  if (moves_joints_) stop_joints();
}

// of all channels of a task
void WholeBodyController::add_up_twists() {
  rates_.setZero();
  Index row = 0;
  for (const Channel& channel : channels_) {
    const Index size = channel.size();
    for (const TargetRate& one : target_rates_) {
      if (channel.kind() == ChannelKind::Twist && channel.task() == one.task)
        rates_.segment(one.row, size) += command_.segment(row, size);
    }
    row += size;
  }
}

// a rate moves what the stack that rules measures, nothing else
bool WholeBodyController::reaches(std::size_t channel) const {
  const ChannelKind kind = channels_[channel].kind();
  if (kind != ChannelKind::Twist && kind != ChannelKind::Delta) return true;
  if (moves_joints_) return false;
  return measured_[channel][active_];
}

bool WholeBodyController::takes(const ConstVectorRef& command) const {
  if (command.size() != scale_.size()) return false;
  if (command.size() > 0 && command.array().isNaN().all()) return false;
  Index row = 0;
  for (const Channel& channel : channels_) {
    const auto part = command.segment(row, channel.size()).array();
    if (!part.isNaN().all() && !part.isFinite().all()) return false;
    row += channel.size();
  }
  return true;
}

void WholeBodyController::require_command(const Vector& command) const {
  if (takes(command)) return;
  throw Error("a command wants " + std::to_string(scale_.size()) + " finite numbers, got " +
              std::to_string(command.size()) + (command.allFinite() ? "" : ", not all finite"));
}

void WholeBodyController::apply(const Channel& channel, const ConstVectorRef& command, bool given,
                                const RobotState& state) {
  switch (channel.kind()) {
    case ChannelKind::Twist:
      return;  // all of a task together
    case ChannelKind::Delta:
      if (given && (command.array() != 0.0).any()) set_delta(*channel.task(), command, state);
      return;
    case ChannelKind::Target:
      if (given) channel.task()->assign_target(command);
      return;
    case ChannelKind::Force:
      if (given) static_cast<ForceTask*>(channel.task())->set_force(command[0]);
      return;
    case ChannelKind::Drive:
      return drive_->controller().drive({command[0], command[1]});
    case ChannelKind::Joint: {
      const Index joint = servo_.find(channel.joint_names().front());
      const JointActuator& actuator = servo_.actuator(joint);
      // more than half of full scale opens a grip; less may be what keeps its force
      if (std::abs(command[0]) > 0.5 * channel.scale()[0]) servo_.let_go(joint, command[0], state);
      const double place = servo_.position()[joint] + command[0] * dt();
      const double held = std::clamp(place, actuator.lower, actuator.upper);
      const double rate = held == place ? command[0] : 0.0;
      servo_.move(joint, held, rate);
      for (const JointServo::Tie& tie : servo_.ties(joint)) {
        if (tie.follower >= 0 && !led_[static_cast<std::size_t>(tie.follower)])
          servo_.move(tie.follower, tie.slope * held + tie.shift, tie.slope * rate);
      }
      return;
    }
    case ChannelKind::Control: {
      for (LedControl& led : led_controls_) {
        if (led.channel != &channel) continue;
        led.value = std::clamp(led.value + command[0] * dt(), led.control.lower, led.control.upper);
      }
      return;
    }
    case ChannelKind::Joints:
      return;  // lead_joints
  }
}

void WholeBodyController::lead_joints(const std::vector<Index>& joints,
                                      const ConstVectorRef& rates) {
  for (std::size_t i = 0; i < joints.size(); ++i)
    lead_joint(joints[i], rates[static_cast<Index>(i)], options_.velocity.max_acceleration);
}

// within an acceleration, the speed of its joint and a way to brake before the end of its range, which
// it passes in no case
void WholeBodyController::lead_joint(Index joint, double wanted, double acceleration) {
  const JointActuator& actuator = servo_.actuator(joint);
  const double from = servo_.position()[joint], now = servo_.velocity()[joint];
  const RateLimits limits{.dt = dt(),
                          .horizon = options_.velocity.horizon,
                          .max_velocity = actuator.limits.speed,
                          .max_acceleration = acceleration};
  const RateInterval within =
      rate_interval({actuator.lower - from, actuator.upper - from, now}, limits);
  const double most = acceleration * dt();
  const double rate =
      std::clamp(std::clamp(wanted, within.lower, within.upper), now - most, now + most);
  const double place = from + rate * dt();
  const double held = std::clamp(place, actuator.lower, actuator.upper);
  servo_.move(joint, held, held == place ? rate : 0.0);
}

// what a stack left in motion, and nobody has moved since
void WholeBodyController::stop_joints() {
  for (Index joint = 0; joint < servo_.coordinate_joints(); ++joint) {
    if (!stopping_[static_cast<std::size_t>(joint)]) continue;
    if (servo_.velocity()[joint] == 0.0) {
      stopping_[static_cast<std::size_t>(joint)] = false;
    } else {
      const double most = options_.velocity.max_acceleration;
      lead_joint(joint, 0.0, std::abs(servo_.factor(joint)) * most);
    }
  }
}

// the target where the task is measured to be, and from there by delta
void WholeBodyController::set_delta(Task& task, const ConstVectorRef& delta,
                                    const RobotState& state) {
  const auto found = std::find(tasks_.begin(), tasks_.end(), &task) - tasks_.begin();
  Task& twin = *twins_[static_cast<std::size_t>(found)];
  sensed_->set_qpos(state.qpos);
  twin.hold(*sensed_);
  auto velocity = delta_.head(delta.size());
  velocity = delta / dt();
  twin.advance(velocity, dt());
  velocity.setZero();
  twin.advance(velocity, dt());
  copy_memory(twin, task, scratch_);
}

// tasks become levels  [T 4.3.2]
void WholeBodyController::measure() {
  if (moves_joints_) return;
  laws_[active_]->measure(plan_, qd_);
}

const MotionLaw& WholeBodyController::law(std::size_t stack) const {
  require(stack < laws_.size(), "a controller of " + std::to_string(laws_.size()) +
                                    " stacks, there is no number " + std::to_string(stack));
  return *laws_[stack];
}

// qdot*  [T 4.3.3], q*  [T 4.3.7]
void WholeBodyController::solve(const RobotState& state) {
  scaled_ = false;
  if (moves_joints_) return;
  MotionLaw& law = *laws_[active_];
  law.solve();
  wished_ = law.next_velocity(qd_);
  if (options_.torque_scaling) {
    const bool decoupled = *options_.decoupled && !by_torques();
    const Vector* const growth =
        decoupled ? &feed_forward_.tell_growth(plan_, qd_, state, servo_) : nullptr;
    const double most = law.max_acceleration() * dt();
    scaled_ = law.scale(servo_.velocity_bounds(q_, qd_, state, most, growth), qd_);
  }
  if (scaled_) held_back_ += dt() * (wished_ - law.next_velocity(qd_));
  yielding_.update(scaled_, law.rate(), dt());
  law.integrate(q_, qd_);
  move_targets();
}

// to where the plan is now: at the end of the period
void WholeBodyController::move_targets() {
  for (const TargetRate& one : target_rates_) {
    const auto rate = rates_.segment(one.row, one.size);
    if (!rate.isZero(0.0)) one.task->advance(rate, dt());
  }
}

void WholeBodyController::hold() {
  qd_.setZero();
  command_.setZero();
  rates_.setZero();
  scaled_ = false;
}

void WholeBodyController::distrust(const std::string& joint, bool speed_too) {
  const auto& names = servo_.names();
  const auto found = std::find(names.begin(), names.end(), joint);
  if (found != names.end()) servo_.distrust(found - names.begin(), speed_too);
}

// the references of the servos
void WholeBodyController::refer() {
  if (moves_joints_) {
    servo_.release(q_, qd_);
    plan_.set_configuration(q_);
  } else if (by_torques()) {  // the robot itself, which goes on as it goes
    next_ = q_;
    step_ = dt() * qd_;
    add_step(plan_.rotations(), step_, next_);
    servo_.follow(next_, qd_);
  } else {
    servo_.follow(q_, qd_);
  }
}

// torques  [T A.2.12]
void WholeBodyController::actuate(const RobotState& state, VectorRef ctrl) {
  refer();
  if (by_torques() && !moves_joints_) {
    law().torque(plan_, efforts_);
    servo_.feed_forward(efforts_, false);  // that of `torque` has friction in it
  } else {
    tell_servos(&state);
  }
  servo_.compute(state, ctrl);
  for (const LedControl& led : led_controls_) ctrl[led.control.actuator] = led.value;
  if (drive_) drive_->compute(state, ctrl);
}

void WholeBodyController::lead(const RobotState& state) {
  refer();
  if (drive_) drive_->follow(state);
}

void WholeBodyController::save(StateWriter& writer) const {
  writer.put(names_);
  writer.put(static_cast<double>(active_));
  writer.put(moves_joints_ ? 1.0 : 0.0);
  for (const bool stops : stopping_) writer.put(stops ? 1.0 : 0.0);
  writer.put(static_cast<double>(support_.id));
  // joints that follow the coordinates go on from where they are
  writer.put(plan_.closures() ? plan_.qpos() : start_);
  for (const Vector* vector : {&ahead_, &q_, &qd_}) writer.put(*vector);
  feed_forward_.save(writer);
  writer.put(held_back_);
  writer.put(Vector(command_.array().isNaN().select(0.0, command_)));
  for (const Task* task : tasks_) {
    task->save(writer);
    task->save_settings(writer);
  }
  yielding_.save(writer);
  for (const JointLimits* limits : limits_) limits->save(writer);
  for (const auto& law : laws_) law->save(writer);
  servo_.save(writer);
  for (const LedControl& led : led_controls_) writer.put(led.value);
  if (drive_) drive_->save(writer);
}

void WholeBodyController::restore(StateReader& reader) {
  require(
      reader.get() == names_,
      "restore: the state is that of another controller: of other coordinates, tasks, stacks or "
      "commands");
  active_ = static_cast<std::size_t>(reader.get_count(static_cast<Index>(stacks_.size()) - 1));
  moves_joints_ = reader.get_count(1) > 0;
  for (std::size_t i = 0; i < stopping_.size(); ++i) stopping_[i] = reader.get_count(1) > 0;
  begun_ = true;
  seen_.setConstant(std::numeric_limits<double>::quiet_NaN());  // nobody knows
  const auto support = static_cast<int>(reader.get_count(kMostBodies));
  for (Vector* vector : {&start_, &ahead_, &q_, &qd_}) reader.get(*vector);
  feed_forward_.restore(reader);
  for (Vector* vector : {&held_back_, &command_}) reader.get(*vector);
  for (Task* task : tasks_) {
    task->restore(reader);
    task->restore_settings(reader);
  }
  yielding_.restore(reader);
  for (JointLimits* limits : limits_) limits->restore(reader);
  for (const auto& law : laws_) law->restore(reader);
  servo_.restore(reader);
  for (LedControl& led : led_controls_) led.value = reader.get();
  if (drive_) drive_->restore(reader);
  if (support != support_.id) plan_.stand_on(Frame{support_.type, support});
  support_ = plan_.support();
  plan_.set_qpos(start_);
  scaled_ = false;
}

}  // namespace hurcules
