"""Step fields: pallets of square posts that are cut to whole units."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import choice, count, number
from hurcules.scenes.scene import Scene

__all__ = ["StepField"]

POSTS = 12  # along each side of a pallet


@dataclass(frozen=True)
class StepField(Scene):
    """Pallets in a straight line, each the same when turned by half a turn.

    Flat: posts of one unit, every sixth one lower or higher. Hill: a ridge across the way.
    Diagonal: a ridge from corner to corner. Dash: flat, hill, diagonal, hill, flat.
    """

    source: ClassVar[str] = "ASTM E2828 (symmetric stepfields)"
    pattern: str = choice("dash", ("flat", "hill", "diagonal", "dash"), "of the pallets")
    unit: float = number(0.1, 0.02, 0.2, "m", "side of a post, and step of its height")
    peak: int = count(4, 1, 6, "height of a ridge in units")
    pallets: int = count(5, 1, 20, "in line")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to the first post")

    @property
    def end(self) -> float:
        """The far edge of the last pallet [m]."""
        return self.distance + self.pallets * POSTS * self.unit

    def build(self, ground: Ground) -> None:
        """Posts of one height in a row of a pallet are one box."""
        side = POSTS * self.unit
        for pallet in range(self.pallets):
            heights = self.heights(self._pattern_of(pallet), ground.rng)
            for i, row in enumerate(heights):
                x = self.distance + pallet * side + i * self.unit
                for j, end, level in _runs(row):
                    low = (x, j * self.unit - side / 2, 0.0)
                    high = (x + self.unit, end * self.unit - side / 2, level * self.unit)
                    name, look = f"post_{pallet + 1}_{i + 1}_{j + 1}", ("wood", "timber")[level % 2]
                    ground.box(name, low, high, material=look)

    def heights(self, pattern: str, rng: np.random.Generator) -> NDArray[np.int64]:
        """Heights of a pallet (12, 12) in units, first axis along the way."""
        i, j = np.mgrid[:POSTS, :POSTS]
        crest = {"flat": 0 * i, "hill": np.minimum(i, POSTS - 1 - i)}
        crest["diagonal"] = np.minimum(i + j, 2 * (POSTS - 1) - i - j) // 2
        base = 1 + crest[pattern] * (self.peak - 1) // (POSTS // 2 - 1)
        change = rng.choice([-1, 1] + 10 * [0], size=(POSTS, POSTS))
        change[POSTS // 2 :] = change[: POSTS // 2][::-1, ::-1]
        return np.clip(base + change, 0, self.peak if pattern != "flat" else max(2, self.peak // 2))

    def _pattern_of(self, pallet: int) -> str:
        dash = ("flat", "hill", "diagonal", "hill")
        return dash[pallet % len(dash)] if self.pattern == "dash" else self.pattern


def _runs(row: NDArray[np.int64]) -> list[tuple[int, int, int]]:
    """First index, end and level of each run of equal levels above the ground."""
    edges = [0, *(np.flatnonzero(np.diff(row)) + 1), len(row)]
    return [(int(a), int(b), int(row[a])) for a, b in pairwise(edges) if row[a]]
