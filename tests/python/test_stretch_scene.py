"""The scene of the stretch: its person, and where it lies.

Source: [C] = docs/design/test-methods.md#casualties.
"""

import mujoco
import pytest

from robot_models import load, place


def test_the_casualty_weighs_75_kg_is_175_cm_tall_and_has_26_joints():  # [C]
    model = load("objects/casualty_75kg.xml")
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    assert mujoco.mj_getTotalmass(model) == pytest.approx(75.0, abs=0.05) and model.nv == 6 + 26
    head, foot = data.body("head").xpos[2], data.body("L_foot").xpos[2]
    assert head - foot == pytest.approx(1.75 * (0.870 - 0.039), abs=0.1)  # chin to ankle


def test_the_casualty_lies_at_rest_ahead_of_the_scoops():
    model = load("scenes/stretch.xml")
    data = mujoco.MjData(model)
    place(model, data, "stretch")
    first = model.joint("casualty_root").qposadr[0]
    start = data.qpos[first:].copy()
    mujoco.mj_step(model, data, 1000)
    assert abs(data.qpos[first:] - start).max() < 0.03
    assert abs(data.joint("casualty_root").qvel).max() < 0.02
    assert data.site("casualty_chest").xpos[0] == pytest.approx(2.72, abs=0.03)
