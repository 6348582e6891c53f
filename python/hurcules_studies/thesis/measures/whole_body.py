"""The manipulation robot moved by its references alone: 19 coordinates, the stack of section 4.3.2.

  joint < lhpos < rhpos < lhor < rhor < {pel, body} < swivel < gaze, rho = 0.1, K = 5, dt = 1 ms

`Body` holds robot, tasks and controller; `follow` moves it along a command and keeps every tick.
`Setting.as_printed` takes a limit within one step, T = 1 of 4.3.9, which makes the thesis' jumps;
the controller's own bounds brake in time.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import Stack, StackLevel, rhqp
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "LEVELS", "Body", "Log", "Setting", "follow"]

DT = 1e-3  # [s]
LEVELS = ("joint", "lhpos", "rhpos", "lhor", "rhor", "pel", "swivel", "gaze")
NO_LIMIT = 1e9  # [rad/s^2]

Command = Callable[[float], Mapping[str, Array]]  # time [s] -> velocities of tasks, by name
Posture = Mapping[str, float]


@dataclass(frozen=True)
class Setting:
    """How the hierarchy is solved, and what bounds the velocities."""

    method: str = "lexicographic"
    as_printed: bool = False  # 4.3.9 with T = 1, no limit of acceleration
    clamped: bool = True  # within the joints' speed limits
    max_iterations: int = 100
    # a solve that takes so many iterations is too late for its tick: the thesis then commands zero
    too_late: int = 10**9
    rho: float = 0.1

    @property
    def options(self) -> hurcules.VelocityControllerOptions:
        """Those of the controller."""
        smooth = "smooth" if self.method == "lexicographic" else "strict"
        solver = rhqp.SolverOptions(
            method=self.method, max_iterations=self.max_iterations, handover=smooth
        )
        options = hurcules.VelocityControllerOptions(dt=DT, law="thesis", solver=solver)
        if self.as_printed:
            options.horizon = DT
            options.max_acceleration = NO_LIMIT
        return options


class Body:
    """The robot standing on its lower legs, its tasks and its controller.

    Attributes:
        robot: at the reference.
        tasks: by name; a new task holds what is.
        controller: of the stack.
    """

    def __init__(
        self,
        posture: Posture,
        setting: Setting = Setting(),
        model: mujoco.MjModel | None = None,
    ) -> None:
        self.model = model or hurcules.models.load("manipulation")
        self.robot = robot = hurcules.Robot(self.model)
        robot.set_keyframe("ready")
        robot.stand_on("lower_leg_L")
        names, q = robot.coordinate_names, robot.configuration
        for name, angle in posture.items():
            q[names.index(name)] = angle
        robot.set_configuration(q)
        self.limits = hurcules.JointLimits("joint", robot)
        if not setting.clamped:
            for name in names:
                self.limits.set_max_velocity(name, np.inf)
        # of many kinds: value, target and orientation are asked of those that have them
        self.tasks: dict[str, Any] = dict(_tasks(robot))
        self.setting = setting
        self.controller = hurcules.VelocityController(robot, setting.options)
        self.controller.set_stack(self.stack())
        for task in self.tasks.values():
            task.hold(robot)

    def stack(self) -> Stack:
        """All levels; as the thesis orders them (figure 4.11)."""
        t = self.tasks
        groups = [
            ("lhpos", ["lhpos"]),
            ("rhpos", ["rhpos"]),
            ("lhor", ["lhor"]),
            ("rhor", ["rhor"]),
            ("pel", ["pelx", "pelpitch", "body"]),
            ("swivel", ["lswivel", "rswivel"]),
            ("gaze", ["gaze"]),
        ]
        rho = self.setting.rho
        levels = [StackLevel(name, [t[task] for task in tasks], rho) for name, tasks in groups]
        return Stack([self.limits, *levels])

    def level_errors(self) -> list[float]:
        """Norm of the errors of each level below the limits, as of the last tick."""
        t = self.tasks
        pel = [t["pelx"], t["pelpitch"], t["body"]]
        swivel = [t["lswivel"], t["rswivel"]]
        groups = [[t["lhpos"]], [t["rhpos"]], [t["lhor"]], [t["rhor"]], pel, swivel, [t["gaze"]]]
        return [
            float(np.sqrt(sum(float(task.error @ task.error) for task in group)))
            for group in groups
        ]


def _tasks(robot: hurcules.Robot) -> dict[str, hurcules.Task]:
    ahead = np.array([[1.0, 0.0, 0.0]])
    tasks: list[hurcules.Task] = [
        hurcules.PositionTask("lhpos", robot, "L_tcp"),
        hurcules.PositionTask("rhpos", robot, "R_tcp"),
        hurcules.OrientationTask("lhor", robot, "L_tcp"),
        hurcules.OrientationTask("rhor", robot, "R_tcp"),
        hurcules.PositionTask("pelx", robot, "pelvis", axes=ahead),
        hurcules.AngleTask("pelpitch", robot, "pelvis"),
        hurcules.AngleTask("body", robot, "torso", kind=hurcules.AngleKind.Heading),
        hurcules.GazeTask("gaze", robot, "gaze"),
    ]
    for side in "LR":
        frames = {part: f"{side}_{part}" for part in ("shoulder", "elbow", "wrist")}
        tasks.append(hurcules.SwivelTask(f"{side.lower()}swivel", robot, torso="torso", **frames))
    return {task.name: task for task in tasks}


@dataclass
class Log:
    """Every tick of a motion; (ticks, ...) each.

    Attributes:
        names: of the coordinates.
        time: [s].
        q: [rad], qd: [rad/s]: the commanded motion.
        active: -1, 0, 1: held back by the lower limit, by none, by the upper one.
        errors: of the levels below the limits, [m] or [rad].
        iterations: of the solve: changes of the working set + 1.
        capped: whether the solve ended at the limit of iterations.
        excess: worst excess over a position limit [rad]; one number.
        failed: ticks in which the solver gave up; one number.
    """

    names: list[str]
    time: Array
    q: Array
    qd: Array
    active: Array
    errors: Array
    iterations: Array
    capped: NDArray[np.bool_]
    excess: float = 0.0
    failed: int = 0

    def of(self, name: str) -> int:
        """Column of a coordinate."""
        return self.names.index(name)

    def first(self, name: str, side: int) -> float:
        """When a limit is first taken [s]; NaN for never."""
        times = self.time[self.active[:, self.of(name)] == side]
        return float(times[0]) if times.size else float("nan")

    def last(self, name: str, side: int) -> float:
        """When a limit is last held [s]; NaN for never."""
        times = self.time[self.active[:, self.of(name)] == side]
        return float(times[-1]) if times.size else float("nan")

    @cached_property
    def arm(self) -> Array:
        """Largest joint speed of the left arm, (ticks,) [rad/s]."""
        columns = [i for i, name in enumerate(self.names) if name.startswith("L")]
        return np.asarray(np.abs(self.qd[:, columns]).max(axis=1))

    def changes(self, start: float = 0.1) -> float:
        """Most changes of the working set in a tick after the start, a phase change of its own."""
        return float(self.iterations[self.time >= start].max()) - 1.0

    def speed(self, *names: str) -> Array:
        """Largest speed of some coordinates, (ticks,) [rad/s]."""
        return np.asarray(np.abs(self.qd[:, [self.of(name) for name in names]]).max(axis=1))


def follow(body: Body, command: Command, seconds: float, stop_at: float = np.inf) -> Log:
    """Moves the references and follows them.

    Args:
        body: at its start.
        command: velocities of the tasks' references, others rest.
        seconds: [s].
        stop_at: [rad/s] ends the motion early at a speed that no machine has.
    """
    robot, controller = body.robot, body.controller
    ticks = round(seconds / DT)
    n = robot.size
    log = Log(
        names=robot.coordinate_names,
        time=np.asarray(DT * np.arange(ticks)),
        q=np.zeros((ticks, n)),
        qd=np.zeros((ticks, n)),
        active=np.zeros((ticks, n)),
        errors=np.zeros((ticks, len(LEVELS) - 1)),
        iterations=np.zeros(ticks),
        capped=np.zeros(ticks, dtype=bool),
    )
    q = robot.configuration
    bad = (rhqp.Status.InvalidInput, rhqp.Status.LostPrecision)
    for i in range(ticks):
        velocities = command(DT * i)
        for name, velocity in velocities.items():
            body.tasks[name].advance(velocity, DT)
        velocity = controller.compute(robot)
        solution = controller.solution
        log.iterations[i] = solution.changes + 1
        log.capped[i] = solution.status == rhqp.Status.IterationLimit
        log.failed += solution.status in bad
        if log.iterations[i] >= body.setting.too_late:
            velocity = np.zeros(n)
            new_q = q
        else:
            new_q = controller.integrate(q)
        log.q[i], log.qd[i] = q, velocity
        log.active[i] = controller.active_limits
        log.errors[i] = body.level_errors()
        q = new_q
        robot.set_configuration(q)
        log.excess = max(
            log.excess, float(np.max(body.limits.lower - q)), float(np.max(q - body.limits.upper))
        )
        if np.abs(velocity).max() > stop_at:
            return _cut(log, i + 1)
    return log


def _cut(log: Log, ticks: int) -> Log:
    names = ("time", "q", "qd", "active", "errors", "iterations", "capped")
    return replace(log, **{name: getattr(log, name)[:ticks] for name in names})
