"""Robots on wheels and slides, with grippers: what their actuators can do, and what holds them up.

Strategy: small robots written here; places, speeds and forces against rolling (v = w r), the ranges
of the model, and MuJoCo's distances.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Error

WHEEL, HALF_TRACK = 0.1, 0.3  # [m]
CART = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.002" cone="elliptic" impratio="10"/>
  <worldbody>
    <geom type="plane" size="9 9 0.1"/>
    <body name="base" pos="0 0 0.2"><freejoint/>
      <geom type="box" size="0.3 0.25 0.08" pos="0 0 0.05" mass="50"/>
      <body pos="0 0.3 -0.1"><joint name="left" axis="0 1 0"/>
        <geom type="cylinder" size="0.1 0.02" zaxis="0 1 0" mass="1.5"/></body>
      <body pos="0 -0.3 -0.1"><joint name="right" axis="0 1 0"/>
        <geom type="cylinder" size="0.1 0.02" zaxis="0 1 0" mass="1.5"/></body>
      <geom type="sphere" size="0.05" pos="0.25 0 -0.15" friction="0.001" priority="1" mass="0.5"/>
      <geom type="sphere" size="0.05" pos="-0.25 0 -0.15" friction="0.001" priority="1" mass="0.5"/>
      <body pos="0.1 0 0.13"><joint name="arm" axis="0 1 0" range="-2 2" armature="0.1"/>
        <geom type="capsule" size="0.04" fromto="0 0 0 0 0 0.4" mass="2"/></body>
    </body>
  </worldbody>
  <actuator>
    <motor joint="left" ctrlrange="-40 40"/><motor joint="right" ctrlrange="-40 40"/>
    <motor joint="arm" ctrlrange="-80 80"/>
  </actuator>
</mujoco>
"""
GANTRY = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.002" gravity="0 0 0"/>
  <worldbody>
    <body name="wall" pos="{wall} 0 0"><geom type="box" size="0.1 1 1"/></body>
    <body name="hand">
      <joint name="x" type="slide" axis="1 0 0"/>
      <joint name="y" type="slide" axis="0 1 0" range="-1 1" limited="true"/>
      <geom name="palm" type="sphere" size="0.05" mass="5"/>
      <site name="tcp"/>
      <body pos="0 0.1 0">
        <joint name="thumb" type="slide" axis="0 -1 0" range="0 0.08" armature="1"/>
        <geom type="box" size="0.02 0.005 0.02" mass="0.1" contype="0" conaffinity="0"/></body>
      <body pos="0 -0.1 0">
        <joint name="finger" type="slide" axis="0 1 0" range="0 0.08" armature="1"/>
        <geom type="box" size="0.02 0.005 0.02" mass="0.1" contype="0" conaffinity="0"/></body>
    </body>
  </worldbody>
  <equality><joint joint1="finger" joint2="thumb" polycoef="0 1 0 0 0"/></equality>
  <actuator>{actuators}</actuator>
