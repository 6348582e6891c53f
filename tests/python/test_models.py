"""The robots, their modules and the casualty, as MuJoCo reads them from models/.

Strategy: every number that the design notes fix is stated once here, with its source, and compared
with the compiled model; the postures are recomputed from the angles that define them; who touches
whom is asked from MuJoCo's own collision detection. Sources: [F] = hurcules-facts.md sections A2 to
A9, [M] = mujoco-facts.md section 4, [C] = response-robot-tests.md section C4.

Not tested here: driving, traction and servo control (the belts need the C++ step), and the looks.
"""

import re
import subprocess
import sys
from pathlib import Path

import mujoco
import numpy as np
import pytest

MODELS = Path(__file__).resolve().parents[2] / "models"
ROBOTS = ("rescue", "manipulation")
MODULES = sorted(MODELS.glob("modules/*.xml"))
FRAGMENTS = [file for file in MODULES if "<mujocoinclude>" in file.read_text()]

# [F A4] link: mass kg, centre of mass in the link m, inertia kg m2
LINKS = {
    "upper_legs": (90, (-0.27, 0, 0.03), (2.32, 5.76, 6.90)),
    "battery": (60, (0, 0, 0), (0.56, 1.31, 1.19)),
    "lower_leg_L": (95, (-0.40, 0, 0), (0.80, 10.73, 10.29)),
    "pelvis": (60, (0, 0, 0.02), (0.92, 0.63, 0.87)),
    "waist": (35, (0, 0, 0.13), (0.534, 0.460, 0.600)),
    "torso": (95, (0, 0, 0.24), (3.51, 2.51, 2.07)),
    "backpack": (30, (0, 0, 0), (0.881, 0.650, 0.281)),
    "neck": (4, (0, 0, 0.04), (0.007, 0.007, 0.007)),
    "head": (10, (0.03, 0, 0.12), (0.131, 0.113, 0.113)),
    "L_sh1": (10, (0, 0.05, 0), (0.038, 0.043, 0.038)),
    "L_sh2": (8, (0, 0, -0.05), (0.032, 0.032, 0.030)),
    "L_uarm": (12, (0, 0, -0.14), (0.110, 0.110, 0.039)),
}
LOWER_ARMS = {
    "rescue": {
        "L_larm": (11.5, (0, 0, -0.30), (0.511, 0.499, 0.016)),
        "transfer_bed": (23, (0, 0, 0), (0.418, 0.261, 0.654)),
    },
    "manipulation": {
        "L_farm": (8, (0, 0, -0.09), (0.036, 0.036, 0.019)),
        "L_wr1": (5, (0, 0, -0.07), (0.016, 0.016, 0.010)),
        "L_wr2": (4, (0, 0, -0.03), (0.007, 0.007, 0.007)),
        "L_hand": (6, (0, 0, -0.07), (0.021, 0.023, 0.012)),  # with its fingers
    },
}
# [F A4] joint: peak torque N m, peak speed rad/s, armature kg m2, range rad
EB_RANGE = {"rescue": (0, 2.48), "manipulation": (-0.05, 2.48)}
HIP_RANGE = {"rescue": (-2.00, 1.05), "manipulation": (-2.00, 1.40)}
DRIVES = {
    "KN": (4500, 0.6, 27, (-0.35, 3.25)),
    "HIP": (5500, 0.5, 54, None),
    "WST": (900, 0.8, 4, (-1.92, 1.92)),
    "NKY": (20, 2.0, 0.03, (-1.57, 1.57)),
    "NKP": (30, 2.0, 0.03, (-1.2, 1.3)),
    "SP": (800, 1.5, 2.6, (-0.6, 2.6)),
    "SR": (800, 1.5, 2.6, (-0.02, 1.75)),
    "SY": (350, 2.0, 0.9, (-1.57, 1.57)),
    "EB": (600, 1.8, 0.9, None),
    "WY": (120, 2.5, 0.14, (-1.9, 1.9)),
    "WP": (150, 2.5, 0.14, (-1.4, 1.4)),
    "WY2": (60, 2.5, 0.10, (-1.9, 1.9)),
}
ARM = {"rescue": ["SP", "SR", "SY", "EB"]}
ARM["manipulation"] = ARM["rescue"] + ["WY", "WP", "WY2"]
BODY = ["HIP", "WST", "NKY", "NKP"]
SITES = ["pelvis", "gaze", "imu"] + [
    s + n for s in ("L_", "R_") for n in ("tcp", "wrist", "elbow", "shoulder")
]
CAMERAS = ["head_wide", "head_left", "head_right", "overview", "side"]
TRACKS = ["L_lower", "R_lower", "L_upper", "R_upper"]

