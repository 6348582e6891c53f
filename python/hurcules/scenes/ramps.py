"""Pitch and roll ramps: square cells that all rise by the same angle."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground, turn
from hurcules.scenes.parameters import choice, count, number
from hurcules.scenes.scene import Scene

__all__ = ["Ramps"]

BASE = 0.005  # [m] the low edge stands this high, so that no cell is a mere line there


@dataclass(frozen=True)
class Ramps(Scene):
    """Cells of full ramps: neighbours meet in ridges and valleys, or cross each other's way."""

    source: ClassVar[str] = "ASTM E2826 (continuous), E2827 (crossing)"
    pattern: str = choice("continuous", ("continuous", "crossing"), "how neighbours lie")
    angle: float = number(
        math.radians(15), math.radians(3), math.radians(30), "rad", "of each ramp"
    )
    cell: float = number(1.2, 0.6, 3.0, "m", "side of a cell")
    rows: int = count(6, 1, 20, "cells along the way")
    columns: int = count(2, 1, 10, "cells across")
    heading: float = number(
        0.0, -math.pi, math.pi, "rad", "field turned by this; pi/2: ridges along"
    )
    distance: float = number(
        2.0, 1.2, 20.0, "m", "from the start to the field's near edge, unturned"
    )

    @property
    def _reach(self) -> float:
        """Of the turned field along the way [m]."""
        long, broad = self.rows * self.cell, self.columns * self.cell
        return abs(long * math.cos(self.heading)) + abs(broad * math.sin(self.heading))

    @property
    def end(self) -> float:
        """The far edge of the field [m]."""
        return self.distance + self._reach

    def build(self, ground: Ground) -> None:
        """One wedge a cell, in a frame at the middle of the field."""
        long, broad = self.rows * self.cell, self.columns * self.cell
        middle = (self.distance + self._reach / 2, 0.0, 0.0)
        frame = ground.spec.worldbody.add_frame(pos=middle, quat=turn("z", self.heading))
        for i in range(self.rows):
            for j in range(self.columns):
                corner = (i * self.cell - long / 2, j * self.cell - broad / 2)
                material = "wood" if self.rises(i, j)[0] == "x" else "timber"
                name = f"ramp_{i + 1}_{j + 1}"
                ground.hull(name, self._wedge(i, j, *corner), frame=frame, material=material)

    def rises(self, i: int, j: int) -> tuple[str, int]:
        """Axis along which cell (i, j) rises, and +1 or -1."""
        if self.pattern == "continuous":
            return "x", 1 if i % 2 == 0 else -1
        sign = 1 if (i // 2 + j // 2) % 2 == 0 else -1
        return ("x", sign) if (i + j) % 2 == 0 else ("y", sign)

    def _wedge(self, i: int, j: int, x: float, y: float) -> list[tuple[float, float, float]]:
        axis, sign = self.rises(i, j)
        rise = self.cell * math.tan(self.angle)
        corners = []
        for u in (0, 1):
            for v in (0, 1):
                along = u if axis == "x" else v
                high = along if sign > 0 else 1 - along
                point = (x + u * self.cell, y + v * self.cell)
                corners += [(*point, 0.0), (*point, BASE + high * rise)]
        return corners
