#include "hurcules/sim/run_record.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hurcules/base/number_text.hpp"
#include "hurcules/base/pose.hpp"

namespace hurcules {

namespace {

Index find(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<Index>(std::find(names.begin(), names.end(), name) - names.begin());
}

// level names of a stack, and those of its tasks that are among these, after those that are there:
// limits, and what a law adds on its own, have no errors
void add_names(const Stack& stack, const std::vector<Task*>& tasks, TelemetryNames& names) {
  for (const StackLevel& level : stack.levels()) {
    if (find(names.levels, level.name) == static_cast<Index>(names.levels.size())) {
      names.levels.push_back(level.name);
    }
    for (const Task* task : level.tasks) {
      if (std::find(tasks.begin(), tasks.end(), task) == tasks.end()) continue;
      if (find(names.task_rows, task->name() + "/0") < static_cast<Index>(names.task_rows.size())) {
        continue;
      }
      for (Index i = 0; i < task->rows(); ++i) {
        names.task_rows.push_back(task->name() + "/" + std::to_string(i));
      }
    }
  }
}

std::vector<const ForceTask*> force_tasks(const WholeBodyController& controller) {
  std::vector<const ForceTask*> found;
  for (const Task* task : controller.tasks()) {
    if (const auto* const force = dynamic_cast<const ForceTask*>(task)) found.push_back(force);
  }
  return found;
}

TelemetryNames names_of(const WholeBodyController& controller) {
  TelemetryNames names;
  names.coordinates = controller.plan().coordinate_names();
  names.joints = controller.servo().names();
  for (std::size_t i = 0; i < controller.stacks().size(); ++i) {
    add_names(controller.law(i).stack(), controller.tasks(), names);
  }
  names.commands = controller.command_names();
  for (const ForceTask* task : force_tasks(controller)) names.forces.push_back(task->name());
  return names;
}

}  // namespace

RunRecord::RunRecord(const WholeBodyController& controller, std::vector<std::string> phases)
    : telemetry(names_of(controller)),
      stage_seconds(Vector::Zero(kStages)),
      names_(names_of(controller)),
      phases_(std::move(phases)),
      planned_(controller.tasks().begin(), controller.tasks().end()),
      forces_(force_tasks(controller)),
      previous_active_(Vector::Zero(controller.plan().size())),
      previous_alarm_(Vector::Zero(Monitors::kQuantities)) {
  telemetry.add_log_channels(names_, log);
  telemetry.add_observation_channels(names_, observation);
  timings.add("time", &telemetry.time);
  for (Index i = 0; i < kStages; ++i) timings.add(stage_names()[i], stage_seconds.data() + i);
  for (std::size_t i = 0; i < controller.stacks().size(); ++i) {
    StackPlaces places;
    for (const StackLevel& level : controller.law(i).stack().levels()) {
      places.level.push_back(find(names_.levels, level.name));
      places.tasks.emplace_back();
      for (const Task* task : level.tasks) {
        const auto at = std::find(planned_.begin(), planned_.end(), task);
        if (at == planned_.end()) continue;
        places.tasks.back().push_back({static_cast<std::size_t>(at - planned_.begin()),
                                       find(names_.task_rows, task->name() + "/0")});
      }
    }
    places_.push_back(std::move(places));
  }
}

void RunRecord::reset() {
  for (Recorder* recorder : {&log, &timings}) recorder->truncate(0.0);
  events.clear();
  telemetry.clear();
  previous_active_.setZero();
  previous_alarm_.setZero();
}

void RunRecord::note_sensed(const WholeBodyController& controller, const Sensed& sensed) {
  Telemetry& t = telemetry;
  const Robot &world = sensed.world, &seen = sensed.seen;
  t.q = world.configuration();
  t.seen_q = seen.configuration();
  world.velocities_of(sensed.qvel, t.qd);
  world.velocities_of(sensed.seen_qvel, t.seen_qd);
  t.q_des = controller.q_des();
  const JointLimits* const limits = controller.law().limits();
  if (controller.moves_joints()) {  // no mode: the ranges of the joints
    for (Index i = 0; i < world.size(); ++i) {
      t.limit_lower[i] = world.coordinates()[static_cast<std::size_t>(i)].lower;
      t.limit_upper[i] = world.coordinates()[static_cast<std::size_t>(i)].upper;
      t.limit_speed[i] = world.coordinates()[static_cast<std::size_t>(i)].max_velocity;
    }
  } else if (limits) {
    t.limit_lower = limits->lower();
    t.limit_upper = limits->upper();
    t.limit_speed = limits->max_velocity();
  } else {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    t.limit_lower.setConstant(-kNone);
    t.limit_upper.setConstant(kNone);
    t.limit_speed.setConstant(kNone);
  }
  t.lag = t.q_des - t.seen_q;
  t.to_lower = t.seen_q - t.limit_lower;
  t.to_upper = t.limit_upper - t.seen_q;
}

void RunRecord::note_base(const Sensed& sensed, Frame support, const std::optional<Frame>& target) {
  Telemetry& t = telemetry;
  const Robot &world = sensed.world, &seen = sensed.seen;
  t.base_position = world.position(support);
  t.base_rotation = rotation_log(world.orientation(support));
  const Matrix3 R = seen.orientation(support);
  const Vector3 p = seen.position(support);
  const Twist twist = seen.twist(support, sensed.seen_qvel);
  t.seen_base_position = p;
  t.seen_base_rotation = rotation_log(R);
  t.base_velocity = twist.linear;
  t.base_spin = twist.angular;
  if (target) t.target_in_base = R.transpose() * (world.position(*target) - p);
}

void RunRecord::note_solution(const WholeBodyController& controller) {
  Telemetry& t = telemetry;
  t.q_des = controller.q_des();
  t.qd_des = controller.qd_des();
  t.command = controller.command();
  t.yielding = controller.scaled() ? 1.0 : 0.0;
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    t.force[static_cast<Index>(i)] = forces_[i]->force();
    t.contact[static_cast<Index>(i)] = static_cast<double>(static_cast<int>(forces_[i]->state()));
  }
  if (controller.moves_joints()) {
    t.active.setZero();
    t.level_active.setZero();
    t.factorizations = t.changes = t.iterations = t.status = t.optimality = 0.0;  // none is solved
    return;
  }
  const Solution& solution = controller.law().solution();
  t.factorizations = solution.factorizations;
  t.changes = solution.changes;
  t.iterations = 1.0 + solution.changes;
  t.status = static_cast<double>(static_cast<int>(solution.status));
  t.optimality = solution.optimality;
  t.active = controller.law().active_limits().cast<double>();
  t.level_active.setZero();
  const StackPlaces& places = places_[controller.active()];
  for (const ActiveRow& active : solution.working_set) {
    t.level_active[places.level[static_cast<std::size_t>(active.held_by)]] += 1.0;
  }
  copy_errors(places, planned_, t.level_error, t.task_error);
}

