"""Targets that rest stay, whatever overloads the motors; those that a rate moves do not run ahead.

Strategy: an arm of weak motors is pushed off its place, or sent behind a wall that is then taken
away, under each law of control: the hand comes to where it was told to be, no reference jumps or
runs away from the robot meanwhile. A hand that a rate drives at the wall stays near it.
Not tested here: what is asked of the motors (test_yielding.py).
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" integrator="implicitfast"/>
  <default><joint axis="0 1 0" armature="0.05" damping="0.5" range="-2.6 2.6" limited="true"/>
    <geom type="capsule" size="0.03" contype="0" conaffinity="0" mass="1"/></default>
  <worldbody>
    <body name="wall" mocap="true" pos="3 0 1"><geom type="box" size="0.05 1 1" contype="1"/></body>
    <body pos="0 0 1"><joint name="turn" axis="0 0 1"/><joint name="shoulder"/>
      <geom fromto="0 0 0 0.4 0 0"/>
      <body pos="0.4 0 0"><joint name="elbow"/><geom fromto="0 0 0 0.4 0 0"/>
        <body name="hand" pos="0.4 0 0"><joint name="wrist"/>
          <geom fromto="0 0 0 0.1 0 0" mass="0.3"/>
          <geom type="sphere" size="0.04" pos="0.1 0 0" mass="0.1" conaffinity="1"/>
          <site name="tip" pos="0.1 0 0"/></body></body></body>
  </worldbody>
  <actuator><motor joint="turn" forcerange="-40 40"/><motor joint="shoulder" forcerange="-40 40"/>
    <motor joint="elbow" forcerange="-25 25"/><motor joint="wrist" forcerange="-8 8"/></actuator>
</mujoco>
"""
START = [0.0, -0.9, 1.7, -0.8]
CONTROLS = ["velocity", "acceleration", "torque"]
LIMIT = 20.0  # [rad/s^2] of references


class Arm:
    """The arm in the loop, its hand, and what its references do."""

    def __init__(self, control: str) -> None:
        self.model = mujoco.MjModel.from_xml_string(ARM)
        robot = hurcules.Robot(self.model)
        robot.set_configuration(START)
        self.hand = hurcules.PositionTask("hand", robot, "tip")
        self.posture = hurcules.PostureTask("posture", robot)
        controller = hurcules.WholeBodyController(
            robot,
            [self.hand, self.posture],
            {"hand": hurcules.Twist(self.hand, 0.3), "place": hurcules.Target(self.hand)},
            control=control,
        )
        self.simulation = hurcules.Simulation(model=self.model, controller=controller)
        self.change, self.ahead = 0.0, 0.0  # [rad/s^2] of references; [rad] of the robot

    @property
    def tip(self) -> np.ndarray:
        """(3,) [m]."""
        return self.simulation.data.site("tip").xpos.copy()

    def run(self, ticks: int, command: dict | None = None) -> float:
        """The fastest that the hand was [m/s]."""
        controller, fastest = self.simulation.controller, 0.0
        for _ in range(ticks):
            before, tip = controller.qd_des.copy(), self.tip
            self.simulation.step(1, command)
            fastest = max(fastest, float(np.linalg.norm(self.tip - tip)) / self.simulation.dt)
            self.change = max(self.change, float(np.abs(controller.qd_des - before).max()))
            ahead = np.abs(controller.q_des - self.simulation.data.qpos[:4]).max()
            self.ahead = max(self.ahead, float(ahead))
        assert not self.simulation.finished
        return fastest

    def push(self, force: list[float]) -> None:
        """A force (3,) [N] on the hand from now on."""
        self.simulation.data.xfrc_applied[self.model.body("hand").id, :3] = force

    def wall_at(self, x: float) -> None:
        """The near face of the wall [m]."""
        self.simulation.data.mocap_pos[0, 0] = x + 0.05


