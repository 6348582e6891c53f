"""Keyframes from the angles that define them, and who touches whom, by MuJoCo's own collisions.

Source: docs/design/robot.md#postures and #start-postures.
"""

import mujoco
import numpy as np
import pytest

from hurcules_studies.thesis.measures.rig import touching
from robot_models import (
    ARM,
    BODY,
    HIP_RANGE,
    ROBOTS,
    TRACK_RADIUS,
    TRACKS,
    elbow_spring,
    expected_joints,
    keys_of,
    load,
    on_flat_ground,
    place,
    sides,
)  # fmt: skip


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request):
    return on_flat_ground(request.param)


def test_keyframes_follow_from_the_angles_that_define_them(robot):
    name, model, data = robot
    for key in keys_of(name):
        place(model, data, key)
        joints, theta = expected_joints(name, key)
        for coordinate in ["KN"] + BODY + ARM[name]:
            for joint in sides(coordinate):
                angle = data.joint(joint).qpos[0]
                low, high = model.joint(joint).range
                assert low <= angle <= high
                if name == "rescue" and coordinate == "EB":  # the spring is part of the elbow
                    angle += data.joint(joint + "S").qpos[0]
                assert angle == pytest.approx(joints.get(coordinate, 0), abs=1e-5)
        assert data.qpos[:3] == pytest.approx([0, 0, TRACK_RADIUS], abs=2e-4)
        assert data.qpos[3:7] == pytest.approx(
            [np.cos(theta / 2), 0, np.sin(theta / 2), 0], abs=1e-5
        )


def test_the_elbow_springs_float_where_the_weight_of_the_lower_arm_leaves_them():
    _, model, data = on_flat_ground("rescue")
    for key in keys_of("rescue"):
        place(model, data, key)
        for side in "LR":
            down = -data.site(f"{side}_tcp").xmat[6]  # of the lower arm's axis
            b = np.arccos(np.clip(down, -1, 1))
            assert data.joint(f"{side}EBS").qpos[0] == pytest.approx(elbow_spring(b), abs=1e-4)


def test_only_the_right_tracks_touch_the_ground_in_a_keyframe(robot):
    name, model, data = robot
    for key in keys_of(name):
        place(model, data, key)
        pairs = touching(model, data)
        assert all("floor" in p for p in pairs), (key, pairs)
        standing = key not in ("home", "drive")
        runs = {f"{t}_run_{i}" for t in (TRACKS[:2] if standing else TRACKS) for i in (1, 2)}
        assert {g for p in pairs for g in p} == runs | {"floor"}


def test_the_scoops_start_the_stretch_where_they_should():  # [robot#start-postures]
    model = load("robots/rescue.xml")
    data = mujoco.MjData(model)
    place(model, data, "stretch")
    for side, y in (("L", 0.33), ("R", -0.33)):
        tcp = data.site(f"{side}_tcp")
        assert tcp.xpos == pytest.approx([1.432, y, 0.128], abs=2e-3)
        outward, _, normal = tcp.xmat.reshape(3, 3).T
        assert np.arcsin(-outward[2]) == pytest.approx(0.395, abs=2e-3) and normal[2] > 0.9


@pytest.mark.parametrize("fold", [False, True], ids=["waist ahead", "waist turned"])
def test_legs_swing_free_only_with_the_waist_turned(robot, fold):  # [robot#postures]
    name, model, data = robot
    hit = False
    for knee in np.linspace(0, np.pi, 90):
        place(model, data, "drive")
        data.qpos[2] = 2.0  # lifted off the ground
        data.joint("WST").qpos[0] = 1.52 * fold
        for s in "LR":
            posture = {"KN": knee, "SP": 0.30, "SY": 0 if name == "rescue" else -0.5, "EB": 2.45}
            for joint, angle in posture.items():
                data.joint(s + joint).qpos[0] = angle
        hit |= bool(touching(model, data))
    assert hit is not fold


def test_bed_and_battery_stop_the_trunk_behind_the_hip_range(robot):  # [robot#geometric-limits]
    name, model, data = robot
    place(model, data, "ready")
    trunk = {"waist", "waist_top", "torso"}

    def free():
        return not any(
            set(p) & trunk and set(p) & {"transfer_bed", "battery"} for p in touching(model, data)
        )

    margin = {"rescue": 0.06, "manipulation": 0.16}[name]  # met at 1.09 (bed) and 1.54 (battery)
    for angle, expected in ((HIP_RANGE[name][1], True), (HIP_RANGE[name][1] + margin, False)):
        data.joint("HIP").qpos[0] = angle
        assert free() is expected
