#include "hurcules/sim/simulation.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <typeinfo>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

std::string seconds(double time) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.3f s", time)));
  return text;
}

int substeps_of(double period, double timestep) {
  const double ratio = period / timestep;
  const double whole = std::round(ratio);
  require(whole >= 1.0 && std::abs(ratio - whole) < 1e-6,
          "the controller's period wants to be a whole number of physics steps of " +
              number_text(timestep) + " s, it is " + number_text(period) + " s");
  return static_cast<int>(whole);
}

std::shared_ptr<WholeBodyController> checked(std::shared_ptr<WholeBodyController> controller,
                                             const mjModel* m, bool physics) {
  require(controller != nullptr, "a simulation wants a controller, none came");
  const mjModel* const own = controller->plan().model().get();
  require(own->nq == m->nq && own->nv == m->nv && own->nu == m->nu && own->nbody == m->nbody,
          "the controller is for another model than the simulation: nq, nv, nu, nbody " +
              std::to_string(own->nq) + ", " + std::to_string(own->nv) + ", " +
              std::to_string(own->nu) + ", " + std::to_string(own->nbody) + " instead of " +
              std::to_string(m->nq) + ", " + std::to_string(m->nv) + ", " + std::to_string(m->nu) +
              ", " + std::to_string(m->nbody));
  require(controller->plan().identity().structure == structure_of(*m),
          "the controller is for another model than the simulation: bodies, joints, sites or what "
          "the actuators drive differ in name or order");
  require(!physics || controller->servo().coordinate_joints() > 0,
          "no joint of the robot has an actuator: in the physics nothing would move it; "
          "hurcules.with_motors and load_urdf (Python) give each joint a motor");
  for (const NamedStack& stack : controller->stacks())
    require(physics || stack.order != ControlOrder::Torque,
            "stack '" + stack.name + "' goes by torques: without physics they move nothing");
  return controller;
}

std::vector<std::string> phases_of(const Supervisor* supervisor) {
  return supervisor ? supervisor->phase_names() : std::vector<std::string>{};
}

}  // namespace

Simulation::Simulation(ModelPtr model, std::shared_ptr<WholeBodyController> controller,
                       SimulationOptions options, std::unique_ptr<Supervisor> supervisor,
                       mjData* data)
    : options_(std::move(options)),
      plant_(std::move(model), data),
      controller_(checked(std::move(controller), plant_.model(), options_.physics)),
      supervisor_(std::move(supervisor)),
      world_(plant_.model_ptr(), controller_->plan().coordinate_names()),
      substeps_(substeps_of(controller_->dt(), plant_.dt())),
      power_meter_(plant_.model(), options_.power),
      battery_(options_.battery),
      sensors_(world_, controller_->dt(), options_.sensors),
      monitors_(plant_.model(), world_.root_bodies(), options_.power.motors, controller_->dt(),
                options_.monitors),
      limit_monitor_(world_, controller_->servo().pid().options().max_torque),
      fall_monitor_({options_.fall.min_height, options_.fall.max_tilt}),
      record_(*controller_, phases_of(supervisor_.get())),
      measured_(*controller_),
      obstacles_(*controller_, world_),
      initial_qpos_(controller_->plan().qpos()),
      seen_qpos_(world_.qpos()),
      seen_qvel_(Vector::Zero(plant_.model()->nv)),
      true_qvel_(seen_qvel_),
      summed_(Vector::Zero(controller_->scale().size())),
      wished_(Vector::Zero(world_.size())),
      support_(controller_->plan().support()) {
  require(options_.max_seconds > 0.0,
          "max_seconds wants a time above 0 [s], " + number_text(options_.max_seconds) + " came");
  const FallOptions& fall = options_.fall;
  if (!fall.frame.empty()) fall_frame_ = world_.frame(fall.frame);
  require(fall_frame_ || !std::isfinite(fall.min_height), "fall: min_height wants a frame");
  require(fall.max_tilt >= 0.0 && (fall.max_tilt <= std::numbers::pi || std::isinf(fall.max_tilt)),
          "fall: max_tilt wants an angle from 0 to pi [rad], or inf, " +
              number_text(fall.max_tilt) + " came");
  if (mj_name2id(plant_.model(), mjOBJ_SITE, "casualty_chest") >= 0) {
    target_ = world_.frame("casualty_chest");
  }
  if (sensors_.alter_state()) {
    seen_ = std::make_unique<Robot>(plant_.model_ptr(), world_.coordinate_names());
  }
  monitors_.add_log_channels(record_.log);
  sensors_.add_log_channels(record_.log);
  if (!options_.physics) {
    placed_ = std::make_unique<Robot>(plant_.model_ptr(), world_.coordinate_names());
    if (const std::string& support = controller_->options().support; !support.empty()) {
      placed_->stand_on(support);
    }
  }
  if (supervisor_) supervisor_->attach(plant_, record_.log);
  // the last one: copies take no time, and have the other columns where they are
  if (options_.clock) record_.log.add("tick_us", &record_.telemetry.tick_us);
  begin(options_.seed, nullptr, !supervisor_);
  measure_state();
}

