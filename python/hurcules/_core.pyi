"""Compiled part of hurcules; use it through the package hurcules.

Written by python/bindings/stubs.py out of the compiled module; not to be edited.
"""

import collections.abc
import os
from typing import Any, ClassVar, overload, type_check_only

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

build: dict[str, str | bool]  # version, mujoco, eigen, simd, compiler, build_type, flags, asserts

class Error(ValueError):
    """Bad input: what was wanted, what came, and where."""

@type_check_only
class _Enum:
    """What pybind11 gives each enumeration."""

    def __init__(self, value: int) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def value(self) -> int: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __int__(self) -> int: ...
    def __index__(self) -> int: ...

class Level:
    """A level of bounded rows: lower <= A x <= upper.

    Args:
      A: (m, n) float64.
      lower, upper: (m,) float64. +-inf or a magnitude >= 1e20 means no side; lower == upper is an equality.
      rho: regularisation coefficient >= 0 (thesis: 0.1). A level of limits wants 0.

    Arrays of float64 in C order are held, not copied: what is written into them is seen by the next
    solve. Anything else is copied once.

    Raises:
      Error: wrong shapes, NaN, lower > upper, rho < 0."""

    def __init__(
        self, A: ArrayLike, lower: ArrayLike, upper: ArrayLike, rho: float = 0.0
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def A(self) -> NDArray[np.float64]:
        """(m, n), the array that is solved; empty for bounds"""

    @property
    def lower(self) -> NDArray[np.float64]:
        """(m,), the array that is solved"""

    @property
    def rho(self) -> float: ...
    @property
    def rows(self) -> int: ...
    @property
    def upper(self) -> NDArray[np.float64]:
        """(m,), the array that is solved"""

class LevelStack:
    """One level of many hierarchies of a batch, see solve_batch.

    Args:
      A: (B, m, n) float64, or (m, n) when all have the same.
      lower, upper: (B, m), or (m,) when all have the same.
      rho: regularisation coefficient >= 0 of all.

    Arrays are held and read as those of Level.

    Raises:
      Error: as Level; numbers behind the first slice are looked at by solve_batch."""

    def __init__(
        self, A: ArrayLike, lower: ArrayLike, upper: ArrayLike, rho: float = 0.0
    ) -> None: ...
    @property
    def A(self) -> NDArray[np.float64]:
        """the array that is solved; empty for bounds"""

    @property
    def lower(self) -> NDArray[np.float64]:
        """the array that is solved"""

    @property
    def rho(self) -> float: ...
    @property
    def upper(self) -> NDArray[np.float64]:
        """the array that is solved"""

class Status(_Enum):
    """How a solve ended."""

    InvalidInput: ClassVar[Status]
    IterationLimit: ClassVar[Status]
    LostPrecision: ClassVar[Status]
    ReducedAccuracy: ClassVar[Status]
    Solved: ClassVar[Status]
    __members__: ClassVar[dict[str, Status]]

class Side(_Enum):
    """The side at which a row is held."""

    Lower: ClassVar[Side]
    Upper: ClassVar[Side]
    __members__: ClassVar[dict[str, Side]]

class ActiveRow:
    """A row that holds x back."""

    def __repr__(self) -> str: ...
    @property
    def held_by(self) -> int:
        """level that pushes against it"""

    @property
    def level(self) -> int:
        """level that the row belongs to"""

    @property
    def multiplier(self) -> float:
        """>= 0, of that level's problem"""

    @property
    def row(self) -> int:
        """its row there"""

    @property
    def side(self) -> Side: ...
    def __init__(self, *args: object, **kwargs: object) -> None: ...

class LevelReport:
    """What a level could do, and what it cost."""

    @property
    def handed_over(self) -> NDArray[np.float64]:
        """of each of these directions the weight with which the levels below get it: 0 where the level keeps it, 1 where it sees nothing, between them by smooth hand-over only"""

    @property
    def infeasible(self) -> NDArray[np.float64]:
        """(m,) v_k: the part of the violation that no x allowed by the rows above and the limits it meets removes [T 3.3.78]"""

    @property
    def rank(self) -> int:
        """directions that its equality rows take from the levels below"""

    @property
    def regularized(self) -> NDArray[np.float64]:
        """(m,) u_k: the part that the regularisation costs, 0 for rho = 0 [T 3.3.80]"""

    @property
    def rho(self) -> float:
        """the regularisation that was used"""

    @property
    def singular_values(self) -> NDArray[np.float64]:
        """of its equality rows in the directions left by the equality rows above, largest first"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class LevelChange:
    """A change of the numbers of one level, or a gradient in them. None: no change.

    Args:
      A: (m, n). Bounds have none.
      lower, upper: (m,). An equality row moves with the mean of both.
      rho: of the regularisation."""

    def __init__(
        self,
        A: ArrayLike | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        rho: float = 0.0,
    ) -> None: ...
    @property
    def A(self) -> NDArray[np.float64] | None:
        """(m, n) or None"""

    @property
    def lower(self) -> NDArray[np.float64] | None:
        """(m,) or None"""

    @property
    def rho(self) -> float: ...
    @property
    def upper(self) -> NDArray[np.float64] | None:
        """(m,) or None"""

class Solution:
    """The answer of one solve. No later solve and no later change of an array moves it.

    multipliers, levels, jvp and vjp are computed when they are asked for."""

    def jvp(self, changes: collections.abc.Sequence[LevelChange | None]) -> NDArray[np.float64]:
        """How x moves with the numbers of the hierarchy: exact, with the working set held.

        Args:
          changes: a LevelChange, or None for no change, a level; levels left out do not change.

        Returns:
          dx (n,).

        Raises:
          Error: shapes that do not fit; a solve that did not end Solved; a method without sensitivities."""

    def vjp(self, x_bar: ArrayLike) -> list[LevelChange]:
        """jvp transposed: the gradient of f(x) in all numbers of the hierarchy, from its gradient in x.

        Args:
          x_bar: (n,) df/dx.

        Returns:
          a LevelChange a level, with df/dA (m, n) (None for Bounds), df/dlower (m,), df/dupper (m,), df/drho.
          Where lower == upper is one number, its gradient is the sum of both.

        Raises:
          Error: as jvp."""

    @property
    def changes(self) -> int:
        """working-set changes"""

    @property
    def factorizations(self) -> int:
        """level factorisations done, at least one a non-empty level"""

    @property
    def final_levels(self) -> int:
        """levels known to be optimal"""

    @property
    def levels(self) -> list[LevelReport]:
        """a LevelReport a final level"""

    @property
    def multipliers(self) -> list[list[NDArray[np.float64]]]:
        """multipliers[k][j] (m_j,): multipliers of level j's rows in the optimality of level k, j <= k.

        multipliers[k][k] are the violations of level k. [T 3.4.116]"""

    @property
    def optimality(self) -> float:
        """worst relative residual of the optimality conditions of all levels"""

    @property
    def status(self) -> Status: ...
    @property
    def violations(self) -> list[NDArray[np.float64]]:
        """per level (m,): A x - clip(A x, lower, upper)"""

    @property
    def working_set(self) -> list[ActiveRow]: ...
    @property
    def x(self) -> NDArray[np.float64]:
        """(n,)"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class SolverOptions:
    """How a hierarchy is solved; see its properties."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> SolverOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SolverOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        method: str = "lexicographic",
        proof: bool = True,
        max_changes: int = 10000,
        max_iterations: int = 100,
        handover: str = "strict",
        regularization: str = "constant",
        singular_threshold: float = 0.1,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def handover(self) -> str:
        """'strict': a direction that a level's equality rows see is lost to the levels below, however
        weak its singular value; x jumps where a rank changes. 'smooth': it goes back to them gradually as
        its singular value falls below rho of the level; x is continuous there, the level loses at most
        0.033 of each lower level's residual (unit rows, rho 0.1, no limit in the way). Strict all the same
        where the level or a level below has rho = 0. Of the method 'lexicographic'."""

    @handover.setter
    def handover(self, arg1: str) -> None: ...
    @property
    def max_changes(self) -> int:
        """working-set changes a solve, after which it ends with IterationLimit"""

    @max_changes.setter
    def max_changes(self, arg0: int) -> None: ...
    @property
    def max_iterations(self) -> int:
        """of Algorithm 1 (rhqp_thesis, hqp, dls_hqp); thesis: 12 for dls_hqp"""

    @max_iterations.setter
    def max_iterations(self, arg0: int) -> None: ...
    @property
    def method(self) -> str:
        """one of method_names()"""

    @method.setter
    def method(self, arg0: str) -> None: ...
    @property
    def proof(self) -> bool:
        """evaluate Solution.optimality at every solve; without, it is NaN"""

    @proof.setter
    def proof(self, arg0: bool) -> None: ...
    @property
    def regularization(self) -> str:
        """'constant': rho of each level. 'adaptive': rho sqrt(1 - (sigma / singular_threshold)^2) with the
        smallest singular value sigma of the level's equality rows on the directions left to it, and 0 where
        sigma >= singular_threshold. Of the method 'lexicographic'."""

    @regularization.setter
    def regularization(self, arg1: str) -> None: ...
    @property
    def singular_threshold(self) -> float:
        """> 0, unit of A; below it 'adaptive' regularises"""

    @singular_threshold.setter
    def singular_threshold(self, arg0: float) -> None: ...

class Solver:
    """Solves hierarchies over n unknowns; keeps its working sets between solves.

    Args:
      n: number of unknowns.
      options: SolverOptions."""

    def __init__(self, n: int, options: SolverOptions = ...) -> None: ...
    def reset(self) -> None:
        """Forgets the working sets: the next solve is cold."""

    def solve(self, levels: collections.abc.Sequence[Level]) -> Solution:
        """Solves the levels in decreasing priority.

        The interpreter lock is released meanwhile: let no other thread write into the arrays. A solver that
        two threads share takes one after the other.

        Args:
          levels: sequence of Level (and Bounds).

        Returns:
          Solution. A hard problem is no error: look at status and optimality.

        Raises:
          Error: shapes that do not fit n unknowns or each other; NaN, infinite A, lower > upper."""

    @property
    def n(self) -> int:
        """number of unknowns"""

class DrivenJoint:
    """One joint of a coordinate: its position = factor * coordinate + offset."""

    @property
    def actuator(self) -> int:
        """actuator id, -1 for none"""

    @property
    def dof(self) -> int:
        """address in qvel"""

    @property
    def factor(self) -> float: ...
    @property
    def joint(self) -> int:
        """joint id of the model"""

    @property
    def offset(self) -> float:
        """[rad] or [m]"""

    @property
    def part(self) -> int:
        """0 to 5 of a free joint, 3 to 5 of a ball joint, else -1"""

    @property
    def qpos(self) -> int:
        """address in qpos, of a ball joint its quaternion's"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class Coordinate:
    """What the controller moves: one joint, or several together."""

    def __repr__(self) -> str: ...
    @property
    def joints(self) -> list[DrivenJoint]:
        """list of DrivenJoint; the first one is read"""

    @property
    def lower(self) -> float:
        """[rad] or [m], -inf when unlimited; of a ball joint the range of all of it"""

    @property
    def max_effort(self) -> float:
        """[N m] or [N], sum over its actuators by their ranges of force or, of plain motors, of control; inf without any"""

    @property
    def max_velocity(self) -> float:
        """[rad/s] or [m/s], from the numeric velocity_limit_JOINT, else inf"""

    @property
    def name(self) -> str: ...
    @property
    def unit(self) -> str:
        """'rad' or 'm'"""

    @property
    def upper(self) -> float:
        """[rad] or [m], inf when unlimited"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class Robot:
    """Any MJCF robot as the controller sees it: coordinates, frames, Jacobians.

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
        root shall float."""

    @overload
    def __init__(
        self,
        model: os.PathLike[str] | str | bytes,
        joints: collections.abc.Sequence[str] | None = None,
        floating: bool = False,
    ) -> None: ...
    @overload
    def __init__(
        self,
        model: mujoco.MjModel,
        joints: collections.abc.Sequence[str] | None = None,
        floating: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def add_step(self, q: ArrayLike, step: ArrayLike) -> NDArray[np.float64]:
        """q (n,) a step (n,) further [rad] or [m], a velocity times a time: q + step, but ball joints and a free root turn.

        Raises:
          Error: q or step of another length."""

    def angular_momentum_drift(self) -> NDArray[np.float64]:
        """(3,) [N m] dA/dt v: how it changes when the coordinates do not accelerate."""

    def angular_momentum_jacobian(self) -> NDArray[np.float64]:
        """A (3, n), L = A v: angular momentum of the robot about its centre of mass, in W [kg m^2/s].

        Without armature; standing as `stand_on` says."""

    def com_drift(self) -> NDArray[np.float64]:
        """(3,) [m/s^2]: Jdot v of the centre of mass."""

    def com_jacobian(self) -> NDArray[np.float64]:
        """(3, n) [m/rad]: velocity of the centre of mass in W."""

    def coordinate(self, name: str) -> int:
        """Index of a coordinate."""

    def coordinates_of(self, qpos: ArrayLike) -> NDArray[np.float64]:
        """Coordinates (n,) out of a whole qpos (nq,)."""

    def inverse_dynamics(self, acceleration: ArrayLike) -> NDArray[np.float64]:
        """Torque (n,) [N m] or [N] that the coordinates take at an acceleration and the present velocity.

        Inertia with armature, gravity, Coriolis, springs and dampers; without dry friction and contacts.

        Args:
          acceleration: (n,) [rad/s^2] or [m/s^2]."""

    def mass_matrix(self) -> NDArray[np.float64]:
        """(n, n) [kg m^2]: joint-space inertia of the coordinates with armature, base held."""

    def orientation(self, frame: str) -> NDArray[np.float64]:
        """R_WF (3, 3); for a camera as MuJoCo has it: it looks along its -z."""

    def position(self, frame: str) -> NDArray[np.float64]:
        """p_WF (3,) [m]: origin of the frame in W."""

    def position_drift(self, frame: str) -> NDArray[np.float64]:
        """(3,) [m/s^2]: Jdot v, acceleration of the origin when the coordinates do not accelerate."""

    def position_jacobian(self, frame: str) -> NDArray[np.float64]:
        """(3, n) [m/rad]: velocity of the frame's origin in W by the coordinates."""

    def rotation_drift(self, frame: str) -> NDArray[np.float64]:
        """(3,) [rad/s^2]: Jdot v, angular acceleration when the coordinates do not accelerate."""

    def rotation_jacobian(self, frame: str) -> NDArray[np.float64]:
        """(3, n): angular velocity of the frame in W by the coordinates."""

    def set_configuration(self, q: ArrayLike) -> None:
        """Sets the coordinates q (n,) [rad] or [m]; all else stays as it is. Warns outside the limits, and where a loop of the model cannot close."""

    def set_keyframe(self, name: str) -> None:
        """Takes the posture of a keyframe, or the model's initial one for ''. Warns outside the limits."""

    def set_qpos(self, qpos: ArrayLike) -> None:
        """Sets the whole qpos (nq,), base and loose bodies too."""

    def set_velocity(self, velocity: ArrayLike) -> None:
        """Sets the velocity (n,) [rad/s] or [m/s]; only drifts use it."""

    def stand_on(self, body: str) -> None:
        """The body that stays where it is when the coordinates move; by default the root of its tree.

        A robot with folding legs stands on those that lie on the ground: its root, and all above, then
        moves with the knees, and Jacobians, drifts and inertia count that.

        Raises:
          Error: no such body, a body of another tree, or a tree without a free joint."""

    def velocities_of(self, qvel: ArrayLike) -> NDArray[np.float64]:
        """Velocities of the coordinates (n,) out of a whole qvel (nv,)."""

    def view_orientation(self, frame: str) -> NDArray[np.float64]:
        """R_WF (3, 3) with x along the line of sight of a camera and z up; else like orientation."""

    @property
    def com(self) -> NDArray[np.float64]:
        """(3,) [m]: centre of mass in W of the tree of the first coordinate."""

    @property
    def configuration(self) -> NDArray[np.float64]:
        """q (n,) [rad] or [m]"""

    @property
    def coordinate_names(self) -> list[str]: ...
    @property
    def coordinates(self) -> list[Coordinate]:
        """list of Coordinate, n of them"""

    @property
    def floating(self) -> bool:
        """its first six coordinates are those of the root"""

    @property
    def floats(self) -> bool:
        """its root is free, no coordinate, and stands on nothing"""

    @property
    def followers(self) -> list[str]:
        """list[str]: joints that follow the coordinates, as constraints of the model close loops with them.

        Constraints are connect, weld, tendon and joint equalities, between parts of the robot, to the ground
        and to other bodies. Such a joint has no spring and, unless `joints` named the coordinates, no
        actuator; no root of a robot follows. It moves with the coordinates in poses,
        Jacobians and dynamics, and its range is a limit of every stack."""

    @property
    def left_out(self) -> str:
        """str: joints of the robot that are held, and constraints that the coordinates do not keep.

        A constraint is kept where joints follow the coordinates (`followers`) and the coordinates are no more
        than its loop leaves free. '' where all are kept and none is held, or where the model says by tuples
        what its coordinates are."""

    @property
    def qpos(self) -> NDArray[np.float64]:
        """(nq,)"""

    @property
    def size(self) -> int:
        """n"""

    @property
    def unkept_constraints(self) -> list[str]:
        """list[str]: equality constraints of the model that the coordinates do not keep.

        By name; one without a name by what it ties: 'that of left_hand and right_hand'."""

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n,) [rad/s] or [m/s]"""

class SpringForce:
    """The contact force on a link that hangs on a spring, from the deflection of the spring.

    The hinge has no motor; contact = damping - spring - weight of what hangs on it. True at rest and in
    slow motion, between the stops of the spring.

    Args:
      robot: Robot whose model it is.
      joint: hinge with stiffness, LEBS say.
      frame: site or body behind it, where the contact is supposed.

    Raises:
      Error: a name that does not exist, a joint that is no spring hinge, a frame before it."""

    def __init__(self, robot: Robot, joint: str, frame: str) -> None: ...
    def update(self, qpos: ArrayLike, qvel: ArrayLike) -> None:
        """Takes what is sensed: qpos (nq,), qvel (nv,)."""

    @property
    def at_stop(self) -> bool:
        """whether a stop bears a share that the spring does not tell"""

    @property
    def deflection(self) -> float:
        """[rad]"""

    @property
    def direction(self) -> NDArray[np.float64]:
        """(3,) of the force, in W"""

    @property
    def force(self) -> float:
        """[N] at the frame, across its lever"""

    @property
    def lever(self) -> float:
        """[m]"""

    @property
    def moment(self) -> float:
        """[N m] of the contact, at the joint"""

class Task:
    """What a task is: it measures, a controller decides.

    Error e (m,) with de/dt = J qdot - velocity_des, and the wish lower <= e <= upper (a point: both 0).
    A new task holds the robot's present value. Arrays are copies, as of the last update."""

    def __gt__(self, arg0: Any) -> bool: ...
    def __lt__(self, arg0: Any) -> bool: ...
    def __repr__(self) -> str: ...
    def advance(self, velocity: ArrayLike, dt: float) -> None:
        """Moves the target and feeds the velocity forward until the next advance or hold.

        Args:
          velocity: (m,) unit of the task per second.
          dt: [s]. The target moves by velocity * dt; the error follows at the next update."""

    def hold(self, robot: Robot) -> None:
        """Makes the present value the target, at rest, and updates."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    @overload
    def set_gain(self, gain: float) -> None:
        """Rate at which errors of this task vanish, instead of the controller's.

        Args:
          gain: [1/s], positive; one number, or one a row (m,). More than one by the control period counts as that."""

    @overload
    def set_gain(self, gain: ArrayLike) -> None:
        """Rate at which errors of this task vanish, instead of the controller's.

        Args:
          gain: [1/s], positive; one number, or one a row (m,). More than one by the control period counts as that."""

    def set_interval(self, lower: ArrayLike, upper: ArrayLike) -> None:
        """The interval that the error shall be in: (m,) each, -inf or inf for no side."""

    def set_max_acceleration(self, acceleration: float) -> None:
        """What the task asks for changes no faster, and brakes no harder before its target.

        Norms, and feed-forwards, as in set_max_speed. By default inf: the accelerations of the coordinates are
        limited alone. Limits and the end of reach may stop the robot harder; what was held and is let go starts
        by up to 0.2 s of it at once. A row that is free within an interval is not held back; law='thesis' knows
        no such limit.

        Args:
          acceleration: [unit/s^2], positive; inf for none.

        Raises:
          Error: no positive number."""

    def set_max_speed(self, speed: float) -> None:
        """No more than this is asked for to bring the error to its interval; a feed-forward comes on top.

        By default 0.5 m/s for points, 0.3 m/s for the centre of mass, 1.5 rad/s for turns and angles,
        1 rad/s for each coordinate of a posture. A norm; where rows stand apart (posture, balance,
        distances) each row alone.

        Args:
          speed: [unit/s], positive."""

    @overload
    def set_weights(self, weights: float) -> None:
        """What each row counts beside the others of its level where they cannot all be met.

        Args:
          weights: (m,), or one for all rows, by default 1; 0 for a row that asks for nothing."""

    @overload
    def set_weights(self, weights: ArrayLike) -> None:
        """What each row counts beside the others of its level where they cannot all be met.

        Args:
          weights: (m,), or one for all rows, by default 1; 0 for a row that asks for nothing."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def update(self, robot: Robot) -> None:
        """Measures at the robot's present configuration."""

    @property
    def drift(self) -> NDArray[np.float64]:
        """(m,): Jdot qdot"""

    @property
    def error(self) -> NDArray[np.float64]:
        """e (m,)"""

    @property
    def is_limit(self) -> bool:
        """controllers brake before its interval as before joint limits"""

    @property
    def jacobian(self) -> NDArray[np.float64]:
        """J (m, n)"""

    @property
    def lower(self) -> NDArray[np.float64]:
        """(m,), of the error"""

    @property
    def max_acceleration(self) -> float:
        """[unit/s^2]"""

    @property
    def max_speed(self) -> float:
        """[unit/s]"""

    @property
    def name(self) -> str: ...
    @property
    def rows(self) -> int:
        """m"""

    @property
    def unit(self) -> str:
        """Of the error: 'm', 'rad', 'm and rad' where rows differ, '' where nobody said."""

    @property
    def upper(self) -> NDArray[np.float64]:
        """(m,), of the error"""

    @property
    def velocity_des(self) -> NDArray[np.float64]:
        """(m,)"""

    @property
    def weights(self) -> NDArray[np.float64]:
        """(m,)"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class ValueTask(Task):
    """A task whose value is a list of numbers: e = value - target, angles the short way round."""

    def set_target(
        self,
        target: ArrayLike,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
    ) -> None:
        """Sets the target; seen at the next update.

        Args:
          target: (m,).
          velocity: (m,) [unit/s] at which the target moves, fed forward until the next call that sets or
            moves it; None: at rest. Who leads a target so sets it anew each tick.
          acceleration: (m,) [unit/s^2] of the target, fed forward so by accelerations and torques; None: 0."""

    @property
    def leash(self) -> float:
        """Deprecated name of max_lead."""

    @leash.setter
    def leash(self, arg1: float) -> None: ...
    @property
    def max_lead(self) -> float:
        """Distance [task unit] that advance leads the target from the value at most, inf for any.

        From a fifth of it on the target goes slower; a velocity that leads back is never held."""

    @max_lead.setter
    def max_lead(self, arg1: float) -> None: ...
    @property
    def target(self) -> NDArray[np.float64]:
        """s_des (m,)"""

    @property
    def value(self) -> NDArray[np.float64]:
        """s (m,), at the last update"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class DampingTask(Task):
    """Coordinates at rest: e = 0 (m,), 0 = qdot.

    Takes up what other tasks leave without pulling anywhere; advance asks for another velocity.

    Args:
      name, robot: see PositionTask.
      coordinates: their names; none means all."""

    def __init__(
        self, name: str, robot: Robot, coordinates: collections.abc.Sequence[str] = []
    ) -> None: ...

