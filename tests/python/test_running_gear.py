"""The tracks are seen to move: pads, sprockets and road wheels turn with their belts.

Strategy: abstract scenes, as a renderer would draw them; no picture is made. Sizes as the meshes
are made: models/assets/running_gear.py.
"""

import mujoco
import numpy as np
import pytest

from hurcules import models
from hurcules.running_gear import RunningGear

RADIUS, BAND = 0.14, 0.126
LENGTH = {"lower": 2 * 0.85 + 2 * np.pi * BAND, "upper": 2 * 0.55 + 2 * np.pi * BAND}
ROWS = {kind: int(length / 0.058) for kind, length in LENGTH.items()}


@pytest.fixture(scope="module")
def robot():
    model = models.load("rescue")
    return model, mujoco.MjData(model), RunningGear(model)


def drawn(robot, angle, scene=None, contacts=False):
    """All geoms of a scene with the belts at an angle: mesh name, position and axes."""
    model, data, gear = robot
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    for joint in range(model.njnt):
        if model.joint(joint).name.endswith("_belt"):
            data.qpos[model.jnt_qposadr[joint]] = angle
    mujoco.mj_forward(model, data)
    scene = scene or mujoco.MjvScene(model, 2000)
    option, everything = mujoco.MjvOption(), mujoco.mjtCatBit.mjCAT_ALL
    option.flags[mujoco.mjtVisFlag.mjVIS_CONTACTPOINT] = contacts
    mujoco.mjv_updateScene(model, data, option, None, mujoco.MjvCamera(), everything, scene)
    gear.show(data, scene)
    return [
        (model.mesh(geom.dataid // 2).name, geom.pos.copy(), geom.mat.copy())
        for geom in scene.geoms[: scene.ngeom]
        if geom.type == mujoco.mjtGeom.mjGEOM_MESH
    ]


def places(parts, mesh):
    return np.array([position for name, position, _ in parts if name == mesh])


def test_each_belt_shows_a_band_and_two_rows_of_pads(robot):
    names = [name for name, _, _ in drawn(robot, 0.0)]
    for kind in ("lower", "upper"):
        assert names.count(f"band_{kind}") == 2 and f"belt_{kind}" not in names
        assert names.count(f"pad_{kind}") == 2 * 2 * ROWS[kind]


def test_pads_stand_on_the_band_and_touch_the_ground(robot):
    for kind, run in (("lower", 0.85), ("upper", 0.55)):
        pads = places(drawn(robot, 0.3), f"pad_{kind}")
        # in the keyframe drive the heel axles lie at x = 0, 0.1399 above the ground
        x, z = pads[:, 0], pads[:, 2] - 0.1399
        away = np.hypot(x - np.clip(x, -run, 0), z)
        assert away.min() > BAND and away.max() < RADIUS


def test_pads_go_as_far_as_the_belt_and_come_round(robot):
    still = places(drawn(robot, 0.0), "pad_lower")
    moved = places(drawn(robot, 0.1), "pad_lower")
    below = (still[:, 2] < 0.02) & (still[:, 0] > -0.8) & (still[:, 0] < -0.05)
    step = (moved - still)[below]
    # forward drive: the lower run goes back by angle x radius
    assert below.sum() > 20
    assert step[:, 0] == pytest.approx(-0.1 * RADIUS, abs=1e-6)  # MuJoCo draws in floats
    assert np.abs(step[:, 1:]).max() < 1e-6
    round_once = places(drawn(robot, LENGTH["lower"] / RADIUS), "pad_lower")
    assert round_once == pytest.approx(still, abs=1e-6)


def test_sprockets_turn_with_the_belt_and_wheels_faster(robot):
    def turn_of(mesh):
        still, moved = (
            next(axes for name, _, axes in drawn(robot, angle) if name == mesh)
            for angle in (0.0, 0.05)
        )
        spin = moved @ still.T
        return np.arctan2(spin[0, 2], spin[0, 0])

    assert turn_of("sprocket_lower") == pytest.approx(0.05, abs=1e-6)
    assert turn_of("wheel_lower") == pytest.approx(0.05 * 0.14 / 0.059, rel=1e-3)


def test_a_scene_that_is_filled_again_shows_the_same_as_a_new_one(robot):
    """Pads stay in it, and only move; where more stands before them they are made anew."""
    scene = mujoco.MjvScene(robot[0], 2000)
    for angle, contacts in ((0.0, False), (0.3, False), (0.3, True), (0.4, False), (0.5, False)):
        again, fresh = drawn(robot, angle, scene, contacts), drawn(robot, angle, None, contacts)
        assert [name for name, _, _ in again] == [name for name, _, _ in fresh]
        for one, other in zip(again, fresh, strict=True):
            assert np.array_equal(one[1], other[1])
            assert np.array_equal(one[2], other[2])


def test_a_model_without_tracks_is_left_alone():
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom size='0.1'/></worldbody></mujoco>"
    )
    data, scene = mujoco.MjData(model), mujoco.MjvScene(model, 100)
    mujoco.mj_forward(model, data)
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene
    )
    before = scene.ngeom
    RunningGear(model).show(data, scene)
    assert scene.ngeom == before


def test_a_full_scene_takes_no_more_pads(robot):
    model, data, gear = robot
    mujoco.mj_forward(model, data)
    scene, everything = mujoco.MjvScene(model, 220), mujoco.mjtCatBit.mjCAT_ALL
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), everything, scene
    )
    gear.show(data, scene)
    assert scene.ngeom == scene.maxgeom


def test_a_segmentation_has_a_number_for_each_pad(robot) -> None:
    """They had what their memory held: an IndexError of MuJoCo's renderer, now and then."""
    model, data, gear = robot
    mujoco.mj_forward(model, data)
    scene, everything = mujoco.MjvScene(model, 2000), mujoco.mjtCatBit.mjCAT_ALL
    for geom in scene.geoms:
        geom.segid = -12345
    mujoco.mjv_updateScene(
        model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), everything, scene
    )
    before = scene.ngeom
    gear.show(data, scene)
    pads = scene.geoms[before : scene.ngeom]
    assert [geom.segid for geom in pads] == list(range(before, scene.ngeom))
    bodies = {model.body(model.geom_bodyid[geom.objid]).name for geom in pads}
    assert len(bodies) == 4
    assert {geom.objtype for geom in pads} == {mujoco.mjtObj.mjOBJ_GEOM}
