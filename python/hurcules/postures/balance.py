"""Static balance: how far the centre of mass lies inside what the robot stands on."""

from __future__ import annotations

from collections.abc import Iterable

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["hull", "inside", "static_margin"]


def hull(points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Corners of the convex hull of points (m, 2), counterclockwise, (k, 2)."""
    rows = sorted(set(map(tuple, points.tolist())))
    if len(rows) < 3:
        return np.array(rows)

    def half(order: Iterable[tuple[float, ...]]) -> list[tuple[float, ...]]:
        chain: list[tuple[float, ...]] = []
        for p in order:
            while len(chain) > 1 and _turn(chain[-2], chain[-1], p) <= 0:
                chain.pop()
            chain.append(p)
        return chain[:-1]

    return np.array(half(rows) + half(reversed(rows)))


def _turn(a: tuple[float, ...], b: tuple[float, ...], c: tuple[float, ...]) -> float:
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def inside(corners: NDArray[np.float64], point: NDArray[np.float64]) -> float:
    """Distance [m] of a point (2) from the edge of a convex polygon (k, 2), -inf without area.

    Negative is outside.
    """
    if len(corners) < 3:
        return -np.inf
    along = np.roll(corners, -1, axis=0) - corners
    offset = point - corners
    across = along[:, 0] * offset[:, 1] - along[:, 1] * offset[:, 0]
    return float((across / np.linalg.norm(along, axis=1)).min())


def static_margin(
    model: mujoco.MjModel, data: mujoco.MjData, root: str, carried: Iterable[str] = ()
) -> float:
    """Distance [m] of the centre of mass from the edge of the support, seen from above.

    Args:
        model: on level ground.
        data: after a step.
        root: body at the root of the robot.
        carried: bodies that are carried; one that touches the ground itself does not count.
    """
    robot = model.body(root).id
    geoms, points = data.contact.geom, data.contact.pos
    bodies = model.geom_bodyid[geoms]
    ground = model.body_weldid[bodies] == 0
    roots = model.body_rootid[bodies]
    touches = ground.any(axis=1)
    mine = touches & (roots == robot).any(axis=1)
    if mine.sum() < 3:
        return -np.inf
    resting = roots[touches]
    loads = [i for name in carried if (i := model.body(name).id) not in resting]
    mass = model.body_subtreemass[[robot, *loads]]
    centre = mass @ data.subtree_com[[robot, *loads], :2] / mass.sum()
    return inside(hull(points[mine, :2]), centre)
