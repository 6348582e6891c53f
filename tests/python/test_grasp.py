"""Towing of grasped sleds (E2830): the hands hold the handle, up to what their spindles bear.

Strategy: short ways with masses far on both sides of what the law in field_tests/grasp.py
allows. Not tested: the largest mass itself, which is a result.
"""

from __future__ import annotations

import dataclasses
import math

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import scenes
from hurcules_studies import field_tests
from hurcules_studies.field_tests.grasp import LOST, Grasp

METHOD = field_tests.method("e2830")
SHORT = dataclasses.replace(METHOD, distance=1.0)


def test_a_light_sled_is_dragged_backward() -> None:
    sled = []

    def watch(model: mujoco.MjModel, qpos: np.ndarray, time: float) -> None:
        sled.append(qpos[model.joint("sled_root").qposadr[0]])

    done = field_tests.repeat(SHORT, 75.0, "manipulation", 0, watch=watch)
    assert done.fault == ""
    assert done.x == pytest.approx(-1.0, abs=0.02)
    assert sled[-1] - sled[0] == pytest.approx(-1.0, abs=0.05)  # it comes along


def test_a_heavy_one_opens_the_fingers() -> None:
    # mu m g / (cos b + mu sin b) = 1.3 kN at a steady speed, two hands hold 0.8 kN
    done = field_tests.repeat(SHORT, 300.0, "manipulation", 0)
    assert done.fault == "lost grip" and done.metres < 0.5


def test_a_robot_without_hands_is_refused() -> None:
    with pytest.raises(hurcules.Error, match="wanted the robot 'manipulation'"):
        field_tests.repeat(SHORT, 75.0, "rescue", 0)


def held() -> tuple[mujoco.MjModel, mujoco.MjData, Grasp]:
    """A robot that looks along 0.5 rad at (1, 2), about to hold the handle."""
    model = scenes.load("sled", "manipulation", mass=75.0)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    posture = METHOD.plan(None)(0.0)
    data.qpos[:2] = 1.0, 2.0
    data.qpos[3:7] = math.cos(0.25), 0.0, 0.0, math.sin(0.25)
    for joint, angle in (("LKN", posture.knee), ("RKN", posture.knee), ("HIP", posture.hip)):
        data.joint(joint).qpos[0] = angle
    return model, data, Grasp(model, data)


def test_the_handle_lies_between_the_fingers_wherever_the_robot_stands() -> None:
    _, data, _ = held()
    middle = (data.site("L_tcp").xpos + data.site("R_tcp").xpos) / 2
    # the pads are 40 mm wide
    assert np.linalg.norm(data.site("sled_handle").xpos - middle) < 2e-3
    across = data.site("L_tcp").xpos - data.site("R_tcp").xpos
    bar = data.geom("sled_handle").xmat.reshape(3, 3)[:, 2]
    assert abs(bar @ across) == pytest.approx(np.linalg.norm(across), rel=1e-3)


def test_a_handle_that_moves_in_a_hand_is_lost() -> None:
    model, data, grasp = held()
    grasp.begin(data)
    root = data.joint("sled_root").qpos
    root[0] += 0.9 * LOST
    mujoco.mj_kinematics(model, data)
    assert not grasp.lost(data)
    root[0] += 0.2 * LOST
    mujoco.mj_kinematics(model, data)
    assert grasp.lost(data)
