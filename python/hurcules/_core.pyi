"""The compiled part of hurcules: float64 arrays, all copies but those of Level; shapes beside."""

import os
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, ClassVar, NoReturn, overload, type_check_only

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

_Vector = NDArray[np.float64]  # one axis
_Matrix = NDArray[np.float64]  # two axes

build: dict[str, str | bool]  # version, mujoco, eigen, simd, compiler, build_type, flags, asserts

class Error(ValueError): ...

@type_check_only
class _Given:  # only the library makes these
    def __init__(self, *args: object, **kwargs: object) -> None: ...

@type_check_only
class _Enum:  # what pybind11 gives each enumeration
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

# solver: see hurcules.rhqp

class Level:
    def __init__(
        self, A: ArrayLike, lower: ArrayLike, upper: ArrayLike, rho: float = 0.0
    ) -> None: ...  # (m, n), (m,), (m,)
    @property
    def A(self) -> _Matrix: ...  # (m, n); empty for bounds
    @property
    def lower(self) -> _Vector: ...  # (m,)
    @property
    def upper(self) -> _Vector: ...  # (m,)
    @property
    def rho(self) -> float: ...
    @property
    def rows(self) -> int: ...  # m

def Bounds(lower: ArrayLike, upper: ArrayLike) -> Level: ...  # (n,), (n,)

class LevelStack:
    def __init__(
        self, A: ArrayLike, lower: ArrayLike, upper: ArrayLike, rho: float = 0.0
    ) -> None: ...  # (B, m, n) or (m, n), (B, m) or (m,) each
    @property
    def A(self) -> NDArray[np.float64]: ...
    @property
    def lower(self) -> NDArray[np.float64]: ...
    @property
    def upper(self) -> NDArray[np.float64]: ...
    @property
    def rho(self) -> float: ...

def BoundsStack(lower: ArrayLike, upper: ArrayLike) -> LevelStack: ...  # (B, n) or (n,) each

class Status(_Enum):
    Solved: ClassVar[Status]
    ReducedAccuracy: ClassVar[Status]
    IterationLimit: ClassVar[Status]
    LostPrecision: ClassVar[Status]
    InvalidInput: ClassVar[Status]
    __members__: ClassVar[dict[str, Status]]

class Side(_Enum):
    Lower: ClassVar[Side]
    Upper: ClassVar[Side]
    __members__: ClassVar[dict[str, Side]]

class ActiveRow(_Given):
    @property
    def level(self) -> int: ...
    @property
    def row(self) -> int: ...
    @property
    def side(self) -> Side: ...
    @property
    def held_by(self) -> int: ...  # level that pushes against it
    @property
    def multiplier(self) -> float: ...  # >= 0

@type_check_only
class _Solved(_Given):
    @property
    def x(self) -> _Vector: ...  # (n,)
    @property
    def status(self) -> Status: ...
    @property
    def violations(self) -> list[_Vector]: ...  # a level (m,)
    @property
    def working_set(self) -> list[ActiveRow]: ...
    @property
    def factorizations(self) -> int: ...
    @property
    def changes(self) -> int: ...
    @property
    def final_levels(self) -> int: ...
    @property
    def optimality(self) -> float: ...

class LevelReport(_Given):
    @property
    def rho(self) -> float: ...
    @property
    def rank(self) -> int: ...
    @property
    def singular_values(self) -> _Vector: ...  # (min(equality rows, free directions),)
    @property
    def handed_over(self) -> _Vector: ...  # as singular_values
    @property
    def infeasible(self) -> _Vector: ...  # (m,)
    @property
    def regularized(self) -> _Vector: ...  # (m,)

class LevelChange:
    def __init__(
        self,
        A: ArrayLike | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
        rho: float = 0.0,
    ) -> None: ...  # (m, n), (m,), (m,)
    @property
    def A(self) -> _Matrix | None: ...  # (m, n)
    @property
    def lower(self) -> _Vector | None: ...  # (m,)
    @property
    def upper(self) -> _Vector | None: ...  # (m,)
    @property
    def rho(self) -> float: ...

class Solution(_Solved):
    @property
    def multipliers(self) -> list[list[_Vector]]: ...  # [k][j] (m_j,), j <= k
    @property
    def levels(self) -> list[LevelReport]: ...
    def jvp(self, changes: Sequence[LevelChange | None]) -> _Vector: ...  # (n,)
    def vjp(self, x_bar: ArrayLike) -> list[LevelChange]: ...  # (n,)