class CustomTask(ValueTask):
    """A task whose value a Python function measures.

    Slower than the others by what Python takes. A copy of a controller shares the function.
    `check_jacobian(task, robot)` compares the Jacobian with differences of the value.

    Args:
      name, robot: see PositionTask.
      rows: m.
      measure: called with the robot; returns value (m,) and Jacobian (m, n), or these and drift (m,),
        which is Jdot qdot.
      unit: of the value, told in diagnostics: "m", say.

    Raises:
      Error: rows below 1, or what came back has another shape."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        rows: int,
        measure: collections.abc.Callable[..., Any],
        unit: str = "",
    ) -> None: ...

class ManipulabilityTask(ValueTask):
    """How far a frame is from a singularity: s (1,), the product of the singular values of its Jacobian.

    set_target(s_min) with set_interval([0], [inf]) keeps it above s_min; a target that is out of reach
    makes it as large as the levels above allow. Slower than others: differences of kinematics.

    Args:
      name, robot, frame: see PositionTask.
      axes: (m, 3), m = 1 to 3 directions in the world that count.
      turns: rotations [rad] count beside positions [m]."""

    def __init__(
        self, name: str, robot: Robot, frame: str, axes: ArrayLike = ..., turns: bool = False
    ) -> None: ...

class PostureTask(ValueTask):
    """Coordinates at chosen positions [rad] or [m] (m,).

    Args:
      name, robot: see PositionTask.
      coordinates: their names, in this order; none means all."""

    def __init__(
        self, name: str, robot: Robot, coordinates: collections.abc.Sequence[str] = []
    ) -> None: ...

class PointTask(ValueTask):
    """A point of the robot at a target."""

    @property
    def position(self) -> NDArray[np.float64]:
        """p_RF (3,) [m]"""

    @property
    def world_position(self) -> NDArray[np.float64]:
        """where the point is (3,) [m] in the world, at the last update"""

    @property
    def world_target(self) -> NDArray[np.float64]:
        """where it shall be (3,) [m] in the world, for drawing"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class PositionTask(PointTask):
    """The origin of a frame at a target position [m] (m,).

    Args:
      name: shown in plots and messages.
      robot: Robot whose present value it starts to hold.
      frame: name of a site, body, camera or geom.
      reference: frame in whose axes the position is measured, '' for the world.
      axes: (m, 3), m = 1 to 3 directions in the axes of the reference.

    Raises:
      Error: a frame that does not exist, or that no coordinate moves against the reference."""

    def __init__(
        self, name: str, robot: Robot, frame: str, reference: str = "", axes: ArrayLike = ...
    ) -> None: ...

class CenterOfMassTask(PointTask):
    """The centre of mass of the whole tree at a target [m] (m,).

    Args:
      name, robot, reference, axes: see PositionTask."""

    def __init__(
        self, name: str, robot: Robot, reference: str = "", axes: ArrayLike = ...
    ) -> None: ...

class PoseTask(Task):
    """The pose of a frame at a target pose: position and orientation.

    e = [p - p_des; log(R R_des^T)] [m], [rad] (6,) in the axes of the reference; advance takes [m/s] and
    [rad/s] (6,) in these axes. Turns are three times as fast [rad/s] as max_speed [m/s].

    Args:
      name, robot, frame, reference: see PositionTask."""

    def __init__(self, name: str, robot: Robot, frame: str, reference: str = "") -> None: ...
    def set_target(
        self,
        position: ArrayLike,
        orientation: ArrayLike | None = None,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
    ) -> None:
        """Sets the target; seen at the next update.

        Args:
          position: (3,) [m].
          orientation: (3, 3) rotation or quaternion (4,) w x y z; None keeps the one that it has.
          velocity: (6,) [m/s], [rad/s] at which the target moves, fed forward until the next call that sets
            or moves it; None: at rest.
          acceleration: (6,) [m/s^2], [rad/s^2] of the target, fed forward so by accelerations and torques;
            None: 0."""

    @property
    def max_lead(self) -> float:
        """Distance [m], and three times as many [rad], that advance leads the target from the frame at most.

        inf for any. From a fifth of it on the target goes slower; a velocity that leads back is never held."""

    @max_lead.setter
    def max_lead(self, arg1: float) -> None: ...
    @property
    def orientation(self) -> NDArray[np.float64]:
        """R_RF (3, 3)"""

    @property
    def position(self) -> NDArray[np.float64]:
        """p_RF (3,) [m]"""

    @property
    def target_orientation(self) -> NDArray[np.float64]:
        """(3, 3)"""

    @property
    def target_position(self) -> NDArray[np.float64]:
        """(3,) [m]"""

    @property
    def world_position(self) -> NDArray[np.float64]:
        """where the point is (3,) [m] in the world, at the last update"""

    @property
    def world_target(self) -> NDArray[np.float64]:
        """where it shall be (3,) [m] in the world, for drawing"""

    @property
    def world_target_orientation(self) -> NDArray[np.float64]:
        """how it shall be turned (3, 3) in the world, for drawing"""

class RelativePoseTask(PoseTask):
    """The pose of a frame in another frame of the robot: a PoseTask whose reference moves too.

    Args:
      name, robot, frame: see PositionTask.
      reference: frame of the robot."""

    def __init__(self, name: str, robot: Robot, frame: str, reference: str) -> None: ...

class OrientationTask(Task):
    """The orientation of a frame at a target orientation.

    e = log(R R_des^T) [rad] (3,) in the axes of the reference; advance takes an angular velocity
    [rad/s] (3,) in these axes.

    Args:
      name, robot, frame, reference: see PositionTask."""

    def __init__(self, name: str, robot: Robot, frame: str, reference: str = "") -> None: ...
    def set_target(
        self,
        target: ArrayLike,
        velocity: ArrayLike | None = None,
        acceleration: ArrayLike | None = None,
    ) -> None:
        """Sets the target; seen at the next update.

        Args:
          target: (3, 3) rotation or quaternion (4,) w x y z.
          velocity: (3,) [rad/s] at which the target turns, fed forward until the next call that sets or
            moves it; None: at rest.
          acceleration: (3,) [rad/s^2] of the target, fed forward so by accelerations and torques; None: 0."""

    @property
    def max_lead(self) -> float:
        """Distance [task unit] that advance leads the target from the value at most, inf for any.

        From a fifth of it on the target goes slower; a velocity that leads back is never held."""

    @max_lead.setter
    def max_lead(self, arg1: float) -> None: ...
    @property
    def orientation(self) -> NDArray[np.float64]:
        """R_RF (3, 3)"""

    @property
    def target(self) -> NDArray[np.float64]:
        """R_des (3, 3)"""

class AngleKind(_Enum):
    """Which angle an AngleTask measures."""

    Elevation: ClassVar[AngleKind]
    Heading: ClassVar[AngleKind]
    __members__: ClassVar[dict[str, AngleKind]]

class AngleTask(ValueTask):
    """One angle [rad] (1,) of an axis that is fixed in a frame.

    Args:
      name, robot, frame, reference: see PositionTask.
      kind: AngleKind.Elevation over the x-y plane, or AngleKind.Heading about z, of the reference.
      axis: (3,) in the frame."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        frame: str,
        kind: AngleKind = ...,
        axis: ArrayLike = ...,
        reference: str = "",
    ) -> None: ...

class SwivelTask(ValueTask):
    """The turn [rad] (1,) of an arm's plane about the line from shoulder to wrist.

    Zero where the elbow lies on the side of `direction`; fades where the arm is straight.

    Args:
      name, robot: see PositionTask.
      shoulder, elbow, wrist, torso: names of frames; the torso carries the shoulder.
      direction: (3,) in the axes of the torso."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        *,
        shoulder: str,
        elbow: str,
        wrist: str,
        torso: str,
        direction: ArrayLike = ...,
    ) -> None: ...

class GazeTask(Task):
    """The camera looks at a point of the world; e = (yaw, pitch) [rad] (2,).

    A positive error: the camera looks to the left of, above the target. advance moves the target
    around the camera, [rad/s] (2,) to the left and upward.

    Args:
      name, robot: see PositionTask.
      frame: a camera, or any other frame, which then looks along its x axis."""

    def __init__(self, name: str, robot: Robot, frame: str) -> None: ...
    def set_target(self, target: ArrayLike) -> None:
        """Sets the target (3,) [m] in W, at rest; seen at the next update."""

    @property
    def target(self) -> NDArray[np.float64]:
        """p_WT (3,) [m]"""

class TorqueLimits(Task):
    """What the drives of the coordinates can give: lower <= M qddot + h <= upper [N m] (n,).

    A level of its own, below the joint limits; for AccelerationController.

    Args:
      name: shown in plots and messages.
      robot: Robot, whose efforts it starts with (inf where it has none)."""

    def __init__(self, name: str, robot: Robot) -> None: ...

class ContactTask(Task):
    """A body that keeps its place on what it stands on, and the forces that this may take.

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
      Error: no such body, a body without collision geoms, a friction that is not positive."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        body: str,
        points: ArrayLike | None = None,
        friction: float = 0.6,
        normal: ArrayLike = ...,
    ) -> None: ...
    @property
    def points(self) -> NDArray[np.float64]:
        """(k, 3) [m] in the body's frame"""

class BalanceTask(Task):
    """The centre of mass stays over a polygon: e (k,) [m], distances from its sides, margin <= e.

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
      Error: fewer than three corners, or corners that are not convex."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        polygon: ArrayLike,
        margin: float = 0.05,
        reference: str = "",
        height: float = 0.0,
        room: int = 0,
    ) -> None: ...
    def set_polygon(self, polygon: ArrayLike) -> None:
        """Another polygon from the next tick on, after a step say.

        Args:
          polygon: (j, 2) [m] corners as for the task, no more of them than it has rows.

        Raises:
          Error: more corners, fewer than three, or corners that are not convex."""

class ZeroMomentTask(Task):
    """The zero moment point stays in a polygon: no motion tips the robot over.

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
      Error: fewer than three corners, or corners that are not convex; a model without gravity."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        polygon: ArrayLike,
        margin: float = 0.03,
        reference: str = "",
        height: float = 0.0,
    ) -> None: ...

