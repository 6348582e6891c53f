#include "hurcules/sim/simulation.hpp"

#include <utility>

#include "hurcules/base/error.hpp"

namespace hurcules {

int Simulation::step(int n, const Vector* command) {
  if (n < 0) throw Error("step wants a number of ticks >= 0, got " + std::to_string(n));
  const auto channels = static_cast<Index>(mission_->channels().size());
  if (command && !(command->size() == channels && command->allFinite())) {
    throw Error("a command wants " + std::to_string(channels) + " finite numbers, got " +
                std::to_string(command->size()) + (command->allFinite() ? "" : ", not all finite"));
  }
  if (options_.record) log_.reserve(static_cast<std::size_t>(n));
  if (options_.clock) timings_.reserve(static_cast<std::size_t>(n));
  if (!finished() && !physics_.check()) end(Ending::Diverged, time());
  int done = 0;
  for (; done < n && !finished(); ++done) tick(command);
  observe();
  return done;
}

void Simulation::tick(const Vector* command) {
  StageTimer timer(options_.clock, stage_seconds_);
  sense();
  check_sensors();
  timer.done(Stage::Sense);
  think(command, timer);
  servo();
  timer.done(Stage::Servo);
  advance_physics();
  timer.done(Stage::Physics);
  record();
  timer.done(Stage::Record);
  if (options_.clock) timings_.record();
  judge();
}

// from what is seen to the reference; one who is held has no other thought than to stay
void Simulation::think(const Vector* command, StageTimer& timer) {
  if (held()) {
    telemetry_.qd_des.setZero();
    telemetry_.yielding = 0.0;
    for (const Stage stage : {Stage::Kinematics, Stage::Problem, Stage::Solve}) timer.done(stage);
    return;
  }
  kinematics();
  timer.done(Stage::Kinematics);
  hierarchy(command);
  timer.done(Stage::Problem);
  solve();
  timer.done(Stage::Solve);
  integrate();
}

// what the joint encoders and the base say
void Simulation::sense() {
  seen_qpos_ = std::as_const(physics_).qpos();
  seen_qvel_ = std::as_const(physics_).qvel();
  world_.set_qpos(seen_qpos_);
  if (seen_) {
    sensors_.overwrite(seen_qpos_, seen_qvel_);
    seen_->set_qpos(seen_qpos_);
  }
  sense_coordinates();
  sense_base();
}

// the reference configuration, on its support
void Simulation::kinematics() {
  if (options_.base == BaseSource::Sensed) plan_.set_qpos(seen().qpos());
  plan_.set_configuration(telemetry_.q_des);
}

// targets move by the command, then tasks become levels  [T 4.3.2]
void Simulation::hierarchy(const Vector* command) {
  mission_->apply(plan_, command ? *command : mission_->operator_command(dt()), dt());
  telemetry_.command = mission_->command();
  controller_->measure(plan_);
}

// qdot*  [T 4.3.3]
void Simulation::solve() {
  telemetry_.qd_des = controller_->solve();
  give_way();
  note_solution();
}

// no further than the motors can hold; every target then follows the robot as fast as the gain
// would have led the robot to it
void Simulation::give_way() {
  const RateWindow& window = servo_.find_window(telemetry_.q_des, {seen_qpos_, seen_qvel_});
  telemetry_.yielding = controller_->give_way(window) ? 1.0 : 0.0;
  if (telemetry_.yielding == 0.0) return;
  mission_->relax(controller_->options().gain * dt());
  held_back_ += dt() * (telemetry_.qd_des - controller_->velocity());
  telemetry_.qd_des = controller_->velocity();
}

// q*  [T 4.3.7]
void Simulation::integrate() {
  controller_->integrate(telemetry_.q_des);
}

// torques  [T A.2.12]
void Simulation::servo() {
  servo_.mind(physics_.brakes());
  servo_.act({telemetry_.q_des, telemetry_.qd_des}, {seen_qpos_, seen_qvel_}, physics_.data());
  telemetry_.torque = servo_.torque();
  telemetry_.demand = servo_.demand();
  telemetry_.joint_error = servo_.error().position;
}

void Simulation::advance_physics() {
  physics_.step();
  power_meter_.read(physics_.data(), physics_.brakes(), physics_.drive_train());
  battery_.draw(power_meter_.total(), dt());
  if (battery_.empty()) physics_.brakes().close();
  telemetry_.power = power_meter_.total();
  telemetry_.charge = battery_.charge();
  if (!physics_.is_sound()) return;
  sensors_.sample(physics_.model(), physics_.data(), static_cast<double>(ticks_ + 1) * dt());
  monitors_.look(physics_.model(), physics_.data(), telemetry_.power);
}

// figures, limits and the row of the log; the tasks are left as measured at the real motion
void Simulation::record() {
  limit_watch_.look(telemetry_);
  const auto joints = static_cast<Index>(servo_.coordinate_joints());
  const TickReport report = {telemetry_.time, controller_->active_limits(),
                             telemetry_.joint_error.head(joints).cwiseAbs().maxCoeff(),
                             limit_watch_.commanded().torque};
  mission_->note_commanded(report);
  measure_actual();
  mission_->note_measured(report);
  note_events();
  note_alarms();
  telemetry_.tick_us = 1e6 * stage_seconds_.head<5>().sum();  // sense to servo
  if (options_.record) log_.record();
}

// what the tick means for the run; the clock goes on
void Simulation::judge() {
  const double now = telemetry_.time;
  telemetry_.time = static_cast<double>(++ticks_) * dt();
  if (!physics_.is_sound()) return end(Ending::Diverged, now);
  if (controller_->solution().status == SolverStatus::InvalidInput) {
    return end(Ending::SolverFailed, now);
  }
  const double height = world_.position(pelvis_).z() - world_.position(support_).z();
  if (fall_watch_.fell(world_.orientation(support_), height)) {
    return end(Ending::Fell, now);
  }
  if (telemetry_.time >= mission_->setup().max_seconds) return end(Ending::TimeUp, now);
  if (held()) {
    ++held_ticks_;
    const double held_for = static_cast<double>(held_ticks_) * dt();
    if (held_for >= options_.sensors.hold_seconds) end(Ending::Held, now);
    return;
  }
  const std::size_t phase = mission_->phase();
  if (!mission_->select_phase(plan_, telemetry_.time)) {
    return end(mission_->verdict().empty() ? Ending::Completed : Ending::Missed, now);
  }
  if (mission_->phase() != phase) enter_phase();
}

}  // namespace hurcules
