"""The pose transformations as lists of moves, for both robots.

From driving to standing, to the ground and back to driving with one leg at a time. The angles are
those of docs/design/robot.md#postures; every script starts in the keyframe `drive`.
"""

from __future__ import annotations

from math import pi

from hurcules._core import Error
from hurcules.postures.moves import Move, move, standing

__all__ = ["fold_back", "lift", "lower", "stand_up"]


def _checked(robot: str) -> bool:
    """Whether it is the rescue robot."""
    if robot not in ("manipulation", "rescue"):
        raise Error(f"robot '{robot}' has no postures; there are: manipulation, rescue")
    return robot == "rescue"


def stand_up(robot: str, *, turn_waist: bool = True, fold_arms: bool = True) -> list[Move]:
    """From `drive` to `ready`: the lower legs swing over the front, beside the turned trunk.

    Args:
        robot: "rescue" or "manipulation".
        turn_waist: False leaves the waist ahead, where the legs hit the arms: a negative control.
        fold_arms: False leaves the arms as they drive: a negative control.
    """
    rescue = _checked(robot)
    turn = [move("open the arms", 3, SR=0.45), move("turn the waist", 5, WST=1.52)]
    fold = [move("fold the arms", 3, SP=0.30, SR=0.0, SY=0.0 if rescue else -0.5, EB=2.45)]
    swing = [
        move("swing both lower legs over the front", 12, KN=pi),
        move("turn the waist back", 5, WST=0.0),
        move("lean forward", 5, HIP=1.0, SP=1.9, EB=0.6, SY=0.0, SR=0.0),
        Move(
            "stand up",
            14,
            (
                (0.25, {"LKN": 7 * pi / 8, "RKN": 7 * pi / 8, "HIP": 1.0 - pi / 8}),
                (1.0, {"LKN": pi / 2, "RKN": pi / 2, "HIP": -pi / 2}),
            ),
        ),
        move("ready", 3, KN=pi / 2, HIP=-pi / 2, SP=0.35, EB=1.5),
    ]
    return turn * turn_waist + fold * fold_arms + swing


def lower(robot: str) -> list[Move]:
    """From `ready` to `acquisition`: the hands at the ground."""
    if _checked(robot):
        return [
            standing("lower the scoops", 14, (0.35, 1.3, 0.7, 0.45, 1.5),
                     (0.75, 1.15, 1.25, 0.2, 1.25), (1.0, 1.1, 1.45, -0.574, 1.0)),
        ]  # fmt: skip
    return [
        standing("raise the arms", 4, (1.0, pi / 2, 0.0, 1.2, 1.6)),
        standing("lower the hands", 12, (0.5, 1.3, 0.8, 1.0, 1.3), (1.0, 1.1, 1.4, 0.5, 0.725)),
    ]


def lift(robot: str) -> list[Move]:
    """From `acquisition` to `carry`, with what was taken there."""
    if _checked(robot):
        return [
            standing("flex the arms", 5, (1.0, 1.1, 1.45, -0.574, 1.62)),
            standing("raise to carry", 16, (0.4, 1.3, 0.8, -0.3, 1.65),
                     (1.0, pi / 2, 0.0, -0.1, 1.75)),
        ]  # fmt: skip
    return [
        standing("raise to carry", 14, (0.4, 1.3, 0.8, 0.4, 1.3), (1.0, pi / 2, 0.0, -0.1, 1.55))
    ]


def fold_back(robot: str) -> list[Move]:
    """From `carry` to driving: sits down and folds one leg at a time on the side off the load."""
    b = 1.75 if _checked(robot) else 1.55
    return [
        standing("sit down", 17, (0.35, 1.1, 0.5, -0.2, b), (0.7, 0.4, 0.9, -0.3, b),
                 (1.0, 0.0, 0.9, -0.35, b)),
        standing("straighten the trunk", 5, (1.0, 0.0, 0.0, -0.2, b)),
        move("turn the waist to the left", 7, WST=pi / 2),
        move("fold the right leg", 14, RKN=0.0),
        move("turn the waist to the right", 12, WST=-pi / 2),
        move("fold the left leg", 14, LKN=0.0),
        move("turn the waist ahead", 7, WST=0.0),
        move("lean for the way", 5, HIP=0.25),
    ]  # fmt: skip
