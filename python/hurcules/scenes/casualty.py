"""A limp person on the ground across the way."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error
from hurcules.scenes.ground import Ground, read_object, turn
from hurcules.scenes.parameters import choice, number
from hurcules.scenes.ramps import Ramps
from hurcules.scenes.scene import Scene
from hurcules.scenes.surfaces import road

__all__ = ["Casualty"]

# from upright (x to the front, z up) to lying with the head along +y
BACK = np.array([0.5, -0.5, -0.5, -0.5])
ROLL = {"back": 0.0, "left": math.pi / 2, "front": math.pi, "right": -math.pi / 2}
WIDTH = 6.0  # [m] of the terrain, about
CELL, FADE = 0.1, 0.8  # [m] between heights of a road, and from the level ground to its roughness
RAMP = 1.2  # [m] of one at the most, up or down
# [rad] of both arms, within their ranges: 80 degrees from the trunk; the forearms over the belly
ARMS: dict[str, dict[str, float]] = {
    "sides": {},
    "out": {"shoulder_abduction": 1.2},
    "folded": {"shoulder_abduction": 0.4, "shoulder_turn": -0.78, "elbow": 1.9},
}
LIE_STILL = {
    "back": tuple(ARMS),
    "front": ("sides", "out"),
    "left": ("sides",),
    "right": ("sides",),
}
TRUNK = ("pelvis", "belly", "lower_back", "chest", "upper_back")  # what folded arms lie on
ON_TRUNK = 16  # contact bit: a casualty does not meet itself, see models/README.md


@dataclass(frozen=True)
class Casualty(Scene):
    """One of the persons of models/objects, its names behind `casualty_`."""

    mass: int = choice(75, (50, 75, 90, 120), "of the person, kg")
    lying: str = choice("back", tuple(ROLL), "on which side")
    arms: str = choice("sides", tuple(ARMS), "along the body, 80 degrees out, or over the belly")
    distance: float = number(2.72, 1.5, 20.0, "m", "from the start to the person's middle")
    lateral: float = number(0.0, -5.0, 5.0, "m", "the person's middle to the left of the way")
    heading: float = number(0.0, -math.pi, math.pi, "rad", "turned by this; 0: head to the left")
    cloth: float = number(0.45, 0.1, 1.5, "", "friction of the clothes on the ground")
    terrain: str = choice("flat", ("flat", "road", "ramps"), "on the way to the person")
    near: float = number(1.5, 1.2, 20.0, "m", "from the start to the terrain")
    way: float = number(5.0, 2.0, 20.0, "m", "across the terrain")
    rise: float = number(0.1, 0.07, 0.5, "m", "from its lowest to its highest point")

    def __post_init__(self) -> None:
        """Refuses arms that would fall, or lie in the ground, as the scene begins."""
        super().__post_init__()
        fitting = LIE_STILL[self.lying]
        if self.arms not in fitting:
            raise Error(
                f"casualty: arms wants one of {', '.join(fitting)} for a person lying "
                f"{self.lying!r}, got {self.arms!r}"
            )

    def build(self, ground: Ground) -> None:
        """Lays the person down just above the ground, which is level there."""
        if self.terrain == "road":
            self._road(ground)
        elif self.terrain == "ramps":
            rows = 2 * math.ceil(self.way / (2 * RAMP))
            side = self.way / rows
            angle, columns = math.atan(self.rise / side), round(WIDTH / side)
            field = Ramps(self.friction, "continuous", angle, side, rows, columns, 0.0, self.near)
            field.build(ground)
        quat = _product(turn("z", self.heading), _product(turn("y", ROLL[self.lying]), BACK))
        person = _person(self.mass, self.arms)
        low, middle = _extent(person, quat)
        pos = (self.distance - middle[0], self.lateral - middle[1], -low)
        ground.attach(person, "casualty_", pos, quat)
        for geom in ground.spec.geoms:
            if geom.name.startswith("casualty_") and geom.contype:
                geom.friction[0] = self.cloth

    def _road(self, ground: Ground) -> None:
        """The spectrum of ISO 8608, scaled to the rise, level at both ends of the way."""
        shape = (round(WIDTH / CELL) + 1, round(self.way / CELL) + 1)
        heights = road(ground.rng, shape, CELL, 1.0)
        heights -= heights.min()
        along = np.arange(shape[1]) * CELL
        u = np.clip(np.minimum(along, self.way - along) / FADE, 0.0, 1.0)
        heights *= u**2 * (3 - 2 * u)
        heights *= self.rise / heights.max()
        ground.field("terrain", heights, (self.near, -WIDTH / 2), CELL, material="earth")


def _person(mass: int, arms: str) -> mujoco.MjSpec:
    """A person of models/objects whose arms begin, at qpos0, as they are wanted."""
    spec = read_object(f"casualty_{mass}kg")
    angles = {f"{side}_{name}": angle for side in "LR" for name, angle in ARMS[arms].items()}
    turned = [body for body in spec.bodies if any(one.name in angles for one in body.joints)]
    straight = spec.compile()
    for body in turned:
        body.quat = _product(straight.body(body.name).quat, _begin_at(body.joints, angles))
        body.alt.type = mujoco.mjtOrientation.mjORIENTATION_QUAT
    for geom in spec.geoms if arms == "folded" else []:
        if geom.parent.name in TRUNK:
            geom.conaffinity |= ON_TRUNK
        elif geom.parent.name.endswith(("_forearm", "_hand")):
            geom.contype |= ON_TRUNK
    return spec


def _begin_at(joints: Sequence[Any], angles: Mapping[str, float]) -> NDArray[np.float64]:
    """Lets a body's hinges begin at angles, so that the same angles mean the same places as before.

    Args:
        joints: of one body, in order.
        angles: [rad] by name, of some of them.

    Returns:
        The quaternion (4) that the body begins turned by.
    """
    turned, back = turn("z", 0.0), np.zeros(4)
    for joint in reversed(joints):
        angle, axis = angles.get(joint.name, 0.0), np.array(joint.axis)
        here, about = np.zeros(4), np.zeros(3)
        mujoco.mju_axisAngle2Quat(here, axis, angle)
        mujoco.mju_negQuat(back, turned)
        mujoco.mju_rotVecQuat(about, axis, back)  # the hinges behind it have turned it
        joint.axis, joint.ref = about, angle
        turned = _product(here, turned)
    return turned


def _extent(person: mujoco.MjSpec, quat: NDArray[np.float64]) -> tuple[float, NDArray[np.float64]]:
    """Lowest point of a turned person [m], and the centre of its mass in x and y."""
    spec = person.copy()
    spec.body("pelvis").quat = quat
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    solid = np.flatnonzero(model.geom_contype)
    low = min(data.geom_xpos[g][2] - _half_height(model, data, g) for g in map(int, solid))
    return float(low), data.subtree_com[0][:2].copy()


def _half_height(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> float:
    up, size = data.geom_xmat[geom].reshape(3, 3)[2], model.geom_size[geom]
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_CAPSULE:
        return float(size[0] + abs(up[2]) * size[1])
    assert model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_ELLIPSOID
    return float(np.linalg.norm(up * size))


def _product(a: NDArray[np.float64], b: NDArray[np.float64]) -> NDArray[np.float64]:
    result = np.zeros(4)
    mujoco.mju_mulQuat(result, a, b)
    return result
