// tasks: what the controller shall achieve. Options of the C++ tasks are keyword arguments here.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>

#include "annotated.hpp"
#include "arrays.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/tasks/angle_task.hpp"
#include "hurcules/tasks/center_of_mass_task.hpp"
#include "hurcules/tasks/custom_task.hpp"
#include "hurcules/tasks/damping_task.hpp"
#include "hurcules/tasks/gaze_task.hpp"
#include "hurcules/tasks/manipulability_task.hpp"
#include "hurcules/tasks/orientation_task.hpp"
#include "hurcules/tasks/pose_task.hpp"
#include "hurcules/tasks/position_task.hpp"
#include "hurcules/tasks/posture_task.hpp"
#include "hurcules/tasks/swivel_task.hpp"
#include "renamed.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace hurcules;
using namespace hurcules_bindings;
using Name = std::string;

namespace {

Vector3 point_of(const ArrayLike& target, const Task& task) {
  const std::string what = "target of task '" + task.name() + "'";
  const Vector values = vector_of(target, what, "(3,)");
  require_size(what, values.size(), 3);
  return values;
}

constexpr const char* kTask = R"(What a task is: it measures, a controller decides.

Error e (m,) with de/dt = J qdot - velocity_des, and the wish lower <= e <= upper (a point: both 0).
A new task holds the robot's present value. Arrays are copies, as of the last update.
)";
constexpr const char* kUpdate = "Measures at the robot's present configuration.";
constexpr const char* kHold = "Makes the present value the target, at rest, and updates.";
constexpr const char* kAdvance =
    R"(Moves the target and feeds the velocity forward until the next advance or hold.

Args:
  velocity: (m,) unit of the task per second.
  dt: [s]. The target moves by velocity * dt; the error follows at the next update.
)";
constexpr const char* kSetMaxAcceleration =
    R"(What the task asks for changes no faster, and brakes no harder before its target.

Norms, and feed-forwards, as in set_max_speed. By default inf: the accelerations of the coordinates are
limited alone. Limits and the end of reach may stop the robot harder; what was held and is let go starts
by up to 0.2 s of it at once. A row that is free within an interval is not held back; law='thesis' knows
no such limit.

Args:
  acceleration: [unit/s^2], positive; inf for none.

Raises:
  Error: no positive number.
)";
constexpr const char* kSetMaxSpeed =
    R"(No more than this is asked for to bring the error to its interval; a feed-forward comes on top.

By default 0.5 m/s for points, 0.3 m/s for the centre of mass, 1.5 rad/s for turns and angles,
1 rad/s for each coordinate of a posture. A norm; where rows stand apart (posture, balance,
distances) each row alone.

Args:
  speed: [unit/s], positive.
)";
constexpr const char* kSetGain =
    R"(Rate at which errors of this task vanish, instead of the controller's.

Args:
  gain: [1/s], positive; one number, or one a row (m,). More than one by the control period counts as that.
)";
constexpr const char* kSetWeights =
    R"(What each row counts beside the others of its level where they cannot all be met.

Args:
  weights: (m,), or one for all rows, by default 1; 0 for a row that asks for nothing.
)";
constexpr const char* kDampingTask = R"(Coordinates at rest: e = 0 (m,), 0 = qdot.

Takes up what other tasks leave without pulling anywhere; advance asks for another velocity.

Args:
  name, robot: see PositionTask.
  coordinates: their names; none means all.
)";
constexpr const char* kUnit =
    "Of the error: 'm', 'rad', 'm and rad' where rows differ, '' where nobody said.";
constexpr const char* kCustomTask = R"(A task whose value a Python function measures.

Slower than the others by what Python takes. A copy of a controller shares the function.
`check_jacobian(task, robot)` compares the Jacobian with differences of the value.

Args:
  name, robot: see PositionTask.
  rows: m.
  measure: called with the robot; returns value (m,) and Jacobian (m, n), or these and drift (m,),
    which is Jdot qdot.
  unit: of the value, told in diagnostics: "m", say.

Raises:
  Error: rows below 1, or what came back has another shape.
)";
constexpr const char* kPoseTask = R"(The pose of a frame at a target pose: position and orientation.