class DistanceTask(Task):
    """Bodies keep away from each other: e (m,) [m], distances of the nearest pairs, margin <= e.

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
        most <= margin, or margin < 0."""

    def __copy__(self) -> DistanceTask: ...
    def __init__(
        self,
        name: str,
        robot: Robot,
        pairs: collections.abc.Sequence[tuple[str, str]],
        margin: float = 0.03,
        most: float = 0.3,
        rows: int = 16,
        as_it_stands: bool = False,
    ) -> None: ...
    def clear_obstacles(self) -> None:
        """All obstacles where the robot has them, at rest, or where a Simulation sees them."""

    def near(self, robot: Robot) -> list[tuple[str, str, float]]:
        """Names of the geoms of the pairs that have a row, and their e [m], as of the last update."""

    def pairs(self, robot: Robot) -> list[tuple[str, str]]:
        """Names of the geoms of each pair."""

    def set_obstacle(
        self,
        robot: Robot,
        body: str,
        position: ArrayLike,
        rotation: ArrayLike | None = None,
        velocity: ArrayLike = ...,
        angular_velocity: ArrayLike = ...,
    ) -> None:
        """Where a body is that the coordinates do not move, and how it moves, until the next call.

        The distance then counts that it comes: the robot gives way in time.

        Args:
          robot: the robot of the task.
          body: name of a body of some pair.
          position: (3,) [m] in the world.
          rotation: (3, 3) or quaternion (4,) w x y z in the world, None for none.
          velocity: (3,) [m/s] of its origin.
          angular_velocity: (3,) [rad/s].

        Raises:
          Error: a body that is in no pair or part of the robot, a matrix that is no rotation."""

    @property
    def sees_obstacles(self) -> bool:
        """A Simulation says where bodies are that may move, unless set_obstacle has said so."""

    @sees_obstacles.setter
    def sees_obstacles(self, arg1: bool) -> None: ...

class ForceLoop(_Enum):
    """The law of a force loop, see ForceGains."""

    FirstOrder: ClassVar[ForceLoop]
    Position: ClassVar[ForceLoop]
    PositionIntegral: ClassVar[ForceLoop]
    Velocity: ClassVar[ForceLoop]
    __members__: ClassVar[dict[str, ForceLoop]]

class ForceGains:
    """Law and gains of a force loop; f = G (s - r) is what the robot exerts along the axis.

    FirstOrder        ds/dt = C (f_d - f)                                    [T 5.7.62]
    Velocity          M s'' = -L s' + K delta, delta = C (f_d - f)           [T 5.4.35]
    Position          M s'' = -L s' + K (delta - s)                          [T 5.4.28-29]
    PositionIntegral  the same, delta with N times the integral of f_d - f   [T 5.4.34]

    Position ends at f = (C G f_d - G r) / (1 + C G), the others at f_d. FirstOrder is for both
    controllers, the others for AccelerationController.

    Args:
      loop: ForceLoop.
      compliance: C > 0, [m/s/N] of FirstOrder, [m/N] of the others.
      integral: N > 0 [m/s/N], of PositionIntegral alone.
      mass: M > 0 [kg], as damping L [kg/s] and stiffness K [kg/s^2] not of FirstOrder.
      damping: see mass.
      stiffness: see mass.
      dt: [s] control period."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    loop: ForceLoop

    def __copy__(self) -> ForceGains: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> ForceGains: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        loop: ForceLoop = ...,
        compliance: float = 0.001,
        integral: float = 0.0,
        mass: float = 1.0,
        damping: float = 20.0,
        stiffness: float = 100.0,
        dt: float = 0.001,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def compliance(self) -> float:
        """[m/s/N] or [m/N]"""

    @compliance.setter
    def compliance(self, arg0: float) -> None: ...
    @property
    def damping(self) -> float:
        """[kg/s]"""

    @damping.setter
    def damping(self, arg0: float) -> None: ...
    @property
    def dt(self) -> float:
        """[s]"""

    @dt.setter
    def dt(self, arg0: float) -> None: ...
    @property
    def integral(self) -> float:
        """[m/s/N]"""

    @integral.setter
    def integral(self, arg0: float) -> None: ...
    @property
    def mass(self) -> float:
        """[kg]"""

    @mass.setter
    def mass(self, arg0: float) -> None: ...
    @property
    def stiffness(self) -> float:
        """[kg/s^2]"""

    @stiffness.setter
    def stiffness(self, arg0: float) -> None: ...

class ContactOptions:
    """When there is contact, too much of it, or no sensor.

    Args:
      f_min: [N] > 0 at which contact begins; it ends below half of it for release_time.
      f_max: [N] > f_min beyond which the row stops until reset.
      release_time: [s].
      patience: [s] for which the last reading stands for missing ones (NaN); then the sensor is lost.
      frozen_move: [m] along the axis with the same reading in contact: the sensor is lost; 0: not
        looked for."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> ContactOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> ContactOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        f_min: float = 2.5,
        f_max: float = 150.0,
        release_time: float = 0.05,
        patience: float = 0.01,
        frozen_move: float = 0.0005,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def f_max(self) -> float:
        """[N]"""

    @f_max.setter
    def f_max(self, arg0: float) -> None: ...
    @property
    def f_min(self) -> float:
        """[N]"""

    @f_min.setter
    def f_min(self, arg0: float) -> None: ...
    @property
    def frozen_move(self) -> float:
        """[m]"""

    @frozen_move.setter
    def frozen_move(self, arg0: float) -> None: ...
    @property
    def patience(self) -> float:
        """[s]"""

    @patience.setter
    def patience(self, arg0: float) -> None: ...
    @property
    def release_time(self) -> float:
        """[s]"""

    @release_time.setter
    def release_time(self, arg0: float) -> None: ...

class StiffnessOptions:
    """How the stiffness of an environment is learnt: least squares on increments, with forgetting.

    Args:
      lower: [N/m] bounds of the estimate.
      upper: [N/m], and what it starts from.
      forgetting: of an increment, 0 to 1.
      step: [m] shortest increment."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> StiffnessOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> StiffnessOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        lower: float = 100.0,
        upper: float = 1000000.0,
        forgetting: float = 0.9,
        step: float = 5e-05,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def forgetting(self) -> float: ...
    @forgetting.setter
    def forgetting(self, arg0: float) -> None: ...
    @property
    def lower(self) -> float:
        """[N/m]"""

    @lower.setter
    def lower(self, arg0: float) -> None: ...
    @property
    def step(self) -> float:
        """[m]"""

    @step.setter
    def step(self, arg0: float) -> None: ...
    @property
    def upper(self) -> float:
        """[N/m]"""

    @upper.setter
    def upper(self, arg0: float) -> None: ...

class ContactState(_Enum):
    """What a ForceTask takes its readings for."""

    Contact: ClassVar[ContactState]
    Free: ClassVar[ContactState]
    SensorLost: ClassVar[ContactState]
    Stopped: ClassVar[ContactState]
    __members__: ClassVar[dict[str, ContactState]]

class ForceTask(PositionTask):
    """The contact force along one axis as a row: in the air a position, in contact a force law.

    Pressing down with 5 N along z is -5 N. Each tick: sense(robot, f), then the controller. From motion
    to force and back the row goes over within `blend`; with 0 it jumps [T Fig. 5.17].

    Args:
      name: shown in plots and messages.
      robot: Robot.
      frame: name of a site, body, camera or geom.
      reference: frame that the axis belongs to, '' for the world; `frame` itself: the axis turns with it,
        over a curved surface.
      axis: (3,), made a unit vector.
      force_des: f_d [N].
      blend: [s].
      environment: G [N/m] where it is known; 0: learnt in contact.
      max_rate: [1/s] where G is learnt, the compliance is held so low that an error vanishes no faster.
      gains: ForceGains.
      contact: ContactOptions.
      stiffness: StiffnessOptions of the estimate.

    Raises:
      Error: a name that does not exist, gains that are unstable with this environment."""

    def __init__(
        self,
        name: str,
        robot: Robot,
        frame: str,
        reference: str = "",
        axis: ArrayLike = ...,
        *,
        force_des: float = -5.0,
        blend: float = 0.1,
        environment: float = 0.0,
        max_rate: float = 50.0,
        gains: ForceGains = ...,
        contact: ContactOptions = ...,
        stiffness: StiffnessOptions = ...,
    ) -> None: ...
    def enable(self, on: bool) -> None:
        """False: motion alone, whatever is read; readings are still watched."""

    def reset(self, robot: Robot) -> None:
        """Out of Stopped and SensorLost, at rest where the frame is."""

    def sense(self, robot: Robot, force: float) -> None:
        """One tick: the reading.

        Args:
          robot: Robot where the controller will see it.
          force: f [N], NaN for none."""

    def set_filter(self, seconds: float) -> None:
        """A low-pass of what the force law is told; contact is judged by the reading itself.

        Args:
          seconds: its time constant, 0 for none. `WholeBodyController.sense` sets 3 ms for a sensor.

        Raises:
          Error: below 0 or not finite."""

    def set_force(self, force_des: float) -> None:
        """f_d [N]."""

    def tare(self, seconds: float = 0.1) -> None:
        """The mean of what is read next is zero from then on: the weight of a tool behind the sensor, say.

        Until then readings count as none and nothing leads the task: a contact ends, at rest. A reset of the
        simulation forgets it, but for one that is asked for before the simulation is made: that is taken
        anew at each start.

        Args:
          seconds: for how long it is read; 0 takes one reading.

        Raises:
          Error: a time below 0 or not finite."""

    @property
    def contact(self) -> ContactState:
        """ContactState"""

    @property
    def force(self) -> float:
        """[N] last reading"""

    @property
    def force_des(self) -> float:
        """[N]"""

    @property
    def learnt_stiffness(self) -> float:
        """[N/m] given or learnt"""

class JointLimits:
    """Ranges and speed limits of all coordinates (n,): no task, but what holds before all tasks.

    A controller has those of the robot; where a stack names others, these take their place. They come
    first in a stack, alone on their level.

    Args:
      name: shown in plots and messages.
      robot: Robot, whose limits it starts with."""

    def __gt__(self, arg0: Any) -> bool: ...
    def __init__(self, name: str, robot: Robot) -> None: ...
    def __lt__(self, arg0: Any) -> bool: ...
    def __repr__(self) -> str: ...
    def reset_ranges(self) -> None:
        """The ranges of the robot again."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def set_interval(self, lower: ArrayLike, upper: ArrayLike) -> None:
        """Narrows the ranges of all coordinates (n,); never wider than the robot's."""

    @overload
    def set_max_velocities(self, limits: float) -> None:
        """Speed limits of all coordinates (n,), or one for all [rad/s] or [m/s], above 0; the robot's own hold where they are smaller. inf: none at all, for what is only reckoned."""

    @overload
    def set_max_velocities(self, limits: ArrayLike) -> None:
        """Speed limits of all coordinates (n,), or one for all [rad/s] or [m/s], above 0; the robot's own hold where they are smaller. inf: none at all, for what is only reckoned."""

    def set_max_velocity(self, coordinate: str, limit: float) -> None:
        """Speed limit of one coordinate [rad/s] or [m/s], above 0; the robot's own holds where it is smaller. inf: none at all, for what is only reckoned."""

    def set_range(self, coordinate: str, lower: float, upper: float) -> None:
        """Narrows the range of one coordinate [rad] or [m]; never wider than the robot's."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def update(self, robot: Robot) -> None:
        """Notes where the coordinates are."""

    @property
    def error(self) -> NDArray[np.float64]:
        """(n,) [rad] or [m]: q at the last update"""

    @property
    def lower(self) -> NDArray[np.float64]:
        """(n,) [rad] or [m]"""

    @property
    def max_velocity(self) -> NDArray[np.float64]:
        """(n,) [rad/s]"""

    @property
    def name(self) -> str: ...
    @property
    def rows(self) -> int:
        """n"""

    @property
    def upper(self) -> NDArray[np.float64]:
        """(n,) [rad] or [m]"""

class StackLevel:
    """Tasks of one priority, or limits of the coordinates.

    Args:
      name: shown in plots and messages.
      tasks: sequence of Task, all on this level, or JointLimits alone.
      rho: regularisation coefficient >= 0; a level of coordinate limits is never regularised.

    Raises:
      Error: no task, or a rho that is negative or not finite."""

    def __init__(
        self, name: str, tasks: collections.abc.Iterable[Task | JointLimits], rho: float = 0.1
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def name(self) -> str: ...
    @property
    def rho(self) -> float: ...
    @property
    def tasks(self) -> list[Any]: ...

class Stack:
    """Tasks by priority, first comes first: Stack([limits, [left, right], posture]).

    Args:
      levels: sequence of Task, StackLevel, or a list of tasks that share a level; JointLimits come
        first, where they are named.

    Raises:
      Error: a task stands twice, or limits stand elsewhere."""

    def __init__(
        self,
        levels: collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ],
    ) -> None: ...
    def __len__(self) -> int: ...
    def __repr__(self) -> str: ...
    @property
    def levels(self) -> list[str]:
        """list of str, decreasing priority"""

class ControlSolution:
    """The solution of a controller's last solve."""

    @property
    def changes(self) -> int:
        """working-set changes"""

    @property
    def factorizations(self) -> int: ...
    @property
    def final_levels(self) -> int:
        """levels known to be optimal"""

    @property
    def optimality(self) -> float:
        """worst relative residual of the optimality conditions of all levels"""

    @property
    def status(self) -> Status: ...
    @property
    def violations(self) -> list[NDArray[np.float64]]:
        """per level (m,): A x - clip(A x, lower, upper)"""

    @property
    def working_set(self) -> list[ActiveRow]:
        """list of ActiveRow"""

    @property
    def x(self) -> NDArray[np.float64]:
        """(n,)"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class Shortfall:
    """A task that is off its interval and is not brought back as it asks; str() is the plain words."""

    def __str__(self) -> str: ...
    @property
    def held_by(self) -> list[str]:
        """list of str"""

    @property
    def short_by(self) -> float:
        """[unit]"""

    @property
    def task(self) -> str: ...
    @property
    def unit(self) -> str:
        """of the task, or of what it lacks: 'm', 'rad', 'm and rad', 'N' ...; '' where none is known"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class LevelDiagnostics:
    """What a level fell short of at the last compute, and why.

    The smallest singular value (distance to singularity) and the product of all (manipulability) are of
    the level's equality rows on the directions that the levels above left; 1 without such rows."""

    @property
    def level(self) -> str: ...
    @property
    def manipulability(self) -> float: ...
    @property
    def shortfalls(self) -> list[Shortfall]:
        """list of Shortfall; empty: all is well"""

    @property
    def shorts(self) -> list[Shortfall]:
        """Deprecated name of shortfalls."""

    @property
    def smallest_singular_value(self) -> float: ...
    def __init__(self, *args: object, **kwargs: object) -> None: ...