</mujoco>
"""
MOTORS = '<motor joint="x" ctrlrange="-50 50"/><motor joint="y" ctrlrange="-50 50"/>'
THUMB = '<motor joint="thumb" ctrlrange="-20 20"/>'


def cart(**options: object) -> hurcules.Simulation:
    model = mujoco.MjModel.from_xml_string(CART)
    robot = hurcules.Robot(model, joints=["arm"])
    posture = hurcules.PostureTask("posture", robot)
    wheels = {side: hurcules.JointRate(side, 10.0) for side in ("left", "right")}
    controller = hurcules.WholeBodyController(
        robot, [posture], wheels, support="base", base="sensed", **options
    )
    return hurcules.Simulation(model=model, controller=controller)


@pytest.mark.parametrize("servo", [{}, {"left": (0.3, 20.0), "right": (0.3, 20.0)}])
def test_a_robot_on_wheels_stands_and_rolls(servo: dict[str, tuple[float, float]]) -> None:
    simulation = cart(servo=servo)
    simulation.step(1500)
    assert np.abs(simulation.data.qvel).max() < 5e-3  # it swung by 1 rad/s, ever more
    before = simulation.data.qpos[0]
    simulation.step(1000, {"left": [2.0], "right": [2.0]})
    assert simulation.data.qpos[0] - before == pytest.approx(2.0 * 2.0 * WHEEL, rel=0.02)
    simulation.step(1000, {"left": [-1.0], "right": [1.0]})
    assert simulation.data.qvel[5] == pytest.approx(WHEEL / HALF_TRACK, rel=0.15)


def test_servos_that_are_not_given_are_reckoned() -> None:
    own = cart(servo={"left": (0.3, 20.0)})
    assert set(own.controller.joints) == {"left", "right", "arm"}
    with pytest.raises(Error, match=r"'wl' does not exist; there are: left, right, arm|'wl'"):
        cart(servo={"wl": (0.3, 20.0)})


def gantry(actuators: str, wall: float = 50.0) -> tuple[mujoco.MjModel, hurcules.Robot]:
    model = mujoco.MjModel.from_xml_string(GANTRY.format(actuators=actuators, wall=wall))
    return model, hurcules.Robot(model, joints=["x", "y"])


def test_joints_that_an_equality_couples_go_along() -> None:
    for physics in (True, False):
        for fingers in (THUMB, THUMB + '<motor joint="finger" ctrlrange="-20 20"/>'):
            model, robot = gantry(MOTORS + fingers)
            posture = hurcules.PostureTask("posture", robot)
            controller = hurcules.WholeBodyController(
                robot, [posture], {"grip": hurcules.JointRate("thumb", 0.1)}
            )
            simulation = hurcules.Simulation(model=model, controller=controller, physics=physics)
            simulation.step(500, {"grip": [0.05]})
            for joint in ("thumb", "finger"):
                assert simulation.data.joint(joint).qpos == pytest.approx(0.05, abs=2e-3)


def test_a_finger_at_its_peak_holds_up_no_arm() -> None:
    text = GANTRY.format(actuators=MOTORS + THUMB, wall=50)
    text = text.replace('contype="0" conaffinity="0"', "")  # the fingers close about a ball
    text = text.replace(
        '<site name="tcp"/>', '<site name="tcp"/><geom type="sphere" size="0.05" mass="0.1"/>'
    )
    text = text.replace(
        'gravity="0 0 0"/>', 'gravity="0 0 0"><flag filterparent="disable"/></option>'
    )
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model, joints=["x", "y", "thumb"])
    hand = hurcules.PositionTask("hand", robot, "tcp", axes=np.eye(3)[:2])
    grip = hurcules.PostureTask("grip", robot, ["thumb"])
    controller = hurcules.WholeBodyController(
        robot, [hand, grip], {"hand": hurcules.Twist(hand, 0.5), "grip": hurcules.Twist(grip, 0.1)}
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(1000, {"grip": [0.08]})
    before = simulation.data.qpos[0]
    simulation.step(1000, {"hand": [0.2, 0.0], "grip": [0.08]})
    assert simulation.data.joint("thumb").qpos < 0.06  # blocked
    assert simulation.data.qpos[0] - before == pytest.approx(0.4, abs=0.01)  # 0.000 before


def test_the_range_of_a_servos_control_is_a_limit() -> None:
    servo = '<velocity joint="x" kv="20" ctrlrange="-1 1"/><motor joint="y" ctrlrange="-50 50"/>'
    model, robot = gantry(servo)
    hand = hurcules.PositionTask("hand", robot, "tcp", axes=np.eye(3)[:2])
    controller = hurcules.WholeBodyController(robot, [hand], {"hand": hurcules.Twist(hand, 5.0)})
    simulation = hurcules.Simulation(model=model, controller=controller)
    for _ in range(100):
        simulation.step(10, {"hand": [3.0, 0.0]})  # the servo goes at 1 m/s at the most
        assert np.abs(simulation.data.ctrl[0]) <= 1.0
    simulation.step(2000)
    ahead = controller.q_des[0] - simulation.data.qpos[0]
    assert abs(ahead) < 1e-3 and abs(simulation.data.qvel[0]) < 1e-3
    assert 1.0 < simulation.data.qpos[0] < 2.2  # not 6 m, and not thrown beyond


@pytest.mark.parametrize("wall", [1.5, 5.0, 20.0])
def test_a_base_keeps_off_what_stands_where_it_may_drive(wall: float) -> None:
    model, robot = gantry(MOTORS + THUMB, wall)
    apart = hurcules.obstacles(robot)
    hand = hurcules.PositionTask("hand", robot, "tcp", axes=np.eye(3)[:2])
    controller = hurcules.WholeBodyController(robot, [apart, hand], {})
    hand.set_target([wall + 1.0, 0.0])
    simulation = hurcules.Simulation(model=model, controller=controller)
    hand.set_target([wall + 1.0, 0.0])
    least = np.inf
    for _ in range(round(40 + 20 * wall)):
        simulation.step(50)
        least = min(least, wall - 0.1 - 0.05 - simulation.data.joint("x").qpos[0])
    assert 0.0 < least < 0.1


def test_a_hand_stays_while_a_base_that_no_coordinate_moves_drives() -> None:
    model = mujoco.MjModel.from_xml_string("""
