"""Robots that others made, from the packages that carry them: the same few lines for all of them.

Strategy: a fixed arm (Fetch, on a base that slides), a fixed seven-joint arm (gymnasium's pusher)
and a humanoid (gymnasium's) reach for a place found by moving their joints, so that it can be
reached, while a second hand's place is metres away. What must hold: the first hand arrives to a
millimetre, no limit is passed on the way, every answer is proven. Not tested here: speed
(benchmarks/inverse_kinematics).
"""

from __future__ import annotations

import importlib.util
import warnings
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import JointLimits, PositionTask, PostureTask, Stack, rhqp


@dataclass(frozen=True)
class Subject:
    """A robot, and the frames that reach: the first may be reached, all others are sent away."""

    package: str
    file: str
    hands: tuple[str, ...]

    def robot(self) -> hurcules.Robot:
        """Loads it."""
        spec = importlib.util.find_spec(self.package)
        assert spec is not None and spec.origin is not None, self.package
        path = Path(spec.origin).parent / self.file
        return hurcules.Robot(mujoco.MjModel.from_xml_path(str(path)))


SUBJECTS = [
    Subject("gymnasium_robotics", "envs/assets/fetch/reach.xml", ("robot0:grip",)),
    Subject("gymnasium", "envs/mujoco/assets/pusher_v5.xml", ("tips_arm",)),
    Subject(
        "gymnasium",
        "envs/mujoco/assets/humanoid.xml",
        ("right_hand", "left_hand", "right_foot", "left_foot"),
    ),
]


def middle(limits: JointLimits) -> np.ndarray:
    """A posture amid all ranges, (n,)."""
    lower, upper = np.clip(limits.lower, -1.0, 1.0), np.clip(limits.upper, -1.0, 1.0)
    return (lower + upper) / 2


def place_within_reach(
    robot: hurcules.Robot, limits: JointLimits, hand: str, seed: int
) -> np.ndarray:
    """Where the hand is after a fifth of the way to a random posture."""
    rng, q = np.random.default_rng(seed), middle(limits)
    lower, upper = np.clip(limits.lower, -1.0, 1.0), np.clip(limits.upper, -1.0, 1.0)
    robot.set_configuration(q + 0.2 * (rng.uniform(lower, upper) - q))
    place = robot.position(hand)
    robot.set_configuration(q)
    return place


@pytest.mark.parametrize("subject", SUBJECTS, ids=lambda one: Path(one.file).stem)
@pytest.mark.parametrize("seed", range(3))
def test_the_first_hand_arrives_whatever_the_others_are_asked_for(
    subject: Subject, seed: int
) -> None:
    robot = subject.robot()
    limits = JointLimits("limits", robot)
    wanted = place_within_reach(robot, limits, subject.hands[0], seed)
    hands = [PositionTask(name, robot, name) for name in subject.hands]
    posture = PostureTask("posture", robot)
    hands[0].set_target(wanted)
    for hand in hands[1:]:
        hand.set_target(hand.value + np.array([5.0, 3.0, -4.0]))
    controller = hurcules.VelocityController(robot)
    controller.set_stack(Stack([limits, *hands, posture]))
    worst = 0.0
    for _ in range(6000):
        q = controller.step(robot)
        worst = max(worst, np.max(limits.lower - q), np.max(q - limits.upper))
        assert controller.solution.status == rhqp.Status.Solved
    assert worst <= 0.0
    assert np.linalg.norm(robot.position(subject.hands[0]) - wanted) < 1e-3


@pytest.mark.parametrize("subject", SUBJECTS[:2], ids=lambda one: Path(one.file).stem)
@pytest.mark.parametrize(
    ("by", "dt"),
    [*product(["velocities", "accelerations"], [0.001, 0.005, 0.025]), ("velocities", 0.05)],
)
def test_by_default_a_hand_arrives_and_all_comes_to_rest(
    subject: Subject, dt: float, by: str
) -> None:
    robot = subject.robot()
    limits = JointLimits("limits", robot)
    lower, upper = np.maximum(limits.lower, -1.5), np.minimum(limits.upper, 1.5)
    start = np.clip(robot.configuration, lower, upper)
    # with seed 5 the pusher ends at its limits, 9 mm off, without the posture too
    way = np.random.default_rng(0).uniform(lower, upper) - start
    robot.set_configuration(start + 0.3 * way)
    wanted = robot.position(subject.hands[0])
    robot.set_configuration(start)  # the pusher's arm is straight here
    hand = PositionTask("hand", robot, subject.hands[0])
    hand.set_target(wanted)
    if by == "velocities":
        controller = hurcules.VelocityController(robot, hurcules.VelocityControllerOptions(dt=dt))
    else:
        controller = hurcules.AccelerationController(
            robot, hurcules.AccelerationControllerOptions(dt=dt)
        )
    controller.set_stack(Stack([limits, hand, PostureTask("posture", robot)]))
    last, hardest = robot.configuration, 0.0
    speed = np.zeros(robot.size)
    for _ in range(round(10 / dt)):
        q = controller.step(robot)
        before, speed, last = speed, (q - last) / dt, q
        hardest = max(hardest, float(np.abs(speed - before).max()))
    assert np.linalg.norm(robot.position(subject.hands[0]) - wanted) < 1e-3
    assert np.abs(speed).max() < 0.01
    assert hardest <= 20.0 * dt * (1 + 1e-6)