std::unique_ptr<Simulation> Simulation::clone(ModelPtr model) const {
  const ModelPtr own = model ? std::move(model) : plant_.model_ptr();
  Robot robot(controller_->plan().model(), world_.coordinate_names());
  robot.set_qpos(initial_qpos_);
  std::shared_ptr<WholeBodyController> controller = controller_->clone(robot);
  std::unique_ptr<Supervisor> supervisor;
  if (supervisor_) {
    supervisor = supervisor_->clone(*controller);
    const Supervisor &made = *supervisor, &own_one = *supervisor_;
    require(typeid(made) == typeid(own_one),
            "the clone of the mission is of another class: its class wants a clone of its own");
  }
  SimulationOptions options = options_;
  options.record = false;
  options.clock = nullptr;
  auto copy = std::make_unique<Simulation>(own, std::move(controller), std::move(options),
                                           std::move(supervisor));
  copy->data_seen_ = copy->supervisor_ != nullptr;
  copy->restore(state());
  return copy;
}

int Simulation::step(int n, const Vector* command, bool begins) {
  if (n < 0) throw Error("step wants a number of ticks >= 0, got " + std::to_string(n));
  if (command) controller_->require_command(*command);
  if (!controller_->serves(this))
    throw Error(
        "another loop has taken the controller of this simulation: one loop a controller, "
        "or reset it first");
  if (options_.record) record_.log.reserve(static_cast<std::size_t>(n));
  if (options_.clock) record_.timings.reserve(static_cast<std::size_t>(n));
  if (!finished() && !plant_.check()) end(Ending::Diverged, time());
  int done = 0;
  for (; done < n && !finished(); ++done) tick(command, begins && done == 0);
  observe();
  return done;
}

void Simulation::tick(const Vector* command, bool first) {
  StageTimer timer(options_.clock, record_.stage_seconds);
  sense();
  check_sensors();
  const RobotState state = sensed();
  timer.done(Stage::Sense);
  think(state, command, first, timer);
  if (options_.physics) {
    actuate(state);
    timer.done(Stage::Servo);
    advance_plant();
  } else {
    controller_->lead(state);
    timer.done(Stage::Servo);
    advance_plan();
  }
  timer.done(Stage::Physics);
  record();
  timer.done(Stage::Record);
  if (options_.clock) record_.timings.record();
  judge();
}

// from what is sensed to the reference; one who is held has no other thought than to stay
void Simulation::think(const RobotState& state, const Vector* command, bool first,
                       StageTimer& timer) {
  WholeBodyController& controller = *controller_;
  if (held()) {
    controller.hold();
    record_.telemetry.qd_des.setZero();
    record_.telemetry.yielding = 0.0;
    for (const Stage stage : {Stage::Kinematics, Stage::Problem, Stage::Solve}) timer.done(stage);
    return;
  }
  controller.kinematics(state);
  timer.done(Stage::Kinematics);
  if (supervisor_ && (!command || options_.adds_command)) {
    const Vector& own = supervisor_->command(dt());
    if (command) controller.add_commands(own, *command, first, summed_);
    command = command ? &summed_ : &own;
    first = true;  // what a mission sets it sets in each tick
  }
  controller.apply(command, first, state);
  obstacles_.tell(world_, plant_, true_qvel_, dt());
  controller.measure();
  timer.done(Stage::Problem);
  controller.solve(state);
  record_.note_solution(controller);
  timer.done(Stage::Solve);
}

