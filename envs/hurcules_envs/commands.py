"""What an action commands: the channels of a controller, by a keyword."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

import hurcules
from hurcules.validation import require_known
from hurcules_envs.environment import Array, Environment, Group

__all__ = ["ACTIONS", "TWINS", "by_joints", "channel_of", "joint_channel"]

ACTIONS = ("twist", "delta", "pose", "joint")
TWINS = ("twist", "joint")  # of an environment that has no other than its own and the twin's

# by action: full scale of positions [m/s or m] and of orientations [rad/s or rad]
_SCALES: Mapping[str, tuple[float, float]] = {
    "twist": (0.3, 0.6),
    "delta": (0.05, 0.2),
    "pose": (2.0, 3.2),
}
_UNITS = {"twist": ("m/s", "rad/s"), "delta": ("m", "rad"), "pose": ("m", "rad")}
LEAD = (0.10, 0.4)  # [m], [rad] the reference goes ahead of the hand at most


def channel_of(action: str, task: hurcules.Task, *, turns: bool = False) -> tuple[Any, float, str]:
    """A channel that moves a task, its scale and its unit.

    Args:
        action: "twist" moves the reference at a velocity, "delta" puts it beside the measured
            value, "pose" sets it in the world.
        task: what is moved.
        turns: it is an orientation.

    Raises:
        hurcules.Error: another action.
    """
    require_known("action", action, ACTIONS)
    scale, unit = _SCALES[action][int(turns)], _UNITS[action][int(turns)]
    if action == "twist":
        if isinstance(task, hurcules.ValueTask):
            task.max_lead = LEAD[int(turns)]
        return hurcules.Twist(task, scale), scale, unit
    if action == "delta":
        return hurcules.Delta(task, scale), scale, unit
    return hurcules.Target(task, scale), scale, unit


def joint_channel(posture: hurcules.PostureTask, robot: hurcules.Robot) -> tuple[Any, Any, Any]:
    """A channel that moves all coordinates by velocities, its scales (n,) and units (n).

    The scales are the coordinates' limits of velocity, at most 1.
    """
    scale = np.array([min(one.max_velocity, 1.0) for one in robot.coordinates])
    units = [f"{one.unit}/s" for one in robot.coordinates]
    return hurcules.Twist(posture, scale), scale, units


def by_joints(
    environment: Environment,
    plan: hurcules.Robot,
    channels: Mapping[str, Any],
    beside: Mapping[str, float | Array],
) -> tuple[hurcules.PostureTask, dict[str, Any]]:
    """Makes velocities of all coordinates what a policy commands, for comparison.

    Its actions, their units and what is seen change: the coordinates, in place of the lead.

    Args:
        environment: whose actions, units, observation and quantities are set.
        plan: the robot.
        channels: by name, those of the environment's own action.
        beside: by channel the scale of what is commanded with the joints as before.

    Returns:
        The task that takes the place of all others after the limits and safe levels, and the
        channels of the controller.
    """
    joints = hurcules.PostureTask("joints", plan)
    channel, scale, units = joint_channel(joints, plan)
    kept = {name: unit for name, unit in environment.units.items() if name in beside}
    environment.units = {"joints": units, **kept}
    environment.actions, environment.components = {"joints": scale, **beside}, {}
    if "q" not in environment.quantities:
        seen = [group for group in environment.observation if group.name != "lead"]
        environment.observation = (*seen, Group("q", len(scale), "rad", 10.0, "coordinates"))
        environment.quantities = (*environment.quantities, "q")
    return joints, {"joints": channel} | {name: channels[name] for name in beside}
