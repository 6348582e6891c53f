// control: the whole-body controller and its channels.
#include <mujoco/mujoco.h>
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "annotated.hpp"
#include "arrays.hpp"
#include "bind_stack.hpp"
#include "command.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/base/values.hpp"
#include "hurcules/control/whole_body_controller.hpp"
#include "hurcules/robot/object_names.hpp"
#include "hurcules/robot/trees.hpp"
#include "in_use.hpp"
#include "solver_levels.hpp"
#include "state.hpp"

namespace py = pybind11;
using namespace pybind11::literals;
using namespace hurcules;
using namespace hurcules_bindings;

void bind_whole_body(py::module_& module);

namespace {

constexpr const char* kTwistChannel =
    R"(A channel that leads the target of a task by a velocity; zero holds it.

Args:
  task: Task with a target.
  scale: full scale, one number or one a row [m/s] or [rad/s]; a command is held to it.
)";
constexpr const char* kDeltaChannel =
    R"(A channel that puts the target of a task at its measured value plus an increment.

It acts once a call of `step`; zero leaves the target where it is.

Args:
  task: Task with a target.
  scale: full scale [m] or [rad].
)";
constexpr const char* kTargetChannel = R"(A channel that sets the target of a task.

It acts once a call of `step`. An orientation is given as a rotation vector.

Args:
  task: Task whose target numbers say; of a GazeTask they are the point.
  scale: largest magnitude [m] or [rad].
)";
constexpr const char* kForceChannel = R"(A channel that sets the force that a ForceTask keeps.

Args:
  task: ForceTask.
  scale: largest magnitude [N].
)";
constexpr const char* kDriveChannel = R"(A channel that drives the tracks: speed and yaw rate.

Args:
  speed: full scale [m/s].
  yaw_rate: full scale [rad/s].
)";
constexpr const char* kJointChannel =
    R"(A channel that moves a joint of no coordinate (a gripper, a bed) by a velocity.

Args:
  joint: name of a joint with an actuator.
  scale: full scale [rad/s] or [m/s].
)";
constexpr const char* kJointsChannel =
    R"(A channel that moves joints one by one, by velocities, while no stack rules (`move_joints`).

Velocities change within the acceleration limit, places stay within the ranges of the joints. While a
stack rules it moves nothing.

Args:
  joints: names of joints with an actuator.
  scale: full scale [rad/s] or [m/s].
)";
constexpr const char* kControlChannel =
    R"(A channel that leads the control of an actuator that no servo commands: a gripper on tendons.

It starts where a position servo holds what it moves, at 0 with others, and stays within the
actuator's ctrlrange. Without physics it moves nothing.

Args:
  actuator: its name.
  scale: full scale [1/s] of its control.
)";
constexpr const char* kController =
    R"(The controller of a whole robot: named commands in, controls of the actuators out.

Each tick: the command moves the targets; the tasks are measured at the plan, a robot that stands at
the reference; the hierarchy is solved; the reference follows; the servos follow the reference.
Position, velocity and acceleration limits of all coordinates come before every level.
Targets that were set before stay, here and when a simulation is made of it; all others go to where
the robot is. A reset of the simulation puts all of them where it starts.

