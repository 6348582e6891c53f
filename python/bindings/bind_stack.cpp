// control: limits of the coordinates, levels and stacks of tasks.
#include "bind_stack.hpp"

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include <string>
#include <utility>

#include "hurcules/base/error.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_stack(py::module_& module);

namespace {

constexpr const char* kJointLimits =
    R"(Ranges and speed limits of all coordinates (n,): no task, but what holds before all tasks.

A controller has those of the robot; where a stack names others, these take their place. They come
first in a stack, alone on their level.

Args:
  name: shown in plots and messages.
  robot: Robot, whose limits it starts with.
)";
constexpr const char* kSetRange =
    "Narrows the range of one coordinate [rad] or [m]; never wider than the robot's.";
constexpr const char* kSetInterval =
    "Narrows the ranges of all coordinates (n,); never wider than the robot's.";
constexpr const char* kSetMaxVelocity =
    "Speed limit of one coordinate [rad/s] or [m/s], above 0; the robot's own holds where it is "
    "smaller. inf: none at all, for what is only reckoned.";
constexpr const char* kSetMaxVelocities =
    "Speed limits of all coordinates (n,), or one for all [rad/s] or [m/s], above 0; the robot's "
    "own hold "
    "where they are smaller. inf: none at all, for what is only reckoned.";
constexpr const char* kNoOrder =
    "limits are not ordered by '<' in Python (a < b < c would lose a): use Stack([a, b, c])";
constexpr const char* kStackLevel = R"(Tasks of one priority, or limits of the coordinates.

Args:
  name: shown in plots and messages.
  tasks: sequence of Task, all on this level, or JointLimits alone.
  rho: regularisation coefficient >= 0; a level of coordinate limits is never regularised.

Raises:
  Error: no task, or a rho that is negative or not finite.
)";
constexpr const char* kStack =
    R"(Tasks by priority, first comes first: Stack([limits, [left, right], posture]).

Args:
  levels: sequence of Task, StackLevel, or a list of tasks that share a level; JointLimits come
    first, where they are named.

Raises:
  Error: a task stands twice, or limits stand elsewhere.
)";

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

using TaskOrLimits = py::typing::Union<Task, JointLimits>;

HeldLevel make_stack_level(const std::string& name, const py::typing::Iterable<TaskOrLimits>& tasks,
                           double rho) {
  std::vector<py::object> kept;
  for (const py::handle task : tasks) keep(kept, task);
  if (kept.size() == 1 && py::isinstance<JointLimits>(kept.front())) {
    StackLevel level(kept.front().cast<JointLimits&>());
    level.name = name;
    return {std::move(level), std::move(kept)};
  }
  std::vector<Task*> pointers;
  for (const py::object& task : kept) pointers.push_back(task_of(task));
  return {StackLevel(name, std::move(pointers), rho), std::move(kept)};
}

StackLevel one_level(py::handle item, std::vector<py::object>& kept) {
  keep(kept, item);
  if (py::isinstance<HeldLevel>(item)) return item.cast<const HeldLevel&>().level;
  if (py::isinstance<JointLimits>(item)) return {item.cast<JointLimits&>()};
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

HeldStack make_stack(const Levels& levels) {
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

void bind_limits(py::module_& module) {
  const auto copy = py::return_value_policy::copy;
  const auto unordered = [](const JointLimits&, const py::object&) -> bool {
    throw py::type_error(kNoOrder);
  };
  py::class_<JointLimits>(module, "JointLimits", kJointLimits)
      .def(py::init<std::string, const Robot&>(), "name"_a, "robot"_a)
      .def("set_range", &JointLimits::set_range, "coordinate"_a, "lower"_a, "upper"_a, kSetRange)
      .def("set_interval", &JointLimits::set_interval, "lower"_a, "upper"_a, kSetInterval)
      .def("reset_ranges", &JointLimits::reset_ranges, "The ranges of the robot again.")
      .def("set_max_velocity", &JointLimits::set_max_velocity, "coordinate"_a, "limit"_a,
           kSetMaxVelocity)
      .def(
          "set_max_velocities",
          [](JointLimits& self, double limit) {
            self.set_max_velocities(Vector::Constant(self.size(), limit));
          },
          "limits"_a, kSetMaxVelocities)
      .def("set_max_velocities", &JointLimits::set_max_velocities, "limits"_a, kSetMaxVelocities)
      .def("update", &JointLimits::update, "robot"_a, "Notes where the coordinates are.")
      .def("state", &state<JointLimits>, kState)
      .def("restore", &restore<JointLimits>, "state"_a, kRestore)
      .def_property_readonly("name", &JointLimits::name)
      .def_property_readonly("rows", &JointLimits::size, "n")
      .def_property_readonly("lower", &JointLimits::lower, copy, "(n,) [rad] or [m]")
      .def_property_readonly("upper", &JointLimits::upper, copy, "(n,) [rad] or [m]")
      .def_property_readonly("max_velocity", &JointLimits::max_velocity, copy, "(n,) [rad/s]")
      .def_property_readonly("error", &JointLimits::configuration, copy,
                             "(n,) [rad] or [m]: q at the last update")
      .def("__lt__", unordered)
      .def("__gt__", unordered)
      .def("__repr__",
           [](const JointLimits& self) { return "JointLimits('" + self.name() + "')"; });
}

}  // namespace

HeldStack hurcules_bindings::stack_of(const py::object& levels) {
  if (py::isinstance<HeldStack>(levels)) return levels.cast<const HeldStack&>();
  require(py::isinstance<py::iterable>(levels) && !py::isinstance<py::str>(levels),
          "levels want a Stack or a list of tasks, a " + type_of(levels) + " came");
  return make_stack(levels.cast<py::iterable>());
}

void bind_stack(py::module_& module) {
  bind_limits(module);
  py::class_<HeldLevel>(module, "StackLevel", kStackLevel)
      .def(py::init(&make_stack_level), "name"_a, "tasks"_a, "rho"_a = StackLevel::kDefaultRho)
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
