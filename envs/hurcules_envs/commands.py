"""What an action commands: the channels of a controller, by a keyword."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

import hurcules
from hurcules.validation import require_known

__all__ = ["ACTIONS", "channel_of", "joint_channel"]

ACTIONS = ("twist", "delta", "pose", "joint")

# by action: full scale of positions [m/s or m] and of orientations [rad/s or rad]
_SCALES: Mapping[str, tuple[float, float]] = {
    "twist": (0.3, 0.6),
    "delta": (0.05, 0.2),
    "pose": (2.0, 3.2),
}
LEAD = (0.10, 0.4)  # [m], [rad] the reference goes ahead of the hand at most


def channel_of(action: str, task: hurcules.Task, *, turns: bool = False) -> tuple[Any, float]:
    """A channel that moves a task, and its scale.

    Args:
        action: "twist" moves the reference at a velocity, "delta" puts it beside the measured
            value, "pose" sets it in the world.
        task: what is moved.
        turns: it is an orientation.

    Raises:
        hurcules.Error: another action.
    """
    require_known("action", action, ACTIONS)
    scale = _SCALES[action][int(turns)]
    if action == "twist":
        if isinstance(task, hurcules.ValueTask):
            task.max_lead = LEAD[int(turns)]
        return hurcules.Twist(task, scale), scale
    if action == "delta":
        return hurcules.Delta(task, scale), scale
    return hurcules.Target(task, scale), scale


def joint_channel(posture: hurcules.PostureTask, robot: hurcules.Robot) -> tuple[Any, Any]:
    """A channel that moves all coordinates by velocities, and its scales (n,) [rad/s].

    The scales are the coordinates' limits of velocity, at most 1.
    """
    scale = np.array([min(one.max_velocity, 1.0) for one in robot.coordinates])
    return hurcules.Twist(posture, scale), scale
