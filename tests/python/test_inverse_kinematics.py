"""`hurcules.inverse_kinematics`: postures that a controller does not reach in one go."""

import pickle

import mujoco
import numpy as np
import pytest

import hurcules
from closed_chains import FIVE_BAR

# two links of 0.5 m in a plane; the first turns by 2.6 rad to either side
ARM = """<mujoco><compiler angle="radian"/><worldbody>
<body name="upper"><joint name="shoulder" axis="0 0 1" limited="true" range="-2.6 2.6"/>
<geom type="capsule" fromto="0 0 0 0.5 0 0" size="0.03"/>
<body name="lower" pos="0.5 0 0">
<joint name="elbow" axis="0 0 1" limited="true" range="-2.5 2.5"/>
<geom type="capsule" fromto="0 0 0 0.45 0 0" size="0.03"/><site name="hand" pos="0.5 0 0"/></body>
</body>
<body name="post" pos="-0.1 -0.5 0"><geom type="cylinder" size="0.1 0.3"/></body>
</worldbody><actuator><motor joint="shoulder"/><motor joint="elbow"/></actuator></mujoco>"""
START = (2.5, 0.1)


@pytest.fixture
def robot() -> hurcules.Robot:
    made = hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))
    made.set_configuration(START)
    return made


def hand_at(robot: hurcules.Robot, posture: tuple[float, float]) -> hurcules.PositionTask:
    """The hand shall be where it is at this posture, in the plane."""
    task = hurcules.PositionTask("hand", robot, "hand", axes=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    robot.set_configuration(posture)
    target = robot.position("hand")[:2]
    robot.set_configuration(START)
    task.set_target(target)
    return task


def test_the_shoulder_goes_the_long_way_round_where_a_controller_meets_its_limit(
    robot: hurcules.Robot,
) -> None:
    hand = hand_at(robot, (-2.4, -0.2))  # through what the first link cannot pass
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([hand]))
    for _ in range(5000):
        controller.step(robot)
    hand.update(robot)
    assert np.linalg.norm(hand.error) > 0.05

    robot.set_configuration(START)
    found = hurcules.inverse_kinematics(robot, [hand])
    assert found.reached and found.error <= 1e-4
    assert found.starts[1] >= 1 and found.configuration[0] < 0.0
    robot.set_configuration(found.configuration)
    hand.update(robot)
    assert np.abs(hand.error).max() == pytest.approx(found.error, abs=1e-15)


def settle(robot: hurcules.Robot, *stack: hurcules.Task) -> None:
    """Ten seconds."""
    controller = hurcules.VelocityController(robot, hurcules.VelocityControllerOptions(dt=0.005))
    controller.set_stack(hurcules.Stack(list(stack)))
    for _ in range(2000):
        controller.step(robot)


def test_the_posture_comes_before_the_hand_and_then_the_hand_stays(robot: hurcules.Robot) -> None:
    hand = hand_at(robot, (-2.4, -0.2))
    posture = hurcules.PostureTask("posture", robot)
    posture.set_target(hurcules.inverse_kinematics(robot, [hand]).configuration)
    settle(robot, hand, posture)  # below the hand it has nothing left to move
    hand.update(robot)
    assert np.linalg.norm(hand.error) > 0.05
    settle(robot, posture)
    settle(robot, hand, posture)
    hand.update(robot)
    assert np.linalg.norm(hand.error) < 1e-6


@pytest.mark.parametrize("seed", range(4))
def test_postures_near_the_present_one_are_tried_first(seed: int) -> None:
    text = ARM.replace("-2.6 2.6", "-12 12").replace("-2.5 2.5", "-12 12")
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(text))
    start = np.array([11.9, 11.6])  # near the ends of both ranges, four turns wide
    robot.set_configuration([12.4 - 2 * np.pi, 11.4])  # half a radian on is past the limit
    target = robot.position("hand")[:2]
    robot.set_configuration(start)
    hand = hurcules.PositionTask("hand", robot, "hand", axes=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    hand.set_target(target)
    found = hurcules.inverse_kinematics(robot, [hand], starts=8, seed=seed)
    assert found.reached and found.starts[0] == 8
    assert np.abs(found.configuration - start).max() < 2 * np.pi


@pytest.mark.parametrize("way", [3.0, 8.0, 30.0, -300.0])
def test_a_base_goes_as_far_as_it_takes(way: float) -> None:
    # a descent ended after 10 s, 5 m from where it began: 8 m were 1.3 m short
    joints = '<joint name="x" type="slide" axis="1 0 0"/><joint name="shoulder"'
    text = ARM.replace('<joint name="shoulder"', joints, 1)
    text = text.replace("<actuator>", '<actuator><motor joint="x"/>')
    base = hurcules.Robot(mujoco.MjModel.from_xml_string(text))
    base.set_configuration([0.0, 0.4, 1.0])
    task = hurcules.PositionTask("hand", base, "hand", axes=[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]])
    task.set_target(base.position("hand")[:2] + np.array([way, 0.0]))
    found = hurcules.inverse_kinematics(base, [task])
    assert found.reached and found.starts == (1, 1)
    assert abs(found.configuration[0] - way) < 2.0  # the arm does the rest


