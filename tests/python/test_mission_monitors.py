"""What the tables watch, made to happen: each threshold of the lift fires in a scene made for it.

Strategy: a person of two boxes with a head on two blades, and an arm of two joints; the conditions
are those of models/missions/lift.toml and casualty.toml, the quantities are compared with MuJoCo's
data. That none fires in a nominal run is test_mission_lift.py's and test_mission_casualty.py's
matter.
"""

from __future__ import annotations

import tomllib
from concurrent.futures import ThreadPoolExecutor

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Mission, lift
from test_mission_table import ARM, ROWS, loop

TABLES = [row for name in ("lift", "casualty") for row in lift.mission(name).rows.phases]
PERSON = """
<mujoco>
  <option timestep="0.002" integrator="implicitfast"/>
  <worldbody>
    <geom name="floor" type="plane" size="5 5 0.1"/>
    <body name="base" pos="0 0 {height}">
      <joint name="up" type="slide" axis="0 0 1" range="-0.3 0.5" limited="true"/>
      <body name="L_larm" pos="0 0.3 0">
        <geom type="box" size="0.4 0.12 0.02" mass="5" friction="0.3"/>
        <site name="L_tcp" pos="0.4 0 0"/>
      </body>
      <body name="R_larm" pos="0 -0.3 0">
        <geom type="box" size="0.4 0.12 0.02" mass="5" friction="0.3"/>
        <site name="R_tcp" pos="0.4 0 0"/>
      </body>
    </body>
    <body name="casualty_pelvis" pos="0.1 0 {lies}">
      <freejoint/>
      <geom type="box" size="0.15 0.5 0.1" mass="60" friction="0.3"/>
      <body name="casualty_thorax" pos="0 0.3 0">
        <site name="chest"/>
        <geom type="sphere" size="0.02" mass="1" contype="0" conaffinity="0"/>
        <body name="casualty_head" pos="0 0.3 0">
          <joint name="neck" axis="1 0 0" stiffness="30" damping="3"/>
          <geom type="sphere" size="0.1" pos="0 0.15 0" mass="5" contype="0" conaffinity="0"/>
          <site name="head" pos="0 0.15 0"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="up" ctrlrange="-3000 3000"/></actuator>
  <sensor>
    <jointpos name="casualty_neck_flexion" joint="neck"/>
    <accelerometer name="casualty_head_acceleration" site="head"/>
    <touch name="casualty_force_pelvis" site="chest"/>
  </sensor>
</mujoco>
"""
WATCHED = """
[mission]
name = "watched"
casualty = "casualty_"

[[phase]]
name = "hold"
stack = "up"
seconds = 3.0
trouble = [{{ when = "{when}", do = ["back to safe", "abort"] }}]

[[phase]]
name = "safe"
stack = "up"
"""


def held(when: str, lies: float = 0.62, height: float = 0.5) -> hurcules.Simulation:
    """The person, his centre at a height [m], on blades at another one; watched for one thing."""
    model = mujoco.MjModel.from_xml_string(PERSON.format(lies=lies, height=height))
    robot = hurcules.Robot(model, joints=["up"])
    up = hurcules.PostureTask("up", robot)
    controller = hurcules.WholeBodyController(
        robot, None, {"up": hurcules.Twist(up, 0.3)}, stacks={"up": [up]}
    )
    mission = Mission.read(tomllib.loads(WATCHED.format(when=when)))
    return hurcules.Simulation(mission, model=model, controller=controller, variation=0.0)


def thresholds(quantity: str, phase: str = "") -> list[str]:
    """The conditions of the tables on a quantity, as text."""
    found = {
        f"{when.quantity} {'>=' if when.above else '<='} {when.value} for {when.seconds} s"
        for row in TABLES
        if phase in ("", row.name)
        for when in (trouble.when for trouble in row.troubles)
        if when.quantity == quantity
    }
    assert found, quantity
    return sorted(found)


def until_safe(simulation: hurcules.Simulation, seconds: float = 1.5) -> bool:
    """Whether its trouble fires in this time."""
    simulation.step(round(seconds / simulation.dt))
    return simulation.phase == "safe" or simulation.finished


SHOVES = {  # what is done to whom, in W: force [N], torque [N m]
    "casualty/shift_m": ("casualty_pelvis", (350.0, 0.0, 0.0), (0.0, 0.0, 0.0)),
    "casualty/support_n": ("casualty_pelvis", (0.0, 0.0, -1200.0), (0.0, 0.0, 0.0)),
    "casualty/neck_flexion_rad": ("casualty_head", (0.0, 0.0, 0.0), (-60.0, 0.0, 0.0)),
    "casualty/head_mps2": ("casualty_head", (0.0, 0.0, 900.0), (0.0, 0.0, 0.0)),
}


@pytest.mark.parametrize("quantity", SHOVES)
def test_what_is_watched_of_the_person_fires_when_it_happens(quantity: str) -> None:
    body, force, torque = SHOVES[quantity]
    for when in thresholds(quantity):
        simulation = held(when)
        assert not until_safe(simulation, 0.5), when  # he rests on the blades
        simulation.data.body(body).xfrc_applied[:] = (*force, *torque)
        assert until_safe(simulation), (when, simulation.log()[quantity][-1])
        assert simulation.events()[-1][1] == "phase safe"