class SolverOptions:
    method: str
    proof: bool
    max_changes: int
    max_iterations: int
    handover: str  # "strict" or "smooth"
    regularization: str  # "constant" or "adaptive"
    singular_threshold: float  # unit of A
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

def method_names() -> list[str]: ...

class Solver:
    def __init__(self, n: int, options: SolverOptions = ...) -> None: ...
    def solve(self, levels: Sequence[Level]) -> Solution: ...
    def reset(self) -> None: ...
    @property
    def n(self) -> int: ...

def solve_batch(
    problems: Sequence[Sequence[Level]] | Sequence[LevelStack],
    threads: int | None = None,
    options: SolverOptions = ...,
) -> list[Solution]: ...

# robot

class DrivenJoint(_Given):
    @property
    def joint(self) -> int: ...
    @property
    def qpos(self) -> int: ...
    @property
    def dof(self) -> int: ...
    @property
    def actuator(self) -> int: ...
    @property
    def factor(self) -> float: ...

class Coordinate(_Given):
    @property
    def name(self) -> str: ...
    @property
    def joints(self) -> list[DrivenJoint]: ...
    @property
    def lower(self) -> float: ...  # [rad] or [m]
    @property
    def upper(self) -> float: ...  # [rad] or [m]
    @property
    def max_velocity(self) -> float: ...  # [rad/s] or [m/s]
    @property
    def max_effort(self) -> float: ...  # [N m] or [N]

class Robot:
    @overload
    def __init__(self, model: str | os.PathLike[str]) -> None: ...
    @overload
    def __init__(self, model: mujoco.MjModel) -> None: ...
    @property
    def size(self) -> int: ...  # n
    @property
    def coordinates(self) -> list[Coordinate]: ...
    @property
    def coordinate_names(self) -> list[str]: ...
    def coordinate(self, name: str) -> int: ...
    def set_qpos(self, qpos: ArrayLike) -> None: ...  # (nq,)
    def set_configuration(self, q: ArrayLike) -> None: ...  # (n,) [rad] or [m]
    def set_velocity(self, velocity: ArrayLike) -> None: ...  # (n,) [rad/s] or [m/s]
    def stand_on(self, body: str) -> None: ...
    def set_keyframe(self, name: str) -> None: ...
    @property
    def configuration(self) -> _Vector: ...  # (n,) [rad] or [m]
    @property
    def velocity(self) -> _Vector: ...  # (n,) [rad/s] or [m/s]
    @property
    def qpos(self) -> _Vector: ...  # (nq,)
    def coordinates_of(self, qpos: ArrayLike) -> _Vector: ...  # (nq,) -> (n,)
    def position(self, frame: str) -> _Vector: ...  # (3,) [m]
    def orientation(self, frame: str) -> _Matrix: ...  # (3, 3)
    def view_orientation(self, frame: str) -> _Matrix: ...  # (3, 3)
    def position_jacobian(self, frame: str) -> _Matrix: ...  # (3, n)
    def rotation_jacobian(self, frame: str) -> _Matrix: ...  # (3, n)
    def position_drift(self, frame: str) -> _Vector: ...  # (3,) [m/s^2]
    def rotation_drift(self, frame: str) -> _Vector: ...  # (3,) [rad/s^2]
    @property
    def com(self) -> _Vector: ...  # (3,) [m]
    def com_drift(self) -> _Vector: ...  # (3,) [m/s^2]
    def com_jacobian(self) -> _Matrix: ...  # (3, n)
    def inverse_dynamics(self, acceleration: ArrayLike) -> _Vector: ...  # (n,) -> (n,) [N m]
    def mass_matrix(self) -> _Matrix: ...  # (n, n) [kg m^2]

class SpringForce:
    def __init__(self, robot: Robot, joint: str, frame: str) -> None: ...
    def update(self, qpos: ArrayLike, qvel: ArrayLike) -> None: ...  # (nq,), (nv,)
    @property
    def deflection(self) -> float: ...  # [rad]
    @property
    def moment(self) -> float: ...  # [N m]
    @property
    def force(self) -> float: ...  # [N]
    @property
    def lever(self) -> float: ...  # [m]
    @property
    def direction(self) -> _Vector: ...  # (3,)
    @property
    def at_stop(self) -> bool: ...

# tasks

