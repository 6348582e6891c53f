"""Robots that others made, from the packages that carry them: the same few lines for all of them.

Strategy: a fixed arm (Fetch, on a base that slides), a fixed seven-joint arm (gymnasium's pusher)
and a humanoid (gymnasium's) reach for a place found by moving their joints, so that it can be
reached, while a second hand's place is metres away. What must hold: the first hand arrives to a
millimetre, no limit is passed on the way, every answer is proven. Not tested here: speed
(benchmarks/inverse_kinematics).
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
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
@pytest.mark.parametrize("dt", [0.001, 0.005, 0.025])
@pytest.mark.parametrize("by", ["velocities", "accelerations"])
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


def test_a_frame_that_does_not_exist_is_named_with_those_that_do() -> None:
    robot = SUBJECTS[0].robot()
    with pytest.raises(hurcules.Error, match=r"'gripper' does not exist; there are: .*robot0:grip"):
        PositionTask("hand", robot, "gripper")
