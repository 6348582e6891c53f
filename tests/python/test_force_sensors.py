"""Force sensors of the model: turned sites, tools behind them, impacts.

Strategy: a tool on three slides and a table; what is read and kept is compared with the contact
force of the physics.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Error

DT = 1e-3  # [s]
WANTED = 20.0  # [N]
MODEL = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001"/>
  <worldbody>
    <geom name="table" type="box" size="1 1 0.1" pos="0 0 -0.1" euler="0 {slope} 0" friction="0.3"/>
    <body pos="0 0 0.3">
      <joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>
      <joint name="z" type="slide" axis="0 0 1"/><geom size="0.02" mass="2" pos="0 0 0.1"/>
      <body>
        <site name="cell" euler="0.3 0.5 0.7"/>
        <geom name="tool" size="0.03" pos="0 0 -0.05" mass="{tool}" friction="0.3"/>
        <site name="tip" pos="0 0 -0.08"/>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="x"/><motor joint="y"/><motor joint="z"/></actuator>
  <sensor><force name="cell" site="cell"/></sensor>
</mujoco>
"""


def pressing(
    control: str, *, slope: float = 0.0, tool: float = 0.001, **sense: Any
) -> tuple[hurcules.Simulation, hurcules.ForceTask]:
    """Down on a table, along its normal."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(slope=slope, tool=tool))
    robot = hurcules.Robot(model)
    normal = np.array([np.sin(slope), 0.0, np.cos(slope)])
    gains = hurcules.ForceGains(compliance=1e-3, dt=DT)
    press = hurcules.ForceTask("press", robot, "tip", axis=normal, force_des=-WANTED, gains=gains)
    across = np.array([[np.cos(slope), 0.0, -np.sin(slope)], [0.0, 1.0, 0.0]])
    place = hurcules.PositionTask("place", robot, "tip", axes=across)
    controller = hurcules.WholeBodyController(
        robot, [press, place], {"press": hurcules.Twist(press, 0.3)}, control=control
    )
    controller.sense(press, "cell", **sense)
    return hurcules.Simulation(model=model, controller=controller, record=False), press


def on_the_table(simulation: hurcules.Simulation) -> float:
    """[N] along the normal of its contact."""
    force = np.zeros(6)
    for i in range(simulation.data.ncon):
        mujoco.mj_contactForce(simulation.model, simulation.data, i, force)
        return float(force[0])
    return 0.0


def land(simulation: hurcules.Simulation, press: hurcules.ForceTask, speed: float) -> float:
    """Comes down at a speed and presses for 6 s; the largest force."""
    most = 0.0
    for _ in range(12000):
        if press.contact != hurcules.ContactState.Free:
            break
        simulation.step(1, {"press": [-speed]})
        most = max(most, on_the_table(simulation))
    for _ in range(6000):
        simulation.step(1)
        most = max(most, on_the_table(simulation))
    return most


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
@pytest.mark.parametrize("slope", [0.0, 0.5])
def test_a_force_is_read_along_the_axis_however_the_cell_is_turned(
    control: str, slope: float
) -> None:
    simulation, press = pressing(control, slope=slope)
    land(simulation, press, 0.02)
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.4)
    assert press.force == pytest.approx(-WANTED, abs=0.4)


def test_the_weight_of_a_tool_is_tared() -> None:
    simulation, press = pressing("velocity", tool=0.3)
    simulation.step(200)
    assert press.contact == hurcules.ContactState.Contact  # by 2.9 N that are none
    press.tare()
    simulation.step(1)
    assert press.contact == hurcules.ContactState.Free and press.force == pytest.approx(0, abs=0.1)
    saved = simulation.state()
    land(simulation, press, 0.02)
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.4)
    simulation.restore(saved)
    assert land(simulation, press, 0.02) > 0.9 * WANTED  # the tare is part of the state
    simulation.reset()
    simulation.step(200)
    assert press.contact == hurcules.ContactState.Contact


def test_an_impact_is_not_pushed_on() -> None:
    simulation, press = pressing("torque")
    assert land(simulation, press, 0.1) < 40.0
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.4)


def test_a_sensor_that_cannot_be_read_is_refused() -> None:
    simulation, press = pressing("velocity")
    controller = simulation.controller
    with pytest.raises(Error, match="sign of a sensor wants a finite number other than 0, 0 came"):
        controller.sense(press, "cell", sign=0.0)
    other = hurcules.ForceTask("other", controller.plan, "tip")
    with pytest.raises(Error, match="'other' is in no stack of the controller"):
        controller.sense(other, "cell")
    with pytest.raises(Error, match="filter of force task 'press' wants a time of 0 or more"):
        press.set_filter(-1.0)
