"""Things to handle: weights, the sled's drag, the door's latch and closer, the valve's friction.

Strategy: each promise is a small experiment with forces applied by the test; the thresholds follow
from the numbers that the files and the parameters state. Not tested: grasping them with the robot.
Sources: [C1] = docs/design/test-methods.md#ground-robot-methods, [C3] =
docs/design/test-methods.md#darpa-challenges.
"""

import math

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, scenes

GRAVITY = 9.81
# kg; [C3] wood of 2 x 4 and 4 x 4 inches; claim H05: 30 kg in each hand
MASSES = {
    "shell_30kg": 30.0, "ordnance_box_30kg": 30.0, "sled": 75.0, "concrete_block": 16.0,
    "timber_2x4": 1.39, "timber_4x4": 2.17, "door": 25.0, "valve": 2.55,
    "ordnance_case": 20.0, "container": 0.0,
}  # fmt: skip


def ready(kind: str, **values: object) -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = scenes.make(kind, **values).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def push(model, data, seconds, **forces):
    """Steps with generalised forces on named joints."""
    data.qfrc_applied[:] = 0
    for joint, force in forces.items():
        data.joint(joint).qfrc_applied[0] = force
    mujoco.mj_step(model, data, round(seconds / model.opt.timestep))


@pytest.mark.parametrize("thing", MASSES)
def test_a_thing_loads_alone_and_weighs_what_it_says(thing):
    model = mujoco.MjModel.from_xml_path(str(models.folder() / f"objects/{thing}.xml"))
    assert mujoco.mj_getTotalmass(model) == pytest.approx(MASSES[thing], abs=1e-6)
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 10)
    assert np.isfinite(data.qpos).all() and data.ncon == 0


def test_every_thing_is_tested():
    files = {file.stem for file in (models.folder() / "objects").glob("*.xml")}
    assert {name for name in files if not name.startswith("casualty")} == set(MASSES)


@pytest.mark.parametrize("height", [0.0, 0.8])
def test_ordnance_lies_still(height):
    model, data = ready("ordnance", height=height)
    start = data.qpos.copy()
    mujoco.mj_step(model, data, 1000)
    assert abs(data.qpos - start).max() < 3e-3 and abs(data.qvel).max() < 5e-3
    assert data.body("box_box").xpos[2] == pytest.approx(height + 0.14, abs=1e-3)


def test_a_shell_rolls_when_pushed_sideways():
    model, data = ready("ordnance")
    data.joint("shell_root").qvel[:3] = 0, 0, 0
    data.joint("shell_root").qfrc_applied[0] = 30.0  # across its axis; sliding takes 147 N
    mujoco.mj_step(model, data, 500)
    turned = abs(data.joint("shell_root").qvel[3:6]).max()
    assert turned * 0.065 == pytest.approx(abs(data.joint("shell_root").qvel[0]), rel=0.15)


def test_debris_lies_before_the_robot():
    model, data = ready("debris", seed=5)
    mujoco.mj_forward(model, data)
    pieces = [i for i in range(1, model.nbody)]
    assert len(pieces) == 14
    start = data.xpos[pieces].copy()
    mujoco.mj_step(model, data, 1000)
    assert abs(data.xpos[pieces] - start).max() < 2e-3
    assert abs(data.qvel).max() < 0.1
    assert data.xpos[pieces, 0].min() > 1.5 and data.xpos[pieces, 2].max() < 1.0
    assert min(c.dist for c in data.contact[: data.ncon]) > -5e-3
    assert not any(w.number for w in data.warning)


# ---- the sled


@pytest.mark.parametrize("mass", [75, 120, 250])  # [C1] E2830: 75, 100, 120 kg and up
@pytest.mark.parametrize("mu", [0.3, 0.5])
def test_the_sled_moves_above_its_friction_only(mass, mu):
    model, data = ready("sled", mass=mass, sled_friction=mu)
    assert mujoco.mj_getTotalmass(model) == pytest.approx(mass)
    mujoco.mj_step(model, data, 500)
    start = data.body("sled_sled").xpos[0]
    drag = mu * mass * GRAVITY
    data.joint("sled_root").qfrc_applied[0] = -0.9 * drag
    mujoco.mj_step(model, data, 1000)
    assert abs(data.body("sled_sled").xpos[0] - start) < 5e-3
    data.joint("sled_root").qfrc_applied[0] = -1.2 * drag
    mujoco.mj_step(model, data, 500)
    speed = data.joint("sled_root").qvel[0]
    mujoco.mj_step(model, data, 500)
    acceleration = (speed - data.joint("sled_root").qvel[0]) / 0.5
    assert acceleration == pytest.approx(0.2 * mu * GRAVITY, rel=0.15)


# ---- the door


def test_the_doorway_is_as_wide_and_the_lever_as_high_as_published():  # [C3]
    model, data = ready("door")
    left, right = data.geom("door_jamb_left"), data.geom("door_jamb_right_low")
    half = model.geom("door_jamb_left").size[1]
    assert left.xpos[1] - right.xpos[1] - 2 * half == pytest.approx(0.851, abs=1e-3)
    assert data.body("door_lever").xpos[2] == pytest.approx(1.016, abs=1e-3)
    assert data.geom("door_lintel").xpos[2] - 0.04 > 2.03


