// robot: any MJCF robot as the controller sees it. In Python a frame is named, never numbered.
#include <pybind11/eigen.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>

#include "annotated.hpp"
#include "hurcules/base/error.hpp"
#include "hurcules/robot/closures.hpp"
#include "hurcules/robot/left_out.hpp"
#include "hurcules/robot/plausibility.hpp"
#include "hurcules/robot/robot.hpp"
#include "mujoco_pointer.hpp"
#include "warn.hpp"

namespace py = pybind11;
using namespace hurcules;
using hurcules_bindings::held_model;
using hurcules_bindings::ModelObject;
using hurcules_bindings::warn;

namespace {

constexpr const char* kRobot =
    R"(Any MJCF robot as the controller sees it: coordinates, frames, Jacobians.

The controller moves n coordinates. A coordinate drives one joint or several together; the MJCF
names them by tuples `coordinate_NAME` of (joint, factor). Without such tuples every hinge, slide or ball
joint that has an actuator is a coordinate, and without actuators every one; joints
that an equality constraint of the model couples linearly (mimic joints) are one, and joints that close
loops follow (`followers`). All others are held.
A ball joint is three coordinates, NAME_rx, NAME_ry and NAME_rz: its rotation vector [rad], at most pi
long. Their velocities [rad/s] and efforts [N m] are MuJoCo's, about the axes of its body, and not the
derivative of the rotation vector: `add_step` goes from one to the other.
It has its own mjData: asking it never disturbs a simulation. One thread asks one Robot.
Warns (UserWarning) of joint ranges that look like radians read as degrees, or the other way round, and,
without `joints`, of joints that are held although a tendon drives them or no spring holds them; `left_out`
says all that are held, and which constraints and limits of tendons are not kept.
A frame is the name of a site, body, camera or geom, looked for in this order. W is the world.

Args:
  model: mujoco.MjModel (kept alive, not copied), or the path of an MJCF, MJB or URDF file (load_urdf).
  joints: names of the coordinates (joints, or tuples without their prefix), in this order; None: by
    the rule above.
  floating: the free joint at the root is six coordinates more, in front: its position [m] and its
    rotation vector [rad] in W; their velocities are those of MuJoCo's free joint. For a robot that
    stands by contacts, with stacks by torques.

Raises:
  Error: the file cannot be read, the tuples name no proper coordinates, or a robot without a free
    root shall float.
)";
constexpr const char* kCoordinate = "What the controller moves: one joint, or several together.";
constexpr const char* kDrivenJoint =
    "One joint of a coordinate: its position = factor * coordinate + offset.";
constexpr const char* kCoordinates = "list of Coordinate, n of them";
constexpr const char* kLower =
    "[rad] or [m], -inf when unlimited; of a ball joint the range of all of it";
constexpr const char* kUpper = "[rad] or [m], inf when unlimited";
constexpr const char* kMaxVelocity =
    "[rad/s] or [m/s], from the numeric velocity_limit_JOINT, else inf";
constexpr const char* kMaxEffort =
    "[N m] or [N], sum over its actuators by their ranges of force or, of plain motors, of "
    "control; "
    "inf without any";
constexpr const char* kStandOn =
    R"(The body that stays where it is when the coordinates move; by default the root of its tree.

A robot with folding legs stands on those that lie on the ground: its root, and all above, then
moves with the knees, and Jacobians, drifts and inertia count that.

Raises:
  Error: no such body, a body of another tree, or a tree without a free joint.
)";
constexpr const char* kSetQpos = "Sets the whole qpos (nq,), base and loose bodies too.";
constexpr const char* kSetConfiguration =
    "Sets the coordinates q (n,) [rad] or [m]; all else stays as it is. Warns outside the limits, "
    "and where a loop of the model cannot close.";
constexpr const char* kSetVelocity = "Sets the velocity (n,) [rad/s] or [m/s]; only drifts use it.";
constexpr const char* kSetKeyframe =
    "Takes the posture of a keyframe, or the model's initial one for ''. Warns outside the limits.";
constexpr const char* kAddStep =
    R"(q (n,) a step (n,) further [rad] or [m], a velocity times a time: q + step, but ball joints and a free root turn.

Raises:
  Error: q or step of another length.
)";
constexpr const char* kCoordinatesOf = "Coordinates (n,) out of a whole qpos (nq,).";
constexpr const char* kPosition = "p_WF (3,) [m]: origin of the frame in W.";
constexpr const char* kOrientation =
    "R_WF (3, 3); for a camera as MuJoCo has it: it looks along its -z.";
