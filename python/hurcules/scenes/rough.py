"""Rough ground: roads by ISO 8608, and beds of gravel and sand."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error
from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import choice, number
from hurcules.scenes.scene import Scene
from hurcules.scenes.surfaces import PAD, bumps, fade_to_pad, road

__all__ = ["Gravel", "RoughRoad", "Sand"]

CLASSES = ("A", "B", "C", "D", "E", "F", "G", "H")
MAX_HEIGHTS = 1_000_000  # of one field: 4 MB


@dataclass(frozen=True)
class _Bed(Scene):
    """Ground that is a height field, with a level pad where the robot starts."""

    length: float = number(20.0, 4.0, 400.0, "m", "of the bed, beginning 3 m behind the start")
    width: float = number(6.0, 3.0, 100.0, "m", "of the bed")
    cell: float = number(0.1, 0.02, 0.5, "m", "between heights")

    def __post_init__(self) -> None:
        """Checks that the field is not too large."""
        super().__post_init__()
        rows, columns = self._shape()
        if rows * columns > MAX_HEIGHTS:
            wanted = f"{self.kind()}: length x width / cell^2 wants at most {MAX_HEIGHTS} heights"
            raise Error(f"{wanted}, got {rows * columns}")

    @property
    def end(self) -> float:
        """Where the robot can stop and still be on the bed [m]."""
        return self.length - 6.0

    def _shape(self) -> tuple[int, int]:
        return round(self.width / self.cell) + 1, round(self.length / self.cell) + 1

    def _add(self, ground: Ground, heights: NDArray[np.float64], material: str) -> None:
        corner = (-3.0, -self.width / 2)
        heights = fade_to_pad(heights, corner, self.cell)
        ground.field("bed", heights, corner, self.cell, material=material)
        left, right, low, high = PAD
        ground.box("pad", (left, low, -0.2), (right, high, 0.0))
        ground.floor(float(heights.min()) - 0.02)


@dataclass(frozen=True)
class RoughRoad(_Bed):
    """A surface with the roughness of a class of roads along every straight line."""

    source: ClassVar[str] = "ISO 8608"
    roughness: str = choice("D", CLASSES, "class of the road")

    def build(self, ground: Ground) -> None:
        """Class A has 16e-6 m3 at 0.1 cycles a metre, each further class four times as much."""
        density = 16e-6 * 4.0 ** CLASSES.index(self.roughness)
        self._add(ground, road(ground.rng, self._shape(), self.cell, density), "earth")


@dataclass(frozen=True)
class Gravel(_Bed):
    """Loose stones as fixed bumps with less grip and some rolling resistance."""

    source: ClassVar[str] = "ASTM E2991 (gravel)"
    friction: float = number(0.5, 0.05, 1.5, "", "sliding friction of the ground")
    rolling_resistance: float = number(0.05, 0.0, 0.3, "", "resistance of the belts over weight")
    deviation: float = number(0.02, 0.002, 0.05, "m", "standard deviation of the heights")
    grain: float = number(0.15, 0.05, 1.0, "m", "breadth of the bumps")

    def build(self, ground: Ground) -> None:
        """Bumps of one breadth."""
        heights = bumps(ground.rng, self._shape(), self.grain / self.cell)
        self._add(ground, self.deviation * heights, "gravel")
        ground.resist(self.rolling_resistance)


@dataclass(frozen=True)
class Sand(_Bed):
    """Dry sand: little grip, much rolling resistance, low soft waves."""

    source: ClassVar[str] = "ASTM E2992 (sand)"
    friction: float = number(0.3, 0.05, 1.5, "", "sliding friction of the ground")
    rolling_resistance: float = number(0.15, 0.0, 0.3, "", "resistance of the belts over weight")
    deviation: float = number(0.01, 0.002, 0.05, "m", "standard deviation of the heights")
    grain: float = number(0.6, 0.05, 2.0, "m", "breadth of the waves")

    def build(self, ground: Ground) -> None:
        """Waves of one breadth."""
        heights = bumps(ground.rng, self._shape(), self.grain / self.cell)
        self._add(ground, self.deviation * heights, "sand")
        ground.resist(self.rolling_resistance)
