"""A robot and its surroundings as one MJCF file without includes, for other programs.

What such a program does not know stays behind: it steps by `mj_step` alone, so the belts have no
traction and the tracks stand as if braked.
"""

from __future__ import annotations

import shutil
from pathlib import Path

import mujoco
import numpy as np

from hurcules import _core, mjcf, models
from hurcules.output import writing
from hurcules.validation import require_known

__all__ = ["ACTUATORS", "export"]

ACTUATORS = ("motor", "position")
TERRAIN = 2  # contact bit of the ground, see models/README.md


def export(
    path: Path | str,
    robot: str | None = None,
    scene: str | None = None,
    *,
    actuators: str = "motor",
    mjx: bool = False,
) -> Path:
    """Writes one MJCF file, and its meshes to the folder `assets` beside it.

    Args:
        path: of the file.
        robot: one of `models.names()`; by default the robot that the scene is made for.
        scene: one of `models.scenes()`; by default "flat".
        actuators: "motor", torques as in our models; "position", servos at every joint that hold
            the angle they are told. With these the robot stands at control 0 and in every keyframe.
        mjx: leaves out what MJX 3.17 does not take: the sensors of the tracks' loads, and contacts
            of cylinders with anything but the ground, so that the ends of the tracks meet nothing
            but a plane.

    Returns:
        The path.

    Raises:
        Error: an unknown name.
        WriteError: the file cannot be written.
    """
    require_known("kind of actuators", actuators, list(ACTUATORS))
    path = Path(path)
    spec = models.make(robot, scene)
    if mjx:
        _fit_mjx(spec)
    if actuators == "position":
        _add_servos(spec)
    mjcf.compile(spec)
    with writing(path):
        _copy_meshes(spec, path.parent / "assets")
        path.write_text(spec.to_xml(), encoding="utf-8")
    return path


def _copy_meshes(spec: mujoco.MjSpec, folder: Path) -> None:
    folder.mkdir(parents=True, exist_ok=True)
    source = Path(spec.modelfiledir)
    for mesh in spec.meshes:
        if not mesh.file:  # its points stand in the model
            continue
        original = source / spec.meshdir / mesh.file
        shutil.copyfile(original, folder / original.name)
        mesh.file = original.name
    spec.meshdir = folder.name
    spec.modelfiledir = str(folder.parent)


def _add_servos(spec: mujoco.MjSpec) -> None:
    """Position servos with the gains of our own, critically damped; the belts keep their motors."""
    table = _core.servo_table(_core.Robot(mjcf.compile(spec)))
    motors = [motor for motor in spec.actuators if not motor.target.endswith("_belt")]
    for motor in motors:
        inertia, bandwidth = table[motor.target]
        motor.set_to_position(kp=inertia * bandwidth**2, kv=2.0 * inertia * bandwidth)
        motor.ctrlrange = spec.joint(motor.target).range
        motor.forcelimited = True
    model = mjcf.compile(spec)
    places = [int(model.joint(motor.target).qposadr[0]) for motor in motors]
    rows = [model.actuator(motor.name).id for motor in motors]
    for key in spec.keys:
        control = np.zeros(model.nu)
        control[rows] = model.key(key.name).qpos[places]
        key.ctrl = control


def _fit_mjx(spec: mujoco.MjSpec) -> None:
    for sensor in list(spec.sensors):
        if sensor.type == mujoco.mjtSensor.mjSENS_CONTACT:
            spec.delete(sensor)
    for geom in spec.geoms:
        meets = bool(geom.contype or geom.conaffinity)
        if geom.type == mujoco.mjtGeom.mjGEOM_CYLINDER and meets:
            geom.contype, geom.conaffinity = 0, TERRAIN
