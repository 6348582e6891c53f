"""The transfer bed of the rescue robot: taking it off, and how far it is out.

The bed can be attached or detached, depending on the mission; without it the battery alone limits
hip and knee (`hurcules.mode_ranges`).
"""

from __future__ import annotations

import mujoco

from hurcules._core import Error
from hurcules.postures.moves import Move

__all__ = ["LIFT", "SLIDE", "detach", "expand", "fold"]

LIFT = 0.38  # [m] to where the arms, level, lay somebody down
SLIDE = 0.31  # [m] of each plate
_BATTERY_STOP = 1.40  # [rad] of the hip, where the torso meets the battery


def detach(spec: mujoco.MjSpec) -> None:
    """Takes the bed off a robot that is not yet compiled; its keyframes stay those of the rest.

    Raises:
        Error: there is no bed.
    """
    body = spec.body("transfer_bed")
    if body is None:
        raise Error("a robot with a transfer bed is wanted: 'rescue', with its bed on")
    for kind in (spec.actuators, spec.equalities, spec.tendons, spec.numerics, spec.sites):
        for element in list(kind):
            if _is_of_bed(element.name) and element.name != "bed":
                spec.delete(element)
    spec.delete(body)
    spec.joint("HIP").range = [spec.joint("HIP").range[0], _BATTERY_STOP]


def _is_of_bed(name: str) -> bool:
    return "bed" in name.split("_")


def expand(seconds: float = 8.0) -> list[Move]:
    """Raises the stowed bed, then slides its plates out."""
    plates = {"L_bed_1": SLIDE, "R_bed_1": SLIDE}
    return [
        Move("raise the bed", seconds, ((1.0, {"bed_lift": LIFT}),)),
        Move("slide the bed out", seconds / 2, ((1.0, plates),)),
    ]


def fold(seconds: float = 8.0) -> list[Move]:
    """Slides the plates in and lowers the bed."""
    plates = {"L_bed_1": 0.0, "R_bed_1": 0.0}
    return [
        Move("slide the bed in", seconds / 2, ((1.0, plates),)),
        Move("lower the bed", seconds, ((1.0, {"bed_lift": 0.0}),)),
    ]
