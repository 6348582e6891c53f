"""Cameras as data: what the model says of them, and that pictures agree with their intrinsics.

The pinhole is checked in a picture: a small ball is drawn where the intrinsics put it. Pictures
need an OpenGL without a window; without one those tests are skipped.
"""

import math
from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import cameras
from hurcules.rendering import RendererError

BALL = """
<mujoco>
  <visual><headlight ambient="1 1 1" diffuse="0 0 0" specular="0 0 0"/></visual>
  <worldbody>
    <camera name="eye" pos="0 0 1" xyaxes="0 -1 0 0 0 1" fovy="40" resolution="320 200"/>
    <camera name="lens" pos="0 0 1" xyaxes="0 -1 0 0 0 1" resolution="320 200"
            sensorsize="0.0032 0.0020" focal="0.003 0.003" principal="0.0002 0.0001"/>
    <geom name="ball" pos="2 0.3 1.2" size="0.03" rgba="1 0 0 1"/>
    <geom name="wall" type="box" pos="4.1 0 1" size="0.1 9 9" rgba="0 0 1 1"/>
  </worldbody>
</mujoco>
"""


@pytest.fixture(scope="module")
def robot() -> mujoco.MjModel:
    return hurcules.models.load("rescue")


@pytest.fixture(scope="module")
def scene() -> tuple[mujoco.MjModel, mujoco.MjData]:
    model = mujoco.MjModel.from_xml_string(BALL)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    return model, data


def picture(scene: tuple[mujoco.MjModel, mujoco.MjData], name: str, depth: bool = False) -> Any:
    try:
        return cameras.picture(*scene, name, depth=depth)
    except RendererError as missing:
        pytest.skip(str(missing))


@pytest.mark.parametrize("kind", ["rescue", "manipulation"])
def test_the_robots_have_their_cameras(kind: str) -> None:
    model = hurcules.models.load(kind)
    assert set(cameras.ROBOT_CAMERAS) <= set(cameras.names(model))
    for name in cameras.ROBOT_CAMERAS:
        camera = cameras.find(model, name)
        assert (camera.width, camera.height) == (1280, 720)


def test_the_head_has_a_wide_camera_and_a_stereo_pair(robot: mujoco.MjModel) -> None:
    # [robot#cameras]: 90 and 60 degrees across, 0.12 m apart
    wide, left = cameras.find(robot, "head_wide"), cameras.find(robot, "head_left")
    assert math.degrees(wide.field[0]) == pytest.approx(90, abs=0.05)
    assert math.degrees(left.field[0]) == pytest.approx(60, abs=0.05)
    assert cameras.baseline(robot) == pytest.approx(0.12)


def test_the_intrinsics_are_those_of_a_pinhole(robot: mujoco.MjModel) -> None:
    camera = cameras.find(robot, "head_wide")
    focal = 640 / math.tan(camera.field[0] / 2)
    wanted = [[focal, 0, 640], [0, focal, 360], [0, 0, 1]]
    np.testing.assert_allclose(camera.intrinsics, wanted, rtol=1e-12)


def test_the_auxiliary_camera_sees_the_hands(robot: mujoco.MjModel) -> None:
    data = mujoco.MjData(robot)
    mujoco.mj_resetDataKeyframe(robot, data, robot.keyframe("carry").id)
    mujoco.mj_forward(robot, data)
    camera = cameras.find(robot, "auxiliary")
    for hand in ("L_tcp", "R_tcp"):
        x, y = project(data, camera, data.site(hand).xpos)
        assert 0 < x < camera.width and 0 < y < camera.height


def project(data: mujoco.MjData, camera: cameras.Camera, point: np.ndarray) -> tuple[float, float]:
    """Pixel of a point in the world."""
    eye = data.camera(camera.name)
    x, y, z = eye.xmat.reshape(3, 3).T @ (point - eye.xpos)
    u, v, w = camera.intrinsics @ (x, -y, -z)  # x right, y down, z along the view
    assert w > 0
    return u / w, v / w


@pytest.mark.parametrize("name", ["eye", "lens"])
def test_a_ball_is_drawn_where_the_intrinsics_put_it(
    scene: tuple[mujoco.MjModel, mujoco.MjData], name: str
) -> None:
    model, data = scene
    colours = picture(scene, name).astype(float)
    assert colours.shape == (200, 320, 3)
    rows, columns = np.nonzero((colours[..., 0] > 100) & (colours[..., 2] < 60))
    assert len(rows) > 10
    u, v = project(data, cameras.find(model, name), data.geom("ball").xpos)
    assert np.mean(columns) + 0.5 == pytest.approx(u, abs=0.7)
    assert np.mean(rows) + 0.5 == pytest.approx(v, abs=0.7)


def test_depth_is_the_distance_along_the_view(
    scene: tuple[mujoco.MjModel, mujoco.MjData],
) -> None:
    depth = picture(scene, "eye", depth=True)
    assert depth.shape == (200, 320)
    assert depth[5, 5] == pytest.approx(4.0, rel=2e-3)  # the wall, also in the corner
    assert np.min(depth) == pytest.approx(1.97, rel=2e-3)  # the ball


def test_what_cannot_be_is_refused(robot: mujoco.MjModel) -> None:
    with pytest.raises(hurcules.Error, match=r"camera 'side' does not exist; there is none"):
        cameras.find(mujoco.MjModel.from_xml_string("<mujoco/>"), "side")
    with pytest.raises(hurcules.Error, match=r"camera .heed. does not exist; there are: .*head_w"):
        cameras.find(robot, "heed")
    with pytest.raises(hurcules.Error, match="different bodies"):
        cameras.baseline(robot, "head_left", "auxiliary")
    with pytest.raises(hurcules.Error, match="above 0, got 0 x 5"):
        cameras.picture(robot, mujoco.MjData(robot), "head_left", size=(0, 5))
