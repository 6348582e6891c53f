"""Robots out of URDF files: frames, limits of speed and effort, motors."""

from __future__ import annotations

import math
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error
from hurcules.motors import with_motors
from hurcules.urdf_shapes import fit_shapes, place_meshes

__all__ = ["load_urdf", "on_floor", "urdf_spec"]

_MOVING = ("revolute", "continuous", "prismatic")
_STIFF = (
    [0.004, 1.0],
    [0.99, 0.999, 0.001, 0.5, 2.0],
)  # time constant [s], impedance: of mimic joints
_LEAST_MASS, _LEAST_INERTIA = 1e-3, 1e-6  # [kg], [kg m^2] of links that say nothing, or less
_COMPILER = {
    "balanceinertia": "true",  # of links whose inertia no body can have
    "boundmass": str(_LEAST_MASS),
    "boundinertia": str(_LEAST_INERTIA),
    "inertiafromgeom": "false",
    "fusestatic": "false",  # keeps the frames of fixed joints
    "strippath": "false",
    "discardvisual": "false",
}


def load_urdf(
    path: str | Path,
    *,
    shapes: bool = True,
    visuals: bool = True,
    floating: bool = False,
    packages: Sequence[str | Path] = (),
) -> mujoco.MjModel:
    """A URDF as a model that `Robot` and `Simulation` take.

    All links stay frames, fixed ones too. The limits of position and effort are MuJoCo's, those of
    speed stand as numerics `velocity_limit_JOINT`, where `Robot` finds them. Each joint has a motor
    (`with_motors`). The root is fixed to the world, as in the file. Links that touch each other in
    the first posture never do: their hulls overlap by construction. What is only seen is in group
    1, and where a link has it, what touches is in group 3, which viewers hide at first.

    MuJoCo reads meshes in OBJ, MSH and binary STL. COLLADA (.dae), text STL, PLY, glTF and what
    else trimesh reads are taken where it is installed, `pip install 'hurcules[urdf]'`: a geom for
    each colour, in metres; as RViz does, the axis that COLLADA calls up is not looked at, and
    colours of a mesh come before those of the file. Reading them takes seconds for large robots:
    `visuals=False` where nobody looks.

    Args:
        path: of the file, or the URDF itself, a text that begins with `<`: what xacro gives, and
            ROS has as `robot_description`. Meshes are looked for as it names them,
            `package://NAME/...` in a folder NAME of `packages`, above the file, or of ROS.
        shapes: False leaves out everything to see and to touch.
        visuals: False leaves out what is only seen.
        floating: the root moves freely (joint "root") above a plane "floor", on which the robot
            stands in its first posture: `on_floor` for any other. One without a shape that can
            touch it, since its meshes are not read say, has its lowest link at that height, and
            falls through until it is given feet: `urdf_spec`.
        packages: folders that hold packages, beside those that ROS_PACKAGE_PATH and
            AMENT_PREFIX_PATH name.

    Raises:
        Error: a file that cannot be read, is no URDF, or is one that MuJoCo refuses.

    Warns:
        UserWarning: shapes that were left out, since their meshes are not there or of a kind that
            is not read; joints whose range is empty, that mimic none, or move no mass;
            links whose inertia no body has, and what it became (below 1 g and 1e-6 kg m^2, which
            every link has at least, without a word); a floating robot that touches no floor.
    """
    return _read(path, shapes, visuals, floating, packages)[1]


def urdf_spec(
    path: str | Path,
    *,
    shapes: bool = True,
    visuals: bool = True,
    floating: bool = False,
    packages: Sequence[str | Path] = (),
) -> mujoco.MjSpec:
    """The same as a specification, for what a scene has beside the robot.

    Arguments, errors and warnings are those of `load_urdf`. `spec.worldbody.add_geom(...)` adds a
    step, say, `spec.option.timestep` is the time step, and `spec.compile()` the model.
    `spec.body("sole").add_geom(...)` gives a foot to a robot whose meshes are not read.
    """
    return _read(path, shapes, visuals, floating, packages)[0]


