"""Ground of Drive: what a seed draws, how high it is, and what of it a robot sees."""

from __future__ import annotations

import math
from typing import Any

import mujoco
import numpy as np

from hurcules_envs.environment import Array

__all__ = ["AHEAD", "BESIDE", "TERRAINS", "Heights", "scene_of"]

# of scenes, by terrain: what stays
TERRAINS: dict[str, dict[str, Any]] = {
    "flat": {}, "ramps": {}, "slope": {}, "stairs": {"landing": 4.0},
    "rough_road": {}, "step_field": {}, "gravel": {}, "sand": {},
}  # fmt: skip
# and what a seed draws beside the ground itself, evenly between these; seed 0: as the scene says
RANGES: dict[str, dict[str, tuple[float, float]]] = {
    "ramps": {"angle": (math.radians(5), math.radians(15))},
    "slope": {"angle": (math.radians(10), math.radians(30))},
    "stairs": {"pitch": (math.radians(25), math.radians(35)), "riser": (0.15, 0.2)},
}

AHEAD = np.linspace(-1.2, 1.2, 25)  # [m] of a point of the grid before the robot
BESIDE = np.linspace(0.4, -0.4, 9)  # [m] to its left
CELL = 0.025  # [m] of the map
LOW, HIGH = np.array([-4.0, -3.0]), np.array([9.0, 3.0])  # [m] of its corners
ABOVE = 10.0  # [m] from where it is measured


def scene_of(terrain: str, seed: int) -> dict[str, Any]:
    """Parameters of a terrain's scene.

    Args:
        terrain: one of `TERRAINS`.
        seed: a whole number >= 0.
    """
    ranges = RANGES.get(terrain, {}) if seed else {}
    generator = np.random.default_rng(seed)
    drawn = {name: float(generator.uniform(*between)) for name, between in ranges.items()}
    return TERRAINS[terrain] | drawn


class Heights:
    """A map of a scene's ground, measured once by rays from above."""

    def __init__(self, scene: mujoco.MjSpec) -> None:
        """Measures it.

        Args:
            scene: without a robot.
        """
        model = scene.compile()
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        count = np.rint((HIGH - LOW) / CELL).astype(int)
        middles = [low + CELL * (np.arange(n) + 0.5) for low, n in zip(LOW, count, strict=True)]
        down = np.array([0.0, 0.0, -1.0])

        def height(x: float, y: float) -> float:
            start = np.array([x, y, ABOVE])
            return ABOVE - mujoco.mj_ray(model, data, start, down, None, True, -1, None)

        self._map = np.array([[height(x, y) for y in middles[1]] for x in middles[0]])

    def at(self, points: Array) -> Array:
        """Heights [m] of the ground at points (..., 2) [m]; NaN outside of the map."""
        cells = np.floor((points - LOW) / CELL).astype(int)
        inside = ((cells >= 0) & (cells < self._map.shape)).all(axis=-1)
        cells = np.where(inside[..., None], cells, 0)
        return np.where(inside, self._map[cells[..., 0], cells[..., 1]], np.nan)

    def around(self, place: Array, sole: Array) -> Array:
        """Heights [m] on the grid about robots, (n, 25 * 9): ahead runs slower, beside faster.

        Args:
            place: (n, 4) x, y [m], cosine and sine of the heading.
            sole: (n, 1) height [m] that they are counted from; outside of the map they are 0.
        """
        forward = place[:, None, None, 2:]
        left = np.stack([-forward[..., 1], forward[..., 0]], axis=-1)
        points = place[:, None, None, :2] + AHEAD[:, None, None] * forward
        heights = self.at(points + BESIDE[:, None] * left).reshape(len(place), -1) - sole
        return np.where(np.isnan(heights), 0.0, heights)
