"""Inclined planes: one without an end to stand on, and the ramp of the test method."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground, turn
from hurcules.scenes.parameters import choice, number
from hurcules.scenes.scene import Scene

__all__ = ["Incline", "Slope"]

MAX_ANGLE = math.radians(45)


@dataclass(frozen=True)
class Slope(Scene):
    """A tilted plane through the origin; the robot stands on it, looking up, down or across."""

    angle: float = number(math.radians(30), 0.0, MAX_ANGLE, "rad", "from the horizontal")
    direction: str = choice(
        "up", ("up", "down", "across"), "where the robot looks; across: hill left"
    )

    def build(self, ground: Ground) -> None:
        """Tilts the floor, and the robot with it."""
        axis, sign = {"up": ("y", -1), "down": ("y", 1), "across": ("x", 1)}[self.direction]
        tilt = turn(axis, sign * self.angle)
        ground.floor(quat=tilt, size=15.0)
        ground.start(quat=tilt)


@dataclass(frozen=True)
class Incline(Scene):
    """Level ground, a ramp upwards along +x, a landing on top."""

    source: ClassVar[str] = "ASTM E2803 (inclined planes)"
    angle: float = number(math.radians(30), math.radians(5), MAX_ANGLE, "rad", "of the ramp")
    length: float = number(4.0, 1.0, 50.0, "m", "of the ramp, along it")
    width: float = number(2.4, 1.2, 20.0, "m", "of ramp and landing")
    landing: float = number(2.4, 0.0, 10.0, "m", "length of the landing")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to the foot")

    @property
    def end(self) -> float:
        """The top of the ramp [m]."""
        return self.distance + self.length * math.cos(self.angle)

    def build(self, ground: Ground) -> None:
        """A solid wedge and a box behind it."""
        run, rise = self.length * math.cos(self.angle), self.length * math.sin(self.angle)
        half, foot, top = self.width / 2, self.distance, self.distance + run
        corners = [(x, y, z) for y in (-half, half) for x, z in ((foot, 0), (top, 0), (top, rise))]
        ground.hull("ramp", corners, material="wood")
        if self.landing > 0.0:
            end = top + self.landing
            ground.box("landing", (top, -half, 0), (end, half, rise), material="wood")
