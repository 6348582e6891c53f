// How a simulation starts over, and how it is saved and restored.
#include <mujoco/mujoco.h>

#include <algorithm>

#include "hurcules/base/error.hpp"
#include "hurcules/sim/simulation.hpp"
#include "hurcules/sim/variation.hpp"

namespace hurcules {

namespace {

constexpr Index kMostTicks = Index{1} << 52;  // what a double counts exactly

}  // namespace

void Simulation::reset(std::uint64_t seed) {
  options_.seed = seed;
  ticks_ = 0;
  ending_ = Ending::Running;
  for (Recorder* recorder : {&log_, &timings_}) recorder->truncate(0.0);
  events_.clear();
  telemetry_.clear();
  battery_.reset();
  telemetry_.charge = battery_.charge();
  place_scene(seed);
  servo_.reset(physics_.data());
  for (const auto& controller : controllers_) controller->reset();
  limit_watch_.reset();
  monitors_.reset();
  sensors_.reset(physics_.data(), seed);
  finding_ = {};
  held_ticks_ = 0;
  previous_alarm_.setZero();
  held_back_.setZero();
  fall_watch_.reset(world_.orientation(support_));
  previous_active_.setZero();
  mission_->reset(plan_, world_);
  enter_phase();
  observe();
}

void Simulation::set_brake(const std::string& joint, bool closed) {
  physics_.brakes().set_closed(physics_.brakes().find(joint), closed);
}

void Simulation::place_scene(std::uint64_t seed) {
  physics_.reset(physics_.find_keyframe(mission_->setup().keyframe));
  Random random(seed);
  Variation variation;
  variation.scale = options_.variation;
  if (casualty_qpos_ >= 0) {
    vary_place(variation, random, physics_.qpos().segment<7>(casualty_qpos_));
  }

  // the posture varies, the support stays: the root of the robot follows
  plan_.set_qpos(physics_.qpos());
  Vector q = plan_.configuration();
  const Task* const limits = controllers_.front()->limits();
  if (limits) vary_posture(variation, random, {limits->lower(), limits->upper()}, q);
  plan_.set_configuration(q);
  start_qpos_ = plan_.qpos();
  plan_.set_qpos(start_qpos_);  // stands to the last bit as after restore
  physics_.qpos() = start_qpos_;
  world_.set_qpos(start_qpos_);
  telemetry_.q_des = q;
}

void Simulation::enter_phase() {
  const std::size_t phase = mission_->phase();
  VelocityController* const next = controllers_[controller_of_phase_[phase]].get();
  if (controller_ && next != controller_) next->take_over(*controller_);
  controller_ = next;
  telemetry_.phase = static_cast<double>(phase);
  events_.add({telemetry_.time, EventKind::PhaseStarted, static_cast<Index>(phase), 0});
}

std::vector<double> Simulation::state() const {
  std::vector<double> values;
  StateWriter writer(values);
  writer.put(static_cast<double>(ticks_));
  writer.put(static_cast<double>(static_cast<int>(ending_)));
  writer.put(ending_time_);
  physics_.save(writer);
  mission_->save(writer);
  for (const auto& controller : controllers_) controller->save(writer);
  servo_.save(writer);
  battery_.save(writer);
  limit_watch_.save(writer);
  fall_watch_.save(writer);
  monitors_.save(writer);
  sensors_.save(writer);
  writer.put(static_cast<double>(static_cast<int>(finding_.trouble)));
  writer.put(static_cast<double>(finding_.entry));
  writer.put(finding_.speed ? 1.0 : 0.0);
  writer.put(static_cast<double>(held_ticks_));
  for (const Vector* vector :
       {&telemetry_.q_des, &telemetry_.qd_des, &telemetry_.active, &telemetry_.level_active,
        &start_qpos_, &previous_active_, &previous_alarm_, &held_back_}) {
    writer.put(*vector);
  }
  return values;
}

void Simulation::restore(const std::vector<double>& values) {
  const std::vector<double> before = state();
  try {
    read(values);
  } catch (...) {
    read(before);  // a snapshot that does not fit changes nothing
    throw;
  }
}

void Simulation::read(const std::vector<double>& values) {
  StateReader reader(values);
  ticks_ = reader.get_count(kMostTicks);
  ending_ = static_cast<Ending>(reader.get_count(static_cast<Index>(Ending::Held)));
  ending_time_ = reader.get();
  physics_.restore(reader);
  mission_->restore(reader);
  for (const auto& controller : controllers_) controller->restore(reader);
  servo_.restore(reader);
  battery_.restore(reader);
  limit_watch_.restore(reader);
  fall_watch_.restore(reader);
  monitors_.restore(reader);
  sensors_.restore(reader);
  finding_.trouble = static_cast<SensorWatch::Trouble>(
      reader.get_count(static_cast<Index>(SensorWatch::Trouble::Disagrees)));
  finding_.entry = reader.get_count(physics_.model()->nu);
  finding_.speed = reader.get_count(1) > 0;
  held_ticks_ = reader.get_count(kMostTicks);
  for (Vector* vector :
       {&telemetry_.q_des, &telemetry_.qd_des, &telemetry_.active, &telemetry_.level_active,
        &start_qpos_, &previous_active_, &previous_alarm_, &held_back_}) {
    reader.get(*vector);
  }
  plan_.set_qpos(start_qpos_);
  require(reader.at_end(), "the snapshot is too long: it belongs to another model or mission");
  controller_ = controllers_[controller_of_phase_[mission_->phase()]].get();
  telemetry_.time = static_cast<double>(ticks_) * dt();
  telemetry_.phase = static_cast<double>(mission_->phase());
  telemetry_.charge = battery_.charge();
  for (Recorder* recorder : {&log_, &timings_}) recorder->truncate(telemetry_.time);
  events_.truncate(telemetry_.time);
  physics_.check();
  observe();
}

}  // namespace hurcules
