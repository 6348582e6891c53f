"""Loads for both arms: a beam to lift, and a springy pad to press on."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import mujoco

from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import number
from hurcules.scenes.scene import Scene

__all__ = ["ForcePad", "Lift"]

BEAM = (0.125, 0.80, 0.10)  # [m] half sizes
PLATE = (0.40, 0.70, 0.015)
PLATE_MASS = 20.0  # [kg]


@dataclass(frozen=True)
class Lift(Scene):
    """A beam across the way on two blocks; lower arms go under it between them."""

    mass: float = number(120.0, 1.0, 300.0, "kg", "of the beam")
    clearance: float = number(0.25, 0.1, 1.0, "m", "between ground and beam")
    distance: float = number(1.5, 1.35, 10.0, "m", "from the start to the middle of the beam")

    def build(self, ground: Ground) -> None:
        """Blocks at the ends, the beam on them."""
        for name, y in (("left", 0.7), ("right", -0.7)):
            low = (self.distance - 0.15, y - 0.1, 0.0)
            high = (self.distance + 0.15, y + 0.1, self.clearance)
            ground.box(f"block_{name}", low, high, material="timber")
        at = (self.distance, 0.0, self.clearance + BEAM[2])
        beam = ground.spec.worldbody.add_body(name="beam", pos=at)
        beam.add_freejoint(name="beam")
        _add_object(ground, beam, "beam", BEAM, self.mass, "dark_concrete")


@dataclass(frozen=True)
class ForcePad(Scene):
    """A plate on springs that gives way downwards; the sensor `pad_force` weighs what is on it."""

    stiffness: float = number(1e4, 1e3, 1e5, "N/m", "of the springs")
    damping_ratio: float = number(0.3, 0.05, 2.0, "", "of the plate on its springs")
    height: float = number(0.06, 0.05, 0.6, "m", "of the plate's top when nothing is on it")
    distance: float = number(1.1, 1.05, 10.0, "m", "from the start to its near edge")

    def build(self, ground: Ground) -> None:
        """The springs' rest height makes up for the weight of the plate."""
        at = (self.distance + PLATE[0], 0.0, self.height - PLATE[2])
        plate = ground.spec.worldbody.add_body(name="pad", pos=at)
        slide = mujoco.mjtJoint.mjJNT_SLIDE
        joint = plate.add_joint(name="pad", type=slide, axis=[0, 0, 1])
        joint.range, joint.limited = [-(self.height - 2 * PLATE[2] - 0.005), 0.05], 1
        joint.stiffness[0] = self.stiffness
        joint.springref = PLATE_MASS * 9.81 / self.stiffness
        joint.damping[0] = 2 * self.damping_ratio * math.sqrt(self.stiffness * PLATE_MASS)
        _add_object(ground, plate, "pad", PLATE, PLATE_MASS, "sign")
        box = mujoco.mjtGeom.mjGEOM_BOX
        plate.add_site(name="pad", type=box, size=[2 * half for half in PLATE], group=4)
        touch, site = mujoco.mjtSensor.mjSENS_TOUCH, mujoco.mjtObj.mjOBJ_SITE
        ground.spec.add_sensor(name="pad_force", type=touch, objtype=site, objname="pad")


def _add_object(ground: Ground, body: Any, name: str, half: Any, mass: float, look: str) -> None:
    """A box that the robot may touch; its own friction 0.6."""
    thing, box = ground.spec.find_default("object"), mujoco.mjtGeom.mjGEOM_BOX
    body.add_geom(thing, name=name, type=box, size=list(half), mass=mass, material=look)
