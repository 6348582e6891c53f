"""docs/safety.md: what it says is on is on, and its programs do what it says.

Strategy: an arm of four joints beside a person, led by the blocks of the page themselves, in plain
MuJoCo. Not tested: the figures of the tables, which were measured once, on other robots.
"""

import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules

START, FAST = [0.3, -0.6, 1.2, -0.3], 2.0  # [rad], [rad/s]
ARM = """<mujoco><option timestep="0.001"/><compiler angle="radian"/>
  <default><joint axis="0 1 0" armature="0.05" range="-2.6 2.6"/><default class="link">
    <geom type="capsule" size="0.04" fromto="0 0 0 0.35 0 0" mass="2"/></default></default>
  <custom><numeric name="velocity_limit_turn" data="2"/><numeric name="velocity_limit_a" data="2"/>
    <numeric name="velocity_limit_b" data="2"/><numeric name="velocity_limit_c" data="2"/></custom>
  <worldbody><geom name="table" type="box" size="0.4 0.4 0.02" pos="0.6 0 0.2"/>
    <body pos="0 0 0.9" childclass="link"><joint name="turn" axis="0 0 1"/>
      <geom fromto="0 0 -.2 0 0 -.1"/>
      <body><joint name="a"/><geom/><body pos="0.35 0 0"><joint name="b"/><geom/>
        <body pos="0.35 0 0"><joint name="c"/><geom/><site name="tip" pos="0.35 0 0"/></body>
      </body></body></body>
    <body name="person" mocap="true" pos="3 0 0.9">
      <geom type="capsule" size="0.2" fromto="0 0 -0.5 0 0 0.5"/></body></worldbody>
  <actuator><motor joint="turn" forcerange="-150 150"/><motor joint="a" forcerange="-150 150"/>
    <motor joint="b" forcerange="-100 100"/><motor joint="c" forcerange="-50 50"/></actuator>
</mujoco>"""


class Cell:
    """Arm, controller and physics; `blocks` are the programs of the page by what they contain."""

    def __init__(self, page: str, control: str = "velocity") -> None:
        self.blocks = re.findall(r"```python\n(.*?)```", page, re.DOTALL)
        self.model = mujoco.MjModel.from_xml_string(ARM)
        self.robot = hurcules.Robot(self.model)
        self.robot.set_configuration(START)
        self.limits = hurcules.JointLimits("limits", self.robot)
        self.hand = hurcules.PositionTask("hand", self.robot, "tip")
        posture = hurcules.PostureTask("posture", self.robot)
        posture.set_max_speed(5.0)
        clear = hurcules.obstacles(self.robot, bodies=["person"], margin=0.1, most=0.5)
        channels = {
            "hand": hurcules.Twist(self.hand, 0.3),
            "posture": hurcules.Target(posture),
            "joints": hurcules.JointRates(["turn", "a", "b", "c"], 3.0),
        }
        self.controller = hurcules.WholeBodyController(
            self.robot,
            channels=channels,
            stacks={
                "work": [self.limits, clear, self.hand, posture],
                "posture": [self.limits, posture],
                "other": [posture],
            },
            control=control,
        )
        self.data = mujoco.MjData(self.model)
        self.data.qpos[:] = self.robot.qpos

    def program(self, word: str) -> dict[str, Any]:
        """Runs the block of the page with this word in it; the names that it then has."""
        names = {"np": np, "hurcules": hurcules, "robot": self.robot, "controller": self.controller}
        names["print"] = lambda error: None
        exec(next(block for block in self.blocks if word in block), names)
        return names

    def go(self, ticks: int, command: dict[str, Any] | None = None) -> np.ndarray:
        """Speeds of the joints [rad/s] after each tick."""
        speeds = np.empty((ticks, self.model.nv))
        for speed in speeds:
            data = self.data
            data.ctrl[:] = self.controller.tick(data.qpos, data.qvel, command)
            mujoco.mj_step(self.model, data)
            speed[:] = data.qvel
        return speeds


@pytest.fixture(scope="module")
def page(root: Path) -> str:
    return (root / "docs/safety.md").read_text(encoding="utf-8")


def test_without_a_word_there_is_what_the_table_says(page: str) -> None:
    model = mujoco.MjModel.from_xml_string(re.sub(r"<custom>.*?</custom>", "", ARM, flags=re.S))
    robot = hurcules.Robot(model)
    limits = hurcules.JointLimits("limits", robot)
    assert np.all(np.isinf(limits.max_velocity)) and "| speed of the joints | **none**" in page
    assert limits.upper == pytest.approx([2.6] * 4)
    options = (hurcules.VelocityControllerOptions(), hurcules.AccelerationControllerOptions())
    assert [one.max_acceleration for one in options] == [20.0, 20.0]
    assert "20 rad/s^2; by torques 200" in page
    assert hurcules.ContactOptions().f_max == 150.0 and "`f_max` (150 N)" in page
    hand = hurcules.PositionTask("hand", robot, "tip")
    assert hand.max_speed == 0.5 and "`set_max_speed` (0.5 m/s)" in page


def test_limits_hold_in_the_stacks_that_name_them_alone(page: str) -> None:
    cell = Cell(page)
    cell.limits.set_max_velocities(np.full(4, 0.1))
    goal = {"posture": np.add(START, 1.0)}
    cell.controller.use("posture")
    assert np.abs(cell.go(500, goal)).max() < 0.15
    cell.controller.use("other")
    assert np.abs(cell.go(500, goal)).max() > 0.5
    cell.controller.use("posture")
    cell.go(300, goal)
    cell.controller.move_joints()
    cell.go(400, {"joints": [-3.0, 0.0, 0.0, 0.0]})
    assert cell.controller.qd_des[0] == pytest.approx(-FAST)  # the model's


