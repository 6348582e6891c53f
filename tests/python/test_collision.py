"""Robots that keep away from themselves and from what stands around them.

Strategy: a hand is sent through a post by both controllers and both laws, at gains from usual to
absurd and at several control periods: the distance, measured by MuJoCo, never becomes less than the
margin by more than a millimetre. What an obstacle holds off its target comes to the margin and
rests. A ball comes flying: the arm gives way. Hurcules claps its hands.
Not tested here: which pairs are found, and the rows (tests/cpp/tasks/distance_task_test.cpp).
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import rhqp

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <default><joint range="-2.8 2.8" limited="true" armature="0.1"/>
    <geom type="capsule" size="0.04" density="300"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="3 3 1"/>
    <geom name="post" type="cylinder" size="0.08 0.6" pos="0.62 0 0.6"/>
    <body name="ball" mocap="true" pos="0 3 0.8"><geom name="ball" type="sphere" size="0.1"/></body>
    <body name="base" pos="0 0 0.8"><geom name="base" type="sphere" size="0.06"/>
      <body name="upper"><joint name="j1" axis="0 0 1"/><joint name="j2" axis="0 1 0"/>
        <geom name="upper" fromto="0.12 0 0 0.35 0 0"/>
        <body name="lower" pos="0.4 0 0"><joint name="j3" axis="0 0 1"/>
          <joint name="j4" axis="0 1 0"/><geom name="lower" fromto="0.08 0 0 0.35 0 0"/>
          <site name="tip" pos="0.4 0 0"/></body></body></body>
  </worldbody>
  <actuator><motor joint="j1" forcerange="-60 60"/><motor joint="j2" forcerange="-60 60"/>
    <motor joint="j3" forcerange="-30 30"/><motor joint="j4" forcerange="-30 30"/></actuator>
</mujoco>
"""
MARGIN = 0.02  # [m]
START = [-1.2, 0.0, 0.6, 0.2]


@pytest.fixture
def model() -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(ARM)


class Judge:
    """The least distance of any pair of geoms that may touch and are no neighbours, by MuJoCo."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model, self.data, self.least = model, mujoco.MjData(model), np.inf
        names = ["floor", "post", "base", "upper", "lower"]
        near = {("base", "upper"), ("upper", "lower"), ("floor", "post"), ("floor", "base"),
                ("post", "base")}  # fmt: skip
        self.pairs = [
            (model.geom(a).id, model.geom(b).id)
            for i, a in enumerate(names)
            for b in names[i + 1 :]
            if (a, b) not in near
        ]

    def look(self, robot: hurcules.Robot) -> None:
        """Measures where the robot is."""
        self.data.qpos[:] = robot.qpos
        mujoco.mj_kinematics(self.model, self.data)
        for a, b in self.pairs:
            distance = mujoco.mj_geomDistance(self.model, self.data, a, b, 1.0, None)
            self.least = min(self.least, distance)


def controller_of(
    robot: hurcules.Robot, by: str, dt: float, gain: float
) -> hurcules.VelocityController | hurcules.AccelerationController:
    if by == "accelerations":
        damping = min(2 * gain, 0.6 / dt)
        options = hurcules.AccelerationControllerOptions(
            dt=dt,
            damping=damping,
            stiffness=min(gain * damping / 2, 0.09 / dt**2),
            rest=min(10.0, 0.6 / dt),
        )
        return hurcules.AccelerationController(robot, options)
    law = "thesis" if by == "thesis" else "arrive"
    gain = min(gain, 1.0 / dt)  # more is refused
    options = hurcules.VelocityControllerOptions(dt=dt, gain=gain, law=law)
    return hurcules.VelocityController(robot, options)


@pytest.mark.parametrize("dt", [0.001, 0.005, 0.025, 0.05])
@pytest.mark.parametrize("gain", [5.0, 50.0, 200.0])
@pytest.mark.parametrize("by", ["velocities", "thesis", "accelerations"])
def test_nothing_is_met_at_any_gain(model: mujoco.MjModel, by: str, gain: float, dt: float) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    limits = hurcules.JointLimits("limits", robot)
    for name in robot.coordinate_names:
        limits.set_max_velocity(name, 3.0)
    # from 3 m/s: the hand is seen from so far that it can stop
    apart = hurcules.self_collision(robot, margin=MARGIN, most=0.5)
    clear = hurcules.obstacles(robot, margin=MARGIN, most=0.5)
    hand = hurcules.PositionTask("hand", robot, "tip")
    hand.set_max_speed(5.0)  # whatever the joints give
    controller = controller_of(robot, by, dt, gain)
    posture = hurcules.PostureTask("posture", robot)
    controller.set_stack(hurcules.Stack([limits, apart, clear, hand, posture]))
    judge = Judge(model)
    rng = np.random.default_rng(1)
    met = 0.0
    for leg in range(6):
        # through the post, into the floor, into the base
        hand.set_target([[0.6, 0.6, 0.8], [0.4, 0.0, -0.3], [0.0, 0.0, 0.8]][leg % 3]
                        + rng.normal(0.0, 0.05, 3))  # fmt: skip
        for _ in range(round(1.0 / dt)):
            controller.step(robot)
            assert controller.solution.status == rhqp.Status.Solved
            judge.look(robot)
        met = max(met, float(np.linalg.norm(hand.error)))
    assert judge.least > MARGIN - 1e-3
    if by != "accelerations" or gain < 50.0:  # there it swings clear of everything
        assert judge.least < 0.1, "nothing was in the way"
    assert met > 0.05


def test_the_arm_gives_way_to_a_ball_that_comes(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    clear = hurcules.obstacles(robot, ["ball"], margin=MARGIN)
    hand = hurcules.PositionTask("hand", robot, "tip")
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([clear, hand]))
    place, velocity = robot.position("tip") - np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.3, 0.0])
    least = np.inf
    for _ in range(3000):
        place = place + 1e-3 * velocity
        clear.set_obstacle(robot, "ball", place, velocity=velocity)
        controller.step(robot)
        clear.update(robot)
        least = min(least, float(clear.error.min()))
    assert least > MARGIN - 1e-3
    assert least < MARGIN + 5e-3, "the ball missed the arm"


SLIDER = """
<mujoco>
  <worldbody>
    <geom name="wall" type="box" size="0.05 1 1" pos="1.05 0 0"/>
    <body name="cart"><joint name="x" type="slide" axis="1 0 0" range="-2 2" limited="true"/>
      <geom name="cart" type="sphere" size="0.1"/><site name="tip"/></body>
  </worldbody>
