// sim: MuJoCo with tracks, brakes and drive trains.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>

#include "annotated.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/sim/plant.hpp"
#include "hurcules/sim/support.hpp"
#include "in_use.hpp"
#include "mujoco_pointer.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_plant(py::module_& module);

namespace {

constexpr const char* kPlant =
    R"(MuJoCo's physics with what the robot adds: traction of tracks, brakes, limits of its drives.

Controls are written to data.ctrl as ever; the model is left as it is.

Args:
  model: mujoco.MjModel.
  data: mujoco.MjData of it.
)";
constexpr const char* kStep = R"(Takes n steps of model.opt.timestep.

MuJoCo's sensors are read in the last one alone.

Args:
  n: >= 0.

Returns:
  Steps taken: fewer than n when the state stopped making sense, see is_sound.
)";
constexpr const char* kReset = R"(Everything at rest in a keyframe, brakes open, time zero.

Args:
  keyframe: part of its name; the first one that has it.

Raises:
  Error: none has it, with the names that exist.
)";
constexpr const char* kIsSound =
    "False once a position, velocity or acceleration was not finite or huge; it then stands still";
constexpr const char* kBrakes =
    R"(Magnetic brakes in the drives of the joints: closed they hold without power.

A brake is dry friction of 1.2 times the motor's peak torque; beyond that it slips. It takes 0.05 s
to open or close. Made by Plant.
)";
constexpr const char* kSetClosed = R"(Closes or opens one brake.

Args:
  joint: name of its joint.
  closed: bool.

Raises:
  Error: that joint has no brake, with the names that have one.
)";

constexpr const char* kRatio = R"(The ratio of motor to joint speed in a transmission, now.

Args:
  joint: one with a brake.

Returns:
  1 without a transmission.
)";
constexpr const char* kEffortRange = R"(What a drive behind its transmission can give, now.

Args:
  joint: one with a brake and a transmission.
  speed: of the joint [rad/s].

Returns:
  Lowest and highest torque at the joint [N m].
)";

constexpr const char* kStaticMargin =
    R"(Distance of the centre of mass from the edge of the support, across gravity [m].

It stands on the contacts that press: of the robot with what does not move, of its tracks with
anything.

Args:
  model: mujoco.MjModel.
  data: after a step.
  root: body at the root of the robot.
  carried: bodies that count to its mass while they do not touch the ground themselves.

Returns:
  Negative where it tips over, -inf in the air.

Raises:
  Error: an unknown body.
)";

std::pair<double, double> effort_range(const Plant& self, const std::string& joint, double speed) {
  const int actuator = self.brakes().find(joint);
  require(self.drive_train().exists(actuator), "joint '" + joint + "' has no transmission");
  const EffortRange range = self.drive_train().range(actuator, speed);
  return {range.lower, range.upper};
}

// in pieces, so that Ctrl-C is heard
int step_physics(Plant& self, int n) {
  require(n >= 0, "step wants a number of steps >= 0, got " + std::to_string(n));
  constexpr int kPiece = 500;
  const InUse in_use("Plant", &self);
  int done = 0;
  while (done < n && self.is_sound()) {
    {
      py::gil_scoped_release release;
      done += self.step(std::min(n - done, kPiece));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
  return done;
}

// a property of one brake, asked by its joint's name
template <typename Result>
auto by_joint(Result (Brakes::*question)(int) const) {
  return [question](const Brakes& self, const std::string& joint) {
    return (self.*question)(self.find(joint));
  };
}

}  // namespace

void bind_plant(py::module_& module) {
  py::class_<Brakes>(module, "Brakes", kBrakes)
      .def_property_readonly("names", &Brakes::names, "joints that have a brake")
      .def(
          "set_closed",
          [](Brakes& self, const std::string& joint, bool closed) {
            self.set_closed(self.find(joint), closed);
          },
          "joint"_a, "closed"_a, kSetClosed)
      .def("close", &Brakes::close, "All of them.")
      .def("reset", &Brakes::reset, "closed"_a = false, "All at once and at once shut or open.")
      .def("is_shut", by_joint(&Brakes::is_shut), "joint"_a)
      .def("is_open", by_joint(&Brakes::is_open), "joint"_a)
      .def("load", by_joint(&Brakes::load), "joint"_a,
           "[N m] or [N] that brake and friction bore in the last step, in the joint's direction")
      .def("max_load", by_joint(&Brakes::max_load), "joint"_a, "[N m] or [N] at which it slips")
      .def_property_readonly("power", &Brakes::power, "[W] of the coils of those held open");
  py::class_<Plant>(module, "Plant", kPlant)
      .def(py::init([](const ModelObject& model, const DataObject& data) {
             const Scene scene = scene_of(model, data);
             return std::make_unique<Plant>(held_model(model), scene.data);
           }),
           "model"_a, "data"_a, py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def("step", &step_physics, "n"_a = 1, kStep)
      .def(
          "reset",
          [](Plant& self, const std::string& keyframe) {
            self.reset(self.find_keyframe(keyframe));
          },
          "keyframe"_a, kReset)
      .def("state", &state<Plant>, kState)
      .def("restore", &restore<Plant>, "state"_a, kRestore)
      .def(
          "ratio",
          [](const Plant& self, const std::string& joint) {
            return self.drive_train().ratio(self.brakes().find(joint));
          },
          "joint"_a, kRatio)
      .def("effort_range", &effort_range, "joint"_a, "speed"_a, kEffortRange)
      .def_property_readonly("is_sound", &Plant::is_sound, kIsSound)
      .def_property_readonly(
          "brakes", [](Plant& self) -> Brakes& { return self.brakes(); },
          py::return_value_policy::reference_internal);
  module.def(
      "static_margin",
      [](const ModelObject& model, const DataObject& data, const std::string& root,
         const std::vector<std::string>& carried) {
        const Scene scene = scene_of(model, data);
        return static_margin(scene.model, scene.data, root, carried);
      },
      "model"_a, "data"_a, "root"_a, "carried"_a = std::vector<std::string>(), kStaticMargin);
}
