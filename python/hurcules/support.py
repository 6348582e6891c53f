"""What a robot on feet stands over."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error, Robot, sole_points

__all__ = ["support_polygon"]

SAME = 1e-6  # [m] corners nearer to a line than this are none


def support_polygon(robot: Robot, feet: Sequence[str], reference: str = "") -> NDArray[np.float64]:
    """The convex polygon about the soles of some feet, for a `BalanceTask`.

    Args:
        robot: as it stands.
        feet: names of bodies, see `sole_points`.
        reference: frame in whose axes the corners are, '' for the world.

    Returns:
        (k, 2) [m] corners in x and y of the reference, counterclockwise.

    Raises:
        Error: no such body or frame, or soles that have no area (two round feet).
    """
    if isinstance(feet, str):
        feet = [feet]
    soles = np.vstack([np.zeros((0, 3)), *(_sole(robot, foot) for foot in feet)])
    if reference:
        soles = (soles - robot.position(reference)) @ robot.orientation(reference)
    corners = _hull(soles[:, :2])
    if len(corners) < 3:
        names = ", ".join(feet) or "no foot"
        raise Error(f"support_polygon wants soles that enclose an area, those of {names} do not")
    return corners


def _sole(robot: Robot, foot: str) -> NDArray[np.float64]:
    """(k, 3) in the world."""
    return robot.position(foot) + sole_points(robot, foot) @ robot.orientation(foot).T


def _hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the convex hull, counterclockwise: the lower chain, then the upper one."""
    ordered = points[np.lexsort((points[:, 1], points[:, 0]))]
    corners: list[NDArray[np.float64]] = []
    for chain in (ordered, ordered[::-1]):
        start = len(corners)
        for point in chain:
            while len(corners) >= start + 2 and not _turns_left(corners[-2], corners[-1], point):
                corners.pop()
            corners.append(point)
        del corners[-1:]  # it begins the other chain
    return np.array(corners)


def _turns_left(a: NDArray[np.float64], b: NDArray[np.float64], c: NDArray[np.float64]) -> bool:
    """Whether b is a corner on the way from a to c."""
    along, aside = c - a, b - a
    return bool(along[1] * aside[0] - along[0] * aside[1] > SAME * np.hypot(*along))
