"""What is missing underfoot: a gap between two platforms, a trench across level ground."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import ClassVar

from hurcules.scenes.ground import Ground, turn
from hurcules.scenes.parameters import number
from hurcules.scenes.scene import Scene

__all__ = ["Gap", "Trench"]


@dataclass(frozen=True)
class Gap(Scene):
    """Two platforms in line; the robot starts on the first one, its top at z = 0."""

    source: ClassVar[str] = "ASTM E2801 (gaps)"
    width: float = number(0.3, 0.0, 2.0, "m", "of the gap, along the way")
    lane: float = number(2.4, 1.2, 10.0, "m", "breadth of the platforms")
    height: float = number(0.6, 0.2, 3.0, "m", "of the platforms")
    length: float = number(4.0, 1.5, 20.0, "m", "of the second platform")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to the edge")

    @property
    def end(self) -> float:
        """The far edge [m]."""
        return self.distance + self.width

    def build(self, ground: Ground) -> None:
        """A floor below, two boxes on it."""
        ground.floor(-self.height)
        half, edge, far = self.lane / 2, self.distance, self.end
        for name, near, end in (("start", -2.5, edge), ("end", far, far + self.length)):
            low, high = (near, -half, -self.height), (end, half, 0.0)
            ground.box(f"platform_{name}", low, high, material="wood")


@dataclass(frozen=True)
class Trench(Scene):
    """Level ground with a trench through it."""

    width: float = number(0.3, 0.05, 3.0, "m", "of the trench, across it")
    depth: float = number(0.5, 0.05, 3.0, "m", "of the trench")
    angle: float = number(
        0.0, -math.pi / 3, math.pi / 3, "rad", "turned by this from square to the way"
    )
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to its near edge, straight ahead")

    @property
    def end(self) -> float:
        """The far edge, straight ahead [m]."""
        return self.distance + self.width / math.cos(self.angle)

    def build(self, ground: Ground) -> None:
        """The floor lies at the bottom; two plates in a turned frame are the ground."""
        ground.floor(-self.depth)
        point = (self.distance, 0.0, 0.0)
        frame = ground.spec.worldbody.add_frame(pos=point, quat=turn("z", self.angle))
        for name, near, end in (("start", -60.0, 0.0), ("end", self.width, 60.0)):
            low, high = (near, -60.0, -self.depth), (end, 60.0, 0.0)
            ground.box(f"ground_{name}", low, high, frame=frame, material="ground")