e = [p - p_des; log(R R_des^T)] [m], [rad] (6,) in the axes of the reference; advance takes [m/s] and
[rad/s] (6,) in these axes. Turns are three times as fast [rad/s] as max_speed [m/s].

Args:
  name, robot, frame, reference: see PositionTask.
)";
constexpr const char* kRelativePoseTask =
    R"(The pose of a frame in another frame of the robot: a PoseTask whose reference moves too.

Args:
  name, robot, frame: see PositionTask.
  reference: frame of the robot.
)";
constexpr const char* kSetPose =
    R"(Sets the target; seen at the next update.

Args:
  position: (3,) [m].
  orientation: (3, 3) rotation or quaternion (4,) w x y z; None keeps the one that it has.
  velocity: (6,) [m/s], [rad/s] at which the target moves, fed forward until the next call that sets
    or moves it; None: at rest.
  acceleration: (6,) [m/s^2], [rad/s^2] of the target, fed forward so by accelerations and torques;
    None: 0.
)";
constexpr const char* kSetTurn =
    R"(Sets the target; seen at the next update.

Args:
  target: (3, 3) rotation or quaternion (4,) w x y z.
  velocity: (3,) [rad/s] at which the target turns, fed forward until the next call that sets or
    moves it; None: at rest.
  acceleration: (3,) [rad/s^2] of the target, fed forward so by accelerations and torques; None: 0.
)";
constexpr const char* kSetInterval =
    "The interval that the error shall be in: (m,) each, -inf or inf for no side.";
constexpr const char* kNoOrder =
    "tasks are not ordered by '<' in Python (a < b < c would lose a): use Stack([a, b, c])";
constexpr const char* kMaxLead =
    R"(Distance [task unit] that advance leads the target from the value at most, inf for any.

From a fifth of it on the target goes slower; a velocity that leads back is never held.
)";
constexpr const char* kMaxLeadOfPose =
    R"(Distance [m], and three times as many [rad], that advance leads the target from the frame at most.

inf for any. From a fifth of it on the target goes slower; a velocity that leads back is never held.
)";
constexpr const char* kValueTask =
    "A task whose value is a list of numbers: e = value - target, angles the short way round.";
constexpr const char* kSetTarget =
    R"(Sets the target; seen at the next update.

Args:
  target: (m,).
  velocity: (m,) [unit/s] at which the target moves, fed forward until the next call that sets or
    moves it; None: at rest. Who leads a target so sets it anew each tick.
  acceleration: (m,) [unit/s^2] of the target, fed forward so by accelerations and torques; None: 0.
)";
constexpr const char* kManipulabilityTask =
    R"(How far a frame is from a singularity: s (1,), the product of the singular values of its Jacobian.

set_target(s_min) with set_interval([0], [inf]) keeps it above s_min; a target that is out of reach
makes it as large as the levels above allow. Slower than others: differences of kinematics.

Args:
  name, robot, frame: see PositionTask.
  axes: (m, 3), m = 1 to 3 directions in the world that count.
  turns: rotations [rad] count beside positions [m].
)";
constexpr const char* kWorldPosition =
    "where the point is (3,) [m] in the world, at the last update";
constexpr const char* kWorldTarget = "where it shall be (3,) [m] in the world, for drawing";
constexpr const char* kPostureTask = R"(Coordinates at chosen positions [rad] or [m] (m,).

Args:
  name, robot: see PositionTask.
  coordinates: their names, in this order; none means all.
)";
constexpr const char* kPositionTask = R"(The origin of a frame at a target position [m] (m,).

Args:
  name: shown in plots and messages.
  robot: Robot whose present value it starts to hold.
  frame: name of a site, body, camera or geom.
  reference: frame in whose axes the position is measured, '' for the world.
  axes: (m, 3), m = 1 to 3 directions in the axes of the reference.

Raises:
  Error: a frame that does not exist, or that no coordinate moves against the reference.
)";
constexpr const char* kCenterOfMassTask =
    R"(The centre of mass of the whole tree at a target [m] (m,).

