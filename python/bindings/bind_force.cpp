// tasks: control of a contact force along one axis.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>

#include "bind_force_docs.hpp"
#include "hurcules/tasks/force_task.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

void bind_force(py::module_& module);

namespace {

void bind_gains(py::module_& module) {
  py::enum_<ForceLoop>(module, "ForceLoop", "The law of a force loop, see ForceGains.")
      .value("FirstOrder", ForceLoop::FirstOrder)
      .value("Velocity", ForceLoop::Velocity)
      .value("Position", ForceLoop::Position)
      .value("PositionIntegral", ForceLoop::PositionIntegral);
  const ForceGains d;
  py::class_<ForceGains>(module, "ForceGains", kForceGains)
      .def(py::init([](ForceLoop loop, double compliance, double integral, double mass,
                       double damping, double stiffness, double dt) {
             return ForceGains{loop, compliance, integral, mass, damping, stiffness, dt};
           }),
           py::kw_only(), "loop"_a = d.loop, "compliance"_a = d.compliance,
           "integral"_a = d.integral, "mass"_a = d.mass, "damping"_a = d.damping,
           "stiffness"_a = d.stiffness, "dt"_a = d.dt)
      .def_readwrite("loop", &ForceGains::loop)
      .def_readwrite("compliance", &ForceGains::compliance, "[m/s/N] or [m/N]")
      .def_readwrite("integral", &ForceGains::integral, "[m/s/N]")
      .def_readwrite("mass", &ForceGains::mass, "[kg]")
      .def_readwrite("damping", &ForceGains::damping, "[kg/s]")
      .def_readwrite("stiffness", &ForceGains::stiffness, "[kg/s^2]")
      .def_readwrite("dt", &ForceGains::dt, "[s]");
  module.def(
      "largest_stiffness",
      [](const ForceGains& gains) {
        check_force_gains(gains, 0.0, "largest_stiffness");
        return largest_stiffness(gains);
      },
      "gains"_a, kLargestStiffness);
}

void bind_options(py::module_& module) {
  const ContactOptions c;
  py::class_<ContactOptions>(module, "ContactOptions", kContactOptions)
      .def(py::init([](double f_min, double f_max, double release_time, double patience,
                       double frozen_move) {
             return ContactOptions{f_min, f_max, release_time, patience, frozen_move};
           }),
           py::kw_only(), "f_min"_a = c.f_min, "f_max"_a = c.f_max,
           "release_time"_a = c.release_time, "patience"_a = c.patience,
           "frozen_move"_a = c.frozen_move)
      .def_readwrite("f_min", &ContactOptions::f_min, "[N]")
      .def_readwrite("f_max", &ContactOptions::f_max, "[N]")
      .def_readwrite("release_time", &ContactOptions::release_time, "[s]")
      .def_readwrite("patience", &ContactOptions::patience, "[s]")
      .def_readwrite("frozen_move", &ContactOptions::frozen_move, "[m]");
  const StiffnessOptions s;
  py::class_<StiffnessOptions>(module, "StiffnessOptions", kStiffnessOptions)
      .def(py::init([](double lower, double upper, double forgetting, double step) {
             return StiffnessOptions{lower, upper, forgetting, step};
           }),
           py::kw_only(), "lower"_a = s.lower, "upper"_a = s.upper, "forgetting"_a = s.forgetting,
           "step"_a = s.step)
      .def_readwrite("lower", &StiffnessOptions::lower, "[N/m]")
      .def_readwrite("upper", &StiffnessOptions::upper, "[N/m]")
      .def_readwrite("forgetting", &StiffnessOptions::forgetting)
      .def_readwrite("step", &StiffnessOptions::step, "[m]");
}

}  // namespace

void bind_force(py::module_& module) {
  bind_gains(module);
  bind_options(module);
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
      .def("set_force", &ForceTask::set_force, "force_des"_a, "f_d [N].")
      .def("enable", &ForceTask::enable, "on"_a, kEnable)
      .def("reset", &ForceTask::reset, "robot"_a, kReset)
      // state() is what every task keeps between ticks
      .def_property_readonly("contact", &ForceTask::state, "ContactState")
      .def_property_readonly("force", &ForceTask::force, "[N] last reading")
      .def_property_readonly("force_des", &ForceTask::force_des, "[N]")
      .def_property_readonly("learnt_stiffness", &ForceTask::stiffness, "[N/m] given or learnt");
}