def chain(rng: np.random.Generator, joints: int) -> hurcules.Robot:
    """An arm of capsules, its hinges about axes drawn, 0.4 to 2 rad to each side."""
    text, length = "", 0.0
    for i in range(joints):
        axis = np.eye(3, dtype=int)[rng.integers(3)]
        reach, start, length = rng.uniform(0.4, 2.0), length, rng.uniform(0.05, 0.25)
        text += f"""<body pos="{start} 0 0">
          <joint name="j{i}" axis="{axis[0]} {axis[1]} {axis[2]}" range="-{reach} {reach}"/>
          <geom type="capsule" fromto="0 0 0 {length} 0 0" size="0.02" mass="0.2"/>"""
    text += f'<site name="tip" pos="{length} 0 0"/>' + "</body>" * joints
    start = f'<mujoco><compiler angle="radian"/><worldbody>{text}</worldbody></mujoco>'
    return hurcules.Robot(mujoco.MjModel.from_xml_string(start))


@pytest.mark.parametrize("by", ["velocities", "accelerations"])
def test_an_orientation_out_of_reach_below_a_place_comes_to_rest(by: str) -> None:
    """Of these 12 arms 4 went on by more than 0.05 rad/s, by velocities as by accelerations.

    An end of reach along the curve that keeps the hand's place passed for a saddle, where no zone
    stops a level; and where a row is all but lost the posture below turned ever faster. Two and one
    still do.
    """
    moving = []
    for seed in range(12):
        rng = np.random.default_rng(seed)
        robot = chain(rng, int(rng.integers(6, 21)))
        robot.set_configuration(rng.uniform(-0.3, 0.3, robot.size))
        hand = PositionTask("hand", robot, "tip")
        turn = hurcules.OrientationTask("turn", robot, "tip")
        axis = rng.normal(size=3)
        quat, matrix = np.empty(4), np.empty(9)
        angle = rng.uniform(1.5, 3.1)
        mujoco.mju_axisAngle2Quat(quat, axis / np.linalg.norm(axis), angle)
        mujoco.mju_quat2Mat(matrix, quat)
        turn.set_target(matrix.reshape(3, 3) @ robot.orientation("tip"))
        levels = [JointLimits("limits", robot), hand, turn, PostureTask("posture", robot)]
        if by == "velocities":
            controller = hurcules.VelocityController(robot)
        else:
            controller = hurcules.AccelerationController(robot)
        controller.set_stack(Stack(levels))
        for _ in range(14000):
            last = controller.step(robot)
        hardest = 0.0
        for _ in range(2000):
            q = controller.step(robot)
            hardest, last = max(hardest, float(np.abs(q - last).max()) / 1e-3), q
        assert np.linalg.norm(hand.error) < 1e-3
        if hardest > 0.05:
            moving.append((seed, hardest, float(np.linalg.norm(turn.error))))
    assert len(moving) <= 2, moving


def test_fingers_that_start_at_their_stops_arrive() -> None:
    """Servos whose controls end with their joints' ranges have nothing to give towards these ends.

    1e-8 N m that one lacked there held the whole hand, 49 of 89 mm off.
    """
    spec = importlib.util.find_spec("gymnasium_robotics")
    assert spec is not None and spec.origin is not None
    path = Path(spec.origin).parent / "envs/assets/adroit_hand/adroit_door.xml"
    model = mujoco.MjModel.from_xml_path(str(path))
    robot = hurcules.Robot(model)
    limits, start = JointLimits("limits", robot), robot.configuration
    way = np.random.default_rng(0).uniform(limits.lower, limits.upper) - start
    robot.set_configuration(start + 0.2 * way)
    wanted = robot.position("S_grasp")
    robot.set_configuration(start)
    hand = PositionTask("hand", robot, "S_grasp")
    hand.set_target(wanted)
    controller = hurcules.WholeBodyController(robot, [hand, PostureTask("posture", robot)])
    with pytest.warns(UserWarning, match="motors cannot hold the weight on them"):
        simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(round(5.0 / simulation.dt))
    assert np.linalg.norm(simulation.data.site("S_grasp").xpos - wanted) < 1e-3


def test_a_weight_that_is_rounding_is_none() -> None:
    # "motors cannot hold ... (8.71e-16 of 0 N m)": fingers whose servos push one way alone
    finger = """<body euler="37 0 0" pos="{side} 0 0">
        <joint name="{name}" axis="0 {axis}" range="0 60"/>
        <geom size="0.05" pos="0.2 0.1 0" mass="1"/></body>"""
    upright = "0.601815023152048 0.798635510047293"
    fingers = finger.format(name="a", side=1, axis=upright) + finger.format(
        name="b", side=-1, axis=" ".join(f"-{part}" for part in upright.split())
    )
    text = f"""<mujoco><worldbody><body><joint name="lift" type="slide" axis="0 0 1"/>
        <geom size="0.05" mass="3"/>{fingers}</body></worldbody><actuator>
        <motor joint="lift"/><position joint="a" kp="10" ctrlrange="0 1"/>
        <position joint="b" kp="10" ctrlrange="0 1"/></actuator></mujoco>"""
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model)
    controller = hurcules.WholeBodyController(robot, [PostureTask("posture", robot)])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        hurcules.Simulation(model=model, controller=controller)


def test_a_frame_that_does_not_exist_is_named_with_those_that_do() -> None:
    robot = SUBJECTS[0].robot()
    with pytest.raises(hurcules.Error, match=r"'gripper' does not exist; there are: .*robot0:grip"):
        PositionTask("hand", robot, "gripper")