@pytest.mark.parametrize("set_by", ["set_target", "channel", "nobody"])
@pytest.mark.parametrize("control", CONTROLS)
def test_a_hand_that_is_pushed_away_comes_back(control: str, set_by: str) -> None:
    arm = Arm(control)
    goal = arm.hand.target.copy()
    if set_by != "nobody":
        goal += [0.05, 0.1, 0.05]
    if set_by == "channel":
        arm.run(1, {"place": goal})
    elif set_by == "set_target":
        arm.hand.set_target(goal)
    arm.run(2000)
    settled = float(np.linalg.norm(arm.tip - goal))
    arm.push([0.0, 120.0, 0.0])
    arm.run(2000)
    assert np.linalg.norm(arm.tip - goal) > 0.1, "the push was too weak"
    arm.push([0.0, 0.0, 0.0])
    arm.change = 0.0  # references that are pushed follow at once
    arm.run(5000)
    assert arm.hand.target == pytest.approx(goal, abs=1e-9)
    assert np.linalg.norm(arm.tip - goal) < settled + 1e-3
    assert np.abs(arm.simulation.data.qvel).max() < 0.01
    if control != "torque":  # there is no reference
        assert arm.change <= LIMIT * arm.simulation.dt * (1 + 1e-9)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_hand_that_a_wall_stopped_comes_to_its_target_when_the_wall_goes(control: str) -> None:
    arm = Arm(control)
    arm.run(500)
    arm.wall_at(arm.tip[0] + 0.04 + 0.03)
    goal = arm.tip + np.array([0.2, 0.0, 0.0])
    arm.hand.set_target(goal)
    arm.run(4000)
    assert np.linalg.norm(arm.tip - goal) > 0.15, "nothing was in the way"
    if control != "torque":
        assert arm.ahead < 0.1  # the reference waits for the robot
    arm.wall_at(3.0)
    arm.change = 0.0
    fastest = arm.run(3000)
    assert np.linalg.norm(arm.tip - goal) < 1e-3
    assert fastest < (0.6 if control != "torque" else 1.5)  # max_speed is 0.5 m/s
    if control != "torque":
        assert arm.change <= LIMIT * arm.simulation.dt * (1 + 1e-9)


@pytest.mark.parametrize("control", ["velocity", "acceleration"])
def test_a_target_that_a_rate_drives_at_a_wall_stays_near_it(control: str) -> None:
    arm = Arm(control)
    arm.run(500)
    arm.wall_at(arm.tip[0] + 0.04 + 0.03)
    wall = arm.tip[0] + 0.03
    arm.run(4000, {"hand": [0.1, 0.0, 0.0]})  # 0.4 m
    assert arm.hand.target[0] - wall < 0.06
    back = arm.tip[0]
    arm.run(1000, {"hand": [-0.1, 0.0, 0.0]})
    assert back - arm.tip[0] > 0.03  # it comes back within half a second


def test_a_run_goes_on_to_the_bit_while_targets_come_back() -> None:
    one, other = Arm("velocity"), Arm("velocity")
    one.push([0.0, 120.0, 0.0])
    one.run(1500)
    one.push([0.0, 0.0, 0.0])
    for ticks in (200, 900):  # before it comes back, and on its way
        one.run(ticks)
        other.simulation.restore(one.simulation.state())
        one.run(300)
        other.run(300)
        assert np.array_equal(one.simulation.state(), other.simulation.state(), equal_nan=True)


def test_who_sets_a_target_anew_meanwhile_has_the_last_word() -> None:
    arm = Arm("velocity")
    arm.push([0.0, 120.0, 0.0])
    arm.run(1500)
    arm.push([0.0, 0.0, 0.0])
    arm.run(900)
    goal = arm.tip + np.array([0.0, 0.02, 0.02])
    arm.hand.set_target(goal)
    arm.run(3000)
    assert np.array_equal(arm.hand.target, goal)
    assert arm.tip == pytest.approx(goal, abs=1e-3)
