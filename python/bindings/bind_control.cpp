// control: stacks of tasks, the velocity controller, the joint servo.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "hurcules/base/error.hpp"
#include "hurcules/control/joint_pid.hpp"
#include "hurcules/control/velocity_controller.hpp"
#include "solver_levels.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

void bind_control(py::module_& module);

namespace {

constexpr const char* kStackLevel = R"(Tasks of one priority.

Args:
  name: shown in plots and messages.
  tasks: sequence of Task, all on this level.
  rho: regularisation coefficient >= 0; a level of coordinate limits is never regularised.

Raises:
  Error: no task, or a rho that is negative or not finite.
)";
constexpr const char* kStack =
    R"(Tasks by priority, first comes first: Stack([limits, [left, right], posture]).

Args:
  levels: sequence of Task, StackLevel, or a list of tasks that share a level.

Raises:
  Error: a task stands twice.
)";
constexpr const char* kOptions = R"(Options of the velocity controller.

Args:
  dt: [s] control period.
  gain: [1/s] with which errors vanish.
  horizon: [s] a position limit is approached no faster than distance / horizon.
  max_acceleration: [rad/s^2] of every coordinate, inf for none.
  return_speed: [rad/s] at which a coordinate outside its limits is driven back.
  transition: [s] in which the velocity goes over to a stack that was set in motion; 0 for none.
  solver: SolverOptions; the default is SolverOptions(handover="smooth"), so that no velocity jumps
    where a task loses a direction.
)";
constexpr const char* kController =
    R"(From a stack to velocities: first-order closed-loop inverse kinematics.

Args:
  robot: Robot that the tasks were made for.
  options: VelocityControllerOptions.
)";
constexpr const char* kSetStack = "Takes over another stack; keeps its tasks alive.";
constexpr const char* kCompute =
    R"(Measures the tasks at the robot's configuration, builds the hierarchy, solves it.

Args:
  robot: Robot at the reference configuration q*.

Returns:
  qdot* (n,) [rad/s] or [m/s]. Releases the interpreter lock.
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
constexpr const char* kActiveLimits =
    "(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one";
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
constexpr const char* kState = "What must be kept between ticks, as a flat list; see restore.";
constexpr const char* kRestore = "Goes on from what state() gave.";

// a level and a stack that keep the Python objects of their tasks alive
struct HeldLevel {
  StackLevel level;
  std::vector<py::object> kept;
};
struct HeldStack {
  Stack stack;
  std::vector<py::object> kept;
};

template <typename Object>
std::vector<double> state(const Object& object) {
  std::vector<double> values;
  StateWriter writer(values);
  object.save(writer);
  return values;
}

template <typename Object>
void restore(Object& object, const std::vector<double>& values) {
  StateReader reader(values);
  object.restore(reader);
}

void keep(std::vector<py::object>& kept, py::handle object) {
  kept.push_back(py::reinterpret_borrow<py::object>(object));
}

std::string type_of(py::handle object) {
  return py::str(py::type::handle_of(object).attr("__name__"));
}

Task* task_of(py::handle item) {
  require(py::isinstance<Task>(item), "a level wants tasks, a " + type_of(item) + " came");
  return item.cast<Task*>();
}

HeldLevel make_level(const std::string& name, const py::iterable& tasks, double rho) {
  std::vector<Task*> pointers;
  std::vector<py::object> kept;
  for (const py::handle task : tasks) {
    pointers.push_back(task_of(task));
    keep(kept, task);
  }
  return {StackLevel(name, std::move(pointers), rho), std::move(kept)};
}

StackLevel one_level(py::handle item, std::vector<py::object>& kept) {
  keep(kept, item);
  if (py::isinstance<HeldLevel>(item)) return item.cast<const HeldLevel&>().level;
  return {*task_of(item)};
}

// a task, a level, or a list of both
StackLevel level_of(py::handle item, std::vector<py::object>& kept) {
  if (!py::isinstance<py::list>(item) && !py::isinstance<py::tuple>(item)) {
    return one_level(item, kept);
  }
  std::vector<StackLevel> parts;
  for (const py::handle part : item) parts.push_back(one_level(part, kept));
  require(!parts.empty(), "a level of a stack wants at least one task, an empty list came");
  StackLevel level = parts.front();
  for (std::size_t i = 1; i < parts.size(); ++i) level = level + parts[i];
  return level;
}

HeldStack make_stack(const py::iterable& levels) {
  std::vector<StackLevel> made;
  std::vector<py::object> kept;
  for (const py::handle item : levels) made.push_back(level_of(item, kept));
  require(!made.empty(), "a stack wants at least one level, none came");
  return {Stack(std::move(made)), std::move(kept)};
}

std::vector<std::string> level_names(const HeldStack& self) {
  std::vector<std::string> names;
  for (const StackLevel& level : self.stack.levels()) names.push_back(level.name);
  return names;
}

void bind_stack(py::module_& module) {
  py::class_<HeldLevel>(module, "StackLevel", kStackLevel)
      .def(py::init(&make_level), "name"_a, "tasks"_a, "rho"_a = StackLevel::kDefaultRho)
      .def_property_readonly("name", [](const HeldLevel& self) { return self.level.name; })
      .def_property_readonly("rho", [](const HeldLevel& self) { return self.level.rho; })
      .def_property_readonly("tasks", [](const HeldLevel& self) { return self.kept; })
      .def("__repr__",
           [](const HeldLevel& self) { return "StackLevel('" + self.level.name + "')"; });
  py::class_<HeldStack>(module, "Stack", kStack)
      .def(py::init(&make_stack), "levels"_a)
      .def_property_readonly("levels", &level_names, "list of str, decreasing priority")
      .def("__len__", [](const HeldStack& self) { return self.stack.levels().size(); })
      .def("__repr__", [](const HeldStack& self) { return self.stack.text(); });
}