class VelocityControllerOptions:
    """Options of the velocity controller.

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
      solver: SolverOptions."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> VelocityControllerOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> VelocityControllerOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        dt: float = 0.001,
        gain: float = 5.0,
        horizon: float = 0.05,
        max_acceleration: float = 20.0,
        enforce_limits: bool = True,
        return_speed: float = 0.2,
        transition: float = 0.2,
        law: str = "arrive",
        solver: SolverOptions = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def dt(self) -> float:
        """[s]"""

    @dt.setter
    def dt(self, arg0: float) -> None: ...
    @property
    def enforce_limits(self) -> bool:
        """limits before all levels"""

    @enforce_limits.setter
    def enforce_limits(self, arg0: bool) -> None: ...
    @property
    def gain(self) -> float:
        """[1/s]"""

    @gain.setter
    def gain(self, arg0: float) -> None: ...
    @property
    def horizon(self) -> float:
        """[s]"""

    @horizon.setter
    def horizon(self, arg0: float) -> None: ...
    @property
    def law(self) -> str:
        """'arrive' or 'thesis'"""

    @law.setter
    def law(self, arg1: str) -> None: ...
    @property
    def max_acceleration(self) -> float:
        """[rad/s^2]"""

    @max_acceleration.setter
    def max_acceleration(self, arg0: float) -> None: ...
    @property
    def return_speed(self) -> float:
        """[rad/s]"""

    @return_speed.setter
    def return_speed(self, arg0: float) -> None: ...
    @property
    def solver(self) -> SolverOptions:
        """SolverOptions"""

    @solver.setter
    def solver(self, arg0: SolverOptions) -> None: ...
    @property
    def transition(self) -> float:
        """[s]"""

    @transition.setter
    def transition(self, arg0: float) -> None: ...

class VelocityController:
    """From a stack to velocities: first-order closed-loop inverse kinematics.

    Args:
      robot: Robot that the tasks were made for.
      options: VelocityControllerOptions."""

    def __init__(self, robot: Robot, options: VelocityControllerOptions = ...) -> None: ...
    def compute(self, robot: Robot) -> NDArray[np.float64]:
        """Measures the tasks at the robot, builds the hierarchy, solves it.

        Args:
          robot: Robot at the configuration (and velocity) to start from.

        Returns:
          qdot* (n,) [rad/s] or [m/s]. Releases the interpreter lock."""

    def diagnostics(self, robot: Robot) -> list[LevelDiagnostics]:
        """What each level fell short of at the last compute, and why.

        Args:
          robot: Robot as it was at compute.

        Returns:
          list of LevelDiagnostics, decreasing priority."""

    def integrate(self, q: ArrayLike) -> NDArray[np.float64]:
        """q* after one dt: q + qdot* dt (n,); rounding never carries it over a limit."""

    def notes(self, robot: Robot) -> list[LevelDiagnostics]:
        """Deprecated name of diagnostics."""

    def reset(self) -> None:
        """At rest, cold."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def set_stack(
        self,
        stack: Stack
        | collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ],
    ) -> None:
        """Takes over another stack, or what Stack takes; keeps its tasks alive. The one that it has already changes nothing."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def step(self, robot: Robot) -> NDArray[np.float64]:
        """compute, integrate and set_configuration in one: the robot moves by one dt.

        Args:
          robot: Robot at the reference configuration q*; it ends at the next one.

        Returns:
          q* (n,) [rad] or [m], one dt later. Releases the interpreter lock."""

    def take_over(self, previous: ArrayLike) -> None:
        """Goes on at the velocity of another controller of the same robot, with a transition.

        Args:
          previous: VelocityController that was in command."""

    @property
    def active_limits(self) -> NDArray[np.int32]:
        """(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one"""

    @property
    def hierarchy(self) -> list[Level]:
        """list of Level, of the last compute"""

    @property
    def options(self) -> VelocityControllerOptions: ...
    @property
    def solution(self) -> ControlSolution:
        """ControlSolution, of the last compute"""

    @property
    def stack(self) -> str:
        """'joint < hpos < ...'"""

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n,) [rad/s] or [m/s], the last qdot*"""

class AccelerationControllerOptions:
    """Options of the acceleration controller.

    Args:
      dt: [s] control period.
      stiffness: [1/s^2] K on errors.
      damping: [1/s] L on their rates; 2 sqrt(K) is critical.
      horizon: [s] a position limit is approached no faster than distance / horizon.
      max_acceleration: [rad/s^2] of every coordinate, inf for none.
      return_speed: [rad/s] at which a coordinate outside its limits is driven back.
      rest: [1/s] rate at which weak and free directions brake; 0: they keep their speed.
      friction: share of the model's dry friction (0 to 1) that torques add, in the direction of the
        velocity that the levels want.
      law: "arrive" or "thesis", see VelocityControllerOptions; the speed that an error asks for is
        stiffness / damping times it. "thesis" wants rest=0 and SolverOptions(handover="smooth").
      solver: SolverOptions."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> AccelerationControllerOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> AccelerationControllerOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        dt: float = 0.001,
        stiffness: float = 100.0,
        damping: float = 20.0,
        horizon: float = 0.05,
        max_acceleration: float = 20.0,
        enforce_limits: bool = True,
        return_speed: float = 0.2,
        rest: float = 10.0,
        friction: float = 1.0,
        law: str = "arrive",
        solver: SolverOptions = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def damping(self) -> float:
        """[1/s]"""

    @damping.setter
    def damping(self, arg0: float) -> None: ...
    @property
    def dt(self) -> float:
        """[s]"""

    @dt.setter
    def dt(self, arg0: float) -> None: ...
    @property
    def enforce_limits(self) -> bool:
        """limits before all levels"""

    @enforce_limits.setter
    def enforce_limits(self, arg0: bool) -> None: ...
    @property
    def friction(self) -> float:
        """share of the model's dry friction in torque"""

    @friction.setter
    def friction(self, arg0: float) -> None: ...
    @property
    def horizon(self) -> float:
        """[s]"""

    @horizon.setter
    def horizon(self, arg0: float) -> None: ...
    @property
    def law(self) -> str:
        """'arrive' or 'thesis'"""

    @law.setter
    def law(self, arg1: str) -> None: ...
    @property
    def max_acceleration(self) -> float:
        """[rad/s^2]"""

    @max_acceleration.setter
    def max_acceleration(self, arg0: float) -> None: ...
    @property
    def rest(self) -> float:
        """[1/s]"""

    @rest.setter
    def rest(self, arg0: float) -> None: ...
    @property
    def return_speed(self) -> float:
        """[rad/s]"""

    @return_speed.setter
    def return_speed(self, arg0: float) -> None: ...
    @property
    def solver(self) -> SolverOptions:
        """SolverOptions"""

    @solver.setter
    def solver(self, arg0: SolverOptions) -> None: ...
    @property
    def stiffness(self) -> float:
        """[1/s^2]"""

    @stiffness.setter
    def stiffness(self, arg0: float) -> None: ...

class AccelerationController:
    """From a stack to accelerations: second-order closed-loop inverse kinematics.

    Integrated for joint servos (step), or turned into torques by inverse dynamics (torque).

    Args:
      robot: Robot that the tasks were made for.
      options: AccelerationControllerOptions.

    Raises:
      Error: gains too high for dt, or an option out of range."""

    def __init__(self, robot: Robot, options: AccelerationControllerOptions = ...) -> None: ...
    def compute(self, robot: Robot) -> NDArray[np.float64]:
        """Measures the tasks at the robot, builds the hierarchy, solves it.

        Args:
          robot: Robot at the configuration (and velocity) to start from.

        Returns:
          qddot* (n,) [rad/s^2] or [m/s^2]. Releases the interpreter lock."""

    def contact_force(self, contact: Task) -> NDArray[np.float64]:
        """F (3,) [N] in W on the robot at a ContactTask of the stack, of the last solution."""

    def diagnostics(self, robot: Robot) -> list[LevelDiagnostics]:
        """What each level fell short of at the last compute, and why.

        Args:
          robot: Robot as it was at compute.

        Returns:
          list of LevelDiagnostics, decreasing priority."""

    def notes(self, robot: Robot) -> list[LevelDiagnostics]:
        """Deprecated name of diagnostics."""

    def reset(self) -> None:
        """At rest, cold."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def set_stack(
        self,
        stack: Stack
        | collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ],
    ) -> None:
        """Takes over another stack, or what Stack takes; keeps its tasks alive. The one that it has already changes nothing."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def step(self, robot: Robot) -> NDArray[np.float64]:
        """compute, then moves the robot by one dt along qddot*.

        Args:
          robot: Robot at the reference configuration and velocity; it ends at the next ones.

        Returns:
          q* (n,) [rad] or [m], one dt later; the velocity is robot.velocity. Releases the interpreter lock."""

    def torque(self, robot: Robot) -> NDArray[np.float64]:
        """What the drives must give for the last qddot*, by inverse dynamics.

        Args:
          robot: Robot as it was at compute.

        Returns:
          (n,) [N m] or [N]."""

    @property
    def acceleration(self) -> NDArray[np.float64]:
        """(n,) [rad/s^2] or [m/s^2], the last qddot*"""

    @property
    def active_limits(self) -> NDArray[np.int32]:
        """(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one"""

    @property
    def hierarchy(self) -> list[Level]:
        """list of Level, of the last compute"""

    @property
    def options(self) -> AccelerationControllerOptions: ...
    @property
    def solution(self) -> ControlSolution:
        """ControlSolution, of the last compute"""

    @property
    def stack(self) -> str:
        """'joint < hpos < ...'"""

    @property
    def velocity(self) -> NDArray[np.float64]:
        """(n,) [rad/s] or [m/s], qdot that the last qddot* leads to in a period"""

class Posture:
    """What `inverse_kinematics` found. An array too: its configuration, as a PostureTask takes it."""

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any: ...
    def __getstate__(
        self,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], float, bool, int, int]: ...
    def __setstate__(self, arg0: tuple[Any, ...]) -> None: ...
    @property
    def configuration(self) -> NDArray[np.float64]:
        """(n,) [rad] or [m] of the robot, within its limits"""

    @property
    def error(self) -> float:
        """[m or rad] the largest that any row of a task lacks"""

    @property
    def qpos(self) -> NDArray[np.float64]:
        """(nq,) the whole of it, for `Robot.set_qpos`: joints that close loops may stand in more than one way at the same configuration"""

    @property
    def reached(self) -> bool:
        """no row lacks more than the tolerance"""

    @property
    def starts(self) -> tuple[int, int]:
        """(begun, reached): how many descents began, and how many of them reached"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class Detour:
    """The detour of a loop that asks controllers of its own; `hurcules.Detour` says what it does."""

    def __init__(
        self,
        robot: Robot,
        before: Stack
        | collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ],
        targets: Stack
        | collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ],
        below: Stack
        | collections.abc.Iterable[
            Task
            | JointLimits
            | StackLevel
            | collections.abc.Iterable[Task | JointLimits | StackLevel]
        ] = (),
        *,
        starts: int = 32,
        seed: int = 0,
        tolerance: float = 0.001,
        nearer: float = 0.02,
        rate: float = 5000.0,
    ) -> None: ...
    def look_at(self, robot: Robot, velocity: ArrayLike, dt: float) -> bool:
        """Looks at the robot after a tick; as `hurcules.Detour.look`.

        Args:
          robot: Robot at the reference.
          velocity: (n,) [rad/s] of the reference.
          dt: [s] since the last look.

        Returns:
          True where from now on the other stack shall rule: stacks["detour"] if on_the_way, else stacks["direct"]."""

    def reset(self) -> None:
        """The direct stack rules, as at the start."""

    @property
    def decision(self) -> str:
        """what the last look decided, in words; '' where all goes on"""

    @property
    def on_the_way(self) -> bool:
        """the posture rules"""

    @property
    def posture(self) -> PostureTask:
        """PostureTask of the way; set_max_speed bounds its speed"""

    @property
    def stacks(self) -> dict[str, Stack]:
        """by name those of a controller: 'direct' rules at the start, 'detour' on the way"""

class JointPidOptions:
    """Gains of the joint servo, (m,) each.

    Args:
      K: [N m s/rad] > 0, state weight.
      K_P: [1/s] > 0.
      K_I: [1/s^2] > 0, K_P^2 > 2 K_I.
      max_torque: [N m] > 0, inf for none.
      gamma: > 0, L2 gain from disturbance to error.
      dt: [s]."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> JointPidOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> JointPidOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        K: ArrayLike,
        K_P: ArrayLike,
        K_I: ArrayLike,
        max_torque: ArrayLike,
        gamma: float = 1.0,
        dt: float = 0.001,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def K(self) -> NDArray[np.float64]:
        """(m,) [N m s/rad]"""

    @K.setter
    def K(self, arg0: ArrayLike) -> None: ...
    @property
    def K_I(self) -> NDArray[np.float64]:
        """(m,) [1/s^2]"""

    @K_I.setter
    def K_I(self, arg0: ArrayLike) -> None: ...
    @property
    def K_P(self) -> NDArray[np.float64]:
        """(m,) [1/s]"""

    @K_P.setter
    def K_P(self, arg0: ArrayLike) -> None: ...
    @property
    def dt(self) -> float:
        """[s]"""

    @dt.setter
    def dt(self, arg0: float) -> None: ...
    @property
    def gamma(self) -> float: ...
    @gamma.setter
    def gamma(self, arg0: float) -> None: ...
    @property
    def max_torque(self) -> NDArray[np.float64]:
        """(m,) [N m]"""

    @max_torque.setter
    def max_torque(self, arg0: ArrayLike) -> None: ...

class JointPid:
    """Inverse-optimal joint servo with torque limits and anti-windup:

    tau = (K + 1 / gamma^2) (de/dt + K_P e + K_I int e dt),  e = q_d - q

    Args:
      options: JointPidOptions.

    Raises:
      Error: sizes that differ, or gains outside the conditions of JointPidOptions."""

    def __init__(self, options: JointPidOptions) -> None: ...
    def compute(self, position: ArrayLike, velocity: ArrayLike) -> NDArray[np.float64]:
        """Torque (m,) [N m] for this tick.

        Args:
          position: e = q_d - q (m,) [rad].
          velocity: de/dt (m,) [rad/s]."""

    def reset(self) -> None:
        """At rest, without memory."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    @property
    def demand(self) -> NDArray[np.float64]:
        """(m,) [N m], before saturation"""

    @property
    def integral(self) -> NDArray[np.float64]:
        """(m,) [rad s]"""

    @property
    def options(self) -> JointPidOptions: ...
    @property
    def torque(self) -> NDArray[np.float64]:
        """(m,) [N m], of the last compute"""

class SpeedLimits:
    """How fast a commanded speed may change.

    Args:
      acceleration: > 0, [m/s^2] or [rad/s^2].
      jerk: > 0, [m/s^3] or [rad/s^3]."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> SpeedLimits: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SpeedLimits: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(self, acceleration: float, jerk: float) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def acceleration(self) -> float:
        """[m/s^2] or [rad/s^2]"""

    @acceleration.setter
    def acceleration(self, arg0: float) -> None: ...
    @property
    def jerk(self) -> float:
        """[m/s^3] or [rad/s^3]"""

    @jerk.setter
    def jerk(self, arg0: float) -> None: ...

class ParkingOptions:
    """How a robot parks: turn, drive, turn, run in.

    Args:
      speed: [m/s] at most.
      yaw_rate: [rad/s] at most, turning in place.
      deceleration: [m/s^2] towards the end of a line.
      turn_centre: [m] forward of the pose's origin: what turns in place are about.
      run_in: [m] driven along the goal's own line at the end.
      line_gain: [rad/m] heading against an offset from a line.
      heading_gain: [1/s] yaw rate against a heading error.
      max_offset: [m] of the turning centre at the end.
      max_turn: [rad] of the heading at the end.
      attempts: run-ins at most.
      patience: times what a turn or a line takes at full speed, and 5 s on top; then parking has failed."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> ParkingOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> ParkingOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        speed: float = 0.5,
        yaw_rate: float = 0.5,
        deceleration: float = 0.25,
        turn_centre: float = -0.4,
        run_in: float = 1.0,
        line_gain: float = 2.5,
        heading_gain: float = 2.0,
        max_offset: float = 0.02,
        max_turn: float = 0.02,
        attempts: int = 4,
        patience: float = 3.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def attempts(self) -> int: ...
    @attempts.setter
    def attempts(self, arg0: int) -> None: ...
    @property
    def deceleration(self) -> float:
        """[m/s^2]"""

    @deceleration.setter
    def deceleration(self, arg0: float) -> None: ...
    @property
    def heading_gain(self) -> float:
        """[1/s]"""

    @heading_gain.setter
    def heading_gain(self, arg0: float) -> None: ...
    @property
    def line_gain(self) -> float:
        """[rad/m]"""

    @line_gain.setter
    def line_gain(self, arg0: float) -> None: ...
    @property
    def max_offset(self) -> float:
        """[m]"""

    @max_offset.setter
    def max_offset(self, arg0: float) -> None: ...
    @property
    def max_turn(self) -> float:
        """[rad]"""

    @max_turn.setter
    def max_turn(self, arg0: float) -> None: ...
    @property
    def patience(self) -> float: ...
    @patience.setter
    def patience(self, arg0: float) -> None: ...
    @property
    def run_in(self) -> float:
        """[m]"""

    @run_in.setter
    def run_in(self, arg0: float) -> None: ...
    @property
    def speed(self) -> float:
        """[m/s]"""

    @speed.setter
    def speed(self, arg0: float) -> None: ...
    @property
    def turn_centre(self) -> float:
        """[m]"""

    @turn_centre.setter
    def turn_centre(self, arg0: float) -> None: ...
    @property
    def yaw_rate(self) -> float:
        """[rad/s]"""

    @yaw_rate.setter
    def yaw_rate(self, arg0: float) -> None: ...

class DriveOptions:
    """Options of the drive controller.

    Args:
      dt: [s] control period.
      radius: [m] belt speed over belt rate.
      gauge: [m] between the middles of the driven tracks.
      mass: [kg] for the feed-forward of acceleration, 0 for none.
      max_torque: [N m] of one drive.
      max_power: [W] of one drive, driving.
      max_braking_power: [W] of one drive, braking: where a transmission lets less torque through at speed.
      max_speed: [m/s] of a belt.
      max_yaw_rate: [rad/s].
      max_sideways: [m/s^2] speed times yaw rate; who is to turn sharper slows down.
      forward: SpeedLimits [m/s^2, m/s^3].
      turning: SpeedLimits [rad/s^2, rad/s^3].
      gain: [N m s/rad] belt rate to torque.
      integral_gain: [N m/rad].
      speed_gain: share of a speed error that is added to what the belts are asked for.
      yaw_gain: share of a yaw rate error that is added to what the belts are asked for.
      yaw_integral_gain: [1/s].
      slip_speed: [m/s] by which a belt may slip.
      slip_ratio: share of the ground speed by which it may slip on top.
      standstill_time: [s] without motion before the brakes close.
      brake_time: [s] for which the drives hold on until the brakes are shut.
      parking: ParkingOptions.

    Numbers out of range are refused by DriveController."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> DriveOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> DriveOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        dt: float = 0.001,
        radius: float = 0.14,
        gauge: float = 0.67,
        mass: float = 680.0,
        max_torque: float = 600.0,
        max_power: float = 7950.0,
        max_braking_power: float = 1000000.0,
        max_speed: float = 5.56,
        max_yaw_rate: float = 1.5,
        max_sideways: float = 2.5,
        forward: SpeedLimits = ...,
        turning: SpeedLimits = ...,
        gain: float = 300.0,
        integral_gain: float = 900.0,
        speed_gain: float = 1.0,
        yaw_gain: float = 1.0,
        yaw_integral_gain: float = 2.0,
        slip_speed: float = 0.2,
        slip_ratio: float = 0.1,
        standstill_time: float = 0.2,
        brake_time: float = 0.1,
        parking: ParkingOptions = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def brake_time(self) -> float:
        """[s]"""

    @brake_time.setter
    def brake_time(self, arg0: float) -> None: ...
    @property
    def dt(self) -> float:
        """[s]"""

    @dt.setter
    def dt(self, arg0: float) -> None: ...
    @property
    def forward(self) -> SpeedLimits:
        """SpeedLimits"""

    @forward.setter
    def forward(self, arg0: SpeedLimits) -> None: ...
    @property
    def gain(self) -> float:
        """[N m s/rad]"""

    @gain.setter
    def gain(self, arg0: float) -> None: ...
    @property
    def gauge(self) -> float:
        """[m]"""

    @gauge.setter
    def gauge(self, arg0: float) -> None: ...
    @property
    def integral_gain(self) -> float:
        """[N m/rad]"""

    @integral_gain.setter
    def integral_gain(self, arg0: float) -> None: ...
    @property
    def mass(self) -> float:
        """[kg]"""

    @mass.setter
    def mass(self, arg0: float) -> None: ...
    @property
    def max_braking_power(self) -> float:
        """[W]"""

    @max_braking_power.setter
    def max_braking_power(self, arg0: float) -> None: ...
    @property
    def max_power(self) -> float:
        """[W]"""

    @max_power.setter
    def max_power(self, arg0: float) -> None: ...
    @property
    def max_sideways(self) -> float:
        """[m/s^2]"""

    @max_sideways.setter
    def max_sideways(self, arg0: float) -> None: ...
    @property
    def max_speed(self) -> float:
        """[m/s]"""

    @max_speed.setter
    def max_speed(self, arg0: float) -> None: ...
    @property
    def max_torque(self) -> float:
        """[N m]"""

    @max_torque.setter
    def max_torque(self, arg0: float) -> None: ...
    @property
    def max_yaw_rate(self) -> float:
        """[rad/s]"""

    @max_yaw_rate.setter
    def max_yaw_rate(self, arg0: float) -> None: ...
    @property
    def parking(self) -> ParkingOptions:
        """ParkingOptions"""

    @parking.setter
    def parking(self, arg0: ParkingOptions) -> None: ...
    @property
    def radius(self) -> float:
        """[m]"""

    @radius.setter
    def radius(self, arg0: float) -> None: ...
    @property
    def slip_ratio(self) -> float: ...
    @slip_ratio.setter
    def slip_ratio(self, arg0: float) -> None: ...
    @property
    def slip_speed(self) -> float:
        """[m/s]"""

    @slip_speed.setter
    def slip_speed(self, arg0: float) -> None: ...
    @property
    def speed_gain(self) -> float: ...
    @speed_gain.setter
    def speed_gain(self, arg0: float) -> None: ...
    @property
    def standstill_time(self) -> float:
        """[s]"""

    @standstill_time.setter
    def standstill_time(self, arg0: float) -> None: ...
    @property
    def turning(self) -> SpeedLimits:
        """SpeedLimits"""

    @turning.setter
    def turning(self, arg0: SpeedLimits) -> None: ...
    @property
    def yaw_gain(self) -> float: ...
    @yaw_gain.setter
    def yaw_gain(self, arg0: float) -> None: ...
    @property
    def yaw_integral_gain(self) -> float:
        """[1/s]"""

    @yaw_integral_gain.setter
    def yaw_integral_gain(self, arg0: float) -> None: ...

