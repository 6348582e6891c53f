"""Pictures without a window: a renderer, or a clear word that there is none, and the camera."""

from __future__ import annotations

import atexit
import os
import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error
from hurcules.opengl import REMEDY, choose_backend, give_mujoco
from hurcules.running_gear import RunningGear

__all__ = [
    "RendererError",
    "TrackRenderer",
    "following_camera",
    "make_renderer",
    "open_renderer",
    "overview_camera",
    "pose",
]


MOST = 16384  # [pixels] what OpenGL takes


class RendererError(Error):
    """There is no usable OpenGL renderer; the text names the remedy."""


class TrackRenderer(mujoco.Renderer):  # type: ignore[misc]  # untyped in the package mujoco
    """MuJoCo's renderer with tracks that move.

    Attributes:
        caption: lines at the top left of a picture in colour.
    """

    caption = ""

    def __init__(self, model: mujoco.MjModel, height: int, width: int) -> None:
        super().__init__(model, height, width)
        self._thread = threading.get_ident()
        self._gear = RunningGear(model)

    def update_scene(
        self,
        data: mujoco.MjData,
        camera: int | str | mujoco.MjvCamera = -1,
        scene_option: mujoco.MjvOption | None = None,
    ) -> None:
        """As MuJoCo's, then the tracks."""
        super().update_scene(data, camera, scene_option)
        self._gear.show(data, self.scene)

    def render(self, *, out: NDArray[Any] | None = None) -> NDArray[Any]:
        """As MuJoCo's.

        Raises:
            RendererError: it was made in another thread, and this OpenGL draws in that one alone.
        """
        try:
            shown = super().render(out=out)
            return self._captioned(shown) if self.caption else shown
        except Exception as error:  # each OpenGL has its own
            if threading.get_ident() == self._thread:
                raise
            raise RendererError(
                "pictures are drawn by the thread that drew the first one; make the environment or "
                "the simulation, and reset it, in the thread that steps it"
            ) from error

    def _captioned(self, shown: NDArray[Any]) -> NDArray[Any]:
        font, place = mujoco.mjtFont.mjFONT_NORMAL, mujoco.mjtGridPos.mjGRID_TOPLEFT
        mujoco.mjr_overlay(font, place, self._rect, self.caption, "", self._mjr_context)
        mujoco.mjr_readPixels(shown, None, self._rect, self._mjr_context)
        shown[:] = np.flipud(shown)
        return shown

    def close(self) -> None:
        """Gives back what it has, in its own context: in another one these would be another's."""
        if context := getattr(self, "_gl_context", None):
            context.make_current()
        super().close()


_open: weakref.WeakSet[TrackRenderer] = weakref.WeakSet()


def _close_all() -> None:
    for renderer in list(_open):
        with suppress(Exception):  # another thread may draw still
            renderer.close()


_drawing: list[int] = []  # the process that drew first; a fork inherits it


def _refuse_fork() -> None:
    """Mesa draws on threads that a fork does not have, and other drivers bear none either."""
    _drawing.append(os.getpid())
    del _drawing[1:]
    if _drawing != [os.getpid()] and os.environ.get("LP_NUM_THREADS") != "0":
        raise RendererError(
            "this process was forked from one that has drawn, and would hang in OpenGL: make the "
            "processes before the first picture or start them by spawn (of Gymnasium's vectors "
            "vector_kwargs={'context': 'spawn'}); where Mesa draws, LP_NUM_THREADS=0 does too"
        )


def make_renderer(model: mujoco.MjModel, width: int, height: int) -> TrackRenderer:
    """Makes an off-screen renderer that the caller closes.

    Args:
        model: what is drawn; its off-screen buffer is enlarged where it is too small.
        width: [pixels].
        height: [pixels].

    Raises:
        Error: a size that no picture has.
        RendererError: there is no OpenGL that works, or the process was forked from one that drew.
    """
    _refuse_fork()
    for size in (width, height):  # before the model's buffer has it
        if not isinstance(size, int | np.integer) or not 1 <= size <= MOST:
            wanted = f"width and height of a picture want whole numbers from 1 to {MOST}"
            raise Error(f"{wanted}, got {width!r} and {height!r}")
    buffer = model.vis.global_
    buffer.offwidth, buffer.offheight = max(buffer.offwidth, width), max(buffer.offheight, height)
    try:
        give_mujoco(choose_backend())
        _open.add(renderer := TrackRenderer(model, height, width))
        atexit.unregister(_close_all)
        atexit.register(_close_all)  # before OpenGL's own end, which is registered by now
        return renderer
    # each OpenGL fails with an exception of its own: RuntimeError, FatalError, ImportError, ...
    except Exception as error:
        text = " ".join(str(error).split()) or type(error).__name__
        raise RendererError(f"no usable renderer ({text}): {REMEDY}") from error


@contextmanager
def open_renderer(model: mujoco.MjModel, width: int, height: int) -> Iterator[mujoco.Renderer]:
    """As `make_renderer`, closed at the end of the `with` block."""
    renderer = make_renderer(model, width, height)
    try:
        yield renderer
    finally:
        renderer.close()


def overview_camera() -> mujoco.MjvCamera:
    """The camera of videos and pictures: from the front left, the whole machine and its reach."""
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_FREE
    camera.lookat[:] = (1.3, 0.0, 0.46)
    camera.distance, camera.azimuth, camera.elevation = 3.5, 103.0, -10.0
    return camera


def following_camera(
    model: mujoco.MjModel,
    body: str,
    distance: float = 3.8,
    azimuth: float = 150.0,
    elevation: float = -16.0,
) -> mujoco.MjvCamera:
    """A camera that goes with what hangs on this body: distance [m], angles [degrees]."""
    camera = mujoco.MjvCamera()
    camera.type = mujoco.mjtCamera.mjCAMERA_TRACKING
    camera.trackbodyid = model.body(body).id
    camera.distance, camera.azimuth, camera.elevation = distance, azimuth, elevation
    return camera


def pose(model: mujoco.MjModel, data: mujoco.MjData, qpos: NDArray[np.float64]) -> None:
    """Puts everything where `qpos` (nq) says, as far as drawing needs it."""
    data.qpos[:] = qpos
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_camlight(model, data)
