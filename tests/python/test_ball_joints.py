"""An arm with a ball joint in its shoulder, from Python.

Strategy: it reaches places and poses that were made by turning its joints, in MuJoCo, by
velocities, accelerations and torques, and rests there; the range of the ball joint is kept. Then
what else goes by coordinates: steps, postures, motors, inverse kinematics, and what is refused.
Jacobians and dynamics are compared in C++ (OfMuJoCo, BallJoint).
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules

LIMIT = 1.2  # [rad] of the shoulder
ARM = f"""<mujoco><compiler angle="radian" autolimits="true"/><option timestep="0.001"/>
<default><geom contype="0" conaffinity="0"/></default><worldbody>
  <body name="upper" pos="0 0 1" euler="0.3 0.2 -0.4">
    <joint name="shoulder" type="ball" range="0 {LIMIT}" damping="0.5"/>
    <geom type="capsule" fromto="0 0 0 0 0 -0.35" size="0.04" mass="2"/>
    <body name="fore" pos="0 0 -0.35"><joint name="elbow" axis="0 1 0" range="-2.4 0"/>
      <geom type="capsule" fromto="0 0 0 0 0 -0.3" size="0.03" mass="1.2"/>
      <body name="hand" pos="0 0 -0.3"><joint name="roll" axis="0 0 1" range="-2 2"/>
        <joint name="tilt" axis="1 0 0" range="-1 1"/>
        <geom type="box" pos="0.02 0 -0.05" size="0.05 0.02 0.06" mass="0.4"/>
        <site name="tip" pos="0.03 0.01 -0.1"/></body></body></body></worldbody></mujoco>"""
START = np.array([0.3, -0.4, 0.2, -1.2, 0.1, 0.2])
GOAL = np.array([-0.5, 0.4, 0.6, -0.7, -0.6, 0.3])


@pytest.fixture(scope="module")
def model() -> mujoco.MjModel:
    """The arm, with a motor about each axis of its joints."""
    return hurcules.with_motors(mujoco.MjSpec.from_string(ARM), peak=60.0)


@pytest.fixture
def robot(model: mujoco.MjModel) -> hurcules.Robot:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    return robot


def pose(model: mujoco.MjModel, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Place and orientation of the tip, (3,) [m] and (3, 3)."""
    probe = hurcules.Robot(model)
    probe.set_configuration(q)
    return probe.position("tip"), probe.orientation("tip")


def angle(data: mujoco.MjData) -> float:
    """How far the shoulder has turned [rad]."""
    return 2.0 * float(np.arccos(min(1.0, abs(data.joint("shoulder").qpos[0]))))


def test_a_ball_joint_is_three_coordinates(robot: hurcules.Robot) -> None:
    names = ["shoulder_rx", "shoulder_ry", "shoulder_rz", "elbow", "roll", "tilt"]
    assert robot.coordinate_names == names
    assert robot.left_out == ""
    assert [one.joints[0].part for one in robot.coordinates] == [3, 4, 5, -1, -1, -1]
    assert robot.configuration == pytest.approx(START)
    assert robot.qpos[0] == pytest.approx(np.cos(np.linalg.norm(START[:3]) / 2))


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
@pytest.mark.parametrize("turns", [False, True], ids=["position", "pose"])
def test_the_hand_arrives_in_the_physics_and_rests(
    model: mujoco.MjModel, robot: hurcules.Robot, control: str, turns: bool
) -> None:
    place, orientation = pose(model, GOAL)
    if turns:
        hand = hurcules.PoseTask("hand", robot, "tip")
    else:
        hand = hurcules.PositionTask("hand", robot, "tip")
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [hand, posture], control=control)
    simulation = hurcules.Simulation(model=model, controller=controller)
    if turns:
        hand.set_target(place, orientation)
    else:
        hand.set_target(place)
    simulation.step(6000)
    data = simulation.data
    mujoco.mj_forward(model, data)
    tip = data.site("tip")
    assert np.linalg.norm(tip.xpos - place) < 1e-4
    if turns:
        assert np.abs(tip.xmat.reshape(3, 3) - orientation).max() < 1e-4
    assert np.abs(data.qvel).max() < 1e-3


