"""A rate that holds a quantity and rests behind the brake of its joint, in a mission.

Strategy: a jaw that presses a spring of 1 kN/m: the quantity is how far the spring gives way, so
that its numbers come from where the jaw is.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules

PRESS = """<mujoco><option timestep="0.002" gravity="0 0 0"/>
  <default><joint type="slide" axis="1 0 0" armature="1" damping="10"/>
    <geom size="0.02" mass="0.1" contype="0" conaffinity="0"/></default>
  <worldbody>
    <body><joint name="arm" range="-1 1"/><geom/><site name="hand"/>
      <body><joint name="jaw" range="0 0.1" stiffness="1000" frictionloss="1"
        solreffriction="0.004 1" solimpfriction="0.9999 0.9999 0.001"/><geom/></body></body>
  </worldbody>
  <actuator><motor joint="arm" forcerange="-100 100"/><motor joint="jaw" forcerange="-100 100"/>
  </actuator></mujoco>"""
HOLD = {"rate": [0.02], "hold": "joint/jaw", "at": 0.02, "span": 0.005, "brake": True}
WAIT = {"seconds": 1.0, "done": ["joint/jaw >= 0.0199 for 0.2 s"], "within": 5.0, "late": ["abort"]}


def press(*phases: dict[str, Any]) -> hurcules.Simulation:
    model = mujoco.MjModel.from_xml_string(PRESS)
    robot = hurcules.Robot(model, joints=["arm"])
    hand = hurcules.PositionTask("hand", robot, "hand", axes=[[1, 0, 0]])
    channels = {"hand": hurcules.Twist(hand, 0.2), "jaw": hurcules.JointRate("jaw", 0.1)}
    controller = hurcules.WholeBodyController(robot, [hand], channels)
    rows = [{"name": f"p{i}", "stack": "stack", **one} for i, one in enumerate(phases)]
    mission = hurcules.Mission.read({"mission": {"name": "press"}, "phase": rows})
    return hurcules.Simulation(mission, model=model, controller=controller, variation=0.0)


def effort(simulation: hurcules.Simulation) -> float:
    return float(np.abs(simulation.data.actuator_force[1]))


def test_the_motor_rests_once_it_is_there_and_in_the_next_phase_too() -> None:
    made = press({"lead": {"jaw": HOLD}, **WAIT}, {"lead": {"jaw": HOLD}, "seconds": 1.0})
    efforts = []
    while not made.finished:
        made.step(1)
        efforts.append((made.phase, effort(made)))
    assert made.success, made.reason
    assert max(one for phase, one in efforts if phase == "p0") > 18.0  # 1 kN/m by 0.02 m
    assert max(one for phase, one in efforts if phase == "p1") == 0.0
    assert made.data.joint("jaw").qpos[0] == pytest.approx(0.02, abs=1e-3)
    log = made.log()
    assert np.abs(log["command/jaw"][log["phase"] == 1]).max() == 0.0


def test_a_firmer_hold_after_a_light_one_presses_anew() -> None:
    firm = {**HOLD, "at": 0.04, "span": 0.03}
    done = {"seconds": 1.0, "done": ["joint/jaw >= 0.0399"], "within": 5.0, "late": ["abort"]}
    made = press({"lead": {"jaw": HOLD}, **WAIT}, {"lead": {"jaw": firm}, **done})
    made.step(10_000)
    assert made.success, made.reason


def test_what_is_no_number_leads_nothing() -> None:
    nothing = {**HOLD, "hold": "monitor/static_margin_m"}  # of a robot that is bolted down
    made = press({"lead": {"jaw": nothing}, "seconds": 1.0})
    made.step(10_000)
    assert made.finished
    assert np.abs(made.log()["command/jaw"]).max() == 0.0


def test_brakes_bear_what_is_held_while_the_mission_holds_or_is_paused() -> None:
    lead = {"jaw": {**HOLD, "at": 0.05}}
    trouble = [{"when": "joint/jaw >= 0.03", "do": ["hold 2 s", "abort"]}]
    made = press({"lead": lead, **WAIT, "done": ["joint/jaw >= 0.05"], "trouble": trouble})
    while made.data.joint("jaw").qpos[0] < 0.03:
        made.step(1)
    made.step(100)
    assert effort(made) == 0.0


@pytest.mark.parametrize("place", [0.010, 0.017])
def test_after_a_pause_the_fingers_press_on(place: float) -> None:
    """At 0.017 less than `span` lacks: the brakes stayed shut, and the phase was late."""
    made = press({"lead": {"jaw": HOLD}, **WAIT})
    while made.data.joint("jaw").qpos[0] < place:
        made.step(1)
    assert effort(made) > 5.0
    made.pause()
    made.step(100)
    assert effort(made) == 0.0
    made.step(20, {"jaw": [0.02]})
    assert effort(made) > 5.0
    made.pause()
    made.step(100)
    assert effort(made) == 0.0
    made.resume()
    made.step(5000)
    assert made.success, made.reason


def test_an_operator_opens_what_is_borne() -> None:
    made = press({"lead": {"jaw": HOLD}, "seconds": 5.0, **{k: WAIT[k] for k in ("done",)}})
    made.step(1500)
    assert effort(made) == 0.0
    made.pause()
    made.step(300, {"jaw": [-0.02]})
    assert made.data.joint("jaw").qpos[0] == pytest.approx(0.008, abs=2e-3)