class Task(_Given):
    def update(self, robot: Robot) -> None: ...
    def hold(self, robot: Robot) -> None: ...
    def advance(self, velocity: ArrayLike, dt: float) -> None: ...  # (m,) unit/s, [s]
    def set_interval(self, lower: ArrayLike, upper: ArrayLike) -> None: ...  # (m,), (m,)
    def set_max_speed(self, speed: float) -> None: ...  # [unit/s]
    @property
    def max_speed(self) -> float: ...  # [unit/s]
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def rows(self) -> int: ...  # m
    @property
    def error(self) -> _Vector: ...  # (m,)
    @property
    def jacobian(self) -> _Matrix: ...  # (m, n)
    @property
    def drift(self) -> _Vector: ...  # (m,)
    @property
    def velocity_des(self) -> _Vector: ...  # (m,)
    @property
    def lower(self) -> _Vector: ...  # (m,), of the error
    @property
    def upper(self) -> _Vector: ...  # (m,), of the error
    @property
    def bounds_coordinates(self) -> bool: ...
    def __lt__(self, other: Any) -> NoReturn: ...  # use Stack([a, b, c])
    def __gt__(self, other: Any) -> NoReturn: ...

class ValueTask(Task):
    @property
    def value(self) -> _Vector: ...  # (m,)
    @property
    def target(self) -> _Vector: ...  # (m,)
    leash: float  # task unit
    def set_target(self, target: ArrayLike) -> None: ...  # (m,)

class JointLimits(Task):
    def __init__(self, name: str, robot: Robot) -> None: ...
    def set_range(self, coordinate: str, lower: float, upper: float) -> None: ...  # [rad] or [m]
    def reset_ranges(self) -> None: ...
    @property
    def max_velocity(self) -> _Vector: ...  # (n,) [rad/s] or [m/s]
    def set_max_velocity(self, coordinate: str, limit: float) -> None: ...

class PostureTask(ValueTask):
    def __init__(self, name: str, robot: Robot, coordinates: Sequence[str] = ...) -> None: ...

class PointTask(ValueTask):
    @property
    def position(self) -> _Vector: ...  # (3,) [m]

class PositionTask(PointTask):
    def __init__(
        self, name: str, robot: Robot, frame: str, reference: str = "", axes: ArrayLike = ...
    ) -> None: ...  # axes (m, 3)

class CenterOfMassTask(PointTask):
    def __init__(
        self, name: str, robot: Robot, reference: str = "", axes: ArrayLike = ...
    ) -> None: ...  # axes (m, 3)

class OrientationTask(Task):
    def __init__(self, name: str, robot: Robot, frame: str, reference: str = "") -> None: ...
    @property
    def orientation(self) -> _Matrix: ...  # (3, 3)
    @property
    def target(self) -> _Matrix: ...  # (3, 3)
    def set_target(self, target: ArrayLike) -> None: ...  # (3, 3)

class AngleKind(_Enum):
    Elevation: ClassVar[AngleKind]
    Heading: ClassVar[AngleKind]
    __members__: ClassVar[dict[str, AngleKind]]

class AngleTask(ValueTask):
    def __init__(
        self,
        name: str,
        robot: Robot,
        frame: str,
        kind: AngleKind = ...,
        axis: ArrayLike = ...,
        reference: str = "",
    ) -> None: ...  # axis (3,)

class SwivelTask(ValueTask):
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
    ) -> None: ...  # direction (3,)

class GazeTask(Task):
    def __init__(self, name: str, robot: Robot, frame: str) -> None: ...
    @property
    def target(self) -> _Vector: ...  # (3,) [m]
    def set_target(self, target: ArrayLike) -> None: ...  # (3,) [m]

class TorqueLimits(Task):
    def __init__(self, name: str, robot: Robot) -> None: ...

class BalanceTask(Task):
    def __init__(
        self,
        name: str,
        robot: Robot,
        polygon: ArrayLike,
        margin: float = 0.05,
        reference: str = "",
    ) -> None: ...  # (k, 2) [m], [m]

class DistanceTask(Task):
    def __init__(
        self,
        name: str,
        robot: Robot,
        pairs: Sequence[tuple[str, str]],
        margin: float = 0.03,
        most: float = 0.3,
    ) -> None: ...  # [m], [m]