@pytest.mark.parametrize("control", ["velocity", "torque"])
@pytest.mark.parametrize("posture", [False, True], ids=["alone", "posture"])
def test_the_range_of_a_ball_joint_is_kept(
    model: mujoco.MjModel, robot: hurcules.Robot, control: str, posture: bool
) -> None:
    hand = hurcules.PositionTask("hand", robot, "tip")
    below = [hurcules.PostureTask("posture", robot)] if posture else []
    controller = hurcules.WholeBodyController(robot, [hand, *below], control=control)
    simulation = hurcules.Simulation(model=model, controller=controller)
    hand.set_target([0.3, 0.2, 2.0])  # above the shoulder, from which the arm hangs
    worst = 0.0
    for _ in range(800):
        simulation.step(10)
        worst = max(worst, angle(simulation.data))
    assert LIMIT - 0.02 < worst < LIMIT + 2e-3
    assert any(
        "shoulder" in str(one) for level in controller.diagnostics() for one in level.shortfalls
    )
    simulation.step(8000)
    assert np.abs(simulation.data.qvel).max() < 1e-3


def test_a_step_is_a_turn_about_the_axes_of_the_body(
    model: mujoco.MjModel, robot: hurcules.Robot
) -> None:
    velocity = np.array([0.5, -1.0, 2.0, 0.3, 0.1, -0.2])
    ahead = robot.qpos
    mujoco.mj_integratePos(model, ahead, velocity, 0.4)
    assert robot.coordinates_of(ahead) == pytest.approx(
        robot.add_step(robot.configuration, 0.4 * velocity), abs=1e-12
    )
    assert robot.velocities_of(velocity) == pytest.approx(velocity)
    with pytest.raises(hurcules.Error, match="add_step wants q and step of 6 values, 6 and 2"):
        robot.add_step(START, [0.0, 1.0])


def test_a_posture_is_reached_by_rotation_vectors(robot: hurcules.Robot) -> None:
    posture = hurcules.PostureTask("posture", robot)
    posture.set_target(GOAL)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([posture]))
    for _ in range(6000):
        controller.step(robot)
    assert robot.configuration == pytest.approx(GOAL, abs=1e-9)


def test_inverse_kinematics_keeps_the_range(model: mujoco.MjModel, robot: hurcules.Robot) -> None:
    hand = hurcules.PoseTask("hand", robot, "tip")
    hand.set_target(*pose(model, GOAL))
    found = hurcules.inverse_kinematics(robot, [hand])
    assert found.reached
    assert np.linalg.norm(found.configuration[:3]) < LIMIT + 1e-12
    hand.set_target(pose(model, GOAL)[0] + [0.0, 0.0, 2.0], pose(model, GOAL)[1])
    found = hurcules.inverse_kinematics(robot, [hand], starts=4)
    assert not found.reached
    assert np.linalg.norm(found.configuration[:3]) < LIMIT + 1e-12


def test_what_a_part_of_a_ball_joint_is_not(model: mujoco.MjModel, robot: hurcules.Robot) -> None:
    with pytest.raises(hurcules.Error, match="wanted together and in their order, as 'shoulder'"):
        hurcules.Robot(model, joints=["elbow", "shoulder_ry"])
    limits = hurcules.JointLimits("limits", robot)
    with pytest.raises(hurcules.Error, match=r"'shoulder_rx' is one of three.*no range of its own"):
        limits.set_range("shoulder_rx", -0.1, 0.1)
    with pytest.warns(UserWarning, match="'shoulder' turned by 1.386, limit 1.2"):
        robot.set_configuration([0.8, 0.8, 0.8, -1.0, 0.0, 0.0])
    one = mujoco.MjSpec.from_string(ARM)
    one.add_actuator(name="one", target="shoulder", trntype=mujoco.mjtTrn.mjTRN_JOINT)
    led = hurcules.Robot(hurcules.with_motors(one))
    assert led.coordinate_names[:3] == robot.coordinate_names[:3]
    with pytest.raises(hurcules.Error, match=r"'shoulder' wants three actuators.*'shoulder_ry'"):
        hurcules.WholeBodyController(led, [hurcules.PostureTask("posture", led)])
