// tasks: inequalities: torques of the drives, balance, distances.
#include <mujoco/mujoco.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "annotated.hpp"
#include "arrays.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/sole_points.hpp"
#include "hurcules/tasks/balance_task.hpp"
#include "hurcules/tasks/contact_task.hpp"
#include "hurcules/tasks/distance_task.hpp"
#include "hurcules/tasks/torque_limits.hpp"
#include "hurcules/tasks/zero_moment_task.hpp"
#include "warn.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_limit_tasks(py::module_& module);

namespace {

constexpr const char* kTorqueLimits =
    R"(What the drives of the coordinates can give: lower <= M qddot + h <= upper [N m] (n,).

A level of its own, below the joint limits; for AccelerationController.

Args:
  name: shown in plots and messages.
  robot: Robot, whose efforts it starts with (inf where it has none).
)";
constexpr const char* kContactTask =
    R"(A body that keeps its place on what it stands on, and the forces that this may take.

For stacks by torques (AccelerationController.torque). Its points neither slide nor lift; the forces at
them are unknowns of the hierarchy, inside pyramids within the friction cones. A stack has its contacts
on one level; the torque limits of the robot come before it by themselves, and at the end the least forces.

Args:
  name: shown in plots and messages.
  robot: Robot; with floating=True for one that nothing else carries.
  body: name of the body, a foot, say.
  points: (k, 3) [m] in the body's frame; None: the lowest points of its collision geoms as the robot
    stands, four at most (sole_points), drawn in by a tenth so that it does not tip over its edge.
    Three or more hold the body in 6-D, one or two themselves.
  friction: Coulomb's coefficient, > 0.
  normal: (3,) in W, out of what it stands on.

Raises:
  Error: no such body, a body without collision geoms, a friction that is not positive.
)";
constexpr const char* kSolePoints =
    R"(The lowest points of the collision geoms of a body, and of what is welded to it, as the robot stands.

Args:
  robot: Robot.
  body: name of a body.

Returns:
  (k, 3) [m] in the body's frame, the outermost four at most within 3 mm of the lowest; the lowest
  alone where these are less than 5 cm apart, as on a round foot.

Raises:
  Error: no such body, or one without collision geoms.
)";
constexpr const char* kBalanceTask =
    R"(The centre of mass stays over a polygon: e (k,) [m], distances from its sides, margin <= e.

A limit that is approached no faster than edot = -gain (e - margin). The gain is sqrt(g / h) by default, h
the height of the centre of mass where the task was made: so the capture point keeps the margin, too.

Args:
  name, robot: see TorqueLimits.
  polygon: (k, 2) [m] corners of a convex polygon in x and y of the reference.
  margin: [m] kept from its sides.
  reference: frame whose axes the corners are in, '' for the world.
  height: [m] of the polygon, z in the axes of the reference.
  room: a row each for so many corners of later polygons, at least k.

Raises:
  Error: fewer than three corners, or corners that are not convex.
)";
constexpr const char* kSetPolygon =
    R"(Another polygon from the next tick on, after a step say.

Args:
  polygon: (j, 2) [m] corners as for the task, no more of them than it has rows.

Raises:
  Error: more corners, fewer than three, or corners that are not convex.
)";
constexpr const char* kZeroMomentTask =
    R"(The zero moment point stays in a polygon: no motion tips the robot over.

Rows (k,) [m^2/s^2]: the moment of gravity and inertia about each side, a kilogram of the robot, as it is
at an acceleration; margin |g| <= J qddot + drift. The one task that bounds accelerations under velocities
and under accelerations. It stands above the tasks that move the robot; a BalanceTask below it, with a
larger margin, keeps room for it to brake.

Args:
  name, robot: see TorqueLimits.
  polygon: (k, 2) [m] corners of a convex polygon in x and y of the reference, on the ground.
  margin: [m] that the point keeps from the sides.
  reference: frame whose axes the corners are in, '' for the world.
  height: [m] of the polygon, z in the axes of the reference.

Raises:
  Error: fewer than three corners, or corners that are not convex; a model without gravity.
)";
constexpr const char* kDistanceTask =
    R"(Bodies keep away from each other: e (m,) [m], distances of the nearest pairs, margin <= e.

