"""What the figures of a mission are called, and how a number is shown."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["FIGURES", "Figure", "describe", "readable", "tells", "wanted"]


@dataclass(frozen=True)
class Figure:
    """A number that a mission ends with."""

    label: str
    where: str = ""  # in the thesis, for those that it gives


_LIMITS = "§4.4, Fig. 4.26"

# by the name in `Simulation.figures`; times count from the start of the stretch
FIGURES = {
    "hip_locked_s": Figure("hip meets its limit and stops", _LIMITS),
    "hip_released_s": Figure("hip is released and moves again", _LIMITS),
    "shoulder_locked_s": Figure("shoulder pitch meets its limit", _LIMITS),
    "pelvis_error_m": Figure("pelvis gives way by, commanded", "§4.4"),
    "pelvis_error_measured_m": Figure("pelvis gives way by, measured"),
    "pelvis_error_at_hip_locked_m": Figure("pelvis error when the hip stops"),
    "pelvis_error_at_shoulder_locked_m": Figure("pelvis error when the shoulders stop"),
    "hand_error_max_m": Figure("largest hand position error, commanded"),
    "hand_error_measured_max_m": Figure("largest hand position error, measured"),
    "hand_error_final_m": Figure("hand position error at the end, measured"),
    "pitch_error_max_rad": Figure("largest hand pitch error, commanded"),
    "pitch_error_measured_max_rad": Figure("largest hand pitch error, measured"),
    "pitch_error_final_rad": Figure("hand pitch error at the end, measured"),
    "gaze_error_max_rad": Figure("largest gaze error, commanded"),
    "gaze_error_measured_max_rad": Figure("largest gaze error, measured"),
    "joint_error_max_rad": Figure("largest joint control error", "Figs. A.3-A.4"),
    "joint_error_max_s": Figure("time of the largest joint control error"),
    "stretched_m": Figure("hands went forward by"),
    "torque_excess_max_nm": Figure("torque asked for above a motor's limit"),
    "energy_J": Figure("energy from the battery, standby included"),
    "battery_share": Figure("share of the battery that was used"),
    "yielded_s": Figure("more was asked than the motors hold: the reference yielded for"),
    # of the lift
    "held_height_m": Figure("held above where the person lay by, least"),
    "held_on_ground_share": Figure("share of the weight on the ground while held, largest"),
    "held_drift_m": Figure("slid along the arms while held by"),
    "laid_down_share": Figure("share of the weight on the ground in the end"),
    "pushed_m": Figure("pushed along the ground by"),
    "push_N": Figure("largest push of both arms along the ground"),
    "contact_share": Figure("largest contact force, share of its region's limit"),
    "support_N": Figure("largest force that carries a region of the body"),
    "neck_extension_rad": Figure("head bent forward by, least (below 0 it hangs back)"),
    "head_mps2": Figure("largest acceleration of the head, gravity included"),
    # of the casualty mission
    "on_bed_share": Figure("share of the weight on the bed in the end"),
    "left_arm_share": Figure("share of the weight on the left arm in the end"),
    "right_arm_share": Figure("share of the weight on the right arm in the end"),
    "way_home_m": Figure("came back by, seen along the way it came"),
    "home_x_m": Figure("in the end this far ahead of where it began"),
    "slid_ahead_m": Figure("slid along the robot on the way home by"),
    "slid_aside_m": Figure("slid across the robot on the way home by"),
    "carried_on_ground_share": Figure("share of the weight on the ground once carried, largest"),
    "ride_mps2": Figure("largest acceleration of the head on the way home, with gravity"),
    # of the disposal
    "in_container_share": Figure("share of the case's weight on the container in the end"),
    "in_ahead_m": Figure("the case lies ahead of the container's middle by"),
    "in_aside_m": Figure("and to its left by"),
    "in_up_m": Figure("and its centre above the ground by"),
    "case_sinking_mps": Figure("largest speed of the case downwards"),
    "case_tilt_rad": Figure("largest tilt of the case while carried"),
    "slipped_m": Figure("the case slipped in the hands by"),
    "left_grip_least_N": Figure("fingers of the left hand press, least"),
    "left_grip_most_N": Figure("fingers of the left hand press, most"),
    "right_grip_least_N": Figure("fingers of the right hand press, least"),
    "right_grip_most_N": Figure("fingers of the right hand press, most"),
    "knock_N": Figure("other parts of the robot press on case or container, most"),
    "carried_margin_m": Figure("centre of pressure inside the support by while it carries, least"),
    "self_distance_m": Figure("nearest that the robot came to itself, as its monitor saw it"),
    "motor_C": Figure("hottest motor winding, as its monitor saw it"),
    # of the monitors: the worst of the run
    "self_collision_distance_m": Figure("nearest that the robot came to itself", "§4.2.1"),
    "static_margin_m": Figure("centre of mass inside its support by, least", "§4.2.1"),
    "pressure_margin_m": Figure("centre of pressure inside the support by, least"),
    "tip_angle_rad": Figure("angle to tipping over, least"),
    "energy_margin_J": Figure("work to tip it over, least"),
    "motor_temperature_C": Figure("hottest motor winding"),
    "power_W": Figure("largest power from the battery"),
}

# suffix of a name: unit, then (below this magnitude, factor, smaller unit)
_UNITS = {
    "_s": ("s", (0.0, 1.0, "s")),
    "_m": ("m", (0.1, 1e3, "mm")),
    "_rad": ("rad", (0.1, 1e3, "mrad")),
    "_us": ("µs", (0.0, 1.0, "µs")),
    "_N": ("N", (0.0, 1.0, "N")),
    "_J": ("J", (0.0, 1.0, "J")),
    "_W": ("W", (0.0, 1.0, "W")),
    "_C": ("°C", (0.0, 1.0, "°C")),
    "_nm": ("N m", (0.0, 1.0, "N m")),
    "_mps": ("m/s", (0.0, 1.0, "m/s")),
    "_mps2": ("m/s²", (0.0, 1.0, "m/s²")),
}


def describe(name: str) -> Figure:
    """The description of a figure; one that nobody described is called by its name."""
    return FIGURES.get(name) or Figure(name.replace("_", " "))


def tells(name: str, summary: Mapping[str, Any]) -> bool:
    """Whether a figure is worth a line: it came, or the table or the thesis asks for it."""
    asked = name in summary["wanted"] or name in summary["thesis"]
    return asked or summary["figures"][name] is not None


def readable(name: str, value: float | None) -> str:
    """A number as a person reads it: "14.3 s", "0.31 mm", "-" for none.

    Args:
        name: ends with the unit of the value, e.g. "hand_error_max_m".
        value: in that unit.
    """
    if value is None or not math.isfinite(value):
        return "-"
    if name.endswith("_J") and abs(value) >= 1e3:
        return f"{value / 1e3:.1f} kJ"
    if name.endswith("_share"):
        return f"{100 * value:.2f} %"
    suffix = next((s for s in _UNITS if name.endswith(s)), None)
    if suffix is None:
        return f"{value:.4g}"
    unit, (below, factor, smaller) = _UNITS[suffix]
    if 0.0 < abs(value) < below:
        return f"{_digits(value * factor)} {smaller}"
    return f"{_digits(value)} {unit}"


def wanted(name: str, bounds: Mapping[str, float | None] | None, value: float | None) -> str:
    """What a figure must be for a success: "at least 0.300 m", ", missed" where it is not; "".

    Args:
        name: as for `readable`.
        bounds: "least" and "most" in the figure's unit, None for none.
        value: that came.
    """
    if not bounds:
        return ""
    least, most = bounds["least"], bounds["most"]
    words = [f"at least {readable(name, least)}"] if least is not None else []
    words += [f"at most {readable(name, most)}"] if most is not None else []
    under = value is not None and least is not None and value < least
    over = value is not None and most is not None and value > most
    return ", ".join([*words, *["missed"] * (under or over)])


def _digits(value: float) -> str:
    """Three digits that count, trailing zeros kept, whole from 1000 on; plain 0 for nothing."""
    if abs(value) >= 999.5:
        return f"{value:.0f}"
    return f"{value:#.3g}".rstrip(".") if value else "0"