Args:
  robot: Robot where it starts; any MJCF robot.
  levels: Stack, or a sequence of Task, StackLevel and lists of tasks, in decreasing priority.
  channels: by name what a command moves: Twist, Delta, Target, ForceReference, Drive, JointRate,
    JointRates, ControlRate.
  stacks: by name further stacks for `use`, each levels as above or (levels, control); the first one
    rules at the start if no `levels` are given.
  control: by what stacks rule that do not say it: "velocity", "acceleration", or "torque": then the accelerations are
    those of the robot as it is sensed, and its drives get what inverse dynamics says. Contacts
    (ContactTask) carry a robot that floats.
  dt: control period [s]; by default the time step of the model.
  base: "held" (the plan stands where the robot stood at the start) or "sensed" (where it stands
    now: targets in the world stay where they are while the robot drives).
  support: body that stands on the ground; by default the robot's own, see Robot.stand_on.
  servo: by joint the inertia that it turns [kg m^2] and its bandwidth [rad/s], of the joints
    that are left out as the model says (servo_table), else reckoned from it. A driven wheel may roll
    the robot.
  feed_forward: servos are told the torques that the model says.
  decoupled: what the servos ask for is given by the mass matrix, wants feed_forward; None: where
    those of all coordinates are reckoned, and no wheel is driven.
  torque_scaling: the motion slows down where a motor would be asked for more than its peak. False
    where drives with servos of their own follow q_des: their sag would be taken for a load.
  drive: DriveOptions of a robot on tracks; needed for a Drive channel.
  belts: names of the left and right joint of the driven belts.
  velocity: VelocityControllerOptions; its dt is not read.
  acceleration: AccelerationControllerOptions; its dt is not read.
  torque: the same for stacks by torques; by default with max_acceleration=200.

Raises:
  Error: no level, an unknown name, a joint that cannot be servoed; the text says which.
)";
constexpr const char* kReset =
    R"(Starts anew at rest: the first stack rules, all targets go to where the robot is.

Args:
  qpos: (nq,) of the whole model; None: where the plan is.

Raises:
  Error: another shape, or numbers that are not finite.
)";
constexpr const char* kTick =
    R"(One tick of a loop of your own: a robot on the bench, or a simulator beside this one.

The same bits as in `Simulation`, which does more: tracks, brakes, sensors, monitors.

Args:
  qpos: (nq,) as sensed; the start, where it is another one than the robot's, goes to `reset`.
  qvel: (nv,) as sensed.
  command: SI values by the name of their channel (the others hold), or (k,); each is held to
    command_scale. None: every target holds.
  sensors: (nsensordata,) what force tasks read, see sense; None where none does.
  first: False where the command is that of the last tick, so that what it sets once (Delta, Target,
    ForceReference) is not set again.

Returns:
  (nu,) the controls of the model's actuators; 0 for one that moves no joint. q_des, qd_des and torque
  are what a drive with a servo of its own wants.

Raises:
  Error: another shape, numbers that are not finite, an unknown channel, no sensors where a force
    task reads one; in the first tick a robot more than 0.05 rad from where the plan starts, later a
    joint that is elsewhere than a tick ago by more than 0.05 rad (or m) and 100 rad/s: a wrong
    reading, or the robot was moved or not heard of for long (`reset`). Nothing has changed then.
)";
constexpr const char* kUse = R"(Lets another stack rule from the next tick on.

The velocity goes on within the acceleration limit, the servos keep their integrals. After joints
were moved one by one, all targets come to where the plan is.

Args:
  stack: its name.

Raises:
  Error: an unknown name, with those that exist.
)";
constexpr const char* kMove =
    R"(Where a joint shall be from now on; no stack rules until `use`.

Joints that a stack left in motion stop within the acceleration limit.

Args:
  joint: name of a joint with an actuator.
  position: [rad] or [m]; beyond the joint's range it squeezes, as a finger does.
  velocity: [rad/s] or [m/s] there, fed forward. No bound of how fast it goes: to a place that is far
    off it goes as fast as its motor can.

Raises:
  Error: no such joint, or numbers that are not finite.
)";
constexpr const char* kStandOn = R"(The plan stands on another body, where it is now.

What the plan takes is told anew, the integrals of the servos take over the difference: no torque
jumps (of decoupled servos it may). It holds until a reset.

Args:
  body: of the robot, with a free root.

Raises:
  Error: no such body.
)";
constexpr const char* kMoveAll = R"(The same for all joints with a servo, in the order of `joints`.

Args:
  positions: (m,) [rad] or [m].
  velocities: (m,) [rad/s] or [m/s].
)";
constexpr const char* kSense = R"(What a force task reads, each tick.

