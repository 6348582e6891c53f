"""Whether the Jacobian of a task of one's own is the derivative of its value."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hurcules._core import CustomTask, Error, Robot

__all__ = ["check_jacobian"]

_STEP = 1e-6  # [rad] or [m]


def check_jacobian(task: CustomTask, robot: Robot, tolerance: float = 1e-4) -> None:
    """Compares a task's Jacobian with central differences of its value, where the robot stands.

    A wrong sign leads a robot away from its target, and nothing else tells. Constraints of
    velocities alone, whose value is always 0 (wheels that do not slide), fail by nature.

    Args:
        task: what a function measures.
        robot: its robot; left as it was.
        tolerance: that the two may differ by, relative to the largest entry of the row, or to 1.

    Raises:
        Error: they differ; names row and coordinate, and both numbers.
    """
    start, stood = robot.configuration.copy(), robot.qpos.copy()

    def value(q: NDArray[np.float64]) -> NDArray[np.float64]:
        robot.set_configuration(q)
        task.update(robot)
        return task.value.copy()

    task.update(robot)
    told = task.jacobian.copy()
    steps = _STEP * np.eye(robot.size)
    try:
        found = np.stack([value(start + h) - value(start - h) for h in steps], axis=1)
    finally:
        robot.set_qpos(stood)
        task.update(robot)
    found /= 2.0 * _STEP
    allowed = tolerance * np.maximum(1.0, np.abs(found).max(axis=1, keepdims=True))
    wrong = ~(np.abs(told - found) <= allowed)
    if wrong.any():
        row, column = np.unravel_index(np.argmax(np.abs(told - found) / allowed), told.shape)
        name, truth = robot.coordinate_names[column], found[row, column]
        raise Error(
            f"task '{task.name}': row {row} of its Jacobian has {told[row, column]:.4g} at "
            f"coordinate '{name}', where its value changes by {truth:.4g}; "
            f"{np.count_nonzero(wrong)} of {wrong.size} entries differ"
        )
