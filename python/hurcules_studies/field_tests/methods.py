"""The test methods: which scene, which parameter grows, how the robot goes."""

from __future__ import annotations

import enum
import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from hurcules.validation import require_known
from hurcules_studies.field_tests.climbing import STRETCHED, OverField, OverHurdle, OverStairs
from hurcules_studies.field_tests.grasp import PULLING
from hurcules_studies.field_tests.postures import FLAT, Plan, Posture, always

__all__ = ["METHODS", "Method", "Way", "method"]


class Way(enum.Enum):
    """What a repetition is."""

    ThereAndBack = "over the obstacle, and back"
    There = "one way"
    Laps = "a lap round both pylons"


def flat(scene: Any) -> Plan:
    """Drive pose all the way."""
    return always(FLAT)


def lean(scene: Any) -> Plan:
    """Leaning forward keeps the robot from tipping backwards on its way up, and down in reverse."""
    return always(Posture(hip=0.4))


def stretched(scene: Any) -> Plan:
    """One long track, the centre of mass low and near its middle."""
    return always(STRETCHED)


def pulling(scene: Any) -> Plan:
    """The hands low, the lower legs in front of them."""
    return always(PULLING)


@dataclass(frozen=True)
class Method:
    """One of the ASTM methods as a series of scenes that get harder."""

    title: str
    scene: str
    parameter: str = ""  # that grows; "" for terrain with one setting
    settings: tuple[float, ...] = ()  # SI units, angles in radians; easy ones first
    fixed: dict[str, Any] = field(default_factory=dict)  # other parameters of the scene
    hold: float = 0.0  # [s] to stand still at the far end
    plan: Callable[[Any], Plan] = flat  # of postures for a scene: the operator's choice
    climbs: bool = False  # tail first, the lower legs turned over to the front
    lifts: bool = False  # its leading legs where it gets stuck, then backs off
    grasps: bool = False  # the sled's handle with both hands, and goes backward
    turns_round: bool = False  # before the way back
    way: Way = Way.ThereAndBack
    speed: float = 0.6  # [m/s]
    distance: float = 0.0  # [m] of a way without end

    def values(self, setting: float | None) -> dict[str, Any]:
        """Parameters of the scene at one setting."""
        # a speed is the driver's, not the scene's
        of_scene = self.parameter and self.way is not Way.Laps
        return self.fixed | ({self.parameter: setting} if of_scene else {})

    @property
    def is_angle(self) -> bool:
        """Whether the settings are angles."""
        return self.parameter in ("angle", "pitch")


def _steps(first: float, last: float, step: float) -> tuple[float, ...]:
    return tuple(round(first + i * step, 6) for i in range(round((last - first) / step) + 1))


def _degrees(*angles: float) -> tuple[float, ...]:
    return tuple(math.radians(angle) for angle in angles)


# numbers: docs/design/test-methods.md#ground-robot-methods; landings are as long as the whole robot
# needs
METHODS: dict[str, Method] = {
    "e2801": Method("gaps", "gap", "width", _steps(0.10, 1.00, 0.10), plan=stretched, climbs=True),
    "e2802": Method(
        title="hurdles",
        scene="hurdle",
        parameter="height",
        settings=_steps(0.05, 0.50, 0.05),
        plan=OverHurdle,
        climbs=True,
        turns_round=True,
        speed=0.4,
    ),
    "e2803": Method(
        title="inclined planes",
        scene="incline",
        parameter="angle",
        settings=_degrees(*range(10, 46, 5)),
        fixed={"landing": 4.0},
        hold=5.0,
        plan=lean,
    ),
    "e2804": Method(
        title="stairs",
        scene="stairs",
        parameter="pitch",
        settings=_degrees(30, 35, 40, 45),
        fixed={"landing": 4.0},
        plan=OverStairs,
        climbs=True,
        speed=0.4,
    ),
    "e2826": Method(
        title="continuous pitch/roll ramps",
        scene="ramps",
        parameter="angle",
        settings=_degrees(5, 10, 15, 20, 25),
        plan=stretched,
        climbs=True,
    ),
    "e2827": Method(
        "crossing pitch/roll ramps",
        "ramps",
        "angle",
        _degrees(5, 10, 15, 20, 25),
        {"pattern": "crossing"},
        plan=OverField,
        climbs=True,
        lifts=True,
        turns_round=True,
    ),
    "e2828": Method(
        title="symmetric stepfields",
        scene="step_field",
        parameter="unit",
        settings=(0.02, 0.04, 0.06, 0.08, 0.10),
        plan=OverField,
        climbs=True,
        lifts=True,
        turns_round=True,
    ),
    "e2829": Method(
        "sustained speed", "pylons", "speed", (1.0, 2.0, 3.0, 4.0, 5.0, 5.56), way=Way.Laps
    ),
    "e2830": Method(
        title="towing, grasped sleds",
        scene="sled",
        parameter="mass",
        settings=(75.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0),
        plan=pulling,
        grasps=True,
        way=Way.There,
        distance=10.0,
    ),
    "e2831": Method(
        title="towing, hitched sleds",
        scene="sled",
        parameter="mass",
        settings=(75.0, 100.0, 120.0, 200.0, 400.0, 600.0, 800.0, 900.0, 1000.0, 1200.0),
        fixed={"hitched": True},
        way=Way.There,
        distance=10.0,
    ),
    "e2991": Method("gravel", "gravel"),
    "e2992": Method("sand", "sand"),
    "iso8608": Method("rough road of class F", "rough_road", fixed={"roughness": "F"}),
}


def method(name: str) -> Method:
    """Returns a method by its name.

    Raises:
        Error: no such method; the text lists those that exist.
    """
    require_known("method", name, METHODS)
    return METHODS[name]