<mujoco>
  <option gravity="0 0 0"/>
  <worldbody>
    <body><joint name="base" type="slide" axis="1 0 0"/><geom size="0.1" mass="20"/>
      <body><joint name="arm" type="slide" axis="1 0 0"/><geom size="0.05" mass="2"/>
        <site name="tcp"/></body></body>
  </worldbody>
  <actuator><motor joint="base"/><motor joint="arm"/></actuator>
</mujoco>""")
    robot = hurcules.Robot(model, joints=["arm"])
    hand = hurcules.PositionTask("hand", robot, "tcp", axes=[[1, 0, 0]])
    controller = hurcules.WholeBodyController(
        robot, [hand], {"base": hurcules.JointRate("base", 0.5)}, base="sensed"
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(100, {"base": [0.1]})
    for _ in range(20):
        simulation.step(50, {"base": [0.1]})
        # v / K = 20 mm before
        assert simulation.data.site("tcp").xpos[0] == pytest.approx(0.0, abs=3e-3)
    assert simulation.data.joint("base").qpos[0] > 0.1


def test_a_pose_is_led_no_further_than_its_lead() -> None:
    model, robot = gantry(MOTORS + THUMB)
    pose = hurcules.PoseTask("pose", robot, "tcp")
    assert pose.max_lead == np.inf
    controller = hurcules.WholeBodyController(robot, [pose], {"pose": hurcules.Twist(pose, 2.0)})
    simulation = hurcules.Simulation(model=model, controller=controller, physics=False)
    led = {}
    for lead in (np.inf, 0.05):  # z and turns are out of reach: the slides go along x and y
        pose.max_lead = lead
        simulation.reset()
        simulation.step(2000, {"pose": [0.0, 0.0, 0.3, 0.0, 0.0, 0.3]})
        turned = np.arctan2(pose.target_orientation[1, 0], pose.target_orientation[0, 0])
        led[lead] = (pose.target_position[2], turned)
    assert led[np.inf] == pytest.approx((1.2, 1.2), abs=0.01)
    assert 0.03 < led[0.05][0] <= 0.05 and 0.09 < led[0.05][1] <= 0.15
    with pytest.raises(Error, match="max_lead of 'pose' wants a positive distance"):
        pose.max_lead = 0.0


def squeezing(actuator: str) -> hurcules.Simulation:
    """A finger of 60 N before a block that is 20 mm away."""
    model = mujoco.MjModel.from_xml_string(f"""
<mujoco>
  <option timestep="0.002" gravity="0 0 0"/>
  <worldbody>
    <body><joint name="arm" type="slide" axis="0 1 0"/><geom size="0.05" mass="2"/></body>
    <geom type="box" size="0.02 0.02 0.02" pos="0.04 0 0.2"/>
    <body pos="0 0 0.2"><joint name="finger" type="slide" axis="-1 0 0" range="-0.05 0.05"/>
      <geom type="box" size="0.01 0.01 0.01" mass="0.5" pos="-0.01 0 0"/></body>
  </worldbody>
  <actuator><motor joint="arm"/>{actuator}</actuator>