Args:
  task: ForceTask of the controller.
  source: SpringForce, or the name of a sensor of the model.
  row: of the sensor; None: of a force sensor the part along the task's axis, however hand and axis
    are turned, else row 0.
  sign: of the sensor: its reading times this is what the robot exerts along the task's axis. Without
    a row 1 is right for a force sensor on the body of the tool.

Raises:
  Error: an unknown sensor, a task that is in no stack of the controller, or a sign of 0.
)";

struct ChannelSpec {
  ChannelKind kind;
  py::object task = py::none();
  Vector scale;
  std::vector<std::string> names = {};
};

Vector scale_of(const py::object& scale) {
  if (py::isinstance<py::float_>(scale) || py::isinstance<py::int_>(scale)) {
    return Vector::Constant(1, scale.cast<double>());
  }
  return vector_of(scale, "the scale of a channel", "a number or (k,)");
}

template <ChannelKind kind>
ChannelSpec task_channel(const TaskObject& task, const ScaleObject& scale) {
  require(py::isinstance<Task>(task),
          "a channel wants a task, a " + std::string(py::str(py::type::of(task).attr("__name__"))) +
              " came");
  return {kind, task, scale_of(scale)};
}

Channel channel_of(const std::string& name, const ChannelSpec& spec) {
  if (spec.kind == ChannelKind::Drive) return Channel::drive(name, spec.scale[0], spec.scale[1]);
  if (spec.kind == ChannelKind::Joint) return Channel::joint(name, spec.names[0], spec.scale[0]);
  if (spec.kind == ChannelKind::Joints) return Channel::joints(name, spec.names, spec.scale[0]);
  if (spec.kind == ChannelKind::Control)
    return Channel::control(name, spec.names[0], spec.scale[0]);
  return {name, spec.kind, *spec.task.cast<Task*>(), spec.scale};
}

ControlOrder control_of(const std::string& name) {
  if (name == "velocity") return ControlOrder::Velocity;
  if (name == "acceleration") return ControlOrder::Acceleration;
  if (name == "torque") return ControlOrder::Torque;
  throw Error(unknown_name("control", name, {"acceleration", "torque", "velocity"}));
}

BaseSource base_of(const std::string& name) {
  if (name == "held") return BaseSource::Held;
  if (name == "sensed") return BaseSource::Sensed;
  throw Error(unknown_name("base", name, {"held", "sensed"}));
}

// the controller, and the Python objects that its tasks live in
struct Held {
  std::vector<py::object> kept;
  std::unique_ptr<WholeBodyController> controller;
};

