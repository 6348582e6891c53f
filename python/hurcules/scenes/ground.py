"""Surroundings while they are built: an MjSpec with sky and floor, and parts to put on it.

The robot comes first, so that its keyframes hold; metres, radians, x forward, y left, z up.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules import mjcf
from hurcules.scenes.materials import add_materials

__all__ = ["Ground", "read_object", "turn"]

FLOOR = "floor"
TRACK_RADIUS = 0.14  # [m] of Hurcules' belts


def turn(axis: str, angle: float) -> NDArray[np.float64]:
    """The quaternion (4) of a turn about x, y or z."""
    quat = np.array([math.cos(angle / 2), 0.0, 0.0, 0.0])
    quat[1 + "xyz".index(axis)] = math.sin(angle / 2)
    return quat


def read_object(name: str) -> mujoco.MjSpec:
    """A thing of models/objects, not compiled yet."""
    return mujoco.MjSpec.from_file(str(mjcf.folder() / "objects" / f"{name}.xml"))


class Ground:
    """What stands and lies in a scene.

    Attributes:
        spec: the model.
        rng: random numbers of the scene's seed.
        friction: sliding friction of everything that is ground.
    """

    def __init__(self, robot: str | None, friction: float, seed: int) -> None:
        """Sky, sun, a floor, and the robot at the origin.

        Args:
            robot: one of `models.names()`, None for no robot.
            friction: sliding friction of everything that is ground.
            seed: what is drawn in this scene follows from it alone.
        """
        folder = mjcf.folder()
        common = [folder / "common" / f"{name}.xml" for name in ("options", "classes")]
        files = [mjcf.robot(robot)] if robot else common
        self.spec = mjcf.parse([*files, folder / "scenes" / "flat.xml"])
        self.rng = np.random.default_rng(seed)
        self._robot = robot
        self.friction = friction
        add_materials(self.spec)
        if robot is None:  # the robot brings the sun that follows it
            _add_sun(self.spec)
        self._slide(self.spec.geom(FLOOR))

    def floor(self, z: float = 0.0, quat: ArrayLike = (1, 0, 0, 0), size: float = 60.0) -> None:
        """Moves the floor; its plane reaches everywhere, `size` [m] of it is seen."""
        geom = self.spec.geom(FLOOR)
        geom.pos, geom.quat, geom.size = [0, 0, z], quat, [size, size, 1]

    def box(self, name: str, low: Sequence[float], high: Sequence[float], **more: Any) -> Any:
        """A box between two corners [m]; more: `material`, `frame`."""
        corners = np.array([low, high], dtype=float)
        half, centre = (corners[1] - corners[0]) / 2, corners.mean(axis=0)
        return self._geom(name, mujoco.mjtGeom.mjGEOM_BOX, size=half, pos=centre, **more)

    def block(
        self, name: str, half: ArrayLike, pos: ArrayLike, quat: ArrayLike, **more: Any
    ) -> Any:
        """A turned box: half sizes [m], centre [m], quaternion."""
        return self._geom(name, mujoco.mjtGeom.mjGEOM_BOX, size=half, pos=pos, quat=quat, **more)

    def cylinder(self, name: str, radius: float, ends: Sequence[ArrayLike], **more: Any) -> Any:
        """A cylinder between two points [m]."""
        shape, fromto = mujoco.mjtGeom.mjGEOM_CYLINDER, np.concatenate([*map(np.asarray, ends)])
        return self._geom(name, shape, size=[radius, 0, 0], fromto=fromto, **more)

    def hull(self, name: str, corners: ArrayLike, **more: Any) -> Any:
        """The convex hull of some points (n, 3) [m]."""
        points = np.asarray(corners, dtype=float)
        self.spec.add_mesh(name=name, uservert=points.flatten())
        return self._geom(name, mujoco.mjtGeom.mjGEOM_MESH, meshname=name, **more)

    def field(
        self, name: str, heights: NDArray[np.float64], corner: ArrayLike, cell: float, **more: Any
    ) -> Any:
        """A height field.

        Args:
            name: of the geom.
            heights: (rows along y, columns along x) [m].
            corner: x and y of the first height [m].
            cell: distance between heights [m].
            more: `material`.
        """
        rows, columns = heights.shape
        half = np.array([columns - 1, rows - 1]) * cell / 2
        low, span = float(heights.min()), max(float(np.ptp(heights)), 1e-6)
        data = ((heights - low) / span).astype(np.float32)
        size = [*half, span, 0.5]
        self.spec.add_hfield(name=name, nrow=rows, ncol=columns, size=size, userdata=data.flatten())
        centre = [*(np.asarray(corner) + half), low]
        return self._geom(name, mujoco.mjtGeom.mjGEOM_HFIELD, hfieldname=name, pos=centre, **more)

    def attach(
        self,
        thing: str | mujoco.MjSpec,
        prefix: str,
        pos: ArrayLike,
        quat: ArrayLike = (1, 0, 0, 0),
    ) -> mujoco.MjSpec:
        """Puts a thing into the scene, its names behind a prefix.

        Args:
            thing: a name of models/objects, or what was read from there and changed.
            prefix: before all its names.
            pos: (3) [m].
            quat: (4).

        Returns:
            The thing's MjSpec as it was before.
        """
        child = read_object(thing) if isinstance(thing, str) else thing
        frame = self.spec.worldbody.add_frame(pos=pos, quat=quat)
        self.spec.attach(child, prefix=prefix, frame=frame)
        return child

    def start(self, pos: ArrayLike = (0, 0, 0), quat: ArrayLike = (1, 0, 0, 0)) -> None:
        """Moves the robot and all its keyframes from the origin to a pose."""
        if self._robot is None:
            return
        body = self.spec.body("upper_legs")
        body.pos, body.quat = _moved(pos, quat, np.r_[body.pos, body.quat])
        for key in self.spec.keys:
            qpos = np.array(key.qpos)
            qpos[:7] = np.concatenate(_moved(pos, quat, qpos[:7]))
            key.qpos = qpos

    def resist(self, rolling: float) -> None:
        """Lets the belts work against the ground as they roll.

        A thing can read the coefficient from the numeric `rolling_resistance`. The driven belts get
        the friction that this coefficient times the robot's weight gives on level ground, half
        each.

        Args:
            rolling: rolling resistance over weight.
        """
        self.spec.add_numeric(name="rolling_resistance", data=[rolling], size=1)
        if self._robot is None or rolling == 0.0:
            return
        model = self.spec.compile()
        weight = model.body("upper_legs").subtreemass[0] * np.linalg.norm(model.opt.gravity)
        for side in "LR":
            self.spec.joint(f"{side}_lower_belt").frictionloss = rolling * weight * TRACK_RADIUS / 2

    def _geom(
        self, name: str, shape: Any, frame: Any = None, material: str = "concrete", **more: Any
    ) -> Any:
        terrain = self.spec.find_default("terrain")
        parent = frame or self.spec.worldbody
        geom = parent.add_geom(terrain, name=name, type=shape, material=material, **more)
        self._slide(geom)
        return geom

    def _slide(self, geom: Any) -> None:
        geom.friction[0] = self.friction


def _add_sun(spec: Any) -> None:
    sun = spec.worldbody.add_light(name="sun", pos=[2.2, 2.6, 5], dir=[-0.40, -0.47, -0.90])
    sun.type = mujoco.mjtLightType.mjLIGHT_DIRECTIONAL
    sun.diffuse, sun.specular = [0.75, 0.73, 0.68], [0.3, 0.3, 0.3]


def _moved(
    pos: ArrayLike, quat: ArrayLike, pose: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """A pose (7) in a frame that stands at `pos`, `quat`."""
    point, rotation = np.zeros(3), np.zeros(4)
    there = np.asarray(pose, dtype=float)
    mujoco.mju_rotVecQuat(point, there[:3], np.asarray(quat, dtype=float))
    mujoco.mju_mulQuat(rotation, np.asarray(quat, dtype=float), there[3:])
    return point + np.asarray(pos, dtype=float), rotation
