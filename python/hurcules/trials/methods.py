"""The test methods: which scene, which parameter grows, how the robot goes."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

from hurcules._core import Error

__all__ = ["METHODS", "Method", "method"]


@dataclass(frozen=True)
class Method:
    """One of the ASTM methods as a series of scenes that get harder."""

    title: str
    scene: str
    parameter: str = ""  # that grows; "" for terrain with one setting
    settings: tuple[float, ...] = ()  # SI units, angles in radians; easy ones first
    fixed: dict[str, Any] = field(default_factory=dict)  # other parameters of the scene
    hold: float = 0.0  # [s] to stand still at the far end
    lean: float = 0.0  # [rad] of the trunk, forward: the operator's choice of posture

    def values(self, setting: float | None) -> dict[str, Any]:
        """Parameters of the scene at one setting."""
        return self.fixed | ({self.parameter: setting} if self.parameter else {})


def _steps(first: float, last: float, step: float) -> tuple[float, ...]:
    return tuple(round(first + i * step, 6) for i in range(round((last - first) / step) + 1))


def _degrees(*angles: float) -> tuple[float, ...]:
    return tuple(math.radians(angle) for angle in angles)


# numbers: response-robot-tests.md section C1; landings are as long as the whole robot needs
METHODS: dict[str, Method] = {
    "e2801": Method("gaps", "gap", "width", _steps(0.10, 1.00, 0.10)),
    "e2802": Method("hurdles", "hurdle", "height", _steps(0.05, 0.50, 0.05)),
    # leaning forward by 0.4 rad keeps the robot from tipping backwards on its way down in reverse
    "e2803": Method(
        title="inclined planes",
        scene="incline",
        parameter="angle",
        settings=_degrees(*range(10, 46, 5)),
        fixed={"landing": 4.0},
        hold=5.0,
        lean=0.4,
    ),
    "e2804": Method("stairs", "stairs", "pitch", _degrees(30, 35, 40, 45), {"landing": 4.0}),
    "e2826": Method("continuous pitch/roll ramps", "ramps"),
    "e2827": Method("crossing pitch/roll ramps", "ramps", fixed={"pattern": "crossing"}),
    "e2828": Method("symmetric stepfields", "step_field"),
    "e2991": Method("gravel", "gravel"),
    "e2992": Method("sand", "sand"),
    "iso8608": Method("rough road of class F", "rough_road", fixed={"roughness": "F"}),
}


def method(name: str) -> Method:
    """Returns a method by its name.

    Raises:
        Error: no such method; the text lists those that exist.
    """
    if name not in METHODS:
        raise Error(f"method '{name}' does not exist; there are: {', '.join(METHODS)}")
    return METHODS[name]
