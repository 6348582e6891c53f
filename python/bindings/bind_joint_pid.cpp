// control: the joint servo.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/control/joint_pid.hpp"
#include "options.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_joint_pid(py::module_& module);

namespace {

constexpr const char* kPidOptions = R"(Gains of the joint servo, (m,) each.

Args:
  K: [N m s/rad] > 0, state weight.
  K_P: [1/s] > 0.
  K_I: [1/s^2] > 0, K_P^2 > 2 K_I.
  max_torque: [N m] > 0, inf for none.
  gamma: > 0, L2 gain from disturbance to error.
  dt: [s].
)";
constexpr const char* kPid = R"(Inverse-optimal joint servo with torque limits and anti-windup:

tau = (K + 1 / gamma^2) (de/dt + K_P e + K_I int e dt),  e = q_d - q

Args:
  options: JointPidOptions.

Raises:
  Error: sizes that differ, or gains outside the conditions of JointPidOptions.
)";
constexpr const char* kPidCompute = R"(Torque (m,) [N m] for this tick.

Args:
  position: e = q_d - q (m,) [rad].
  velocity: de/dt (m,) [rad/s].
)";

}  // namespace

void bind_joint_pid(py::module_& module) {
  using Options = JointPidOptions;
  bind_options<Options>(
      module, "JointPidOptions", kPidOptions,
      {required("K", &Options::K, "(m,) [N m s/rad]"), required("K_P", &Options::K_P, "(m,) [1/s]"),
       required("K_I", &Options::K_I, "(m,) [1/s^2]"),
       required("max_torque", &Options::max_torque, "(m,) [N m]"), field("gamma", &Options::gamma),
       field("dt", &Options::dt, "[s]")});
  const auto compute = [](JointPid& self, const Vector& position, const Vector& velocity) {
    require(position.size() == self.size() && velocity.size() == self.size(),
            "position and velocity want " + std::to_string(self.size()) + " numbers each");
    require(position.allFinite() && velocity.allFinite(),
            "position and velocity want finite numbers");
    return Vector(self.compute({position, velocity}));
  };
  const auto copy = py::return_value_policy::copy;
  py::class_<JointPid>(module, "JointPid", kPid)
      .def(py::init<Options>(), "options"_a)
      .def("compute", compute, "position"_a, "velocity"_a, kPidCompute)
      .def("reset", &JointPid::reset, "At rest, without memory.")
      .def("state", &state<JointPid>, kState)
      .def("restore", &restore<JointPid>, "state"_a, kRestore)
      .def_property_readonly("options", &JointPid::options, copy)
      .def_property_readonly("torque", &JointPid::torque, copy, "(m,) [N m], of the last compute")
      .def_property_readonly("demand", &JointPid::demand, copy, "(m,) [N m], before saturation")
      .def_property_readonly("integral", &JointPid::integral, copy, "(m,) [rad s]");
}