Controllers brake before the margin as before a joint limit, with half of the acceleration that the
coordinates have along a row; the gain plays no part. A row belongs to a pair of geoms while that is
nearer than `most` and among the nearest, up to three more to points of it that were nearest before:
flat faces rest on each other. Without a pair a row asks for nothing (e = most, J = 0).

Args:
  name, robot: see TorqueLimits.
  pairs: of names of bodies or geoms; a body stands for its geoms that can touch something.
  margin: [m].
  most: [m] > margin; pairs farther apart ask for nothing.
  rows: so many points of pairs of geoms count at a time, the nearest.
  as_it_stands: a pair that is nearer than the margin now keeps half of its present distance.

Raises:
  Error: a name that does not exist, no pair, two that no coordinate moves against each other, or
    most <= margin, or margin < 0.
)";
constexpr const char* kSelfCollision =
    R"(The robot keeps away from itself: a DistanceTask for a level above the hands.

Its pairs are found: geoms of the robot that the model lets touch (contype, conaffinity, exclude).
Left out are neighbours in the tree, pairs in contact now or in nearly every sampled posture, and
pairs that come nearer than 2 `most` in none. A pair that is nearer than the margin now keeps half of
its present distance.

Args:
  robot: Robot, in a posture that it may stand in.
  margin, most, rows: see DistanceTask.
  postures: sampled between the limits, evenly.
  seed: of the samples.

Returns:
  DistanceTask "self_collision"; without a pair it asks for nothing.

Raises:
  Error: most <= margin, or postures or rows below 1.
)";
constexpr const char* kObstacles =
    R"(The robot keeps away from what stands around it: a DistanceTask for a level above the hands.

Its pairs are found as by self_collision: geoms of the robot with all that stands still (floor,
walls, tables), and with the bodies of these names, wherever they are: they may move. In a
Simulation the task sees how, elsewhere DistanceTask.set_obstacle says it.

Args:
  robot, margin, most, rows, postures, seed: see self_collision.
  bodies: names of bodies that have joints, or are moved by mocap, and count too.

Returns:
  DistanceTask "obstacles"; without a pair it asks for nothing. Warns (UserWarning) of pairs that are
  left out since they touch now.

Raises:
  Error: a name that is no body or a body of the robot, or see self_collision.
)";
constexpr const char* kSetObstacle =
    R"(Where a body is that the coordinates do not move, and how it moves, until the next call.

The distance then counts that it comes: the robot gives way in time.

Args:
  robot: the robot of the task.
  body: name of a body of some pair.
  position: (3,) [m] in the world.
  rotation: (3, 3) or quaternion (4,) w x y z in the world, None for none.
  velocity: (3,) [m/s] of its origin.
  angular_velocity: (3,) [rad/s].

Raises:
  Error: a body that is in no pair or part of the robot, a matrix that is no rotation.
)";

using NearPair = std::tuple<std::string, std::string, double>;

std::pair<std::string, std::string> names_of(const Robot& robot, const GeomPair& pair) {
  return {geom_name(*robot.model(), pair.first), geom_name(*robot.model(), pair.second)};
}

std::vector<std::pair<std::string, std::string>> pair_names(const DistanceTask& task,
                                                            const Robot& robot) {
  std::vector<std::pair<std::string, std::string>> names;
  for (const GeomPair& pair : task.pairs()) names.push_back(names_of(robot, pair));
  return names;
}

// pairs that are left out since they touch now: feet on the ground, but a hand on a table too
void warn_of_contacts(const Robot& robot, const DistanceTask& task) {
  const mjModel& m = *robot.model();
  const std::unique_ptr<mjData, void (*)(mjData*)> d(mj_makeData(&m), mj_deleteData);
  std::copy(robot.qpos().begin(), robot.qpos().end(), d->qpos);
  mj_fwdPosition(&m, d.get());
  std::set<std::string> touching;
  for (int i = 0; i < d->ncon; ++i) {
    const int a = d->contact[i].geom[0], b = d->contact[i].geom[1];
    if (a < 0 || b < 0 || d->contact[i].dist > 0.0) continue;
    if (m.body_rootid[m.geom_bodyid[a]] == m.body_rootid[m.geom_bodyid[b]]) continue;
    if (!robot.moves({mjOBJ_GEOM, a}, {mjOBJ_GEOM, b})) continue;
    const auto same = [a, b](const GeomPair& pair) {
      return pair == GeomPair{a, b} || pair == GeomPair{b, a};
    };
    if (std::none_of(task.pairs().begin(), task.pairs().end(), same))
      touching.insert("(" + geom_name(*robot.model(), a) + ", " + geom_name(*robot.model(), b) +
                      ")");
  }
  std::string names;
  for (const std::string& pair : touching) names += (names.empty() ? "" : ", ") + pair;
  if (names.empty()) return;
  hurcules_bindings::warn("obstacles leaves out what touches now: " + names +
                          ". Make it in a posture away from what the robot shall keep away from");
}

