"""Scenes have the shape that was asked for, measured by rays from above.

Strategy: no number is read from the model; heights are where a vertical ray meets the ground.
Numbers of the test methods: [C] = docs/design/test-methods.md#ground-robot-methods. Rough ground
and grip stand in test_scene_rough.py.
"""

import math

import mujoco
import numpy as np
import pytest

from hurcules import scenes
from surface import Surface

# ---- slopes


@pytest.mark.parametrize("degrees", [0, 10, 30, 45])
@pytest.mark.parametrize("direction, axis, sign", [("up", 0, 1), ("down", 0, -1), ("across", 1, 1)])
def test_a_slope_has_its_angle_and_direction(degrees, direction, axis, sign):
    slope = Surface("slope", angle=math.radians(degrees), direction=direction)
    far = np.zeros(2)
    far[axis] = 3.0
    rise = slope.height(*far) - slope.height(*-far)
    assert math.degrees(math.atan2(rise, 6.0)) == pytest.approx(sign * degrees, abs=1e-6)
    assert slope.height(0, 0) == pytest.approx(0, abs=1e-9)
    assert slope.height(*far[::-1]) == pytest.approx(0, abs=1e-9)  # level along the other axis


@pytest.mark.parametrize("direction, nose", [("up", 0.5), ("down", -0.5), ("across", 0.0)])
def test_the_robot_lies_flat_on_the_slope_and_looks_the_right_way(direction, nose):
    model = scenes.load("slope", direction=direction)  # 30 degrees: sine 0.5
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    mujoco.mj_kinematics(model, data)
    axes = data.body("upper_legs").xmat.reshape(3, 3)
    assert axes[2, 0] == pytest.approx(nose, abs=1e-6)
    assert axes[2, 2] == pytest.approx(math.cos(math.radians(30)), abs=1e-6)
    assert axes[2, 1] == pytest.approx(0.5 if direction == "across" else 0.0, abs=1e-6)


@pytest.mark.parametrize("degrees", [15, 30, 45])  # [C] E2803
def test_an_incline_rises_from_its_foot_to_its_landing(degrees):
    angle, length, foot = math.radians(degrees), 3.0, 2.5
    incline = Surface("incline", angle=angle, length=length, distance=foot, landing=2.0)
    assert incline.height(foot - 0.01) == 0.0
    near, far = incline.height(foot + 0.2), incline.height(foot + 1.8)
    assert math.atan2(far - near, 1.6) == pytest.approx(angle, abs=1e-5)
    top = foot + length * math.cos(angle)
    rise = length * math.sin(angle)
    assert incline.heights(np.array([top + 0.01, top + 1.99])) == pytest.approx(rise, abs=1e-5)
    assert incline.height(top + 2.01) == 0.0


# ---- gaps and hurdles


@pytest.mark.parametrize("width", [0.1, 0.5, 1.0])  # [C] E2801: from 0.10 m
def test_a_gap_is_as_wide_as_asked(width):
    gap = Surface("gap", width=width, height=0.7)
    edges = gap.edges(0.0, 5.0)
    assert edges == pytest.approx([2.0, 2.0 + width], abs=2e-3)
    assert gap.height(0) == 0.0 and gap.height(2.0 + width / 2) == pytest.approx(-0.7)
    assert gap.edges(-1.5, 1.5, y=1.19) == [] and gap.height(0, 1.21) == pytest.approx(-0.7)


@pytest.mark.parametrize("degrees", [0, 40])
def test_a_trench_is_as_wide_and_deep_as_asked(degrees):
    angle = math.radians(degrees)
    trench = Surface("trench", width=0.4, depth=0.6, angle=angle)
    edges = trench.edges(1.0, 4.0)
    assert edges[0] == pytest.approx(2.0, abs=2e-3)
    assert (edges[1] - edges[0]) * math.cos(angle) == pytest.approx(0.4, abs=4e-3)
    assert trench.height(2.0 + 0.2) == pytest.approx(-0.6, abs=1e-6)
    assert trench.height(0) == trench.height(4.0) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("rolling", [False, True])
@pytest.mark.parametrize("height", [0.1, 0.3])  # [C] E2802
def test_a_hurdle_has_its_height_thickness_and_round_edges(height, rolling):
    hurdle = Surface("hurdle", height=height, thickness=0.2, edge_radius=0.04, rolling=rolling)
    assert hurdle.height(1.999) == hurdle.height(2.201) == 0.0
    assert hurdle.height(2.1) == pytest.approx(height, abs=1e-6)
    for into in (0.01, 0.02, 0.03):  # a quarter of a circle
        z = height - 0.04 + math.sqrt(0.04**2 - (0.04 - into) ** 2)
        for x in (2.0 + into, 2.2 - into):
            assert hurdle.height(x) == pytest.approx(z, abs=1e-6)


def test_the_pipes_of_a_rolling_hurdle_turn_freely():
    hurdle = Surface("hurdle", rolling=True)
    data = hurdle.data
    data.joint("hurdle_pipe_near").qvel[0] = 5.0
    mujoco.mj_step(hurdle.model, data, 200)
    assert data.joint("hurdle_pipe_near").qpos[0] > 0.7
    assert data.joint("hurdle_pipe_far").qpos[0] == 0.0


# ---- steps and stairs


