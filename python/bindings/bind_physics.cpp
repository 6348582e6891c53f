// sim: the simulated world by itself, without a mission: brakes, drive trains, power, battery.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "hurcules/base/error.hpp"
#include "hurcules/sim/battery.hpp"
#include "hurcules/sim/physics.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "scene.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_physics(py::module_& module);

namespace {

constexpr const char* kPhysics =
    R"(The physics with tracks, brakes, drive trains, and what the robot takes from its battery.

Python owns model and data and writes `data.ctrl`; a step limits the drives to what their motors
and transmissions give. A look at the power after each step adds up to `work` and `energy`.

Args:
  model: mujoco.MjModel with a robot; every actuator of a joint is a motor.
  data: mujoco.MjData of this model.

Raises:
  Error: a model without the numbers that motors and transmissions want.
)";
constexpr const char* kReset = R"(Everything at rest in a keyframe, brakes open, no energy taken.

Args:
  keyframe: the first one whose name contains this text.

Raises:
  Error: there is none; the text lists the names that exist.
)";
constexpr const char* kStep = R"(Steps; releases the interpreter lock.

Args:
  n: number of steps.

Raises:
  Error: n < 0.
)";
constexpr const char* kSetBrake = R"(Closes or opens a brake, over its 0.05 s.

Args:
  joint: one of `brakes`.
  closed: False opens it.

Raises:
  Error: a joint without brake; the text lists those that have one.
)";
constexpr const char* kShut = "Shuts all brakes at once, without their 0.05 s: for a start.";
constexpr const char* kLoad = R"(What a brake and the friction of its joint bore in the last step.

Args:
  joint: one of `brakes`.

Returns:
  [N m], of a slide [N], in the joint's direction.
)";
constexpr const char* kRatio = R"(The ratio of motor to joint speed in the transmission, now.

Args:
  joint: one of `brakes`.

Returns:
  1 without a transmission.
)";
constexpr const char* kEffort = R"(What a drive behind its transmission can give, now.

Args:
  joint: one of `brakes`, with a transmission.
  speed: of the joint [rad/s].

Returns:
  Lowest and highest torque at the joint [N m].
)";
constexpr const char* kBattery = R"(A voltage behind a resistance, until its energy is used up.

Args:
  capacity: [J] that can be used.
  voltage: [V] without load.
  resistance: [Ohm].

Raises:
  Error: a capacity or voltage that is not above 0, a resistance below 0.
)";

class World {
 public:
  World(const py::object& model, const py::object& data) : World(scene_of(model, data)) {}
  void reset(const std::string& keyframe) {
    physics.reset(physics.find_keyframe(keyframe));
    work = energy = 0.0;
  }
  void step(int n) {
    require(n >= 0, "step wants a number of steps >= 0, got " + std::to_string(n));
    py::gil_scoped_release release;
    for (int i = 0; i < n; ++i) {
      physics.step();
      meter.read(physics.data(), physics.brakes(), physics.drive_train());
      work += physics.dt() * meter.mechanical();
      energy += physics.dt() * meter.total();
    }
  }
  [[nodiscard]] int actuator(const std::string& joint) const {
    return physics.brakes().find(joint);
  }

  Physics physics;
  PowerMeter meter;
  double work = 0.0, energy = 0.0;  // [J] since reset

 private:
  explicit World(const Scene& scene)
      : physics(borrow_model(scene.model), scene.data), meter(scene.model) {}
};

void bind_world(py::module_& module) {
  py::class_<World>(module, "Physics", kPhysics)
      .def(py::init<const py::object&, const py::object&>(), "model"_a, "data"_a,
           py::keep_alive<1, 2>(), py::keep_alive<1, 3>())
      .def("reset", &World::reset, "keyframe"_a, kReset)
      .def("step", &World::step, "n"_a = 1, kStep)
      .def_property_readonly(
          "brakes", [](const World& self) { return self.physics.brakes().names(); },
          "joints with a brake")
      .def(
          "set_brake",
          [](World& self, const std::string& joint, bool closed) {
            self.physics.brakes().set_closed(self.actuator(joint), closed);
          },
          "joint"_a, "closed"_a, kSetBrake)
      .def(
          "shut_brakes", [](World& self) { self.physics.brakes().reset(true); }, kShut)
      .def(
          "brake_load",
          [](const World& self, const std::string& joint) {
            return self.physics.brakes().load(self.actuator(joint));
          },
          "joint"_a, kLoad)
      .def(
          "ratio",
          [](const World& self, const std::string& joint) {
            return self.physics.drive_train().ratio(self.actuator(joint));
          },
          "joint"_a, kRatio)
      .def(
          "effort_range",
          [](const World& self, const std::string& joint, double speed) {
            const int actuator = self.actuator(joint);
            const DriveTrain& train = self.physics.drive_train();
            require(train.exists(actuator), "joint '" + joint + "' has no transmission");
            const EffortRange range = train.range(actuator, speed);
            return py::make_tuple(range.lower, range.upper);
          },
          "joint"_a, "speed"_a, kEffort)
      .def_property_readonly(
          "is_sound", [](const World& self) { return self.physics.is_sound(); },
          "False once a number was not finite or huge")
      .def_property_readonly(
          "mechanical_power", [](const World& self) { return self.meter.mechanical(); },
          "[W] of all motors, at their joints, in the last step")
      .def_property_readonly(
          "power", [](const World& self) { return self.meter.total(); },
          "[W] from the battery in the last step: motors, open brakes, standby")
      .def_readonly("work", &World::work, "[J] of all motors since reset")
      .def_readonly("energy", &World::energy, "[J] from the battery since reset");
}

void bind_battery(py::module_& module) {
  const BatteryOptions defaults;
  py::class_<Battery>(module, "Battery", kBattery)
      .def(py::init([](double capacity, double voltage, double resistance) {
             return Battery({capacity, voltage, resistance});
           }),
           py::kw_only(), "capacity"_a = defaults.capacity, "voltage"_a = defaults.voltage,
           "resistance"_a = defaults.resistance)
      .def("draw", &Battery::draw, "power"_a, "seconds"_a,
           "Gives [W] for [s]; a negative power charges it, up to full.")
      .def_property_readonly("energy", &Battery::energy, "[J] left")
      .def_property_readonly("charge", &Battery::charge, "0 to 1")
      .def_property_readonly("lost", &Battery::lost, "[J] in its own resistance")
      .def_property_readonly("empty", &Battery::empty);
}

}  // namespace

void bind_physics(py::module_& module) {
  bind_world(module);
  bind_battery(module);
}