constexpr const char* kViewOrientation =
    "R_WF (3, 3) with x along the line of sight of a camera and z up; else like orientation.";
constexpr const char* kPositionJacobian =
    "(3, n) [m/rad]: velocity of the frame's origin in W by the coordinates.";
constexpr const char* kRotationJacobian =
    "(3, n): angular velocity of the frame in W by the coordinates.";
constexpr const char* kPositionDrift =
    "(3,) [m/s^2]: Jdot v, acceleration of the origin when the coordinates do not accelerate.";
constexpr const char* kRotationDrift =
    "(3,) [rad/s^2]: Jdot v, angular acceleration when the coordinates do not accelerate.";
constexpr const char* kCom = "(3,) [m]: centre of mass in W of the tree of the first coordinate.";
constexpr const char* kComJacobian = "(3, n) [m/rad]: velocity of the centre of mass in W.";
constexpr const char* kComDrift = "(3,) [m/s^2]: Jdot v of the centre of mass.";
constexpr const char* kInverseDynamics =
    R"(Torque (n,) [N m] or [N] that the coordinates take at an acceleration and the present velocity.

Inertia with armature, gravity, Coriolis, springs and dampers; without dry friction and contacts.

Args:
  acceleration: (n,) [rad/s^2] or [m/s^2].
)";
constexpr const char* kAngularMomentumJacobian =
    R"(A (3, n), L = A v: angular momentum of the robot about its centre of mass, in W [kg m^2/s].

Without armature; standing as `stand_on` says.)";
constexpr const char* kAngularMomentumDrift =
    "(3,) [N m] dA/dt v: how it changes when the coordinates do not accelerate.";
constexpr const char* kMassMatrix =
    "(n, n) [kg m^2]: joint-space inertia of the coordinates with armature, base held.";

constexpr const char* kFollowers =
    R"(list[str]: joints that follow the coordinates, as constraints of the model close loops with them.

Constraints are connect, weld, tendon and joint equalities, between parts of the robot, to the ground
and to other bodies. Such a joint has no spring and, unless `joints` named the coordinates, no
actuator; no root of a robot follows. It moves with the coordinates in poses,
Jacobians and dynamics, and its range is a limit of every stack.
)";
constexpr const char* kLeftOut =
    R"(str: joints of the robot that are held, and constraints that the coordinates do not keep.

A constraint is kept where joints follow the coordinates (`followers`) and the coordinates are no more
than its loop leaves free. '' where all are kept and none is held, or where the model says by tuples
what its coordinates are.
)";
constexpr const char* kUnkeptConstraints =
    R"(list[str]: equality constraints of the model that the coordinates do not keep.

By name; one without a name by what it ties: 'that of left_hand and right_hand'.
)";

using FrameJacobian = void (Robot::*)(Frame, MatrixRef) const;

template <FrameJacobian jacobian>
Matrix frame_jacobian(const Robot& robot, const std::string& frame) {
  Matrix J(3, robot.size());
  (robot.*jacobian)(robot.frame(frame), J);
  return J;
}

// a function of a frame, asked by the frame's name
template <typename Result>
auto by_name(Result (Robot::*question)(Frame) const) {
  return [question](const Robot& robot, const std::string& frame) {
    return (robot.*question)(robot.frame(frame));
  };
}

using Names = std::vector<std::string>;

using OptionalNames = hurcules_bindings::As<"collections.abc.Sequence[str] | None">;

Names names_of(const OptionalNames& joints) {
  if (joints.is_none()) return {};
  Names names;
  try {
    if (!py::isinstance<py::str>(joints)) names = joints.cast<Names>();
  } catch (const py::cast_error&) {  // said below
  }
  require(!names.empty(), "joints wants a list of names, at least one, or None; got " +
                              std::string(py::repr(joints)));
  return names;
}

std::unique_ptr<Robot> checked(ModelPtr model, const OptionalNames& joints, bool floating) {
  auto robot = std::make_unique<Robot>(std::move(model), names_of(joints), floating);
  warn(implausible_ranges(*robot));
  if (joints.is_none()) warn(held_joints(*robot));
  return robot;
}

