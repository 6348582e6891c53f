"""On what a table says the robot stands: refused where that cannot be, told where it bears nothing.

Strategy: two boxes on the ground joined by a motor, with an arm on the first, moved joint by joint;
names of bodies that lie on the ground, and of others. The tables of the project all start
(test_mission_table.py, test_mission_disposal.py and others make them).
"""

from __future__ import annotations

import tomllib

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Error, Mission, disposal

BOXES = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.002" integrator="implicitfast"/>
  <default><joint axis="0 1 0" armature="0.05" damping="0.5" range="-2 2" limited="true"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 0.1" euler="0 {tilt} 0"/>
    <body name="back" pos="0 0 0.05" euler="0 {tilt} 0">
      <freejoint/>
      <geom type="box" size="0.2 0.2 0.05" pos="-0.2 0 0" mass="20"/>
      <body name="front">
        <joint name="middle"/>
        <geom type="box" size="0.2 0.2 0.05" pos="0.3 0 0" mass="10" contype="2"/>
      </body>
      <body name="arm" pos="-0.2 0 0.1">
        <joint name="shoulder"/>
        <geom type="capsule" size="0.03" fromto="0 0 0 0 0 0.4" mass="2"/>
      </body>
      <body name="flag" pos="-0.2 0 0"/>
    </body>
  </worldbody>
  <actuator>
    <motor joint="middle" forcerange="-300 300"/>
    <motor joint="shoulder" forcerange="-100 100"/>
  </actuator>
</mujoco>
"""
ROWS = """
[mission]
name = "boxes"
support = "back"

[[phase]]
name = "stand"
stack = "posture"
seconds = 0.1

[[phase]]
name = "raise the front"
stack = "joints"
posture = "joints"
seconds = 1.5
keys = [{ share = 1.0, middle = -1.0 }]

[[phase]]
name = "rest"
stack = "joints"
support = "back"
seconds = 1.5
"""


def loop(
    text: str = ROWS, tilt: float = 0.0, physics: bool = True, beside: str = ""
) -> hurcules.Simulation:
    boxes = BOXES.format(tilt=tilt).replace('<body name="back"', f'{beside}<body name="back"', 1)
    model = mujoco.MjModel.from_xml_string(boxes)
    robot = hurcules.Robot(model)
    robot.stand_on("back")
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot,
        None,
        {
            "posture": hurcules.Twist(posture, 2.0),
            "joints": hurcules.JointRates(["middle", "shoulder"], 1.0),
        },
        stacks={"posture": [posture]},
    )
    return hurcules.Simulation(
        Mission.read(tomllib.loads(text)), model=model, controller=controller, variation=0.0,
        physics=physics,
    )  # fmt: skip


def with_support(phase: str, body: str, rows: str = ROWS) -> str:
    """The table in which a phase stands on a body; "": the whole mission does."""
    if not phase:
        return rows.replace('support = "back"', f'support = "{body}"', 1)
    head, tail = rows.split(f'name = "{phase}"\n')
    tail = tail.replace('support = "back"\n', "", 1)
    return f'{head}name = "{phase}"\nsupport = "{body}"\n{tail}'


def unborne(simulation: hurcules.Simulation) -> list[tuple[float, str]]:
    return [event for event in simulation.events() if "bears nothing" in event[1]]


@pytest.mark.parametrize(
    "phase, body, wanted",
    [
        ("", "arm", r"\[mission\]: the robot cannot stand on 'arm' as it begins: 0\.12 m above"),
        ("", "arm", r"wanted at most 0\.05; on the ground are: back, front"),
        ("raise the front", "arm", r"phase 'raise the front': the robot cannot stand on 'arm'"),
        # its joint has been led up by then: 0.4 m at -1 rad, less what its edge comes down
        ("rest", "front", r"phase 'rest': .* 'front' as it begins: 0\.\d+ m above"),
        ("rest", "arm", r"on the ground are: back$"),
    ],
)
def test_a_support_that_does_not_lie_on_the_ground_is_refused(
    phase: str, body: str, wanted: str
) -> None:
    with pytest.raises(Error, match=wanted):
        loop(with_support(phase, body))


def test_walls_that_touch_are_no_ground() -> None:
    wall = '<geom type="box" size="0.1 1 1" pos="-0.499 0 1"/>'
    loop(
        with_support("raise the front", "front"), beside=wall
    )  # flat on the ground, as the back is


def test_what_an_earlier_key_names_is_followed() -> None:
    last = "keys = [{ share = 1.0, middle = -1.0 }]"
    both = "keys = [{ share = 0.5, middle = -1.0 }, { share = 1.0, shoulder = 0.1 }]"
    assert last in ROWS
    with pytest.raises(Error, match="phase 'rest': the robot cannot stand on 'front'"):
        loop(with_support("rest", "front", ROWS.replace(last, both)))


def test_a_table_of_the_project_stands_on_its_legs_not_on_its_trunk() -> None:
    mission = disposal.mission()
    rows = mission.rows
    phases = rows.phases
    (stand_up,) = (row for row in phases if row.name == "stand up")
    assert stand_up.support == "lower_leg_L"
    stand_up.support = "torso"
    rows.phases = phases
    model = disposal.model(disposal.Job())
    with pytest.raises(Error, match=r"'stand up': .* 'torso' .* 0\.39.*: L_upper_track"):
        hurcules.Simulation(
            Mission(mission.setup, rows), model=model, controller=disposal.controller(model)
        )


@pytest.mark.parametrize("tilt", [0.0, 0.5])
@pytest.mark.parametrize(
    "phase, body", [("", "front"), ("", "flag"), ("raise the front", "front"), ("rest", "back")]
)
def test_one_that_does_is_taken_on_a_slope_too(phase: str, body: str, tilt: float) -> None:
    assert loop(with_support(phase, body), tilt=tilt).phases[0] == "stand"


def test_where_the_posture_is_not_known_nothing_is_refused() -> None:
    led = ROWS.replace('stack = "joints"\nposture = "joints"', 'stack = "posture"')
    led = led.replace("keys = [{ share = 1.0, middle = -1.0 }]", "lead.posture = { by = [0, 0.2] }")
    assert loop(with_support("rest", "front", led)).phases[-1] == "rest"
    # behind the last phase: only reactions go there, from anywhere
    late = 'last = true\nwithin = 9.0\nlate = ["back to rest", "abort"]\nkeys'
    behind = ROWS.replace("keys", late)
    assert loop(with_support("rest", "arm", behind)).phases[-1] == "rest"


def test_a_support_that_bears_nothing_is_told_once_a_phase() -> None:
    assert not unborne(run_whole(loop()))
    simulation = loop(with_support("raise the front", "front"))
    simulation.step(round(0.8 / simulation.dt))
    saved = simulation.state()
    told = unborne(run_whole(simulation))
    names = ("raise the front", "rest")
    assert [text for _, text in told] == [f"the support bears nothing in phase {n}" for n in names]
    # a second after it has left the ground, or after the phase has begun
    assert 1.1 < told[0][0] < 1.6
    assert told[1][0] == pytest.approx(2.6, abs=0.02)
    simulation.restore(saved)
    assert unborne(run_whole(simulation)) == told
    assert not unborne(run_whole(loop(with_support("raise the front", "front"), physics=False)))


def run_whole(simulation: hurcules.Simulation) -> hurcules.Simulation:
    while not simulation.finished:
        simulation.step(100)
    assert simulation.success, simulation.reason
    assert not np.isnan(simulation.state()).any()
    return simulation
