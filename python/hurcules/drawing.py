"""What a controller does, drawn: targets, errors, and the joints that a limit holds.

A green ball is where a point shall be, with the axes of a pose; an orange line leads there from
where it is planned to be; a red ball is a joint at its limit, named at the top left. Any robot, in
MuJoCo's viewer (`hurcules.watch`), as a picture (`Simulation.picture`) or in a notebook.
"""

from __future__ import annotations

import base64
import struct
import threading
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import Any, Protocol

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules import _core
from hurcules.legend import joint_words, level_words
from hurcules.rendering import RendererError, TrackRenderer, make_renderer
from hurcules.validation import require_known

__all__ = [
    "ErrorMark",
    "LimitMark",
    "Loop",
    "caption",
    "draw",
    "error_marks",
    "html",
    "limit_marks",
    "picture",
]

Array = NDArray[np.float64]
Picture = NDArray[np.uint8]  # (height, width, 3)

TARGET, ERROR, LIMIT = (0.2, 0.8, 0.3, 0.9), (1.0, 0.54, 0.24, 0.9), (0.9, 0.1, 0.1, 0.6)
AXES = ((0.9, 0.2, 0.2, 1.0), (0.2, 0.8, 0.2, 1.0), (0.2, 0.4, 1.0, 1.0))
GLOW = 0.6  # of their own light: as bright in the dark
NEAR = 1e-3  # [m] of an error that is still worth a line
SIZES = (0.015, 0.04)  # [m] of a ball, least and most; between them a fiftieth of the scene


@dataclass(frozen=True)
class ErrorMark:
    """A task whose target is a place.

    Attributes:
        task: its name.
        position: (3,) [m] in the world, where its point is planned to be.
        target: (3,) [m] in the world.
        orientation: (3, 3) of the target, None for a point.
    """

    task: str
    position: Array
    target: Array
    orientation: Array | None = None


@dataclass(frozen=True)
class LimitMark:
    """A joint that its limit holds back.

    Attributes:
        text: the joint and the side.
        position: (3,) [m] in the world.
    """

    text: str
    position: Array


class Loop(Protocol):
    """What is drawn: a `hurcules.Simulation`."""

    model: mujoco.MjModel
    data: mujoco.MjData

    @property
    def controller(self) -> _core.WholeBodyController:
        """What is drawn of it."""

    @property
    def time(self) -> float:
        """[s]."""

    @property
    def levels(self) -> list[str]:
        """Their names, in decreasing priority."""

    def level_errors(self) -> Array:
        """Of each level, measured."""


def error_marks(loop: Loop) -> list[ErrorMark]:
    """Of the points and poses of the stack that rules, as of the last tick."""
    marks = []
    turn, shift = _from_plan(loop)
    for task in loop.controller.tasks if loop.controller.active else []:
        if isinstance(task, _core.PointTask | _core.PoseTask):
            axes = (
                turn @ task.world_target_orientation if isinstance(task, _core.PoseTask) else None
            )
            position, target = turn @ task.world_position + shift, turn @ task.world_target + shift
            marks.append(ErrorMark(task.name, position, target, axes))
    return marks


def _from_plan(loop: Loop) -> tuple[Array, Array]:
    """Rotation (3, 3) and shift (3,) [m] from where the plan stands to where the robot does."""
    model, plan = loop.model, loop.controller.plan
    root = model.body_rootid[model.jnt_bodyid[plan.coordinates[0].joints[0].joint]]
    joint = model.body_jntadr[root]
    if joint < 0 or model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE:
        return np.eye(3), np.zeros(3)
    first = model.jnt_qposadr[joint]
    planned, real = (_turn(qpos[first + 3 : first + 7]) for qpos in (plan.qpos, loop.data.qpos))
    turn = real @ planned.T
    return turn, loop.data.qpos[first : first + 3] - turn @ plan.qpos[first : first + 3]


def _turn(quaternion: Array) -> Array:
    turn = np.empty(9)
    mujoco.mju_quat2Mat(turn, quaternion)
    return turn.reshape(3, 3)


def limit_marks(loop: Loop) -> list[LimitMark]:
    """Of the coordinates at a position limit, as of the last tick."""
    controller = loop.controller
    sides = controller.active_limits.tolist() if controller.active else []
    return [
        LimitMark(
            f"{joint_words(coordinate.name)} {'upper' if side > 0 else 'lower'} limit",
            loop.data.xanchor[coordinate.joints[0].joint].copy(),
        )
        for coordinate, side in zip(controller.plan.coordinates, sides, strict=False)
        if side
    ]


def draw(scene: mujoco.MjvScene, loop: Loop) -> None:
    """Adds the marks of a simulation to a scene, as far as it has room.

    Args:
        scene: of a renderer, or `user_scn` of a viewer.
        loop: the simulation.
    """
    size = float(np.clip(0.02 * loop.model.stat.extent, *SIZES))
    for mark in error_marks(loop):
        away = float(np.linalg.norm(mark.position - mark.target))
        if away > NEAR:
            _line(scene, size / 3, mark.position, mark.target, ERROR)
        _ball(scene, size, mark.target, TARGET, f"{mark.task}: {1e3 * away:.0f} mm")
        if mark.orientation is not None:
            for axis, colour in zip(mark.orientation.T, AXES, strict=True):
                _line(scene, size / 3, mark.target, mark.target + 4 * size * axis, colour)
    for limit in limit_marks(loop):
        _ball(scene, 2.5 * size, limit.position, LIMIT)