def test_steps_go_up_and_down_again():
    steps = Surface("steps", height=0.2, run=0.5, count=2, platform=1.0)
    middles = 2.0 + np.array([-0.2, 0.25, 0.75, 1.25, 1.75, 2.2])
    assert steps.heights(middles) == pytest.approx([0, 0.2, 0.4, 0.4, 0.2, 0], abs=1e-9)
    assert steps.edges(1.5, 4.5) == pytest.approx([2.0, 2.5, 3.5, 4.0], abs=2e-3)


@pytest.mark.parametrize("open_risers", [False, True])
@pytest.mark.parametrize("degrees", [30, 35, 40, 45])  # [C] E2804, riser 0.20 m
def test_stairs_have_their_riser_and_pitch(degrees, open_risers):
    pitch = math.radians(degrees)
    stairs = Surface("stairs", pitch=pitch, open_risers=open_risers)
    run = 0.2 / math.tan(pitch)
    treads = stairs.heights(2.0 + run * (np.arange(5) + 0.5))
    assert treads == pytest.approx(0.2 * np.arange(1, 6), abs=1e-9)
    edges = stairs.edges(1.9, 2.0 + 4.5 * run)
    assert edges == pytest.approx(2.0 + run * np.arange(5), abs=0.021 if open_risers else 2e-3)
    assert stairs.height(2.0 + 4 * run + 2.39) == pytest.approx(1.0)  # the landing, 2.4 m


def test_one_looks_through_open_risers_only():
    for open_risers in (False, True):
        stairs = Surface("stairs", open_risers=open_risers)
        geom = np.zeros(1, np.int32)
        start, ahead = np.array([0.0, 0.0, 0.3]), np.array([1.0, 0.0, 0.0])
        distance = mujoco.mj_ray(stairs.model, stairs.data, start, ahead, None, 1, -1, geom)
        assert (distance > 2.5) is open_risers  # behind the second riser


# ---- ramps and step fields


def test_continuous_ramps_meet_at_their_edges():
    ramps = Surface("ramps", rows=4, columns=2)
    x = np.arange(2.05, 6.75, 0.05)
    for y in (-0.6, 0.6):
        z = ramps.heights(x, y)
        assert abs(np.diff(z)).max() < 0.05 * math.tan(math.radians(15)) + 0.006
        assert np.ptp(z) == pytest.approx(1.2 * math.tan(math.radians(15)), abs=0.02)  # [C] 0.3215
    inside = ramps.height(2.0 + 0.9, 0.3) - ramps.height(2.0 + 0.3, 0.3)
    assert math.degrees(math.atan2(inside, 0.6)) == pytest.approx(15, abs=1e-4)
    assert ramps.height(2.9, 0.5) == pytest.approx(ramps.height(2.9, -0.5))


def test_crossing_ramps_break_at_their_edges_and_rise_by_the_same_angle():
    ramps = Surface("ramps", pattern="crossing", rows=4, columns=2)
    slopes = set()
    for i in range(4):
        for j in range(2):
            x, y = 2.0 + 1.2 * (i + 0.5), 1.2 * (j - 0.5)
            dx = ramps.height(x + 0.3, y) - ramps.height(x - 0.3, y)
            dy = ramps.height(x, y + 0.3) - ramps.height(x, y - 0.3)
            assert math.degrees(math.atan2(math.hypot(dx, dy), 0.6)) == pytest.approx(15, abs=1e-3)
            slopes.add((round(np.sign(round(dx, 6))), round(np.sign(round(dy, 6)))))
    assert {(1, 0), (0, 1)} <= slopes and len(slopes) >= 3
    # along the middle between two cells' centres the surface breaks
    assert ramps.edges(2.1, 6.7, y=0.3) != []


def test_a_turned_field_of_ramps_can_be_driven_along_its_ridges():
    ramps = Surface("ramps", heading=math.pi / 2, rows=2, columns=6)
    z = ramps.heights(np.arange(2.1, 9.1, 0.1), y=0.3)
    assert np.ptp(z) < 1e-6 and z[0] > 0.1


@pytest.mark.parametrize("pattern, peak", [("hill", 4), ("diagonal", 3), ("flat", 4)])
def test_step_fields_have_whole_units_and_half_turn_symmetry(pattern, peak):
    field = Surface("step_field", pattern=pattern, peak=peak, pallets=1, seed=5)
    at = 0.1 * np.arange(12) + 0.05
    z = np.array([[field.height(2.0 + x, y - 0.6) for y in at] for x in at])
    units = np.round(z / 0.1)
    assert z == pytest.approx(0.1 * units, abs=1e-9)
    assert np.array_equal(units, units[::-1, ::-1])
    assert units.max() == (peak if pattern != "flat" else 2) and units.min() >= 0
    if pattern == "hill":  # [C] perpendicular hill: higher in the middle than at both ends
        rows = units.mean(axis=1)
        assert rows[5] > rows[0] + 1 and rows[6] > rows[11] + 1


def test_a_dash_is_five_pallets_in_line():  # [C] E2828
    field = Surface("step_field", seed=2)
    assert field.height(2.0 + 5 * 1.2 + 0.05) == 0.0
    assert max(field.heights(np.arange(2.05 + 4.8, 8.0, 0.1), 0.05)) > 0.05
