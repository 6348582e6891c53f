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
from taring import rest_and_tare

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
    control: str,
    *,
    slope: float = 0.0,
    tool: float = 0.001,
    contact: hurcules.ContactOptions | None = None,
    **sense: Any,
) -> tuple[hurcules.Simulation, hurcules.ForceTask]:
    """Down on a table, along its normal."""
    model = mujoco.MjModel.from_xml_string(MODEL.format(slope=slope, tool=tool))
    robot = hurcules.Robot(model)
    normal = np.array([np.sin(slope), 0.0, np.cos(slope)])
    gains = hurcules.ForceGains(compliance=1e-3, dt=DT)
    press = hurcules.ForceTask(
        "press",
        robot,
        "tip",
        axis=normal,
        force_des=-WANTED,
        gains=gains,
        contact=contact or hurcules.ContactOptions(),
    )
    across = np.array([[np.cos(slope), 0.0, -np.sin(slope)], [0.0, 1.0, 0.0]])
    place = hurcules.PositionTask("place", robot, "tip", axes=across)
    controller = hurcules.WholeBodyController(
        robot, [press, place], {"press": hurcules.Twist(press, 0.3)}, control=control
    )
    controller.sense(press, "cell", **sense)
    return hurcules.Simulation(model=model, controller=controller), press


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
    log = simulation.log()
    assert log["force/press"][-1] == press.force
    assert log["contact/press"][-1] == int(hurcules.ContactState.Contact)


def test_the_weight_of_a_tool_is_tared() -> None:
    simulation, press = pressing("velocity", tool=0.3)
    simulation.step(200)
    assert press.contact == hurcules.ContactState.Contact  # by 2.9 N that are none
    press.tare()
    simulation.step(102)
    assert press.contact == hurcules.ContactState.Free and press.force == pytest.approx(0, abs=0.1)
    press.reset(simulation.controller.plan)  # out of a stop, say
    simulation.step(1)
    assert press.contact == hurcules.ContactState.Free  # it forgot
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


@pytest.mark.parametrize("control", ["velocity", "acceleration", "torque"])
def test_above_f_max_it_presses_no_more(control: str) -> None:
    # a servo raised the force by 80 N/s, up to 600 N; the reading stayed that of the hit
    most = hurcules.ContactOptions(f_max=30.0)
    simulation, press = pressing(control, contact=most)
    press.set_force(-25.0)
    for _ in range(2000):
        simulation.step(1, {"press": [-0.3]})
    assert press.contact == hurcules.ContactState.Stopped
    simulation.step(1500)
    forces = []
    for _ in range(3000):
        simulation.step(1)
        forces.append(on_the_table(simulation))
    assert max(forces) < 15.0 and abs(press.force) < 15.0
    said = [str(fall) for level in simulation.controller.diagnostics() for fall in level.shortfalls]
    assert any("its stop above f_max" in text for text in said), said
    height = simulation.data.site("tip").xpos[2]
    simulation.step(1000, {"press": [0.05]})
    assert simulation.data.site("tip").xpos[2] - height == pytest.approx(0.05, abs=5e-3)


def test_a_contact_that_is_lost_by_torques_is_not_borne() -> None:
    # thrown at 0.6 m/s by the force that torques bore into nothing; met again with 360 N
    simulation, press = pressing("torque", tool=0.5)
    simulation.step(300)
    press.tare()
    simulation.step(102)
    land(simulation, press, 0.02)
    simulation.model.geom("table").pos[2] -= 0.03
    fastest, most = 0.0, 0.0
    for _ in range(4000):
        simulation.step(1, {"press": [-0.02]})
        fastest = max(fastest, abs(float(simulation.data.qvel[2])))
        most = max(most, on_the_table(simulation))
    assert fastest < 1.5 * 1e-3 * WANTED * 2.0 and most < 1.5 * WANTED
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.5)


ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="0.001" cone="elliptic" impratio="10"/>
  <default><geom contype="0" conaffinity="0" friction="{friction}"/></default>
  <worldbody>
    <geom name="table" {table} contype="1" conaffinity="1"/>
    <body pos="0 0 0.5"><joint name="a" axis="0 1 0" armature="0.1"/>
      <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="4"/>
      <body pos="0.4 0 0"><joint name="b" axis="0 1 0" armature="0.1"/>
        <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="3"/>
        <body pos="0.4 0 0"><joint name="c" axis="0 1 0" armature="0.05"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0.1 0 0" mass="1"/>
          <body pos="0.1 0 0"><site name="cell"/>
            <geom name="tool" size="0.02" pos="0.03 0 0" mass="0.1" contype="1" conaffinity="1"/>
            <site name="tip" pos="0.05 0 0"/></body></body></body></body>
  </worldbody>
  <actuator><motor joint="a"/><motor joint="b"/><motor joint="c"/></actuator>
  <sensor><force name="cell" site="cell"/></sensor>