class ParkingPhase(_Enum):
    """Where a parking robot is; Off: none was asked for."""

    Align: ClassVar[ParkingPhase]
    Approach: ClassVar[ParkingPhase]
    Done: ClassVar[ParkingPhase]
    Face: ClassVar[ParkingPhase]
    Failed: ClassVar[ParkingPhase]
    Off: ClassVar[ParkingPhase]
    RunIn: ClassVar[ParkingPhase]
    __members__: ClassVar[dict[str, ParkingPhase]]

class DriveController:
    """Drives a robot on two tracks by speed and yaw rate, or to a pose.

    Speeds follow their commands with limited acceleration and jerk; a belt that slips is held back; the
    effective gauge of skid steering is learnt from the gyro. At standstill the brakes close.

    Args:
      options: DriveOptions.

    Raises:
      Error: an option out of range."""

    def __init__(self, options: DriveOptions = ...) -> None: ...
    def compute(
        self,
        left: float,
        right: float,
        yaw_rate: float,
        speed: float,
        pose: collections.abc.Sequence[float] | None = None,
    ) -> list[float]:
        """One control period.

        Args:
          left: [rad/s] rate of the left driven belt, > 0 forward.
          right: [rad/s] of the right one.
          yaw_rate: [rad/s] of the gyro about the vertical, > 0 to the left.
          speed: [m/s] along the ground, up and down slopes too, by heading.
          pose: (x, y, yaw) [m, m, rad]; wanted while the robot parks.

        Returns:
          (left, right) torques of the drives [N m]; see also `braked`.

        Raises:
          Error: a measurement is not finite, or the pose is missing."""

    def drive(self, speed: float, yaw_rate: float = 0.0) -> None:
        """Drives like this from now on, ends parking.

        Args:
          speed: [m/s] forward; beyond max_speed it is held there.
          yaw_rate: [rad/s] to the left; beyond max_yaw_rate it is held there.

        Raises:
          Error: a number is not finite."""

    def park(self, x: float, y: float, yaw: float) -> None:
        """Goes to this pose and stays there, brakes shut.

        Args:
          x: [m] of the pose's origin in the world.
          y: [m].
          yaw: [rad] of the heading from x towards y.

        Raises:
          Error: a number is not finite."""

    def reset(self) -> None:
        """Stands, braked, knows nothing of the ground."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    @property
    def braked(self) -> bool:
        """whether the brakes of both drives are to be shut"""

    @property
    def gauge(self) -> float:
        """[m] effective, as estimated"""

    @property
    def options(self) -> DriveOptions: ...
    @property
    def parking_phase(self) -> ParkingPhase: ...
    @property
    def reference(self) -> list[float]:
        """(2,) speed [m/s] and yaw rate [rad/s] of the moment"""

    @property
    def slipping(self) -> bool:
        """whether a belt was held back in the last period"""

class DriveState:
    """What the drive controller measures."""

    @property
    def left(self) -> float:
        """[rad/s] of the driven belt, > 0 forward"""

    @property
    def pose(self) -> list[float]:
        """(x, y, yaw) of the root [m, m, rad]"""

    @property
    def right(self) -> float:
        """[rad/s]"""

    @property
    def speed(self) -> float:
        """[m/s] along the ground, up and down slopes too, by heading"""

    @property
    def yaw_rate(self) -> float:
        """[rad/s] about the vertical"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class TrackDrive:
    """What the drive controller of a robot measures, from its joints and its root.

    Args:
      robot: Robot with a free joint at its root.
      options: DriveOptions.
      left: joint of the left driven belt.
      right: of the right one.

    Raises:
      Error: a belt without an actuator, a robot without a free root, or an option out of range."""

    def __init__(
        self,
        robot: Robot,
        options: DriveOptions = ...,
        left: str = "L_lower_belt",
        right: str = "R_lower_belt",
    ) -> None: ...
    def measure(self, qpos: ArrayLike, qvel: ArrayLike) -> DriveState:
        """What belts, gyro and localisation tell.

        Args:
          qpos: (nq,) of the model.
          qvel: (nv,) of the model.

        Raises:
          Error: arrays of another size."""

    @property
    def controller(self) -> DriveController: ...

class Channel:
    """What a command moves; see Twist and the others."""

    @property
    def scale(self) -> NDArray[np.float64]: ...
    @property
    def task(self) -> Any: ...
    def __init__(self, *args: object, **kwargs: object) -> None: ...

class WholeBodyController:
    """The controller of a whole robot: named commands in, controls of the actuators out.

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
      Error: no level, an unknown name, a joint that cannot be servoed; the text says which."""

    def __init__(
        self,
        robot: Robot,
        levels: Any | None = None,
        channels: dict[str, Any] = {},
        *,
        stacks: dict[str, Any] = {},
        control: str = "velocity",
        dt: float | None = None,
        base: str = "held",
        support: str = "",
        servo: collections.abc.Mapping[str, tuple[float, float]] = {},
        feed_forward: bool = True,
        decoupled: bool | None = None,
        torque_scaling: bool = True,
        drive: DriveOptions | None = None,
        belts: tuple[str, str] = ("L_lower_belt", "R_lower_belt"),
        velocity: VelocityControllerOptions | None = None,
        acceleration: AccelerationControllerOptions | None = None,
        torque: AccelerationControllerOptions | None = None,
    ) -> None: ...
    def __repr__(self) -> str: ...
    def contact_force(self, contact: str) -> NDArray[np.float64]:
        """F (3,) [N] in W on the robot at a ContactTask of the stack that rules, as it was wanted last."""

    def diagnostics(self) -> list[LevelDiagnostics]:
        """What each level falls short of and why, targets that gave way to torques too: list of LevelDiagnostics, decreasing priority."""

    def hold_targets(self) -> None:
        """The targets of all tasks come to where the plan is."""

    def move(self, joint: str, position: float, velocity: float = 0.0) -> None:
        """Where a joint shall be from now on; no stack rules until `use`.

        Joints that a stack left in motion stop within the acceleration limit.

        Args:
          joint: name of a joint with an actuator.
          position: [rad] or [m]; beyond the joint's range it squeezes, as a finger does.
          velocity: [rad/s] or [m/s] there, fed forward. No bound of how fast it goes: to a place that is far
            off it goes as fast as its motor can.

        Raises:
          Error: no such joint, or numbers that are not finite."""

    def move_all(self, positions: ArrayLike, velocities: ArrayLike) -> None:
        """The same for all joints with a servo, in the order of `joints`.

        Args:
          positions: (m,) [rad] or [m].
          velocities: (m,) [rad/s] or [m/s]."""

    def move_joints(self) -> None:
        """No stack rules until `use`: joints stop within the acceleration limit, and stay; JointRates moves them."""

    def reset(self, qpos: ArrayLike | None = None) -> None:
        """Starts anew at rest: the first stack rules, all targets go to where the robot is.

        Args:
          qpos: (nq,) of the whole model; None: where the plan is.

        Raises:
          Error: another shape, or numbers that are not finite."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def sense(
        self, task: ForceTask, source: Any, row: int | None = None, sign: float | None = None
    ) -> None:
        """What a force task reads, each tick.

        Args:
          task: ForceTask of the controller.
          source: SpringForce, or the name of a sensor of the model.
          row: of the sensor; None: of a force sensor the part along the task's axis, however hand and axis
            are turned, else row 0.
          sign: of the sensor: its reading times this is what the robot exerts along the task's axis. Without
            a row 1 is right for a force sensor on the body of the tool.

        Raises:
          Error: an unknown sensor, a task that is in no stack of the controller, or a sign of 0."""

    def stand_on(self, body: str) -> None:
        """The plan stands on another body, where it is now.

        What the plan takes is told anew, the integrals of the servos take over the difference: no torque
        jumps (of decoupled servos it may). It holds until a reset.

        Args:
          body: of the robot, with a free root.

        Raises:
          Error: no such body."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def task(self, name: str) -> Task:
        """A task of its stacks, by name. Raises Error with the names that exist."""

    def tick(
        self,
        qpos: ArrayLike,
        qvel: ArrayLike,
        command: collections.abc.Mapping[str, ArrayLike] | ArrayLike | None = None,
        *,
        sensors: ArrayLike | None = None,
        first: bool = True,
    ) -> NDArray[np.float64]:
        """One tick of a loop of your own: a robot on the bench, or a simulator beside this one.

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
            reading, or the robot was moved or not heard of for long (`reset`). Nothing has changed then."""

    def use(self, stack: str) -> None:
        """Lets another stack rule from the next tick on.

        The velocity goes on within the acceleration limit, the servos keep their integrals. After joints
        were moved one by one, all targets come to where the plan is.

        Args:
          stack: its name.

        Raises:
          Error: an unknown name, with those that exist."""

    @property
    def active(self) -> str | None:
        """the stack that rules; None while joints are moved"""

    @property
    def active_limits(self) -> NDArray[np.int32]:
        """(n,) -1, 0, 1: held back by its lower position limit, by none, by its upper one"""

    @property
    def channels(self) -> list[tuple[str, int]]:
        """list of (name, number of values)"""

    @property
    def command(self) -> NDArray[np.float64]:
        """(k,) what it did in the last tick, as held to scale: 0 for nothing, of Target and ForceReference NaN; given again tick by tick it gives the same bits"""

    @property
    def command_names(self) -> list[str]:
        """(k,) of all values of all channels"""

    @property
    def command_scale(self) -> NDArray[np.float64]:
        """(k,) SI"""

    @property
    def demand(self) -> NDArray[np.float64]:
        """(m,) the same before saturation"""

    @property
    def drive(self) -> DriveController:
        """DriveController of the tracks, None without"""

    @property
    def dt(self) -> float:
        """[s]"""

    @property
    def joint_error(self) -> NDArray[np.float64]:
        """(m,) [rad] or [m] place minus sensed"""

    @property
    def joint_places(self) -> NDArray[np.float64]:
        """(m,) [rad] or [m] where the servos hold them"""

    @property
    def joints(self) -> list[str]:
        """(m,) joints with a servo"""

    @property
    def plan(self) -> Robot:
        """Robot at the reference; look at it, but do not move it"""

    @property
    def q_des(self) -> NDArray[np.float64]:
        """(n,) [rad] reference"""

    @property
    def qd_des(self) -> NDArray[np.float64]:
        """(n,) [rad/s]"""

    @property
    def scaled(self) -> bool:
        """the last tick was slowed down by what the motors can hold"""

    @property
    def solution(self) -> ControlSolution:
        """ControlSolution, of the last tick"""

    @property
    def stacks(self) -> list[str]:
        """names of the stacks"""

    @property
    def tasks(self) -> list[Task]:
        """the tasks of the stack that rules, in decreasing priority"""

    @property
    def torque(self) -> NDArray[np.float64]:
        """(m,) [N m] or [N] of the servos"""

    @property
    def unfed_forces(self) -> list[str]:
        """Names of the force tasks that no `sense` feeds and that were never told a force."""

    @property
    def unseen_references(self) -> list[tuple[str, str, bool]]:
        """(task, frame, whether by mocap) where a task is measured in a frame that may move and whose motion the plan does not see"""

class Brakes:
    """Magnetic brakes in the drives of the joints: closed they hold without power.

    A brake is dry friction of 1.2 times the motor's peak torque; beyond that it slips. It takes 0.05 s
    to open or close. Made by Plant."""

    def close(self) -> None:
        """All of them."""

    def is_open(self, joint: str) -> bool: ...
    def is_shut(self, joint: str) -> bool: ...
    def load(self, joint: str) -> float:
        """[N m] or [N] that brake and friction bore in the last step, in the joint's direction"""

    def max_load(self, joint: str) -> float:
        """[N m] or [N] at which it slips"""

    def reset(self, closed: bool = False) -> None:
        """All at once and at once shut or open."""

    def set_closed(self, joint: str, closed: bool) -> None:
        """Closes or opens one brake.

        Args:
          joint: name of its joint.
          closed: bool.

        Raises:
          Error: that joint has no brake, with the names that have one."""

    @property
    def names(self) -> list[str]:
        """joints that have a brake"""

    @property
    def power(self) -> float:
        """[W] of the coils of those held open"""

    def __init__(self, *args: object, **kwargs: object) -> None: ...

class Plant:
    """MuJoCo's physics with what the robot adds: traction of tracks, brakes, limits of its drives.

    Controls are written to data.ctrl as ever; the model is left as it is.

    Args:
      model: mujoco.MjModel.
      data: mujoco.MjData of it."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None: ...
    def effort_range(self, joint: str, speed: float) -> tuple[float, float]:
        """What a drive behind its transmission can give, now.

        Args:
          joint: one with a brake and a transmission.
          speed: of the joint [rad/s].

        Returns:
          Lowest and highest torque at the joint [N m]."""

    def ratio(self, joint: str) -> float:
        """The ratio of motor to joint speed in a transmission, now.

        Args:
          joint: one with a brake.

        Returns:
          1 without a transmission."""

    def reset(self, keyframe: str) -> None:
        """Everything at rest in a keyframe, brakes open, time zero.

        Args:
          keyframe: part of its name; the first one that has it.

        Raises:
          Error: none has it, with the names that exist."""

    def restore(self, state: collections.abc.Sequence[float]) -> None:
        """Goes on from what state() gave. Raises Error for a list of another length."""

    def state(self) -> list[float]:
        """What must be kept between ticks, as a flat list; see restore."""

    def step(self, n: int = 1) -> int:
        """Takes n steps of model.opt.timestep.

        MuJoCo's sensors are read in the last one alone.

        Args:
          n: >= 0.

        Returns:
          Steps taken: fewer than n when the state stopped making sense, see is_sound."""

    @property
    def brakes(self) -> Brakes: ...
    @property
    def is_sound(self) -> bool:
        """False once a position, velocity or acceleration was not finite or huge; it then stands still"""

class Condition:
    """A quantity on one side of a value, for some time on end.

    Args:
      quantity: a column of the log (`simulation.channels`), or of the scene: position/OBJECT/x, joint/JOINT, sensor/SENSOR, contact_force/BODY.
      above: the quantity is at least the value; False: at most.
      value: in the unit of the quantity.
      seconds: [s]."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    above: bool
    quantity: str

    @staticmethod
    def read(text: str) -> Condition:
        """Reads "QUANTITY >= 0.3 for 2 s".

        Raises:
          Error: it is none."""

    def __copy__(self) -> Condition: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Condition: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self, *, quantity: str, above: bool = True, value: float = 0.0, seconds: float = 0.0
    ) -> None: ...
    def __repr__(self) -> str: ...
    def words(self) -> str:
        """As text, which reads back as the same, all bits of its numbers."""

    @property
    def seconds(self) -> float: ...
    @seconds.setter
    def seconds(self, arg0: float) -> None: ...
    @property
    def value(self) -> float: ...
    @value.setter
    def value(self, arg0: float) -> None: ...

