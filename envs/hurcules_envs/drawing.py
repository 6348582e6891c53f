"""Marks in pictures: goals, paths, directions."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np

__all__ = ["add_arrow", "add_ball"]

Color = tuple[float, float, float, float]


def add_ball(scene: mujoco.MjvScene, place: Sequence[float], radius: float, color: Color) -> None:
    """Draws a ball [m]; nothing where the scene is full."""
    _add(scene, mujoco.mjtGeom.mjGEOM_SPHERE, [radius] * 3, place, color)


def add_arrow(
    scene: mujoco.MjvScene, start: Sequence[float], end: Sequence[float], width: float, color: Color
) -> None:
    """Draws an arrow [m]; nothing where the scene is full."""
    geom = _add(scene, mujoco.mjtGeom.mjGEOM_ARROW, [width] * 3, start, color)
    if geom is not None:
        ends = np.array(start, float), np.array(end, float)
        mujoco.mjv_connector(geom, mujoco.mjtGeom.mjGEOM_ARROW, width, *ends)


def _add(
    scene: mujoco.MjvScene, kind: int, size: Sequence[float], place: Sequence[float], color: Color
) -> mujoco.MjvGeom | None:
    if scene.ngeom >= scene.maxgeom:
        return None
    geom = scene.geoms[scene.ngeom]
    mujoco.mjv_initGeom(
        geom, kind, np.array(size, float), np.array(place, float), np.eye(3).ravel(),
        np.array(color, np.float32),
    )  # fmt: skip
    scene.ngeom += 1
    return geom