</mujoco>
"""
CONTROLLERS = [hurcules.VelocityController, hurcules.AccelerationController]


@pytest.mark.parametrize("controller", CONTROLLERS)
@pytest.mark.parametrize("target", [0.85, 1.2], ids=["before the wall", "in the wall"])
def test_an_obstacle_stops_what_it_is_near_no_sooner_than_at_its_margin(
    controller: type, target: float
) -> None:
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(SLIDER))
    clear = hurcules.obstacles(robot, margin=MARGIN)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=[[1.0, 0.0, 0.0]])
    tip.set_target([target])
    controls = controller(robot)
    controls.set_stack(hurcules.Stack([clear, tip]))
    for _ in range(6000):
        controls.step(robot)
    at_margin = 0.9 - MARGIN
    assert robot.configuration[0] == pytest.approx(min(target, at_margin), abs=5e-4)


@pytest.mark.parametrize("controller", CONTROLLERS)
@pytest.mark.parametrize("target", [(0.62, 0.0, 0.8), (0.7, -0.1, 0.9)])
def test_a_hand_that_an_obstacle_holds_off_its_target_rests(
    model: mujoco.MjModel, controller: type, target: tuple[float, float, float]
) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    clear = hurcules.obstacles(robot, margin=MARGIN)
    hand = hurcules.PositionTask("hand", robot, "tip")
    hand.set_target(target)
    controls = controller(robot)
    posture = hurcules.PostureTask("posture", robot)
    controls.set_stack(hurcules.Stack([clear, hand, posture]))
    for _ in range(6000):
        before = robot.configuration
        controls.step(robot)
    assert np.abs(robot.configuration - before).max() < 1e-6  # 1 mrad/s
    assert min(pair[2] for pair in clear.near(robot)) == pytest.approx(MARGIN, abs=1e-4)


FLAT = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <default><joint range="-2.8 2.8" limited="true"/><geom type="capsule" size="0.03"/></default>
  <worldbody>
    <geom name="table" type="box" size="0.5 0.6 0.02" pos="0.75 0 0.3"/>
    <body name="base" pos="0 0 0.6">
      <body name="upper"><joint name="j1" axis="0 0 1"/><joint name="j2" axis="0 1 0"/>
        <joint name="j3" axis="1 0 0"/><geom fromto="0.1 0 0 0.33 0 0"/>
        <body name="lower" pos="0.4 0 0"><joint name="j4" axis="0 1 0"/>
          <joint name="j5" axis="1 0 0"/><geom fromto="0.06 0 0 0.25 0 0"/>
          <body name="hand" pos="0.33 0 0" euler="0 1.5708 0"><joint name="j6" axis="0 1 0"/>
            <joint name="j7" axis="1 0 0"/>
            <geom name="hand" type="{shape}" pos="0 0 0.05"/><site name="tip" pos="0 0 0.06"/>
          </body></body></body></body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize("controller", CONTROLLERS)
@pytest.mark.parametrize("shape", ['box" size="0.06 0.04 0.01', 'cylinder" size="0.05 0.01'])
def test_a_flat_hand_that_is_pressed_at_a_table_does_not_rock(controller: type, shape: str) -> None:
    # its nearest point jumps from corner to corner: with a row for the nearest alone 11 of these 12
    # moved for ever, at up to 0.8 rad/s
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(FLAT.format(shape=shape)))
    for target in ([0.6, 0.1, 0.27], [0.5, -0.2, 0.3], [0.7, 0.2, 0.31]):
        robot.set_configuration([0.3, -0.3, 0.1, 0.8, 0.1, -0.5, 0.1])
        clear = hurcules.obstacles(robot, margin=MARGIN)
        hand = hurcules.PositionTask("hand", robot, "tip")
        hand.set_target(target)
        controls = controller(robot)
        controls.set_stack(hurcules.Stack([clear, hand, hurcules.PostureTask("posture", robot)]))
        for _ in range(8000):
            before = robot.configuration
            controls.step(robot)
        assert np.abs(robot.configuration - before).max() < 1e-6  # 1 mrad/s
        assert min(pair[2] for pair in clear.near(robot)) == pytest.approx(MARGIN, abs=1e-4)


def test_notes_name_what_is_in_the_way(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    clear = hurcules.obstacles(robot, margin=MARGIN)
    hand = hurcules.PositionTask("hand", robot, "tip")
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([clear, hand]))
    hand.set_target([0.62, 0.0, 0.8])  # inside the post
    for _ in range(5000):
        controller.step(robot)
    (short,) = controller.diagnostics(robot)[-1].shortfalls
    assert any("(lower, post)" in name for name in short.held_by), str(short)
    assert clear.near(robot)
    assert {name for pair in clear.near(robot) for name in pair[:2]} >= {"post", "lower"}


def test_an_obstacle_that_nothing_can_touch_is_refused(model: mujoco.MjModel) -> None:
    model.geom_contype[model.body("ball").geomadr] = 0
    model.geom_conaffinity[model.body("ball").geomadr] = 0
    robot = hurcules.Robot(model)
    with pytest.raises(hurcules.Error, match="body 'ball' has no geom that can touch the robot"):
        hurcules.obstacles(robot, bodies=["ball"])


def test_in_the_physics_an_arm_stops_before_the_floor(model: mujoco.MjModel) -> None:
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    clear = hurcules.obstacles(robot, bodies=["ball"])
    hand = hurcules.PositionTask("hand", robot, "tip")
    channels = {"hand": hurcules.Twist(hand, 0.5)}
    controller = hurcules.WholeBodyController(robot, [clear, hand], channels)
    simulation = hurcules.Simulation(model=model, controller=controller)
    for _ in range(60):
        simulation.step(50, {"hand": [0.0, 0.0, -0.5]})
        assert simulation.data.ncon == 0
    assert simulation.data.site("tip").xpos[2] < 0.15


def test_hurcules_does_not_clap_its_hands() -> None:
    robot = hurcules.Robot(hurcules.models.load("manipulation"))
    robot.set_keyframe("ready")
    apart = hurcules.self_collision(robot)
    pairs = apart.pairs(robot)
    assert len(pairs) > 20
    hands = [hurcules.PositionTask(side, robot, f"{side}_tcp") for side in "LR"]
    middle = (hands[0].value + hands[1].value) / 2
    for hand in hands:
        hand.set_target(middle)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([apart, *hands, hurcules.PostureTask("posture", robot)]))
    least = np.inf
    for _ in range(4000):
        controller.step(robot)
        least = min(least, float(apart.error.min()))
    assert 0.02 - 1e-3 < least < 0.03


def test_pairs_that_are_far_are_no_rows() -> None:
    robot = hurcules.Robot(hurcules.models.load("manipulation"))
    robot.set_keyframe("ready")
    robot.stand_on("lower_leg_L")
    apart = hurcules.self_collision(robot, margin=0.01, most=0.028)
    assert len(apart.pairs(robot)) > 100
    assert apart.near(robot) == []


def test_a_geom_without_a_name_is_told_by_its_body() -> None:
    # of a URDF no geom has one: "geom 20, geom 31"
    robot = hurcules.Robot(hurcules.models.folder() / "examples" / "quadruped.xml")
    pairs = hurcules.self_collision(robot).pairs(robot)
    assert ("geom 1 of trunk", "geom 4 of FL_shank") in pairs