void warn_of_height_fields(const Robot& robot) {
  const mjModel& m = *robot.model();
  std::string names;
  for (int geom = 0; geom < m.ngeom; ++geom) {
    if (m.geom_type[geom] != mjGEOM_HFIELD) continue;
    names += (names.empty() ? "" : ", ") + geom_name(*robot.model(), geom);
  }
  if (names.empty()) return;
  hurcules_bindings::warn(
      "obstacles leaves out height fields, whose distance MuJoCo does not measure "
      "rightly: " +
      names + ". Boxes or meshes in their place count");
}

std::vector<NearPair> near_pairs(const DistanceTask& task, const Robot& robot) {
  std::vector<NearPair> near;
  for (Index row = 0; row < task.rows(); ++row) {
    if (task.pair(row) < 0 || task.is_kept(row)) continue;
    const auto [first, second] =
        names_of(robot, task.pairs()[static_cast<std::size_t>(task.pair(row))]);
    near.emplace_back(first, second, task.error()[row]);
  }
  return near;
}

void set_obstacle(DistanceTask& task, const Robot& robot, const std::string& body,
                  const Vector3& position, const OptionalArrayLike& rotation,
                  const Vector3& velocity, const Vector3& angular_velocity) {
  task.set_obstacle(
      robot, body,
      {{position, rotation.is_none() ? Matrix3(Matrix3::Identity())
                                     : rotation_from(rotation, "rotation of '" + body + "'")},
       velocity,
       angular_velocity});
}

}  // namespace