std::unique_ptr<Robot> robot_of_object(const ModelObject& model, const OptionalNames& joints,
                                       bool floating) {
  if (!py::isinstance(model, py::module_::import("mujoco").attr("MjModel"))) {
    std::string text = "a mujoco.MjModel or the path of a model is wanted, a ";
    text += std::string(py::str(py::type::of(model).attr("__name__"))) + " came";
    if (py::hasattr(model, "compile")) text += "; its compile() gives one";  // an MjSpec
    if (py::hasattr(model, "ptr")) text += "; its ptr is one";               // of dm_control
    if (py::hasattr(model, "model") && py::hasattr(model.attr("model"), "ptr"))
      text += "; its model.ptr is one";  // a Physics of it
    if (py::hasattr(model, "to_xml_string"))
      text += "; mujoco.MjModel.from_xml_string(its to_xml_string(), its get_assets()) makes one";
    throw Error(text);
  }
  return checked(held_model(model), joints, floating);
}

std::unique_ptr<Robot> robot_of_path(const std::filesystem::path& model,
                                     const OptionalNames& joints, bool floating) {
  if (model.extension() != ".urdf") return checked(load_model(model.string()), joints, floating);
  // MuJoCo's own reading leaves out speeds, efforts and the frames of fixed links
  const auto load = py::module_::import("hurcules.urdf").attr("load_urdf");
  return checked(held_model(load(model.string())), joints, floating);
}

std::vector<std::string> followers(const Robot& robot) {
  std::vector<std::string> names;
  if (!robot.closures()) return names;
  for (const Closures::Follower& follower : robot.closures()->followers())
    if (names.empty() || names.back() != follower.joint) names.push_back(follower.joint);
  return names;
}

void bind_coordinate(py::module_& module) {
  py::class_<DrivenJoint>(module, "DrivenJoint", kDrivenJoint)
      .def_readonly("joint", &DrivenJoint::joint, "joint id of the model")
      .def_readonly("qpos", &DrivenJoint::qpos, "address in qpos, of a ball joint its quaternion's")
      .def_readonly("dof", &DrivenJoint::dof, "address in qvel")
      .def_readonly("actuator", &DrivenJoint::actuator, "actuator id, -1 for none")
      .def_readonly("factor", &DrivenJoint::factor)
      .def_readonly("offset", &DrivenJoint::offset, "[rad] or [m]")
      .def_readonly("part", &DrivenJoint::part,
                    "0 to 5 of a free joint, 3 to 5 of a ball joint, else -1");
  py::class_<Coordinate>(module, "Coordinate", kCoordinate)
      .def_readonly("name", &Coordinate::name)
      .def_readonly("unit", &Coordinate::unit, "'rad' or 'm'")
      .def_readonly("joints", &Coordinate::joints, "list of DrivenJoint; the first one is read")
      .def_readonly("lower", &Coordinate::lower, kLower)
      .def_readonly("upper", &Coordinate::upper, kUpper)
      .def_readonly("max_velocity", &Coordinate::max_velocity, kMaxVelocity)
      .def_readonly("max_effort", &Coordinate::max_effort, kMaxEffort)
      .def("__repr__", [](const Coordinate& self) { return "Coordinate('" + self.name + "')"; });
}

void bind_state(py::class_<Robot>& robot) {
  const auto copy = py::return_value_policy::copy;
  robot.def_property_readonly("size", &Robot::size, "n")
      .def_property_readonly("coordinates", &Robot::coordinates, copy, kCoordinates)
      .def_property_readonly("coordinate_names", &Robot::coordinate_names)
      .def("coordinate", &Robot::coordinate, py::arg("name"), "Index of a coordinate.")
      .def("set_qpos", &Robot::set_qpos, py::arg("qpos"), kSetQpos)
      .def(
          "set_configuration",
          [](Robot& self, const ConstVectorRef& q) {
            self.set_configuration(q);
            warn(outside_limits(self));
            warn(open_loops(self));
          },
          py::arg("q"), kSetConfiguration)
      .def("set_velocity", &Robot::set_velocity, py::arg("velocity"), kSetVelocity)
      .def("stand_on", py::overload_cast<const std::string&>(&Robot::stand_on), py::arg("body"),
           kStandOn)
      .def_property_readonly("floats", &Robot::floats,
                             "its root is free, no coordinate, and stands on nothing")
      .def_property_readonly("floating", &Robot::floating,
                             "its first six coordinates are those of the root")
      .def(
          "set_keyframe",
          [](Robot& self, const std::string& name) {
            self.set_keyframe(name);
            warn(outside_limits(self));
          },
          py::arg("name"), kSetKeyframe)
      .def_property_readonly("configuration", &Robot::configuration, copy, "q (n,) [rad] or [m]")
      .def_property_readonly("velocity", &Robot::velocity, copy, "(n,) [rad/s] or [m/s]")
      .def_property_readonly("qpos", &Robot::qpos, copy, "(nq,)")
      .def(
          "add_step",
          [](const Robot& self, const ConstVectorRef& q, const ConstVectorRef& step) {
            require(q.size() == self.size() && step.size() == self.size(),
                    "add_step wants q and step of " + std::to_string(self.size()) + " values, " +
                        std::to_string(q.size()) + " and " + std::to_string(step.size()) + " came");
            Vector next = q;
            add_step(self.rotations(), step, next);
            return next;
          },
          py::arg("q"), py::arg("step"), kAddStep)
      .def(
          "coordinates_of",
          [](const Robot& self, const ConstVectorRef& qpos) {
            Vector q(self.size());
            self.coordinates_of(qpos, q);
            return q;
          },
          py::arg("qpos"), kCoordinatesOf)
      .def(
          "velocities_of",
          [](const Robot& self, const ConstVectorRef& qvel) {
            Vector velocity(self.size());
            self.velocities_of(qvel, velocity);
            return velocity;
          },
          py::arg("qvel"), "Velocities of the coordinates (n,) out of a whole qvel (nv,).");
}