std::shared_ptr<WholeBodyController> make(
    const Robot& robot, const std::optional<AnyObject>& levels, const py::dict& channels,
    const py::dict& stacks, const std::string& control, std::optional<double> dt,
    const std::string& base, const std::string& support,
    const std::map<std::string, std::pair<double, double>>& servo, bool feed_forward,
    std::optional<bool> decoupled, bool torque_scaling, const std::optional<DriveOptions>& drive,
    const std::pair<std::string, std::string>& belts,
    const std::optional<VelocityControllerOptions>& velocity,
    const std::optional<AccelerationControllerOptions>& acceleration,
    const std::optional<AccelerationControllerOptions>& torque) {
  auto held = std::make_shared<Held>();
  std::vector<NamedStack> all;
  const auto add = [&](const std::string& name, const py::object& source, ControlOrder how) {
    HeldStack stack = stack_of(source);
    all.push_back({name, stack.stack, how});
    for (py::object& object : stack.kept) held->kept.push_back(std::move(object));
  };
  const ControlOrder usual = control_of(control);
  if (levels && !levels->is_none()) add("stack", *levels, usual);
  for (const auto& [name, source] : stacks) {
    const auto object = py::reinterpret_borrow<py::object>(source);
    if (py::isinstance<py::tuple>(object) && py::len(object) == 2 &&
        py::isinstance<py::str>(object[py::int_(1)])) {
      add(name.cast<std::string>(), object[py::int_(0)],
          control_of(object[py::int_(1)].cast<std::string>()));
    } else {
      add(name.cast<std::string>(), object, usual);
    }
  }
  std::vector<Channel> made;
  for (const auto& [name, spec] : channels) {  // in the order in which they were written
    const auto text = name.cast<std::string>();
    require(py::isinstance<ChannelSpec>(spec),
            "channel '" + text +
                "' wants Twist, Delta, Target, ForceReference, Drive, JointRate, JointRates or " +
                "ControlRate");
    made.push_back(channel_of(text, spec.cast<const ChannelSpec&>()));
  }
  WholeBodyControllerOptions options;
  if (velocity) options.velocity = *velocity;
  if (acceleration) options.acceleration = *acceleration;
  if (torque) options.torque = *torque;
  options.dt = dt.value_or(robot.timestep());
  options.base = base_of(base);
  options.support = support;
  options.feed_forward = feed_forward;
  options.decoupled = decoupled;
  options.torque_scaling = torque_scaling;
  for (const auto& [joint, row] : servo) options.servo.push_back({joint, row.first, row.second});
  if (drive) options.drive = TrackDriveOptions{belts.first, belts.second, *drive};
  held->controller = std::make_unique<WholeBodyController>(robot, std::move(all), std::move(made),
                                                           std::move(options));
  return {held, held->controller.get()};
}

bool reads_effort(int type) {
  switch (type) {
    case mjSENS_FORCE:
    case mjSENS_TORQUE:
    case mjSENS_TOUCH:
    case mjSENS_CONTACT:
    case mjSENS_TACTILE:
    case mjSENS_ACTUATORFRC:
    case mjSENS_JOINTACTFRC:
    case mjSENS_TENDONACTFRC:
    case mjSENS_JOINTLIMITFRC:
    case mjSENS_TENDONLIMITFRC:
    case mjSENS_USER:
    case mjSENS_PLUGIN:
      return true;
    default:
      return false;
  }
}

void sense(WholeBodyController& self, ForceTask& task, const AnyObject& source,
           std::optional<int> asked, std::optional<double> told) {
  if (py::isinstance<SpringForce>(source)) {
    return self.sense(task, std::make_unique<SpringForce>(source.cast<const SpringForce&>()));
  }
  const auto name = source.cast<std::string>();
  const mjModel* const m = self.plan().model().get();
  const int sensor = find_object(*m, mjOBJ_SENSOR, name);
  require(reads_effort(m->sensor_type[sensor]),
          "sensor '" + name +
              "' reads no force: a force task wants one of MuJoCo's force, touch, " +
              "torque, contact, actuatorfrc, jointactuatorfrc, tendonactuatorfrc, user or plugin");
  // a touch is never below 0, whichever way it is pressed
  const bool touch = m->sensor_type[sensor] == mjSENS_TOUCH;
  const double sign = told.value_or(touch && task.force_des() < 0.0 ? -1.0 : 1.0);
  if (!asked && m->sensor_type[sensor] == mjSENS_FORCE) {
    const Frame site{mjOBJ_SITE, m->sensor_objid[sensor]};
    return self.sense(task, m->sensor_adr[sensor], site, sign);
  }
  const int row = asked.value_or(0);
  require(row >= 0 && row < m->sensor_dim[sensor],
          "sensor '" + name + "' has " + std::to_string(m->sensor_dim[sensor]) + " rows, row " +
              std::to_string(row) + " was asked for");
  self.sense(task, m->sensor_adr[sensor] + row, sign);
}