class ForceLoop(_Enum):
    FirstOrder: ClassVar[ForceLoop]
    Velocity: ClassVar[ForceLoop]
    Position: ClassVar[ForceLoop]
    PositionIntegral: ClassVar[ForceLoop]
    __members__: ClassVar[dict[str, ForceLoop]]

class ForceGains:
    loop: ForceLoop
    compliance: float  # [m/s/N] or [m/N]
    integral: float  # [m/s/N]
    mass: float  # [kg]
    damping: float  # [kg/s]
    stiffness: float  # [kg/s^2]
    dt: float  # [s]
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

def largest_stiffness(gains: ForceGains) -> float: ...  # [N/m]

class ContactOptions:
    f_min: float  # [N]
    f_max: float  # [N]
    release_time: float  # [s]
    patience: float  # [s]
    frozen_move: float  # [m]
    def __init__(
        self,
        *,
        f_min: float = 2.5,
        f_max: float = 150.0,
        release_time: float = 0.05,
        patience: float = 0.01,
        frozen_move: float = 0.0005,
    ) -> None: ...

class StiffnessOptions:
    lower: float  # [N/m]
    upper: float  # [N/m]
    forgetting: float
    step: float  # [m]
    def __init__(
        self,
        *,
        lower: float = 100.0,
        upper: float = 1000000.0,
        forgetting: float = 0.9,
        step: float = 5e-05,
    ) -> None: ...

class ContactState(_Enum):
    Free: ClassVar[ContactState]
    Contact: ClassVar[ContactState]
    Stopped: ClassVar[ContactState]
    SensorLost: ClassVar[ContactState]
    __members__: ClassVar[dict[str, ContactState]]

class ForceTask(PositionTask):
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
    ) -> None: ...  # (3,), [N], [s], [N/m], [1/s]
    def sense(self, robot: Robot, force: float) -> None: ...  # [N], NaN for none
    def set_force(self, force_des: float) -> None: ...  # [N]
    def enable(self, on: bool) -> None: ...
    def reset(self, robot: Robot) -> None: ...
    @property
    def contact(self) -> ContactState: ...
    @property
    def force(self) -> float: ...  # [N]
    @property
    def force_des(self) -> float: ...  # [N]
    @property
    def learnt_stiffness(self) -> float: ...  # [N/m]

# control

class StackLevel:
    def __init__(self, name: str, tasks: Iterable[Task], rho: float = 0.1) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def rho(self) -> float: ...
    @property
    def tasks(self) -> list[Task]: ...

class Stack:
    def __init__(self, levels: Iterable[Task | StackLevel | Iterable[Task]]) -> None: ...
    @property
    def levels(self) -> list[str]: ...  # decreasing priority
    def __len__(self) -> int: ...

class ControlSolution(_Solved): ...

class ShortTask(_Given):
    @property
    def task(self) -> str: ...
    @property
    def short_by(self) -> float: ...  # [unit]
    @property
    def unit(self) -> str: ...  # "m" or "rad"
    @property
    def held_by(self) -> list[str]: ...

class LevelNote(_Given):
    @property
    def level(self) -> str: ...
    @property
    def smallest_singular_value(self) -> float: ...
    @property
    def manipulability(self) -> float: ...
    @property
    def shorts(self) -> list[ShortTask]: ...

class VelocityControllerOptions:
    dt: float  # [s]
    gain: float  # [1/s]
    horizon: float  # [s]
    max_acceleration: float  # [rad/s^2]
    return_speed: float  # [rad/s]
    transition: float  # [s]
    law: str  # "arrive" or "thesis"
    solver: SolverOptions
    def __init__(
        self,
        *,
        dt: float = 0.001,
        gain: float = 5.0,
        horizon: float = 0.05,
        max_acceleration: float = 20.0,
        return_speed: float = 0.2,
        transition: float = 0.2,
        law: str = "arrive",
        solver: SolverOptions = ...,
    ) -> None: ...

