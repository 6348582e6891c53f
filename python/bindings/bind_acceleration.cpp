// control: the acceleration controller.
#include "bind_controller.hpp"
#include "hurcules/control/acceleration_controller.hpp"
#include "in_use.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_acceleration(py::module_& module);

namespace {

constexpr const char* kOptions = R"(Options of the acceleration controller.

Args:
  dt: [s] control period.
  stiffness: [1/s^2] K on errors.
  damping: [1/s] L on their rates; 2 sqrt(K) is critical.
  horizon: [s] a position limit is approached no faster than distance / horizon.
  max_acceleration: [rad/s^2] of every coordinate, inf for none.
  return_speed: [rad/s] at which a coordinate outside its limits is driven back.
  rest: [1/s] rate at which weak and free directions brake; 0: they keep their speed.
  friction: share of the model's dry friction (0 to 1) that torques add, in the direction of the
    velocity that the levels want.
  law: "arrive" or "thesis", see VelocityControllerOptions; the speed that an error asks for is
    stiffness / damping times it. "thesis" wants rest=0 and SolverOptions(handover="smooth").
  solver: SolverOptions.
)";
constexpr const char* kController =
    R"(From a stack to accelerations: second-order closed-loop inverse kinematics.

Integrated for joint servos (step), or turned into torques by inverse dynamics (torque).

Args:
  robot: Robot that the tasks were made for.
  options: AccelerationControllerOptions.

Raises:
  Error: gains too high for dt, or an option out of range.
)";
constexpr const char* kStep = R"(compute, then moves the robot by one dt along qddot*.

Args:
  robot: Robot at the reference configuration and velocity; it ends at the next ones.

Returns:
  q* (n,) [rad] or [m], one dt later; the velocity is robot.velocity. Releases the interpreter lock.
)";
constexpr const char* kTorque =
    R"(What the drives must give for the last qddot*, by inverse dynamics.

Args:
  robot: Robot as it was at compute.

Returns:
  (n,) [N m] or [N].
)";

void bind_acceleration_options(py::module_& module) {
  using Options = AccelerationControllerOptions;
  bind_options<Options>(
      module, "AccelerationControllerOptions", kOptions,
      {field("dt", &Options::dt, "[s]"), field("stiffness", &Options::stiffness, "[1/s^2]"),
       field("damping", &Options::damping, "[1/s]"), field("horizon", &Options::horizon, "[s]"),
       field("max_acceleration", &Options::max_acceleration, "[rad/s^2]"),
       field("enforce_limits", &Options::enforce_limits, "limits before all levels"),
       field("return_speed", &Options::return_speed, "[rad/s]"),
       field("rest", &Options::rest, "[1/s]"),
       field("friction", &Options::friction, "share of the model's dry friction in torque"),
       text_field<Options>(
           "law", [](const Options& self) { return to_string(self.law); },
           [](Options& self, const std::string& law) { self.law = law_named(law); },
           "'arrive' or 'thesis'"),
       field("solver", &Options::solver, "SolverOptions")});
}

}  // namespace

void bind_acceleration(py::module_& module) {
  bind_acceleration_options(module);
  const auto step = [](AccelerationController& self, Robot& robot) {
    const InUse in_use("controller or Robot", &self, &robot);
    const py::gil_scoped_release release;
    self.compute(robot);
    Vector q = robot.configuration(), velocity = robot.velocity();
    self.integrate(q, velocity);
    robot.set_configuration(q);
    robot.set_velocity(velocity);
    return q;
  };
  const auto torque = [](const AccelerationController& self, const Robot& robot) {
    Vector given(robot.size());
    self.torque(robot, given);
    return given;
  };
  py::class_<AccelerationController> controller(module, "AccelerationController", kController);
  controller
      .def(py::init<const Robot&, AccelerationControllerOptions>(), "robot"_a,
           "options"_a = AccelerationControllerOptions{})
      .def("step", step, "robot"_a, kStep)
      .def("torque", torque, "robot"_a, kTorque)
      .def("contact_force", &AccelerationController::contact_force, "contact"_a,
           "F (3,) [N] in W on the robot at a ContactTask of the stack, of the last solution.")
      .def_property_readonly("acceleration", &AccelerationController::acceleration,
                             py::return_value_policy::copy,
                             "(n,) [rad/s^2] or [m/s^2], the last qddot*")
      .def_property_readonly(
          "velocity", &AccelerationController::velocity,
          "(n,) [rad/s] or [m/s], qdot that the last qddot* leads to in a period");
  bind_common(controller, "qddot* (n,) [rad/s^2] or [m/s^2]");
}