# [F A9] theta, lean, a, b: angles of upper legs, trunk, upper arm, lower arm
STANDING = {
    ("rescue", "ready"): (np.pi / 2, 0.0, 0.35, 1.85),
    ("rescue", "acquisition"): (1.1, 1.45, -0.574, 1.0),
    ("rescue", "carry"): (np.pi / 2, 0.0, -0.1, 1.75),
    ("manipulation", "ready"): (np.pi / 2, 0.0, 0.35, 1.85),
    ("manipulation", "acquisition"): (1.1, 1.4, 0.5, 0.725),
    ("manipulation", "carry"): (np.pi / 2, 0.0, -0.1, 1.55),
}
STRETCH = {"KN": 1.981, "HIP": 0.327, "NKP": -0.835, "SP": 1.190, "EB": 1.474}
DRIVE = {"rescue": {"SP": 0.0, "EB": 1.6}, "manipulation": {"SP": 0.35, "EB": 1.5}}
TRACK_RADIUS = 0.14


def load(path):
    return mujoco.MjModel.from_xml_path(str(MODELS / path))


def geoms_of(model, body):
    first = int(model.body(body).geomadr[0])
    return list(range(first, first + int(model.body(body).geomnum[0]))) if first >= 0 else []


@pytest.fixture(scope="module", params=ROBOTS)
def robot(request):
    """Name, model alone on flat ground, data."""
    text = f"""<mujoco><include file="{MODELS}/robots/{request.param}.xml"/>
               <include file="{MODELS}/scenes/flat.xml"/></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    return request.param, model, mujoco.MjData(model)


def place(model, data, key):
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)


def sides(name):
    """Both joints of a coordinate that exists left and right, else the name itself."""
    return [name] if name in BODY else ["L" + name, "R" + name]


def keys_of(name):
    return ["home", "drive", "ready", "acquisition", "carry"] + ["stretch"] * (name == "rescue")


def expected_joints(name, key):
    """Joint angles of a keyframe from the definition of its posture, and the pitch of the base."""
    if key in ("home", "drive"):
        return DRIVE[name], 0.0
    if key == "stretch":
        return STRETCH, np.pi - STRETCH["KN"]
    theta, lean, a, b = STANDING[name, key]
    return {"KN": np.pi - theta, "HIP": lean - theta, "SP": a + lean, "EB": b - a}, theta


def touching(model, data):
    """Pairs of geoms in contact."""
    mujoco.mj_fwdPosition(model, data)

    def names(c):
        return tuple(sorted(model.geom(int(g)).name for g in c.geom))

    return {names(c) for c in data.contact[: data.ncon]}


def composite(model, names):
    """Mass, centre and inertia about it of several bodies together, axes of the first body."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    ids = [model.body(n).id for n in names]
    mass = model.body_mass[ids]
    centre = mass @ data.xipos[ids] / mass.sum()
    inertia = np.zeros((3, 3))
    for i, m in zip(ids, mass, strict=True):
        axes, arm = data.ximat[i].reshape(3, 3), data.xipos[i] - centre
        inertia += axes @ np.diag(model.body_inertia[i]) @ axes.T
        inertia += m * (arm @ arm * np.eye(3) - np.outer(arm, arm))
    frame = data.xmat[ids[0]].reshape(3, 3)
    return mass.sum(), frame.T @ (centre - data.xpos[ids[0]]), frame.T @ inertia @ frame


