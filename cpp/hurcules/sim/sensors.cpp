#include "hurcules/sim/sensors.hpp"

#include <mujoco/mujoco.h>

#include <cmath>
#include <limits>
#include <utility>

#include "hurcules/base/error.hpp"
#include "hurcules/base/number_text.hpp"
#include "hurcules/sim/sensor_setups.hpp"

namespace hurcules {

namespace {

// apart from one sensor to the next, and from the seed that varies the scene
constexpr std::uint64_t kStream = 0x9e3779b97f4a7c15ULL;

std::vector<EncoderReference> references_of(const Robot& robot) {
  std::vector<EncoderReference> references;
  for (const int joint : encoder_joints(robot.model().get(), robot.root_bodies())) {
    EncoderReference reference;
    for (Index i = 0; i < robot.size(); ++i) {
      for (const DrivenJoint& driven : robot.coordinates()[static_cast<std::size_t>(i)].joints) {
        if (driven.joint == joint) reference = {i, driven.factor};
      }
    }
    references.push_back(reference);
  }
  return references;
}

bool is_state(const SensorSetup& setup) {
  return setup.name.starts_with("encoder_") || setup.name.starts_with("pose_");
}

}  // namespace

Sensors::Sensors(const Robot& robot, double dt, const SensorOptions& options)
    : options_(options),
      range_(robot.model().get(), dt, options.range),
      monitor_(references_of(robot), dt, options.monitor) {
  require(
      std::isfinite(options_.hold_seconds) && options_.hold_seconds >= 0.0,
      "sensors: hold_seconds wants a number >= 0, " + number_text(options_.hold_seconds) + " came");
  for (SensorSetup& setup : find_sensors(robot.model().get(), robot.root_bodies())) {
    const auto found = options_.models.find(setup.name);
    const SensorModel model = found == options_.models.end() ? SensorModel{} : found->second;
    sensors_.emplace_back(std::move(setup), model, dt);
    usable_.push_back(sensors_.back().reading());
    written_.push_back(is_state(sensors_.back().setup()) && !model.ideal());
  }
  has_encoders_ = !sensors_.empty() && sensors_.front().setup().name == kEncoderPosition;
  for (const auto& [name, model] : options_.models) (void)find(name);
  for (const SensorFault& fault : options_.faults) add_fault(fault);
  for (const bool written : written_) alter_state_ = alter_state_ || written;
}

std::size_t Sensors::find(const std::string& name) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (sensors_[i].setup().name == name) return i;
  }
  throw Error(unknown_name("sensor", name, names()));
}

void Sensors::add_fault(const SensorFault& fault) {
  require(std::isfinite(fault.start) && fault.start >= 0.0, "fault of '" + fault.entry +
                                                                "': start wants a time >= 0, " +
                                                                number_text(fault.start) + " came");
  const std::size_t slash = fault.entry.find('/');
  const std::size_t sensor = find(fault.entry.substr(0, slash));
  const std::string entry = slash == std::string::npos ? "" : fault.entry.substr(slash + 1);
  const std::vector<std::string>& entries = sensors_[sensor].setup().entries;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (entries[i] != entry) continue;
    faults_.push_back({sensor, static_cast<Index>(i), fault.kind, fault.start, 0.0});
    if (is_state(sensors_[sensor].setup())) written_[sensor] = true;
    return;
  }
  throw Error(
      unknown_name("entry of sensor '" + sensors_[sensor].setup().name + "',", entry, entries));
}

std::vector<std::string> Sensors::names() const {
  std::vector<std::string> names;
  for (const Sensor& sensor : sensors_) names.push_back(sensor.setup().name);
  return names;
}

void Sensors::reset(const mjData* data, std::uint64_t seed) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i].reset(data, seed + kStream * (i + 1));
    usable_[i] = sensors_[i].reading();
  }
  range_.reset(seed + kStream * (sensors_.size() + 1));
  monitor_.reset();
  for (Fault& fault : faults_) fault.held = sensors_[fault.sensor].reading()[fault.entry];
}

void Sensors::sample(const mjModel* model, mjData* data, double time) {
  for (Sensor& sensor : sensors_) sensor.sample(data);
  range_.sample(model, data);
  for (Fault& fault : faults_) {
    Sensor& sensor = sensors_[fault.sensor];
    if (time < fault.start) {
      fault.held = sensor.reading()[fault.entry];
    } else if (fault.kind == FaultKind::Frozen) {
      sensor.set_reading(fault.entry, fault.held);
    } else {
      sensor.set_reading(fault.entry, std::numeric_limits<double>::quiet_NaN());
    }
  }
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const Vector& reading = sensors_[i].reading();
    for (Index k = 0; k < reading.size(); ++k) {
      if (std::isfinite(reading[k])) usable_[i][k] = reading[k];
    }
  }
}

void Sensors::overwrite(VectorRef qpos, VectorRef qvel) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    if (!written_[i]) continue;
    const SensorSetup& setup = sensors_[i].setup();
    for (std::size_t k = 0; k < setup.sources.size(); ++k) {
      const SensorSource& source = setup.sources[k];
      VectorRef& target = source.array == SensorSource::Array::Position ? qpos : qvel;
      target[source.address] = usable_[i][static_cast<Index>(k)];
    }
    if (setup.name == kPoseRotation) qpos.segment<4>(setup.sources[0].address).normalize();
  }
}

SensorMonitor::Finding Sensors::monitor(const Vector& q_des) {
  if (!alter_state_ || !has_encoders_) return {};
  // they are the first two of find_sensors
  return monitor_.look(sensors_[0].reading(), sensors_[1].reading(), q_des);
}

std::string Sensors::text(const SensorMonitor::Finding& finding) const {
  const std::size_t sensor = finding.speed ? 1 : 0;
  const SensorSetup& setup = sensors_[sensor].setup();
  const std::string entry = setup.entries[static_cast<std::size_t>(finding.entry)];
  switch (finding.trouble) {
    case SensorMonitor::Trouble::None:
      return "";
    case SensorMonitor::Trouble::NotANumber:
      return setup.name + "/" + entry + " is not a number";
    case SensorMonitor::Trouble::Stuck:
      return setup.name + "/" + entry + " does not change while its reference moves";
    case SensorMonitor::Trouble::Disagrees:
      return "position and speed of the encoder of " + entry + " disagree";
  }
  return "";
}

void Sensors::add_log_channels(Recorder& recorder) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    const SensorSetup& setup = sensors_[i].setup();
    bool faulty = false;
    for (const Fault& fault : faults_) faulty = faulty || fault.sensor == i;
    if (sensors_[i].model().ideal() && !faulty) continue;
    recorder.add("sensor/" + setup.name, setup.entries, sensors_[i].reading());
  }
}

void Sensors::save(StateWriter& writer) const {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i].save(writer);
    writer.put(usable_[i]);
  }
  for (const Fault& fault : faults_) writer.put(fault.held);
  range_.save(writer);
  monitor_.save(writer);
}

void Sensors::restore(StateReader& reader) {
  for (std::size_t i = 0; i < sensors_.size(); ++i) {
    sensors_[i].restore(reader);
    reader.get(usable_[i]);
  }
  for (Fault& fault : faults_) fault.held = reader.get();
  range_.restore(reader);
  monitor_.restore(reader);
}

}  // namespace hurcules