def test_a_latched_door_holds_and_an_open_latch_lets_go():
    model, data = ready("door")
    push(model, data, 1.0, door_hinge=250.0)  # 320 N at the lever
    assert abs(data.joint("door_hinge").qpos[0]) < 0.01
    push(model, data, 0.5, door_lever=3.0)
    assert data.joint("door_bolt").qpos[0] > 0.012  # drawn back behind the strike, 10 mm
    push(model, data, 2.0, door_hinge=40.0, door_lever=3.0)
    assert data.joint("door_hinge").qpos[0] > 1.2


def test_the_closer_shuts_the_door_and_the_latch_snaps_in():
    model, data = ready("door")
    data.joint("door_hinge").qpos[0] = 1.2
    push(model, data, 6.0)
    assert abs(data.joint("door_hinge").qpos[0]) < 0.01
    push(model, data, 1.0, door_hinge=250.0)
    assert abs(data.joint("door_hinge").qpos[0]) < 0.01


def test_without_a_closer_the_door_stays_open():
    model, data = ready("door", closer=False)
    data.joint("door_hinge").qpos[0] = 1.2
    push(model, data, 2.0)
    assert data.joint("door_hinge").qpos[0] == pytest.approx(1.2, abs=0.01)


@pytest.mark.parametrize("opens, side", [("away", 1), ("towards", -1)])
def test_the_door_opens_to_the_side_that_was_asked_for(opens, side):
    model, data = ready("door", opens=opens)
    data.joint("door_hinge").qpos[0] = 1.2
    mujoco.mj_kinematics(model, data)
    assert side * (data.site("door_lever_near").xpos[0] - 2.5) > 0.5


# ---- the valve


@pytest.mark.parametrize("torque", [5.0, 40.0])
def test_the_valve_turns_above_its_friction_only(torque):
    model, data = ready("valve", torque=torque)
    push(model, data, 1.0, valve_wheel=0.95 * torque)
    assert abs(data.joint("valve_wheel").qpos[0]) < 1e-3
    push(model, data, 3.0, valve_wheel=torque + 3.0)  # damping 1 N m s: ends at 3 rad/s
    assert data.joint("valve_wheel").qvel[0] == pytest.approx(3.0, rel=0.05)


@pytest.mark.parametrize("height", [0.6, 1.4])
def test_the_wheel_is_at_its_height_and_opens_counterclockwise(height):
    model, data = ready("valve", height=height)
    assert data.body("valve_wheel").xpos[2] == pytest.approx(height, abs=1e-9)
    top = data.site("valve_rim").xpos.copy()
    assert np.hypot(*(top - data.body("valve_wheel").xpos)[1:]) == pytest.approx(0.15)
    data.joint("valve_wheel").qpos[0] = 0.3
    mujoco.mj_kinematics(model, data)
    # seen from -x, looking along +x, left is +y: counterclockwise moves the top to the left
    assert data.site("valve_rim").xpos[1] - top[1] == pytest.approx(0.15 * math.sin(0.3), abs=1e-6)


# ---- persons in scenes


@pytest.mark.parametrize("mass", [50, 75, 90, 120])
@pytest.mark.parametrize("lying", ["back", "front", "left", "right"])
def test_a_person_begins_clear_of_the_ground_and_comes_to_rest(mass, lying):
    model, data = ready("casualty", mass=mass, lying=lying)
    low = min((c.dist for c in data.contact[: data.ncon]), default=0.0)
    assert low > -2e-4
    looks = {"back": (2, 1), "front": (2, -1), "left": (0, 1), "right": (0, -1)}[lying]
    front = data.body("casualty_pelvis").xmat.reshape(3, 3)[:, 0]
    assert looks[1] * front[looks[0]] == pytest.approx(1.0, abs=1e-6)
    mujoco.mj_step(model, data, 4000)
    assert abs(data.qvel).max() < 0.3
    assert not any(w.number for w in data.warning)
    centre = data.subtree_com[model.body("casualty_pelvis").id]
    assert 0.03 < centre[2] < 0.3 and centre[0] == pytest.approx(2.72, abs=0.35)
    forces = [s for s in range(model.nsensor) if "_force_" in model.sensor(s).name]
    total = sum(data.sensor(s).data[0] for s in forces)
    assert total == pytest.approx(mass * GRAVITY, rel=0.15)


