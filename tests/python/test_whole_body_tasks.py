"""Balance, distance, torque limits, accelerations and forces from Python.

Strategy: an inequality in a stack gives way to nothing below it: a hand is sent where it would cost
balance, or into a post, and the inequality holds. Torques of the acceleration controller beside
MuJoCo's inverse dynamics. Brakes of the whole robot. Wrong calls and their words. Not tested here:
the laws (C++ tests), force control in the physics.
"""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

import hurcules

DT = 1e-3
ARM = """
<mujoco>
  <worldbody>
    <body name="upper" pos="0 0 1"><joint name="shoulder" axis="0 1 0" range="-150 150"/>
      <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="4"/>
      <body name="lower" pos="0.4 0 0"><joint name="elbow" axis="0 1 0" range="-150 150"/>
        <geom name="forearm" type="capsule" size="0.04" fromto="0.1 0 0 0.4 0 0" mass="3"/>
        <site name="tip" pos="0.4 0 0"/></body></body>
    <body name="post" pos="0.55 0 0.45"><geom name="post" type="sphere" size="0.1"/></body>
  </worldbody>
  <actuator><motor joint="shoulder" forcerange="-30 30"/><motor joint="elbow" forcerange="-20 20"/>
  </actuator>
</mujoco>
"""


@pytest.fixture
def model() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(ARM)


def send(
    robot: hurcules.Robot, first: list[hurcules.Task | hurcules.JointLimits], velocity: list[float]
) -> list[float]:
    """Sends the tip along below the first levels for 2 s: the least error of the last of these."""
    hand = hurcules.PositionTask("hand", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([*first, hand]))
    least = []
    for _ in range(2000):
        hand.advance(velocity, DT)
        controller.step(robot)
        first[-1].update(robot)
        least.append(float(first[-1].error.min()))
    assert np.abs(hand.error).max() > 0.05, "nothing was in the hand's way"
    return least