double Simulation::link_age() const {
  return heard_ ? time() - *heard_ : 0.0;
}

// what the joint encoders and the base say
void Simulation::sense() {
  seen_qpos_ = std::as_const(plant_).qpos();
  true_qvel_ = seen_qvel_ = std::as_const(plant_).qvel();
  // the first tick of a step finds what was observed after the last one
  if (world_.qpos() != seen_qpos_) world_.set_qpos(seen_qpos_);
  measured_.forget();
  base_fresh_ = false;
  if (seen_) {
    sensors_.overwrite(seen_qpos_, seen_qvel_);
    seen_->set_qpos(seen_qpos_);
  }
  record_.note_sensed(*controller_, {world_, seen(), true_qvel_, seen_qvel_});
  if (supervisor_ || options_.record) note_base();
}

void Simulation::note_base() const {
  if (base_fresh_) return;
  record_.note_base({world_, seen(), true_qvel_, seen_qvel_}, support_, target_);
  base_fresh_ = true;
}

RobotState Simulation::sensed() {
  return {seen_qpos_, seen_qvel_, plant_.actuators(), plant_.data()->sensordata};
}

// an encoder that cannot be believed holds the robot for good: all brakes close, behind which the
// motors rest
void Simulation::check_sensors() {
  // a reference that is scaled down must not hide an encoder that is stuck
  wished_ = controller_->q_des() + controller_->held_back();
  if (!held()) finding_ = sensors_.monitor(wished_);
  if (!held()) return;
  plant_.brakes().close();
  // where no brake bears the joint, its servo must not follow what is not believed
  const bool speed = finding_.speed || finding_.trouble == SensorMonitor::Trouble::Disagrees;
  controller_->distrust(sensors_.joint_of(finding_), speed);
}

void Simulation::actuate(const RobotState& state) {
  Eigen::Map<Vector> ctrl(plant_.data()->ctrl, plant_.model()->nu);
  controller_->actuate(state, ctrl);
  if (supervisor_ && !held() && !battery_.empty()) supervisor_->brake(plant_.brakes());
  if (const std::optional<TrackDrive>& drive = controller_->drive();
      drive && !held() && !battery_.empty()) {
    for (const JointActuator* belt : {&drive->left(), &drive->right()}) {
      plant_.brakes().set_closed(belt->actuator, drive->braked());
    }
  }
  record_.note_servo(*controller_);
}

void Simulation::advance_plant() {
  plant_.step(substeps_);
  power_meter_.read(plant_.data(), plant_.brakes(), plant_.drive_train());
  battery_.draw(power_meter_.total(), dt());
  if (battery_.empty()) plant_.brakes().close();
  record_.telemetry.power = power_meter_.total();
  record_.telemetry.charge = battery_.charge();
  if (!plant_.is_sound()) return;
  sensors_.sample(plant_.model(), plant_.data(), static_cast<double>(ticks_ + 1) * dt());
  monitors_.look(plant_.model(), plant_.data(), record_.telemetry.power);
}

// without physics: coordinates, joints that were moved one by one, and the tracks, as commanded
void Simulation::advance_plan() {
  if (placed_->qpos() != std::as_const(plant_).qpos())
    placed_->set_qpos(std::as_const(plant_).qpos());
  placed_->set_configuration(controller_->q_des());
  seen_qpos_ = placed_->qpos();
  const JointServo& servo = controller_->servo();
  const std::optional<TrackDrive>& drive = controller_->drive();
  for (Index i = 0; i < servo.size(); ++i) {
    const bool belt = drive && (servo.actuator(i).actuator == drive->left().actuator ||
                                servo.actuator(i).actuator == drive->right().actuator);
    if (!belt) servo.place(i, seen_qpos_);
  }
  if (drive) drive->roll(seen_qpos_, placed_->com(), dt());  // skids about its weight
  plant_.move(seen_qpos_, dt());
}

