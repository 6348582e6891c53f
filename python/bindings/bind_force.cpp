// tasks: control of a contact force along one axis.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "bind_force_docs.hpp"
#include "hurcules/tasks/force_task.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_force(py::module_& module);

namespace {

void bind_gains(py::module_& module) {
  py::enum_<ForceLoop>(module, "ForceLoop", "The law of a force loop, see ForceGains.")
      .value("FirstOrder", ForceLoop::FirstOrder)
      .value("Velocity", ForceLoop::Velocity)
      .value("Position", ForceLoop::Position)
      .value("PositionIntegral", ForceLoop::PositionIntegral);
  bind_options<ForceGains>(
      module, "ForceGains", kForceGains,
      {field("loop", &ForceGains::loop),
       field("compliance", &ForceGains::compliance, "[m/s/N] or [m/N]"),
       field("integral", &ForceGains::integral, "[m/s/N]"),
       field("mass", &ForceGains::mass, "[kg]"), field("damping", &ForceGains::damping, "[kg/s]"),
       field("stiffness", &ForceGains::stiffness, "[kg/s^2]"),
       field("dt", &ForceGains::dt, "[s]")});
  module.def(
      "largest_stiffness",
      [](const ForceGains& gains) {
        check_force_gains(gains, 0.0, "largest_stiffness");
        return largest_stiffness(gains);
      },
      "gains"_a, kLargestStiffness);
}

void bind_force_options(py::module_& module) {
  bind_options<ContactOptions>(
      module, "ContactOptions", kContactOptions,
      {field("f_min", &ContactOptions::f_min, "[N]"), field("f_max", &ContactOptions::f_max, "[N]"),
       field("release_time", &ContactOptions::release_time, "[s]"),
       field("patience", &ContactOptions::patience, "[s]"),
       field("frozen_move", &ContactOptions::frozen_move, "[m]")});
  bind_options<StiffnessOptions>(module, "StiffnessOptions", kStiffnessOptions,
                                 {field("lower", &StiffnessOptions::lower, "[N/m]"),
                                  field("upper", &StiffnessOptions::upper, "[N/m]"),
                                  field("forgetting", &StiffnessOptions::forgetting),
                                  field("step", &StiffnessOptions::step, "[m]")});
}

}  // namespace

void bind_force(py::module_& module) {
  bind_gains(module);
  bind_force_options(module);
  py::enum_<ContactState>(module, "ContactState", "What a ForceTask takes its readings for.")
      .value("Free", ContactState::Free)
      .value("Contact", ContactState::Contact)
      .value("Stopped", ContactState::Stopped, "beyond f_max, until reset")
      .value("SensorLost", ContactState::SensorLost, "until reset");
  const ForceTaskOptions d;
  const auto make = [](std::string name, const Robot& robot, const std::string& frame,
                       std::string reference, const Vector3& axis, double force_des, double blend,
                       double environment, double max_rate, const ForceGains& gains,
                       const ContactOptions& contact, const StiffnessOptions& stiffness) {
    return std::make_unique<ForceTask>(
        std::move(name), robot, frame,
        ForceTaskOptions{std::move(reference), axis, force_des, blend, environment, max_rate, gains,
                         contact, stiffness});
  };
  py::class_<ForceTask, PositionTask>(module, "ForceTask", kForceTask)
      .def(py::init(make), "name"_a, "robot"_a, "frame"_a, "reference"_a = d.reference,
           "axis"_a = d.axis, py::kw_only(), "force_des"_a = d.force_des, "blend"_a = d.blend,
           "environment"_a = d.environment, "max_rate"_a = d.max_rate, "gains"_a = d.gains,
           "contact"_a = d.contact, "stiffness"_a = d.stiffness)
      .def("sense", &ForceTask::sense, "robot"_a, "force"_a, kSense)
      .def("tare", &ForceTask::tare, "seconds"_a = 0.1, kTare)
      .def("set_filter", &ForceTask::set_filter, "seconds"_a, kSetFilter)
      .def("set_force", &ForceTask::set_force, "force_des"_a, "f_d [N].")
      .def("enable", &ForceTask::enable, "on"_a, kEnable)
      .def("reset", &ForceTask::reset, "robot"_a, kReset)
      // state() is what every task keeps between ticks
      .def_property_readonly("contact", &ForceTask::state, "ContactState")
      .def_property_readonly("force", &ForceTask::force, "[N] last reading")
      .def_property_readonly("force_des", &ForceTask::force_des, "[N]")
      .def_property_readonly("learnt_stiffness", &ForceTask::stiffness, "[N/m] given or learnt");
}