void require_stack(const VelocityController& controller) {
  require(!controller.stack().levels().empty(), "a controller wants a stack before it computes");
}

void bind_controller(py::module_& module) {
  using Options = VelocityControllerOptions;
  const Options defaults;
  py::class_<Options>(module, "VelocityControllerOptions", kOptions)
      .def(py::init([](double dt, double gain, double horizon, double max_acceleration,
                       double return_speed, double transition, const SolverOptions& solver) {
             return Options{dt, gain, horizon, max_acceleration, return_speed, transition, solver};
           }),
           py::kw_only(), "dt"_a = defaults.dt, "gain"_a = defaults.gain,
           "horizon"_a = defaults.horizon, "max_acceleration"_a = defaults.max_acceleration,
           "return_speed"_a = defaults.return_speed, "transition"_a = defaults.transition,
           "solver"_a = defaults.solver)
      .def_readwrite("dt", &Options::dt, "[s]")
      .def_readwrite("gain", &Options::gain, "[1/s]")
      .def_readwrite("horizon", &Options::horizon, "[s]")
      .def_readwrite("max_acceleration", &Options::max_acceleration, "[rad/s^2]")
      .def_readwrite("return_speed", &Options::return_speed, "[rad/s]")
      .def_readwrite("transition", &Options::transition, "[s]")
      .def_readwrite("solver", &Options::solver, "SolverOptions");
  // the stack is kept beside the controller, as set_stack got it
  const auto set_stack = [](VelocityController& self, const HeldStack& stack) {
    self.set_stack(stack.stack);
  };
  const auto compute = [](VelocityController& self, const Robot& robot) {
    require_stack(self);
    py::gil_scoped_release release;
    return Vector(self.compute(robot));
  };
  const auto integrate = [](const VelocityController& self, const ConstVectorRef& q) {
    require(q.size() == self.velocity().size() && q.allFinite(),
            "integrate wants " + std::to_string(self.velocity().size()) + " finite numbers, got " +
                std::to_string(q.size()) + (q.allFinite() ? "" : ", not all finite"));
    Vector next = q;
    self.integrate(next);
    return next;
  };
  const auto step = [](VelocityController& self, Robot& robot) {
    require_stack(self);
    py::gil_scoped_release release;
    return Vector(self.step(robot));
  };
  const auto copy = py::return_value_policy::copy;
  py::class_<VelocityController>(module, "VelocityController", kController)
      .def(py::init<const Robot&, Options>(), "robot"_a, "options"_a = defaults)
      .def("set_stack", set_stack, "stack"_a, py::keep_alive<1, 2>(), kSetStack)
      .def("compute", compute, "robot"_a, kCompute)
      .def("integrate", integrate, "q"_a, kIntegrate)
      .def("step", step, "robot"_a, kStep)
      .def("reset", &VelocityController::reset, "At rest, cold.")
      .def("state", &state<VelocityController>, kState)
      .def("restore", &restore<VelocityController>, "state"_a, kRestore)
      .def_property_readonly("options", &VelocityController::options, copy)
      .def_property_readonly("velocity", &VelocityController::velocity, copy,
                             "(n,) [rad/s] or [m/s], the last qdot*")
      .def_property_readonly("active_limits", &VelocityController::active_limits, copy,
                             kActiveLimits)
      .def_property_readonly("solution", &VelocityController::solution, copy,
                             "ControlSolution, of the last compute")
      .def_property_readonly(
          "hierarchy",
          [](const VelocityController& self) {
            return hurcules_bindings::copies_of(self.hierarchy());
          },
          "list of Level, of the last compute")
      .def_property_readonly(
          "stack", [](const VelocityController& self) { return self.stack().text(); },
          "'joint < hpos < ...'");
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

void bind_pid(py::module_& module) {
  using Options = JointPidOptions;
  const Options defaults;
  py::class_<Options>(module, "JointPidOptions", kPidOptions)
      .def(py::init([](const Vector& K, const Vector& K_P, const Vector& K_I,
                       const Vector& max_torque, double gamma,
                       double dt) { return Options{K, K_P, K_I, gamma, max_torque, dt}; }),
           py::kw_only(), "K"_a, "K_P"_a, "K_I"_a, "max_torque"_a, "gamma"_a = defaults.gamma,
           "dt"_a = defaults.dt)
      .def_readwrite("K", &Options::K, "(m,) [N m s/rad]")
      .def_readwrite("K_P", &Options::K_P, "(m,) [1/s]")
      .def_readwrite("K_I", &Options::K_I, "(m,) [1/s^2]")
      .def_readwrite("gamma", &Options::gamma)
      .def_readwrite("max_torque", &Options::max_torque, "(m,) [N m]")
      .def_readwrite("dt", &Options::dt, "[s]");
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

}  // namespace

void bind_control(py::module_& module) {
  bind_stack(module);
  bind_solution(module);
  bind_controller(module);
  bind_pid(module);
}