def top_of(model, data):
    """Highest visible point of the robot [m]: support function of each visual geom along z."""
    best = -np.inf
    for g in range(model.ngeom):
        if model.geom_bodyid[g] == 0 or model.geom_group[g] != 2:
            continue
        up = data.geom_xmat[g].reshape(3, 3)[2]
        size, kind = model.geom_size[g], mujoco.mjtGeom(model.geom_type[g])
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            mesh = model.mesh(int(model.geom_dataid[g]))
            first = int(mesh.vertadr[0])
            rise = (model.mesh_vert[first : first + int(mesh.vertnum[0])] @ up).max()
        elif kind == mujoco.mjtGeom.mjGEOM_BOX:
            rise = abs(up) @ size
        elif kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
            rise = size[0] + abs(up[2]) * size[1]
        elif kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
            rise = size[0] * np.hypot(up[0], up[1]) + abs(up[2]) * size[1]
        else:
            raise AssertionError(f"no support function for {kind}")
        best = max(best, data.geom_xpos[g][2] + rise)
    return best


# ---- files


@pytest.mark.parametrize(
    "file", ["robots/rescue", "robots/manipulation", "scenes/stretch", "objects/casualty_75kg"]
)
def test_a_complete_file_loads_alone_and_steps(file):
    model = load(f"{file}.xml")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 10)
    assert np.isfinite(data.qpos).all() and not any(w.number for w in data.warning)


@pytest.mark.parametrize("path", FRAGMENTS, ids=lambda p: p.stem)
def test_a_module_loads_alone_on_a_stand_and_steps(path):
    model = mujoco.MjModel.from_xml_string(f"""<mujoco><include file="{MODELS}/common/options.xml"/>
        <include file="{MODELS}/common/classes.xml"/><include file="{MODELS}/common/looks.xml"/>
        <worldbody><body name="stand"><include file="{path}"/></body></worldbody></mujoco>""")
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 10)
    assert model.ngeom > 1 and np.isfinite(data.qpos).all()


def test_every_module_is_part_of_a_robot():
    used = {
        f
        for r in ROBOTS
        for f in re.findall(r"modules/(\w+)", (MODELS / f"robots/{r}.xml").read_text())
    }
    assert used == {path.stem for path in MODULES}


def test_a_model_loads_from_a_relative_path_too(monkeypatch):
    monkeypatch.chdir(MODELS.parent)
    assert mujoco.MjModel.from_xml_path("models/scenes/stretch.xml").nkey == 6


def test_the_meshes_are_what_their_script_writes(tmp_path):
    script = MODELS / "assets/make_meshes.py"
    subprocess.run([sys.executable, "-B", script, tmp_path], check=True, capture_output=True)
    kept = {f.name: f.read_text() for f in (MODELS / "assets/meshes").iterdir()}
    assert {f.name: f.read_text() for f in tmp_path.iterdir()} == kept


# ---- masses and sizes


def test_the_robot_weighs_680_kg(robot):  # [F A2]
    assert mujoco.mj_getTotalmass(robot[1]) == pytest.approx(680.0, abs=0.05)


def test_links_have_the_mass_centre_and_inertia_of_the_table(robot):
    name, model, _ = robot
    for link, (mass, centre, inertia) in {**LINKS, **LOWER_ARMS[name]}.items():
        parts = [link] + [f"L_finger_{i}" for i in (1, 2)] * (link == "L_hand")
        m, c, tensor = composite(model, parts)
        assert m == pytest.approx(mass), link
        assert c == pytest.approx(centre, abs=1e-4), link
        assert tensor == pytest.approx(np.diag(inertia), abs=1e-4), link


def test_the_right_side_mirrors_the_left(robot):
    _, model, data = robot
    place(model, data, "ready")
    mirror = np.diag([1, -1, 1])

    def other(n):
        return re.sub("^L", "R", n).replace("leg_L", "leg_R")

    left = [n for n in (model.body(i).name for i in range(model.nbody)) if other(n) != n]
    assert len(left) >= 9
    for n in left:
        a, b = data.body(n), data.body(other(n))
        assert b.xipos == pytest.approx(mirror @ a.xipos, abs=1e-9), n

        def tensor(d, k):
            return d.ximat.reshape(3, 3) @ np.diag(model.body(k).inertia) @ d.ximat.reshape(3, 3).T

        assert tensor(b, other(n)) == pytest.approx(mirror @ tensor(a, n) @ mirror, abs=1e-9), n
        for mine, its in zip(geoms_of(model, n), geoms_of(model, other(n)), strict=True):
            mesh = model.geom_type[mine] == mujoco.mjtGeom.mjGEOM_MESH
            near = 1e-3 if mesh else 1e-9  # meshes are rounded and turned rather than mirrored
            assert model.geom_size[its] == pytest.approx(model.geom_size[mine], abs=near)
            assert data.geom_xpos[its] == pytest.approx(mirror @ data.geom_xpos[mine], abs=near)