def _read(
    path: str | Path,
    shapes: bool,
    visuals: bool,
    floating: bool,
    packages: Sequence[str | Path],
) -> tuple[mujoco.MjSpec, mujoco.MjModel]:
    text = path if isinstance(path, str) and path.lstrip().startswith("<") else None
    path = Path(path if text is None else "URDF")
    try:
        root = ET.parse(path).getroot() if text is None else ET.fromstring(text.lstrip())
    except OSError as error:
        raise Error(f"cannot read {path}: {error.strerror}") from error
    except ET.ParseError as error:
        raise Error(f"{path} is no XML: {error}") from error
    if root.tag != "robot":
        raise Error(f"{path} wants to be a URDF, whose root is <robot>; <{root.tag}> came")
    if any("xacro}" in element.tag for element in root.iter()):
        raise Error(f"{path} wants xacro first, which makes a URDF of it")
    meshes = fit_shapes(root, path, shapes, visuals, packages)
    told = _fit_inertias(root, path)
    _check_ranges(root, path)
    speeds = _speeds(root, path)
    extension = root.find("mujoco")
    if extension is None:
        extension = ET.SubElement(root, "mujoco")
    compiler = extension.find("compiler")
    if compiler is None:
        compiler = ET.SubElement(extension, "compiler")
    compiler.attrib.update(_COMPILER)
    compiler.attrib.pop("meshdir", None)
    try:
        spec = mujoco.MjSpec.from_string(ET.tostring(root, encoding="unicode"))
    except ValueError as error:
        raise Error(f"{path}: {error}") from error
    joints = {joint.name for joint in spec.joints}
    for name, speed in speeds.items():
        for part in ("", "_TX", "_TY", "_RZ"):  # a planar joint is three
            if name + part in joints:
                spec.add_numeric(name=f"velocity_limit_{name}{part}", data=[speed], size=1)
    for mimic in spec.equalities:  # by MuJoCo's own stiffness a hand rested 3 mm off
        mimic.solref, mimic.solimp = _STIFF
    place_meshes(spec, meshes)
    try:
        plain = spec.compile()
        for text in [*_doubts(root, plain), *_changed(told, plain)]:
            warnings.warn(f"{path.name}: {text}", stacklevel=3)
        _exclude_overlaps(spec, plain)
        if not floating:
            return spec, with_motors(spec)
        base = spec.worldbody.first_body()
        if base is None or spec.worldbody.next_body(base) is not None or spec.worldbody.geoms:
            raise Error("its root link is fixed to the world, or is empty: it cannot float")
        base.add_freejoint(name="root")
        spec.worldbody.add_light(pos=[0, -2, 4], dir=[0, 0.4, -1], castshadow=False)
        spec.worldbody.add_geom(name="floor", type=mujoco.mjtGeom.mjGEOM_PLANE, size=[10, 10, 0.1])
        model = with_motors(spec)
        lying = model.qpos0.copy()
        if _touching(model, model.geom("floor").id):
            model.qpos0[:] = on_floor(model, model.qpos0)
        else:
            model.qpos0[2] -= _lowest_link(model)
            warnings.warn(
                f"{path.name}: no shape of the robot can touch the floor: it falls through, and a "
                "ContactTask finds no sole; remedy: spec = urdf_spec(..., floating=True), "
                "spec.body('FOOT').add_geom(...) for each foot, spec.compile(), on_floor",
                stacklevel=3,
            )
        model.stat.center += (model.qpos0 - lying)[:3]  # where cameras look
        base.pos = model.qpos0[:3]
        return spec, model
    except (ValueError, Error) as error:
        raise Error(f"{path}: {error}") from error


