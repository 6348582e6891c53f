"""In a Simulation distances see the bodies around the robot move.

Strategy: an arm holds its hand's place, a ball flies at it, free or as a mocap body that somebody
moves each tick or every twentieth. Nobody tells the task; the least distance of the robot as it is,
measured by MuJoCo, stays near the margin. What set_obstacle says counts more; what does not look is
touched. Tasks in frames that move are warned of.
Not tested here: obstacles that are told (test_collision.py).
"""

from __future__ import annotations

import re
import warnings

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" gravity="0 0 0"/>
  <default><joint range="-2.8 2.8" limited="true" armature="0.1"/>
    <geom type="capsule" size="0.04" density="300"/></default>
  <worldbody>
    <body name="hung" mocap="true" pos="0 4 0.8">
      <body name="held"><geom name="held" type="sphere" size="0.1"/></body></body>
    <body name="flying" pos="0 0 5"><freejoint/>
      <geom name="flying" type="sphere" size="0.1" density="1000"/></body>
    <body name="base" pos="0 0 0.8"><geom name="base" type="sphere" size="0.06"/>
      <body name="upper"><joint name="j1" axis="0 0 1"/><joint name="j2" axis="0 1 0"/>
        <geom name="upper" fromto="0.12 0 0 0.35 0 0"/>
        <body name="lower" pos="0.4 0 0"><joint name="j3" axis="0 0 1"/>
          <joint name="j4" axis="0 1 0"/><geom name="lower" fromto="0.08 0 0 0.35 0 0"/>
          <site name="tip" pos="0.4 0 0"/></body></body></body>
  </worldbody>
  <actuator><motor joint="j1" forcerange="-200 200"/><motor joint="j2" forcerange="-200 200"/>
    <motor joint="j3" forcerange="-90 90"/><motor joint="j4" forcerange="-90 90"/></actuator>
</mujoco>
"""
MARGIN, SPEED = 0.03, 0.3  # [m], [m/s]


class Loop:
    """The arm in the loop, and a ball that comes at its forearm."""

    def __init__(self, body: str = "hung", control: str = "velocity") -> None:
        self.model = mujoco.MjModel.from_xml_string(ARM)
        self.robot = hurcules.Robot(self.model, ["j1", "j2", "j3", "j4"])
        self.robot.set_configuration([-0.6, 0.0, 0.9, 0.2])
        self.clear = hurcules.obstacles(self.robot, [body], margin=MARGIN)
        hand = hurcules.PositionTask("hand", self.robot, "tip")
        controller = hurcules.WholeBodyController(self.robot, [self.clear, hand], control=control)
        self.simulation = hurcules.Simulation(model=self.model, controller=controller)
        data = self.simulation.data
        self.start = data.site("tip").xpos - [0.1, 0.6, 0.0]
        self.ball = {"hung": "held", "flying": "flying"}[body]
        if body == "flying":
            data.qpos[:3], data.qvel[1] = self.start, SPEED

    def least(self, ticks: int = 3000, every: int = 1) -> float:
        """The least distance [m]; the mocap body is moved in every n-th tick."""
        data, least = self.simulation.data, np.inf
        pairs = [(self.model.geom(g).id, self.model.geom(self.ball).id) for g in ("upper", "lower")]
        for _ in range(ticks):
            tick = round(self.simulation.time / self.simulation.dt)
            if self.ball == "held" and tick % every == 0:
                data.mocap_pos[0] = self.start + SPEED * self.simulation.time * np.eye(3)[1]
            self.simulation.step()
            for pair in pairs:
                least = min(least, mujoco.mj_geomDistance(self.model, data, *pair, 1.0, None))
        assert not self.simulation.finished
        return least


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
@pytest.mark.parametrize("body", ["flying", "hung"])
def test_the_arm_gives_way_to_what_nobody_tells_it_of(body: str, control: str) -> None:
    assert MARGIN - 4e-3 < Loop(body, control).least() < MARGIN + 8e-3


def test_a_mocap_body_may_move_in_every_twentieth_tick() -> None:
    assert MARGIN - 0.01 < Loop().least(every=20) < MARGIN + 0.01


def test_what_the_user_says_counts_more() -> None:
    loop = Loop()
    loop.clear.set_obstacle(loop.robot, "held", [0.0, 9.0, 0.0])
    assert loop.least() < 2e-3
    assert loop.clear.error.min() == 0.15  # nothing is near
    loop.clear.clear_obstacles()
    loop.simulation.step(1)
    assert loop.clear.error.min() < 0.15


def test_what_does_not_look_is_touched() -> None:
    loop = Loop()
    loop.clear.sees_obstacles = False
    assert loop.least() < 2e-3


def test_a_run_goes_on_from_its_state_to_the_bit() -> None:
    one, other = Loop(), Loop()
    one.least(1500, every=20)
    other.simulation.restore(one.simulation.state())
    other.simulation.data.mocap_pos[:] = one.simulation.data.mocap_pos
    one.least(600, every=20)
    other.least(600, every=20)
    assert np.array_equal(one.simulation.state(), other.simulation.state(), equal_nan=True)


def test_a_task_in_a_frame_that_moves_unseen_is_warned_of() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, ["j1", "j2", "j3", "j4"])
    for frame, base, said in (
        ("flying", "held", "'flying', which may move: .* late by its speed / gain"),
        ("held", "sensed", "'held', which may move: no plan sees a mocap body move"),
        ("flying", "sensed", ""),
        ("base", "held", ""),
    ):
        hand = hurcules.RelativePoseTask("hand", robot, "tip", frame)
        controller = hurcules.WholeBodyController(robot, [hand], base=base)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            hurcules.Simulation(model=model, controller=controller)
        texts = [str(one.message) for one in caught]
        assert len(texts) == (1 if said else 0)
        assert all(re.search(said, text) for text in texts)
