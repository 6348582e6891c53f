// What a tick leaves behind: measured values, errors, events, and why a run ended.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "hurcules/base/pose.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

namespace {

std::string seconds(double time) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%.3f s", time)));
  return text;
}

std::string number(double value) {
  std::string text(32, '\0');
  text.resize(static_cast<std::size_t>(std::snprintf(text.data(), text.size(), "%g", value)));
  return text;
}

}  // namespace

std::vector<Figure> Simulation::figures() const {
  std::vector<Figure> figures = mission_->figures();
  const double none = std::numeric_limits<double>::quiet_NaN();
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    figures.push_back({Monitors::names()[static_cast<std::size_t>(i)], monitors_.worst(i), none});
  }
  return figures;
}

void Simulation::sense_coordinates() {
  telemetry_.q = world_.configuration();
  telemetry_.seen_q = seen().configuration();
  const auto qvel = std::as_const(physics_).qvel();
  for (Index i = 0; i < world_.size(); ++i) {
    const DrivenJoint& joint = world_.coordinates()[static_cast<std::size_t>(i)].joints.front();
    telemetry_.qd[i] = qvel[joint.dof] / joint.factor;
    telemetry_.seen_qd[i] = seen_qvel_[joint.dof] / joint.factor;
  }
  if (const Task* const limits = controller_->limits()) {
    telemetry_.limit_lower = limits->lower();
    telemetry_.limit_upper = limits->upper();
  }
  telemetry_.lag = telemetry_.q_des - telemetry_.seen_q;
  telemetry_.to_lower = telemetry_.seen_q - telemetry_.limit_lower;
  telemetry_.to_upper = telemetry_.limit_upper - telemetry_.seen_q;
}

void Simulation::sense_base() {
  telemetry_.base_position = world_.position(support_);
  telemetry_.base_rotation = rotation_log(world_.orientation(support_));
  const Matrix3 R = seen().orientation(support_);
  const Vector3 p = seen().position(support_);
  const Twist twist = seen().twist(support_, seen_qvel_);
  telemetry_.seen_base_position = p;
  telemetry_.seen_base_rotation = rotation_log(R);
  telemetry_.base_velocity = twist.linear;
  telemetry_.base_spin = twist.angular;
  if (casualty_) telemetry_.target_in_base = R.transpose() * (world_.position(*casualty_) - p);
}

// an encoder that cannot be believed holds the robot for good: all brakes close, behind which the
// motors rest
void Simulation::check_sensors() {
  // a reference that yields must not hide an encoder that is stuck
  wished_ = telemetry_.q_des + held_back_;
  if (!held()) finding_ = sensors_.watch(wished_);
  if (held()) physics_.brakes().close();
}

// what somebody outside sees between two calls: the state as it is now
void Simulation::observe() {
  if (!physics_.is_sound()) return;
  sense();
  measure_actual();
}

void Simulation::measure_actual() {
  for (const StackLevel& level : controller_->stack().levels()) {
    for (Task* task : level.tasks) {
      if (!task->bounds_coordinates()) task->update(world_);
    }
  }
  copy_errors(telemetry_.level_error_measured, telemetry_.task_error_measured);
}

// the errors as the tasks were measured last; limits have none
void Simulation::copy_errors(Vector& levels, Vector& rows) const {
  const StackPlaces& places = places_[controller_of_phase_[mission_->phase()]];
  for (std::size_t k = 0; k < places.level.size(); ++k) {
    double square = 0.0;
    Index row = places.first_row[k];
    for (const Task* task : controller_->stack().levels()[k].tasks) {
      if (task->bounds_coordinates()) continue;
      square += task->error().squaredNorm();
      rows.segment(row, task->rows()) = task->error();
      row += task->rows();
    }
    levels[places.level[k]] = std::sqrt(square);
  }
}

void Simulation::note_solution() {
  const Solution& solution = controller_->solution();
  telemetry_.factorizations = solution.factorizations;
  telemetry_.changes = solution.changes;
  telemetry_.iterations = 1.0 + solution.changes;
  telemetry_.status = static_cast<double>(static_cast<int>(solution.status));
  telemetry_.optimality = solution.optimality;
  telemetry_.active = controller_->active_limits().cast<double>();
  telemetry_.level_active.setZero();
  const StackPlaces& places = places_[controller_of_phase_[mission_->phase()]];
  for (const ActiveRow& active : solution.working_set) {
    telemetry_.level_active[places.level[static_cast<std::size_t>(active.held_by)]] += 1.0;
  }
  copy_errors(telemetry_.level_error, telemetry_.task_error);
}

void Simulation::note_events() {
  for (Index i = 0; i < plan_.size(); ++i) {
    if (telemetry_.active[i] == previous_active_[i]) continue;
    const bool met = telemetry_.active[i] != 0.0;
    const double side = met ? telemetry_.active[i] : previous_active_[i];
    events_.add({telemetry_.time, met ? EventKind::LimitMet : EventKind::LimitReleased, i,
                 static_cast<int>(side)});
  }
  previous_active_ = telemetry_.active;
}

void Simulation::note_alarms() {
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    const double alarm = monitors_.alarm(i) ? 1.0 : 0.0;
    if (alarm == previous_alarm_[i]) continue;
    events_.add({telemetry_.time, alarm > 0.0 ? EventKind::AlarmRaised : EventKind::AlarmFell, i,
                 Monitors::falls(i) ? -1 : 1});
    previous_alarm_[i] = alarm;
  }
}

std::string Simulation::text(const Event& event) const {
  if (event.kind == EventKind::AlarmRaised || event.kind == EventKind::AlarmFell) {
    const std::string& quantity = Monitors::names()[static_cast<std::size_t>(event.what)];
    const std::string side = event.side > 0 ? " above " : " below ";
    return (event.kind == EventKind::AlarmRaised ? "alarm: " : "alarm over: ") + quantity + side +
           number(monitors_.threshold(event.what));
  }
  if (event.kind == EventKind::PhaseStarted) {
    return "phase " + mission_->phases()[static_cast<std::size_t>(event.what)].name;
  }
  const std::string& name = names_.coordinates[static_cast<std::size_t>(event.what)];
  const std::string side = event.side > 0 ? "upper" : "lower";
  return name + (event.kind == EventKind::LimitMet ? " meets its " : " leaves its ") + side +
         " limit";
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
      return std::string(mission_->verdict());
    case Ending::TimeUp:
      return "time is up at " + seconds(ending_time_);
    case Ending::Fell:
      return "fell over at " + seconds(ending_time_);
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

Vector Simulation::operator_command() {
  return mission_->operator_command(dt());
}

}  // namespace hurcules