class Reaction:
    """What a mission does about trouble.

    Args:
      kind: "back" to a phase, "hold" or "ask" for some seconds, "lower" to the way to safety, "abort".
      phase: of "back"; the present one begins anew.
      seconds: [s] of "hold" and "ask".
      times: in a run; then the next reaction in the row."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    kind: str
    phase: str

    @staticmethod
    def read(text: str) -> Reaction:
        """Reads "back to PHASE", "hold 2 s", "ask 30 s", "lower" or "abort", maybe with ", 3 times".

        Raises:
          Error: it is none."""

    def __copy__(self) -> Reaction: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Reaction: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self, *, kind: str = "abort", phase: str = "", seconds: float = 0.0, times: int = 1
    ) -> None: ...
    def __repr__(self) -> str: ...
    def words(self) -> str:
        """As text, which reads back as the same, all bits of its numbers."""

    @property
    def seconds(self) -> float: ...
    @seconds.setter
    def seconds(self, arg0: float) -> None: ...
    @property
    def times(self) -> int: ...
    @times.setter
    def times(self, arg0: int) -> None: ...

class Trouble:
    """What must not be, and the reactions to it.

    Args:
      when: Condition.
      reactions: list of Reaction; the first that is left; the last is "lower" or "abort"."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    when: Condition

    def __copy__(self) -> Trouble: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Trouble: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self, *, when: Condition, reactions: collections.abc.Sequence[Reaction]
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def reactions(self) -> list[Reaction]: ...
    @reactions.setter
    def reactions(self, arg0: collections.abc.Sequence[Reaction]) -> None: ...

class Lead:
    """What a phase does to one channel.

    Args:
      channel: of the controller.
      rate: (k,) SI at which it is led, or
      way: until so much has been given [SI s]; inf: on and on.
      by: (k,) the way [SI s] that it is led in the seconds of the phase, smoothly.
      to: look and move: quantities, one an entry of `by` or `value`, that are added to it as they are
        when the phase begins; "" adds nothing.
      hold: a quantity that the rate holds at a value: in full where it is `span` or more below, backwards
        above; "": none.
      at: that value, in the quantity's unit.
      span: in the same unit, above 0.
      value: (k,) what a `Target` or a `ForceReference` is set to, in its unit.
      follow: the quantities of `to` are added to the value as they are now, tick by tick.
      brake: of a channel of joints: once `hold` is at its value their brakes bear it, until it has fallen
        by `span`; then the rate acts in full."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    brake: bool
    channel: str
    follow: bool
    hold: str

    def __copy__(self) -> Lead: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Lead: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        channel: str,
        rate: ArrayLike = ...,
        way: float = ...,
        by: ArrayLike = ...,
        to: collections.abc.Sequence[str] = [],
        hold: str = "",
        at: float = 0.0,
        span: float = 0.0,
        value: ArrayLike = ...,
        follow: bool = False,
        brake: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def at(self) -> float: ...
    @at.setter
    def at(self, arg0: float) -> None: ...
    @property
    def by(self) -> NDArray[np.float64]: ...
    @by.setter
    def by(self, arg0: ArrayLike) -> None: ...
    @property
    def rate(self) -> NDArray[np.float64]: ...
    @rate.setter
    def rate(self, arg0: ArrayLike) -> None: ...
    @property
    def span(self) -> float: ...
    @span.setter
    def span(self, arg0: float) -> None: ...
    @property
    def to(self) -> list[str]: ...
    @to.setter
    def to(self, arg0: collections.abc.Sequence[str]) -> None: ...
    @property
    def value(self) -> NDArray[np.float64]: ...
    @value.setter
    def value(self, arg0: ArrayLike) -> None: ...
    @property
    def way(self) -> float: ...
    @way.setter
    def way(self, arg0: float) -> None: ...

class PostureKey:
    """Angles of coordinates, or places of joints, at a share of a motion.

    Args:
      share: 0 to 1.
      angles: by coordinate [rad], or by joint [rad] or [m]; the others stay as at the beginning."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> PostureKey: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> PostureKey: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self, *, share: float = 1.0, angles: collections.abc.Sequence[tuple[str, float]] = []
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def angles(self) -> list[tuple[str, float]]: ...
    @angles.setter
    def angles(self, arg0: collections.abc.Sequence[tuple[str, float]]) -> None: ...
    @property
    def share(self) -> float: ...
    @share.setter
    def share(self, arg0: float) -> None: ...

class Park:
    """Where a phase parks the robot: its centre of mass, on the ground.

    Args:
      body: from which the pose counts, as it is when the phase begins: ahead along its heading, its y
        axis to its left; "": from where the robot stood as the run began.
      ahead: [m].
      left: [m].
      heading: [rad] to the left.
      speed: [m/s] at most.
      yaw_rate: [rad/s] at most, turning in place."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    body: str

    def __copy__(self) -> Park: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Park: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        body: str = "",
        ahead: float = 0.0,
        left: float = 0.0,
        heading: float = 0.0,
        speed: float = 0.5,
        yaw_rate: float = 0.5,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def ahead(self) -> float: ...
    @ahead.setter
    def ahead(self, arg0: float) -> None: ...
    @property
    def heading(self) -> float: ...
    @heading.setter
    def heading(self, arg0: float) -> None: ...
    @property
    def left(self) -> float: ...
    @left.setter
    def left(self, arg0: float) -> None: ...
    @property
    def speed(self) -> float: ...
    @speed.setter
    def speed(self, arg0: float) -> None: ...
    @property
    def yaw_rate(self) -> float: ...
    @yaw_rate.setter
    def yaw_rate(self, arg0: float) -> None: ...

class Phase:
    """One row of a mission's table.

    Args:
      name: of the row.
      stack: of the controller, which rules, or "joints": none rules, joints are moved one by one.
      seconds: [s] that ways and postures take, the least duration.
      leads: list of Lead; channels that are not led hold.
      support: body that the robot stands on from here on; "": that of the row before.
      brakes: joints that rest behind their brakes in this phase, "SP" both; all others are open.
      posture: channel of a PostureTask over all coordinates; of the stack "joints" a JointRates.
      keys: list of PostureKey, where it leads to.
      park: Park, or None: drives there; where that fails, what is done when it takes too long.
      done: list of Condition, all of them, when all motions have ended.
      within: [s].
      late: list of Reaction, when it takes longer.
      troubles: list of Trouble.
      note: what it is for, in words: for the printed table and the film.
      next: name of the phase that it goes on to; "": the one below.
      last: the run is over after it; what follows is only reached from elsewhere."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    last: bool
    name: str
    next: str
    note: str
    park: Park | None
    posture: str
    stack: str
    support: str

    def __copy__(self) -> Phase: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Phase: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        name: str,
        stack: str,
        seconds: float = 0.0,
        leads: collections.abc.Sequence[Lead] = [],
        posture: str = "",
        keys: collections.abc.Sequence[PostureKey] = [],
        done: collections.abc.Sequence[Condition] = [],
        within: float = ...,
        late: collections.abc.Sequence[Reaction] = [],
        troubles: collections.abc.Sequence[Trouble] = [],
        support: str = "",
        brakes: collections.abc.Sequence[str] = [],
        park: Park | None = None,
        note: str = "",
        next: str = "",
        last: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def brakes(self) -> list[str]: ...
    @brakes.setter
    def brakes(self, arg0: collections.abc.Sequence[str]) -> None: ...
    @property
    def done(self) -> list[Condition]: ...
    @done.setter
    def done(self, arg0: collections.abc.Sequence[Condition]) -> None: ...
    @property
    def keys(self) -> list[PostureKey]: ...
    @keys.setter
    def keys(self, arg0: collections.abc.Sequence[PostureKey]) -> None: ...
    @property
    def late(self) -> list[Reaction]: ...
    @late.setter
    def late(self, arg0: collections.abc.Sequence[Reaction]) -> None: ...
    @property
    def leads(self) -> list[Lead]: ...
    @leads.setter
    def leads(self, arg0: collections.abc.Sequence[Lead]) -> None: ...
    @property
    def seconds(self) -> float: ...
    @seconds.setter
    def seconds(self, arg0: float) -> None: ...
    @property
    def troubles(self) -> list[Trouble]: ...
    @troubles.setter
    def troubles(self, arg0: collections.abc.Sequence[Trouble]) -> None: ...
    @property
    def within(self) -> float: ...
    @within.setter
    def within(self, arg0: float) -> None: ...

class Measure:
    """A figure of a run: a quantity over some phases.

    Args:
      name: of the figure, with its unit.
      quantity: a column of the log (`simulation.channels`), or of the scene as in Condition.
      take: "largest", "smallest", "span" (largest less smallest) or "last".
      phases: list of names, none: all.
      least: below, the mission failed.
      most: above, the mission failed."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    name: str
    quantity: str
    take: str

    def __copy__(self) -> Measure: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> Measure: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        name: str,
        quantity: str,
        take: str = "last",
        phases: collections.abc.Sequence[str] = [],
        least: float = ...,
        most: float = ...,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def least(self) -> float: ...
    @least.setter
    def least(self, arg0: float) -> None: ...
    @property
    def most(self) -> float: ...
    @most.setter
    def most(self, arg0: float) -> None: ...
    @property
    def phases(self) -> list[str]: ...
    @phases.setter
    def phases(self, arg0: collections.abc.Sequence[str]) -> None: ...

class MissionTable:
    """A mission as data.

    Args:
      phases: list of Phase, in their order.
      safety: name of the phase that "lower" goes to.
      measures: list of Measure."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    safety: str

    def __copy__(self) -> MissionTable: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> MissionTable: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        phases: collections.abc.Sequence[Phase],
        safety: str = "",
        measures: collections.abc.Sequence[Measure] = [],
    ) -> None: ...
    def __repr__(self) -> str: ...
    def text(self) -> str:
        """The table as text: a line a phase, note, conditions and reactions below."""

    @property
    def measures(self) -> list[Measure]: ...
    @measures.setter
    def measures(self, arg0: collections.abc.Sequence[Measure]) -> None: ...
    @property
    def phases(self) -> list[Phase]: ...
    @phases.setter
    def phases(self, arg0: collections.abc.Sequence[Phase]) -> None: ...

class MissionSetup:
    """What a mission wants of its run.

    Args:
      name: of the mission.
      support: body that the robot stands on.
      max_seconds: [s] it fails when it takes longer.
      min_height: [m] of `fall_frame` above the support; below, the robot fell.
      max_tilt: [rad] of the support against its start; above, the robot fell. 0: nobody looks.
      fall_frame: body or site whose height is watched; "": none is, `max_tilt` alone tells.
      casualty: what stands before the names of the person to watch, "" for nobody.
      stand_off: [m] of the robot's centre of mass from the person's where it stands square to the body;
        from the centre of the load likewise.
      load: body of a thing to carry, with sites LOAD_left and LOAD_right to grasp; "" for none.
      container: body of what it is put into, "" for none.
      container_stand: [m] of the robot's centre of mass from its centre where it stands square to it."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    casualty: str
    container: str
    fall_frame: str
    load: str
    name: str
    support: str

    def __copy__(self) -> MissionSetup: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> MissionSetup: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        name: str,
        support: str = "",
        max_seconds: float = ...,
        min_height: float = 0.0,
        max_tilt: float = 0.0,
        fall_frame: str = "",
        casualty: str = "",
        stand_off: float = 0.0,
        load: str = "",
        container: str = "",
        container_stand: float = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def container_stand(self) -> float: ...
    @container_stand.setter
    def container_stand(self, arg0: float) -> None: ...
    @property
    def max_seconds(self) -> float: ...
    @max_seconds.setter
    def max_seconds(self, arg0: float) -> None: ...
    @property
    def max_tilt(self) -> float: ...
    @max_tilt.setter
    def max_tilt(self, arg0: float) -> None: ...
    @property
    def min_height(self) -> float: ...
    @min_height.setter
    def min_height(self, arg0: float) -> None: ...
    @property
    def stand_off(self) -> float: ...
    @stand_off.setter
    def stand_off(self, arg0: float) -> None: ...

class SensorModel:
    """How a sensor departs from the truth; all zero: not at all, to the last bit.

    Args:
      noise: standard deviation of each sample, in the unit of the sensor.
      bias: standard deviation of a constant that is drawn at the start.
      drift: of a bias that walks, its standard deviation after 1 s.
      delay: samples, 0 to 1000.
      step: of the last bit; 0 is as fine as a double."""

    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __copy__(self) -> SensorModel: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SensorModel: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        noise: float = 0.0,
        bias: float = 0.0,
        drift: float = 0.0,
        delay: int = 0,
        step: float = 0.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def bias(self) -> float: ...
    @bias.setter
    def bias(self, arg0: float) -> None: ...
    @property
    def delay(self) -> int: ...
    @delay.setter
    def delay(self, arg0: int) -> None: ...
    @property
    def drift(self) -> float: ...
    @drift.setter
    def drift(self, arg0: float) -> None: ...
    @property
    def noise(self) -> float: ...
    @noise.setter
    def noise(self, arg0: float) -> None: ...
    @property
    def step(self) -> float: ...
    @step.setter
    def step(self, arg0: float) -> None: ...

class RangeFinder:
    """A planar laser scanner in the x-y plane of a site; its mirror turns a few rays each tick.

    Args:
      rays: of a scan; 0: there is no scanner.
      period: ticks a scan.
      angle: [rad] field of view about x of the site, at most 2 pi.
      min_range: [m] what is nearer reads 0.
      max_range: [m] what is further reads inf.
      model: SensorModel [m]; its delay in whole scans.
      site: of the model; its own body is not seen."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    model: SensorModel
    site: str

    def __copy__(self) -> RangeFinder: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> RangeFinder: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        rays: int = 0,
        period: int = 25,
        angle: float = 4.71238898038469,
        min_range: float = 0.1,
        max_range: float = 30.0,
        model: SensorModel = ...,
        site: str = "lidar",
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def angle(self) -> float: ...
    @angle.setter
    def angle(self, arg0: float) -> None: ...
    @property
    def max_range(self) -> float: ...
    @max_range.setter
    def max_range(self, arg0: float) -> None: ...
    @property
    def min_range(self) -> float: ...
    @min_range.setter
    def min_range(self, arg0: float) -> None: ...
    @property
    def period(self) -> int: ...
    @period.setter
    def period(self, arg0: int) -> None: ...
    @property
    def rays(self) -> int: ...
    @rays.setter
    def rays(self, arg0: int) -> None: ...

class FaultKind(_Enum):
    """What is wrong with an entry of a sensor."""

    Frozen: ClassVar[FaultKind]
    NotANumber: ClassVar[FaultKind]
    __members__: ClassVar[dict[str, FaultKind]]

class SensorFault:
    """A fault of one entry of a sensor.

    Args:
      entry: e.g. "encoder_position/LSP".
      kind: FaultKind.
      start: [s] from when on."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    entry: str
    kind: FaultKind

    def __copy__(self) -> SensorFault: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SensorFault: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(self, entry: str, kind: FaultKind = ..., start: float = 0.0) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def start(self) -> float: ...
    @start.setter
    def start(self, arg0: float) -> None: ...

class SensorOptions:
    """The sensors of a simulation; hurcules.sensors.realistic() has typical ones.

    Args:
      models: dict of sensor name to SensorModel; the others are ideal.
      range: RangeFinder.
      faults: list of SensorFault.
      hold_seconds: [s] that a robot which lost a joint's encoder is held before the run ends."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    range: RangeFinder

    def __copy__(self) -> SensorOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SensorOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        models: collections.abc.Mapping[str, SensorModel] = {},
        range: RangeFinder = ...,
        faults: collections.abc.Sequence[SensorFault] = [],
        hold_seconds: float = 1.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def faults(self) -> list[SensorFault]: ...
    @faults.setter
    def faults(self, arg0: collections.abc.Sequence[SensorFault]) -> None: ...
    @property
    def hold_seconds(self) -> float: ...
    @hold_seconds.setter
    def hold_seconds(self, arg0: float) -> None: ...
    @property
    def models(self) -> dict[str, SensorModel]: ...
    @models.setter
    def models(self, arg0: collections.abc.Mapping[str, SensorModel]) -> None: ...

