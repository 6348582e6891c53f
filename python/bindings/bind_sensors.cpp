// sim: options of sensors and monitors, and what a simulation tells of them.
#include "bind_sensors.hpp"

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <optional>
#include <string>
#include <utility>

#include "bind_sensors_docs.hpp"
#include "hurcules/sim/realistic_sensors.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

namespace hurcules_bindings {

namespace {

using Names = std::pair<std::string, std::string>;

void bind_sensor_model(py::module_& module) {
  using Model = SensorModel;
  bind_options<Model>(
      module, "SensorModel", kSensorModel,
      {field("noise", &Model::noise), field("bias", &Model::bias), field("drift", &Model::drift),
       field("delay", &Model::delay), field("step", &Model::step)});
}

void bind_range_finder(py::module_& module) {
  using Options = RangeFinderOptions;
  bind_options<Options>(module, "RangeFinder", kRangeFinder,
                        {field("rays", &Options::rays), field("period", &Options::period),
                         field("angle", &Options::angle), field("min_range", &Options::min_range),
                         field("max_range", &Options::max_range), field("model", &Options::model),
                         field("site", &Options::site)});
}

void bind_faults(py::module_& module) {
  py::enum_<FaultKind>(module, "FaultKind", kFaultKind)
      .value("NotANumber", FaultKind::NotANumber, "it reads NaN")
      .value("Frozen", FaultKind::Frozen, "it repeats what it said last");
  bind_options<SensorFault>(
      module, "SensorFault", kSensorFault,
      {required("entry", &SensorFault::entry), field("kind", &SensorFault::kind),
       field("start", &SensorFault::start)},
      Arguments::Positional);
}

void bind_sensor_options(py::module_& module) {
  using Options = SensorOptions;
  bind_options<Options>(
      module, "SensorOptions", kSensorOptions,
      {field("models", &Options::models), field("range", &Options::range),
       field("faults", &Options::faults), field("hold_seconds", &Options::hold_seconds)});
  module.def("realistic_sensors", py::overload_cast<>(&realistic_sensors), kRealisticSensors);
  module.def("realistic_sensors", py::overload_cast<const Robot&>(&realistic_sensors), "robot"_a,
             "Those of them that a robot has.");
}

void bind_monitor_options(py::module_& module) {
  using Options = MonitorOptions;
  bind_options<Options>(
      module, "MonitorOptions", kMonitorOptions,
      {field("on", &Options::on), field("min_distance", &Options::min_distance),
       field("min_margin", &Options::min_margin),
       field("min_pressure_margin", &Options::min_pressure_margin),
       field("min_tip_angle", &Options::min_tip_angle), field("min_energy", &Options::min_energy),
       field("max_temperature", &Options::max_temperature),
       field("max_power", &Options::max_power)});
}

py::typing::Dict<py::str, Vector> sensors(const Simulation& self) {
  py::typing::Dict<py::str, Vector> result;
  for (const Sensor& sensor : self.sensors().all()) {
    result[py::str(sensor.setup().name)] = sensor.reading();
  }
  const RangeFinder& range = self.sensors().range();
  if (range.options().rays > 0) result["range"] = range.reading();
  return result;
}

py::typing::Dict<py::str, py::typing::Tuple<py::str, py::typing::List<py::str>>> sensor_entries(
    const Simulation& self) {
  py::typing::Dict<py::str, py::typing::Tuple<py::str, py::typing::List<py::str>>> result;
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

py::typing::Dict<py::str, double> monitors(const Simulation& self) {
  py::typing::Dict<py::str, double> result;
  for (Index i = 0; i < Monitors::kQuantities; ++i) {
    result[py::str(Monitors::names()[static_cast<std::size_t>(i)])] = self.monitors().value(i);
  }
  return result;
}

py::typing::Dict<py::str, double> motor_temperatures(const Simulation& self) {
  const MotorThermalModel& windings = self.monitors().windings();
  py::typing::Dict<py::str, double> result;
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