def at_speed(cell: Cell) -> tuple[np.ndarray, float]:
    """Where the first joint is when it turns as fast as it may, and its speed."""
    cell.controller.use("posture")
    cell.go(300, {"posture": [2.4, *START[1:]]})
    assert cell.data.qvel[0] == pytest.approx(FAST, abs=0.05)
    return cell.data.qpos.copy(), float(cell.data.qvel[0])


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_a_stop_is_as_short_as_its_formula_and_nothing_goes_on_by_itself(
    page: str, control: str
) -> None:
    cell = Cell(page, control)
    before, speed = at_speed(cell)
    cell.program("move_joints()")
    assert np.abs(cell.go(1000)[152:]).max() < 0.01
    way = cell.data.qpos - before
    assert way[0] == pytest.approx(speed**2 / 40.0, rel=0.06)
    rests = cell.data.qpos.copy()
    cell.data.mocap_pos[0] = [1.0, 0.0, 0.9]  # nobody who comes near moves it
    assert np.abs(cell.go(300)).max() < 1e-3
    cell.program("hold_targets()")
    assert np.abs(cell.go(500)).max() < 0.01
    assert cell.data.qpos == pytest.approx(rests, abs=1e-3)


def test_a_stop_before_the_end_of_a_range_is_no_harder(page: str) -> None:
    cell = Cell(page)
    cell.controller.use("posture")
    goal = {"posture": [4.0, *START[1:]]}
    while cell.data.qpos[0] < 2.45:
        cell.go(1, goal)
    cell.controller.move_joints()
    speeds = [cell.controller.qd_des[0]]
    for _ in range(300):
        cell.go(1)
        speeds.append(cell.controller.qd_des[0])
    assert np.abs(np.diff(speeds)).max() < 20.0 * 1e-3 * 1.01
    assert speeds[-1] == 0.0


def test_who_only_holds_the_targets_sees_the_arm_come_back(page: str) -> None:
    cell = Cell(page)
    before, _ = at_speed(cell)
    cell.controller.hold_targets()
    speeds = cell.go(1500)
    assert cell.data.qpos[0] == pytest.approx(before[0], abs=0.01)
    assert speeds[:, 0].min() < -0.3
    assert np.abs(speeds[-1]).max() < 0.01


def test_a_controller_that_is_called_twice_goes_twice_as_fast(page: str) -> None:
    ways = []
    for times in (1, 2):
        cell = Cell(page)
        before = cell.data.qpos.copy()
        for _ in range(500):
            for _ in range(times):
                cell.data.ctrl[:] = cell.controller.tick(
                    cell.data.qpos, cell.data.qvel, {"hand": [0.0, 0.1, 0.0]}
                )
            mujoco.mj_step(cell.model, cell.data)
        ways.append(cell.data.qpos[0] - before[0])
    assert ways[1] == pytest.approx(2.0 * ways[0], rel=0.05)


def spoiled(qpos: np.ndarray, joint: int, by: float) -> np.ndarray:
    qpos = qpos.copy()
    qpos[joint] += by
    return qpos


FAULTS: dict[str, Callable[..., tuple[Any, Any, Any]]] = {
    "a spike": lambda k, q, v, c, held: (spoiled(q, 1, 0.3 * (k == 0)), v, c),
    "no number": lambda k, q, v, c, held: (spoiled(q, 1, np.nan), v, c),
    "a jump": lambda k, q, v, c, held: (spoiled(q, 1, 0.3), v, c),
    "a command that is none": lambda k, q, v, c, held: (q, v, {"hand": [np.nan] * 3}),
    "a frozen encoder": lambda k, q, v, c, held: (
        spoiled(q, 1, held[1] - q[1]),
        v * [1, 0, 1, 1],
        c,
    ),
    "an arm that is pushed": lambda k, q, v, c, held: (q, v, c),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_the_guard_lets_a_spike_pass_and_stops_what_stays(page: str, fault: str) -> None:
    cell = Cell(page)
    model, data = cell.model, cell.data
    cell.controller.use("work")
    period, held, stopped = cell.program("def period")["period"], None, None
    fastest = 0.0
    for tick in range(2500):
        turn = 2.0 * np.pi * tick * 1e-3
        command = {"hand": [0.0, 0.25 * np.cos(turn), 0.25 * np.sin(turn)]}
        qpos, qvel = data.qpos.copy(), data.qvel.copy()
        if tick >= 1000:
            held = qpos if held is None else held
            qpos, qvel, command = FAULTS[fault](tick - 1000, qpos, qvel, command, held)
            if fault == "an arm that is pushed":
                data.qfrc_applied[1] = 200.0
        controls = period(qpos, qvel, command)
        if controls is None:
            stopped = tick - 1000
            break
        data.ctrl[:] = controls
        mujoco.mj_step(model, data)
        fastest = max(fastest, np.abs(data.qvel).max())
    if fault == "a spike":
        assert stopped is None
        assert fastest < FAST
    else:
        assert stopped is not None and stopped < 50
        assert fastest < 4.0
    if fault != "an arm that is pushed":
        assert fastest < FAST