</mujoco>
"""
START = [-0.5, 1.3, 0.7707963]  # the tool looks down
TABLE = 'type="box" size="1 1 0.05" pos="0.6 0 {height}"'
DRUM = 'type="cylinder" size="0.3" fromto="{x} -1 {z} {x} 1 {z}"'


def above(text: str, **friction: float) -> tuple[mujoco.MjModel, hurcules.Robot]:
    """The arm, its tool 10 mm above what `text` says."""
    bare = mujoco.MjModel.from_xml_string(ARM.format(table='size="0.01"', **friction))
    robot = hurcules.Robot(bare)
    robot.set_configuration(START)
    x, _, z = robot.position("tip")
    table = text.format(height=z - 0.06, x=x, z=z - 0.31)
    model = mujoco.MjModel.from_xml_string(ARM.format(table=table, **friction))
    robot = hurcules.Robot(model)
    robot.set_configuration(START)
    return model, robot


def test_friction_beside_the_axis_is_no_error_of_the_force_by_torques() -> None:
    model, robot = above(TABLE, friction=1.0)
    press = hurcules.ForceTask("press", robot, "tip", force_des=-WANTED)
    along = hurcules.PositionTask("along", robot, "tip", axes=[[1, 0, 0]])
    turn = hurcules.PostureTask("turn", robot)
    channels = {"press": hurcules.Twist(press, 0.3), "along": hurcules.Twist(along, 0.1)}
    controller = hurcules.WholeBodyController(
        robot, [press, along, turn], channels, control="torque"
    )
    controller.sense(press, "cell")
    simulation = hurcules.Simulation(model=model, controller=controller)
    rest_and_tare(simulation, press)
    simulation.step(2000, {"press": [-0.02]})
    forces = []
    for _ in range(2000):  # the tool sticks, and is drawn aside ever more
        simulation.step(1, {"along": [0.005]})
        forces.append(on_the_table(simulation))
    assert np.mean(forces[-500:]) == pytest.approx(WANTED, abs=1.0)


def wiped(control: str, own: bool) -> tuple[hurcules.Simulation, float]:
    """Over a drum, 0.4 rad, along the tool's axis or the one that it had at first; mean [N]."""
    model, robot = above(DRUM, friction=0.1)
    axis = {"reference": "tip", "axis": [1, 0, 0]} if own else {"axis": [0, 0, -1]}
    press = hurcules.ForceTask("press", robot, "tip", force_des=WANTED, max_rate=20.0, **axis)
    along = hurcules.PositionTask("along", robot, "tip", axes=[[1, 0, 0]])
    turn = hurcules.OrientationTask("turn", robot, "tip")
    channels = {
        "press": hurcules.Twist(press, 0.3),
        "along": hurcules.Twist(along, 0.3),
        "turn": hurcules.Twist(turn, 1.0),
    }
    controller = hurcules.WholeBodyController(
        robot, [[press, along, turn]], channels, control=control
    )
    controller.sense(press, "cell")
    simulation = hurcules.Simulation(model=model, controller=controller)
    rest_and_tare(simulation, press)
    simulation.step(2000, {"press": [0.02]})
    forces, turned = [], 0.0
    for _ in range(2000):
        turned += 0.2 * DT
        along_x = 0.3 * 0.2 * np.cos(turned)
        simulation.step(1, {"press": [0.02], "along": [along_x], "turn": [0, 0.2, 0]})
        forces.append(on_the_table(simulation))
    return simulation, float(np.mean(forces[500:]))


@pytest.mark.parametrize("control", ["velocity", "acceleration"])
def test_a_tool_presses_along_its_own_axis_over_a_curve(control: str) -> None:
    simulation, force = wiped(control, own=True)
    _, beside = wiped(control, own=False)
    x, _, z = simulation.data.site("tip").xpos - simulation.model.geom("table").pos
    assert np.arctan2(x, z) > 0.3
    # the surface comes at up to 23 mm/s along an axis that stays, C (f_d - f) must make that
    assert abs(force - WANTED) < 0.5 * abs(beside - WANTED)
    saved = simulation.state()
    simulation.step(100, {"along": [0.01]})
    again = simulation.state()
    simulation.restore(saved)
    simulation.step(100, {"along": [0.01]})
    assert np.array_equal(simulation.state(), again, equal_nan=True)


