// What the controllers of velocity and of acceleration have in common for Python.
#pragma once

#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "bind_stack.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/robot/robot.hpp"
#include "in_use.hpp"
#include "renamed.hpp"
#include "solver_levels.hpp"
#include "state.hpp"

namespace hurcules_bindings {

inline constexpr const char* kSetStack =
    "Takes over another stack, or what Stack takes; keeps its tasks alive. The one that it has "
    "already changes nothing.";
inline constexpr const char* kDiagnostics =
    R"(What each level fell short of at the last compute, and why.

Args:
  robot: Robot as it was at compute.

Returns:
  list of LevelDiagnostics, decreasing priority.
)";
inline constexpr const char* kActiveLimits =
    "(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one";

// `result`: what compute returns, in words
template <typename Controller>
void bind_common(pybind11::class_<Controller>& controller, const std::string& result) {
  namespace py = pybind11;
  using namespace pybind11::literals;
  const auto set_stack = [](Controller& self, const StackLike& stack) {
    const py::object held = py::cast(stack_of(stack));
    if (self.set_stack(held.cast<const HeldStack&>().stack))
      py::detail::keep_alive_impl(py::cast(&self), held);
  };
  const auto compute = [](Controller& self, const hurcules::Robot& robot) {
    const InUse in_use("controller or Robot", &self, &robot);
    const py::gil_scoped_release release;
    return hurcules::Vector(self.compute(robot));
  };
  const std::string compute_doc =
      "Measures the tasks at the robot, builds the hierarchy, solves it.\n\n"
      "Args:\n  robot: Robot at the configuration (and velocity) to start from.\n\n"
      "Returns:\n  " +
      result + ". Releases the interpreter lock.\n";
  const auto diagnostics = [](const Controller& self, const hurcules::Robot& robot) {
    return self.diagnostics(robot);
  };
  const auto notes = [diagnostics](const Controller& self, const hurcules::Robot& robot) {
    warn_renamed("notes", "diagnostics");
    return diagnostics(self, robot);
  };
  const auto copy = py::return_value_policy::copy;
  controller.def("set_stack", set_stack, "stack"_a, kSetStack)
      .def("compute", compute, "robot"_a, compute_doc.c_str())
      .def("diagnostics", diagnostics, "robot"_a, kDiagnostics)
      .def("notes", notes, "robot"_a, "Deprecated name of diagnostics.")
      .def("reset", &Controller::reset, "At rest, cold.")
      .def("state", &state<Controller>, kState)
      .def("restore", &restore<Controller>, "state"_a, kRestore)
      .def_property_readonly("options", &Controller::options, copy)
      .def_property_readonly("active_limits", &Controller::active_limits, copy, kActiveLimits)
      .def_property_readonly("solution", &Controller::solution, copy,
                             "ControlSolution, of the last compute")
      .def_property_readonly(
          "hierarchy", [](const Controller& self) { return copies_of(self.hierarchy()); },
          "list of Level, of the last compute")
      .def_property_readonly(
          "stack", [](const Controller& self) { return self.stack().text(); },
          "'joint < hpos < ...'");
}

}  // namespace hurcules_bindings
