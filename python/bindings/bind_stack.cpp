// control: levels and stacks of tasks.
#include "bind_stack.hpp"

#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <string>
#include <utility>

#include "hurcules/base/error.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_stack(py::module_& module);

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

HeldLevel make_level(const std::string& name, const py::typing::Iterable<Task>& tasks, double rho) {
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

// what Stack takes
using Levels = py::typing::Iterable<
    py::typing::Union<Task, HeldLevel, py::typing::Iterable<py::typing::Union<Task, HeldLevel>>>>;

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

}  // namespace

HeldStack hurcules_bindings::stack_of(const py::object& levels) {
  if (py::isinstance<HeldStack>(levels)) return levels.cast<const HeldStack&>();
  require(py::isinstance<py::iterable>(levels) && !py::isinstance<py::str>(levels),
          "levels want a Stack or a list of tasks, a " + type_of(levels) + " came");
  return make_stack(levels.cast<py::iterable>());
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
