"""The manipulation robot that stands before something, a hand where it is wanted."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules

__all__ = ["SETTLING", "SUPPORT", "place_hands", "settle"]

SUPPORT = "lower_leg_L"
TUCKED: Mapping[str, float] = MappingProxyType({"SP": -0.4, "EB": 1.2})  # [rad]
SETTLING = 1.0  # [s] until the robot stands and its arms hang still


def place_hands(
    model: mujoco.MjModel,
    places: Mapping[str, NDArray[np.float64]],
    joints: Mapping[str, float] | None = None,
) -> hurcules.Robot:
    """The robot in its posture "ready", hands pointing forward where they are wanted.

    Args:
        model: with the robot "manipulation".
        places: by "L" or "R" of the tcp in the world [m]; an arm that is not named is drawn back.
        joints: of no coordinate, fingers say, [rad] or [m]; the others as in the posture.

    Raises:
        hurcules.Error: a place is out of reach.
    """
    coarse = hurcules.models.with_timestep(model, 0.02)
    robot = hurcules.Robot(coarse)
    robot.set_keyframe("ready")
    robot.stand_on(SUPPORT)
    q = robot.configuration
    for side in set("LR") - set(places):
        for joint, angle in TUCKED.items():
            q[robot.coordinate(side + joint)] = angle
    robot.set_configuration(q)
    tasks: list[hurcules.Task] = []
    for side in places:
        tasks.append(hurcules.PositionTask(f"{side} place", robot, f"{side}_tcp"))
        tasks.append(hurcules.OrientationTask(f"{side} turn", robot, f"{side}_tcp"))
    posture = hurcules.PostureTask("posture", robot)
    channels = {task.name: hurcules.Target(task) for task in tasks}
    controller = hurcules.WholeBodyController(
        robot, [tasks, posture], channels, dt=0.02, support=SUPPORT,
        torque_scaling=False,
    )  # fmt: skip
    simulation = hurcules.Simulation(
        model=coarse, controller=controller, record=False, physics=False
    )
    command = {f"{side} place": np.asarray(place) for side, place in places.items()}
    simulation.step(400, command)
    qpos = np.array(simulation.data.qpos)
    for name, value in (joints or {}).items():
        qpos[model.joint(name).qposadr[0]] = value
    placed = hurcules.Robot(model)
    placed.set_qpos(qpos)
    placed.stand_on(SUPPORT)
    for side, place in places.items():
        miss = float(np.linalg.norm(placed.position(f"{side}_tcp") - place))
        if miss > 2e-3:
            raise hurcules.Error(f"hand {side}: {1e3 * miss:.0f} mm short of {place}")
    return placed


def settle(simulation: hurcules.Simulation) -> hurcules.Robot:
    """A robot where the simulation comes to rest."""
    simulation.step(round(SETTLING / simulation.dt))
    robot = hurcules.Robot(simulation.model)
    robot.set_qpos(simulation.data.qpos)
    robot.stand_on(SUPPORT)
    q, ends = robot.configuration, robot.coordinates
    within = np.clip(q, [one.lower for one in ends], [one.upper for one in ends])
    if (within != q).any():  # it may rest at a stop
        robot.set_configuration(within)
    return robot