class VelocityController:
    def __init__(self, robot: Robot, options: VelocityControllerOptions = ...) -> None: ...
    def set_stack(self, stack: Stack) -> None: ...
    def compute(self, robot: Robot) -> _Vector: ...  # (n,) [rad/s] or [m/s]
    def integrate(self, q: ArrayLike) -> _Vector: ...  # (n,) -> (n,) [rad] or [m]
    def notes(self, robot: Robot) -> list[LevelNote]: ...  # decreasing priority
    def take_over(self, previous: VelocityController) -> None: ...
    def step(self, robot: Robot) -> _Vector: ...  # (n,) [rad] or [m], the next q*
    def reset(self) -> None: ...
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    @property
    def options(self) -> VelocityControllerOptions: ...
    @property
    def velocity(self) -> _Vector: ...  # (n,) [rad/s] or [m/s]
    @property
    def active_limits(self) -> NDArray[np.int32]: ...  # (n,) -1, 0, 1
    @property
    def solution(self) -> ControlSolution: ...
    @property
    def hierarchy(self) -> list[Level]: ...
    @property
    def stack(self) -> str: ...  # "joint < hpos < ..."

class AccelerationControllerOptions:
    dt: float  # [s]
    stiffness: float  # [1/s^2]
    damping: float  # [1/s]
    horizon: float  # [s]
    max_acceleration: float  # [rad/s^2]
    return_speed: float  # [rad/s]
    rest: float  # [1/s]
    law: str  # "arrive" or "thesis"
    solver: SolverOptions
    def __init__(
        self,
        *,
        dt: float = 0.001,
        stiffness: float = 100.0,
        damping: float = 20.0,
        horizon: float = 0.05,
        max_acceleration: float = 20.0,
        return_speed: float = 0.2,
        rest: float = 10.0,
        law: str = "arrive",
        solver: SolverOptions = ...,
    ) -> None: ...

class AccelerationController:
    def __init__(self, robot: Robot, options: AccelerationControllerOptions = ...) -> None: ...
    def set_stack(self, stack: Stack) -> None: ...
    def compute(self, robot: Robot) -> _Vector: ...  # (n,) [rad/s^2] or [m/s^2]
    def step(self, robot: Robot) -> _Vector: ...  # (n,) [rad] or [m], the next q*
    def torque(self, robot: Robot) -> _Vector: ...  # (n,) [N m] or [N]
    def notes(self, robot: Robot) -> list[LevelNote]: ...  # decreasing priority
    def reset(self) -> None: ...
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    @property
    def options(self) -> AccelerationControllerOptions: ...
    @property
    def acceleration(self) -> _Vector: ...  # (n,) [rad/s^2] or [m/s^2]
    @property
    def active_limits(self) -> NDArray[np.int32]: ...  # (n,) -1, 0, 1
    @property
    def solution(self) -> ControlSolution: ...
    @property
    def hierarchy(self) -> list[Level]: ...
    @property
    def stack(self) -> str: ...  # "joint < hpos < ..."

class JointPidOptions:
    K: _Vector  # (m,) [N m s/rad]
    K_P: _Vector  # (m,) [1/s]
    K_I: _Vector  # (m,) [1/s^2]
    gamma: float
    max_torque: _Vector  # (m,) [N m]
    dt: float  # [s]
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

class JointPid:
    def __init__(self, options: JointPidOptions) -> None: ...
    def compute(
        self, position: ArrayLike, velocity: ArrayLike
    ) -> _Vector: ...  # (m,) [rad], (m,) [rad/s] -> (m,) [N m]
    def reset(self) -> None: ...
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    @property
    def options(self) -> JointPidOptions: ...
    @property
    def torque(self) -> _Vector: ...  # (m,) [N m]
    @property
    def demand(self) -> _Vector: ...  # (m,) [N m], before saturation
    @property
    def integral(self) -> _Vector: ...  # (m,) [rad s]

# control: the drives

class SpeedLimits:
    acceleration: float  # [m/s^2] or [rad/s^2]
    jerk: float  # [m/s^3] or [rad/s^3]
    def __init__(self, acceleration: float, jerk: float) -> None: ...

class ParkingOptions:
    speed: float  # [m/s]
    yaw_rate: float  # [rad/s]
    deceleration: float  # [m/s^2]
    turn_centre: float  # [m]
    run_in: float  # [m]
    line_gain: float  # [rad/m]
    heading_gain: float  # [1/s]
    max_offset: float  # [m]
    max_turn: float  # [rad]
    attempts: int
    patience: float
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

