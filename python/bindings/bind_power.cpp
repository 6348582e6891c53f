// sim: what the robot takes from its battery, and the battery.
#include <pybind11/pybind11.h>

#include <memory>

#include "annotated.hpp"
#include "hurcules/sim/battery.hpp"
#include "hurcules/sim/physics.hpp"
#include "hurcules/sim/power_meter.hpp"
#include "mujoco_pointer.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_power(py::module_& module);

namespace {

constexpr const char* kMeter =
    R"(What the robot takes from its battery: motors, open brakes, and 300 W that are always on.

Args:
  model: mujoco.MjModel with a robot; every actuator of a joint is a motor.

Raises:
  Error: a model without the numbers that motors and transmissions want.
)";
constexpr const char* kRead = R"(Reads a step that was just taken.

Args:
  physics: of the same model.
)";
constexpr const char* kBattery = R"(A voltage behind a resistance, until its energy is used up.

Args:
  capacity: [J] that can be used.
  voltage: [V] without load.
  resistance: [Ohm].

Raises:
  Error: a capacity or voltage that is not above 0, a resistance below 0.
)";

}  // namespace

void bind_power(py::module_& module) {
  py::class_<PowerMeter>(module, "PowerMeter", kMeter)
      .def(py::init([](const ModelObject& model) {
             return std::make_unique<PowerMeter>(pointer<const mjModel_>(model, "mujoco.MjModel"));
           }),
           "model"_a)
      .def(
          "read",
          [](PowerMeter& self, const Physics& physics) {
            self.read(physics.data(), physics.brakes(), physics.drive_train());
          },
          "physics"_a, kRead)
      .def_property_readonly("mechanical", &PowerMeter::mechanical, "[W] of all motors, at joints")
      .def_property_readonly("motors", &PowerMeter::motors, "[W] electric")
      .def_property_readonly("total", &PowerMeter::total, "[W] with open brakes and standby");
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