Vector tick(WholeBodyController& self, const ArrayLike& qpos, const ArrayLike& qvel,
            const CommandObject& command, const OptionalArrayLike& sensors, bool first) {
  const std::optional<Vector> given = command_of(self, command);
  const Vector q = vector_of(qpos, "qpos", "(nq,)"), v = vector_of(qvel, "qvel", "(nv,)");
  const mjModel* const m = self.plan().model().get();
  Vector readings;
  if (!sensors.is_none()) {
    readings = vector_of(sensors, "sensors", "(nsensordata,)");
    require_values("sensordata", readings, m->nsensordata);
  }
  Vector ctrl = Vector::Zero(m->nu);
  const InUse in_use("WholeBodyController", &self);
  const py::gil_scoped_release release;
  self.tick(q, v, given ? &*given : nullptr, first, ctrl,
            sensors.is_none() ? nullptr : readings.data());
  return ctrl;
}

void reset(WholeBodyController& self, const OptionalArrayLike& qpos) {
  const InUse in_use("WholeBodyController", &self);
  self.reset(qpos.is_none() ? self.plan().qpos() : vector_of(qpos, "qpos", "(nq,)"));
}

void bind_channels(py::module_& module) {
  py::class_<ChannelSpec>(module, "Channel", "What a command moves; see Twist and the others.")
      .def_property_readonly("scale", [](const ChannelSpec& self) { return self.scale; })
      .def_property_readonly("task", [](const ChannelSpec& self) { return self.task; });
  const double none = std::numeric_limits<double>::infinity();
  module.def("Twist", &task_channel<ChannelKind::Twist>, "task"_a, "scale"_a, kTwistChannel);
  module.def("Delta", &task_channel<ChannelKind::Delta>, "task"_a, "scale"_a, kDeltaChannel);
  module.def("Target", &task_channel<ChannelKind::Target>, "task"_a, "scale"_a = none,
             kTargetChannel);
  module.def("ForceReference", &task_channel<ChannelKind::Force>, "task"_a, "scale"_a,
             kForceChannel);
  module.def(
      "Drive",
      [](double speed, double yaw_rate) {
        return ChannelSpec{ChannelKind::Drive, py::none(), Eigen::Vector2d(speed, yaw_rate)};
      },
      "speed"_a, "yaw_rate"_a, kDriveChannel);
  module.def(
      "JointRate",
      [](const std::string& joint, double scale) {
        return ChannelSpec{ChannelKind::Joint, py::none(), Vector::Constant(1, scale), {joint}};
      },
      "joint"_a, "scale"_a, kJointChannel);
  module.def(
      "JointRates",
      [](const std::vector<std::string>& joints, double scale) {
        return ChannelSpec{ChannelKind::Joints, py::none(), Vector::Constant(1, scale), joints};
      },
      "joints"_a, "scale"_a = std::numeric_limits<double>::infinity(), kJointsChannel);
  module.def(
      "ControlRate",
      [](const std::string& actuator, double scale) {
        return ChannelSpec{
            ChannelKind::Control, py::none(), Vector::Constant(1, scale), {actuator}};
      },
      "actuator"_a, "scale"_a, kControlChannel);
}

std::vector<std::pair<std::string, Index>> sizes(const WholeBodyController& self) {
  std::vector<std::pair<std::string, Index>> all;
  for (const Channel& channel : self.channels()) all.emplace_back(channel.name(), channel.size());
  return all;
}

std::vector<std::string> unfed_forces(const WholeBodyController& self) {
  std::vector<std::string> names;
  for (const Task* const task : self.tasks()) {
    const auto* const force = dynamic_cast<const ForceTask*>(task);
    if (force && !force->is_told() && !self.feeds(*force)) names.push_back(task->name());
  }
  return names;
}

