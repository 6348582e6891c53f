"""The transfer bed: it expands by its own motors, carries a person, and limits hip and knee.

Strategy: the bed is driven by the servo in the physics; a limp person of 120 kg is laid on it; the
limits of both modes are compared with where the trunk and the ground really stop the robot.
Numbers: docs/design/robot.md#transfer-bed and #geometric-limits; claim H16.
"""

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, transfer_bed
from hurcules_studies.thesis.measures.bed import first_touch, ground_angle
from hurcules_studies.thesis.measures.rig import start, touching

PERSON = "objects/casualty_120kg.xml"
ARMS_FREE = {"SP": -0.55, "SR": 0.20, "SY": 1.20, "EB": 1.00}  # [rad] models/missions/casualty.toml


def settled(model, data):
    """Height of the lying surface [m]."""
    return data.site("bed").xpos[2]


def test_the_bed_expands_by_itself_and_folds_again():  # H16
    model = models.load("rescue")
    data, player = start(model, "rescue", "drive")
    low = settled(model, data)
    assert low == pytest.approx(0.38, abs=0.002)  # [robot#transfer-bed]
    for result in player.play(transfer_bed.expand()):
        assert result.worst_torque < 1.0 and result.speed < 1.0 and not result.collisions
    ends = [data.geom(f"{s}_bed_2").xpos[1] for s in "LR"]
    assert ends == pytest.approx([0.62, -0.62], abs=0.003)  # 1.70 m from end to end
    assert 0.70 <= settled(model, data) <= 0.78  # [robot#transfer-bed]
    for result in player.play(transfer_bed.fold()):
        assert not result.collisions
    assert settled(model, data) == pytest.approx(low, abs=0.002)


def scene(person_file, rims=False):
    """The rescue robot, a person 2 cm above the bed that is out."""
    files = [models.path("rescue"), models.folder() / "scenes/flat.xml"]
    spec = models.parse(files, "bed")
    if rims:
        transfer_bed.add_rims(spec)
    person = mujoco.MjSpec.from_file(str(models.folder() / person_file))
    # on the back, the head to the left, the middle of the body over that of the bed
    frame = spec.worldbody.add_frame(pos=[-0.17, -0.10, 0.76 + 0.13], quat=[0.5, -0.5, -0.5, -0.5])
    frame.attach_body(person.body("pelvis"), "person_", "")
    return spec.compile()


def with_person():
    """The same in `drive`, with 120 kg."""
    model = scene(PERSON)
    data, player = start(model, "rescue", "drive")
    plates = {f"{s}_bed_{i}": transfer_bed.SLIDE for s in "LR" for i in (1, 2)}
    for joint, place in {"bed_lift": transfer_bed.LIFT, **plates}.items():
        data.joint(joint).qpos[0] = place
    mujoco.mj_forward(model, data)
    # the arms out of the way
    for side in "LR":
        data.joint(f"{side}SP").qpos[0], data.joint(f"{side}EB").qpos[0] = -0.3, 2.3
    player.reference[:] = data.qpos[player._qpos]
    return model, data, player


def test_a_person_of_120_kg_lies_on_the_bed_and_stays():
    model, data, player = with_person()
    player.wait(4.0)
    place = data.body("person_pelvis").xpos.copy()
    player.wait(2.0)
    # limp arms still slide off the edge; the body lies
    assert np.linalg.norm(data.body("person_pelvis").xpos - place) < 0.04
    assert (data.body("person_pelvis").xpos - data.site("bed").xpos)[2] > 0.08
    pairs = [pair for pair in touching(model, data) if any("person" in name for name in pair)]
    assert not any("floor" in pair for pair in pairs)
    assert any("transfer_bed" in pair for pair in pairs)
    # [robot#passive-joints] 120 kg and 23 kg on 20 kN/m, wound by 15 mm, less what hands and trunk
    # bear
    sag = (120 + 23) * 9.81 / 20e3 - 0.015
    assert 0.85 * sag < -data.joint("bed_spring").qpos[0] < 1.03 * sag
    # the lift bears at most the 1.4 kN and its dry friction, 120 N, of the 4 kN it has
    assert abs(data.actuator("bed_lift").force[0]) < 143 * 9.81 + 130