Args:
  name, robot, reference, axes: see PositionTask.
)";
constexpr const char* kOrientationTask = R"(The orientation of a frame at a target orientation.

e = log(R R_des^T) [rad] (3,) in the axes of the reference; advance takes an angular velocity
[rad/s] (3,) in these axes.

Args:
  name, robot, frame, reference: see PositionTask.
)";
constexpr const char* kAngleTask = R"(One angle [rad] (1,) of an axis that is fixed in a frame.

Args:
  name, robot, frame, reference: see PositionTask.
  kind: AngleKind.Elevation over the x-y plane, or AngleKind.Heading about z, of the reference.
  axis: (3,) in the frame.
)";
constexpr const char* kSwivelTask =
    R"(The turn [rad] (1,) of an arm's plane about the line from shoulder to wrist.

Zero where the elbow lies on the side of `direction`; fades where the arm is straight.

Args:
  name, robot: see PositionTask.
  shoulder, elbow, wrist, torso: names of frames; the torso carries the shoulder.
  direction: (3,) in the axes of the torso.
)";
constexpr const char* kGazeTask =
    R"(The camera looks at a point of the world; e = (yaw, pitch) [rad] (2,).

A positive error: the camera looks to the left of, above the target. advance moves the target
around the camera, [rad/s] (2,) to the left and upward.

Args:
  name, robot: see PositionTask.
  frame: a camera, or any other frame, which then looks along its x axis.
)";

// holds a Python function: copied and freed with the lock of the interpreter
struct PythonMeasure {
  PythonMeasure(py::function function, const Name& task)
      : task_("task '" + task + "': "),
        function_(new py::function(std::move(function)), [](py::function* held) {
          const py::gil_scoped_acquire lock;
          delete held;
        }) {}

  void operator()(const Robot& robot, VectorRef value, MatrixRef jacobian, VectorRef drift) const {
    const py::gil_scoped_acquire lock;
    const py::object self = py::cast(&robot, py::return_value_policy::reference);
    const py::object came = (*function_)(self);
    const bool pair = py::isinstance<py::tuple>(came) && (py::len(came) == 2 || py::len(came) == 3);
    require(
        pair,
        task_ + "a function that measures wants to return (value, jacobian) or these and drift");
    const auto parts = py::reinterpret_borrow<py::tuple>(came);
    const std::string m = std::to_string(value.size()), n = std::to_string(jacobian.cols());
    fill(parts[0], value, task_ + "value", "(" + m + ",)");
    const std::string what = task_ + "jacobian";
    const Matrix J = matrix_of(parts[1], what, "(" + m + ", " + n + ")");
    require(J.rows() == jacobian.rows() && J.cols() == jacobian.cols(),
            what + " wants shape (" + m + ", " + n + "), (" + std::to_string(J.rows()) + ", " +
                std::to_string(J.cols()) + ") came");
    jacobian = J;
    if (parts.size() == 3) fill(parts[2], drift, task_ + "drift", "(" + m + ",)");
  }

 private:
  static void fill(const py::object& from, VectorRef to, const std::string& what,
                   const std::string& shape) {
    const Vector values = vector_of(from, what, shape);
    require(values.size() == to.size(),
            what + " wants shape " + shape + ", (" + std::to_string(values.size()) + ",) came");
    to = values;
  }

  std::string task_;  // for errors
  std::shared_ptr<py::function> function_;
};

std::unique_ptr<CustomTask> custom_task(Name name, const Robot& robot, Index rows,
                                        py::function measure, std::string unit) {
  PythonMeasure named(std::move(measure), name);
  return std::make_unique<CustomTask>(std::move(name), robot, rows, std::move(named),
                                      std::move(unit));
}

