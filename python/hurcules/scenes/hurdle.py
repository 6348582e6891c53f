"""A hurdle with round edges, as fixed or as freely turning pipes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, ClassVar

import mujoco

from hurcules._core import Error
from hurcules.scenes.ground import Ground
from hurcules.scenes.parameters import flag, number
from hurcules.scenes.scene import Scene

__all__ = ["Hurdle"]


@dataclass(frozen=True)
class Hurdle(Scene):
    """A low wall across the way with a pipe along both upper edges."""

    source: ClassVar[str] = "ASTM E2802 (variable hurdle)"
    height: float = number(0.2, 0.02, 1.0, "m", "of the hurdle")
    thickness: float = number(0.1, 0.05, 5.0, "m", "along the way, pipes included")
    edge_radius: float = number(0.03, 0.005, 0.1, "m", "of the pipes")
    rolling: bool = flag(False, "the pipes turn freely")
    lane: float = number(2.4, 1.2, 10.0, "m", "breadth")
    distance: float = number(2.0, 1.2, 20.0, "m", "from the start to its near side")

    def __post_init__(self) -> None:
        """Checks that the pipes have room."""
        super().__post_init__()
        room = min(self.height, self.thickness / 2)
        if self.edge_radius > room:
            raise Error(
                "hurdle: edge_radius wants at most the height and half the thickness, here "
                f"{room:g} m, got {self.edge_radius:g} m"
            )

    @property
    def end(self) -> float:
        """The far side [m]."""
        return self.distance + self.thickness

    def build(self, ground: Ground) -> None:
        """Two walls that differ by the pipes' radius, and the pipes."""
        r, half, near = self.edge_radius, self.lane / 2, self.distance
        far, top = self.end, self.height - r
        ground.box("hurdle_wall", (near, -half, 0.0), (far, half, top), material="timber")
        middle = near + r, far - r
        if middle[1] > middle[0] + 1e-3 and self.height > top:
            low, high = (middle[0], -half, 0.0), (middle[1], half, self.height)
            ground.box("hurdle_top", low, high, material="timber")
        for name, x in zip(("near", "far"), middle, strict=True):
            self._add_pipe(ground, name, (x, 0.0, top))

    def _add_pipe(self, ground: Ground, name: str, at: Any) -> None:
        body = None
        if self.rolling:
            body = ground.spec.worldbody.add_body(name=f"hurdle_pipe_{name}", pos=at)
            joint = f"hurdle_pipe_{name}"
            hinge = mujoco.mjtJoint.mjJNT_HINGE
            body.add_joint(name=joint, type=hinge, axis=[0, 1, 0], damping=0.02, armature=0.01)
            body.mass, body.ipos, body.inertia = 2.0, [0, 0, 0], [0.1, 0.01, 0.1]
            body.explicitinertial = True
            at = (0.0, 0.0, 0.0)
        ends = [(at[0], side * self.lane / 2, at[2]) for side in (-1, 1)]
        ground.cylinder(f"hurdle_pipe_{name}", self.edge_radius, ends, frame=body, material="steel")