def test_a_hand_gives_way_to_balance(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([0.3, 1.2])
    x = robot.com[0]
    square = np.array([[-0.2, -0.2], [x + 0.06, -0.2], [x + 0.06, 0.2], [-0.2, 0.2]])
    balance = hurcules.BalanceTask("balance", robot, square, margin=0.02)
    assert balance.error.min() == pytest.approx(0.06, abs=1e-12)
    least = send(robot, [hurcules.JointLimits("joint", robot), balance], [0.15, 0.0])
    # a side is approached at the controller's gain, never passed but for the step's curvature
    assert min(least) > 0.02 - 1e-5
    assert min(least) < 0.03, "the centre of mass was not driven to the side"


def test_a_hand_keeps_away_from_a_post(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([-0.2, 0.6])
    apart = hurcules.DistanceTask("apart", robot, [("forearm", "post")], margin=0.05, most=0.5)
    least = send(robot, [hurcules.JointLimits("joint", robot), apart], [-0.05, -0.25])
    assert min(least) > 0.05 - 1e-4
    assert min(least) < 0.055, "the arm was not driven to the post"
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    mujoco.mj_forward(model, data)
    forearm, post = model.geom("forearm").id, model.geom("post").id
    measured = mujoco.mj_geomDistance(model, data, forearm, post, 1.0, None)
    # between two looks the nearest points move with their bodies
    assert measured == pytest.approx(least[-1], abs=1e-4)


def test_torques_are_those_of_inverse_dynamics(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([0.4, 0.9])
    robot.set_velocity([0.3, -0.5])
    hand = hurcules.PositionTask("hand", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    hand.advance([0.2, 0.1], DT)
    controller = hurcules.AccelerationController(robot)
    controller.set_stack(hurcules.Stack([hurcules.JointLimits("joint", robot), hand]))
    acceleration = controller.compute(robot)
    assert np.abs(acceleration).max() > 0.1
    data = mujoco.MjData(model)
    data.qpos[:], data.qvel[:], data.qacc[:] = robot.qpos, robot.velocity, acceleration
    model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT
    mujoco.mj_inverse(model, data)
    np.testing.assert_allclose(controller.torque(robot), data.qfrc_inverse, atol=1e-9)
    np.testing.assert_allclose(robot.inverse_dynamics(acceleration), data.qfrc_inverse, atol=1e-9)


def test_an_arm_follows_by_acceleration_within_its_torques(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([0.4, 0.9])
    hand = hurcules.PositionTask("hand", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    torques = hurcules.TorqueLimits("torque", robot)
    controller = hurcules.AccelerationController(robot)
    stack = hurcules.Stack([hurcules.JointLimits("joint", robot), torques, hand])
    controller.set_stack(stack)
    given = []
    for tick in range(3000):
        # up with all it has, then rest
        hand.advance([-0.05, 0.5] if tick < 800 else [0.0, 0.0], DT)
        q = robot.configuration
        acceleration = controller.step(robot)
        assert np.isfinite(acceleration).all()
        given.append(controller.hierarchy[1].A @ controller.acceleration)
        assert np.abs(robot.configuration - q).max() < 0.1
    # the rows hold M qddot within effort - h
    rows = controller.hierarchy[1]
    assert (given[-1] <= rows.upper + 1e-6).all()
    assert (given[-1] >= rows.lower - 1e-6).all()


def test_a_snapshot_goes_on_bit_for_bit(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration([0.4, 0.9])
    force = hurcules.ForceTask("force", robot, "tip", environment=1e4)
    controller = hurcules.AccelerationController(robot)
    controller.set_stack(hurcules.Stack([hurcules.JointLimits("joint", robot), force]))

    def go(ticks: int) -> np.ndarray:
        for tick in range(ticks):
            force.advance([-0.05], DT)
            force.sense(robot, -3.0 - 1e-3 * tick)
            controller.step(robot)
        return np.concatenate([robot.configuration, robot.velocity])

    go(50)
    kept = controller.state(), force.state(), robot.configuration, robot.velocity
    first = go(50)
    controller.restore(kept[0])
    force.restore(kept[1])
    robot.set_configuration(kept[2])
    robot.set_velocity(kept[3])
    np.testing.assert_array_equal(go(50), first)


@pytest.mark.parametrize(
    ("start", "speed", "held_by"),
    [
        ([0.05, 0.05], -0.2, ["shoulder upper limit", "elbow upper limit"]),
        ([0.0, 0.0], -0.2, ["shoulder upper limit", "elbow upper limit"]),  # it bends
        ([0.0, 0.0], 0.2, ["a singular posture"]),
    ],
)
def test_notes_say_what_holds_a_hand(
    model: mujoco.MjModel, start: list[float], speed: float, held_by: list[str]
) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(start)
    limits = hurcules.JointLimits("joint", robot)
    hand = hurcules.PositionTask("hand", robot, "tip", axes=[[1, 0, 0]])
    limits.set_range("shoulder", -0.1, 0.1)
    limits.set_range("elbow", -0.1, 0.1)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([limits, hand]))
    for _ in range(3000):
        hand.advance([speed], DT)
        controller.step(robot)
    levels = controller.diagnostics(robot)
    assert [level.level for level in levels] == ["joint", "hand"]
    assert levels[0].shortfalls == []
    (short,) = levels[1].shortfalls
    assert short.task == "hand"
    assert short.short_by == pytest.approx(float(abs(hand.error[0])), rel=1e-6)
    assert short.held_by == held_by
    assert str(short) == f"hand: {short.short_by:.3g} m short, held by {' and '.join(held_by)}"


def test_a_brake_holds_what_falls_without_it() -> None:
    model = hurcules.models.load("rescue")
    falls = []
    for braked in (True, False):
        data = mujoco.MjData(model)
        physics = hurcules.Plant(model, data)
        physics.reset("ready")
        physics.brakes.reset(closed=braked)
        address = model.joint("LSP").qposadr[0]
        start = data.qpos[address]
        assert physics.step(500) == 500
        assert physics.is_sound
        falls.append(abs(data.qpos[address] - start))
        # open ones cost the power of their coils, closed ones nothing
        assert (physics.brakes.power == 0.0) == braked
        assert physics.brakes.is_shut("LSP") == braked
    assert falls[0] < 1e-4
    assert falls[1] > 0.1


def robot_of() -> hurcules.Robot:
    return hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))


WRONG: list[tuple[Callable[[hurcules.Robot], object], str]] = [
    (
        lambda r: hurcules.BalanceTask("b", r, [[0, 0], [1, 0], [0.2, 0.2], [0, 1]]),
        "polygon of task 'b' wants to be convex, without corners on a line; corner 2 is not",
    ),
    (lambda r: hurcules.BalanceTask("b", r, [[0, 0], [1, 0]]), "wants 3 or more finite corners"),
    (lambda r: hurcules.DistanceTask("d", r, []), "wants at least one pair"),
    (lambda r: hurcules.DistanceTask("d", r, [("forearm", "past")]), "'past' does not exist"),
    (
        lambda r: hurcules.DistanceTask("d", r, [("forearm", "forearm")]),
        "no coordinate moves 'forearm' against 'forearm'",
    ),
    (lambda r: hurcules.DistanceTask("d", r, [("forearm", "post")], 0.3, 0.2), "margin of task"),
    (
        lambda r: hurcules.ForceTask(
            "f", r, "tip", environment=1e5, gains=hurcules.ForceGains(compliance=0.05)
        ),
        "f",
    ),
    (lambda r: hurcules.largest_stiffness(hurcules.ForceGains(compliance=-1.0)), "compliance"),
    (lambda r: hurcules.AccelerationController(r).compute(r), "wants a stack before it computes"),
    (lambda r: hurcules.AccelerationController(r).torque(r), "wants a stack before it computes"),
    (lambda r: r.inverse_dynamics([0.0]), "inverse_dynamics wants 2 finite accelerations, got 1"),
    (
        lambda r: hurcules.AccelerationController(
            r, hurcules.AccelerationControllerOptions(damping=1e4)
        ),
        "too high for a control period",
    ),
    (
        lambda r: hurcules.Plant(r, mujoco.MjData(mujoco.MjModel.from_xml_string(ARM))),
        "a mujoco.MjModel is wanted, a Robot came",
    ),
]


@pytest.mark.parametrize(("call", "words"), WRONG)
def test_wrong_calls_are_told_what_was_wanted(
    call: Callable[[hurcules.Robot], object], words: str
) -> None:
    with pytest.raises(hurcules.Error) as error:
        call(robot_of())
    assert words in str(error.value)