// the frames that hold their place in the plan while they move in the world
std::vector<std::tuple<std::string, std::string, bool>> unseen_references(
    const WholeBodyController& self) {
  const Robot& plan = self.plan();
  const mjModel& m = *plan.model();
  const bool sees_joints = self.options().base == BaseSource::Sensed || self.by_torques();
  std::vector<std::tuple<std::string, std::string, bool>> unseen;
  for (const Task* const task : self.tasks()) {
    const std::optional<Frame> frame = task->reference_frame();
    if (!frame || plan.moves(*frame)) continue;
    const int body = body_of(m, *frame);
    if (!may_move(m, body) || in_own_tree(plan, body)) continue;
    const bool mocap = m.body_mocapid[m.body_rootid[body]] >= 0;
    if (mocap || !sees_joints)
      unseen.emplace_back(task->name(), mj_id2name(&m, frame->type, frame->id), mocap);
  }
  return unseen;
}

}  // namespace

void bind_whole_body(py::module_& module) {
  bind_channels(module);
  py::class_<WholeBodyController, std::shared_ptr<WholeBodyController>> controller(
      module, "WholeBodyController", kController);
  controller.def(py::init(&make), "robot"_a, "levels"_a = py::none(), "channels"_a = py::dict(),
                 py::kw_only(), "stacks"_a = py::dict(), "control"_a = "velocity",
                 "dt"_a = py::none(), "base"_a = "held", "support"_a = "",
                 "servo"_a = std::map<std::string, std::pair<double, double>>{},
                 "feed_forward"_a = true, "decoupled"_a = py::none(), "torque_scaling"_a = true,
                 "drive"_a = py::none(),
                 "belts"_a = std::pair<std::string, std::string>{"L_lower_belt", "R_lower_belt"},
                 "velocity"_a = py::none(), "acceleration"_a = py::none(), "torque"_a = py::none());
  const auto solution = [](const WholeBodyController& self) { return self.law().solution(); };
  const auto active = [](const WholeBodyController& self) -> std::optional<std::string> {
    if (self.moves_joints()) return std::nullopt;
    return self.stacks()[self.active()].name;
  };
  const auto tasks = [](const WholeBodyController& self) {
    std::vector<Task*> all;
    for (const StackLevel& level : self.law().stack().levels())
      all.insert(all.end(), level.tasks.begin(), level.tasks.end());
    return all;
  };
  const auto names = [](const WholeBodyController& self) {
    std::vector<std::string> all;
    for (const NamedStack& stack : self.stacks()) all.push_back(stack.name);
    return all;
  };
  const auto drive = [](WholeBodyController& self) -> DriveController* {
    return self.drive() ? &self.drive()->controller() : nullptr;
  };
  const auto joints = [](const WholeBodyController& self) { return self.servo().names(); };
  using Controller = WholeBodyController;
  void (Controller::* const move_one)(const std::string&, double, double) = &Controller::move;
  void (Controller::* const move_all)(const Vector&, const Vector&) = &Controller::move;
  const auto places = [](const WholeBodyController& self) { return self.servo().position(); };
  const auto torque = [](const WholeBodyController& self) { return self.servo().torque(); };
  const auto demand = [](const WholeBodyController& self) { return self.servo().demand(); };
  const auto error = [](const WholeBodyController& self) { return self.servo().error().position; };
  const auto copy = py::return_value_policy::copy;
  controller
      .def("tick", &tick, "qpos"_a, "qvel"_a, "command"_a = py::none(), py::kw_only(),
           "sensors"_a = py::none(), "first"_a = true, kTick)
      .def("reset", &reset, "qpos"_a = py::none(), kReset)
      .def("use", waiting(&Controller::use), "stack"_a, kUse)
      .def("move", waiting(move_one), "joint"_a, "position"_a, "velocity"_a = 0.0, kMove)
      .def("move_all", waiting(move_all), "positions"_a, "velocities"_a, kMoveAll)
      .def("move_joints", waiting(&Controller::move_joints),
           "No stack rules until `use`: joints stop within the acceleration limit, and stay; "
           "JointRates moves them.")
      .def("stand_on", waiting(&Controller::stand_on), "body"_a, kStandOn)
      .def_property_readonly("unfed_forces", &unfed_forces,
                             "Names of the force tasks that no `sense` feeds and that were never "
                             "told a force.")
      .def_property_readonly("unseen_references", &unseen_references,
                             "(task, frame, whether by mocap) where a task is measured in a frame "
                             "that may move and whose motion the plan does not see")
      .def("hold_targets", waiting(&Controller::hold_targets),
           "The targets of all tasks come to where the plan is.")
      .def("task", &WholeBodyController::task, "name"_a,
           py::return_value_policy::reference_internal,
           "A task of its stacks, by name. Raises Error with the names that exist.")
      .def("sense", waiting(&sense), "task"_a, "source"_a, "row"_a = py::none(),
           "sign"_a = py::none(), py::keep_alive<1, 2>(), kSense)
      .def("state", waiting(&state<const Controller>), kState)
      .def("restore", waiting(&restore<Controller>), "state"_a, kRestore)
      .def(
          "diagnostics",
          [](const WholeBodyController& self) {
            InUse::wait(&self);
            return self.diagnostics();
          },
          "What each level falls short of and why, targets that gave way to torques too: list of "
          "LevelDiagnostics, decreasing priority.")
      .def(
          "contact_force",
          [](const WholeBodyController& self, const std::string& contact) {
            return self.law().contact_force(self.task(contact));
          },
          "contact"_a,
          "F (3,) [N] in W on the robot at a ContactTask of the stack that rules, as it was wanted "
          "last.")
      .def_property_readonly("dt", &WholeBodyController::dt, "[s]")
      .def_property_readonly("plan", &WholeBodyController::plan,
                             py::return_value_policy::reference_internal,
                             "Robot at the reference; look at it, but do not move it")
      .def_property_readonly("channels", &sizes, "list of (name, number of values)")
      .def_property_readonly("command_names", &WholeBodyController::command_names, copy,
                             "(k,) of all values of all channels")
      .def_property_readonly("command_scale", &WholeBodyController::scale, copy, "(k,) SI")
      .def_property_readonly(
          "command", &WholeBodyController::command, copy,
          "(k,) what it did in the last tick, as held to scale: 0 for nothing, of Target "
          "and ForceReference NaN; given again tick by tick it gives the same bits")
      .def_property_readonly("stacks", names, "names of the stacks")
      .def_property_readonly("active", active, "the stack that rules; None while joints are moved")
      .def_property_readonly("tasks", tasks, py::return_value_policy::reference_internal,
                             "the tasks of the stack that rules, in decreasing priority")
      .def_property_readonly("joints", joints, "(m,) joints with a servo")
      .def_property_readonly("joint_places", places, "(m,) [rad] or [m] where the servos hold them")
      .def_property_readonly("joint_error", error, "(m,) [rad] or [m] place minus sensed")
      .def_property_readonly("torque", torque, "(m,) [N m] or [N] of the servos")
      .def_property_readonly("demand", demand, "(m,) the same before saturation")
      .def_property_readonly("q_des", &WholeBodyController::q_des, copy, "(n,) [rad] reference")
      .def_property_readonly("qd_des", &WholeBodyController::qd_des, copy, "(n,) [rad/s]")
      .def_property_readonly("scaled", &WholeBodyController::scaled,
                             "the last tick was slowed down by what the motors can hold")
      .def_property_readonly(
          "active_limits",
          [](const WholeBodyController& self) { return self.law().active_limits(); },
          "(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one")
      .def_property_readonly("solution", solution, "ControlSolution, of the last tick")
      .def_property_readonly("drive", drive, py::return_value_policy::reference_internal,
                             "DriveController of the tracks, None without")
      .def("__repr__", [](const WholeBodyController& self) {
        std::string text = "WholeBodyController(" + self.law().stack().text() + "; channels:";
        for (const Channel& channel : self.channels()) text += " " + channel.name();
        return text + ")";
      });
}
