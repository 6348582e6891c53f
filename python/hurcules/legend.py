"""The short names of joints and levels, in words."""

from __future__ import annotations

import re
from collections.abc import Sequence

__all__ = [
    "JOINTS",
    "LEVELS",
    "event_words",
    "joint_words",
    "level_words",
    "limit_words",
    "reason_words",
    "region_words",
]

# without L or R for the side
JOINTS = {
    "KN": "knee",
    "HIP": "hip",
    "WST": "waist",
    "NKY": "neck yaw",
    "NKP": "neck pitch",
    "SP": "shoulder pitch",
    "SR": "shoulder roll",
    "SY": "shoulder yaw",
    "EB": "elbow",
    "WY": "wrist yaw",
    "WP": "wrist pitch",
    "WY2": "second wrist yaw",
}
LEVELS = {
    "joint": "joint limits",
    "hpos": "hand positions",
    "hpitch": "pitch of the lower arms",
    "pel": "pelvis, forward",
    "gaze": "gaze direction",
    "L_hand + R_hand": "hands",
    "L_pitch + R_pitch": "pitch of the lower arms",
    "L_across + R_across + L_press + R_press": "hands, pressing",
}
# what a mission looks at, and its unit
_SEEN = {
    "casualty/heading_rad": ("the person lies this far from square across the way", "rad"),
    "casualty/stand_ahead_m": ("the stand before the person is ahead by", "m"),
    "casualty/face_up": ("the person's chest faces up by (1 on the back, 0 on a side)", ""),
    "distance/casualty_L_hand/casualty_pelvis": ("the left hand lies away from the hips by", "m"),
    "distance/casualty_R_hand/casualty_pelvis": ("the right hand lies away from the hips by", "m"),
}
_UNMET = re.compile(r"(?:took too long: )?(\S+) (<=|>=) (\S+) is not true, it is ([^\s;]+)")
_SIDES = {"L": "left", "R": "right"}


def joint_words(name: str) -> str:
    """A joint or coordinate in words, "left shoulder pitch" for "LSP"; other names stay."""
    if name == "KN":
        return "both knees"
    if name in JOINTS:
        return JOINTS[name]
    if name[:1] in _SIDES and name[1:] in JOINTS:
        return f"{_SIDES[name[0]]} {JOINTS[name[1:]]}"
    return name


def level_words(name: str) -> str:
    """A level in words, "hand positions" for "hpos"; other names stay."""
    return LEVELS.get(name, name)


def region_words(name: str) -> str:
    """A region of the body in words, "left upper arm" for "L_upper_arm"."""
    side, _, rest = name.partition("_")
    return f"{_SIDES.get(side, side)} {rest.replace('_', ' ')}".strip()


def event_words(text: str) -> str:
    """An event in words: "hip meets its upper limit" for "HIP meets its upper limit"."""
    name, _, rest = text.partition(" ")
    return f"{joint_words(name)} {rest}" if rest else text


def reason_words(text: str) -> str:
    """Why a mission ended or what it asks, in words: what was found, and what was wanted."""

    def told(match: re.Match[str]) -> str:
        name, sign, wanted, found = match.groups()
        if name not in _SEEN:
            return match[0]
        words, unit = _SEEN[name]
        bound = "at most" if sign == "<=" else "at least"
        return f"{words} {float(found):.2f} {unit}, wanted is {bound} {wanted} {unit}".rstrip()

    return _UNMET.sub(told, text)


def limit_words(active: Sequence[str]) -> list[str]:
    """Active limits in words, both sides as one.

    Args:
        active: as "LSP upper", "RSP upper", "HIP lower".

    Returns:
        "shoulder pitch upper", "hip lower".
    """
    words: list[str] = []
    for text in active:
        name, _, side = text.partition(" ")
        twin = {"L": "R", "R": "L"}.get(name[:1], "") + name[1:]
        if name[1:] in JOINTS and f"{twin} {side}" in active:
            words.append(f"{JOINTS[name[1:]]} {side}")
        else:
            words.append(f"{joint_words(name)} {side}")
    return list(dict.fromkeys(words))
