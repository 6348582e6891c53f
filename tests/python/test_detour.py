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
    assert said[0].startswith("hand: 0.4") and "goes round by another posture" in said[0]
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
    none = "none of 4 descents finds a posture for all targets, or a nearer one"
    assert said == [f"hand: 0.4 m short; {none}"]
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
    while not detour.on_the_way:
        run(robot, controller, detour, DT)
    rested = robot.configuration
    said = run(robot, controller, detour, 15.0)
    assert said[0].startswith("barred, ") and said[0].endswith(" before the posture; goes back")
    assert said[1:] == ["it is back; the targets rule again"]
    assert np.abs(controller.velocity).max() < 1e-3
    assert robot.configuration == pytest.approx(rested, abs=5e-3)
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


def test_a_state_restored_on_the_way_goes_back_to_the_targets() -> None:
    arm = Physics()
    while not arm.detour.on_the_way:
        arm.step()
    saved = arm.simulation.state()
    arm.simulation.reset()
    arm.step()
    arm.simulation.restore(saved)
    assert arm.controller.active == "detour"
    arm.step()
    assert arm.controller.active == "direct"


def test_a_controller_without_its_stacks_is_refused(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    detour = hurcules.Detour(robot, [], [hand])
    controller = hurcules.WholeBodyController(robot, stacks={"reach": detour.stacks["direct"]})
    with pytest.raises(hurcules.Error, match="has no stack 'detour', it has reach"):
        detour.look(controller)


@pytest.mark.parametrize("speed", [0.0005, 0.002, 0.05])
def test_a_hand_that_is_to_go_slowly_does_not_rest(robot: hurcules.Robot, speed: float) -> None:
    hand = hand_at(robot, (2.0, 0.5))
    hand.set_max_speed(speed)
    detour, controller = hurcules.Detour(robot, [], [hand]), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    assert run(robot, controller, detour, 5.0) == []


def test_a_hand_that_starts_slowly_does_not_rest(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, START)
    options = hurcules.VelocityControllerOptions(dt=0.001, max_acceleration=0.1)
    controller = hurcules.VelocityController(robot, options)
    detour = hurcules.Detour(robot, [], [hand])
    controller.set_stack(detour.stacks["direct"])
    said = []
    for tick in range(3000):
        if tick == 500:  # it has rested until now
            hand.set_target(hand_at(robot, (2.0, 0.5)).target)
        controller.step(robot)
        said += filter(None, [detour.look(controller)])
    assert said == []


def test_a_slow_hand_finds_its_posture_and_goes_there_slowly(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    hand.set_max_speed(0.05)
    assert hurcules.inverse_kinematics(robot, [hand]).reached
    assert hand.max_speed == 0.05
    detour, controller = hurcules.Detour(robot, [], [hand]), velocities(robot)
    detour.posture.set_max_speed(0.3)
    controller.set_stack(detour.stacks["direct"])
    said = run(robot, controller, detour, 60.0)
    assert len(said) == 2 and said[1].startswith("the posture is reached")


def test_a_base_that_was_driven_nearer_looks_again() -> None:
    text = re.sub('<body name="post".*', "", ARM)
    text = text.replace(
        "<worldbody>", '<worldbody><body name="cart"><freejoint/><geom size="0.1"/>'
    )
    robot = hurcules.Robot(
        mujoco.MjModel.from_xml_string(text.replace("</worldbody>", "</body></worldbody>"))
    )
    robot.set_configuration(START)
    hand = hand_at(robot, AROUND)
    away, home = robot.qpos, robot.qpos
    away[0] = -5.0
    robot.set_qpos(away)
    detour, controller = hurcules.Detour(robot, [], [hand]), velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    said = run(robot, controller, detour, 20.0)
    assert len(said) == 1 and "none of 32" in said[0]
    robot.set_qpos(home)
    controller.reset()
    assert len(run(robot, controller, detour, 20.0)) == 2
    hand.update(robot)
    assert np.linalg.norm(hand.error) < 1e-4


def test_what_is_no_detour(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, AROUND)
    with pytest.raises(hurcules.Error, match="wants at least one task as a target"):
        hurcules.Detour(robot, [hand], [])
    with pytest.raises(hurcules.Error, match="starts wants a number >= 1, got 0"):
        hurcules.Detour(robot, [], [hand], starts=0)
    with pytest.raises(hurcules.Error, match="tolerance wants a positive number, got nan"):
        hurcules.Detour(robot, [], [hand], tolerance=float("nan"))
    with pytest.raises(hurcules.Error, match="rate wants a positive number, got inf"):
        hurcules.Detour(robot, [], [hand], rate=np.inf)
    with pytest.raises(hurcules.Error, match="2 finite numbers, got 2, not all finite"):
        hurcules.Detour(robot, [], [hand]).look_at(robot, [0.0, np.nan], 0.001)
    with pytest.raises(hurcules.Error, match="stands twice"):
        hurcules.Detour(robot, [hand], [hand])


# two poses that Hurcules cannot both have; the far hand ends in a minimum 0.3 m beyond another one
NEAR = (
    [[0.819, 0.312, 0.482], [0.193, 0.641, -0.743], [-0.541, 0.701, 0.465]],
    [1.159, -0.206, 0.261],
)
FAR = [[0.778, -0.553, 0.299], [0.589, 0.475, -0.654], [0.22, 0.685, 0.695]], [0.369, -0.386, 1.142]


def test_of_a_robot_on_its_feet_the_far_hand_comes_nearer_by_another_posture() -> None:
    robot = hurcules.Robot(hurcules.models.load("manipulation"))
    robot.set_keyframe("ready")
    robot.stand_on("lower_leg_L")
    hands = []
    for name, (turn, place) in (("R_tcp", NEAR), ("L_tcp", FAR)):
        a, _, b = np.linalg.svd(turn)  # the nearest rotation to three decimals
        hands.append(hurcules.PoseTask(name, robot, name))
        hands[-1].set_target(np.array(place), a @ b)
    limits = hurcules.JointLimits("limits", robot)
    detour = hurcules.Detour(robot, [limits], hands, [hurcules.PostureTask("posture", robot)])
    controller = velocities(robot)
    controller.set_stack(detour.stacks["direct"])
    said = run(robot, controller, detour, 5.0)
    assert said == [] and np.linalg.norm(hands[1].error) > 0.55
    said = run(robot, controller, detour, 15.0)
    assert len(said) == 2 and "goes round by another posture, nearer by 0.3" in said[0]
    assert said[1] == "the posture is reached; the targets rule again"
    assert np.linalg.norm(hands[1].error) < 0.26 and np.linalg.norm(hands[0].error) < 1e-5
