#include "hurcules/mission/mission.hpp"

#include <algorithm>
#include <limits>

#include "hurcules/base/error.hpp"
#include "hurcules/mission/stretch.hpp"

namespace hurcules {

void Mission::reset(const Robot& plan, const Robot& world) {
  command_ = Vector::Zero(static_cast<Index>(channels_.size()));
  operated_ = command_;
  for (Figure& figure : figures_) figure.value = std::numeric_limits<double>::quiet_NaN();
  start(plan, world);
  enter(0, plan, 0.0);
}

bool Mission::select_phase(const Robot& plan, double time) {
  while (phases_[phase_].done(time - phase_start_)) {
    if (phase_ + 1 == phases_.size()) return false;
    enter(phase_ + 1, plan, time);
  }
  return true;
}

void Mission::enter(std::size_t phase, const Robot& plan, double time) {
  phase_ = phase;
  phase_start_ = time;
  if (phases_[phase_].enter) phases_[phase_].enter(plan, time);
}

const Vector& Mission::operator_command(double dt) {
  operated_.setZero();
  if (phases_[phase_].operate) phases_[phase_].operate(operated_, dt);
  return operated_;
}

void Mission::apply(const Robot& plan, const ConstVectorRef& command, double dt) {
  for (Index i = 0; i < command_.size(); ++i) {
    const double scale = channels_[static_cast<std::size_t>(i)].scale;
    command_[i] = std::clamp(command[i], -scale, scale);
  }
  move_targets(plan, command_, dt);
}

void Mission::relax(double share) {
  for (Task* task : tasks_) task->relax(share);
}

void Mission::save(StateWriter& writer) const {
  writer.put(static_cast<double>(phase_));
  writer.put(phase_start_);
  writer.put(command_);
  for (const Figure& figure : figures_) writer.put(figure.value);
  for (const Task* task : tasks_) task->save(writer);
  save_memory(writer);
}

void Mission::restore(StateReader& reader) {
  phase_ = static_cast<std::size_t>(reader.get_count(static_cast<Index>(phases_.size()) - 1));
  phase_start_ = reader.get();
  reader.get(command_);
  for (Figure& figure : figures_) figure.value = reader.get_any();
  for (Task* task : tasks_) task->restore(reader);
  restore_memory(reader);
}

namespace {

struct Entry {
  MissionSetup setup;
  std::unique_ptr<Mission> (*make)(const Robot& plan);
};

template <class M>
Entry entry() {
  return {M::setup_of(),
          [](const Robot& plan) -> std::unique_ptr<Mission> { return std::make_unique<M>(plan); }};
}

// all missions that there are
const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = {entry<Stretch>()};
  return all;
}

const Entry& find(const std::string& name) {
  for (const Entry& candidate : entries()) {
    if (candidate.setup.name == name) return candidate;
  }
  throw Error(unknown_name("mission", name, mission_names()));
}

}  // namespace

const MissionSetup& mission_setup(const std::string& name) {
  return find(name).setup;
}

std::unique_ptr<Mission> make_mission(const std::string& name, const Robot& plan) {
  return find(name).make(plan);
}

std::vector<std::string> mission_names() {
  std::vector<std::string> names;
  for (const Entry& candidate : entries()) names.push_back(candidate.setup.name);
  return names;
}

}  // namespace hurcules
