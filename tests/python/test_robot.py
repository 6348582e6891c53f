"""Robot and tasks from Python: names, shapes, lifetimes and messages.

Strategy: compare with MuJoCo's own functions on the same posture, and drive a small arm to a target
in closed loop. The mathematics is tested in tests/cpp/robot and tests/cpp/tasks, not again here.
"""

import gc
from pathlib import Path

import mujoco
import numpy as np
import pytest

from hurcules import _core

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body name="upper" pos="0 0 1">
      <joint name="yaw" axis="0 0 1" range="-2 2" limited="true"/>
      <joint name="pitch" axis="0 -1 0"/>
      <geom size="0.05" mass="2"/>
      <body name="fore" pos="0.4 0 0">
        <joint name="elbow" axis="0 -1 0"/>
        <geom name="fore_geom" size="0.04" mass="1"/>
        <body name="wrist" pos="0.3 0 0">
          <joint name="roll" axis="1 0 0"/>
          <geom size="0.03" mass="1"/>
          <site name="tip" pos="0.1 0 0"/>
          <camera name="eye" xyaxes="0 -1 0 0 0 1"/>
        </body>
      </body>
    </body>
  </worldbody>
  <custom><numeric name="velocity_limit_yaw" data="1.5"/></custom>
  <keyframe><key name="bent" qpos="0.2 -0.5 1.2 0.3"/></keyframe>
