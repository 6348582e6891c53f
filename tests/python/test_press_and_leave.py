"""What docs say of pressing: a contact found again, one that is left, how stiff a hand is.

Strategy: a tool on three slides; forces are those of the physics, stiffnesses those of a formula.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import ContactState
from test_force_sensors import on_the_table

WANTED, MASS = 20.0, 2.0  # [N], [kg]
MODEL = f"""
<mujoco>
  <option timestep="0.001"/>
  <worldbody>
    <geom name="table" type="box" size="1 1 0.1" pos="0 0 -0.1"/>
    <body pos="0 0 0.3">
      <joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>
      <joint name="z" type="slide" axis="0 0 1"/><geom size="0.02" mass="{MASS - 0.001}"/>
      <body name="tool">
        <site name="tip"/><geom size="0.03" mass="0.001"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="x"/><motor joint="y"/><motor joint="z"/></actuator>
  <sensor><force name="cell" site="tip"/></sensor>
</mujoco>
"""
CONTROLS = ("velocity", "acceleration", "torque")


def pressing(control: str) -> tuple[hurcules.Simulation, hurcules.ForceTask]:
    """A tool that presses on the table."""
    model = mujoco.MjModel.from_xml_string(MODEL)
    robot = hurcules.Robot(model)
    press = hurcules.ForceTask("press", robot, "tip", force_des=-WANTED, max_rate=20.0)
    place = hurcules.PositionTask("place", robot, "tip", axes=np.eye(3)[:2])
    channels = {"press": hurcules.Twist(press, 0.3)}
    controller = hurcules.WholeBodyController(robot, [press, place], channels, control=control)
    controller.sense(press, "cell")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(12000, {"press": [-0.03]})
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.3)
    return simulation, press


@pytest.mark.parametrize("control", CONTROLS)
def test_in_contact_a_twist_moves_nothing(control: str) -> None:
    simulation, press = pressing(control)
    simulation.step(1000, {"press": [0.1]})
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.3)
    assert press.contact == ContactState.Contact


@pytest.mark.parametrize("control", CONTROLS)
def test_a_contact_that_is_lost_is_found_by_who_still_commands_it(control: str) -> None:
    for command, found in (([-0.03], WANTED), ([0.0], 0.0)):
        simulation, _ = pressing(control)
        simulation.model.geom("table").pos[2] -= 0.06  # the table goes away
        simulation.step(6000, {"press": command})
        assert on_the_table(simulation) == pytest.approx(found, abs=0.3)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_contact_is_left_by_motion_alone(control: str) -> None:
    simulation, press = pressing(control)
    height = float(simulation.data.body("tool").xpos[2])
    press.enable(False)
    simulation.step(1000, {"press": [0.1]})
    simulation.step(500)
    assert simulation.data.body("tool").xpos[2] - height == pytest.approx(0.1, abs=0.003)
    assert press.contact == ContactState.Free


def hanging(control: str, gain: float) -> hurcules.Simulation:
    """The tool, held in the air."""
    model = mujoco.MjModel.from_xml_string(MODEL)
    robot = hurcules.Robot(model)
    place = hurcules.PositionTask("place", robot, "tip")
    place.set_gain(gain)
    controller = hurcules.WholeBodyController(robot, [place], control=control)
    return hurcules.Simulation(model=model, controller=controller, record=False)


@pytest.mark.parametrize("gain", [5.0, 20.0])
@pytest.mark.parametrize("control", CONTROLS)
def test_a_hand_is_stiff_by_servos_and_a_spring_by_torques(control: str, gain: float) -> None:
    simulation = hanging(control, gain)
    damping = hurcules.AccelerationControllerOptions().damping
    start = simulation.data.body("tool").xpos.copy()
    push = 0.1  # [N] small: far from its target a level is regularised, 2 % softer at 5 N
    simulation.data.xfrc_applied[simulation.model.body("tool").id, 0] = push
    simulation.step(4000)
    way = float((simulation.data.body("tool").xpos - start)[0])
    spring = push / (MASS * damping * gain) if control == "torque" else 0.0
    assert way == pytest.approx(spring, rel=0.01, abs=1e-6)


@pytest.mark.parametrize("control", CONTROLS)
def test_a_load_that_the_model_is_told_of_is_carried(control: str) -> None:
    simulation = hanging(control, 5.0)
    simulation.step(500)
    start = float(simulation.data.body("tool").xpos[2])
    simulation.model.body("tool").mass[0] += 1.0
    simulation.step(3000)
    assert simulation.data.body("tool").xpos[2] == pytest.approx(start, abs=1e-4)