void bind_kinematics(py::class_<Robot>& robot) {
  const py::arg frame("frame");
  robot.def_property_readonly("left_out", &left_out, kLeftOut);
  robot.def_property_readonly("unkept_constraints", &unkept_constraints, kUnkeptConstraints);
  robot.def_property_readonly("followers", &followers, kFollowers);
  robot.def("position", by_name(&Robot::position), frame, kPosition)
      .def("orientation", by_name(&Robot::orientation), frame, kOrientation)
      .def("view_orientation", by_name(&Robot::view_orientation), frame, kViewOrientation)
      .def("position_jacobian", &frame_jacobian<&Robot::position_jacobian>, frame,
           kPositionJacobian)
      .def("rotation_jacobian", &frame_jacobian<&Robot::rotation_jacobian>, frame,
           kRotationJacobian)
      .def("position_drift", by_name(&Robot::position_drift), frame, kPositionDrift)
      .def("rotation_drift", by_name(&Robot::rotation_drift), frame, kRotationDrift)
      .def_property_readonly("com", &Robot::com, kCom)
      .def("com_drift", &Robot::com_drift, kComDrift)
      .def(
          "com_jacobian",
          [](const Robot& self) {
            Matrix J(3, self.size());
            self.com_jacobian(J);
            return J;
          },
          kComJacobian)
      .def(
          "angular_momentum_jacobian",
          [](const Robot& self) {
            Matrix A(3, self.size());
            self.angular_momentum_jacobian(A);
            return A;
          },
          kAngularMomentumJacobian)
      .def("angular_momentum_drift", &Robot::angular_momentum_drift, kAngularMomentumDrift)
      .def(
          "mass_matrix",
          [](const Robot& self) {
            Matrix M(self.size(), self.size());
            self.mass_matrix(M);
            return M;
          },
          kMassMatrix)
      .def(
          "inverse_dynamics",
          [](const Robot& self, const ConstVectorRef& acceleration) {
            require(acceleration.size() == self.size() && acceleration.allFinite(),
                    "inverse_dynamics wants " + std::to_string(self.size()) +
                        " finite accelerations, got " + std::to_string(acceleration.size()) +
                        (acceleration.allFinite() ? "" : ", not all finite"));
            Vector torque(self.size());
            self.inverse_dynamics(acceleration, torque);
            return torque;
          },
          py::arg("acceleration"), kInverseDynamics);
}

}  // namespace

void bind_robot(py::module_& module);

void bind_robot(py::module_& module) {
  bind_coordinate(module);
  py::class_<Robot> robot(module, "Robot", kRobot);
  robot
      .def(py::init(&robot_of_path), py::arg("model"), py::arg("joints") = py::none(),
           py::arg("floating") = false)
      .def(py::init(&robot_of_object), py::arg("model"), py::arg("joints") = py::none(),
           py::arg("floating") = false, py::keep_alive<1, 2>())
      .def("__repr__", [](const Robot& self) {
        return "Robot(" + std::to_string(self.size()) + " coordinates)";
      });
  bind_state(robot);
  bind_kinematics(robot);
}
