"""Level ground, bare or with two pylons to drive round."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import number
from hurcules.scenes.scene import Scene

__all__ = ["Flat", "Pylons"]


@dataclass(frozen=True)
class Flat(Scene):
    """A plane."""

    rolling_resistance: float = number(0.0, 0.0, 0.3, "", "resistance of the belts over weight")

    def build(self, ground: Ground) -> None:
        """Leaves the floor as it is."""
        ground.resist(self.rolling_resistance)


@dataclass(frozen=True)
class Pylons(Scene):
    """A paved course round two pylons; they stand beside the start and `spacing` ahead of it."""

    source: ClassVar[str] = "ASTM E2829 (sustained speed)"
    spacing: float = number(50.0, 5.0, 200.0, "m", "between the pylons")
    side: float = number(2.0, 1.2, 10.0, "m", "pylons stand to the left of the start by this")

    def build(self, ground: Ground) -> None:
        """Two cones' worth of obstacles, 0.9 m high."""
        for index, x in enumerate((0.0, self.spacing), start=1):
            foot, top = (x, self.side, 0.0), (x, self.side, 0.9)
            ground.cylinder(f"pylon_{index}", 0.15, (foot, top), material="sign")
