"""The limp persons of models/objects: weights, segments, rest on the ground, limpness, sensors.

Strategy: what the table fixes is stated here again, with its source, and compared with the compiled
model; the rest is physics on flat ground. Source of the numbers: [C] =
docs/design/test-methods.md#casualties (de Leva 1996, male; lengths Drillis and Contini). Not
tested: the looks, and whether a living person would be hurt.
"""

import subprocess
import sys

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import casualties, models, scenes

PERSONS = {50: 1.60, 75: 1.75, 90: 1.80, 120: 1.85}  # [C] mass kg, stature m
GRAVITY = 9.81

# [C] fraction of the mass, centre from the proximal end, radii of gyration, as printed there
TABLE = {
    "head": (0.0694, 0.5976, (0.362, 0.376, 0.312)),
    "thorax": (0.1596, 0.2999, (0.716, 0.454, 0.659)),
    "abdomen": (0.1633, 0.4502, (0.482, 0.383, 0.468)),
    "pelvis": (0.1117, 0.6115, (0.615, 0.551, 0.587)),
    "upper_arm": (0.0271, 0.5772, (0.285, 0.269, 0.158)),
    "forearm": (0.0162, 0.4574, (0.276, 0.265, 0.121)),
    "hand": (0.0061, 0.7900, (0.628, 0.513, 0.401)),
    "thigh": (0.1416, 0.4095, (0.329, 0.329, 0.149)),
    "shank": (0.0433, 0.4395, (0.251, 0.246, 0.102)),
    "foot": (0.0137, 0.4415, (0.257, 0.245, 0.124)),
}
TRUNK = ("head", "thorax", "abdomen", "pelvis")
# [C] kg at 75, 90, 120 kg
PRINTED = {
    "thigh": (10.62, 12.74, 16.99),
    "thorax": (11.97, 14.36, 19.15),
    "hand": (0.46, 0.55, 0.73),
}
# [C] m at 1.75, 1.80, 1.85 m
LENGTHS = {
    ("upper_arm", "forearm"): (0.326, 0.335, 0.344),
    ("forearm", "hand"): (0.256, 0.263, 0.270),
    ("thigh", "shank"): (0.429, 0.441, 0.453),
}
LIMBS = ("thigh", "shank", "foot", "upper_arm", "forearm", "hand")
REGIONS = {"skull", "face", "neck", "chest", "upper_back", "belly", "lower_back", "pelvis"} | {
    f"{side}_{limb}" for side in "LR" for limb in LIMBS
}


def alone(mass: int) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_path(str(models.folder() / f"objects/casualty_{mass}kg.xml"))


@pytest.fixture(scope="module", params=PERSONS)
def person(request: pytest.FixtureRequest) -> tuple[int, mujoco.MjModel]:
    return request.param, alone(request.param)


@pytest.fixture(scope="module", params=PERSONS)
def lying(request: pytest.FixtureRequest) -> tuple[int, mujoco.MjModel]:
    """On the back on flat ground, head to the left."""
    return request.param, on_the_back(request.param).compile()


def on_the_back(mass: int) -> mujoco.MjSpec:
    spec = mujoco.MjSpec.from_file(str(models.folder() / f"objects/casualty_{mass}kg.xml"))
    plane = mujoco.mjtGeom.mjGEOM_PLANE
    spec.worldbody.add_geom(type=plane, size=[5, 5, 1], contype=2, conaffinity=8)
    body = spec.body("pelvis")
    body.pos, body.quat = [0, 0, -geom_bottom(alone(mass))], [0.5, -0.5, -0.5, -0.5]
    return spec