void bind_task(py::module_& module) {
  const auto copy = py::return_value_policy::copy;
  py::class_<Task>(module, "Task", kTask)
      .def("update", &Task::update, py::arg("robot"), kUpdate)
      .def("hold", &Task::hold, py::arg("robot"), kHold)
      .def("advance", &Task::advance, py::arg("velocity"), py::arg("dt"), kAdvance)
      .def("set_interval", &Task::set_interval, py::arg("lower"), py::arg("upper"), kSetInterval)
      .def("set_max_speed", &Task::set_max_speed, py::arg("speed"), kSetMaxSpeed)
      .def_property_readonly("max_speed", &Task::max_speed, "[unit/s]")
      .def("set_max_acceleration", &Task::set_max_acceleration, py::arg("acceleration"),
           kSetMaxAcceleration)
      .def_property_readonly("max_acceleration", &Task::max_acceleration, "[unit/s^2]")
      .def("set_gain", py::overload_cast<double>(&Task::set_gain), py::arg("gain"), kSetGain)
      .def("set_gain", py::overload_cast<const ConstVectorRef&>(&Task::set_gain), py::arg("gain"),
           kSetGain)
      .def(
          "set_weights",
          [](Task& self, double weight) {
            self.set_weights(Vector::Constant(self.rows(), weight));
          },
          py::arg("weights"), kSetWeights)
      .def("set_weights", &Task::set_weights, py::arg("weights"), kSetWeights)
      .def_property_readonly("weights", &Task::weights, copy, "(m,)")
      .def_property_readonly("is_limit", &Task::is_limit,
                             "controllers brake before its interval as before joint limits")
      .def("state", &state<Task>, kState)
      .def("restore", &restore<Task>, py::arg("state"), kRestore)
      .def_property_readonly("name", &Task::name)
      .def_property_readonly("rows", &Task::rows, "m")
      .def_property_readonly("unit", &Task::unit, kUnit)
      .def_property_readonly("error", &Task::error, copy, "e (m,)")
      .def_property_readonly("jacobian", &Task::jacobian, copy, "J (m, n)")
      .def_property_readonly("drift", &Task::drift, copy, "(m,): Jdot qdot")
      .def_property_readonly("velocity_des", &Task::velocity_des, copy, "(m,)")
      .def_property_readonly("lower", &Task::lower, copy, "(m,), of the error")
      .def_property_readonly("upper", &Task::upper, copy, "(m,), of the error")
      .def("__lt__", [](const Task&, const py::object&) -> bool { throw py::type_error(kNoOrder); })
      .def("__gt__", [](const Task&, const py::object&) -> bool { throw py::type_error(kNoOrder); })
      .def("__repr__", [](const Task& self) {
        return "Task('" + self.name() + "', rows=" + std::to_string(self.rows()) + ")";
      });
  py::class_<ValueTask, Task>(module, "ValueTask", kValueTask)
      .def_property_readonly("value", &ValueTask::value, copy, "s (m,), at the last update")
      .def_property_readonly("target", &ValueTask::target, copy, "s_des (m,)")
      .def(
          "set_target",
          [](ValueTask& task, const ConstVectorRef& target, const std::optional<Vector>& velocity,
             const std::optional<Vector>& acceleration) {
            const Vector none = Vector::Zero(task.rows());
            task.set_reference(target, velocity.value_or(none), acceleration.value_or(none));
          },
          py::arg("target"), py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
          kSetTarget)
      .def_property("max_lead", &ValueTask::max_lead, &ValueTask::set_max_lead, kMaxLead)
      .def_property(
          "leash",
          [](const ValueTask& self) {
            warn_renamed("ValueTask.leash", "max_lead");
            return self.max_lead();
          },
          [](ValueTask& self, double max_lead) {
            warn_renamed("ValueTask.leash", "max_lead");
            self.set_max_lead(max_lead);
          },
          "Deprecated name of max_lead.");
}

void bind_coordinate_tasks(py::module_& module) {
  const py::arg name("name"), robot("robot");
  py::class_<DampingTask, Task>(module, "DampingTask", kDampingTask)
      .def(py::init<Name, const Robot&, const std::vector<Name>&>(), name, robot,
           py::arg("coordinates") = std::vector<Name>{});
  py::class_<CustomTask, ValueTask>(module, "CustomTask", kCustomTask)
      .def(py::init(&custom_task), name, robot, py::arg("rows"), py::arg("measure"),
           py::arg("unit") = "");
  py::class_<ManipulabilityTask, ValueTask>(module, "ManipulabilityTask", kManipulabilityTask)
      .def(py::init([](Name n, const Robot& r, const Name& frame, Matrix rows, bool turns) {
             return std::make_unique<ManipulabilityTask>(
                 std::move(n), r, frame, ManipulabilityTaskOptions{std::move(rows), turns});
           }),
           name, robot, py::arg("frame"), py::arg("axes") = ManipulabilityTaskOptions{}.axes,
           py::arg("turns") = ManipulabilityTaskOptions{}.turns);
  py::class_<PostureTask, ValueTask>(module, "PostureTask", kPostureTask)
      .def(py::init<Name, const Robot&, const std::vector<Name>&>(), name, robot,
           py::arg("coordinates") = std::vector<Name>{});
}

