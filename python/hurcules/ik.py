"""A posture that meets all tasks at once, where the way there is not known."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hurcules._core import (
    Error,
    JointLimits,
    Robot,
    Stack,
    StackLevel,
    Task,
    VelocityController,
    VelocityControllerOptions,
)

__all__ = ["Posture", "inverse_kinematics", "within_balls"]

Level = Task | JointLimits | StackLevel | Sequence[Task | JointLimits]

DT, GAIN = 0.02, 20.0  # [s], [1/s] of a descent
LEAST, MOST = 10, 1000  # [s] that it takes, unless it ends by itself: a base may have far to go
WAY = 0.1  # [m or rad] that one which goes on beyond LEAST comes nearer in a second
REST = 1e-5  # [rad/s] or [m/s]: it goes no farther
FREE = np.pi  # [rad] or [m] to either side of where a coordinate without range stands


@dataclass(frozen=True)
class Posture:
    """What was found.

    Attributes:
        configuration: (n,) of the robot, within its limits.
        error: [m or rad] the largest that any row of a task lacks.
        reached: no row lacks more than the tolerance.
        starts: how many descents began, and how many of them reached.
        qpos: (nq,) the whole of it, for `Robot.set_qpos`: joints that close loops may stand in more
            than one way at the same configuration.
    """

    configuration: NDArray[np.float64]
    error: float
    reached: bool
    starts: tuple[int, int]
    qpos: NDArray[np.float64] = field(repr=False)

    def __array__(self, dtype: Any = None, copy: bool | None = None) -> NDArray[np.float64]:
        """The configuration, so that `robot.set_configuration` and a `PostureTask` take it."""
        return np.array(self.configuration, dtype)


def inverse_kinematics(
    robot: Robot,
    tasks: Sequence[Level],
    *,
    starts: int = 32,
    seed: int = 0,
    tolerance: float = 1e-4,
) -> Posture:
    """The posture nearest to the present one, of those found, that meets all tasks.

    Where none does: the one that lacks least in the first level, then in the second, and so on.

    A controller descends from where the robot stands; where limits or singularities end the
    descent, others begin at random postures, each farther from the present one than the last.
    What a controller cannot reach from here in one go (the target wants an elbow or a wrist turned
    the other way) it reaches by this posture: give it to a `PostureTask` that no task of the hand
    comes before, then add the hand. Nothing is said of the way between the two.

    Args:
        robot: stays as it is.
        tasks: what shall be met, in decreasing priority, as for a controller; limits such as
            distances come first and shall hold.
        starts: descents at most.
        seed: of the random postures; same arguments, same posture.
        tolerance: [m or rad] of each row.

    Raises:
        Error: no task, fewer than one start, or a tolerance that is not positive.
    """
    levels = list(tasks)
    wanted = [_tasks_of(level) for level in levels]
    if not any(wanted):
        raise Error("inverse_kinematics: wanted at least one task")
    if starts < 1:
        raise Error(f"inverse_kinematics: starts wants a number >= 1, got {starts}")
    if not tolerance > 0.0:
        raise Error(f"inverse_kinematics: tolerance wants a positive number, got {tolerance}")
    present, whole = robot.configuration, robot.qpos
    lower, upper = _ranges(robot)
    inside = np.clip(present, lower, upper)
    generator = np.random.default_rng(seed)
    found: list[tuple[list[float], NDArray[np.float64], NDArray[np.float64]]] = []
    try:
        for start in range(starts):
            short = _descend(robot, levels, wanted, tolerance)
            found.append((short, robot.configuration, robot.qpos))
            if max(found[0][0]) <= tolerance:
                break
            drawn = within_balls(robot, generator.uniform(lower, upper))
            robot.set_qpos(whole)
            with warnings.catch_warnings():  # a descent begins anywhere
                warnings.filterwarnings("ignore", "the loops that")
                robot.set_configuration(inside + (start + 1) / starts * (drawn - inside))
    finally:
        robot.set_qpos(whole)
        for task in (task for level in wanted for task in level):
            task.update(robot)
    met = [one for one in found if max(one[0]) <= tolerance]
    if met:
        short, configuration, qpos = min(met, key=lambda one: np.abs(one[1] - present).max())
    else:  # what differs by less than the tolerance is alike
        short, configuration, qpos = min(
            found, key=lambda one: [int(s / tolerance) for s in one[0]]
        )
    return Posture(configuration, max(short), bool(met), (len(found), len(met)), qpos)


def _tasks_of(level: Level) -> Sequence[Task]:
    if isinstance(level, Task | JointLimits):
        level = [level]
    tasks = level.tasks if isinstance(level, StackLevel) else level
    return [task for task in tasks if isinstance(task, Task)]


def _ranges(robot: Robot) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Of random postures, (n,) each."""
    lower = np.array([one.lower for one in robot.coordinates])
    upper = np.array([one.upper for one in robot.coordinates])
    free = ~np.isfinite(upper - lower)
    q = robot.configuration
    return np.where(free, q - FREE, lower), np.where(free, q + FREE, upper)


def within_balls(robot: Robot, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same with ball joints turned no further than their ranges, (n,)."""
    for i, coordinate in enumerate(robot.coordinates):
        joint = coordinate.joints[0]
        if joint.part == 3:
            angle = float(np.linalg.norm(q[i : i + 3]))
            q[i : i + 3] *= min(1.0, coordinate.upper / angle) if angle > 0.0 else 1.0
    return q


def _descend(
    robot: Robot,
    levels: Sequence[Level],
    wanted: Sequence[Sequence[Task]],
    tolerance: float,
) -> list[float]:
    """Moves the robot as far as it goes; what each level lacks there [m or rad]."""
    options = VelocityControllerOptions(dt=DT, gain=GAIN, max_acceleration=np.inf, transition=0.0)
    controller = VelocityController(robot, options)
    controller.set_stack(Stack(list(levels)))
    nearest = [np.inf] * len(wanted)
    for tick in range(1, round(MOST / DT) + 1):
        controller.step(robot)
        short = [max((_lacking(robot, task) for task in level), default=0.0) for level in wanted]
        if max(short) <= 0.1 * tolerance or np.abs(controller.velocity).max() < REST:
            break
        seconds, rest = divmod(tick, round(1.0 / DT))
        if rest == 0:
            goes_on = any(now < one - WAY for now, one in zip(short, nearest, strict=True))
            if seconds >= LEAST and not goes_on:
                break
            nearest = [min(both) for both in zip(short, nearest, strict=True)]
    return short


def _lacking(robot: Robot, task: Task) -> float:
    task.update(robot)
    error = task.error
    short = np.abs(np.clip(error, task.lower, task.upper) - error)
    return float(short[task.weights > 0.0].max(initial=0.0))