def geom_bottom(model: mujoco.MjModel) -> float:
    """Where the back lies in the person's frame: least x of the trunk's capsules [m]."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    hips = model.geom("hips").id
    return float(data.geom_xpos[hips][0] - model.geom_size[hips][0])


def full(segment: str) -> list[str]:
    return [segment] if segment in TRUNK else [f"{side}_{segment}" for side in "LR"]


def test_the_files_are_what_their_script_writes(tmp_path):
    script = models.folder() / "assets/make_casualties.py"
    subprocess.run([sys.executable, "-B", script, tmp_path], check=True, capture_output=True)
    kept = {f.name: f.read_text() for f in (models.folder() / "objects").glob("casualty_*.xml")}
    assert {f.name: f.read_text() for f in tmp_path.iterdir()} == kept
    assert set(kept) == {f"casualty_{mass}kg.xml" for mass in PERSONS}


def test_the_table_adds_up_to_a_whole_person():
    assert sum(row[0] * len(full(name)) for name, row in TABLE.items()) == pytest.approx(
        1, abs=1e-9
    )


def test_the_segments_add_up_to_the_mass(person):
    mass, model = person
    assert mujoco.mj_getTotalmass(model) == pytest.approx(mass, rel=1e-5)


def test_segments_have_the_mass_and_the_radii_of_gyration_of_the_table(person):
    mass, model = person
    for name, (fraction, _, radii) in TABLE.items():
        for body in full(name):
            segment = model.body(body)
            assert segment.mass[0] == pytest.approx(fraction * mass, rel=1e-5), body
            found = np.sqrt(segment.inertia / segment.mass)
            ratio = np.sort(found) / np.sort(radii)  # one length for all three axes
            assert ratio == pytest.approx(np.full(3, ratio[0]), rel=1e-3), body


def test_centres_of_mass_stand_at_the_fraction_of_the_same_length(person):
    _, model = person
    for name in ("upper_arm", "forearm", "thigh", "shank", "hand"):
        _, fraction, radii = TABLE[name]
        segment = model.body(f"L_{name}")
        length = np.sqrt(segment.inertia.max() / segment.mass[0]) / max(radii)
        assert -segment.ipos[2] == pytest.approx(fraction * length, rel=2e-3), name


@pytest.mark.parametrize("column, mass", list(enumerate((75, 90, 120))))
def test_masses_and_lengths_are_the_printed_ones(column, mass):
    model = alone(mass)
    for name, masses in PRINTED.items():
        assert model.body(full(name)[0]).mass[0] == pytest.approx(masses[column], abs=0.006), name
    for (name, child), lengths in LENGTHS.items():
        found = np.linalg.norm(model.body(f"L_{child}").pos)
        assert found == pytest.approx(lengths[column], abs=1e-3), name


def test_the_crown_stands_a_stature_above_the_sole_of_a_straight_body(person):
    mass, model = person
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    skull = data.geom("face").xpos[2] + model.geom("face").size[2]
    ankle = data.body("L_foot").xpos[2]
    # [C] ankle height 0.039 of the stature
    assert skull - ankle == pytest.approx(PERSONS[mass] * (1 - 0.039), abs=0.03)


def test_left_mirrors_right(person):
    _, model = person
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    for limb in LIMBS:
        left, right = data.body(f"L_{limb}"), data.body(f"R_{limb}")
        assert left.xipos == pytest.approx(right.xipos * [1, -1, 1], abs=1e-9)


def test_a_person_lies_down_without_penetration_and_stays(lying):
    _, model = lying
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    assert all(contact.dist > -2e-4 for contact in data.contact[: data.ncon])
    start = data.qpos.copy()
    mujoco.mj_step(model, data, 3000)
    assert abs(data.qpos - start).max() < 0.02
    assert abs(data.qvel).max() < 5e-3
    assert min(contact.dist for contact in data.contact[: data.ncon]) > -1e-3
    assert not any(warning.number for warning in data.warning)


def test_the_regions_together_feel_the_weight_and_nothing_else(lying):
    mass, model = lying
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 2000)
    names = [model.sensor(i).name for i in range(model.nsensor)]
    forces = {n.removeprefix("force_"): data.sensor(n).data[0] for n in names if "force_" in n}
    assert set(forces) == REGIONS
    assert sum(forces.values()) == pytest.approx(mass * GRAVITY, rel=1e-3)
    assert forces["chest"] == forces["belly"] == forces["face"] == 0.0  # they look up
    assert forces["pelvis"] > 0.15 * mass * GRAVITY and forces["skull"] > 0


def test_pressing_on_the_chest_is_felt_by_the_chest_alone(lying):
    mass, model = lying
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    spec = on_the_back(mass)
    press = spec.worldbody.add_body(pos=data.site("chest").xpos + np.array([0, 0, 0.052]))
    press.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])
    press.add_geom(size=[0.05, 0, 0], mass=5.0, contype=4, conaffinity=8)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 2000)
    assert data.sensor("force_chest").data[0] == pytest.approx(5.0 * GRAVITY, rel=0.05)
    assert data.sensor("force_belly").data[0] == data.sensor("force_face").data[0] == 0.0


def test_a_raised_arm_and_leg_fall(lying):
    _, model = lying
    data = mujoco.MjData(model)
    for joint, angle in (("L_shoulder_flexion", 1.0), ("R_hip_flexion", 0.6), ("R_knee", 0.5)):
        data.joint(joint).qpos[0] = angle
    mujoco.mj_step(model, data, 2000)
    # what friction and damping can hold is little beside the weight of an arm or a leg
    for joint in ("L_shoulder_flexion", "R_hip_flexion", "R_knee"):
        assert abs(data.joint(joint).qpos[0]) < 0.15, joint


def test_no_joint_holds_more_than_friction_and_none_goes_far_beyond_its_range(person):
    _, model = person
    model.opt.gravity[:] = 0.0
    data = mujoco.MjData(model)
    rng = np.random.default_rng(7)
    data.qvel[6:] = rng.uniform(-2.0, 2.0, model.nv - 6)
    beyond = 0.0
    for _ in range(2000):
        mujoco.mj_step(model, data)
        span, angle = model.jnt_range[1:], data.qpos[7:]
        beyond = max(beyond, (span[:, 0] - angle).max(), (angle - span[:, 1]).max())
    assert beyond < 0.1
    assert abs(data.qvel[6:]).max() < 0.2  # damped out, not driven
    assert (model.jnt_limited[1:] == 1).all() and model.nu == 0


def test_the_neck_tells_its_angles_and_the_head_its_acceleration(lying):
    _, model = lying
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 2000)
    assert np.linalg.norm(data.sensor("head_acceleration").data) == pytest.approx(GRAVITY, rel=0.02)
    for axis, angle in (("flexion", 0.3), ("bending", -0.2), ("turn", 0.5)):
        data.joint(f"neck_{axis}").qpos[0] = angle
        mujoco.mj_forward(model, data)
        assert data.sensor(f"neck_{axis}").data[0] == angle
    ranges = [tuple(model.joint(f"neck_{a}").range) for a in ("flexion", "bending", "turn")]
    assert ranges == [(-0.7, 0.7), (-0.6, 0.6), (-1.2, 1.2)]  # [C]


def test_a_falling_head_feels_the_blow(lying):
    _, model = lying
    data = mujoco.MjData(model)
    data.qpos[2] += 0.3
    peak = 0.0
    for _ in range(500):
        mujoco.mj_step(model, data)
        peak = max(peak, np.linalg.norm(data.sensor("head_acceleration").data))
    assert 10 * GRAVITY < peak < 1000 * GRAVITY


def test_forces_are_told_apart_by_who_exerts_them():
    model = scenes.load("casualty", mass=90)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("ready").id)
    hurcules.step(model, data, 1000)
    forces = casualties.contact_forces(model, data)
    assert list(forces) == casualties.regions(model) and set(forces) == REGIONS
    for region, by in forces.items():
        felt = data.sensor(f"casualty_force_{region}").data[0]
        assert sum(by.values()) == pytest.approx(felt, abs=1e-9), region
        assert by["robot"] == by["things"] == 0.0
    assert sum(by["ground"] for by in forces.values()) == pytest.approx(90 * GRAVITY, rel=0.01)


def test_an_arm_that_presses_on_the_chest_is_told_from_the_ground_below():
    model = scenes.load("casualty", distance=2.0)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("drive").id)
    root, person = model.joint("root").qposadr[0], model.joint("casualty_root").qposadr[0]
    data.qpos[root + 2] = 3.0  # above everything
    data.qpos[person + 2] += 1e-3  # clear of the ground
    mujoco.mj_forward(model, data)
    # a lower track onto the chest: 2 mm into it
    chest, track = data.site("casualty_chest").xpos, data.geom("L_lower_run_1").xpos
    drop = track[2] - model.geom("L_lower_run_1").size[2] - chest[2] + 2e-3
    data.qpos[root : root + 2] += (chest - track)[:2]
    data.qpos[root + 2] -= drop
    hurcules.step(model, data, 20)  # until the leg's spring passes its weight on
    forces = casualties.contact_forces(model, data)
    assert forces["chest"]["robot"] > 0.0 and forces["chest"]["ground"] == 0.0


def test_without_a_casualty_the_message_names_the_prefix():
    with pytest.raises(hurcules.Error, match="no casualty with the prefix 'person_'"):
        casualties.regions(scenes.load("casualty"), prefix="person_")