def on_floor(
    model: mujoco.MjModel, qpos: NDArray[np.float64], floor: str = "floor", depth: float = 5e-4
) -> NDArray[np.float64]:
    """A configuration whose free root is as high as the robot stands on a plane.

    Args:
        model: with a free joint at the root of its first body.
        qpos: (nq,) what the robot's posture is.
        floor: name of a plane.
        depth: [m] that the lowest geom is in it: feet that only touch carry nothing in the first
            step.

    Returns:
        (nq,) the same with another height: the lowest of the geoms that can touch the plane does.

    Raises:
        Error: no such plane, no free root, or another number of numbers.
    """
    plane = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_GEOM, floor)
    if plane < 0 or model.geom_type[plane] != mujoco.mjtGeom.mjGEOM_PLANE:
        planes = np.flatnonzero(model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE)
        names = ", ".join(name for name in (model.geom(geom).name for geom in planes) if name)
        raise Error(
            f"on_floor wants the name of a plane, {floor!r} is none; there are: {names or 'none'}"
        )
    if np.shape(qpos) != (model.nq,):
        raise Error(f"on_floor wants qpos of shape ({model.nq},), {np.shape(qpos)} came")
    if model.njnt == 0 or model.jnt_type[0] != mujoco.mjtJoint.mjJNT_FREE:
        raise Error("on_floor wants a robot whose first joint is free")
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_forward(model, data)
    touch = _touching(model, plane)
    if not touch:
        raise Error(f"no geom of the robot can touch {floor!r}")
    placed = np.array(qpos, dtype=float)
    far = 1e3
    gap = min(mujoco.mj_geomDistance(model, data, geom, plane, far, None) for geom in touch)
    placed[:3] -= (gap + depth) * data.geom_xmat[plane].reshape(3, 3)[:, 2]
    return placed


def _touching(model: mujoco.MjModel, plane: int) -> list[int]:
    """The geoms of the robot that can touch a plane."""
    root = model.body_rootid[model.jnt_bodyid[0]]
    return [
        geom
        for geom in np.flatnonzero(model.body_rootid[model.geom_bodyid] == root).tolist()
        if model.geom_contype[geom] & model.geom_conaffinity[plane]
        or model.geom_contype[plane] & model.geom_conaffinity[geom]
    ]