def slid(rims, degrees):
    """How far 75 kg slide in 2 s on the bed of a robot that leans ahead by so much (3,) [m].

    The robot is held, but for the rims, which are pumped up for 4 s; gravity leans by 5 degrees a
    second.
    """
    model = scene("objects/casualty_75kg.xml", rims)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    plates = {f"{s}_bed_{i}": transfer_bed.SLIDE for s in "LR" for i in (1, 2)}
    arms = {f"{s}{j}": v for s in "LR" for j, v in ARMS_FREE.items()}
    for joint, place in {"bed_lift": transfer_bed.LIFT, "HIP": -0.52, **plates, **arms}.items():
        data.joint(joint).qpos[0] = place
    pumps = [f"{s}_bed_rim_{e}" for s in "LR" for e in ("front", "back")] if rims else []
    root = model.body("person_pelvis").id
    held = data.qpos[: model.jnt_qposadr[model.body_jntadr[root]]].copy()
    moves = [model.joint(name).qposadr[0] for name in pumps]
    start_of = None
    for tick in range(round((6.0 + abs(degrees) / 5.0) / model.opt.timestep)):
        time = tick * model.opt.timestep
        angle = np.sign(degrees) * np.radians(min(abs(degrees), 5.0 * max(0.0, time - 4.0)))
        model.opt.gravity[:] = 9.81 * np.array([np.sin(angle), 0.0, -np.cos(angle)])
        for name in pumps:
            data.actuator(name).ctrl = 250.0 if time < 4.0 else 0.0
        mujoco.mj_step(model, data)
        if time < 4.0:
            held[moves] = data.qpos[moves]
        data.qpos[: len(held)] = held
        data.qvel[: model.body_dofadr[root]] = 0.0
        if start_of is None and time >= 4.0:
            start_of = data.subtree_com[root].copy()
    return data.subtree_com[root] - start_of


@pytest.mark.parametrize("degrees", [-30.0, 30.0])
def test_rims_hold_a_person_on_a_slope(degrees):
    """Without them he slides ahead, and back against the trunk, by two hands."""
    bare, rimmed = slid(False, degrees), slid(True, degrees)
    assert abs(bare[0]) > 0.08
    assert np.linalg.norm(rimmed) < 0.05


def test_rims_are_for_a_bed_that_has_none():
    spec = models.parse([models.path("rescue")], "bed")
    transfer_bed.add_rims(spec)
    model = spec.compile()
    assert mujoco.mj_getTotalmass(model) == pytest.approx(682.0, abs=0.01)
    assert [model.key(k).name for k in range(model.nkey)][:2] == ["home", "drive"]
    with pytest.raises(hurcules.Error, match="a transfer bed without rims"):
        transfer_bed.add_rims(spec)
    transfer_bed.detach(spec)
    assert not [a.name for a in spec.actuators if "bed" in a.name]
    with pytest.raises(hurcules.Error, match="a transfer bed without rims"):
        transfer_bed.add_rims(models.parse([models.path("manipulation")], "bare"))


@pytest.mark.parametrize(
    "bed, stop", [(True, {"transfer_bed"}), (False, {"battery"})], ids=["attached", "detached"]
)
def test_what_stops_the_trunk_changes_with_the_bed(bed, stop):  # H16
    model = models.load("rescue", bed=bed)
    trunk = {"waist", "waist_top", "torso"}
    angles = np.arange(0.9, 1.65, 0.01)
    met = first_touch(model, "ready", "HIP", angles, (trunk, stop))
    # [robot#geometric-limits]: the bed at 1.08, the battery at 1.45 (manipulation: 1.54 measured)
    assert met is not None and abs(met - (1.09 if bed else 1.54)) < 0.03
    mode = hurcules.mode_ranges("rescue_ready" if bed else "rescue_ready_without_bed")
    assert mode["HIP"][1] < model.joint("HIP").range[1] < met


def test_what_stops_the_knee_changes_with_the_bed():  # H16
    for bed, parts, theta in ((True, ["transfer_bed"], 2.2), (False, ["battery"], 2.5)):
        met = ground_angle(models.load("rescue", bed=bed), parts)
        assert met == pytest.approx(theta, abs=0.05)
        mode = hurcules.mode_ranges("rescue_ready" if bed else "rescue_ready_without_bed")
        assert np.pi - mode["KN"][0] < met


def test_without_its_bed_the_robot_is_23_kg_lighter_and_keeps_its_postures():
    whole, bare = models.load("rescue"), models.load("rescue", bed=False)
    assert mujoco.mj_getTotalmass(whole) - mujoco.mj_getTotalmass(bare) == pytest.approx(23.0)
    assert [bare.key(i).name for i in range(bare.nkey)] == [
        whole.key(i).name for i in range(whole.nkey)
    ]
    for name in ("HIP", "LEB", "R_lower_belt", "REBS"):
        for key in ("stretch", "carry"):
            a, b = (m.key(key).qpos[m.joint(name).qposadr[0]] for m in (whole, bare))
            assert a == b
    assert models.load("rescue", "slope30", bed=False).nq == bare.nq
    assert models.load(mission="stretch", bed=False).nq == models.load(mission="stretch").nq - 6


def test_a_robot_without_bed_has_none_to_take_off():
    with pytest.raises(hurcules.Error, match="transfer bed is wanted"):
        models.load("manipulation", bed=False)
    with pytest.raises(hurcules.Error, match="mode 'fly' does not exist; there are: rescue_ready"):
        hurcules.mode_ranges("fly")
