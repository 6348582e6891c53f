"""Names, drives, springs and tracks of the robots against the tables of the design page.

Sources: docs/design/robot.md#joints, docs/design/mujoco.md#track-model.
Not tested here: driving and servo control (the belts need the C++ step).
"""

import mujoco
import numpy as np
import pytest

from robot_models import (
    ARM,
    BED,
    BODY,
    CAMERAS,
    DRIVES,
    EB_RANGE,
    HIP_RANGE,
    ROBOTS,
    SITES,
    SPRINGS,
    TRACK_RADIUS,
    TRACKS,
    geoms_of,
    keys_of,
    on_flat_ground,
    place,
    sides,
)  # fmt: skip


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request):
    return on_flat_ground(request.param)


def test_every_drive_has_its_motor_limits_and_speed(robot):
    name, model, _ = robot
    for coordinate in ["KN"] + BODY + ARM[name]:
        peak, speed, armature, span = DRIVES[coordinate]
        span = span or {"HIP": HIP_RANGE, "EB": EB_RANGE}[coordinate][name]
        for joint in sides(coordinate):
            motor, j = model.actuator(joint), model.joint(joint)
            assert motor.trnid[0] == j.id and motor.gear[0] == 1
            assert list(motor.forcerange) == list(motor.ctrlrange) == [-peak, peak]
            assert tuple(j.range) == pytest.approx(span) and j.limited[0]
            assert model.dof_armature[j.dofadr[0]] == armature
            assert model.dof_frictionloss[j.dofadr[0]] == pytest.approx(0.03 * peak, rel=0.01)
            assert model.dof_damping[j.dofadr[0]] == pytest.approx(peak / (20 * speed), rel=0.02)
            assert model.numeric(f"velocity_limit_{joint}").data[0] == speed
            assert model.numeric(f"power_limit_{joint}").data[0] == pytest.approx(peak * speed / 2)


def test_springs_are_joints_without_motor(robot):
    name, model, _ = robot
    motors = set(model.actuator_trnid[:, 0].tolist())
    springs = {**SPRINGS[name], **{k.replace("L", "R", 1): v for k, v in SPRINGS[name].items()}}
    for joint, (stiffness, damping, span, free) in springs.items():
        j = model.joint(joint)
        assert j.id not in motors and tuple(j.range) == span
        assert model.jnt_stiffness[j.id] == stiffness
        assert model.dof_damping[j.dofadr[0]] == damping
        assert model.qpos_spring[j.qposadr[0]] == free
    # all but the suspension of the tracks
    held = {
        int(i)
        for i in np.flatnonzero(model.jnt_stiffness)
        if not model.body(int(model.jnt_bodyid[i])).name.endswith("_track")
    }
    assert held == {model.joint(joint).id for joint in springs}


def test_the_bed_has_a_lift_and_two_coupled_slides_a_side():
    _, model, data = on_flat_ground("rescue")
    for joint, (peak, speed, span) in BED.items():
        motor = next(
            i for i in range(model.nu) if model.actuator_trnid[i, 0] == model.joint(joint).id
        )
        assert list(model.actuator_forcerange[motor]) == [-peak, peak]
        assert tuple(model.joint(joint).range) == span
        assert model.numeric(f"velocity_limit_{joint}").data[0] == speed
        assert model.numeric(f"power_limit_{joint}").data[0] == pytest.approx(peak * speed / 2)
    place(model, data, "drive")
    for side in "LR":
        for i in (1, 2):
            data.joint(f"{side}_bed_{i}").qpos[0] = 0.31
    mujoco.mj_forward(model, data)
    ends = [data.geom(f"{s}_bed_2").xpos[1] + 0.23 * (1 if s == "L" else -1) for s in "LR"]
    assert ends == pytest.approx([0.85, -0.85])  # 1.70 m long [robot#transfer-bed]
    assert abs(data.eq_active).all() and np.abs(data.efc_pos[:4]).max() < 1e-9


def test_all_agreed_names_exist(robot):
    name, model, _ = robot
    for finder, names in (
        (model.site, SITES), (model.camera, CAMERAS), (model.key, keys_of(name)),
        (model.actuator, ["L_drive", "R_drive"] + ["L_grip", "R_grip"] * (name == "manipulation")),
        (model.actuator, ["bed_lift", "L_bed", "R_bed"] * (name == "rescue")),
        (model.joint, ["root"] + [f"{t}_belt" for t in TRACKS]),
        (model.sensor, ["imu_acceleration", "imu_rate"] + [f"{t}_load" for t in TRACKS]),
    ):  # fmt: skip
        for n in names:
            finder(n)  # raises KeyError with the names that exist


def test_coordinates_are_listed_in_the_controllers_order(robot):
    name, model, _ = robot
    order = ["KN"] + BODY + [s + a for s in "LR" for a in ARM[name]]
    tuples = [model.tuple(i) for i in range(model.ntuple)]
    found = {
        t.name.removeprefix("coordinate_"): t for t in tuples if t.name.startswith("coordinate_")
    }
    assert list(found) == order and len(order) == {"rescue": 13, "manipulation": 19}[name]
    for coordinate, t in found.items():
        joints = ["LKN", "RKN"] if coordinate == "KN" else [coordinate]
        assert [model.joint(int(i)).name for i in t.objid] == joints
        assert set(t.objtype.tolist()) == {int(mujoco.mjtObj.mjOBJ_JOINT)}
        assert set(t.objprm.tolist()) == {1.0}


def test_a_track_is_declared_with_its_belt_and_all_its_contact_geoms(robot):
    _, model, data = robot
    place(model, data, "drive")
    for t in TRACKS:
        side, leg = t.split("_")
        belt, *geoms = (int(i) for i in model.tuple(f"track_{side}_{leg}").objid)
        assert model.joint(belt).name == f"{t}_belt"
        assert geoms == [g for g in geoms_of(model, f"{t}_track") if model.geom_contype[g]]
        sizes = {g: model.geom_size[g] for g in geoms}
        boxes = [g for g in geoms if model.geom_type[g] == mujoco.mjtGeom.mjGEOM_BOX]
        # [mujoco#track-model]
        assert len(boxes) >= 2 and all(sizes[g][2] == TRACK_RADIUS for g in boxes)
        assert all(
            sizes[g][0] == pytest.approx(TRACK_RADIUS - 0.001) for g in set(geoms) - set(boxes)
        )
    # [robot#kinematic-chain] an axle behind the knee would be pressed into the ground
    for side in "LR":
        heel, knee = data.geom(f"{side}_lower_heel").xpos, data.joint(f"{side}KN").xanchor
        assert heel == pytest.approx(knee) and np.allclose(
            data.joint(f"{side}_lower_belt").xanchor, knee
        )
