"""What docs/loop.md says to who comes from ROS 2: trajectories, joint states, wrenches."""

from __future__ import annotations

import copy

import mujoco
import numpy as np
import pytest
from numpy.typing import NDArray

import hurcules

ARM = """
<mujoco>
  <option timestep="0.001"/>
  <compiler angle="radian"/>
  <default>
    <joint axis="0 1 0" range="-2.6 2.6"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="2" contype="0" conaffinity="0"/>
  </default>
  <worldbody>
    <body pos="0 0 1"><joint name="c"/><geom/>
      <body pos="0.4 0 0"><joint name="a"/><geom/>
        <body pos="0.4 0 0"><joint name="b"/><geom size="0.04" mass="0.5"/>
          <body name="tool">
            <site name="cell"/><geom fromto="0 0 0 0.15 0 0" size="0.02" mass="1"/>
            <site name="tip" pos="0.17 0 0"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <sensor><force name="cell" site="cell"/></sensor>
</mujoco>"""
START = np.array([-0.6, 1.2, -0.6])


Parts = tuple[mujoco.MjModel, hurcules.Robot, mujoco.MjData]


@pytest.fixture
def parts() -> Parts:
    model = hurcules.with_motors(mujoco.MjSpec.from_string(ARM))
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    mujoco.mj_forward(model, data)
    return model, robot, data


def cubic(
    start: NDArray[np.float64], speed: NDArray[np.float64], end: NDArray[np.float64], time: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Where the way of two seconds from `start` to `end` is, and how fast."""
    way, seconds = end - start, 2.0
    second = 3.0 * way / seconds**2 - 2.0 * speed / seconds
    third = -2.0 * way / seconds**3 + speed / seconds**2
    place = start + speed * time + second * time**2 + third * time**3
    return place, speed + 2.0 * second * time + 3.0 * third * time**2


def test_a_trajectory_is_followed_preempted_and_cancelled(parts: Parts) -> None:
    model, robot, data = parts
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture])
    off, speeds = [], [np.zeros(3)]

    def tick() -> None:
        data.ctrl[:] = controller.tick(data.qpos, data.qvel)
        mujoco.mj_step(model, data)
        speeds.append(np.array(controller.qd_des))

    for goal, ticks in (([0.4, 0.6, 0.3], 1200), ([-0.9, 0.9, -0.2], 1000)):  # the second preempts
        start, speed = np.array(controller.q_des), np.array(controller.qd_des)
        for time in np.arange(1, ticks + 1) * controller.dt:
            place, rate = cubic(start, speed, np.array(goal), time)
            posture.set_target(place, rate)
            tick()
            off.append(np.abs(data.qpos - place).max())
    assert np.abs(speeds[-1]).max() > 0.5
    assert max(off) < 2e-3
    controller.hold_targets()  # cancels in the middle
    there = data.qpos.copy()
    for _ in range(1000):
        tick()
    assert np.abs(data.qpos - there).max() < 0.03
    assert np.abs(data.qvel).max() < 1e-3
    assert np.abs(np.diff(speeds, axis=0)).max() < 20.0 * controller.dt * (1.0 + 1e-9)


@pytest.mark.parametrize(("bridge", "most"), [("last", 1.6), ("plan", 0.3), ("model", 5e-3)])
def test_a_silence_is_bridged_by_the_plan_or_the_model(
    parts: Parts, bridge: str, most: float
) -> None:
    """Joint states that do not come for 0.3 s, in motion: the last one once more is worse."""
    model, robot, data = parts
    tip = hurcules.PositionTask("tip", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    stack = [tip, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, stack, {"tip": hurcules.Twist(tip, 0.3)})
    seen, off = data, []
    for tick in range(800):
        if tick == 500 and bridge == "model":
            seen = copy.copy(data)  # goes on as the model says
        if tick < 500 or bridge == "model":
            qpos, qvel = seen.qpos.copy(), seen.qvel.copy()
            lag, slower = qpos - controller.q_des, qvel - controller.qd_des
        elif bridge == "plan":
            qpos, qvel = controller.q_des + lag, controller.qd_des + slower
        command = {"tip": [-0.2, 0.2]} if tick < 500 else None
        data.ctrl[:] = controller.tick(qpos, qvel, command)
        mujoco.mj_step(model, data)
        if seen is not data:
            seen.ctrl[:] = data.ctrl
            mujoco.mj_step(model, seen)
        off.append(np.abs(data.qpos - controller.q_des).max())
    assert max(off[500:]) < most
    assert bridge != "last" or max(off) > 1.0


def test_joint_states_are_told_by_name(parts: Parts) -> None:
    model, _, _ = parts
    names, places, speeds = ["b", "c", "a"], [0.3, 0.1, 0.2], [3.0, 1.0, 2.0]
    qpos, qvel = model.qpos0.copy(), np.zeros(model.nv)
    for name, place, speed in zip(names, places, speeds, strict=True):
        qpos[model.joint(name).qposadr] = place
        qvel[model.joint(name).dofadr] = speed
    assert (qpos.tolist(), qvel.tolist()) == ([0.1, 0.2, 0.3], [1.0, 2.0, 3.0])


def test_the_weight_of_a_tool_is_taken_off_as_it_turns(parts: Parts) -> None:
    """A tare holds while the axis keeps its direction: 0.8 rad make 7 N of a kilogram."""
    model, robot, data = parts
    press = hurcules.ForceTask("press", robot, "tip", reference="tip", axis=[1.0, 0.0, 0.0])
    turn = hurcules.OrientationTask("turn", robot, "tip")
    stack = [press, turn, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, stack, {"turn": hurcules.Twist(turn, 1.0)})
    press.enable(False)
    for tick in range(1500):
        weight = -1.0 * (controller.plan.orientation("tip").T @ model.opt.gravity)
        press.sense(controller.plan, data.sensor("cell").data[0] - weight[0])
        command = {"turn": [0.0, 0.8, 0.0]} if tick < 1000 else None
        data.ctrl[:] = controller.tick(data.qpos, data.qvel, command)
        mujoco.mj_step(model, data)
    assert data.sensor("cell").data[0] == pytest.approx(-7.04, abs=0.01)
    assert press.force == pytest.approx(0.0, abs=0.02)


def test_what_a_model_excludes_is_no_pair() -> None:
    link = '<body name="{}" pos="0.2 0 0"><joint/><geom size="0.05"/>{}</body>'
    chain = ""
    for name in "edcba":
        chain = link.format(name, chain)
    spec = mujoco.MjSpec.from_string(f"<mujoco><worldbody>{chain}</worldbody></mujoco>")
    before = hurcules.Robot(hurcules.with_motors(spec))
    pairs = [("a", "c"), ("a", "d"), ("a", "e"), ("b", "d"), ("b", "e"), ("c", "e")]
    assert len(hurcules.self_collision(before).pairs(before)) == len(pairs)
    for first, second in pairs:
        spec.add_exclude(bodyname1=first, bodyname2=second)
    after = hurcules.Robot(hurcules.with_motors(spec))
    assert hurcules.self_collision(after).pairs(after) == []