class DriveOptions:
    dt: float  # [s]
    radius: float  # [m]
    gauge: float  # [m]
    mass: float  # [kg]
    max_torque: float  # [N m]
    max_power: float  # [W]
    max_speed: float  # [m/s]
    max_yaw_rate: float  # [rad/s]
    max_sideways: float  # [m/s^2]
    forward: SpeedLimits  # [m/s^2], [m/s^3]
    turning: SpeedLimits  # [rad/s^2], [rad/s^3]
    gain: float  # [N m s/rad]
    integral_gain: float  # [N m/rad]
    speed_gain: float
    yaw_gain: float
    yaw_integral_gain: float  # [1/s]
    slip_speed: float  # [m/s]
    slip_ratio: float
    standstill_time: float  # [s]
    brake_time: float  # [s]
    parking: ParkingOptions
    def __init__(
        self,
        *,
        dt: float = 0.001,
        radius: float = 0.14,
        gauge: float = 0.67,
        mass: float = 680.0,
        max_torque: float = 600.0,
        max_power: float = 7950.0,
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

class ParkingPhase(_Enum):
    Off: ClassVar[ParkingPhase]
    Face: ClassVar[ParkingPhase]
    Approach: ClassVar[ParkingPhase]
    Align: ClassVar[ParkingPhase]
    RunIn: ClassVar[ParkingPhase]
    Done: ClassVar[ParkingPhase]
    Failed: ClassVar[ParkingPhase]
    __members__: ClassVar[dict[str, ParkingPhase]]

class DriveController:
    def __init__(self, options: DriveOptions = ...) -> None: ...
    def drive(self, speed: float, yaw_rate: float = 0.0) -> None: ...  # [m/s], [rad/s]
    def park(self, x: float, y: float, yaw: float) -> None: ...  # [m], [m], [rad]
    def compute(
        self,
        left: float,
        right: float,
        yaw_rate: float,
        speed: float,
        pose: Sequence[float] | None = None,
    ) -> list[float]: ...  # [rad/s], [rad/s], [rad/s], [m/s], (3,) -> (2,) [N m]
    def reset(self) -> None: ...
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    @property
    def options(self) -> DriveOptions: ...
    @property
    def braked(self) -> bool: ...
    @property
    def slipping(self) -> bool: ...
    @property
    def gauge(self) -> float: ...  # [m]
    @property
    def parking_phase(self) -> ParkingPhase: ...
    @property
    def reference(self) -> list[float]: ...  # (2,) [m/s], [rad/s]

# sim

class Brakes(_Given):
    @property
    def names(self) -> list[str]: ...
    def set_closed(self, joint: str, closed: bool) -> None: ...
    def close(self) -> None: ...
    def reset(self, closed: bool = False) -> None: ...
    def is_shut(self, joint: str) -> bool: ...
    def is_open(self, joint: str) -> bool: ...
    def load(self, joint: str) -> float: ...  # [N m] or [N]
    def max_load(self, joint: str) -> float: ...  # [N m] or [N]
    @property
    def power(self) -> float: ...  # [W]

class Physics:
    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None: ...
    def step(self, n: int = 1) -> int: ...
    def reset(self, keyframe: str) -> None: ...
    def state(self) -> list[float]: ...
    def restore(self, state: Sequence[float]) -> None: ...
    def ratio(self, joint: str) -> float: ...
    def effort_range(self, joint: str, speed: float) -> tuple[float, float]: ...  # [N m]
    @property
    def is_sound(self) -> bool: ...
    @property
    def brakes(self) -> Brakes: ...

def step(model: mujoco.MjModel, data: mujoco.MjData, n: int = 1) -> None: ...

class PowerMeter:
    def __init__(self, model: mujoco.MjModel) -> None: ...
    def read(self, physics: Physics) -> None: ...
    @property
    def mechanical(self) -> float: ...  # [W]
    @property
    def motors(self) -> float: ...  # [W]
    @property
    def total(self) -> float: ...  # [W]

class Battery:
    def __init__(
        self, *, capacity: float = 22320000.0, voltage: float = 96.0, resistance: float = 0.05
    ) -> None: ...
    def draw(self, power: float, seconds: float) -> None: ...  # [W], [s]
    @property
    def energy(self) -> float: ...  # [J]
    @property
    def charge(self) -> float: ...
    @property
    def lost(self) -> float: ...  # [J]
    @property
    def empty(self) -> bool: ...

def missions() -> list[str]: ...
def mission_scene(mission: str) -> str: ...
def servo_table(robot: str) -> dict[str, tuple[float, float]]: ...  # [kg m^2] or [kg], [rad/s]
def mode_ranges(mode: str) -> dict[str, tuple[float, float]]: ...  # [rad]

class BaseSource(_Enum):
    Held: ClassVar[BaseSource]
    Sensed: ClassVar[BaseSource]
    __members__: ClassVar[dict[str, BaseSource]]

class SensorModel:
    noise: float
    bias: float
    drift: float
    delay: int  # [samples]
    step: float
    def __init__(
        self,
        *,
        noise: float = 0.0,
        bias: float = 0.0,
        drift: float = 0.0,
        delay: int = 0,
        step: float = 0.0,
    ) -> None: ...

class RangeFinder:
    rays: int
    period: int  # [ticks]
    angle: float  # [rad]
    min_range: float  # [m]
    max_range: float  # [m]
    model: SensorModel  # [m]
    site: str
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

class FaultKind(_Enum):
    NotANumber: ClassVar[FaultKind]
    Frozen: ClassVar[FaultKind]
    __members__: ClassVar[dict[str, FaultKind]]

class SensorFault:
    entry: str
    kind: FaultKind
    start: float  # [s]
    def __init__(self, entry: str, kind: FaultKind = ..., start: float = 0.0) -> None: ...

class SensorOptions:
    models: dict[str, SensorModel]
    range: RangeFinder
    faults: list[SensorFault]
    hold_seconds: float  # [s]
    def __init__(
        self,
        *,
        models: Mapping[str, SensorModel] = ...,
        range: RangeFinder = ...,
        faults: Sequence[SensorFault] = ...,
        hold_seconds: float = 1.0,
    ) -> None: ...

class MonitorOptions:
    on: bool
    min_distance: float  # [m]
    min_margin: float  # [m]
    min_pressure_margin: float  # [m]
    min_tip_angle: float  # [rad]
    min_energy: float  # [J]
    max_temperature: float  # [deg C]
    max_power: float  # [W]
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

class SimulationOptions:
    seed: int
    variation: float
    method: str
    record: bool
    timed: bool
    base: BaseSource
    sensors: SensorOptions
    monitors: MonitorOptions
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
    ) -> None: ...