def caption(loop: Loop) -> str:
    """The joints at their limits, one a line."""
    return "\n".join(mark.text for mark in limit_marks(loop))


def _ball(
    scene: mujoco.MjvScene, size: float, place: Array, colour: tuple[float, ...], label: str = ""
) -> None:
    for geom in _new(scene):
        turn, sphere = np.eye(3).ravel(), mujoco.mjtGeom.mjGEOM_SPHERE
        mujoco.mjv_initGeom(
            geom, sphere, np.full(3, size), place, turn, np.array(colour, np.float32)
        )
        geom.label, geom.emission = label, GLOW


def _line(
    scene: mujoco.MjvScene, width: float, start: Array, end: Array, colour: tuple[float, ...]
) -> None:
    for geom in _new(scene):
        kind, turn = mujoco.mjtGeom.mjGEOM_CAPSULE, np.eye(3).ravel()
        mujoco.mjv_initGeom(
            geom, kind, np.full(3, width), start, turn, np.array(colour, np.float32)
        )
        mujoco.mjv_connector(geom, kind, width, start, end)
        geom.emission = GLOW


def _new(scene: mujoco.MjvScene) -> Iterator[Any]:
    """The next geom of a scene, none where it is full."""
    if scene.ngeom < scene.maxgeom:
        scene.ngeom += 1
        yield scene.geoms[scene.ngeom - 1]


def _require_camera(model: mujoco.MjModel, camera: str | int) -> None:
    cameras = [model.camera(i).name for i in range(model.ncam)]
    if isinstance(camera, str):
        require_known("camera", camera, cameras)
    elif not 0 <= camera < model.ncam:
        known = ", ".join(cameras) or "none"
        raise _core.Error(f"camera {camera}: the model has {model.ncam}, counted from 0: {known}")


def picture(
    loop: Loop,
    width: int = 640,
    height: int = 480,
    camera: str | int | mujoco.MjvCamera | None = None,
) -> Picture:
    """What a simulation looks like now, with its marks.

    Args:
        loop: the simulation.
        width: [pixels].
        height: [pixels].
        camera: of the model, by name or number, or one of MuJoCo's; None looks at all of it, and
            goes after a robot that leaves it.

    Raises:
        RendererError: there is no OpenGL that works.
        Error: the model has no such camera, or a size that no picture has.
    """
    model = loop.model
    if isinstance(camera, str | int):
        _require_camera(model, camera)
    renderer = _kept_renderer(model, width, height)
    renderer.update_scene(loop.data, overview(loop) if camera is None else camera)
    draw(renderer.scene, loop)
    renderer.caption = caption(loop)
    return np.array(renderer.render())


def overview(loop: Loop) -> mujoco.MjvCamera:
    """Looks at all of the model, and goes after a robot that is half its size away."""
    model, camera = loop.model, mujoco.MjvCamera()
    mujoco.mjv_defaultFreeCamera(model, camera)
    moved = loop.controller.plan.coordinates[0].joints[0].dof
    root = model.body_rootid[model.dof_bodyid[moved]]
    way: Array = loop.data.xpos[root] - model.body_pos[root]
    away = float(np.linalg.norm(way))
    camera.lookat += way * max(0.0, 1.0 - 0.5 * float(model.stat.extent) / max(away, NEAR))
    return camera


class _Own(threading.local):
    """The last renderer of each thread: to make one takes longer than to draw."""

    renderer: TrackRenderer | None = None
    size: tuple[int, int, int] = (0, 0, 0)  # id of its model, which it keeps, width, height


_own = _Own()


def _kept_renderer(model: mujoco.MjModel, width: int, height: int) -> TrackRenderer:
    wanted = (id(model), width, height)
    if _own.renderer is None or _own.size != wanted:
        if _own.renderer is not None:
            _own.renderer.close()
        _own.renderer = None
        _own.renderer, _own.size = make_renderer(model, width, height), wanted
    return _own.renderer


def html(loop: Loop) -> str:
    """For a notebook: time, levels, limits, and a picture where there is OpenGL."""
    rows = [("time", f"{loop.time:.3f} s")]
    levels = zip(loop.levels, loop.level_errors(), strict=True)
    rows += [(f"error of {level_words(name)} [m, rad]", f"{error:.4g}") for name, error in levels]
    limits = ", ".join(mark.text for mark in limit_marks(loop))
    rows.append(("held by", limits or "no joint limit"))
    cells = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th><td>{escape(text)}</td></tr>"
        for name, text in rows
    )
    return f"<table><caption>{escape(repr(loop))}</caption>{cells}</table>{_image(loop)}"


def _image(loop: Loop) -> str:
    try:
        shown = _png(picture(loop))
    except RendererError as error:
        return f"<p>{escape(str(error))}</p>"
    return f"<img src='data:image/png;base64,{base64.b64encode(shown).decode()}'/>"


def _png(shown: Picture) -> bytes:
    """A picture as a PNG file, without a package that writes them."""
    height, width, _ = shown.shape
    lines = np.hstack([np.zeros((height, 1), np.uint8), shown.reshape(height, -1)])
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)  # 8 bits, red green blue
    chunks = ((b"IHDR", header), (b"IDAT", zlib.compress(lines.tobytes())), (b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(
        struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))
        for kind, body in chunks
    )