</mujoco>
"""
BENT = np.array([0.2, -0.5, 1.2, 0.3])


@pytest.fixture
def model() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(ARM)


@pytest.fixture
def robot(model: mujoco.MjModel) -> _core.Robot:
    robot = _core.Robot(model)
    robot.set_keyframe("bent")
    return robot


def test_coordinates_carry_names_and_limits(robot: _core.Robot) -> None:
    assert robot.size == 4
    assert robot.coordinate_names == ["yaw", "pitch", "elbow", "roll"]
    assert robot.coordinate("elbow") == 2
    yaw, pitch = robot.coordinates[:2]
    assert (yaw.name, yaw.lower, yaw.upper, yaw.max_velocity) == ("yaw", -2.0, 2.0, 1.5)
    assert (pitch.lower, pitch.max_velocity, pitch.max_effort) == (-np.inf, np.inf, np.inf)
    assert yaw.joints[0].joint == 0
    assert yaw.joints[0].factor == 1.0


def test_poses_and_jacobians_are_those_of_mujoco(model: mujoco.MjModel, robot: _core.Robot) -> None:
    data = mujoco.MjData(model)
    data.qpos[:] = BENT
    mujoco.mj_forward(model, data)
    linear, angular = np.zeros((3, model.nv)), np.zeros((3, model.nv))
    mujoco.mj_jacSite(model, data, linear, angular, model.site("tip").id)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)

    np.testing.assert_array_equal(robot.configuration, BENT)
    np.testing.assert_allclose(robot.position("tip"), data.site("tip").xpos, atol=1e-14)
    np.testing.assert_allclose(robot.orientation("eye").ravel(), data.camera("eye").xmat)
    np.testing.assert_allclose(robot.view_orientation("eye"), robot.orientation("wrist"))
    np.testing.assert_allclose(robot.position_jacobian("tip"), linear, atol=1e-14)
    np.testing.assert_allclose(robot.rotation_jacobian("tip"), angular, atol=1e-14)
    np.testing.assert_allclose(robot.com, data.subtree_com[1], atol=1e-14)
    np.testing.assert_allclose(robot.mass_matrix(), inertia, atol=1e-14)
    assert robot.com_jacobian().shape == (3, 4)
    np.testing.assert_array_equal(robot.coordinates_of(data.qpos), BENT)


def test_drifts_are_zero_at_rest_only(robot: _core.Robot) -> None:
    drifts = (robot.position_drift, robot.rotation_drift)
    assert all(not drift("tip").any() for drift in drifts)
    robot.set_velocity([1.0, 0.5, -0.5, 2.0])
    assert all(drift("tip").any() for drift in drifts)
    assert robot.com_drift().any()


def test_asking_does_not_touch_the_simulation(model: mujoco.MjModel, robot: _core.Robot) -> None:
    data = mujoco.MjData(model)
    robot.set_configuration(np.ones(4))
    assert not data.qpos.any()


def test_model_lives_as_long_as_the_robot() -> None:
    robot = _core.Robot(mujoco.MjModel.from_xml_string(ARM))
    gc.collect()
    trash = [mujoco.MjModel.from_xml_string("<mujoco/>") for _ in range(20)]
    robot.set_keyframe("bent")
    np.testing.assert_array_equal(robot.configuration, BENT)
    assert len(trash) == 20


@pytest.mark.parametrize("kind", [str, Path])
def test_model_comes_from_a_path(tmp_path: Path, kind: type) -> None:
    path = tmp_path / "arm.xml"
    path.write_text(ARM)
    assert _core.Robot(kind(path)).size == 4


def test_arrays_are_copies(robot: _core.Robot) -> None:
    before = robot.configuration
    before[:] = 7.0
    np.testing.assert_array_equal(robot.configuration, BENT)
    task = _core.PostureTask("posture", robot)
    task.error[:] = 1.0
    assert not task.error.any()


def test_wrong_input_says_what_was_wanted(robot: _core.Robot, tmp_path: Path) -> None:
    with pytest.raises(_core.Error, match=r"frame 'tpi' does not exist; there are: tip, world"):
        robot.position("tpi")
    with pytest.raises(_core.Error, match="set_qpos wants 4 numbers, 3 came"):
        robot.set_qpos(np.zeros(3))
    with pytest.raises(_core.Error, match="number 1 is nan"):
        robot.set_configuration([0.0, np.nan, 0.0, 0.0])
    with pytest.raises(_core.Error, match="does not exist"):
        _core.Robot(tmp_path / "none.xml")
    with pytest.raises(_core.Error, match=r"MjModel or the path of a model is wanted, a int came"):
        _core.Robot(3)
    assert issubclass(_core.Error, ValueError)


def make_tasks(robot: _core.Robot) -> list[_core.Task]:
    """One task of each kind."""
    arm = {"shoulder": "upper", "elbow": "fore", "wrist": "tip", "torso": "world"}
    return [
        _core.PositionTask("position", robot, "tip"),
        _core.PositionTask("height", robot, "tip", reference="fore", axes=[[0.0, 0.0, 1.0]]),
        _core.OrientationTask("orientation", robot, frame="tip", reference="upper"),
        _core.AngleTask("pitch", robot, "fore"),
        _core.AngleTask("heading", robot, "tip", kind=_core.AngleKind.Heading, axis=(1, 1, 0)),
        _core.SwivelTask("swivel", robot, **arm, direction=(0.0, 0.3, -1.0)),
        _core.GazeTask("gaze", robot, "eye"),
        _core.CenterOfMassTask("com", robot, reference="upper", axes=np.eye(3)[:2]),
        _core.PostureTask("posture", robot, ["roll", "yaw"]),
    ]


def test_tasks_have_the_documented_shapes(robot: _core.Robot) -> None:
    rows = {"position": 3, "orientation": 3, "gaze": 2, "com": 2, "posture": 2}
    for task in make_tasks(robot):
        m = rows.get(task.name, 1)
        assert task.rows == m
        assert task.jacobian.shape == (m, 4)
        for vector in (task.error, task.drift, task.velocity_des, task.lower, task.upper):
            assert vector.shape == (m,)
        assert repr(task) == f"Task('{task.name}', rows={m})"


def test_tasks_hold_advance_and_restore(robot: _core.Robot) -> None:
    for task in make_tasks(robot):
        np.testing.assert_allclose(task.error, 0.0, atol=1e-14)
        state = task.state()
        velocity = np.linspace(0.1, 0.3, task.rows)
        task.advance(velocity, 0.01)
        np.testing.assert_allclose(task.velocity_des, velocity, atol=1e-14)
        task.update(robot)
        np.testing.assert_allclose(task.error, -0.01 * velocity, atol=1e-14)
        task.restore(state)
        task.update(robot)
        np.testing.assert_allclose(task.error, 0.0, atol=1e-14)


def test_tasks_outlive_their_robot(model: mujoco.MjModel) -> None:
    task = _core.PositionTask("position", _core.Robot(model), "tip")
    gc.collect()
    task.update(_core.Robot(model))
    with pytest.raises(_core.Error, match="made for another robot"):
        task.update(_core.Robot(mujoco.MjModel.from_xml_string("<mujoco/>")))


def test_limits_are_narrowed_by_name(robot: _core.Robot) -> None:
    limits = _core.JointLimits("joint", robot)
    limits.set_range("yaw", -1.0, 0.5)
    most = limits.max_velocity.copy()
    limits.set_max_velocities(1e3)
    assert limits.max_velocity[0] == most[0] == 1.5  # the robot's own is smaller
    limits.set_max_velocities(np.inf)
    assert np.all(np.isinf(limits.max_velocity))
    limits.set_max_velocities(most)
    limits.set_max_velocity("yaw", 0.25)
    assert (limits.lower[0], limits.upper[0], limits.max_velocity[0]) == (-1.0, 0.5, 0.25)
    with pytest.raises(_core.Error, match="'yaw' wants lower <= upper within -2"):
        limits.set_range("yaw", -3.0, 0.5)
    state = limits.state()
    limits.reset_ranges()
    assert limits.upper[0] == 2.0
    limits.restore(state)
    assert limits.upper[0] == 0.5
    limits.set_interval(limits.lower, 0.5 * limits.upper)
    assert limits.upper[0] == 0.25
    limits.update(robot)
    np.testing.assert_array_equal(limits.error, robot.configuration)
    assert (limits.name, limits.rows) == ("joint", 4)
    assert not isinstance(limits, _core.Task)


def test_limits_come_first_and_alone_in_a_stack(robot: _core.Robot) -> None:
    limits, hand = _core.JointLimits("joint", robot), _core.PositionTask("hand", robot, "tip")
    named = _core.StackLevel("ranges", [limits])
    for levels in ([limits, hand], [[limits], hand], (limits, [hand])):
        assert str(_core.Stack(levels)) == "joint < hand"
    assert str(_core.Stack([named, hand])) == "ranges < hand"
    with pytest.raises(_core.Error, match="'joint' come first in a stack, not after 'hand'"):
        _core.Stack([hand, limits])
    with pytest.raises(_core.Error, match="stand alone on their level"):
        _core.Stack([[limits, hand]])
    with pytest.raises(_core.Error, match="a level wants tasks, a JointLimits came"):
        _core.StackLevel("both", [limits, hand])


def test_less_than_points_to_stack(robot: _core.Robot) -> None:
    first, second = _core.JointLimits("joint", robot), make_tasks(robot)[0]
    with pytest.raises(TypeError, match=r"Stack\(\[a, b, c\]\)"):
        first < second  # noqa: B015
    with pytest.raises(TypeError, match=r"Stack"):
        second > first  # noqa: B015


def test_closed_loop_reaches_the_target(robot: _core.Robot) -> None:
    task = _core.PositionTask("position", robot, "tip")
    task.set_target(task.target + np.array([-0.15, 0.1, 0.1]))
    for _ in range(300):
        task.update(robot)
        velocity = np.linalg.lstsq(task.jacobian, task.velocity_des - 5.0 * task.error, rcond=None)
        robot.set_configuration(robot.configuration + 0.02 * velocity[0])
    np.testing.assert_allclose(robot.position("tip"), task.target, atol=1e-9)