void bind_pose_tasks(py::module_& module) {
  const auto copy = py::return_value_policy::copy;
  const py::arg name("name"), robot("robot"), frame("frame");
  const auto pose = [](Name n, const Robot& r, const Name& f, Name ref) {
    return std::make_unique<PoseTask>(std::move(n), r, f, PoseTaskOptions{std::move(ref)});
  };
  const auto set_target =
      [](PoseTask& task, const ArrayLike& position, const OptionalArrayLike& orientation,
         const std::optional<Vector>& velocity, const std::optional<Vector>& acceleration) {
        const Vector none = Vector::Zero(task.rows());
        task.set_reference(
            point_of(position, task),
            orientation.is_none()
                ? task.target_orientation()
                : rotation_from(orientation, "orientation of task '" + task.name() + "'"),
            velocity.value_or(none), acceleration.value_or(none));
      };
  py::class_<PoseTask, Task>(module, "PoseTask", kPoseTask)
      .def(py::init(pose), name, robot, frame, py::arg("reference") = PoseTaskOptions{}.reference)
      .def_property_readonly("position", &PoseTask::position, copy, "p_RF (3,) [m]")
      .def_property_readonly("orientation", &PoseTask::orientation, copy, "R_RF (3, 3)")
      .def_property_readonly("target_position", &PoseTask::target_position, copy, "(3,) [m]")
      .def_property_readonly("target_orientation", &PoseTask::target_orientation, copy, "(3, 3)")
      .def_property_readonly("world_position", &PoseTask::world_position, kWorldPosition)
      .def_property_readonly("world_target", &PoseTask::world_target, kWorldTarget)
      .def_property_readonly("world_target_orientation", &PoseTask::world_target_orientation,
                             "how it shall be turned (3, 3) in the world, for drawing")
      .def_property("max_lead", &PoseTask::max_lead, &PoseTask::set_max_lead, kMaxLeadOfPose)
      .def("set_target", set_target, py::arg("position"), py::arg("orientation") = py::none(),
           py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(), kSetPose);
  py::class_<RelativePoseTask, PoseTask>(module, "RelativePoseTask", kRelativePoseTask)
      .def(py::init<Name, const Robot&, const Name&, const Name&>(), name, robot, frame,
           py::arg("reference"));
}

void bind_point_tasks(py::module_& module) {
  const PointTaskOptions defaults;
  const py::arg name("name"), robot("robot");
  const auto reference = py::arg("reference") = defaults.reference;
  const auto axes = py::arg("axes") = defaults.axes;
  const auto position = [](Name n, const Robot& r, const Name& frame, Name ref, Matrix rows) {
    return std::make_unique<PositionTask>(std::move(n), r, frame,
                                          PositionTaskOptions{std::move(ref), std::move(rows)});
  };
  const auto com = [](Name n, const Robot& r, Name ref, Matrix rows) {
    return std::make_unique<CenterOfMassTask>(
        std::move(n), r, CenterOfMassTaskOptions{std::move(ref), std::move(rows)});
  };
  const auto copy = py::return_value_policy::copy;
  py::class_<PointTask, ValueTask>(module, "PointTask", "A point of the robot at a target.")
      .def_property_readonly("position", &PointTask::position, copy, "p_RF (3,) [m]")
      .def_property_readonly("world_position", &PointTask::world_position, kWorldPosition)
      .def_property_readonly("world_target", &PointTask::world_target, kWorldTarget);
  py::class_<PositionTask, PointTask>(module, "PositionTask", kPositionTask)
      .def(py::init(position), name, robot, py::arg("frame"), reference, axes);
  py::class_<CenterOfMassTask, PointTask>(module, "CenterOfMassTask", kCenterOfMassTask)
      .def(py::init(com), name, robot, reference, axes);
}