def test_what_the_controller_reaches_is_found_at_the_first_descent_and_nothing_is_moved(
    robot: hurcules.Robot,
) -> None:
    hand = hand_at(robot, (2.0, 0.5))
    before = tuple(hand.error)
    found = hurcules.inverse_kinematics(robot, [hurcules.JointLimits("limits", robot), hand])
    assert found.reached and found.starts == (1, 1)
    assert tuple(robot.configuration) == START
    assert tuple(hand.error) == before
    again = hurcules.inverse_kinematics(robot, [hand])
    assert again.configuration.tobytes() == found.configuration.tobytes()


def test_what_was_found_is_taken_as_it_is(robot: hurcules.Robot) -> None:
    found = hurcules.inverse_kinematics(robot, [hand_at(robot, (-0.7, -2.0))])
    posture = hurcules.PostureTask("posture", robot)
    posture.set_target(found)
    robot.set_configuration(found)
    assert np.array_equal(posture.target, found.configuration)
    assert np.array_equal(robot.configuration, found.configuration)


def test_out_of_reach_it_says_by_how_much(robot: hurcules.Robot) -> None:
    hand = hurcules.PositionTask("hand", robot, "hand", axes=[[1.0, 0.0, 0.0]])
    hand.set_target([1.2])  # the stretched arm has 1 m
    found = hurcules.inverse_kinematics(robot, [hand], starts=4)
    assert not found.reached
    assert found.starts == (4, 0)
    # it rests a little before it is straight: (0.02 S)^2 / (2 c), docs/control.md
    assert 0.2 <= found.error < 0.2 + 2e-3


@pytest.mark.parametrize(
    ("posture", "wish"), [((-0.7, -2.0), (0.7, 2.1)), ((-0.1, -1.3), (1.6, 2.1))]
)
def test_a_wish_that_cannot_be_met_costs_the_hand_above_it_nothing(
    robot: hurcules.Robot, posture: tuple[float, float], wish: tuple[float, float]
) -> None:
    # descents that miss the hand by 0.3 and 0.8 m come nearer to the wish
    hand = hand_at(robot, posture)
    last = hurcules.PostureTask("wish", robot)
    last.set_target(wish)
    found = hurcules.inverse_kinematics(robot, [hand, last], starts=8)
    assert not found.reached and found.error > 0.5
    robot.set_configuration(found.configuration)
    hand.update(robot)
    assert np.abs(hand.error).max() < 1e-4


def test_distances_that_come_first_hold(robot: hurcules.Robot) -> None:
    apart = hurcules.DistanceTask("post", robot, [("lower", "post"), ("upper", "post")], 0.05)
    hand = hand_at(robot, (-1.8, 1.5))  # the elbow in the post: the other way round it is free
    found = hurcules.inverse_kinematics(robot, [apart, hand])
    assert found.reached
    robot.set_configuration(found.configuration)
    apart.update(robot)
    assert apart.error.min() > 0.05 - 1e-4


def test_a_closed_chain_is_given_whole_and_left_as_it_was() -> None:
    # the descent ends in the other assembly, in which the robot was left
    model = mujoco.MjModel.from_xml_string(FIVE_BAR)
    robot, found = hurcules.Robot(model), hurcules.Robot(model)
    before = robot.qpos
    hand = hurcules.PositionTask("hand", robot, "hand", axes=[[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    hand.set_target([-0.16574745, -0.03357351])
    posture = hurcules.inverse_kinematics(robot, [hand])
    np.testing.assert_array_equal(robot.qpos, before)
    found.set_qpos(posture.qpos)
    hand.update(found)
    assert posture.reached and np.abs(hand.error).max() < 1e-4
    data = mujoco.MjData(model)
    data.qpos[:] = posture.qpos
    mujoco.mj_forward(model, data)
    assert np.abs(data.efc_pos[: data.ne]).max() < 1e-9
    found.set_qpos(before)
    found.set_configuration(posture.configuration)
    hand.update(found)
    assert np.abs(hand.error).max() > 0.1  # the same angles of the motors


def test_a_posture_is_pickled(robot: hurcules.Robot) -> None:
    found = hurcules.inverse_kinematics(robot, [hand_at(robot, (2.0, 0.5))])
    again = pickle.loads(pickle.dumps(found))
    assert np.array_equal(again, found) and np.array_equal(again.qpos, found.qpos)
    assert (again.error, again.reached, again.starts) == (found.error, True, (1, 1))


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"starts": 0}, "starts wants a number >= 1, got 0"),
        ({"tolerance": float("nan")}, "tolerance wants a positive number, got nan"),
    ],
)
def test_bad_arguments_are_refused(
    robot: hurcules.Robot, options: dict[str, float], words: str
) -> None:
    hand = hurcules.PositionTask("hand", robot, "hand")
    with pytest.raises(hurcules.Error, match=words):
        hurcules.inverse_kinematics(robot, [hand], **options)
    with pytest.raises(hurcules.Error, match="at least one task"):
        hurcules.inverse_kinematics(robot, [])
