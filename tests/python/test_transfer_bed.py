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


def with_person():
    """The rescue robot in `drive`, the bed out, a person of 120 kg 2 cm above it."""
    files = [models.path("rescue"), models.folder() / "scenes/flat.xml"]
    spec = models.parse(files, "bed")
    person = mujoco.MjSpec.from_file(str(models.folder() / PERSON))
    # on the back, the head to the left, the middle of the body over that of the bed
    frame = spec.worldbody.add_frame(pos=[-0.17, -0.10, 0.76 + 0.13], quat=[0.5, -0.5, -0.5, -0.5])
    frame.attach_body(person.body("pelvis"), "person_", "")
    model = spec.compile()
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