// figures, limits and the row of the log
void Simulation::record() {
  Telemetry& telemetry = record_.telemetry;
  limit_monitor_.look(telemetry);
  telemetry.link_age = link_age();
  if (supervisor_) {
    const auto report = [&](const std::vector<const Task*>& tasks) {
      return TickReport{telemetry.time, controller_->law().active_limits(),
                        telemetry.tracking_error, limit_monitor_.commanded().torque, tasks};
    };
    supervisor_->note_commanded(*controller_, report(measured_.planned()));
    measure_world();
    if (!options_.physics) plant_.see();
    supervisor_->note_measured(report(measured_.all()));
  } else if (options_.record) {
    measure_world();
  }
  record_.note_events(monitors_);
  telemetry.tick_us = 1e6 * record_.stage_seconds.head<5>().sum();  // sense to servo
  if (options_.record) record_.log.record();
}

// [m] of the frame that falls
double Simulation::height() const {
  if (!fall_frame_) return std::numeric_limits<double>::infinity();
  const Vector3 place = world_.position(*fall_frame_);
  if (controller_->plan().floating()) return place.z();
  return fall_monitor_.height(world_.orientation(support_), place - world_.position(support_));
}

// what the tick means for the run; the clock goes on
void Simulation::judge() {
  const double now = time();
  record_.telemetry.time = static_cast<double>(++ticks_) * dt();
  if (!plant_.is_sound()) return end(Ending::Diverged, now);
  if (controller_->law().solution().status == SolverStatus::InvalidInput) {
    return end(Ending::SolverFailed, now);
  }
  if (fall_monitor_.fell(world_.orientation(support_), height())) return end(Ending::Fell, now);
  if (time() >= options_.max_seconds) return end(Ending::TimeUp, time());
  if (held()) {
    ++held_ticks_;
    const double held_for = static_cast<double>(held_ticks_) * dt();
    if (held_for >= options_.sensors.hold_seconds) end(Ending::Held, now);
    return;
  }
  if (!supervisor_) return;
  const std::size_t phase = supervisor_->phase();
  if (options_.physics && supervisor_->unborne()) record_.note(EventKind::Unborne, phase);
  const std::optional<double> asked = supervisor_->asks_until();
  const bool goes_on = supervisor_->advance(*controller_, time());
  if (const std::optional<Cause> cause = supervisor_->reacted()) {
    record_.note(EventKind::Reacted, cause->phase, static_cast<int>(cause->trouble),
                 static_cast<int>(cause->reaction));
  }
  if (!goes_on) {
    return end(supervisor_->verdict().empty() ? Ending::Completed : Ending::Missed, now);
  }
  if (supervisor_->phase() != phase) record_.note_phase(supervisor_->phase());
  if (const auto asks = supervisor_->asks_until(); asks && asks != asked) {
    record_.note(EventKind::Asked, supervisor_->phase());
  }
  stand_on_new_support();
}

// a phase may have the robot stand on another body
void Simulation::stand_on_new_support() {
  const Frame support = controller_->plan().support();
  if (support.id == support_.id) return;
  support_ = support;
  fall_monitor_.reset(world_.orientation(support_));
  if (placed_) placed_->stand_on(controller_->plan().support_name());
}

// what somebody outside sees between two calls: the state as it is now
void Simulation::observe() {
  if (!plant_.is_sound()) return;
  if (!options_.physics && data_seen_) plant_.see();
  sense();
}

void Simulation::measure_world() const {
  measured_.measure(world_);
  record_.note_measured(*controller_, measured_.all());
}

const Telemetry& Simulation::telemetry() const {
  note_base();
  if (plant_.is_sound()) measure_world();
  return record_.telemetry;
}

const Recorder& Simulation::observation(bool measured) const {
  note_base();
  if (measured && plant_.is_sound()) measure_world();
  return record_.observation;
}

const Recorder& Simulation::log() const {
  note_base();
  return record_.log;
}

void Simulation::end(Ending ending, double time) {
  ending_ = ending;
  ending_time_ = time;
}

