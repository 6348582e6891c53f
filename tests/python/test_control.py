"""Stack, controller, servo and snapshots from Python: what wrong input is answered with.

Strategy: each wrong call on the smallest robot, and the words of the answer; a default. Not tested
here: what the controller computes (C++ tests, examples).
"""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

import hurcules

PENDULUM = """
<mujoco>
  <worldbody>
    <body><joint name="slide" type="slide" axis="1 0 0"/><geom size="0.1"/>
      <body><joint name="swing" axis="0 1 0"/><geom size="0.1" pos="0 0 -1"/>
        <site name="tip" pos="0 0 -1"/></body></body>
  </worldbody>
</mujoco>
"""


@pytest.fixture
def robot() -> hurcules.Robot:
    return hurcules.Robot(mujoco.MjModel.from_xml_string(PENDULUM))


def hand(robot: hurcules.Robot) -> hurcules.PositionTask:
    return hurcules.PositionTask("hand", robot, "tip")


def controller(robot: hurcules.Robot) -> hurcules.VelocityController:
    return hurcules.VelocityController(robot)


WRONG: list[tuple[Callable[[hurcules.Robot], object], str]] = [
    (lambda r: hurcules.Stack("ab"), "a level wants tasks, a str came"),
    (lambda r: hurcules.Stack(["ab"]), "a level wants tasks, a str came"),
    (lambda r: hurcules.Stack([[[hand(r)]]]), "a level wants tasks, a list came"),
    (lambda r: hurcules.Stack([]), "a stack wants at least one level"),
    (lambda r: hurcules.Stack([[]]), "an empty list came"),
    (lambda r: hurcules.StackLevel("a", [3]), "a level wants tasks, a int came"),
    (lambda r: controller(r).compute(r), "a controller wants a stack before it computes"),
    (lambda r: controller(r).step(r), "a controller wants a stack before it computes"),
    (lambda r: controller(r).integrate([1.0, 2.0, 3.0]), "integrate wants 2 finite numbers, got 3"),
    (lambda r: controller(r).integrate([1.0, np.nan]), "got 2, not all finite"),
    (
        lambda r: hand(r).advance([0.0, 0.0, 0.1], np.nan),
        "dt of task 'hand' wants a finite time, got nan",
    ),
    (lambda r: hurcules.PositionTask("p", r, "tip", axes=np.zeros((1, 3))), "one of length 0 came"),
    (
        lambda r: hurcules.PositionTask("p", r, "hnad"),
        "frame 'hnad' does not exist; there are: tip",
    ),
    (lambda r: r.coordinate("elbow"), "coordinate 'elbow' does not exist; there are: slide, swing"),
]


@pytest.mark.parametrize(("call", "text"), WRONG)
def test_wrong_input_says_what_was_wanted_and_what_came(
    robot: hurcules.Robot, call: Callable[[hurcules.Robot], object], text: str
) -> None:
    with pytest.raises(hurcules.Error) as error:
        call(robot)
    assert text in str(error.value)
    assert "\n" not in str(error.value)


def test_the_law_is_to_arrive_unless_another_one_is_named() -> None:
    for options in (hurcules.VelocityControllerOptions, hurcules.AccelerationControllerOptions):
        assert options().law == "arrive"
        assert options().solver.handover == "strict"
        assert options(law="thesis").law == "thesis"
        with pytest.raises(hurcules.Error, match="law wants 'arrive' or 'thesis', got 'fast'"):
            options(law="fast")


def test_the_servo_refuses_nan() -> None:
    one = np.ones(1)
    pid = hurcules.JointPid(hurcules.JointPidOptions(K=one, K_P=2 * one, K_I=one, max_torque=one))
    with pytest.raises(hurcules.Error, match="want finite numbers"):
        pid.compute([np.nan], [0.0])


def test_a_broken_model_is_one_line(tmp_path) -> None:
    path = tmp_path / "broken.xml"
    path.write_text("<mujoco>\n  <worldbody><body><geom/></body></worldbody>\n</mujoco>")
    with pytest.raises(hurcules.Error, match="cannot be loaded") as error:
        hurcules.Robot(path)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize("spoil", ["all", "middle", "count", "short", "long"])
def test_a_wrong_snapshot_changes_nothing(spoil: str) -> None:
    simulation = hurcules.Simulation("stretch", seed=0)
    simulation.step(50)
    before = simulation.state()
    wrong = before.copy()
    if spoil == "all":
        wrong[:] = np.nan
    elif spoil == "middle":
        wrong[40] = np.nan
    elif spoil == "count":
        wrong[0] = -1.5
    else:
        wrong = wrong[:-3] if spoil == "short" else np.append(wrong, 0.0)
    with pytest.raises(hurcules.Error, match="snapshot"):
        simulation.restore(wrong)
    assert np.array_equal(simulation.state(), before, equal_nan=True)
    simulation.step(10)
    assert not simulation.finished