void bind_limit_tasks(py::module_& module) {
  py::class_<TorqueLimits, Task>(module, "TorqueLimits", kTorqueLimits)
      .def(py::init<std::string, const Robot&>(), "name"_a, "robot"_a);
  using Points = Eigen::Matrix<double, Eigen::Dynamic, 3>;
  const ContactTaskOptions contact;
  const auto make_contact = [](std::string name, const Robot& robot, const std::string& body,
                               const std::optional<Points>& points, double friction,
                               const Vector3& normal) {
    ContactTaskOptions options{{}, friction, normal};
    for (Index i = 0; points && i < points->rows(); ++i)
      options.points.emplace_back(points->row(i));
    return std::make_unique<ContactTask>(std::move(name), robot, body, std::move(options));
  };
  py::class_<ContactTask, Task>(module, "ContactTask", kContactTask)
      .def(py::init(make_contact), "name"_a, "robot"_a, "body"_a, "points"_a = py::none(),
           "friction"_a = contact.friction, "normal"_a = contact.normal)
      .def_property_readonly(
          "points",
          [](const ContactTask& self) {
            Points points(static_cast<Index>(self.options().points.size()), 3);
            for (Index i = 0; i < points.rows(); ++i)
              points.row(i) = self.options().points[static_cast<std::size_t>(i)];
            return points;
          },
          "(k, 3) [m] in the body's frame");
  module.def(
      "sole_points",
      [](const Robot& robot, const std::string& body) {
        const std::vector<Vector3> found = sole_points(robot, body);
        Points points(static_cast<Index>(found.size()), 3);
        for (Index i = 0; i < points.rows(); ++i)
          points.row(i) = found[static_cast<std::size_t>(i)];
        return points;
      },
      "robot"_a, "body"_a, kSolePoints);
  const BalanceTaskOptions balance;
  const auto make_balance = [](std::string name, const Robot& robot, Matrix polygon, double margin,
                               std::string reference, double height, Index room) {
    return std::make_unique<BalanceTask>(
        std::move(name), robot,
        BalanceTaskOptions{std::move(polygon), margin, height, std::move(reference), room});
  };
  py::class_<BalanceTask, Task>(module, "BalanceTask", kBalanceTask)
      .def(py::init(make_balance), "name"_a, "robot"_a, "polygon"_a, "margin"_a = balance.margin,
           "reference"_a = balance.reference, "height"_a = balance.height, "room"_a = balance.room)
      .def("set_polygon", &BalanceTask::set_polygon, "polygon"_a, kSetPolygon);
  const ZeroMomentTaskOptions zero_moment;
  const auto make_zero_moment = [](std::string name, const Robot& robot, Matrix polygon,
                                   double margin, std::string reference, double height) {
    return std::make_unique<ZeroMomentTask>(
        std::move(name), robot,
        ZeroMomentTaskOptions{std::move(polygon), margin, height, std::move(reference)});
  };
  py::class_<ZeroMomentTask, Task>(module, "ZeroMomentTask", kZeroMomentTask)
      .def(py::init(make_zero_moment), "name"_a, "robot"_a, "polygon"_a,
           "margin"_a = zero_moment.margin, "reference"_a = zero_moment.reference,
           "height"_a = zero_moment.height);
  const DistanceTaskOptions distance;
  const auto make_distance = [](std::string name, const Robot& robot,
                                std::vector<std::pair<std::string, std::string>> pairs,
                                double margin, double most, Index rows, bool as_it_stands) {
    const DistanceTaskOptions options{std::move(pairs), margin, most, rows, as_it_stands};
    return std::make_unique<DistanceTask>(std::move(name), robot, options);
  };
  py::class_<DistanceTask, Task>(module, "DistanceTask", kDistanceTask)
      .def(py::init(make_distance), "name"_a, "robot"_a, "pairs"_a, "margin"_a = distance.margin,
           "most"_a = distance.most, "rows"_a = distance.rows,
           "as_it_stands"_a = distance.as_it_stands)
      .def("set_obstacle", &set_obstacle, "robot"_a, "body"_a, "position"_a,
           "rotation"_a = py::none(), "velocity"_a = Vector3::Zero().eval(),
           "angular_velocity"_a = Vector3::Zero().eval(), kSetObstacle)
      .def("clear_obstacles", &DistanceTask::clear_obstacles,
           "All obstacles where the robot has them, at rest, or where a Simulation sees them.")
      .def_property(
          "sees_obstacles", &DistanceTask::sees_obstacles, &DistanceTask::set_sees_obstacles,
          "A Simulation says where bodies are that may move, unless set_obstacle has said "
          "so.")
      .def("__copy__",
           [](const DistanceTask& self) { return std::make_unique<DistanceTask>(self); })
      .def("pairs", &pair_names, "robot"_a, "Names of the geoms of each pair.")
      .def("near", &near_pairs, "robot"_a,
           "Names of the geoms of the pairs that have a row, and their e [m], as of the last "
           "update.");
  const CollisionOptions usual;
  module.def(
      "self_collision",
      [](const Robot& robot, double margin, double most, Index rows, int postures, unsigned seed) {
        return std::make_unique<DistanceTask>(
            self_collision(robot, {margin, most, rows, postures, seed}));
      },
      "robot"_a, "margin"_a = usual.margin, "most"_a = usual.most, "rows"_a = usual.rows,
      "postures"_a = usual.postures, "seed"_a = usual.seed, kSelfCollision);
  module.def(
      "obstacles",
      [](const Robot& robot, const std::vector<std::string>& bodies, double margin, double most,
         Index rows, int postures, unsigned seed) {
        auto task = std::make_unique<DistanceTask>(
            obstacles(robot, bodies, {margin, most, rows, postures, seed}));
        warn_of_contacts(robot, *task);
        warn_of_height_fields(robot);
        return task;
      },
      "robot"_a, "bodies"_a = std::vector<std::string>(), "margin"_a = usual.margin,
      "most"_a = usual.most, "rows"_a = usual.rows, "postures"_a = usual.postures,
      "seed"_a = usual.seed, kObstacles);
}