def _lowest_link(model: mujoco.MjModel) -> float:
    """[m] how high the lowest frame of the robot is in its first posture."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    return float(data.xpos[1:, 2].min())


def _exclude_overlaps(spec: mujoco.MjSpec, model: mujoco.MjModel) -> None:
    data = mujoco.MjData(model)
    for joint in range(model.njnt):
        if model.jnt_limited[joint]:
            place = model.jnt_qposadr[joint]
            data.qpos[place] = np.clip(data.qpos[place], *model.jnt_range[joint])
    mujoco.mj_forward(model, data)
    pairs = {tuple(sorted(pair)) for pair in model.geom_bodyid[data.contact.geom].tolist()}
    for first, second in sorted(pairs):
        spec.add_exclude(bodyname1=model.body(first).name, bodyname2=model.body(second).name)


def _fit_inertias(root: ET.Element, path: Path) -> dict[str, NDArray[np.float64]]:
    """Inertias that no body has, which MuJoCo refuses, become the nearest that one may have.

    Returns:
        By link (3,) [kg m^2] its principal moments as they stand in the file, ascending.
    """
    told = {}
    for link in root.iter("link"):
        inertia = link.find("inertial/inertia")
        if inertia is None:
            continue
        try:
            tensor = _tensor(inertia)
        except ValueError as error:
            raise Error(f"{path}: inertia of link {link.get('name')!r}: {error}") from error
        file, axes = np.linalg.eigh(tensor)
        told[str(link.get("name"))] = file
        values = file.clip(_LEAST_INERTIA)
        values[2] = min(values[2], _SUM * (values[0] + values[1]))
        if not np.array_equal(values, file):
            tensor = axes @ np.diag(values) @ axes.T
        for key, (i, j) in _ENTRIES.items():
            inertia.set(key, repr(float(tensor[i, j])))
    return told


def _changed(told: dict[str, NDArray[np.float64]], model: mujoco.MjModel) -> Iterator[str]:
    """Which links have another inertia than the file says, by more than the least."""
    changed = []
    for body in map(model.body, range(1, model.nbody)):
        moments = np.sort(body.inertia)
        file = told.get(body.name)
        if file is not None and np.abs(moments - file).max() > 2.0 * _LEAST_INERTIA:
            was, now = (" ".join(f"{moment:.3g}" for moment in three) for three in (file, moments))
            changed.append(f"{body.name} ({was}: now {now})")
    if changed:
        more = f" and {len(changed) - _NAMED} others" if len(changed) > _NAMED else ""
        yield (
            "no body has the principal moments of inertia [kg m^2] of "
            f"{', '.join(changed[:_NAMED])}{more}: one of them is below 0 or above the sum of the "
            "other two"
        )


_NAMED = 6  # links in a warning
_SUM = 1.0 - 1e-9  # the largest moment is at most that of the others, rounding apart
_ENTRIES = {
    "ixx": (0, 0),
    "iyy": (1, 1),
    "izz": (2, 2),
    "ixy": (0, 1),
    "ixz": (0, 2),
    "iyz": (1, 2),
}


def _tensor(inertia: ET.Element) -> NDArray[np.float64]:
    tensor = np.zeros((3, 3))
    for key, (i, j) in _ENTRIES.items():
        tensor[i, j] = tensor[j, i] = float(inertia.get(key, "0"))
    return tensor


def _doubts(root: ET.Element, model: mujoco.MjModel) -> Iterator[str]:
    """What MuJoCo reads otherwise than the file has it, or makes up."""
    joints = {str(joint.get("name")): joint for joint in root.findall("joint")}
    moving = {name: one for name, one in joints.items() if one.get("type") in _MOVING}
    empty = [
        name
        for name, one in moving.items()
        if one.get("type") != "continuous" and not np.ptp(_range(one)) > 0.0
    ]
    if empty:
        yield f"the range of {', '.join(empty)} is empty and counts as none"
    for what in ("effort", "velocity"):
        limits = {name: one.find("limit") for name, one in moving.items()}
        zero = [n for n, one in limits.items() if one is not None and _number(one, what) == 0.0]
        if zero:
            yield f"the limit of {what} of {', '.join(zero)} is 0 and counts as none"
    mimics = {name: one.find("mimic") for name, one in moving.items()}
    leaders = {name: one.get("joint") for name, one in mimics.items() if one is not None}
    if lost := [f"{name} ({leader})" for name, leader in leaders.items() if leader not in moving]:
        yield f"joints mimic one that does not move or is not there: {', '.join(lost)}"
    links = np.ones(model.nbody)
    for body in range(model.nbody - 1, 0, -1):
        links[model.body_parentid[body]] += links[body]
    bodies = model.jnt_bodyid
    light = model.body_subtreemass[bodies] < 1.01 * _LEAST_MASS * links[bodies]
    if names := ", ".join(model.joint(i).name for i in np.flatnonzero(light)):
        yield f"what {names} move has no mass: a link without one counts as 1 g"


def _number(limit: ET.Element, what: str) -> float:
    try:
        return float(limit.get(what, "nan"))
    except ValueError:  # MuJoCo's to refuse
        return math.nan


def _range(joint: ET.Element) -> tuple[float, float]:
    limit = joint.find("limit")
    read = {} if limit is None else limit.attrib
    return float(read.get("lower", "0")), float(read.get("upper", "0"))


def _check_ranges(root: ET.Element, path: Path) -> None:
    """MuJoCo takes a range that is none for no range, and gives continuous joints theirs."""
    for joint in root.findall("joint"):
        limit = joint.find("limit")
        if joint.get("type") == "continuous" and limit is not None:
            limit.attrib.pop("lower", None)
            limit.attrib.pop("upper", None)
        if joint.get("type") not in ("revolute", "prismatic"):
            continue
        try:
            lower, upper = _range(joint)
        except ValueError as error:
            raise Error(f"{path}: range of joint {joint.get('name')!r}: {error}") from error
        if not lower <= upper:
            name = joint.get("name")
            raise Error(f"{path}: range of joint {name!r}: lower {lower:g} above upper {upper:g}")


def _speeds(root: ET.Element, path: Path) -> dict[str, float]:
    """By joint its limit [rad/s] or [m/s], where it has one above 0."""
    speeds = {}
    for joint in root.findall("joint"):
        limit = joint.find("limit")
        text = None if limit is None else limit.get("velocity")
        if text is None:
            continue
        try:
            speed = float(text)
        except ValueError:
            speed = math.nan
        if math.isnan(speed) or speed < 0.0:
            raise Error(f"{path}: joint {joint.get('name')!r} wants a velocity >= 0, got {text!r}")
        if 0.0 < speed < math.inf:
            speeds[str(joint.get("name"))] = speed
    return speeds
