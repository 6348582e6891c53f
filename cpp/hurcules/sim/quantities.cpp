#include "hurcules/sim/quantities.hpp"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/pose.hpp"
#include "hurcules/control/tasks.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"

namespace hurcules {

namespace {

// channels of this name, or all with this part before the "/"
std::vector<Index> channels_of(const Recorder& recorder, const std::string& name) {
  std::vector<Index> found;
  const std::vector<std::string>& channels = recorder.channels();
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::string& channel = channels[i];
    const bool within = channel.size() > name.size() && channel[name.size()] == '/' &&
                        channel.compare(0, name.size(), name) == 0;
    if (channel == name || within) found.push_back(static_cast<Index>(i));
  }
  return found;
}

double part_of(const Excess& excess, Index part) {
  return part == 0 ? excess.position : part == 1 ? excess.velocity : excess.torque;
}

int self_contacts(const mjModel* m, const mjData* d, const std::vector<int>& roots) {
  int count = 0;
  for (int i = 0; i < d->ncon; ++i) {
    const mjContact& contact = d->contact[i];
    if (contact.geom[0] < 0 || contact.geom[1] < 0 || contact.dist > 0.0) continue;
    const bool own = in_trees(*m, m->geom_bodyid[contact.geom[0]], roots) &&
                     in_trees(*m, m->geom_bodyid[contact.geom[1]], roots);
    count += own ? 1 : 0;
  }
  return count;
}

}  // namespace

Quantities::Quantities(const Simulation& simulation, const std::vector<std::string>& names)
    : identity_(simulation.identity()),
      sensor_rows_(simulation.plant().model()->nsensordata),
      names_(names) {
  for (const std::string& name : names) {
    quantities_.push_back(find(simulation, name));
    sizes_.push_back(quantities_.back().size);
    size_ += sizes_.back();
  }
}

Quantities::Quantity Quantities::find(const Simulation& simulation, const std::string& name) {
  const mjModel* const m = simulation.plant().model();
  const std::size_t slash = name.find('/');
  const std::string group = name.substr(0, slash);
  const std::string rest = slash == std::string::npos ? "" : name.substr(slash + 1);
  Quantity found;
  const std::vector<std::pair<std::string, std::pair<Kind, Index>>> frames = {
      {"position", {Kind::Position, 3}},
      {"rotation", {Kind::Rotation, 3}},
      {"matrix", {Kind::RotationMatrix, 9}},
      {"velocity", {Kind::Velocity, 3}},
      {"spin", {Kind::Spin, 3}}};
  for (const auto& [word, what] : frames) {
    if (group != word) continue;
    found.kind = what.first;
    found.size = what.second;
    found.frame = simulation.world().frame(rest);
    return found;
  }
  if (group == "value" || group == "target") {
    const std::vector<Task*>& tasks = simulation.controller().tasks();
    const Task* const task = &simulation.controller().task(rest);
    require(dynamic_cast<const ValueTask*>(task) != nullptr,
            "quantity '" + name + "': the value of this task is no list of numbers");
    found.kind = group == "value" ? Kind::Value : Kind::Target;
    found.size = task->rows();
    found.places = {std::find(tasks.begin(), tasks.end(), task) - tasks.begin()};
    return found;
  }
  if (group == "force") {
    const std::vector<Task*>& tasks = simulation.controller().tasks();
    const Task* const task = &simulation.controller().task(rest);
    require(dynamic_cast<const ForceTask*>(task) != nullptr,
            "quantity '" + name + "': this task reads no force");
    found.kind = Kind::Force;
    found.places = {std::find(tasks.begin(), tasks.end(), task) - tasks.begin()};
    return found;
  }
  // what sensors of the simulation say is a channel
  const bool says = group == "sensor" && mj_name2id(m, mjOBJ_SENSOR, rest.c_str()) < 0;
  if (const auto data = says ? std::nullopt : DataQuantity::find(*m, name)) {
    found.kind = Kind::Data;
    found.size = data->size();
    found.data = data;
    return found;
  }
  if (group == "excess" || group == "excess_now" || group == "commanded_excess") {
    const std::vector<std::string> kinds = {"position", "velocity", "torque"};
    const auto kind = std::find(kinds.begin(), kinds.end(), rest) - kinds.begin();
    if (kind == 3) throw Error(unknown_name("excess", rest, kinds));
    found.kind = group == "excess"       ? Kind::Excess
                 : group == "excess_now" ? Kind::ExcessNow
                                         : Kind::CommandedExcess;
    found.places = {kind};
    return found;
  }
  for (const auto& [word, kind] : {std::pair{"self_contacts", Kind::SelfContacts},
                                   {"scaled", Kind::Scaled},
                                   {"finished", Kind::Finished},
                                   {"ending", Kind::Ending}}) {
    if (name != word) continue;
    found.kind = kind;
    return found;
  }
  for (const Kind kind : {Kind::Observation, Kind::Log}) {
    const Recorder& recorder =
        kind == Kind::Observation ? simulation.observation() : simulation.log();
    found.kind = kind;
    found.measured = group == "task_error";
    found.places = channels_of(recorder, name);
    found.size = static_cast<Index>(found.places.size());
    if (found.size > 0) return found;
  }
  std::vector<std::string> known = {"position/FRAME",
                                    "rotation/FRAME",
                                    "matrix/FRAME",
                                    "velocity/FRAME",
                                    "spin/FRAME",
                                    "value/TASK",
                                    "target/TASK",
                                    "force/TASK",
                                    "joint/JOINT",
                                    "distance/OBJECT/OBJECT",
                                    "joint_velocity/JOINT",
                                    "sensor/SENSOR",
                                    "excess/KIND",
                                    "excess_now/KIND",
                                    "commanded_excess/KIND",
                                    "self_contacts",
                                    "scaled",
                                    "contact_force/BODY",
                                    "finished",
                                    "ending"};
  for (const Recorder* recorder : {&simulation.observation(), &simulation.log()}) {
    for (const std::string& channel : recorder->channels()) {
      const std::string word = channel.substr(0, channel.find('/'));
      if (std::find(known.begin(), known.end(), word) == known.end()) known.push_back(word);
    }
  }
  throw Error(unknown_name("quantity", name, known));
}