void RunRecord::note_servo(const WholeBodyController& controller) {
  telemetry.torque = controller.servo().torque();
  telemetry.demand = controller.servo().demand();
  telemetry.joint_error = controller.servo().error().position;
  const Index joints = controller.servo().coordinate_joints();
  telemetry.tracking_error =
      joints > 0 ? telemetry.joint_error.head(joints).cwiseAbs().maxCoeff() : 0.0;
}

void RunRecord::note_measured(const WholeBodyController& controller,
                              const std::vector<const Task*>& tasks) {
  copy_errors(places_[controller.active()], tasks, telemetry.level_error_measured,
              telemetry.task_error_measured);
}

// the errors as the tasks were measured last, of levels what is outside the intervals; limits of
// coordinates have none, nor rows that ask for nothing
void RunRecord::copy_errors(const StackPlaces& places, const std::vector<const Task*>& tasks,
                            Vector& levels, Vector& rows) const {
  for (std::size_t k = 0; k < places.level.size(); ++k) {
    double square = 0.0;
    for (const TaskPlace& place : places.tasks[k]) {
      const Task& task = *tasks[place.task];
      for (Index i = 0; i < task.rows(); ++i)
        if (task.asks(i)) square += std::pow(task.beyond(i), 2);
      rows.segment(place.first_row, task.rows()) = task.error();
    }
    levels[places.level[k]] = std::sqrt(square);
  }
}