void bind_rotation_tasks(py::module_& module) {
  const AngleTaskOptions defaults;
  const auto copy = py::return_value_policy::copy;
  const py::arg name("name"), robot("robot"), frame("frame");
  const auto reference = py::arg("reference") = defaults.reference;
  const auto orientation = [](Name n, const Robot& r, const Name& f, Name ref) {
    return std::make_unique<OrientationTask>(std::move(n), r, f,
                                             OrientationTaskOptions{std::move(ref)});
  };
  const auto angle = [](Name n, const Robot& r, const Name& f, AngleKind kind, const Vector3& axis,
                        Name ref) {
    return std::make_unique<AngleTask>(std::move(n), r, f,
                                       AngleTaskOptions{kind, axis, std::move(ref)});
  };
  py::class_<OrientationTask, Task>(module, "OrientationTask", kOrientationTask)
      .def(py::init(orientation), name, robot, frame, reference)
      .def_property_readonly("orientation", &OrientationTask::orientation, copy, "R_RF (3, 3)")
      .def_property_readonly("target", &OrientationTask::target, copy, "R_des (3, 3)")
      .def_property("max_lead", &OrientationTask::max_lead, &OrientationTask::set_max_lead,
                    kMaxLead)
      .def(
          "set_target",
          [](OrientationTask& task, const ArrayLike& target, const std::optional<Vector>& velocity,
             const std::optional<Vector>& acceleration) {
            const Vector none = Vector::Zero(task.rows());
            task.set_reference(rotation_from(target, "target of task '" + task.name() + "'"),
                               velocity.value_or(none), acceleration.value_or(none));
          },
          py::arg("target"), py::arg("velocity") = py::none(), py::arg("acceleration") = py::none(),
          kSetTurn);
  py::enum_<AngleKind>(module, "AngleKind", "Which angle an AngleTask measures.")
      .value("Elevation", AngleKind::Elevation)
      .value("Heading", AngleKind::Heading);
  py::class_<AngleTask, ValueTask>(module, "AngleTask", kAngleTask)
      .def(py::init(angle), name, robot, frame, py::arg("kind") = defaults.kind,
           py::arg("axis") = defaults.axis, reference);
}

void bind_arm_and_head_tasks(py::module_& module) {
  const auto copy = py::return_value_policy::copy;
  const py::arg name("name"), robot("robot");
  const auto swivel = [](Name n, const Robot& r, Name shoulder, Name elbow, Name wrist, Name torso,
                         const Vector3& direction) {
    return std::make_unique<SwivelTask>(
        std::move(n), r,
        SwivelTaskOptions{std::move(shoulder), std::move(elbow), std::move(wrist), std::move(torso),
                          direction});
  };
  py::class_<SwivelTask, ValueTask>(module, "SwivelTask", kSwivelTask)
      .def(py::init(swivel), name, robot, py::kw_only(), py::arg("shoulder"), py::arg("elbow"),
           py::arg("wrist"), py::arg("torso"),
           py::arg("direction") = SwivelTaskOptions{}.direction);
  py::class_<GazeTask, Task>(module, "GazeTask", kGazeTask)
      .def(py::init<Name, const Robot&, const Name&>(), name, robot, py::arg("frame"))
      .def_property_readonly("target", &GazeTask::target, copy, "p_WT (3,) [m]")
      .def(
          "set_target",
          [](GazeTask& task, const ArrayLike& target) { task.set_target(point_of(target, task)); },
          py::arg("target"), "Sets the target (3,) [m] in W, at rest; seen at the next update.");
}

}  // namespace

void bind_tasks(py::module_& module);

void bind_tasks(py::module_& module) {
  bind_task(module);
  bind_coordinate_tasks(module);
  bind_point_tasks(module);
  bind_pose_tasks(module);
  bind_rotation_tasks(module);
  bind_arm_and_head_tasks(module);
}
