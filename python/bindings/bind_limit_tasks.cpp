// tasks: inequalities: torques of the drives, balance, distances.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hurcules/tasks/balance_task.hpp"
#include "hurcules/tasks/distance_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;

void bind_limit_tasks(py::module_& module);

namespace {

constexpr const char* kTorqueLimits =
    R"(What the drives of the coordinates can give: lower <= M qddot + h <= upper [N m] (n,).

A level of its own, below the joint limits; for AccelerationController.

Args:
  name: shown in plots and messages.
  robot: Robot, whose efforts it starts with (inf where it has none).
)";
constexpr const char* kBalanceTask =
    R"(The centre of mass stays over a polygon: e (k,) [m], distances from its sides, margin <= e.

Args:
  name, robot: see TorqueLimits.
  polygon: (k, 2) [m] corners of a convex polygon in x and y of the reference.
  margin: [m] kept from its sides.
  reference: frame whose axes the corners are in, '' for the world.

Raises:
  Error: fewer than three corners, or corners that are not convex.
)";
constexpr const char* kDistanceTask =
    R"(Bodies keep away from each other: e (k,) [m], a distance a pair, margin <= e.

Args:
  name, robot: see TorqueLimits.
  pairs: of names of bodies or geoms.
  margin: [m].
  most: [m] > margin; pairs farther apart ask for nothing.

Raises:
  Error: a name that does not exist, or most <= margin.
)";

}  // namespace

void bind_limit_tasks(py::module_& module) {
  py::class_<TorqueLimits, Task>(module, "TorqueLimits", kTorqueLimits)
      .def(py::init<std::string, const Robot&>(), "name"_a, "robot"_a);
  const BalanceTaskOptions balance;
  const auto make_balance = [](std::string name, const Robot& robot, Matrix polygon, double margin,
                               std::string reference) {
    return std::make_unique<BalanceTask>(
        std::move(name), robot,
        BalanceTaskOptions{std::move(polygon), margin, std::move(reference)});
  };
  py::class_<BalanceTask, Task>(module, "BalanceTask", kBalanceTask)
      .def(py::init(make_balance), "name"_a, "robot"_a, "polygon"_a, "margin"_a = balance.margin,
           "reference"_a = balance.reference);
  const DistanceTaskOptions distance;
  const auto make_distance = [](std::string name, const Robot& robot,
                                std::vector<std::pair<std::string, std::string>> pairs,
                                double margin, double most) {
    return std::make_unique<DistanceTask>(std::move(name), robot,
                                          DistanceTaskOptions{std::move(pairs), margin, most});
  };
  py::class_<DistanceTask, Task>(module, "DistanceTask", kDistanceTask)
      .def(py::init(make_distance), "name"_a, "robot"_a, "pairs"_a, "margin"_a = distance.margin,
           "most"_a = distance.most);
}
