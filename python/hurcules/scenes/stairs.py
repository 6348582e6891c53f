"""Steps: low ones up and down again, and flights of stairs between two landings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import count, flag, number
from hurcules.scenes.scene import Scene

__all__ = ["Stairs", "Steps"]

TREAD = 0.03  # [m] thickness of the slab where risers are open


@dataclass(frozen=True)
class Steps(Scene):
    """Steps up along the way, a platform, and as many down."""

    height: float = number(0.15, 0.01, 0.6, "m", "of one step")
    run: float = number(1.2, 0.1, 5.0, "m", "from step to step")
    count: int = count(1, 1, 10, "steps on each side")
    platform: float = number(2.4, 0.5, 10.0, "m", "length on top")
    width: float = number(2.4, 1.2, 10.0, "m", "breadth")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to the first step")

    @property
    def end(self) -> float:
        """The foot of the last step [m]."""
        return self.distance + 2 * (self.count - 1) * self.run + self.platform

    def build(self, ground: Ground) -> None:
        """Slabs on each other, each shorter by a run at both ends."""
        half = self.width / 2
        end = self.distance + 2 * (self.count - 1) * self.run + self.platform
        for i in range(self.count):
            cut = i * self.run
            low = (self.distance + cut, -half, i * self.height)
            high = (end - cut, half, (i + 1) * self.height)
            ground.box(
                f"step_{i + 1}", low, high, material="dark_concrete" if i % 2 else "concrete"
            )


@dataclass(frozen=True)
class Stairs(Scene):
    """A flight of stairs up along the way, with a landing on top."""

    source: ClassVar[str] = "ASTM E2804 (stairs and landings)"
    riser: float = number(0.2, 0.05, 0.3, "m", "height of one step")
    pitch: float = number(
        math.radians(35), math.radians(15), math.radians(50), "rad", "of the flight"
    )
    count: int = count(5, 1, 30, "risers")
    width: float = number(2.4, 1.2, 10.0, "m", "breadth")
    landing: float = number(2.4, 0.5, 10.0, "m", "length of the upper landing")
    open_risers: bool = flag(False, "slabs with nothing between them")
    walls: bool = flag(False, "on both sides")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to the first riser")

    @property
    def run(self) -> float:
        """Depth of one step [m]."""
        return self.riser / math.tan(self.pitch)

    @property
    def end(self) -> float:
        """The edge of the landing [m]."""
        return self.distance + (self.count - 1) * self.run

    def build(self, ground: Ground) -> None:
        """One box a step; the last one is the landing."""
        half, x = self.width / 2, self.distance
        for i in range(1, self.count + 1):
            last = i == self.count
            end = x + (self.landing if last else self.run)
            top = i * self.riser
            overlap = 0.02 if self.open_risers and not last else 0.0
            bottom = top - TREAD if self.open_risers and not last else 0.0
            material = "concrete" if i % 2 else "dark_concrete"
            ground.box(
                f"stair_{i}", (x, -half, bottom), (end + overlap, half, top), material=material
            )
            x = end
        if self.walls:
            for name, y in (("left", half), ("right", -half - 0.1)):
                high = (x, y + 0.1, self.count * self.riser + 1.2)
                ground.box(f"wall_{name}", (self.distance, y, 0.0), high, material="wood")
