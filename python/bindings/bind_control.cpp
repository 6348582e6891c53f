// control: the velocity controller, and what every controller tells of its last solve.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bind_controller.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "in_use.hpp"
#include "options.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_control(py::module_& module);

namespace {

constexpr const char* kOptions = R"(Options of the velocity controller.

Args:
  dt: [s] control period.
  gain: [1/s] with which errors vanish.
  horizon: [s] a position limit is approached no faster than distance / horizon.
  max_acceleration: [rad/s^2] of every coordinate, inf for none.
  return_speed: [rad/s] at which a coordinate outside its limits is driven back.
  transition: [s] in which the velocity goes over to a stack that was set in motion; 0 for none.
  law: 'arrive': errors vanish at max_speed of their tasks at most, targets that can be reached are,
    and everything comes to rest. 'thesis': gain times error however large, constant
    regularisation; it wants SolverOptions(handover="smooth"), so that no velocity jumps where a task
    loses a direction.
  solver: SolverOptions.
)";
constexpr const char* kController =
    R"(From a stack to velocities: first-order closed-loop inverse kinematics.

Args:
  robot: Robot that the tasks were made for.
  options: VelocityControllerOptions.
)";
constexpr const char* kTakeOver =
    R"(Goes on at the velocity of another controller of the same robot, with a transition.

Args:
  previous: VelocityController that was in command.
)";
constexpr const char* kIntegrate =
    R"(q* after one dt: q + qdot* dt (n,); rounding never carries it over a limit.)";
constexpr const char* kStep =
    R"(compute, integrate and set_configuration in one: the robot moves by one dt.

Args:
  robot: Robot at the reference configuration q*; it ends at the next one.

Returns:
  q* (n,) [rad] or [m], one dt later. Releases the interpreter lock.
)";
constexpr const char* kShortfall =
    R"(A task that is off its interval and is not brought back as it asks; str() is the plain words.)";
constexpr const char* kLevelDiagnostics =
    R"(What a level fell short of at the last compute, and why.

The smallest singular value (distance to singularity) and the product of all (manipulability) are of
the level's equality rows on the directions that the levels above left; 1 without such rows.
)";

void bind_controller(py::module_& module) {
  using Options = VelocityControllerOptions;
  const Options defaults;
  bind_options<Options>(
      module, "VelocityControllerOptions", kOptions,
      {field("dt", &Options::dt, "[s]"), field("gain", &Options::gain, "[1/s]"),
       field("horizon", &Options::horizon, "[s]"),
       field("max_acceleration", &Options::max_acceleration, "[rad/s^2]"),
       field("enforce_limits", &Options::enforce_limits, "limits before all levels"),
       field("return_speed", &Options::return_speed, "[rad/s]"),
       field("transition", &Options::transition, "[s]"),
       text_field<Options>(
           "law", [](const Options& self) { return to_string(self.law); },
           [](Options& self, const std::string& law) { self.law = law_named(law); },
           "'arrive' or 'thesis'"),
       field("solver", &Options::solver, "SolverOptions")});
  const auto integrate = [](const VelocityController& self, const ConstVectorRef& q) {
    require(q.size() == self.velocity().size() && q.allFinite(),
            "integrate wants " + std::to_string(self.velocity().size()) + " finite numbers, got " +
                std::to_string(q.size()) + (q.allFinite() ? "" : ", not all finite"));
    Vector next = q;
    self.integrate(next);
    return next;
  };
  const auto step = [](VelocityController& self, Robot& robot) {
    const InUse in_use("controller or Robot", &self, &robot);
    const py::gil_scoped_release release;
    return Vector(self.step(robot));
  };
  py::class_<VelocityController> controller(module, "VelocityController", kController);
  controller.def(py::init<const Robot&, Options>(), "robot"_a, "options"_a = defaults)
      .def("integrate", integrate, "q"_a, kIntegrate)
      .def("step", step, "robot"_a, kStep)
      .def("take_over", &VelocityController::take_over, "previous"_a, kTakeOver)
      .def_property_readonly("velocity", &VelocityController::velocity,
                             py::return_value_policy::copy,
                             "(n,) [rad/s] or [m/s], the last qdot*");
  bind_common(controller, "qdot* (n,) [rad/s] or [m/s]");
}

// what a controller knows of its last solve; rhqp.Solution has the multipliers too
void bind_solution(py::module_& module) {
  py::class_<Solution>(module, "ControlSolution", "The solution of a controller's last solve.")
      .def_readonly("x", &Solution::x, "(n,)")
      .def_readonly("status", &Solution::status)
      .def_readonly("violations", &Solution::violations,
                    "per level (m,): A x - clip(A x, lower, upper)")
      .def_readonly("working_set", &Solution::working_set, "list of ActiveRow")
      .def_readonly("factorizations", &Solution::factorizations)
      .def_readonly("changes", &Solution::changes, "working-set changes")
      .def_readonly("final_levels", &Solution::final_levels, "levels known to be optimal")
      .def_readonly("optimality", &Solution::optimality,
                    "worst relative residual of the optimality conditions of all levels");
}

void bind_diagnostics(py::module_& module) {
  py::class_<Shortfall>(module, "Shortfall", kShortfall)
      .def_readonly("task", &Shortfall::task)
      .def_readonly("short_by", &Shortfall::short_by, "[unit]")
      .def_readonly("unit", &Shortfall::unit,
                    "of the task, or of what it lacks: 'm', 'rad', 'm and rad', 'N' ...; '' where "
                    "none is known")
      .def_readonly("held_by", &Shortfall::held_by, "list of str")
      .def("__str__", &Shortfall::text);
  py::class_<LevelDiagnostics>(module, "LevelDiagnostics", kLevelDiagnostics)
      .def_readonly("level", &LevelDiagnostics::level)
      .def_readonly("smallest_singular_value", &LevelDiagnostics::smallest_singular_value)
      .def_readonly("manipulability", &LevelDiagnostics::manipulability)
      .def_readonly("shortfalls", &LevelDiagnostics::shortfalls,
                    "list of Shortfall; empty: all is well")
      .def_property_readonly(
          "shorts",
          [](const LevelDiagnostics& self) {
            warn_renamed("LevelDiagnostics.shorts", "shortfalls");
            return self.shortfalls;
          },
          "Deprecated name of shortfalls.");
}

}  // namespace

void bind_control(py::module_& module) {
  bind_solution(module);
  bind_diagnostics(module);
  bind_controller(module);
}
