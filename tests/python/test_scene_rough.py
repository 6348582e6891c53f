"""Rough ground has the spectrum that was asked for; friction and rolling resistance do their work.

Strategy: densities are estimated from the heights and compared with ISO 8608; grip is checked with
the robot on the ground against Coulomb's law and Newton's.
[D2] = docs/design/test-methods.md#rough-roads.
"""

import math

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import scenes
from standing import brake
from surface import Surface

# ---- rough ground


def psd(heights, cell):
    """One-sided density of straight cuts [m3] over wave number [cycles/m], averaged over cuts."""
    window = np.hanning(heights.shape[1])
    cuts = (heights - heights.mean(axis=1, keepdims=True)) * window
    density = 2 * abs(np.fft.rfft(cuts, axis=1)) ** 2 * cell / (window**2).sum()
    return np.fft.rfftfreq(heights.shape[1], cell), density.mean(axis=0)


@pytest.mark.parametrize("letter", "ABCDEFGH")
def test_a_road_has_the_density_of_its_class(letter):  # [D2] geometric means 16e-6 m3 x 4^k
    spec = scenes.make("rough_road", roughness=letter, length=100.0, width=40.0, seed=1)
    model = spec.compile()
    rows, columns = model.hfield_nrow[0], model.hfield_ncol[0]
    heights = model.hfield_data.reshape(rows, columns) * model.hfield_size[0, 2]
    n, density = psd(heights[:, 60:].astype(float), 0.1)  # behind the pad
    wanted = 16e-6 * 4.0 ** "ABCDEFGH".index(letter) * (np.maximum(n, 1e-9) / 0.1) ** -2
    for low, high in ((0.1, 0.3), (0.3, 1.0), (1.0, 3.0)):
        band = (n >= low) & (n < high)
        ratio = np.exp(np.log(density[band] / wanted[band]).mean())
        assert 0.7 < ratio < 1.4, (low, high, ratio)  # the class reaches from 0.5 to 2


def test_a_road_is_as_rough_across_as_along():
    model = scenes.make("rough_road", length=60.0, width=60.0, seed=8).compile()
    heights = model.hfield_data.reshape(model.hfield_nrow[0], -1) * model.hfield_size[0, 2]
    n, along = psd(heights[:, 60:].astype(float), 0.1)
    m, across = psd(heights[:, 60:].T.astype(float), 0.1)
    one = np.log(along[(n > 0.3) & (n < 3)]).mean() + 0.0
    other = np.log(across[(m > 0.3) & (m < 3)]).mean()
    assert one == pytest.approx(other, abs=0.3)


@pytest.mark.parametrize("kind", ["gravel", "sand"])
def test_a_bed_has_its_deviation_and_a_level_pad(kind):
    bed = Surface(kind, deviation=0.02, seed=3)
    x = np.arange(4.0, 16.0, 0.13)
    z = np.concatenate([bed.heights(x, y) for y in np.arange(-2.5, 2.6, 0.5)])
    assert z.std() == pytest.approx(0.02, rel=0.2)
    assert bed.heights(np.arange(-1.45, 1.45, 0.1), 0.3) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("kind", ["rough_road", "gravel", "sand"])
@pytest.mark.parametrize("robot", ["rescue", "manipulation"])
def test_a_robot_settles_on_rough_ground_without_sinking_in(kind, robot):
    model = scenes.load(kind, robot)
    brake(model)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    surface = Surface(kind)
    below = [surface.heights(np.arange(5.0, 6.3, 0.1), y) for y in np.arange(-0.4, 0.5, 0.1)]
    data.qpos[0], data.qpos[2] = 6.1, data.qpos[2] + np.max(below) + 0.005
    for _ in range(120):
        hurcules.step(model, data, 10)
    assert max(-c.dist for c in data.contact[: data.ncon]) < 3e-3
    assert not any(w.number for w in data.warning)
    assert np.linalg.norm(data.qvel[:3]) < 0.05
    assert data.body("upper_legs").xpos[2] > np.mean(below) + 0.10


# ---- grip


@pytest.mark.parametrize("friction, holds", [(0.30, False), (0.45, True)])
def test_the_robot_slides_below_the_friction_of_the_angle_only(friction, holds):
    model = scenes.load("slope", angle=math.radians(20), friction=friction)  # tan 20 = 0.364
    brake(model)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    mujoco.mj_forward(model, data)
    for _ in range(100):
        hurcules.step(model, data, 10)
    gone = float(np.linalg.norm(data.qpos[:3] - model.key("drive").qpos[:3]))
    g = 9.81
    theory = 0.5 * g * (math.sin(math.radians(20)) - friction * math.cos(math.radians(20)))
    assert gone == pytest.approx(0.0 if holds else theory, abs=5e-3 if holds else 0.1 * theory)


@pytest.mark.parametrize("f", [0.0, 0.05, 0.15])
def test_a_coasting_robot_is_slowed_by_its_rolling_resistance(f):
    model = scenes.load("flat", rolling_resistance=f)
    belts = [j for j in range(model.njnt) if model.joint(j).name.endswith("_belt")]
    inertia = sum(model.dof_armature[model.jnt_dofadr[j]] for j in belts)
    for joint in range(model.njnt):  # hold all but the belts
        spring = "_spring" in model.joint(joint).name
        free = model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE
        if joint not in belts and not free and not spring:
            model.dof_frictionloss[model.jnt_dofadr[joint]] = 5000.0
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    speed, radius = 2.0, 0.14
    data.qvel[0] = speed
    for joint in belts:
        data.qvel[model.jnt_dofadr[joint]] = speed / radius
    hurcules.step(model, data, 200)  # settle
    before = data.qvel[0]
    hurcules.step(model, data, 300)
    found = (before - data.qvel[0]) / 0.3
    # belts count as inertia; their bearings have 0.1 N m s each
    mass = 680.0 + inertia / radius**2
    theory = (f * 680.0 * 9.81 + 4 * 0.1 * before / radius**2) / mass
    assert found == pytest.approx(theory, rel=0.05, abs=0.01)