</mujoco>""")
    robot = hurcules.Robot(model, joints=["arm"])
    posture = hurcules.PostureTask("posture", robot)
    channels = {"grip": hurcules.JointRate("finger", 0.05)}
    controller = hurcules.WholeBodyController(robot, [posture], channels)
    return hurcules.Simulation(model=model, controller=controller)


@pytest.mark.parametrize(
    "actuator",
    [
        '<motor joint="finger" ctrlrange="-60 60"/>',
        '<position joint="finger" kp="2000" ctrlrange="-0.05 0.05" forcerange="-60 60"/>',
    ],
)
def test_a_finger_that_squeezes_opens_at_once(actuator: str) -> None:
    simulation = squeezing(actuator)
    for seconds in (1.0, 5.0):  # 0.9 and 1.3 s before
        simulation.step(round(seconds / simulation.dt), {"grip": [-0.05]})
        pressed = simulation.data.joint("finger").qpos[0]
        assert -simulation.data.actuator_force[1] > 20.0
        simulation.step(round(0.4 / simulation.dt), {"grip": [0.05]})
        assert simulation.data.joint("finger").qpos[0] - pressed > 0.01


TENDON = """
<mujoco>
  <compiler angle="radian"/>
  <worldbody>
    <body><joint name="arm" axis="0 0 1"/><geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.03"/>
      <body pos="0.3 0.02 0"><joint name="left" type="slide" axis="0 1 0" range="0 0.04"/>
        <geom size="0.01" mass="0.1"/></body>
      <body pos="0.3 -0.02 0"><joint name="right" type="slide" axis="0 -1 0" range="0 0.04"/>
        <geom size="0.01" mass="0.1"/></body></body>
  </worldbody>
  <tendon><fixed name="split">
    <joint joint="left" coef="0.5"/><joint joint="right" coef="0.5"/></fixed></tendon>
  <equality><joint joint1="left" joint2="right"/></equality>
  <actuator>
    <motor name="turn" joint="arm"/>
    <general name="grip" tendon="split" ctrlrange="0 255" gainprm="0.0157" biastype="affine"
      biasprm="0 -100 -10" forcerange="-100 100"/>
  </actuator>
</mujoco>"""


def test_a_gripper_on_tendons_is_led_by_the_rate_of_its_control() -> None:
    model = mujoco.MjModel.from_xml_string(TENDON)
    robot = hurcules.Robot(model, joints=["arm"])
    start = robot.qpos
    start[1:] = 0.02
    robot.set_qpos(start)
    posture = hurcules.PostureTask("posture", robot)

    def controlled(actuator: str, scale: float = 255.0) -> hurcules.WholeBodyController:
        channels = {"grip": hurcules.ControlRate(actuator, scale)}
        return hurcules.WholeBodyController(robot, [posture], channels)

    controller = controlled("grip")
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(200)  # nothing is commanded: it stays
    assert simulation.data.joint("left").qpos[0] == pytest.approx(0.02, abs=1e-4)
    assert simulation.data.ctrl[1] == pytest.approx(0.02 * 100.0 / 0.0157, rel=1e-6)
    simulation.step(250, {"grip": [-1e9]})  # held to its scale: 0.5 s at 255 1/s
    assert simulation.data.ctrl[1] == pytest.approx(0.0, abs=1e-9)
    simulation.step(250)
    assert simulation.data.joint("left").qpos[0] < 2e-3
    saved = simulation.state()
    simulation.step(500, {"grip": [100.0]})
    assert simulation.data.ctrl[1] == pytest.approx(100.0)
    simulation.restore(saved)
    simulation.step(1)
    assert simulation.data.ctrl[1] == pytest.approx(0.0, abs=1e-9)
    with pytest.raises(Error, match="actuator 'grap' does not exist; there are: turn, grip"):
        controlled("grap")
    with pytest.raises(Error, match="which the servo of joint 'arm' commands"):
        controlled("turn")
