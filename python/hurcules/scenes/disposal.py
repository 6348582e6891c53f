"""A case of ordnance to fetch, and the container to put it into."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hurcules.scenes.ground import Ground, turn
from hurcules.scenes.parameters import number
from hurcules.scenes.scene import Scene

__all__ = ["Disposal"]

BARS = 1.0  # [kg] of the case
HALF = 0.10  # [m] height of the case


@dataclass(frozen=True)
class Disposal(Scene):
    """A case with two bars to grasp, its names behind `ordnance_`, and an open container."""

    mass: float = number(20.0, 5.0, 60.0, "kg", "of the case")
    grip: float = number(0.6, 0.1, 1.5, "", "friction of the bars under the fingers")
    distance: float = number(2.75, 1.6, 20.0, "m", "from the start to the middle of the case")
    lateral: float = number(0.0, -5.0, 5.0, "m", "that to the left of the way")
    heading: float = number(0.0, -math.pi, math.pi, "rad", "turned by this; 0: across the way")
    container_distance: float = number(6.0, 2.0, 40.0, "m", "from the start to the container")
    container_lateral: float = number(0.8, -10.0, 10.0, "m", "that to the left of the way")
    container_heading: float = number(0.3, -math.pi, math.pi, "rad", "it is turned by this")

    def build(self, ground: Ground) -> None:
        """Case and container on the ground."""
        at = (self.distance, self.lateral, HALF)
        ground.attach("ordnance_case", "ordnance_", at, turn("z", self.heading))
        ground.spec.geom("ordnance_case").mass = self.mass - BARS
        for side in ("left", "right"):
            ground.spec.geom(f"ordnance_bar_{side}").friction[0] = self.grip
        there = (self.container_distance, self.container_lateral, 0.0)
        ground.attach("container", "container_", there, turn("z", self.container_heading))
