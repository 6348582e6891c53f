"""Tracks that are seen to move: sprockets, road wheels and pads turn with the belts, in pictures.

The model shows a belt as one still mesh, for viewers that know nothing of this. Here that mesh
gives way to a bare band and its pads, each where the belt's angle has brought it; contacts know
nothing of either. A track is the body that shows a mesh `belt_NAME`, and its
belt joint.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["RunningGear"]

_RADIUS = 0.14  # [m] of the tracks, over the pads
_BAND = 0.126  # [m] of the band under the pads
_PITCH = 0.058  # [m] at least, from pad to pad
_RUN = {"lower": 0.85, "upper": 0.55}  # [m] between the axles
_WIDTH = {"lower": 0.15, "upper": 0.13}  # [m] of the band
_TURNING = {"sprocket": _RADIUS, "wheel": 0.052 + 0.5 * (_RADIUS - _BAND)}  # [m] rolling radius


@dataclass
class _Track:
    kind: str  # "lower" or "upper"
    belt: int  # geom that shows the still belt
    angle: int  # address in qpos of its joint
    turning: dict[int, float] = field(default_factory=dict)  # geom: its turn per turn of the belt
    pads: _Pads | None = None  # as they were shown last


@dataclass
class _Pads:
    scene: mujoco.MjvScene
    first: int  # of its geoms
    places: NDArray[np.float32]  # (m, 3) in the scene
    turns: NDArray[np.float32]  # (m, 3, 3)

    def are_there(self, scene: mujoco.MjvScene, mesh: int, still: mujoco.MjvGeom) -> bool:
        """Nobody has drawn over them: who did began no later than where the scene ended."""
        if scene is not self.scene or scene.ngeom != self.first or not len(self.places):
            return False
        geom = scene.geoms[self.first]
        return bool(geom.dataid == mesh and _owner(geom) == _owner(still))


class RunningGear:
    """Moves the tracks of all robots of a model in scenes to be drawn.

    Args:
        model: any; without tracks nothing is done.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._drawn = np.array([_matrix(quat) for quat in model.mesh_quat]).reshape(-1, 3, 3)
        self._tracks: dict[int, _Track] = {}  # by the body that shows the belt
        shown = {
            geom: model.mesh(int(model.geom_dataid[geom])).name
            for geom in range(model.ngeom)
            if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH
        }
        for geom, mesh in shown.items():
            joint = self._belt_joint(int(model.geom_bodyid[geom]))
            if mesh in ("belt_lower", "belt_upper") and joint >= 0 and self._has_parts(mesh[5:]):
                track = _Track(mesh[5:], geom, int(model.jnt_qposadr[joint]))
                self._tracks[int(model.geom_bodyid[geom])] = track
        for geom, mesh in shown.items():
            kind = mesh.split("_")[0]
            track_of_geom = self._track_above(int(model.geom_bodyid[geom]))
            if kind in _TURNING and track_of_geom is not None:
                track_of_geom.turning[geom] = _RADIUS / _TURNING[kind]

    def show(self, data: mujoco.MjData, scene: mujoco.MjvScene) -> None:
        """Changes a scene that `mjv_updateScene` has just filled from this data."""
        if not self._tracks:
            return
        at = {
            int(geom.objid): geom
            for geom in scene.geoms[: scene.ngeom]
            if geom.objtype == mujoco.mjtObj.mjOBJ_GEOM
        }
        for track in self._tracks.values():
            angle = float(data.qpos[track.angle])
            wheels = [geom for geom in track.turning if geom in at]
            for geom, axes in zip(wheels, self._turned(data, track, wheels, angle), strict=True):
                at[geom].mat[:] = axes
            if track.belt in at:
                self._show_belt(data, scene, at[track.belt], track, angle)

    def _turned(
        self, data: mujoco.MjData, track: _Track, wheels: list[int], angle: float
    ) -> NDArray[np.float64]:
        """(k, 3, 3) axes of wheels that have turned about the y axes of the meshes as drawn."""
        drawn = self._drawn[self._model.geom_dataid[wheels]]
        turns = np.array([track.turning[geom] for geom in wheels]) * angle
        spin = np.zeros((len(wheels), 3, 3))
        spin[:, 0, 0] = spin[:, 2, 2] = np.cos(turns)
        spin[:, 0, 2] = np.sin(turns)
        spin[:, 2, 0] = -spin[:, 0, 2]
        spin[:, 1, 1] = 1.0
        axes: NDArray[np.float64] = data.geom_xmat[wheels].reshape(-1, 3, 3)
        return axes @ drawn.transpose(0, 2, 1) @ spin @ drawn

    def _show_belt(
        self,
        data: mujoco.MjData,
        scene: mujoco.MjvScene,
        still: mujoco.MjvGeom,
        track: _Track,
        angle: float,
    ) -> None:
        origin, axes = self._frame(data, track.belt)
        band, pad = (self._model.mesh(f"{part}_{track.kind}").id for part in ("band", "pad"))
        side = _WIDTH[track.kind] / 4 - 0.002
        points, turns = _on_oval(_marks(track.kind) + _RADIUS * angle, _RUN[track.kind])
        points[0::2, 1], points[1::2, 1] = side, -side
        # MuJoCo has moved the vertices of each mesh
        turns = axes @ turns
        places = origin + points @ axes.T + turns @ self._model.mesh_pos[pad]
        turns = turns @ self._drawn[pad]
        still.dataid = 2 * band  # odd numbers are convex hulls
        still.pos[:] = origin + axes @ self._model.mesh_pos[band]
        still.mat[:] = axes @ self._drawn[band]
        if track.pads is None or not track.pads.are_there(scene, 2 * pad, still):
            track.pads = _add_pads(scene, len(places), 2 * pad, still)
        else:
            scene.ngeom += len(track.pads.places)
        shown = len(track.pads.places)  # as many as the scene had room for
        track.pads.places[:] = places[:shown]
        track.pads.turns[:] = turns[:shown]

    def _frame(
        self, data: mujoco.MjData, geom: int
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Where the frame that a geom's mesh was drawn in is: origin and axes in the world."""
        number = int(self._model.geom_dataid[geom])
        axes = data.geom_xmat[geom].reshape(3, 3) @ self._drawn[number].T
        return data.geom_xpos[geom] - axes @ self._model.mesh_pos[number], axes

    def _belt_joint(self, body: int) -> int:
        """The belt joint of a body or of a body right below it, -1 for none."""
        model = self._model
        for joint in range(model.njnt):
            owner = int(model.jnt_bodyid[joint])
            near = owner == body or int(model.body_parentid[owner]) == body
            if near and model.joint(joint).name.endswith("_belt"):
                return joint
        return -1

    def _has_parts(self, kind: str) -> bool:
        meshes = {self._model.mesh(i).name for i in range(self._model.nmesh)}
        return {f"band_{kind}", f"pad_{kind}"} <= meshes

    def _track_above(self, body: int) -> _Track | None:
        while body > 0 and body not in self._tracks:
            body = int(self._model.body_parentid[body])
        return self._tracks.get(body)


def _marks(kind: str) -> NDArray[np.float64]:
    """Arc length [m] of each pad at angle 0, both rows in turn."""
    length = 2 * _RUN[kind] + 2 * np.pi * _BAND
    count = int(length / _PITCH)
    return np.arange(2 * count) * 0.5 * length / count


def _on_oval(s: NDArray[np.float64], run: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Points (m, 3) of the band at arc lengths s (m), and the axes (m, 3, 3) of pads there.

    s counts from below the heel axle backwards. In the frame of the
    track: heel axle at the origin along y, toe axle at x = -run.
    """
    bend = np.pi * _BAND
    s = s % (2 * run + 2 * bend)
    corners = np.array([0.0, run, run + bend, 2 * run + bend, 2 * run + 2 * bend])
    centre = np.interp(s, corners, [0.0, -run, -run, 0.0, 0.0])
    a = np.interp(s, corners, np.array([-0.5, -0.5, -1.5, -1.5, -2.5]) * np.pi)
    c, n, zero = np.cos(a), np.sin(a), 0 * a
    out = np.stack([c, zero, n], axis=1)
    across = np.stack([zero, zero + 1, zero], axis=1)
    along = np.stack([n, zero, -c], axis=1)  # across x out
    points = _BAND * out
    points[:, 0] += centre
    return points, np.stack([along, across, out], axis=2)


def _add_pads(scene: mujoco.MjvScene, count: int, mesh: int, still: mujoco.MjvGeom) -> _Pads:
    """Pads of a belt as far as the scene has room, to be placed."""
    first, end = scene.ngeom, min(scene.ngeom + count, scene.maxgeom)
    size, place, turn, rgba = np.zeros(3), np.zeros(3), np.eye(3).ravel(), still.rgba
    geoms = scene.geoms[first:end]
    for number, geom in enumerate(geoms, first):
        mujoco.mjv_initGeom(geom, mujoco.mjtGeom.mjGEOM_MESH, size, place, turn, rgba)
        geom.dataid = mesh
        # a segmentation shows it as the belt; mjv_initGeom leaves what was there
        geom.objtype, geom.objid = _owner(still)
        geom.segid = number
        _paint_like(geom, still)
    scene.ngeom = end
    if not geoms:
        return _Pads(scene, first, np.empty((0, 3), np.float32), np.empty((0, 3, 3), np.float32))
    places, turns = (_in_all([getattr(geom, name) for geom in geoms]) for name in ("pos", "mat"))
    return _Pads(scene, first, places, turns)


def _in_all(arrays: list[NDArray[np.float32]]) -> NDArray[np.float32]:
    """The same member of structures that lie one after the other, as one array."""
    first, last = arrays[0], arrays[-1]
    step = (last.ctypes.data - first.ctypes.data) // max(len(arrays) - 1, 1)
    shape, strides = (len(arrays), *first.shape), (step, *first.strides)
    return np.lib.stride_tricks.as_strided(first, shape, strides)


def _owner(geom: mujoco.MjvGeom) -> tuple[int, int]:
    return int(geom.objtype), int(geom.objid)


def _paint_like(geom: mujoco.MjvGeom, other: mujoco.MjvGeom) -> None:
    geom.matid, geom.category = other.matid, other.category
    geom.emission, geom.specular = other.emission, other.specular
    geom.shininess, geom.reflectance = other.shininess, other.reflectance


def _matrix(quat: NDArray[np.float64]) -> NDArray[np.float64]:
    result = np.empty(9)
    mujoco.mju_quat2Mat(result, quat)
    return result.reshape(3, 3)
