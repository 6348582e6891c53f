// sim: options of sensors and monitors, and what a simulation tells of them.
#include "bind_sensors.hpp"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>
#include <utility>

#include "bind_sensors_docs.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

namespace hurcules_bindings {

namespace {

using Names = std::pair<std::string, std::string>;

void bind_sensor_model(py::module_& module) {
  using Model = SensorModel;
  const Model defaults;
  py::class_<Model>(module, "SensorModel", kSensorModel)
      .def(py::init([](double noise, double bias, double drift, int delay, double step) {
             return Model{noise, bias, drift, delay, step};
           }),
           py::kw_only(), "noise"_a = defaults.noise, "bias"_a = defaults.bias,
           "drift"_a = defaults.drift, "delay"_a = defaults.delay, "step"_a = defaults.step)
      .def_readwrite("noise", &Model::noise)
      .def_readwrite("bias", &Model::bias)
      .def_readwrite("drift", &Model::drift)
      .def_readwrite("delay", &Model::delay)
      .def_readwrite("step", &Model::step);
}

void bind_range_finder(py::module_& module) {
  using Options = RangeFinderOptions;
  const Options defaults;
  py::class_<Options>(module, "RangeFinder", kRangeFinder)
      .def(py::init([](int rays, int period, double angle, double min_range, double max_range,
                       const SensorModel& model, std::string site) {
             return Options{rays, period, angle, min_range, max_range, model, std::move(site)};
           }),
           py::kw_only(), "rays"_a = defaults.rays, "period"_a = defaults.period,
           "angle"_a = defaults.angle, "min_range"_a = defaults.min_range,
           "max_range"_a = defaults.max_range, "model"_a = defaults.model, "site"_a = defaults.site)
      .def_readwrite("rays", &Options::rays)
      .def_readwrite("period", &Options::period)
      .def_readwrite("angle", &Options::angle)
      .def_readwrite("min_range", &Options::min_range)
      .def_readwrite("max_range", &Options::max_range)
      .def_readwrite("model", &Options::model)
      .def_readwrite("site", &Options::site);
}

void bind_faults(py::module_& module) {
  py::enum_<FaultKind>(module, "FaultKind", kFaultKind)
      .value("NotANumber", FaultKind::NotANumber, "it reads NaN")
      .value("Frozen", FaultKind::Frozen, "it repeats what it said last");
  py::class_<SensorFault>(module, "SensorFault", kSensorFault)
      .def(py::init([](std::string entry, FaultKind kind, double start) {
             return SensorFault{std::move(entry), kind, start};
           }),
           "entry"_a, "kind"_a = SensorFault{}.kind, "start"_a = SensorFault{}.start)
      .def_readwrite("entry", &SensorFault::entry)
      .def_readwrite("kind", &SensorFault::kind)
      .def_readwrite("start", &SensorFault::start);
}

void bind_sensor_options(py::module_& module) {
  using Options = SensorOptions;
  const Options defaults;
  py::class_<Options>(module, "SensorOptions", kSensorOptions)
      .def(py::init([](std::map<std::string, SensorModel> models, const RangeFinderOptions& range,
                       std::vector<SensorFault> faults, double hold_seconds) {
             Options options;
             options.models = std::move(models);
             options.range = range;
             options.faults = std::move(faults);
             options.hold_seconds = hold_seconds;
             return options;
           }),
           py::kw_only(), "models"_a = defaults.models, "range"_a = defaults.range,
           "faults"_a = defaults.faults, "hold_seconds"_a = defaults.hold_seconds)
      .def_readwrite("models", &Options::models)
      .def_readwrite("range", &Options::range)
      .def_readwrite("faults", &Options::faults)
      .def_readwrite("hold_seconds", &Options::hold_seconds);
}

void bind_monitor_options(py::module_& module) {
  using Options = MonitorOptions;
  const Options defaults;
  py::class_<Options>(module, "MonitorOptions", kMonitorOptions)
      .def(py::init([](bool on, double min_distance, double min_margin, double min_pressure_margin,
                       double min_tip_angle, double min_energy, double max_temperature,
                       double max_power) {
             Options options;
             options.on = on;
             options.min_distance = min_distance;
             options.min_margin = min_margin;
             options.min_pressure_margin = min_pressure_margin;
             options.min_tip_angle = min_tip_angle;
             options.min_energy = min_energy;
             options.max_temperature = max_temperature;
             options.max_power = max_power;
             return options;
           }),
           py::kw_only(), "on"_a = defaults.on, "min_distance"_a = defaults.min_distance,
           "min_margin"_a = defaults.min_margin,
           "min_pressure_margin"_a = defaults.min_pressure_margin,
           "min_tip_angle"_a = defaults.min_tip_angle, "min_energy"_a = defaults.min_energy,
           "max_temperature"_a = defaults.max_temperature, "max_power"_a = defaults.max_power)
      .def_readwrite("on", &Options::on)
      .def_readwrite("min_distance", &Options::min_distance)
      .def_readwrite("min_margin", &Options::min_margin)
      .def_readwrite("min_pressure_margin", &Options::min_pressure_margin)
      .def_readwrite("min_tip_angle", &Options::min_tip_angle)
      .def_readwrite("min_energy", &Options::min_energy)
      .def_readwrite("max_temperature", &Options::max_temperature)
      .def_readwrite("max_power", &Options::max_power);
}

py::dict sensors(const Simulation& self) {
  py::dict result;
  for (const Sensor& sensor : self.sensors().all()) {
    result[py::str(sensor.setup().name)] = sensor.reading();
  }
  const RangeFinder& range = self.sensors().range();
  if (range.options().rays > 0) result["range"] = range.reading();
  return result;
}

py::dict sensor_entries(const Simulation& self) {
  py::dict result;
  for (const Sensor& sensor : self.sensors().all()) {
    result[py::str(sensor.setup().name)] =
        py::make_tuple(sensor.setup().unit, sensor.setup().entries);
  }
  return result;
}

Vector ray_angles(const Simulation& self) {
  const RangeFinder& range = self.sensors().range();
  Vector angles(range.options().rays);
  for (Index i = 0; i < angles.size(); ++i) angles[i] = range.ray_angle(i);
  return angles;
}

py::dict monitors(const Simulation& self) {
  py::dict result;
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    result[py::str(Monitors::names()[static_cast<std::size_t>(i)])] = self.monitors().value(i);
  }
  return result;
}

py::dict motor_temperatures(const Simulation& self) {
  const Windings& windings = self.monitors().windings();
  py::dict result;
  for (std::size_t i = 0; i < windings.names().size(); ++i) {
    result[py::str(windings.names()[i])] = windings.temperature()[static_cast<Index>(i)];
  }
  return result;
}

std::vector<Names> self_collision_pairs(const Simulation& self) {
  return self.monitors().self_distance().names(self.plant().model());
}

std::optional<Names> nearest_pair(const Simulation& self) {
  const Index nearest = self.monitors().self_distance().nearest();
  if (nearest < 0) return std::nullopt;
  return self_collision_pairs(self)[static_cast<std::size_t>(nearest)];
}

}  // namespace

void bind_sensors(py::module_& module) {
  bind_sensor_model(module);
  bind_range_finder(module);
  bind_faults(module);
  bind_sensor_options(module);
  bind_monitor_options(module);
}

void bind_sensor_results(py::class_<Simulation>& simulation) {
  simulation.def("sensors", &sensors, kSensors)
      .def("sensor_entries", &sensor_entries, kSensorEntries)
      .def("ray_angles", &ray_angles, kRayAngles)
      .def("monitors", &monitors, kMonitors)
      .def("motor_temperatures", &motor_temperatures, kMotorTemperatures)
      .def("self_collision_pairs", &self_collision_pairs, kSelfCollisionPairs)
      .def("nearest_pair", &nearest_pair, kNearestPair)
      .def_property_readonly("held", &Simulation::held,
                             "whether it stands behind its brakes for a sensor's sake");
}

}  // namespace hurcules_bindings