class MonitorOptions:
    """Thresholds of the monitors' alarms; an infinite one never alarms.

    Args:
      on: whether they look at all.
      min_distance: [m] of the robot to itself.
      min_margin: [m] of the centre of mass to the edge of the support polygon.
      min_pressure_margin: [m] of the centre of pressure to that edge.
      min_tip_angle: [rad] to tip over about an edge.
      min_energy: [J] to tip over about an edge.
      max_temperature: [deg C] of the hottest motor.
      max_power: [W] from the battery."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    on: bool

    def __copy__(self) -> MonitorOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> MonitorOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        on: bool = True,
        min_distance: float = 0.01,
        min_margin: float = 0.05,
        min_pressure_margin: float = 0.0,
        min_tip_angle: float = 0.05,
        min_energy: float = 0.0,
        max_temperature: float = 120.0,
        max_power: float = 20000.0,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def max_power(self) -> float: ...
    @max_power.setter
    def max_power(self, arg0: float) -> None: ...
    @property
    def max_temperature(self) -> float: ...
    @max_temperature.setter
    def max_temperature(self, arg0: float) -> None: ...
    @property
    def min_distance(self) -> float: ...
    @min_distance.setter
    def min_distance(self, arg0: float) -> None: ...
    @property
    def min_energy(self) -> float: ...
    @min_energy.setter
    def min_energy(self, arg0: float) -> None: ...
    @property
    def min_margin(self) -> float: ...
    @min_margin.setter
    def min_margin(self, arg0: float) -> None: ...
    @property
    def min_pressure_margin(self) -> float: ...
    @min_pressure_margin.setter
    def min_pressure_margin(self, arg0: float) -> None: ...
    @property
    def min_tip_angle(self) -> float: ...
    @min_tip_angle.setter
    def min_tip_angle(self, arg0: float) -> None: ...

class BaseSource(_Enum):
    """Where the planner's support stands."""

    Held: ClassVar[BaseSource]
    Sensed: ClassVar[BaseSource]
    __members__: ClassVar[dict[str, BaseSource]]

class Ending(_Enum):
    """Why a run is over."""

    Completed: ClassVar[Ending]
    Diverged: ClassVar[Ending]
    Fell: ClassVar[Ending]
    Held: ClassVar[Ending]
    Missed: ClassVar[Ending]
    Running: ClassVar[Ending]
    SolverFailed: ClassVar[Ending]
    TimeUp: ClassVar[Ending]
    __members__: ClassVar[dict[str, Ending]]

class FallOptions:
    """When a run ends because the robot fell.

    Args:
      frame: whose height is watched; "": none is.
      min_height: of the frame above the controller's support, of a robot that floats above z = 0 [m].
      max_tilt: of the support (of a robot that floats: its root) against its start [rad]."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    frame: str

    def __copy__(self) -> FallOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> FallOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(self, frame: str = "", min_height: float = ..., max_tilt: float = ...) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def max_tilt(self) -> float:
        """[rad]"""

    @max_tilt.setter
    def max_tilt(self, arg0: float) -> None: ...
    @property
    def min_height(self) -> float:
        """[m]"""

    @min_height.setter
    def min_height(self, arg0: float) -> None: ...

class SimulationOptions:
    """Options of a simulation.

    Args:
      seed: of the differences between runs.
      variation: scale of these: casualty +-3 cm and +-0.05 rad, start posture +-2 mrad.
      method: of the solver, one of rhqp.method_names().
      record: keep the time series.
      timed: keep the time of each stage of each tick.
      base: where the planner thinks that the robot stands: BaseSource.Held or BaseSource.Sensed.
      sensors: SensorOptions; ideal by default.
      monitors: MonitorOptions.
      adds_command: a command is added to what the mission commands, in place of taking its place.
      loaded_springs: sprung hinges without a motor start where they bear what hangs on them."""

    __hash__: ClassVar[None]  # type: ignore[assignment]
    base: BaseSource
    method: str
    monitors: MonitorOptions
    record: bool
    sensors: SensorOptions
    timed: bool

    def __copy__(self) -> SimulationOptions: ...
    def __deepcopy__(self, memo: dict[str, Any]) -> SimulationOptions: ...
    def __eq__(self, other: object) -> bool: ...
    def __init__(
        self,
        *,
        seed: int = 0,
        variation: float = 1.0,
        method: str = "lexicographic",
        record: bool = True,
        timed: bool = False,
        base: BaseSource = ...,
        sensors: SensorOptions = ...,
        monitors: MonitorOptions = ...,
        max_seconds: float = ...,
        physics: bool = True,
        fall: FallOptions = ...,
        adds_command: bool = False,
        loaded_springs: bool = False,
    ) -> None: ...
    def __repr__(self) -> str: ...
    @property
    def adds_command(self) -> bool:
        """a command is added to the mission's own"""

    @adds_command.setter
    def adds_command(self, arg0: bool) -> None: ...
    @property
    def fall(self) -> FallOptions:
        """when the robot counts as fallen"""

    @fall.setter
    def fall(self, arg0: FallOptions) -> None: ...
    @property
    def loaded_springs(self) -> bool:
        """springs start where they bear what hangs on them"""

    @loaded_springs.setter
    def loaded_springs(self, arg0: bool) -> None: ...
    @property
    def max_seconds(self) -> float:
        """[s] the run ends when it takes longer"""

    @max_seconds.setter
    def max_seconds(self, arg0: float) -> None: ...
    @property
    def physics(self) -> bool:
        """false: the robot is where it is commanded to be"""

    @physics.setter
    def physics(self, arg0: bool) -> None: ...
    @property
    def seed(self) -> int: ...
    @seed.setter
    def seed(self, arg0: int) -> None: ...
    @property
    def variation(self) -> float: ...
    @variation.setter
    def variation(self, arg0: float) -> None: ...

class Simulation:
    """The closed loop in C++, on a model and data that Python owns.

    Args:
      model: mujoco.MjModel of the mission's scene.
      data: mujoco.MjData of this model; the simulation resets and steps it.
      mission: name of the mission that commands it.
      controller: WholeBodyController instead of a mission.
      options: SimulationOptions.

    Raises:
      Error: the model lacks something that the mission asks for."""

    @overload
    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        mission: str = "stretch",
        options: SimulationOptions = ...,
    ) -> None: ...
    @overload
    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        controller: WholeBodyController,
        table: MissionTable,
        setup: MissionSetup,
        options: SimulationOptions = ...,
    ) -> None: ...
    @overload
    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        controller: WholeBodyController,
        options: SimulationOptions = ...,
    ) -> None: ...
    def answer(self, yes: bool) -> None:
        """Answers what the mission asks: `question`.

        Args:
          yes: the phase goes on, with as much time once more where it was late; False: the next reaction.

        Raises:
          Error: nothing is asked."""

    def commanded_level_errors(self) -> NDArray[np.float64]:
        """The same of the commanded motion, at the last tick."""

    def events(self) -> list[tuple[float, str]]:
        """(time [s], text) of phases, and of limits met and left."""

    def figures(self) -> dict[str, Any]:
        """The mission's own figures and the worst that the monitors saw; NaN: has not happened."""

    def follow(
        self, joints: collections.abc.Sequence[str], positions: ArrayLike, velocities: ArrayLike
    ) -> int:
        """Leads joints along a motion, one tick a row.

        No stack rules meanwhile; `controller.use` hands the robot back to one.

        Args:
          joints: names of joints with an actuator; the others stay.
          positions: (ticks, joints) [rad] or [m].
          velocities: (ticks, joints) [rad/s] or [m/s].

        Returns:
          The ticks done: fewer when the run ends.

        Raises:
          Error: an unknown joint, a position beyond its range, or arrays that do not fit."""

    def go(self, phase: str) -> None:
        """Begins a phase of the mission now, out of its order.

        Args:
          phase: its name.

        Raises:
          Error: no such phase, or no mission."""

    def heartbeat(self) -> None:
        """The operator's link is alive: the column `link_age` [s] counts from now on.

        Before the first heartbeat of a run it is 0: who has no link cannot lose it. It is part of `state`."""

    def level_errors(self) -> NDArray[np.float64]:
        """Norm of what each level is outside its intervals in the physics now, in the unit of its tasks; rows of weight 0, or without a side, are left out."""

    def limit_violation(self) -> dict[str, Any]:
        """Worst excess over any limit of the model (not of a stack's JointLimits): position_rad, velocity, torque in the physics, 0 for none; commanded: the same of the commanded motion."""

    def log(self) -> dict[str, Any]:
        """Every recorded channel over time: dict of name to (ticks,)."""

    def monitors(self) -> dict[str, float]:
        """What the monitors saw at the last tick: dict of name with unit to number."""

    def motor_temperatures(self) -> dict[str, float]:
        """[deg C] of the motors' windings: dict of joint to number."""

    def nearest_pair(self) -> tuple[str, str] | None:
        """(name, name) of the nearest of these at the last tick; None beyond the cutoff of 0.25 m."""

    def observation(self) -> NDArray[np.float64]:
        """What a policy sees now (m,), see observation_names."""

    def operator_command(self) -> NDArray[np.float64]:
        """What the mission's own operator commands next (k,)."""

    def pause(self) -> None:
        """The mission stands still, its clocks and time-outs too: to take over by hand.

        The robot holds, or does what `step` is given. Nobody looks for the mission's troubles meanwhile; falls,
        sensors and `max_seconds` count on.

        Raises:
          Error: no mission."""

    def ray_angles(self) -> NDArray[np.float64]:
        """(rays,) [rad] about z of the scanner's site, 0 along its x; empty without a scanner."""

    def read(self, quantities: Quantities) -> NDArray[np.float64]:
        """(m,) their present values."""

    def reset(self, seed: int, start: ArrayLike | None = None) -> None:
        """Back to the start, of a mission varied by this seed; start (nq,): where that is this time."""

    def restore(self, state: ArrayLike) -> None:
        """Goes on from what state() gave, bit for bit, in any simulation of the same mission and model.

        The log keeps what it recorded before that time. Masses, sizes and friction are the model's, not the
        state's: where they differ, what follows does.

        Raises:
          Error: the state belongs to a model of other parts, or another mission."""

    def resume(self) -> None:
        """The mission goes on after `pause`.

        Where it was; where a command moved something meanwhile, its phase begins anew from where the robot is,
        as by `go`.

        Raises:
          Error: no mission."""

    def self_collision_pairs(self) -> list[tuple[str, str]]:
        """(name, name) of the contact shapes whose distance is watched."""

    def sensor_entries(self) -> dict[str, tuple[str, list[str]]]:
        """What the numbers of each sensor are: dict of name to (unit, names of its entries)."""

    def sensors(self) -> dict[str, NDArray[np.float64]]:
        """What each sensor says now: dict of name to (m,); with a scanner also range (rays,) [m]."""

    def solver(self) -> dict[str, Any]:
        """How the last solve went: status (number of rhqp.Status), factorizations, changes, optimality."""

    def state(self) -> NDArray[np.float64]:
        """All that decides how the run goes on, as one array; the log and the events are not in it."""

    def step(
        self, n: int = 1, command: collections.abc.Mapping[str, ArrayLike] | ArrayLike | None = None
    ) -> int:
        """Control ticks of dt. Releases the interpreter lock.

        Args:
          n: how many.
          command: (k,) SI, in the order of command_names, held to command_scale; None: the mission's
            operator, and without a mission every target holds.

        Returns:
          The ticks done: fewer when the mission ends.

        Raises:
          Error: a command of another size, or not finite."""

    def thesis_figures(self) -> dict[str, Any]:
        """What the thesis reports for those figures that it gives."""

    def timings(self) -> dict[str, Any]:
        """Seconds that each stage of each tick took: dict of (ticks,)."""

    def wanted_figures(self) -> dict[str, Any]:
        """(least, most) that those figures must be for success whose mission says so."""

    @property
    def brakes(self) -> Brakes:
        """Brakes of the joints' drives"""

    @property
    def channels(self) -> list[str]: ...
    @property
    def command_names(self) -> list[str]: ...
    @property
    def command_scale(self) -> NDArray[np.float64]:
        """(k,) SI"""

    @property
    def controller(self) -> WholeBodyController:
        """WholeBodyController of the loop"""

    @property
    def dt(self) -> float:
        """[s]"""

    @property
    def ending(self) -> Ending:
        """Ending: the reason as a number"""

    @property
    def finished(self) -> bool: ...
    @property
    def held(self) -> bool:
        """whether it stands behind its brakes for a sensor's sake"""

    @property
    def levels(self) -> list[str]:
        """decreasing priority"""

    @property
    def observation_names(self) -> list[str]: ...
    @property
    def paused(self) -> bool:
        """its mission stands still: `pause`"""

    @property
    def phase(self) -> str:
        """of the mission; '' without one"""

    @property
    def phase_notes(self) -> list[str]:
        """of each, what it is for"""

    @property
    def phases(self) -> list[str]: ...
    @property
    def physics(self) -> bool:
        """False: it moves without forces"""

    @property
    def plant(self) -> Plant:
        """Plant that it steps"""

    @property
    def question(self) -> str:
        """What the mission asks (reaction `ask 30 s`) and waits for in `answer`; '' for nothing."""

    @property
    def reason(self) -> str:
        """'' while running, else why it ended: 'completed', 'fell over at ...'"""

    @property
    def records(self) -> bool:
        """False: `log` is empty"""

    @property
    def success(self) -> bool: ...
    @property
    def time(self) -> float:
        """[s] since reset"""

class Quantities:
    """Named numbers of a simulation, found once and read together.

    Names: position/FRAME, rotation/FRAME (rotation vector), velocity/FRAME, spin/FRAME (3 each, in the
    world), matrix/FRAME (9); value/TASK, target/TASK; force/TASK (what a force task read);
    distance/OBJECT/OBJECT; joint/JOINT, joint_velocity/JOINT; sensor/SENSOR; monitor/NAME; excess/KIND, commanded_excess/KIND
    (position, velocity, torque: the worst so far), excess_now/KIND (of the last period); contact_force/BODY; self_contacts; scaled; finished
    (1 where it is over); ending (the number of its Ending, 0 until then); and each channel of the observation and the log, alone ("q/KN") or as a group
    ("q").

    Args:
      simulation: Simulation that they are of; they can be read from any copy of it.
      names: list of names.

    Raises:
      Error: a name that does not exist, with those that do."""

    def __init__(self, simulation: Simulation, names: collections.abc.Sequence[str]) -> None: ...
    def __len__(self) -> int: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def sizes(self) -> list[int]:
        """of each name"""

class SimulationBatch:
    """Many copies of a simulation on threads, stepped in one call.

    Each has controller and data of its own; they share the model unless each gets its own. Its bits
    are those that it has alone, whatever the number of threads. Copies record nothing.

    Args:
      simulation: Simulation to copy, in its present state.
      n: how many.
      threads: 0 for one a processor.
      models: one mujoco.MjModel each, of the same names and shapes, or none. Their controllers go on
        reckoning with the model of `simulation`.

    Raises:
      Error: n < 1, or models that do not fit."""

    def __getitem__(self, arg0: int) -> Simulation: ...
    def __init__(
        self,
        simulation: Simulation,
        n: int,
        threads: int = 0,
        models: collections.abc.Sequence[mujoco.MjModel] = [],
    ) -> None: ...
    def __len__(self) -> int: ...
    def observation(self) -> NDArray[np.float64]:
        """(n, m) what a policy sees now, see Simulation.observation_names."""

    def push(self, body: int, forces: ArrayLike) -> None:
        """Forces on a body of each, from now on; zero ends them.

        Args:
          body: number of the body in the model.
          forces: (n, 3) [N] in the world, at its centre of mass.

        Raises:
          Error: an array of another shape, not finite, or no such body."""

    def read(self, quantities: Quantities) -> NDArray[np.float64]:
        """(n, m) their present values."""

    def reset(
        self,
        seeds: collections.abc.Sequence[int],
        mask: collections.abc.Sequence[bool] | None = None,
        starts: ArrayLike | None = None,
    ) -> None:
        """Back to the start; seeds (n,), mask (n,) bool: which, starts (n, nq): where that is."""

    def restore(
        self, states: ArrayLike, mask: collections.abc.Sequence[bool] | None = None
    ) -> None:
        """Goes on from state()."""

    def state(self) -> NDArray[np.float64]:
        """(n, s) all that decides how each goes on, see Simulation.state."""

    def step(
        self,
        ticks: int,
        commands: collections.abc.Mapping[str, ArrayLike] | ArrayLike | None = None,
        mask: collections.abc.Sequence[bool] | None = None,
    ) -> None:
        """Control ticks of all. Releases the interpreter lock.

        Args:
          ticks: how many; one that is finished stands still.
          commands: (n, k) SI, or None.
          mask: (n,) bool: which are stepped; None: all.

        Raises:
          Error: arrays of another shape, or not finite."""

    def step_and_read(
        self,
        ticks: int,
        quantities: Quantities,
        commands: collections.abc.Mapping[str, ArrayLike] | ArrayLike | None = None,
        mask: collections.abc.Sequence[bool] | None = None,
    ) -> NDArray[np.float64]:
        """Control ticks of all, and what is read then. Releases the interpreter lock.

        Faster than `step`, then `read`: each is read while the processor has it at hand.

        Args:
          ticks: how many; one that is finished stands still.
          quantities: what is read.
          commands: (n, k) SI, or None.
          mask: (n,) bool: which are stepped; None: all. All are read.

        Returns:
          (n, m) as `read`.

        Raises:
          Error: arrays of another shape, or not finite."""

    @property
    def endings(self) -> list[Ending]:
        """(n,) list of Ending"""

    @property
    def finished(self) -> NDArray[np.bool_]:
        """(n,) bool"""

    @property
    def physics(self) -> NDArray[np.float64]:
        """(n, s) for mujoco.mj_setState with mjSTATE_INTEGRATION: time, qpos, qvel, ctrl, ..."""

    @property
    def qpos(self) -> NDArray[np.float64]:
        """(n, nq) of the physics"""

    @property
    def qvel(self) -> NDArray[np.float64]:
        """(n, nv) of the physics"""

    @property
    def threads(self) -> int: ...
    @property
    def time(self) -> NDArray[np.float64]:
        """(n,) [s]"""

