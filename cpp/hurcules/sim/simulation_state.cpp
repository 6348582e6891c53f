// Snapshots of a simulation.
#include <mujoco/mujoco.h>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/sim/simulation.hpp"

namespace hurcules {

namespace {

constexpr Index kMostTicks = Index{1} << 52;  // what a double counts exactly

// A snapshot begins with its version, its length, what it is of, and the number of values in use;
// what is left of its room is zero.
constexpr double kStateVersion = 7.0;
constexpr std::size_t kStateHeader = 4;

// of all names along the vectors of a controller's simulation, and of its log but for the time of a
// tick, which copies do not take
double identity_of(const Robot& world, const TelemetryNames& names, const Recorder& log) {
  std::vector<std::string> columns = log.channels();
  std::erase(columns, "tick_us");
  return hash_of_names({&names.coordinates, &names.joints, &names.levels, &names.task_rows,
                        &names.commands, &columns},
                       world.identity().structure);
}

// numbers at most that the working sets of all solvers take in a snapshot
std::size_t room_of_working_sets(const WholeBodyController& controller) {
  constexpr std::size_t kPerSolver = 3;  // counts
  std::size_t room = 0;
  for (std::size_t i = 0; i < controller.stacks().size(); ++i) {
    std::size_t rows = 0;  // of this level and those above, each of which it may hold
    for (const Level& level : controller.law(i).hierarchy()) {
      rows += static_cast<std::size_t>(level.rows());
      room += rows;
    }
    room += rows + kPerSolver;  // what kind each row is
  }
  return room;
}

}  // namespace

void Simulation::measure_state() {
  std::vector<double> values;
  write(values);
  state_size_ = kStateHeader + values.size() + room_of_working_sets(*controller_);
  identity_ = identity_of(world_, record_.names(), record_.log);
}

std::vector<double> Simulation::state() const {
  std::vector<double> values = {kStateVersion, static_cast<double>(state_size_), identity_, 0.0};
  values.reserve(state_size_);
  write(values);
  values[3] = static_cast<double>(values.size());
  require(values.size() <= state_size_, "a snapshot is longer than its room");
  values.resize(state_size_, 0.0);
  return values;
}

void Simulation::write(std::vector<double>& values) const {
  StateWriter writer(values);
  writer.put(static_cast<double>(ticks_));
  writer.put(static_cast<double>(static_cast<int>(ending_)));
  writer.put(ending_time_);
  writer.put(heard_.value_or(-1.0));
  plant_.save(writer);
  if (supervisor_) supervisor_->save(writer);
  controller_->save(writer);
  battery_.save(writer);
  limit_monitor_.save(writer);
  fall_monitor_.save(writer);
  monitors_.save(writer);
  sensors_.save(writer);
  writer.put(static_cast<double>(static_cast<int>(finding_.trouble)));
  writer.put(static_cast<double>(finding_.entry));
  writer.put(finding_.speed ? 1.0 : 0.0);
  writer.put(static_cast<double>(held_ticks_));
  record_.save(writer);
}

void Simulation::restore(const std::vector<double>& values) {
  require(values.size() >= kStateHeader && values[0] == kStateVersion,
          "a snapshot of another version: wanted " + number_text(kStateVersion) + ", got " +
              (values.empty() ? "nothing" : number_text(values[0])));
  require(values.size() == state_size_ && values[1] == static_cast<double>(state_size_) &&
              values[2] == identity_,
          "a snapshot of another model, controller or mission: it has " +
              std::to_string(values.size()) + " numbers, wanted are " +
              std::to_string(state_size_) + " of these coordinates, tasks and channels");
  const std::vector<double> before = state();
  try {
    read(values);
  } catch (...) {
    read(before);  // a snapshot that does not fit changes nothing
    throw;
  }
  controller_->serve(this);
}

void Simulation::read(const std::vector<double>& values) {
  const std::size_t used = static_cast<std::size_t>(values[3]);
  require(values[3] >= kStateHeader && used <= values.size(), "a snapshot is damaged");
  const std::vector<double> payload(values.begin() + kStateHeader,
                                    values.begin() + static_cast<std::ptrdiff_t>(used));
  StateReader reader(payload);
  ticks_ = reader.get_count(kMostTicks);
  ending_ = static_cast<Ending>(reader.get_count(static_cast<Index>(Ending::Held)));
  ending_time_ = reader.get();
  const double heard = reader.get();
  heard_ = heard < 0.0 ? std::nullopt : std::optional(heard);
  plant_.restore(reader);
  if (supervisor_) supervisor_->restore(reader);
  controller_->restore(reader);
  support_ = controller_->plan().support();
  battery_.restore(reader);
  limit_monitor_.restore(reader);
  fall_monitor_.restore(reader);
  monitors_.restore(reader);
  sensors_.restore(reader);
  finding_.trouble = static_cast<SensorMonitor::Trouble>(
      reader.get_count(static_cast<Index>(SensorMonitor::Trouble::Disagrees)));
  finding_.entry = reader.get_count(plant_.model()->nu);
  finding_.speed = reader.get_count(1) > 0;
  held_ticks_ = reader.get_count(kMostTicks);
  record_.restore(reader);
  require(reader.at_end(), "the snapshot is too long: it belongs to another model or mission");
  Telemetry& telemetry = record_.telemetry;
  telemetry.qd_des = controller_->qd_des();
  telemetry.time = static_cast<double>(ticks_) * dt();
  telemetry.link_age = link_age();
  telemetry.phase = supervisor_ ? static_cast<double>(supervisor_->phase()) : 0.0;
  telemetry.charge = battery_.charge();
  record_.truncate(telemetry.time);
  plant_.check();
  observe();
}

}  // namespace hurcules
