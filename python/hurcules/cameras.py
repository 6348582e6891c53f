"""Cameras as data: name, resolution, field of view, intrinsics, and the pictures they take.

The model has the stereo pair `head_left`, `head_right`, the wide camera `head_wide`, and
`auxiliary` on the chest, which looks along the arms; others (`overview`, `scene`, ...) are not
the robot's but can be asked for too. A camera looks along -z of its frame, x right, y up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error
from hurcules.rendering import open_renderer
from hurcules.validation import require_known

__all__ = ["ROBOT_CAMERAS", "Camera", "baseline", "find", "names", "picture"]

ROBOT_CAMERAS = ("head_wide", "head_left", "head_right", "auxiliary")


@dataclass(frozen=True)
class Camera:
    """A camera of a model.

    Attributes:
        name: in the model.
        width: [pixels].
        height: [pixels].
        field: (2,) [rad] field of view across and upright.
        intrinsics: (3, 3) [pixels] of a pinhole: focal lengths, and the centre of the picture. It
            maps x right, y down, z along the view.
    """

    name: str
    width: int
    height: int
    field: tuple[float, float]
    intrinsics: NDArray[np.float64]


def names(model: mujoco.MjModel) -> list[str]:
    """The cameras of a model."""
    return [model.camera(i).name for i in range(model.ncam)]


def find(model: mujoco.MjModel, name: str) -> Camera:
    """A camera of a model, a prefix before its name allowed.

    Raises:
        Error: there is none of this name; the text says which there are.
    """
    camera = _index(model, name)
    width, height = (int(pixels) for pixels in model.cam_resolution[camera])
    if min(width, height) <= 1:  # none was given: the window's
        width, height = model.vis.global_.offwidth, model.vis.global_.offheight
    sensor = model.cam_sensorsize[camera]
    if sensor[1] > 0:
        pixels = (width, height) / sensor  # a metre on the sensor
        focal = model.cam_intrinsic[camera, :2] * pixels
        # the principal point moves the picture to the left and upward
        centre = np.array((width, height)) / 2 - model.cam_intrinsic[camera, 2:] * pixels
    else:
        # square pixels, the centre in the middle
        focal = np.full(2, height / 2 / math.tan(math.radians(model.cam_fovy[camera]) / 2))
        centre = np.array((width, height)) / 2
    matrix = np.array([[focal[0], 0, centre[0]], [0, focal[1], centre[1]], [0, 0, 1]], float)
    field = tuple(2 * math.atan(n / 2 / f) for n, f in zip((width, height), focal, strict=True))
    return Camera(model.camera(camera).name, width, height, (field[0], field[1]), matrix)


def baseline(model: mujoco.MjModel, left: str = "head_left", right: str = "head_right") -> float:
    """Distance of a stereo pair [m]; both cameras on one body.

    Raises:
        Error: no such camera, or they sit on different bodies.
    """
    pair = [_index(model, name) for name in (left, right)]
    if len(set(model.cam_bodyid[pair])) != 1:
        raise Error(f"cameras '{left}' and '{right}' sit on different bodies: no stereo pair")
    return float(np.linalg.norm(model.cam_pos[pair[0]] - model.cam_pos[pair[1]]))


def picture(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    name: str,
    *,
    depth: bool = False,
    size: tuple[int, int] | None = None,
) -> NDArray[np.uint8] | NDArray[np.float32]:
    """What a camera sees of a state. Makes a renderer each time: for single pictures.

    Args:
        model: of the scene.
        data: its positions are drawn as they stand, after mj_forward or a step.
        name: of the camera.
        depth: distance along the view [m] instead of colours.
        size: (width, height) [pixels]; None is the camera's own.

    Returns:
        (height, width, 3) colours, or (height, width) [m].

    Raises:
        Error: there is no such camera, or a size that is not above 0.
        RendererError: there is no OpenGL that works.
    """
    camera = find(model, name)
    width, height = size or (camera.width, camera.height)
    if width < 1 or height < 1:
        raise Error(f"a picture wants a size above 0, got {width} x {height}")
    with open_renderer(model, width, height) as renderer:
        if depth:
            renderer.enable_depth_rendering()
        renderer.update_scene(data, camera=camera.name)
        return np.array(renderer.render())


def _index(model: mujoco.MjModel, name: str) -> int:
    known = names(model)
    found = [i for i, other in enumerate(known) if other == name or other.endswith(f"_{name}")]
    exact = [i for i in found if known[i] == name]
    if not exact and len(found) != 1:
        require_known("camera", name, known)
    return (exact or found)[0]