class Simulation:
    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        mission: str = "stretch",
        options: SimulationOptions = ...,
    ) -> None: ...
    def step(self, n: int = 1, command: ArrayLike | None = None) -> int: ...  # (k,) [SI unit/s]
    def reset(self, seed: int) -> None: ...
    def state(self) -> _Vector: ...
    def restore(self, state: ArrayLike) -> None: ...
    def operator_command(self) -> _Vector: ...  # (k,) [m/s] or [rad/s]
    @property
    def dt(self) -> float: ...  # [s]
    @property
    def time(self) -> float: ...  # [s]
    @property
    def finished(self) -> bool: ...
    @property
    def success(self) -> bool: ...
    @property
    def reason(self) -> str: ...
    @property
    def phase(self) -> str: ...
    @property
    def phases(self) -> list[str]: ...
    @property
    def command_names(self) -> list[str]: ...
    @property
    def command_scale(self) -> _Vector: ...  # (k,) [m/s] or [rad/s]
    def observation(self) -> _Vector: ...  # (m,)
    @property
    def observation_names(self) -> list[str]: ...
    @property
    def levels(self) -> list[str]: ...
    def level_errors(self) -> _Vector: ...  # measured, a level
    def commanded_level_errors(self) -> _Vector: ...
    def solver(self) -> dict[str, float]: ...  # status, factorizations, changes, optimality
    @property
    def channels(self) -> list[str]: ...
    def log(self) -> dict[str, _Vector]: ...  # (ticks,) each
    def timings(self) -> dict[str, _Vector]: ...  # (ticks,) each [s]
    def figures(self) -> dict[str, float]: ...  # NaN for what has not happened
    def thesis_figures(self) -> dict[str, float]: ...
    def events(self) -> list[tuple[float, str]]: ...  # [s]
    def limit_violation(self) -> dict[str, Any]: ...
    def sensors(self) -> dict[str, _Vector]: ...  # (m,) each
    def sensor_entries(self) -> dict[str, tuple[str, list[str]]]: ...
    def ray_angles(self) -> _Vector: ...  # (rays,) [rad]
    def monitors(self) -> dict[str, float]: ...
    def motor_temperatures(self) -> dict[str, float]: ...  # [deg C]
    def self_collision_pairs(self) -> list[tuple[str, str]]: ...
    def nearest_pair(self) -> tuple[str, str] | None: ...
    @property
    def held(self) -> bool: ...
