"""An operator beside a mission: answers what it asks, pauses it, takes over and hands back.

Strategy: the small table of test_mission_table.py, asked and interrupted at known ticks.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Error
from test_mission_table import ARM, ROWS, loop

ASKS = ROWS.replace("q/j2 >= 2.0", "q/j2 >= 0.1 for 0.05 s")


def asking() -> hurcules.Simulation:
    simulation = loop(ASKS)
    while not simulation.question:
        assert simulation.step(1) == 1
    return simulation


def test_what_a_mission_asks_is_said_and_answered() -> None:
    simulation = asking()
    assert simulation.question == "phase 'up': q/j2 >= 0.1 for 0.05 s; go on?"
    time, text = simulation.events()[-1]
    assert (time, text) == (pytest.approx(simulation.time), "asks in phase up")
    saved = simulation.state()
    simulation.step(200)
    assert simulation.question
    simulation.answer(False)
    simulation.step(2)
    assert (simulation.phase, simulation.question) == ("back", "")  # lower
    with pytest.raises(Error, match="nothing is asked now"):
        simulation.answer(True)
    simulation.restore(saved)
    for neither in (None, 2.0, "yes"):
        with pytest.raises(TypeError):
            simulation.answer(neither)
    simulation.answer(True)
    answered = simulation.state()
    for _ in range(2):
        simulation.step(1)
        assert (simulation.phase, simulation.question) == ("up", "")
        simulation.restore(answered)  # an answer is part of the state
    with pytest.raises(Error, match="nothing is asked now"):
        loop().answer(True)


def test_a_yes_holds_until_the_trouble_has_been_away() -> None:
    simulation = asking()
    simulation.answer(True)
    simulation.step(20)  # the trouble lasts: it was lowered one tick after the yes
    assert (simulation.phase, simulation.question) == ("up", "")
    saved = simulation.state()
    simulation.step(20)
    assert simulation.phase == "up"
    simulation.restore(saved)
    simulation.step(20)
    assert simulation.phase == "up"  # what was excused is part of the state
    simulation.pause()
    simulation.step(100, {"posture": [0.0, -1.5]})  # away
    simulation.resume()
    while simulation.phase == "up":
        assert simulation.step(1) == 1 and not simulation.question
    assert simulation.data.joint("j2").qpos < 0.2  # here again, and its one question is used up


def test_what_is_asked_waits_for_the_end_of_a_pause() -> None:
    simulation = asking()
    simulation.pause()
    with pytest.raises(Error, match="the mission is paused: resume"):
        simulation.answer(True)
    simulation.resume()
    simulation.answer(True)


@pytest.mark.parametrize("says_no", [True, False])
def test_a_no_and_silence_are_not_asked_again(says_no: bool) -> None:
    simulation = loop(ASKS.replace("ask 5.0 s", "ask 0.5 s, 3 times"))
    while not simulation.question:
        simulation.step(1)
    if says_no:
        simulation.answer(False)
    simulation.step(2 if says_no else 502)
    assert (simulation.phase, simulation.question) == ("back", "")


def test_silence_is_a_no() -> None:
    simulation = asking()
    simulation.step(round(4.99 / simulation.dt))
    assert simulation.phase == "up"
    simulation.step(10)
    assert simulation.phase == "back"


def test_a_paused_mission_stands_still_and_goes_on_to_the_same_end() -> None:
    whole, paused = loop(), loop()
    whole.step(9000)
    paused.step(250)
    paused.pause()
    assert paused.paused
    paused.step(round(6.0 / paused.dt))  # twice its time-out
    assert (paused.phase, paused.finished) == ("up", False)
    assert paused.log()["mission/waiting"][-1] == 1.0
    paused.resume()
    paused.step(9000)
    assert paused.success, paused.reason
    assert paused.time == pytest.approx(whole.time + 6.0, abs=0.01)
    np.testing.assert_allclose(paused.data.qpos, whole.data.qpos, atol=2e-3)
    told = [text for _, text in paused.events() if "in phase" in text]
    assert told == ["paused in phase up", "resumed in phase up"]


def test_who_took_over_hands_back_where_the_robot_is() -> None:
    simulation = loop()
    simulation.step(250)
    assert simulation.data.joint("j1").qpos[0] < -0.05
    simulation.pause()
    simulation.step(2000, {"posture": [0.2, 0.0]})  # against its way, beyond its time-out
    here = simulation.data.joint("j1").qpos[0]
    assert here > 0.4
    saved = simulation.state()
    simulation.resume()
    before = simulation.controller.q_des.copy()
    simulation.step(1)
    assert np.abs(simulation.controller.q_des - before).max() < 1e-3  # no jump
    simulation.step(9000)
    assert simulation.success, simulation.reason
    assert simulation.figures()["reached_rad"] == pytest.approx(-0.5, abs=0.02)
    end = simulation.data.qpos.copy()
    other = loop()
    other.restore(saved)
    assert other.paused
    other.resume()
    other.step(9001)
    assert other.data.qpos.tolist() == end.tolist()


def test_a_simulation_without_a_mission_has_nothing_to_pause() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model)
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    simulation = hurcules.Simulation(model=model, controller=controller)
    assert (simulation.paused, simulation.question) == (False, "")
    for act in (simulation.pause, simulation.resume):
        with pytest.raises(Error, match="without a mission"):
            act()
    with pytest.raises(Error, match="nothing is asked"):
        simulation.answer(True)
