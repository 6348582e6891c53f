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

std::vector<std::string> names_of(const std::vector<Task*>& tasks) {
  std::vector<std::string> names;
  for (const Task* task : tasks) names.push_back(task->name());
  return names;
}

std::vector<std::string> names_of(const std::vector<NamedStack>& stacks) {
  std::vector<std::string> names;
  for (const NamedStack& stack : stacks) names.push_back(stack.name);
  return names;
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
void add_once(T* one, std::vector<T*>& all) {
  if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
}

}  // namespace

WholeBodyController::WholeBodyController(const Robot& robot, std::vector<NamedStack> stacks,
                                         std::vector<Channel> channels,
                                         WholeBodyControllerOptions options)
    : options_(completed(robot, std::move(options))),
      plan_(robot.model(), robot.coordinate_names()),
      stacks_(std::move(stacks)),
      servo_(robot, options_.servo, options_.dt),
      joints_(servo_, {.dt = options_.dt,
                       .horizon = options_.velocity.horizon,
                       .max_acceleration = options_.velocity.max_acceleration}),
      commands_(std::move(channels), stacks_, plan_, servo_, options_.drive.has_value(),
                options_.dt),
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
  require_distinct(names_of(stacks_), "stacks");
  for (const NamedStack& stack : stacks_) {
    laws_.push_back(law_of(plan_, stack, options_));
  }
  collect_tasks();
  const std::vector<std::string> coordinates = plan_.coordinate_names();
  const std::vector<std::string> tasks = names_of(tasks_);
  std::vector<std::string> stack_names;
  for (const NamedStack& stack : stacks_)
    stack_names.push_back(stack.name + std::to_string(static_cast<int>(stack.order)));
  names_ = hash_of_names({&coordinates, &tasks, &commands_.names(), &stack_names});
  q_ = qd_ = held_back_ = wished_ = efforts_ = step_ = next_ = Vector::Zero(plan_.size());
  feed_forward_ = FeedForward(servo_, plan_.size(), *options_.decoupled, options_.dt);
  seen_ = Vector::Zero(servo_.size());
  carrying_ = carrying_joints(plan_);
  reset(robot.qpos(), true);
}

void WholeBodyController::collect_tasks() {
  for (const NamedStack& stack : stacks_) {
    force_tasks_.emplace_back();
    for (Task* const task : stack.stack.tasks()) {
      add_once(task, tasks_);
      if (auto* const force = dynamic_cast<ForceTask*>(task)) force_tasks_.back().push_back(force);
    }
    for (const StackLevel& level : stack.stack.levels()) {
      if (!level.limits) continue;
      level.limits->update(plan_);  // throws Error for those of another robot
      add_once(level.limits, limits_);
    }
  }
  require_distinct(names_of(tasks_), "tasks");
  yielding_ = YieldingTargets(tasks_);
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
  for (Task* const task : tasks_)
    if (task->name() == name) return *task;
  throw Error(unknown_name("task", name, names_of(tasks_)));
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
  for (const Channel& channel : commands_.channels()) {
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
  active_ = 0;
  moves_joints_ = scaled_ = begun_ = false;
  joints_.leave_all();
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
  commands_.reset(*plan_.model(), start_);
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
  throw Error(unknown_name("stack", name, names_of(stacks_)));
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
  joints_.begin(servo_);
  for (const Index joint : commands_.moved_joints()) joints_.leave(joint);
}

void WholeBodyController::move(const std::string& joint, double position, double velocity) {
  const Index place = servo_.find(joint);
  require(std::isfinite(position) && std::isfinite(velocity),
          "move wants a finite position and velocity of joint '" + joint + "', " +
              number_text(position) + " and " + number_text(velocity) + " came");
  move_joints();
  servo_.move(place, position, velocity);
  joints_.leave(place);
}

void WholeBodyController::move(const Vector& position, const Vector& velocity) {
  require(position.size() == servo_.size() && velocity.size() == servo_.size() &&
              position.allFinite() && velocity.allFinite(),
          "move wants " + std::to_string(servo_.size()) + " finite positions and velocities, " +
              std::to_string(position.size()) + " and " + std::to_string(velocity.size()) +
              " came");
  move_joints();
  for (Index i = 0; i < servo_.size(); ++i) servo_.move(i, position[i], velocity[i]);
  joints_.leave_all();
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
  require(std::find(tasks_.begin(), tasks_.end(), &task) != tasks_.end(),
          "force task '" + task.name() + "' is in no stack of the controller");
}

void WholeBodyController::tick(const ConstVectorRef& qpos, const ConstVectorRef& qvel,
                               const Vector* command, bool first, VectorRef ctrl,
                               const double* sensors) {
  require_values("qpos", qpos, start_.size());
  require_values("qvel", qvel, plan_.nv());
  require_size("ctrl", ctrl.size(), plan_.nu());
  if (command) commands_.require_fit(*command);
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
  const auto stack = moves_joints_ ? std::nullopt : std::optional(active_);
  commands_.apply(command, first, state, {stack, servo_, joints_, drive_});
  if (moves_joints_) joints_.stop(servo_);
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
  commands_.move_targets();
}

void WholeBodyController::hold() {
  qd_.setZero();
  commands_.hold();
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
  commands_.write_controls(ctrl);
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
  joints_.save(writer);
  writer.put(static_cast<double>(support_.id));
  // joints that follow the coordinates go on from where they are
  writer.put(plan_.closures() ? plan_.qpos() : start_);
  for (const Vector* vector : {&ahead_, &q_, &qd_}) writer.put(*vector);
  feed_forward_.save(writer);
  writer.put(held_back_);
  commands_.save(writer);
  for (const Task* task : tasks_) {
    task->save(writer);
    task->save_settings(writer);
  }
  yielding_.save(writer);
  for (const JointLimits* limits : limits_) limits->save(writer);
  for (const auto& law : laws_) law->save(writer);
  servo_.save(writer);
  if (drive_) drive_->save(writer);
}

void WholeBodyController::restore(StateReader& reader) {
  require(
      reader.get() == names_,
      "restore: the state is that of another controller: of other coordinates, tasks, stacks or "
      "commands");
  active_ = static_cast<std::size_t>(reader.get_count(static_cast<Index>(stacks_.size()) - 1));
  moves_joints_ = reader.get_count(1) > 0;
  joints_.restore(reader);
  begun_ = true;
  seen_.setConstant(std::numeric_limits<double>::quiet_NaN());  // nobody knows
  const auto support = static_cast<int>(reader.get_count(kMostBodies));
  for (Vector* vector : {&start_, &ahead_, &q_, &qd_}) reader.get(*vector);
  feed_forward_.restore(reader);
  reader.get(held_back_);
  commands_.restore(reader);
  for (Task* task : tasks_) {
    task->restore(reader);
    task->restore_settings(reader);
  }
  yielding_.restore(reader);
  for (JointLimits* limits : limits_) limits->restore(reader);
  for (const auto& law : laws_) law->restore(reader);
  servo_.restore(reader);
  if (drive_) drive_->restore(reader);
  if (support != support_.id) plan_.stand_on(Frame{support_.type, support});
  support_ = plan_.support();
  plan_.set_qpos(start_);
  scaled_ = false;
}

}  // namespace hurcules
