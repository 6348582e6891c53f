"""Mobile manipulators, as docs/loop.md tells a user to lead them.

Strategy: an arm of four joints with a gripper on a base of two slides and a hinge, as text. The
base rests while the arm reaches, rolls without slipping where a task says so, keeps still under a
change of stacks; fingers on a JointRate hold a box while the hand lifts it. Negative controls: the
same without the level, the task, the call. Not tested: wheels on the ground.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules

BASE, ARM = ["x", "y", "yaw"], ["lift", "j1", "j2", "j3", "j4"]
FINGERS = """<position name="grip" joint="left" kp="4000" kv="80" ctrlrange="-.02 .04"
  forcerange="-60 60"/>"""
TENDON = """<general name="grip" tendon="split" gainprm=".0157" biastype="affine"
  biasprm="0 -100 -10" ctrlrange="0 255" forcerange="-100 100"/>"""
ROBOT = """<mujoco><compiler angle="radian"/><option timestep="0.002"/>
  <default><joint armature=".1" damping=".5"/><geom type="capsule" size=".04"/>
    <default class="base"><joint armature="0" damping="0"/></default></default>
  <worldbody><geom name="floor" type="plane" size="9 9 .1"/>
    <body name="table" pos=".85 0 .2"><geom type="box" size=".15 .4 .2"/></body>
    <body name="box" pos=".85 0 .44"><freejoint/>
      <geom type="box" size=".015 .02 .04" mass=".3" friction="1"/></body>
    <body name="base" pos="0 0 .2">
      <joint class="base" name="x" type="slide" axis="1 0 0"/>
      <joint class="base" name="y" type="slide" axis="0 1 0"/>
      <joint class="base" name="yaw" axis="0 0 1"/>
      <geom type="box" size=".25 .2 .1" mass="60"/>
      <body name="column" pos="0 0 .4"><joint name="lift" type="slide" axis="0 0 1" range="0 .4"/>
        <geom type="box" size=".05 .05 .2" mass="8"/>
        <body pos=".1 0 .2"><joint name="j1" axis="0 0 1" range="-2.8 2.8"/>
          <geom fromto="0 0 0 0 0 .1" mass="2"/>
          <body pos="0 0 .1"><joint name="j2" axis="0 1 0" range="-2 2"/>
            <geom fromto="0 0 0 .4 0 0" mass="2"/>
            <body pos=".4 0 0"><joint name="j3" axis="0 1 0" range="-2.6 2.6"/>
              <geom fromto="0 0 0 .3 0 0" mass="1.5"/>
              <body pos=".3 0 0"><joint name="j4" axis="0 1 0" range="-2.6 2.6"/>
                <geom type="box" size=".02 .05 .03" pos=".03 0 0" mass=".4"/>
                <site name="tcp" pos=".12 0 0"/>
                <body pos=".06 0 0"><joint name="left" type="slide" axis="0 1 0" range="0 .04"/>
                  <geom type="box" size=".04 .008 .012" pos=".04 .01 0" mass=".05"/></body>
                <body pos=".06 0 0"><joint name="right" type="slide" axis="0 -1 0" range="0 .04"/>
                  <geom type="box" size=".04 .008 .012" pos=".04 -.01 0" mass=".05"/></body>
              </body></body></body></body></body></body></worldbody>
  <tendon><fixed name="split">
    <joint joint="left" coef=".5"/><joint joint="right" coef=".5"/></fixed></tendon>
  <equality><joint joint1="right" joint2="left"/></equality>
  <actuator><velocity joint="x" kv="2000"/><velocity joint="y" kv="2000"/>
    <velocity joint="yaw" kv="500"/><motor joint="lift" forcerange="-600 600"/>
    <motor joint="j1" forcerange="-80 80"/><motor joint="j2" forcerange="-120 120"/>
    <motor joint="j3" forcerange="-80 80"/><motor joint="j4" forcerange="-30 30"/>{grip}</actuator>
  </mujoco>"""


def model(grip: str = FINGERS) -> mujoco.MjModel:
    return mujoco.MjModel.from_xml_string(ROBOT.format(grip=grip))


def placed(of: mujoco.MjModel) -> hurcules.Robot:
    """The fingers, which are no coordinates, are open, the hand looks down over the box."""
    robot = hurcules.Robot(of, joints=BASE + ARM)
    qpos = robot.qpos
    for finger in ("left", "right"):
        qpos[of.joint(finger).qposadr[0]] = 0.035
    robot.set_qpos(qpos)
    robot.set_configuration([0.0, 0.0, 0.0, 0.1, 0.0, -0.5, 1.2, np.pi / 2 - 0.7])
    return robot


def reached(levels: list[str]) -> np.ndarray:
    """Where the base is after the hand was led by 0.1 m to the side."""
    of = model()
    robot = placed(of)
    tasks = {
        "hand": hurcules.PositionTask("hand", robot, "tcp"),
        "base": hurcules.PostureTask("base", robot, BASE),
        "posture": hurcules.PostureTask("posture", robot),
    }
    channels = {"hand": hurcules.Twist(tasks["hand"], 0.3)}
    controller = hurcules.WholeBodyController(robot, [tasks[name] for name in levels], channels)
    simulation = hurcules.Simulation(model=of, controller=controller)
    before = robot.position("tcp")
    simulation.step(500, {"hand": [0.0, 0.1, 0.0]})
    simulation.step(500)
    moved = simulation.data.site("tcp").xpos - before
    np.testing.assert_allclose(moved, [0.0, 0.1, 0.0], atol=1e-3)
    return np.array([simulation.data.joint(name).qpos[0] for name in BASE])


def test_a_base_on_a_level_of_its_own_rests_while_the_arm_reaches() -> None:
    assert np.abs(reached(["hand", "base", "posture"])).max() < 1e-4
    assert np.abs(reached(["hand", "posture"])).max() > 0.03


def side_speed(robot: hurcules.Robot) -> tuple[list[float], np.ndarray, list[float]]:
    """As docs/loop.md has it: the base rolls."""
    x, y, yaw = (robot.coordinate(name) for name in ("x", "y", "yaw"))
    sine, cosine = np.sin(robot.configuration[yaw]), np.cos(robot.configuration[yaw])
    row = np.zeros((1, robot.size))
    row[0, [x, y]] = -sine, cosine
    ahead = cosine * robot.velocity[x] + sine * robot.velocity[y]
    return [0.0], row, [-ahead * robot.velocity[yaw]]


@pytest.mark.parametrize(
    ("goal", "control", "rolls"),
    [
        ([1.0, 1.0, 0.0], "velocity", True),
        ([0.0, 1.5, 0.0], "velocity", True),
        ([-2.0, 0.1, 0.0], "velocity", True),
        ([0.0, 1.5, 0.0], "acceleration", True),
        ([0.0, 1.5, 0.0], "velocity", False),
    ],
)
def test_a_base_rolls_where_a_task_above_the_hand_says_so(
    goal: list[float], control: str, rolls: bool
) -> None:
    of = model()
    of.geom_contype[:] = 0  # the way leads over the table
    of.geom_conaffinity[:] = 0
    robot = placed(of)
    hand = hurcules.PositionTask("hand", robot, "tcp")
    posture = hurcules.PostureTask("posture", robot, ARM)
    wheels = [hurcules.CustomTask("rolls", robot, 1, side_speed)]
    levels = wheels * rolls + [hand, posture]
    controller = hurcules.WholeBodyController(robot, levels, control=control)
    simulation = hurcules.Simulation(model=of, controller=controller)
    target = robot.position("tcp") + goal
    hand.set_target(target)
    slipped, data = 0.0, simulation.data
    for _ in range(800):
        simulation.step(5)
        yaw = data.joint("yaw").qpos[0]
        aside = np.cos(yaw) * data.joint("y").qvel[0] - np.sin(yaw) * data.joint("x").qvel[0]
        slipped += float(abs(aside)) * 5 * simulation.dt
    np.testing.assert_allclose(data.site("tcp").xpos, target, atol=1e-4)
    assert slipped < 1e-3 if rolls else slipped > 0.1


ARM_URDF = """<robot name="arm"><link name="foot">{link}</link>
  <joint name="shoulder" type="revolute"><parent link="foot"/><child link="arm"/>
    <axis xyz="0 0 1"/><limit lower="-2" upper="2" effort="50" velocity="2"/></joint>
  <link name="arm">{link}</link>
  <joint name="end" type="fixed"><parent link="arm"/><child link="tool"/>
    <origin xyz="0.5 0 0"/></joint><link name="tool"/></robot>"""
LINK = """<inertial><mass value="3"/>
  <inertia ixx=".02" iyy=".02" izz=".02" ixy="0" ixz="0" iyz="0"/></inertial>"""


def test_a_robot_of_a_urdf_gets_a_base_as_the_page_says(root: Path, tmp_path: Path) -> None:
    page = (root / "docs" / "loop.md").read_text(encoding="utf-8")
    block = page[page.index('spec = hurcules.urdf_spec("arm.urdf")') :]
    (tmp_path / "arm.urdf").write_text(ARM_URDF.format(link=LINK))
    program = block[: block.index("def side_speed")]
    names: dict[str, Any] = {"hurcules": hurcules, "mujoco": mujoco}
    exec(program.replace("arm.urdf", str(tmp_path / "arm.urdf")), names)
    robot = hurcules.Robot(names["model"])
    assert robot.coordinate_names == ["x", "y", "yaw", "shoulder"]
    assert [one.max_velocity for one in robot.coordinates][:3] == [0.8, 0.8, 0.8]
    tool = hurcules.PositionTask("tool", robot, "tool", axes=[[1, 0, 0], [0, 1, 0]])
    controller = hurcules.WholeBodyController(robot, [tool], {"tool": hurcules.Twist(tool, 0.3)})
    simulation = hurcules.Simulation(model=names["model"], controller=controller)
    before = robot.position("tool")
    simulation.step(round(2.0 / simulation.dt), {"tool": [0.2, 0.3]})
    simulation.step(round(1.0 / simulation.dt))
    moved = simulation.data.body("tool").xpos - before
    np.testing.assert_allclose(moved, [0.4, 0.6, 0.0], atol=2e-3)


def test_fingers_on_a_rate_hold_a_box_while_the_hand_lifts_it() -> None:
    of = model()
    robot = placed(of)
    over = hurcules.PoseTask("hand", robot, "tcp")
    down = np.array([[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]])
    over.set_target([0.85, 0.0, 0.445], down)
    apart = [hurcules.self_collision(robot), hurcules.obstacles(robot)]
    found = hurcules.inverse_kinematics(robot, [*apart, over])
    assert found.reached
    robot.set_configuration(found.configuration)
    hand = hurcules.PoseTask("hand", robot, "tcp")
    posture = hurcules.PostureTask("posture", robot)
    channels = {"hand": hurcules.Twist(hand, 0.3), "grip": hurcules.JointRate("left", 0.05)}
    controller = hurcules.WholeBodyController(robot, [hand, posture], channels)
    simulation = hurcules.Simulation(model=of, controller=controller)
    simulation.step(1000, {"grip": [-0.03]})
    simulation.step(500, {"hand": [0.0, 0.0, 0.2, 0.0, 0.0, 0.0]})
    simulation.step(250)
    assert simulation.data.site("tcp").xpos[2] == pytest.approx(0.645, abs=2e-3)
    assert simulation.data.body("box").xpos[2] > 0.62


def test_a_gripper_on_a_tendon_is_moved_by_its_control() -> None:
    of = model(TENDON)
    robot = placed(of)
    with pytest.raises(hurcules.Error, match="joint with an actuator 'left' does not exist"):
        hurcules.WholeBodyController(
            robot,
            [hurcules.PostureTask("posture", robot)],
            {"grip": hurcules.JointRate("left", 0.05)},
        )
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    simulation = hurcules.Simulation(model=of, controller=controller)
    simulation.data.ctrl[of.actuator("grip").id] = 50.0
    simulation.step(500)
    fingers = [simulation.data.joint(name).qpos[0] for name in ("left", "right")]
    assert fingers == pytest.approx([50.0 * 0.0157 / 100.0] * 2, abs=5e-4)
    before = simulation.state()
    simulation.data.ctrl[of.actuator("grip").id] = 0.0
    simulation.restore(before)
    assert simulation.data.ctrl[of.actuator("grip").id] == 50.0


@pytest.mark.parametrize("holds", [True, False])
def test_a_stack_that_takes_over_goes_to_its_own_targets_unless_they_are_held(holds: bool) -> None:
    of = model()
    robot = placed(of)
    hands = [hurcules.PositionTask(name, robot, "tcp") for name in ("arm", "whole")]
    base = hurcules.DampingTask("base", robot, BASE)
    rest = [hurcules.PostureTask(name, robot) for name in ("first", "second")]
    stacks = {"arm": [base, hands[0], rest[0]], "whole": [hands[1], rest[1]]}
    channels = {"hand": hurcules.Twist(hands[0], 0.3)}
    controller = hurcules.WholeBodyController(robot, stacks=stacks, channels=channels)
    simulation = hurcules.Simulation(model=of, controller=controller)
    simulation.step(500, {"hand": [0.0, 0.1, 0.0]})
    simulation.step(250)
    before = simulation.data.site("tcp").xpos.copy()
    if holds:
        controller.hold_targets()
    controller.use("whole")
    simulation.step(1000)
    back = before - simulation.data.site("tcp").xpos
    np.testing.assert_allclose(back, [0.0, 0.0 if holds else 0.1, 0.0], atol=1e-3)


@pytest.mark.parametrize(("lead", "soon"), [(np.inf, False), (0.05, True)])
def test_a_stick_beyond_the_reach_is_paid_for_unless_the_lead_is_bounded(
    lead: float, soon: bool
) -> None:
    of = model()
    robot = hurcules.Robot(of, joints=ARM)
    robot.set_qpos(placed(of).qpos)
    hand = hurcules.PositionTask("hand", robot, "tcp")
    hand.max_lead = lead
    levels = [hand, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, levels, {"hand": hurcules.Twist(hand, 0.3)})
    simulation = hurcules.Simulation(model=of, controller=controller, physics=False)
    simulation.step(2500, {"hand": [0.3, 0.0, 0.0]})
    there = simulation.data.site("tcp").xpos[0]
    simulation.step(250, {"hand": [-0.3, 0.0, 0.0]})
    assert (simulation.data.site("tcp").xpos[0] < there - 0.05) == soon
