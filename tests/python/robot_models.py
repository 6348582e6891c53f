"""What the model tests share: the numbers that the design page fixes, and how models are asked.

Sources: docs/design/robot.md and docs/design/mujoco.md.
"""

from pathlib import Path

import mujoco
import numpy as np

MODELS = Path(__file__).resolve().parents[2] / "models"
ROBOTS = ("rescue", "manipulation")
MODULES = sorted(MODELS.glob("modules/*.xml"))
FRAGMENTS = [file for file in MODULES if "<mujocoinclude>" in file.read_text()]

# [robot#joints] joint: peak torque N m, peak speed rad/s, armature kg m2, range rad
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

# [robot#postures] theta, lean, a, b: angles of upper legs, trunk, upper arm, lower arm
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

# [robot#passive-joints] stiffness N m/rad or N/m, damping, range, where it gives no force
SPRINGS = {
    "rescue": {"LEBS": (500, 15, (0, 0.20), 0.08), "bed_spring": (20e3, 1.5e3, (-0.09, 0), 0.015)},
    "manipulation": {
        "LWPS": (1500, 8, (-0.10, 0.10), 0.0),
        "L_pad_1": (50e3, 250, (0, 0.012), 0.0),
        "L_pad_2": (50e3, 250, (0, 0.012), 0.0),
    },
}
# [robot#transfer-bed] joint: peak force N, peak speed m/s, range m
BED = {"bed_lift": (4000, 0.1, (0, 0.40)), "L_bed_1": (300, 0.2, (0, 0.31))}
# moment of a level lower arm of the rescue robot about its elbow [N m]: 11.5 kg at 0.30 m
SCOOP_WEIGHT = 11.5 * 9.81 * 0.30


def elbow_spring(b):
    """Where the elbow spring carries a lower arm at angle b from straight down [rad]."""
    return 0.08 - SCOOP_WEIGHT * np.sin(b) / 500


def load(path):
    return mujoco.MjModel.from_xml_path(str(MODELS / path))


def geoms_of(model, body):
    first = int(model.body(body).geomadr[0])
    return list(range(first, first + int(model.body(body).geomnum[0]))) if first >= 0 else []


def on_flat_ground(name):
    """Name, model alone on flat ground, data."""
    text = f"""<mujoco><include file="{MODELS}/robots/{name}.xml"/>
               <include file="{MODELS}/scenes/flat.xml"/></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    return name, model, mujoco.MjData(model)


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