@pytest.mark.parametrize("key, height", [("drive", 1.678), ("ready", 1.900)])  # [F A2]
def test_the_robot_is_as_high_as_published(robot, key, height):
    _, model, data = robot
    place(model, data, key)
    assert top_of(model, data) == pytest.approx(height, abs=0.005)


# ---- names and limits


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


def test_all_agreed_names_exist(robot):
    name, model, _ = robot
    for finder, names in (
        (model.site, SITES), (model.camera, CAMERAS), (model.key, keys_of(name)),
        (model.actuator, ["L_drive", "R_drive"] + ["L_grip", "R_grip"] * (name == "manipulation")),
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
        assert len(boxes) >= 2 and all(sizes[g][2] == TRACK_RADIUS for g in boxes)  # [M 4.1]
        assert all(
            sizes[g][0] == pytest.approx(TRACK_RADIUS - 0.001) for g in set(geoms) - set(boxes)
        )
    for side in "LR":  # [F A3] an axle behind the knee would be pressed into the ground
        heel, knee = data.geom(f"{side}_lower_heel").xpos, data.joint(f"{side}KN").xanchor
        assert heel == pytest.approx(knee) and np.allclose(
            data.joint(f"{side}_lower_belt").xanchor, knee
        )


# ---- postures


def test_keyframes_follow_from_the_angles_that_define_them(robot):
    name, model, data = robot
    for key in keys_of(name):
        place(model, data, key)
        joints, theta = expected_joints(name, key)
        for coordinate in ["KN"] + BODY + ARM[name]:
            for joint in sides(coordinate):
                assert data.joint(joint).qpos[0] == pytest.approx(
                    joints.get(coordinate, 0), abs=1e-5
                )
                low, high = model.joint(joint).range
                assert low <= data.joint(joint).qpos[0] <= high
        assert data.qpos[:3] == pytest.approx([0, 0, TRACK_RADIUS], abs=2e-4)
        assert data.qpos[3:7] == pytest.approx(
            [np.cos(theta / 2), 0, np.sin(theta / 2), 0], abs=1e-5
        )


def test_only_the_right_tracks_touch_the_ground_in_a_keyframe(robot):
    name, model, data = robot
    for key in keys_of(name):
        place(model, data, key)
        pairs = touching(model, data)
        assert all("floor" in p for p in pairs), (key, pairs)
        standing = key not in ("home", "drive")
        runs = {f"{t}_run_{i}" for t in (TRACKS[:2] if standing else TRACKS) for i in (1, 2)}
        assert {g for p in pairs for g in p} == runs | {"floor"}


def test_the_scoops_start_the_stretch_where_the_notes_say():  # [F A4]
    model = load("robots/rescue.xml")
    data = mujoco.MjData(model)
    place(model, data, "stretch")
    for side, y in (("L", 0.33), ("R", -0.33)):
        tcp = data.site(f"{side}_tcp")
        assert tcp.xpos == pytest.approx([1.432, y, 0.128], abs=2e-3)
        outward, _, normal = tcp.xmat.reshape(3, 3).T
        assert np.arcsin(-outward[2]) == pytest.approx(0.395, abs=2e-3) and normal[2] > 0.9


@pytest.mark.parametrize("fold", [False, True], ids=["waist ahead", "waist turned"])
def test_legs_swing_free_only_with_the_waist_turned(robot, fold):  # [F A9], negative control
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


def test_bed_and_battery_stop_the_trunk_behind_the_hip_range(robot):  # [F A4]
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


# ---- the person


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