@pytest.mark.parametrize("mass", [50, 75, 90, 120])
@pytest.mark.parametrize("arms", ["out", "folded"])
def test_the_arms_of_a_person_on_the_back_stay_where_they_were_wanted(mass, arms):
    model, data = ready("casualty", mass=mass, arms=arms)
    assert min(c.dist for c in data.contact[: data.ncon]) > -2e-4
    mujoco.mj_step(model, data, 3000)
    assert abs(data.qvel).max() < 0.1
    wanted = {
        "out": {"shoulder_abduction": 1.2, "shoulder_turn": 0.0, "elbow": 0.0},
        "folded": {"shoulder_abduction": 0.4, "shoulder_turn": -0.78, "elbow": 1.9},
    }[arms]
    trunk = data.body("casualty_thorax").xmat.reshape(3, 3)
    for side in "LR":
        for name, angle in wanted.items():
            joint = data.joint(f"casualty_{side}_{name}")
            assert joint.qpos[0] == pytest.approx(angle, abs=0.15), (side, name)
        # by places, in the frame of the trunk: x to the front, y left, z up
        shoulder, elbow, wrist = (
            data.body(f"casualty_{side}_{name}").xpos for name in ("upper_arm", "forearm", "hand")
        )
        arm = trunk.T @ (elbow - shoulder) / np.linalg.norm(elbow - shoulder)
        if arms == "out":  # 0.2 rad at the sides: 1.4 rad from the trunk, level
            assert math.acos(-arm[2]) == pytest.approx(1.4, abs=0.02)
            assert abs(wrist[2] - shoulder[2]) < 0.02
        else:  # above the belly, between the elbows
            assert wrist[2] > data.geom("casualty_belly_0.165").xpos[2]
            inward = trunk.T @ (wrist - elbow)
            assert inward[0] > 0.1 and inward[1] * (1 if side == "L" else -1) < -0.05


def test_hinges_that_begin_at_angles_mean_the_same_places_as_before():
    straight, folded = (scenes.load("casualty", arms=arms) for arms in ("sides", "folded"))
    places = []
    for model in (straight, folded):
        data = mujoco.MjData(model)
        data.qpos[:] = folded.qpos0
        random = np.random.default_rng(3).uniform(-0.3, 0.3, model.nq)
        for joint in range(model.njnt):
            if "_shoulder_" in model.joint(joint).name or "_elbow" in model.joint(joint).name:
                at = model.jnt_qposadr[joint]
                data.qpos[at] += random[at]
        mujoco.mj_kinematics(model, data)
        bodies = ("L_forearm", "R_forearm", "L_hand", "R_hand")
        places.append([data.body(f"casualty_{name}").xmat.copy() for name in bodies])
    assert places[0] == pytest.approx(np.array(places[1]), abs=1e-12)


@pytest.mark.parametrize(
    "lying, arms, wanted",
    [
        ("back", "up", "arms wants one of sides, out, folded, got 'up'"),
        ("front", "folded", "one of sides, out for a person lying 'front', got 'folded'"),
        ("left", "out", "one of sides for a person lying 'left', got 'out'"),
    ],
)
def test_arms_that_would_not_lie_still_are_refused(lying, arms, wanted):
    with pytest.raises(hurcules.Error, match=wanted):
        scenes.scene("casualty", lying=lying, arms=arms)


# ---- loads


@pytest.mark.parametrize("mass", [20.0, 120.0])  # [robot#what-the-thesis-gives]
def test_the_beam_lies_still_with_room_for_arms_below(mass):
    model, data = ready("lift", mass=mass, clearance=0.3)
    mujoco.mj_step(model, data, 1000)
    assert model.body("beam").mass[0] == pytest.approx(mass)
    assert data.body("beam").xpos[2] == pytest.approx(0.4, abs=2e-3)
    assert abs(data.qvel).max() < 2e-3
    # both lower arms of the robot, 0.66 m apart and 0.12 m wide, pass between the blocks
    inner = data.geom("block_left").xpos[1] - model.geom("block_left").size[1]
    assert inner > 0.33 + 0.06 + 0.1


@pytest.mark.parametrize("stiffness", [1e3, 1e4, 1e5])  # [D4 16]
@pytest.mark.parametrize("height", [0.05, 0.15])
def test_the_pad_gives_way_by_force_over_stiffness_and_weighs_the_force(stiffness, height):
    spec = scenes.make("force_pad", stiffness=stiffness, height=height)
    weight = spec.worldbody.add_body(pos=[1.5, 0.2, height + 0.05])
    weight.add_freejoint()
    weight.add_geom(size=[0.05, 0, 0], mass=1.0, contype=4, conaffinity=8, friction=[1, 0.1, 0.1])
    model = spec.compile()
    data = mujoco.MjData(model)
    top = data.body("pad").xpos
    mujoco.mj_forward(model, data)
    assert top[2] + 0.015 == pytest.approx(height, abs=1e-9)
    mujoco.mj_step(model, data, 6000)
    assert data.sensor("pad_force").data[0] == pytest.approx(GRAVITY, rel=0.02)
    assert data.joint("pad").qpos[0] == pytest.approx(-GRAVITY / stiffness, rel=0.02, abs=2e-6)


def test_an_empty_pad_stays_where_it_is():
    model, data = ready("force_pad")
    mujoco.mj_step(model, data, 1000)
    assert abs(data.joint("pad").qpos[0]) < 1e-9
    assert data.sensor("pad_force").data[0] == 0.0
