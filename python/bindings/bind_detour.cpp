// control: postures that meet all tasks, and the way round by them.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bind_stack.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/control/detour.hpp"
#include "in_use.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_detour(py::module_& module);

namespace {

constexpr const char* kPosture =
    R"(What `inverse_kinematics` found. An array too: its configuration, as a PostureTask takes it.)";
constexpr const char* kInverseKinematics =
    R"(The posture nearest to the present one, of those found, that meets all tasks.

Where none does: the one that lacks least in the first level, then in the second, and so on (the
norm of its rows, in steps of ten tolerances).

A controller descends from where the robot stands; where limits or singularities end the
descent, others begin at random postures, each farther from the present one than the last.
What a controller cannot reach from here in one go (the target wants an elbow or a wrist turned
the other way) it reaches by this posture: give it to a `PostureTask` that no task of the hand
comes before, then add the hand; or let a `Detour` do that. Nothing is said of the way between the two.

Args:
  robot: stays as it is.
  tasks: what shall be met, in decreasing priority, as for a controller; limits such as
    distances come first and shall hold.
  starts: descents at most.
  seed: of the random postures; same arguments, same posture.
  tolerance: [m or rad] of each row.

Returns:
  Posture.

Raises:
  Error: no task, fewer than one start, or a tolerance that is not positive.
)";
constexpr const char* kDetour =
    R"(The detour of a loop that asks controllers of its own; `hurcules.Detour` says what it does.)";
constexpr const char* kLookAt =
    R"(Looks at the robot after a tick; as `hurcules.Detour.look`.

Args:
  robot: Robot at the reference.
  velocity: (n,) [rad/s] of the reference.
  dt: [s] since the last look.

Returns:
  True where from now on the other stack shall rule: stacks["detour"] if on_the_way, else stacks["direct"].
)";

std::vector<StackLevel> levels_of(const py::object& levels, std::vector<py::object>& kept) {
  const bool sequence = py::isinstance<py::list>(levels) || py::isinstance<py::tuple>(levels);
  if (sequence && py::len(levels) == 0) return {};
  const HeldStack held = stack_of(levels);
  kept.insert(kept.end(), held.kept.begin(), held.kept.end());
  return held.stack.levels();
}

Posture search(const Robot& robot, const StackLike& tasks, int starts, std::uint64_t seed,
               double tolerance) {
  std::vector<py::object> kept;
  PostureSearch found(robot, Stack(levels_of(tasks, kept)), {starts, seed, tolerance});
  for (bool goes_on = true; goes_on;) {
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    const py::gil_scoped_release release;
    goes_on = found.advance(1000);
  }
  return found.best();
}

// a detour with the objects that its levels are made of
struct HeldDetour {
  std::vector<py::object> kept;
  std::unique_ptr<Detour> detour;
};

HeldDetour make_detour(const Robot& robot, const StackLike& before, const StackLike& targets,
                       const StackLike& below, int starts, std::uint64_t seed, double tolerance,
                       double nearer, double rate) {
  HeldDetour made;
  const std::vector<StackLevel> first = levels_of(before, made.kept);
  const std::vector<StackLevel> middle = levels_of(targets, made.kept);
  const std::vector<StackLevel> last = levels_of(below, made.kept);
  DetourOptions options;
  options.search.starts = starts;
  options.search.seed = seed;
  options.tolerance = tolerance;
  options.nearer = nearer;
  options.rate = rate;
  made.detour = std::make_unique<Detour>(robot, first, middle, last, options);
  return made;
}

py::typing::Dict<py::str, HeldStack> stacks(const py::object& self) {
  const auto& held = self.cast<const HeldDetour&>();
  std::vector<py::object> kept = held.kept;
  kept.push_back(self);
  py::typing::Dict<py::str, HeldStack> named;
  named["direct"] = HeldStack{held.detour->direct(), kept};
  named["detour"] = HeldStack{held.detour->way(), kept};
  return named;
}

bool look_at(HeldDetour& self, const Robot& robot, const ConstVectorRef& velocity, double dt) {
  require(std::isfinite(dt) && dt > 0.0,
          "look_at: dt wants a positive number, got " + std::to_string(dt));
  const InUse in_use("Detour or Robot", &self, &robot);
  const py::gil_scoped_release release;
  return self.detour->look(robot, velocity, dt);
}

}  // namespace

void bind_detour(py::module_& module) {
  const auto copy = py::return_value_policy::copy;
  py::class_<Posture>(module, "Posture", kPosture)
      .def_readonly("configuration", &Posture::configuration, copy,
                    "(n,) [rad] or [m] of the robot, within its limits")
      .def_readonly("error", &Posture::error, "[m or rad] the largest that any row of a task lacks")
      .def_readonly("reached", &Posture::reached, "no row lacks more than the tolerance")
      .def_property_readonly(
          "starts", [](const Posture& self) { return std::pair(self.starts, self.reaching); },
          "(begun, reached): how many descents began, and how many of them reached")
      .def_readonly(
          "qpos", &Posture::qpos, copy,
          "(nq,) the whole of it, for `Robot.set_qpos`: joints that close loops may stand in "
          "more than one way at the same configuration")
      .def(
          "__array__",
          [](const Posture& self, const py::object& dtype, const py::object& /*copy*/) {
            const py::array made = py::cast(self.configuration);
            return dtype.is_none() ? py::object(made) : made.attr("astype")(dtype);
          },
          "dtype"_a = py::none(), "copy"_a = py::none())
      .def(py::pickle(
          [](const Posture& self) {
            return py::make_tuple(self.configuration, self.qpos, self.error, self.reached,
                                  self.starts, self.reaching);
          },
          [](const py::tuple& kept) {
            return Posture{kept[0].cast<Vector>(), kept[1].cast<Vector>(), kept[2].cast<double>(),
                           kept[3].cast<bool>(),   kept[4].cast<int>(),    kept[5].cast<int>()};
          }));
  const PostureSearchOptions defaults;
  module.def("inverse_kinematics", &search, "robot"_a, "tasks"_a, py::kw_only(),
             "starts"_a = defaults.starts, "seed"_a = defaults.seed,
             "tolerance"_a = defaults.tolerance, kInverseKinematics);
  const DetourOptions options;
  py::class_<HeldDetour>(module, "Detour", kDetour)
      .def(py::init(&make_detour), "robot"_a, "before"_a, "targets"_a, "below"_a = py::tuple(),
           py::kw_only(), "starts"_a = defaults.starts, "seed"_a = defaults.seed,
           "tolerance"_a = options.tolerance, "nearer"_a = options.nearer, "rate"_a = options.rate)
      .def("look_at", &look_at, "robot"_a, "velocity"_a, "dt"_a, kLookAt)
      .def(
          "reset", [](HeldDetour& self) { self.detour->reset(); },
          "The direct stack rules, as at the start.")
      .def_property_readonly(
          "stacks", &stacks,
          "by name those of a controller: 'direct' rules at the start, 'detour' on "
          "the way")
      .def_property_readonly(
          "posture", [](HeldDetour& self) -> PostureTask& { return self.detour->posture(); },
          py::return_value_policy::reference_internal,
          "PostureTask of the way; set_max_speed bounds its speed")
      .def_property_readonly(
          "on_the_way", [](const HeldDetour& self) { return self.detour->on_the_way(); },
          "the posture rules")
      .def_property_readonly(
          "decision", [](const HeldDetour& self) { return self.detour->decision(); },
          "what the last look decided, in words; '' where all goes on");
}