def test_blades_that_press_who_lies_fire() -> None:
    (when,) = thresholds("casualty/contact_share")
    simulation = held(when, lies=0.1, height=0.225)  # 5 mm above him
    assert not until_safe(simulation, 0.5)
    simulation.step(400, {"up": [-0.2]})
    assert simulation.phase == "safe"
    log = simulation.log()
    force = log["casualty/force/pelvis"]
    np.testing.assert_allclose(log["casualty/contact_share"], force / 180.0)  # its limit [N]
    assert log["casualty/on_ground"][1:].min() > 0.15


def test_the_shift_on_the_arms_counts_from_when_they_have_all_of_him() -> None:
    simulation = held("casualty/shift_m >= 9.0")
    log = simulation.log
    simulation.step(200)
    pelvis = simulation.data.body("casualty_pelvis")
    began = pelvis.xpos[:2].copy()
    rested = log()["casualty/shift_m"][-1]
    assert rested < 0.002
    simulation.data.body("casualty_pelvis").xfrc_applied[:2] = (300.0, 0.0)
    simulation.step(150)
    moved = np.linalg.norm(pelvis.xpos[:2] - began)
    assert moved > 0.02
    assert log()["casualty/shift_m"][-1] == pytest.approx(moved, abs=0.005)
    saved = simulation.state()
    simulation.step(20)
    here = log()["casualty/shift_m"][-1]
    simulation.restore(saved)
    simulation.step(20)
    assert log()["casualty/shift_m"][-1] == here  # from where he was taken is part of the state
    lies = held("casualty/shift_m >= 9.0", lies=0.1, height=0.6)  # the blades above him
    lies.data.body("casualty_pelvis").xfrc_applied[0] = 900.0
    lies.step(500)
    assert lies.log()["casualty/moved_m"][-1] > 0.05
    assert lies.log()["casualty/shift_m"].max() == 0.0


def watching(when: str, **options: object) -> hurcules.Simulation:
    """The waving arm, which goes back when this is true."""
    return loop(ROWS.replace("q/j2 >= 2.0", when).replace("ask 5.0 s", "back to back"), **options)


def test_the_tracking_error_is_the_largest_of_the_joints_and_fires_when_the_arm_is_struck() -> None:
    (when,) = thresholds("tracking_error")
    simulation = watching(when)
    simulation.step(300)
    simulation.data.body("lower").xfrc_applied[2] = 600.0
    while simulation.phase == "up":
        assert simulation.step(1) == 1
    assert simulation.time < 300 * simulation.dt + 0.2
    log = simulation.log()
    joints = np.abs([log["joint_error/j1"], log["joint_error/j2"]]).max(axis=0)
    np.testing.assert_array_equal(log["tracking_error"], joints)
    assert log["tracking_error"][:300].max() < 0.5 * hurcules.Condition.read(when).value


def test_a_solver_that_does_not_end_fires_and_is_forgotten_where_no_stack_rules() -> None:
    (when,) = thresholds("status")
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model)
    limits = hurcules.JointLimits("limits", robot)
    limits.set_max_velocities(0.2)  # both joints are held: more than one change
    hand = hurcules.PositionTask("hand", robot, "hand")
    posture = hurcules.PostureTask("posture", robot)
    velocity = hurcules.VelocityControllerOptions(
        solver=hurcules.rhqp.SolverOptions(max_changes=1, method="rhqp_thesis")
    )
    controller = hurcules.WholeBodyController(
        robot,
        None,
        {"posture": hurcules.Twist(posture, 2.0), "joints": hurcules.JointRates(["j1", "j2"], 1.0)},
        stacks={"posture": [limits, hand, posture]},
        velocity=velocity,
    )
    rows = ROWS.replace("q/j2 >= 2.0", when).replace("ask 5.0 s", "back to back")
    for old, new in (
        ('name = "back"\nstack = "posture"', 'name = "back"\nstack = "joints"'),
        ("lead.posture", "lead.joints"),
    ):
        rows = rows.replace(old, new)
    mission = Mission.read(tomllib.loads(rows))
    simulation = hurcules.Simulation(mission, model=model, controller=controller, variation=0.0)
    hand.set_target([3.0, 0.0, 3.0])
    simulation.step(1000)
    assert (simulation.log()["status"] >= 2.0).any()
    assert simulation.phase == "back"
    simulation.step(2)
    assert simulation.log()["status"][-1] == 0.0


def test_a_heartbeat_of_another_thread_waits_for_its_turn() -> None:
    simulation, beats = watching("link_age >= 100.0"), 0
    with ThreadPoolExecutor(1) as pool:
        for _ in range(20):  # on a busy machine the steps may be done before this thread goes on
            steps = pool.submit(simulation.step, 2000)
            while not steps.done():
                simulation.heartbeat()
                beats += 1
    assert beats > 1


def test_a_lost_link_fires_and_who_never_had_one_loses_none() -> None:
    (when,) = thresholds("link_age", "approach")
    limit = hurcules.Condition.read(when).value
    simulation = watching(f"link_age >= {limit}")
    alone = simulation.state()
    simulation.step(100)
    assert not simulation.log()["link_age"].any()
    simulation.heartbeat()
    simulation.step(10)
    assert simulation.log()["link_age"][-1] == pytest.approx(9 * simulation.dt)
    saved = simulation.state()
    assert not np.isnan(saved).any()
    simulation.restore(alone)
    simulation.step(1)
    assert simulation.log()["link_age"][-1] == 0.0  # the heartbeat is part of the state
    simulation.restore(saved)
    simulation.pause()
    simulation.step(round(limit / simulation.dt) + 1)
    simulation.resume()
    simulation.step(2)
    assert simulation.phase == "back"
    simulation.reset(0)
    simulation.step(1)
    assert simulation.log()["link_age"][-1] == 0.0