void RunRecord::note_events(const Monitors& monitors) {
  for (Index i = 0; i < previous_active_.size(); ++i) {
    if (telemetry.active[i] == previous_active_[i]) continue;
    const bool met = telemetry.active[i] != 0.0;
    const double side = met ? telemetry.active[i] : previous_active_[i];
    events.add({telemetry.time, met ? EventKind::LimitMet : EventKind::LimitReleased, i,
                static_cast<int>(side)});
  }
  previous_active_ = telemetry.active;
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    const double alarm = monitors.alarm(i) ? 1.0 : 0.0;
    if (alarm == previous_alarm_[i]) continue;
    events.add({telemetry.time, alarm > 0.0 ? EventKind::AlarmRaised : EventKind::AlarmFell, i,
                Monitors::falls(i) ? -1 : 1});
    previous_alarm_[i] = alarm;
  }
}

void RunRecord::note_phase(std::size_t phase) {
  telemetry.phase = static_cast<double>(phase);
  note(EventKind::PhaseStarted, phase);
}

void RunRecord::note(EventKind kind, std::size_t phase, int side, int answer) {
  events.add({telemetry.time, kind, static_cast<Index>(phase), side, answer});
}

std::string RunRecord::text(const Event& event, const Monitors& monitors) const {
  const auto name_of = [&](const auto& names) -> const std::string& {
    if (event.what < 0 || event.what >= static_cast<Index>(names.size()))
      throw Error("this simulation has no such event: number " + std::to_string(event.what) +
                  " of " + std::to_string(names.size()));
    return names[static_cast<std::size_t>(event.what)];
  };
  if (event.kind == EventKind::AlarmRaised || event.kind == EventKind::AlarmFell) {
    const std::string& quantity = name_of(Monitors::names());
    const std::string side = event.side > 0 ? " above " : " below ";
    return (event.kind == EventKind::AlarmRaised ? "alarm: " : "alarm over: ") + quantity + side +
           number_text(monitors.threshold(event.what));
  }
  for (const auto& [kind, word] :
       {std::pair(EventKind::PhaseStarted, ""), std::pair(EventKind::Asked, "asks in "),
        std::pair(EventKind::Paused, "paused in "), std::pair(EventKind::Resumed, "resumed in "),
        std::pair(EventKind::Unborne, "the support bears nothing in ")}) {
    if (event.kind == kind) return word + ("phase " + name_of(phases_));
  }
  const std::string& name = name_of(names_.coordinates);
  const std::string side = event.side > 0 ? "upper" : "lower";
  return name + (event.kind == EventKind::LimitMet ? " meets its " : " leaves its ") + side +
         " limit";
}

void RunRecord::truncate(double time) {
  for (Recorder* recorder : {&log, &timings}) recorder->truncate(time);
  events.truncate(time);
}

void RunRecord::save(StateWriter& writer) const {
  for (const Vector* vector :
       {&telemetry.active, &telemetry.level_active, &previous_active_, &previous_alarm_}) {
    writer.put(*vector);
  }
}

void RunRecord::restore(StateReader& reader) {
  for (Vector* vector :
       {&telemetry.active, &telemetry.level_active, &previous_active_, &previous_alarm_}) {
    reader.get(*vector);
  }
}

}  // namespace hurcules