class PowerMeter:
    """What the robot takes from its battery: motors, open brakes, and 300 W that are always on.

    Args:
      model: mujoco.MjModel with a robot; every actuator of a joint is a motor.

    Raises:
      Error: a model without the numbers that motors and transmissions want."""

    def __init__(self, model: mujoco.MjModel) -> None: ...
    def read(self, physics: Plant) -> None:
        """Reads a step that was just taken.

        Args:
          physics: of the same model."""

    @property
    def mechanical(self) -> float:
        """[W] of all motors, at joints"""

    @property
    def motors(self) -> float:
        """[W] electric"""

    @property
    def total(self) -> float:
        """[W] with open brakes and standby"""

class Battery:
    """A voltage behind a resistance, until its energy is used up.

    Args:
      capacity: [J] that can be used.
      voltage: [V] without load.
      resistance: [Ohm].

    Raises:
      Error: a capacity or voltage that is not above 0, a resistance below 0."""

    def __init__(
        self, *, capacity: float = 22320000.0, voltage: float = 96.0, resistance: float = 0.05
    ) -> None: ...
    def draw(self, power: float, seconds: float) -> None:
        """Gives [W] for [s]; a negative power charges it, up to full."""

    @property
    def charge(self) -> float:
        """0 to 1"""

    @property
    def empty(self) -> bool: ...
    @property
    def energy(self) -> float:
        """[J] left"""

    @property
    def lost(self) -> float:
        """[J] in its own resistance"""

def Bounds(lower: ArrayLike, upper: ArrayLike) -> Level:
    """Simple bounds lower <= x <= upper as a level of its own, never regularised.

    Args:
      lower, upper: (n,) float64. +-inf or a magnitude >= 1e20 means no side. Held as Level holds them."""

def BoundsStack(lower: ArrayLike, upper: ArrayLike) -> LevelStack:
    """Simple bounds of many hierarchies of a batch.

    Args:
      lower, upper: (B, n) float64, or (n,) when all have the same."""

def ControlRate(actuator: str, scale: float) -> Channel:
    """A channel that leads the control of an actuator that no servo commands: a gripper on tendons.

    It starts where a position servo holds what it moves, at 0 with others, and stays within the
    actuator's ctrlrange. Without physics it moves nothing.

    Args:
      actuator: its name.
      scale: full scale [1/s] of its control."""

def Delta(task: Task, scale: float | ArrayLike) -> Channel:
    """A channel that puts the target of a task at its measured value plus an increment.

    It acts once a call of `step`; zero leaves the target where it is.

    Args:
      task: Task with a target.
      scale: full scale [m] or [rad]."""

def Drive(speed: float, yaw_rate: float) -> Channel:
    """A channel that drives the tracks: speed and yaw rate.

    Args:
      speed: full scale [m/s].
      yaw_rate: full scale [rad/s]."""

def ForceReference(task: Task, scale: float | ArrayLike) -> Channel:
    """A channel that sets the force that a ForceTask keeps.

    Args:
      task: ForceTask.
      scale: largest magnitude [N]."""

def JointRate(joint: str, scale: float) -> Channel:
    """A channel that moves a joint of no coordinate (a gripper, a bed) by a velocity.

    Args:
      joint: name of a joint with an actuator.
      scale: full scale [rad/s] or [m/s]."""

def JointRates(joints: collections.abc.Sequence[str], scale: float = ...) -> Channel:
    """A channel that moves joints one by one, by velocities, while no stack rules (`move_joints`).

    Velocities change within the acceleration limit, places stay within the ranges of the joints. While a
    stack rules it moves nothing.

    Args:
      joints: names of joints with an actuator.
      scale: full scale [rad/s] or [m/s]."""

def Target(task: Task, scale: float | ArrayLike = ...) -> Channel:
    """A channel that sets the target of a task.

    It acts once a call of `step`. An orientation is given as a rotation vector.

    Args:
      task: Task whose target numbers say; of a GazeTask they are the point.
      scale: largest magnitude [m] or [rad]."""

def Twist(task: Task, scale: float | ArrayLike) -> Channel:
    """A channel that leads the target of a task by a velocity; zero holds it.

    Args:
      task: Task with a target.
      scale: full scale, one number or one a row [m/s] or [rad/s]; a command is held to it."""

def all_below(values: ArrayLike, bound: float) -> NDArray[np.bool_]:
    """(n,) bool: whether all of a row (n, k) are smaller than `bound`."""

def check_rows(table: MissionTable) -> None:
    """Checks what of a table can be told without a controller: phases, reactions, time-outs, ways.

    Args:
      table: MissionTable.

    Raises:
      Error: naming the row, with what was wanted and what came."""

def clipped(values: np.ndarray) -> tuple[NDArray[np.float64], bool]:
    """Numbers cut to [-1, 1].

    Args:
      values: of any shape.

    Returns:
      A copy, and whether all are finite."""

def distances(
    one: ArrayLike, other: ArrayLike, size: int, rounded: bool = False
) -> NDArray[np.float64]:
    """Distances of places from each other.

    Args:
      one: (n, h size) h poses in a row: place [m], then what else they have.
      other: the same.
      size: of a pose, 3 or more.
      rounded: both as float32 has them, which is how they are seen.

    Returns:
      (n, h) [m].

    Raises:
      Error: arrays of another shape."""

def half_angle_cosines(
    one: ArrayLike, other: ArrayLike, size: int, rounded: bool = False
) -> NDArray[np.float64]:
    """How orientations differ.

    Args:
      one: (n, h size) h poses in a row: place, quaternion w, x, y, z of any length, what else they
        have.
      other: the same.
      size: of a pose, 7 or more.
      rounded: both as float32 has them, which is how they are seen.

    Returns:
      (n, h) cosine, from 0 to 1, of half the angle between them.

    Raises:
      Error: arrays of another shape."""

def hold(
    now: ArrayLike, dt: float, least: float, held: ArrayLike, done: ArrayLike
) -> NDArray[np.float64]:
    """Counts for how long something holds without a break.

    Args:
      now: (n,) bool: it does, after a step.
      dt: [s] of the step.
      least: [s] for which it is to hold.
      held: (n, 1) [s] so far, updated.
      done: (n, 1) updated: 1 from when it held for `least`.

    Returns:
      (n,) what `done` grew by.

    Raises:
      Error: arrays of another size."""

def inverse_kinematics(
    robot: Robot,
    tasks: Stack
    | collections.abc.Iterable[
        Task | JointLimits | StackLevel | collections.abc.Iterable[Task | JointLimits | StackLevel]
    ],
    *,
    starts: int = 32,
    seed: int = 0,
    tolerance: float = 0.0001,
) -> Posture:
    """The posture nearest to the present one, of those found, that meets all tasks.

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
      Error: no task, fewer than one start, or a tolerance that is not positive."""

def judge(
    values: ArrayLike,
    terms: collections.abc.Sequence[ArrayLike],
    failed: ArrayLike,
    ended: ArrayLike,
    costly: ArrayLike,
    worst: ArrayLike,
) -> tuple[Any, ...]:
    """Judges a step of episodes side by side.

    By what was read of their simulations and what their task says: reward, cost, how it ended, and the
    numbers that are told of these. The cost is 1 where the robot touches itself; is beyond the
    limit of a joint's place by more than 5 mrad (of slides 5 mm) at the end of the step, or within it
    further than ever; or where the task says so.

    Args:
      values: (n, m) as read, `judged()` its last columns.
      terms: list of (n,) arrays, the terms of the reward.
      failed: (n,) bool.
      ended: (n,) bool, by success.
      costly: (n,) bool: more that costs.
      worst: (n,) the worst excess [rad] of each at its last step, updated; 0 for one that begins.

    Returns:
      reward (n,), failed (n,), terminated (n,), ending (n,), what is told (r, n): the terms, then by
      the names of `judged()`; and whether the rewards are finite.

    Raises:
      Error: arrays of another size."""

def judged() -> list[tuple[str, str]]:
    """What `judge` reads, in this order, and what it tells of it.

    Returns:
      Pairs of names; of the ending the cost is told."""

def largest_stiffness(gains: ForceGains) -> float:
    """Largest stiffness G [N/m] of an environment that the gains keep stable in steps of dt.

    The reading is one step old and the robot follows exactly; a real servo asks for less: C G well
    below its bandwidth. C G dt < 1 for FirstOrder.

    Args:
      gains: ForceGains.

    Raises:
      Error: gains that cannot be."""

def lift_start() -> dict[str, float]:
    """Where a lift starts, beside the keyframe `stretch`: angles [rad] by coordinate.

    "KN" means the coordinate of this name, or both sides'."""

def means(values: ArrayLike, factor: float = 1.0) -> NDArray[np.float64]:
    """(n,) `factor` times the mean of a row of (n, k)."""

def method_names() -> list[str]:
    """The names that SolverOptions(method=...) takes.

    'lexicographic': the default, exact, always ends.
    'rhqp_thesis': Algorithm 1 of the thesis, literally; can end off the optimum or at its iteration limit.
    'hqp': the same active set with every rho = 0.
    'dls_hqp': the same with a damped inverse and multipliers that leave out the regularisation error.
    'cascade': one general QP a level; the same answers as 'lexicographic', slow, for comparison."""

def mission_scene(mission: str) -> str:
    """Scene file of a mission, under models/."""

def missions() -> list[str]:
    """Names of the missions."""

def mode_ranges(mode: str) -> dict[str, Any]:
    """Ranges of the coordinates in a mode of work: narrower than the hardware's.

    Args:
      mode: "rescue_ready" (the transfer bed is on) or "rescue_ready_without_bed".

    Returns:
      By coordinate: lowest and highest angle [rad].

    Raises:
      Error: an unknown mode."""

def obstacles(
    robot: Robot,
    bodies: collections.abc.Sequence[str] = [],
    margin: float = 0.02,
    most: float = 0.15,
    rows: int = 16,
    postures: int = 200,
    seed: int = 0,
) -> DistanceTask:
    """The robot keeps away from what stands around it: a DistanceTask for a level above the hands.

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
      Error: a name that is no body or a body of the robot, or see self_collision."""

def read_table(path: str) -> tuple[MissionSetup, MissionTable]:
    """What stands in a table file: MissionSetup and MissionTable.

    Args:
      path: of the file.

    Raises:
      Error: it cannot be read, with its line, what was wanted and what exists."""

@overload
def realistic_sensors() -> SensorOptions:
    """SensorOptions of typical sensors, with noise, bias, delay and resolution."""

@overload
def realistic_sensors(robot: Robot) -> SensorOptions:
    """Those of them that a robot has."""

def seen(
    parts: collections.abc.Sequence[ArrayLike],
    bound: ArrayLike,
    errors: ArrayLike | None = None,
    goals: collections.abc.Sequence[ArrayLike] = (),
) -> tuple[list[Any], bool]:
    """Arrays side by side, as an observation, and goals.

    Args:
      parts: list of (n, k) arrays.
      bound: (m,) float32, what is beyond is cut off.
      errors: (n, e) or None, added first, to the first columns.
      goals: list of (n, g) arrays, which are not cut.

    Returns:
      List of (n, m) float32 and of the goals likewise, and whether all are finite.

    Raises:
      Error: arrays of another shape."""

def self_collision(
    robot: Robot,
    margin: float = 0.02,
    most: float = 0.15,
    rows: int = 16,
    postures: int = 200,
    seed: int = 0,
) -> DistanceTask:
    """The robot keeps away from itself: a DistanceTask for a level above the hands.

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
      Error: most <= margin, or postures or rows below 1."""

def servo_table(robot: Robot) -> dict[str, Any]:
    """What the model says that servos of its joints shall reckon with: its numerics `servo_JOINT`.

    A WholeBodyController takes them where it is given no others.

    Args:
      robot: whose model has them, as Hurcules has.

    Returns:
      By joint: the inertia that it turns [kg m^2], of a slide [kg], and its bandwidth [rad/s].

    Raises:
      Error: a servo_JOINT that is no two numbers above 0."""

def sole_points(robot: Robot, body: str) -> NDArray[np.float64]:
    """The lowest points of the collision geoms of a body, and of what is welded to it, as the robot stands.

    Args:
      robot: Robot.
      body: name of a body.

    Returns:
      (k, 3) [m] in the body's frame, the outermost four at most within 3 mm of the lowest; the lowest
      alone where these are less than 5 cm apart, as on a round foot.

    Raises:
      Error: no such body, or one without collision geoms."""

def solve_batch(
    problems: collections.abc.Sequence[collections.abc.Sequence[Level]]
    | collections.abc.Sequence[LevelStack],
    threads: int | None = None,
    options: SolverOptions = ...,
) -> list[Solution]:
    """Solves many independent hierarchies on threads, without the interpreter lock.

    Args:
      problems: sequence of sequences of Level (and Bounds), each with its own number of unknowns; or
        one sequence of LevelStack (and BoundsStack): hierarchies of one shape, without an object each.
      threads: how many; None: one a processor.
      options: SolverOptions of all.

    Returns:
      list of Solution, bit for bit those of a new Solver a problem.

    Raises:
      Error: as Solver.solve, with the number of the problem."""

def squares(values: ArrayLike) -> NDArray[np.float64]:
    """(n,) sum of the squares of a row of (n, k)."""

def static_margin(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    root: str,
    carried: collections.abc.Sequence[str] = [],
) -> float:
    """Distance of the centre of mass from the edge of the support, across gravity [m].

    It stands on the contacts that press: of the robot with what does not move, of its tracks with
    anything.

    Args:
      model: mujoco.MjModel.
      data: after a step.
      root: body at the root of the robot.
      carried: bodies that count to its mass while they do not touch the ground themselves.

    Returns:
      Negative where it tips over, -inf in the air.

    Raises:
      Error: an unknown body."""

def step(model: mujoco.MjModel, data: mujoco.MjData, n: int = 1) -> None:
    """mj_step with the traction of the tracks; plain mj_step leaves the belts without any.

    MuJoCo's sensors are read in the last step alone.

    Args:
      model: mujoco.MjModel; its tracks are the tuples `track_NAME`.
      data: mujoco.MjData of this model.
      n: number of steps. Releases the interpreter lock.

    Raises:
      Error: tracks without the elliptic cones that they want."""

def swing(
    place: ArrayLike,
    free: ArrayLike,
    dt: float,
    before: ArrayLike,
    velocity: ArrayLike,
    deflection: ArrayLike,
    rate: ArrayLike,
) -> NDArray[np.float64]:
    """Carries points in springs on by a step, along each axis alike.

    What they hang in changes its velocity where the step begins.

    Args:
      place: (n, k) [m] of what they hang in, now.
      free: (2, 2) what deflection and its rate become in the step by themselves.
      dt: [s] of the step.
      before: (n, k) [m] the place before, updated.
      velocity: (n, k) [m/s] of it, updated.
      deflection: (n, k) [m], updated.
      rate: (n, k) [m/s] of the deflection, updated.

    Returns:
      (n, k) [m] where the points are.

    Raises:
      Error: arrays of another shape."""

def table_controller(
    name: str, model: mujoco.MjModel, method: str = "lexicographic"
) -> WholeBodyController:
    """The controller that the table of a mission commands; its robot stands at the start.

    "lift" (of lift and casualty) has the stacks `arms`, `press` (force control downwards) and `posture`;
    "disposal" has `hands` (place and direction of both, then pelvis, then posture) and `posture`, and the
    channels `left_grip` and `right_grip` of the fingers. Both have a channel a task, `drive` for the
    tracks, and `joints` for all joints but belts and fingers, one by one.

    Args:
      name: "lift" or "disposal".
      model: mujoco.MjModel of its scene.
      method: how the hierarchy is solved, one of `rhqp.method_names()`.

    Raises:
      Error: another name, or a scene without the robot."""

def table_lines(
    setup: MissionSetup, table: MissionTable, controller: str, model: str, model_bytes: bytes
) -> str:
    """The text of a table file, which `hurcules-sim` runs.

    Args:
      setup: MissionSetup.
      table: MissionTable.
      controller: name of a `table_controller`.
      model: name of the model's file, which lies beside it.
      model_bytes: of that file, as mj_saveModel writes it.

    Raises:
      Error: a name or a note of more than one line."""