void Quantities::read(const Simulation& simulation, VectorRef out) const {
  require(out.size() == size_, "quantities want room for " + std::to_string(size_) +
                                   " numbers, got " + std::to_string(out.size()));
  const mjModel* const m = simulation.plant().model();
  if (simulation.identity() != identity_ || m->nsensordata != sensor_rows_)
    throw Error("these quantities are those of another robot, controller or mission");
  Index place = 0;
  for (const Quantity& quantity : quantities_) {
    read(quantity, simulation, out.segment(place, quantity.size));
    place += quantity.size;
  }
}

void Quantities::read(const Quantity& quantity, const Simulation& simulation, VectorRef out) {
  const Robot& world = simulation.world();
  const mjModel* const m = simulation.plant().model();
  const mjData* const d = simulation.plant().data();
  switch (quantity.kind) {
    case Kind::Position:
      out = world.position(quantity.frame);
      return;
    case Kind::Rotation:
      out = rotation_log(world.orientation(quantity.frame));
      return;
    case Kind::RotationMatrix: {
      const Matrix3 R = world.orientation(quantity.frame).transpose();  // column by column
      out = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(R.data());
      return;
    }
    case Kind::Velocity:
      out = world.twist(quantity.frame, simulation.plant().qvel()).linear;
      return;
    case Kind::Spin:
      out = world.twist(quantity.frame, simulation.plant().qvel()).angular;
      return;
    case Kind::Value:
    case Kind::Target: {
      const auto number = static_cast<std::size_t>(quantity.places.front());
      const auto& task = static_cast<const ValueTask&>(simulation.measured_task(number));
      out = quantity.kind == Kind::Value ? task.value() : task.target();
      return;
    }
    case Kind::Force: {
      const auto number = static_cast<std::size_t>(quantity.places.front());
      out[0] = static_cast<const ForceTask&>(*simulation.controller().tasks()[number]).force();
      return;
    }
    case Kind::Data:
      quantity.data->read(*m, *d, out);
      return;
    case Kind::Observation:
    case Kind::Log: {
      const Recorder& recorder = quantity.kind == Kind::Observation
                                     ? simulation.observation(quantity.measured)
                                     : simulation.log();
      for (Index i = 0; i < quantity.size; ++i) {
        out[i] =
            recorder.now(static_cast<std::size_t>(quantity.places[static_cast<std::size_t>(i)]));
      }
      return;
    }
    case Kind::Excess:
      out[0] = part_of(simulation.limits().measured(), quantity.places.front());
      return;
    case Kind::ExcessNow:
      out[0] = part_of(simulation.limits().now(), quantity.places.front());
      return;
    case Kind::CommandedExcess:
      out[0] = part_of(simulation.limits().commanded(), quantity.places.front());
      return;
    case Kind::SelfContacts:
      out[0] = self_contacts(m, d, world.root_bodies());
      return;
    case Kind::Scaled:
      out[0] = simulation.controller().scaled() ? 1.0 : 0.0;
      return;
    case Kind::Finished:
      out[0] = simulation.finished() ? 1.0 : 0.0;
      return;
    case Kind::Ending:
      out[0] = static_cast<double>(simulation.ending());
      return;
  }
}

}  // namespace hurcules
