"""A robot that reaches hastily does not tip over: the zero moment point of what was commanded.

The point is that of MuJoCo's inverse dynamics of the commanded motion, the root free. What commands
is the same with and without the rows, by velocities and by accelerations.
"""

from __future__ import annotations

from itertools import pairwise

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import hurcules
from hurcules_envs.robots import RobotSetup, load_robot
from hurcules_envs.safety import support_polygon

Array = NDArray[np.float64]
DT, MARGIN = 0.004, 0.05
LAWS = ("velocity", "acceleration")


@pytest.fixture(scope="module")
def setup() -> RobotSetup:
    return load_robot("rescue")


def margins(setup: RobotSetup, motion: list[Array]) -> Array:
    """(t,) [m] of the zero moment point within the polygon; `motion`: qpos tick by tick."""
    model, data = setup.model, mujoco.MjData(setup.model)
    polygon, height = support_polygon(setup.model, setup.robot(), setup.support)
    rates, least = [], []
    for before, after in pairwise(motion):
        rate = np.zeros(model.nv)
        mujoco.mj_differentiatePos(model, rate, DT, before, after)
        rates.append(rate)
    support = model.body(setup.support).id
    for t in range(1, len(rates)):
        data.qpos[:], data.qvel[:] = motion[t], (rates[t - 1] + rates[t]) / 2
        data.qacc[:] = (rates[t] - rates[t - 1]) / DT
        mujoco.mj_fwdPosition(model, data)
        mujoco.mj_fwdVelocity(model, data)
        efforts = np.zeros(model.nv)
        mujoco.mj_rne(model, data, 1, efforts)
        force, moment = efforts[:3], data.xmat[1].reshape(3, 3) @ efforts[3:6]
        R, p = data.xmat[support].reshape(3, 3), data.xpos[support]
        ground = (R @ [0, 0, height] + p)[2]
        origin = data.xpos[1] - [0, 0, ground]
        moment = moment + np.cross(origin, force)
        point = np.array([-moment[1], moment[0], 0.0]) / force[2] + [0, 0, ground]
        x, y = (R.T @ (point - p))[:2]
        (left, low), (right, high) = polygon.min(axis=0), polygon.max(axis=0)
        least.append(min(x - left, right - x, y - low, high - y))
    return np.array(least)


def reach(setup: RobotSetup, law: str, rows: bool, seed: int = 0) -> Array:
    """Both hands go where they are told, elsewhere every 0.4 s, for 6 s; margins (t,)."""
    robot = setup.robot()
    hands = [hurcules.PositionTask(name, robot, name) for name in setup.hands]
    posture = hurcules.PostureTask("posture", robot)
    levels = [setup.limits(robot)]
    if rows:
        polygon, height = support_polygon(setup.model, setup.robot(), setup.support)
        levels += [
            hurcules.ZeroMomentTask("tip", robot, polygon, MARGIN, setup.support, height),
            hurcules.BalanceTask("balance", robot, polygon, 0.1, setup.support, height),
        ]
    stack = hurcules.Stack([*levels, hands, posture])
    if law == "velocity":
        options = hurcules.VelocityControllerOptions(dt=DT, max_acceleration=20.0)
        controller = hurcules.VelocityController(robot, options)
    else:
        options = hurcules.AccelerationControllerOptions(dt=DT, max_acceleration=20.0)
        controller = hurcules.AccelerationController(robot, options)
    controller.set_stack(stack)
    generator, motion = np.random.default_rng(seed), [robot.qpos.copy()]
    homes = [hand.value.copy() for hand in hands]
    for tick in range(round(6.0 / DT)):
        if tick % 100 == 0:
            for hand, home in zip(hands, homes, strict=True):
                hand.set_target(home + generator.uniform(-0.6, 0.6, 3))
        controller.step(robot)
        motion.append(robot.qpos.copy())
    return margins(setup, motion)


@pytest.mark.parametrize("law", LAWS)
def test_a_hasty_reach_keeps_the_zero_moment_point(setup: RobotSetup, law: str) -> None:
    kept = reach(setup, law, rows=True)
    assert kept.min() > MARGIN - 0.02
    assert reach(setup, law, rows=False).min() < 0.0, "nothing was there to be kept"