def test_a_tare_is_the_mean_of_what_is_read() -> None:
    _, robot = above(TABLE, friction=1.0)
    press = hurcules.ForceTask("press", robot, "tip")
    noise = np.random.default_rng(0).normal(5.0, 1.0, 100)
    press.tare(0.1)
    press.sense(robot, 99.0)  # of before: a simulation that starts has none
    for reading in noise:
        press.sense(robot, float(reading))
        assert press.force == 0.0 and press.contact == hurcules.ContactState.Free
    press.sense(robot, 6.0)
    assert press.force == pytest.approx(6.0 - noise.mean(), abs=1e-12)
    with pytest.raises(Error, match="tare of force task 'press' wants a time of 0 or more"):
        press.tare(-1.0)


def test_what_reads_no_force_is_refused_and_a_touch_has_its_sign() -> None:
    text = MODEL.format(slope=0.0, tool=0.001).replace(
        '<force name="cell" site="cell"/>',
        '<framepos name="place" objtype="site" objname="cell"/><touch name="touch" site="pad"/>',
    )
    pad = '<site name="pad" pos="0 0 -0.05" size="0.04"/>'
    text = text.replace('<site name="tip"', pad + '<site name="tip"')
    model = mujoco.MjModel.from_xml_string(text)
    robot = hurcules.Robot(model)
    press = hurcules.ForceTask("press", robot, "tip", force_des=-WANTED)
    place = hurcules.PositionTask("place", robot, "tip", axes=np.eye(3)[:2])
    controller = hurcules.WholeBodyController(
        robot, [press, place], {"press": hurcules.Twist(press, 0.3)}
    )
    with pytest.raises(Error, match="sensor 'place' reads no force"):
        controller.sense(press, "place")
    simulation = hurcules.Simulation(model=model, controller=controller)
    with pytest.warns(UserWarning, match="force task press: nothing tells it a force"):
        simulation.step(1)
    controller.sense(press, "touch")  # pressed with f_max by a sign of +1
    simulation.reset()
    land(simulation, press, 0.02)
    assert on_the_table(simulation) == pytest.approx(WANTED, abs=0.4)


def test_a_robot_on_feet_presses_and_its_feet_push_back() -> None:
    # 20 N wanted, 2 N for good: the root bore nothing of them
    spec = mujoco.MjSpec.from_file(str(hurcules.models.folder() / "examples" / "quadruped.xml"))
    start = hurcules.Robot(spec.compile(), floating=True)
    start.set_keyframe("stand")
    x, _, z = start.position("hand")
    (site,) = [site for site in spec.sites if site.name == "hand"]
    tool = site.parent.add_body(name="tool", pos=site.pos)
    tool.add_geom(name="tool", size=[0.03, 0, 0], mass=0.1)
    tool.add_site(name="cell")
    kind, of = mujoco.mjtSensor.mjSENS_FORCE, mujoco.mjtObj.mjOBJ_SITE
    spec.add_sensor(name="cell", type=kind, objtype=of, objname="cell")
    box = mujoco.mjtGeom.mjGEOM_BOX
    spec.worldbody.add_geom(name="wall", type=box, size=[0.05, 1, 1], pos=[x + 0.1, 0, z])
    model = spec.compile()
    robot = hurcules.Robot(model, floating=True)
    robot.set_keyframe("stand")
    legs = ("FL", "FR", "HL", "HR")
    feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank", friction=0.6) for leg in legs]
    com = hurcules.CenterOfMassTask("com", robot)
    trunk = hurcules.OrientationTask("trunk", robot, "trunk")
    soft = hurcules.ContactOptions(f_min=1.0)
    press = hurcules.ForceTask(
        "press",
        robot,
        "hand",
        axis=[1, 0, 0],
        force_des=WANTED,
        contact=soft,
        gains=hurcules.ForceGains(dt=model.opt.timestep),
    )
    across = hurcules.PositionTask("across", robot, "hand", axes=np.eye(3)[1:])
    levels = [feet, [com, trunk], press, across, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(
        robot, levels, {"press": hurcules.Twist(press, 0.3)}, control="torque"
    )
    controller.sense(press, "cell")
    simulation = hurcules.Simulation(model=model, controller=controller)
    rest_and_tare(simulation, press)
    simulation.step(round(4.0 / simulation.dt), {"press": [0.03]})
    wanted = sum(controller.contact_force(leg) for leg in legs)
    assert press.contact == hurcules.ContactState.Contact
    assert press.force == pytest.approx(WANTED, abs=0.5)
    assert wanted[0] == pytest.approx(WANTED, abs=1.5)
    assert simulation.data.body("trunk").xpos[2] > 0.35


def test_a_tare_that_is_asked_for_beforehand_is_taken_at_each_start() -> None:
    simulation, press = pressing("velocity", tool=0.3)
    press.tare()
    again = hurcules.Simulation(model=simulation.model, controller=simulation.controller)
    for _ in range(2):
        again.step(102)
        assert press.contact == hurcules.ContactState.Free
        again.step(100)
        assert press.force == pytest.approx(0.0, abs=0.05)
        again.reset()
