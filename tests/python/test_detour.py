"""`hurcules.Detour`: by another posture to where a controller rests short of its targets."""

import re
from collections.abc import Callable

import mujoco
import numpy as np
import pytest

import hurcules
from test_inverse_kinematics import ARM, START, hand_at

AROUND = (-2.4, -0.2)  # the hand is there the short way through what the first link cannot pass
DT = 0.005
Make = Callable[[hurcules.Robot], hurcules.VelocityController | hurcules.AccelerationController]


def velocities(robot: hurcules.Robot) -> hurcules.VelocityController:
    return hurcules.VelocityController(robot, hurcules.VelocityControllerOptions(dt=DT))


def accelerations(robot: hurcules.Robot) -> hurcules.AccelerationController:
    return hurcules.AccelerationController(robot, hurcules.AccelerationControllerOptions(dt=DT))


@pytest.fixture
def robot() -> hurcules.Robot:
    made = hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))
    made.set_configuration(START)
    return made


def run(
    robot: hurcules.Robot,
    controller: hurcules.VelocityController | hurcules.AccelerationController,
    detour: hurcules.Detour,
    seconds: float = 10.0,
) -> list[str]:
    said: list[str] = []
    for _ in range(round(seconds / DT)):
        controller.step(robot)
        said += filter(None, [detour.look(controller)])
    return said


@pytest.mark.parametrize("make", [velocities, accelerations])
def test_the_hand_arrives_by_another_posture(robot: hurcules.Robot, make: Make) -> None:
    hand, limits = hand_at(robot, AROUND), hurcules.JointLimits("limits", robot)
    detour = hurcules.Detour(robot, [limits], [hand], [hurcules.PostureTask("posture", robot)])
    controller = make(robot)
    controller.set_stack(detour.stacks["direct"])
    before, jump, said = np.zeros(2), 0.0, []
    for _ in range(round(15.0 / DT)):
        q = controller.step(robot)
        said += filter(None, [detour.look(controller)])
        now = np.array(controller.velocity)
        jump, before = max(jump, float(np.abs(now - before).max())), now
        assert np.all(q <= limits.upper) and np.all(q >= limits.lower)
    hand.update(robot)
    assert np.linalg.norm(hand.error) < 1e-4
    assert said[0].startswith("hand rests 0.39") and "goes round by another posture" in said[0]
    assert said[1:] == ["the posture is reached; the targets rule again"]
    assert jump <= 20.0 * DT * (1 + 1e-9)  # max_acceleration, through both changes


def test_a_target_in_reach_never_leads_away(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, (1.5, 0.5))
    detour, controller = hurcules.Detour(robot, [], [hand]), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    assert run(robot, controller, detour) == [] and not detour.on_the_way
    hand.update(robot)
    assert np.linalg.norm(hand.error) < 1e-4


def test_out_of_reach_it_searches_once_and_again_for_another_target(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    there = hand.target
    hand.set_target([0.0, 1.4])
    detour, controller = hurcules.Detour(robot, [], [hand], starts=4), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    said = run(robot, controller, detour)
    assert said == ["hand rests 0.4 short; none of 4 descents finds a posture for all targets"]
    assert np.abs(controller.velocity).max() < 1e-3  # at rest, as near as it gets
    robot.set_configuration(START)
    controller.reset()
    hand.set_target(there)
    assert len(run(robot, controller, detour, 15.0)) == 2
    hand.update(robot)
    assert np.linalg.norm(hand.error) < 1e-4


def test_a_target_that_moves_ends_the_detour(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    detour, controller = hurcules.Detour(robot, [], [hand]), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    while not detour.on_the_way:
        run(robot, controller, detour, DT)
    run(robot, controller, detour, 0.3)
    assert detour.on_the_way
    near = np.array([0.0, 0.9])
    hand.set_target(near)
    assert run(robot, controller, detour, DT) == ["a target moved; the targets rule again"]
    run(robot, controller, detour, 5.0)
    assert robot.position("hand")[:2] == pytest.approx(near, abs=1e-4)


def test_what_comes_before_bars_the_way() -> None:
    # the post stands between the two postures, and a search looks at postures alone
    text = ARM.replace('pos="-0.1 -0.5 0"', 'pos="0.6 0 0"')
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(text))
    robot.set_configuration(START)
    hand, post = hand_at(robot, AROUND), hurcules.obstacles(robot)
    detour, controller = hurcules.Detour(robot, [post], [hand]), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    said = run(robot, controller, detour, 15.0)
    assert len(said) == 2 and said[1].startswith("barred, ")
    assert np.abs(controller.velocity).max() < 1e-3
    assert run(robot, controller, detour) == []


class Physics:
    """The arm without the post and without weight, its hand led by a whole-body controller."""

    def __init__(self) -> None:
        text = re.sub('<body name="post".*', "", ARM)
        text = text.replace("<worldbody>", '<option timestep="0.002" gravity="0 0 0"/><worldbody>')
        model = mujoco.MjModel.from_xml_string(text.replace("<joint ", '<joint damping="0.1" '))
        robot = hurcules.Robot(model)
        self.hand = hand_at(robot, AROUND)
        posture = hurcules.PostureTask("posture", robot)
        self.detour = hurcules.Detour(robot, [], [self.hand], [posture])
        self.controller = hurcules.WholeBodyController(robot, stacks=self.detour.stacks)
        self.simulation = hurcules.Simulation(model=model, controller=self.controller)

    def step(self) -> str:
        """A tick, and what was decided in it."""
        self.simulation.step(1)
        return self.detour.look(self.controller)


def test_a_whole_body_controller_goes_round_in_the_physics() -> None:
    arm = Physics()
    said = [one for one in (arm.step() for _ in range(7500)) if one]
    assert len(said) == 2 and arm.controller.active == "direct"
    place = arm.simulation.data.site("hand").xpos[:2]
    assert place == pytest.approx(arm.hand.target, abs=2e-3)


def test_a_reset_on_the_way_ends_the_detour() -> None:
    arm = Physics()
    while not arm.detour.on_the_way:
        arm.step()
    assert arm.controller.active == "detour"
    arm.simulation.reset()
    assert arm.controller.active == "direct"
    assert arm.step() == "" and not arm.detour.on_the_way


def test_what_is_no_detour(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    with pytest.raises(hurcules.Error, match="wants at least one task as a target"):
        hurcules.Detour(robot, [hand], [])
    with pytest.raises(hurcules.Error, match="starts wants a number >= 1, got 0"):
        hurcules.Detour(robot, [], [hand], starts=0)
    with pytest.raises(hurcules.Error, match="tolerance wants a positive number, got nan"):
        hurcules.Detour(robot, [], [hand], tolerance=float("nan"))
    with pytest.raises(hurcules.Error, match="stands twice"):
        hurcules.Detour(robot, [hand], [hand])