std::string Simulation::reason() const {
  switch (ending_) {
    case Ending::Running:
      return "";
    case Ending::Completed:
      return "completed";
    case Ending::Missed:
      return std::string(supervisor_->verdict());
    case Ending::TimeUp:
      return "time is up at " + seconds(ending_time_) +
             (supervisor_ ? " in " + supervisor_->waits_for() : std::string());
    case Ending::Fell:
      return "fell over at " + seconds(ending_time_) + ": " +
             fall_monitor_.text(world_.orientation(support_), height());
    case Ending::Diverged:
      return "diverged at " + seconds(ending_time_);
    case Ending::SolverFailed:
      return "the solver refused its input at " + seconds(ending_time_);
    case Ending::Held: {
      const double since = ending_time_ - static_cast<double>(held_ticks_ - 1) * dt();
      return "held since " + seconds(since) + ": " + sensors_.text(finding_);
    }
  }
  return "";
}

std::vector<Figure> Simulation::figures() const {
  std::vector<Figure> figures;
  if (supervisor_) figures = supervisor_->figures();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    figures.push_back({Monitors::names()[static_cast<std::size_t>(i)], monitors_.worst(i), none});
  }
  return figures;
}

Vector Simulation::operator_command() {
  if (supervisor_) return supervisor_->command(dt());
  return Vector::Zero(controller_->scale().size());
}

void Simulation::set_brake(const std::string& joint, bool closed) {
  plant_.brakes().set_closed(plant_.brakes().find(joint), closed);
}

void Simulation::reset(std::uint64_t seed, const Vector* start) {
  if (start) require_values("start, a qpos,", *start, plant_.model()->nq);
  begin(seed, start, false);
}

void Simulation::begin(std::uint64_t seed, const Vector* start, bool keep_targets) {
  controller_->serve(this);
  options_.seed = seed;
  ticks_ = 0;
  heard_.reset();
  ending_ = Ending::Running;
  record_.reset();
  battery_.reset();
  record_.telemetry.charge = battery_.charge();
  place(seed, start, keep_targets);
  limit_monitor_.reset();
  if (options_.physics) {
    plant_.feel();
    monitors_.reset(plant_.model(), plant_.data());
  } else {
    plant_.see();
    monitors_.reset();
  }
  sensors_.reset(plant_.data(), seed);
  finding_ = {};
  held_ticks_ = 0;
  support_ = controller_->plan().support();
  fall_monitor_.reset(world_.orientation(support_));
  if (supervisor_) {
    supervisor_->reset(*controller_, world_);
    record_.note_phase(supervisor_->phase());
  }
  observe();
}

void Simulation::place(std::uint64_t seed, const Vector* where, bool keep_targets) {
  Vector start = where ? *where : initial_qpos_;
  if (supervisor_ && !where) {
    start = supervisor_->start(plant_, controller_->plan_to_place(), seed);
  }
  plant_.reset(-1);
  plant_.place(start);
  controller_->reset(start, keep_targets);
  if (options_.physics && options_.loaded_springs) plant_.load_springs();
  world_.set_qpos(std::as_const(plant_).qpos());
}

void Simulation::go(std::size_t phase) {
  require(supervisor_ != nullptr, "a simulation without a mission has no phases");
  const std::size_t phases = supervisor_->phase_names().size();
  require(phase < phases, "go wants a phase from 0 to " + std::to_string(phases - 1) + ", got " +
                              std::to_string(phase));
  if (finished()) return;
  supervisor_->go(phase, *controller_, time());
  record_.note_phase(phase);
  stand_on_new_support();
}

void Simulation::pause() {
  require(supervisor_ != nullptr,
          "a simulation without a mission has no phases to pause; its controller's "
          "move_joints() stops the robot, hold_targets() holds it");
  if (finished() || paused()) return;
  supervisor_->pause();
  record_.note(EventKind::Paused, supervisor_->phase());
}

void Simulation::resume() {
  require(supervisor_ != nullptr, "a simulation without a mission has no phases to resume");
  if (finished() || !paused()) return;
  supervisor_->resume(*controller_, time());
  record_.note(EventKind::Resumed, supervisor_->phase());
}

std::string Simulation::question() const {
  return supervisor_ && !finished() ? supervisor_->question() : "";
}

void Simulation::answer(bool yes) {
  require(!paused(), "the mission is paused: resume, and what it asks is asked again");
  require(supervisor_ && !finished() && supervisor_->asks_until(),
          "answer wants a mission that asks (reaction 'ask 30 s'), nothing is asked now");
  supervisor_->answer(yes);
}

}  // namespace hurcules
