"""The transfer bed of the rescue robot: taking it off, rims for it, and how far it is out.

The bed can be attached or detached, depending on the mission; without it the battery alone limits
hip and knee (`hurcules.mode_ranges`). Across terrain it wants rims.
"""

from __future__ import annotations

import mujoco

from hurcules import mjcf
from hurcules._core import Error
from hurcules.postures.moves import Move

__all__ = ["LIFT", "SLIDE", "add_rims", "detach", "expand", "fold"]

LIFT = 0.38  # [m] to where the arms, level, lay somebody down
SLIDE = 0.31  # [m] of each plate
_RIMS = {"L": 0.115, "R": -0.115}  # [m] to the left of the bed's middle
_RIM_SPEED, _RIM_POWER = 0.05, 6.0  # [m/s], [W] peaks of each
_RIM_SERVO = [2.5, 20.0]  # [kg] of a pump, [rad/s]
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


def add_rims(spec: mujoco.MjSpec) -> None:
    """Bags of air beside the bed's front and back edge, for a robot that is not yet compiled.

    Joints `L_bed_rim_front` ... `R_bed_rim_back`, 0 to 0.12 m up, with a motor each (the pump).

    Raises:
        Error: there is no bed, or it has rims.
    """
    bed = spec.body("transfer_bed")
    if bed is None or spec.joint("L_bed_rim_front") is not None:
        raise Error("a robot with a transfer bed without rims is wanted: 'rescue', with its bed on")
    for side, y in _RIMS.items():
        rims = mujoco.MjSpec.from_file(str(mjcf.folder() / "modules" / "transfer_bed_rims.xml"))
        joints = [f"{side}_{joint.name}" for joint in rims.joints]
        spec.attach(rims, prefix=f"{side}_", frame=bed.add_frame(pos=[0.0, y, 0.0]))
        for joint in joints:
            spec.add_numeric(name=f"velocity_limit_{joint}", data=[_RIM_SPEED], size=1)
            spec.add_numeric(name=f"power_limit_{joint}", data=[_RIM_POWER], size=1)
            spec.add_numeric(name=f"servo_{joint}", data=_RIM_SERVO, size=2)


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
