"""Paths: what docs/loop.md says of a tool that follows one, on an arm of six joints written here.

Strategy: places and axes by MuJoCo's own kinematics of the physics, beside the path as NumPy has
it. That the tool waits where a joint is too slow: example 21 (test_examples.py).
"""

from __future__ import annotations

from collections.abc import Callable

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """<mujoco><option timestep="0.002"/><compiler angle="radian"/>
  <default><joint axis="0 1 0" armature="0.1" range="-3 3"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0 0 0.1" mass="2" contype="0"/></default>
  <worldbody>
    <body pos="0 0 0.3"><joint name="turn" axis="0 0 1"/><geom/>
      <body><joint name="shoulder"/><geom fromto="0 0 0 0 0 0.5"/>
        <body pos="0 0 0.5"><joint name="elbow"/><geom fromto="0 0 0 0 0 0.4"/>
          <body pos="0 0 0.4"><joint name="roll" axis="0 0 1"/><geom/>
            <body><joint name="bend"/><geom/>
              <body pos="0 0 0.1"><joint name="spin" axis="0 0 1"/><geom/>
                <site name="tip" pos="0 0 0.15"/></body></body></body></body></body></body>
    <body name="table" pos="0.65 0.15 0.1"><joint name="table" axis="0 0 1" range="-9 9"/>
      <geom type="cylinder" size="0.1 0.02" fromto="0 0 0 0 0 0.02" mass="8"/></body>
  </worldbody></mujoco>"""
JOINTS = ["turn", "shoulder", "elbow", "roll", "bend", "spin"]
START = [0.0, 0.3, 1.6, 0.0, 1.24, 0.0]
UP = np.array([0.0, 0.0, 1.0])
Lead = Callable[[hurcules.PositionTask, float, np.ndarray], None]


@pytest.fixture
def model() -> mujoco.MjModel:
    return hurcules.with_motors(mujoco.MjSpec.from_string(ARM))


def arm(model: mujoco.MjModel, joints: list[str] = JOINTS) -> hurcules.Robot:
    robot = hurcules.Robot(model, joints=joints)
    robot.set_configuration([*START, 0.0][: len(joints)])
    return robot


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    """The rotation about a unit vector."""
    quaternion, matrix = np.zeros(4), np.zeros(9)
    mujoco.mju_axisAngle2Quat(quaternion, np.asarray(axis, float), angle)
    mujoco.mju_quat2Mat(matrix, quaternion)
    return matrix.reshape(3, 3)


def circle(time: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A place, its rate and that of its rate: 0.1 m/s about a radius of 80 mm, from rest."""
    gain = 0.1 if time < 1.0 else 0.0
    way, speed = (0.05 * time**2, 0.1 * time) if time < 1.0 else (0.1 * (time - 0.5), 0.1)
    out = np.array([np.cos(way / 0.08), np.sin(way / 0.08), 0.0])
    along, start = np.cross(UP, out), np.array([1.0, 0.0, 0.0])
    return 0.08 * (out - start), speed * along, gain * along - speed**2 / 0.08 * out


def off_the_circle(model: mujoco.MjModel, control: str, lead: Lead) -> tuple[float, float]:
    """How far the tip is beside where the circle is, along and across [m]."""
    robot = arm(model)
    start = robot.position("tip")
    place = hurcules.PositionTask("place", robot, "tip")
    tilt = hurcules.OrientationTask("tilt", robot, "tip")
    controller = hurcules.WholeBodyController(robot, [[place, tilt]], control=control)
    simulation = hurcules.Simulation(model=model, controller=controller)
    worst = np.zeros(2)
    while simulation.time < 4.0:
        lead(place, simulation.time, start)
        simulation.step(1)
        here, rate, _ = circle(simulation.time)
        mujoco.mj_kinematics(model, simulation.data)  # a step leaves places where it began
        off = simulation.data.site("tip").xpos - start - here
        if simulation.time > 1.5:
            along = off @ rate / np.linalg.norm(rate)
            worst = np.maximum(worst, [abs(along), np.sqrt(max(0.0, off @ off - along**2))])
    return worst[0], worst[1]


def test_a_path_without_its_rate_is_followed_late_and_cut(model: mujoco.MjModel) -> None:
    along, across = off_the_circle(
        model, "velocity", lambda place, time, start: place.set_target(start + circle(time)[0])
    )
    assert 0.018 < along < 0.025  # 0.1 m/s by 5 / s
    assert 0.004 < across < 0.008


def test_with_its_rate_the_tool_is_on_the_path_at_each_moment(model: mujoco.MjModel) -> None:
    def lead(place: hurcules.PositionTask, time: float, start: np.ndarray) -> None:
        here, rate, _ = circle(time)
        place.set_target(start + here, rate)

    along, across = off_the_circle(model, "velocity", lead)
    assert along < 5e-5 and across < 5e-5  # a period is 0.2 mm


@pytest.mark.parametrize("control", ["acceleration", "torque"])
def test_by_accelerations_a_curve_wants_its_acceleration_too(
    model: mujoco.MjModel, control: str
) -> None:
    def lead(place: hurcules.PositionTask, time: float, start: np.ndarray) -> None:
        here, rate, turns = circle(time)
        place.set_target(start + here, rate, turns if told else None)

    told = False
    assert max(off_the_circle(model, control, lead)) > 1e-3
    told = True
    assert max(off_the_circle(model, control, lead)) < 5e-5


def seen_axis(robot: hurcules.Robot) -> hurcules.OrientationTask:
    """The world as the tool sees it, free about the tool's z."""
    axis = hurcules.OrientationTask("axis", robot, "world", reference="tip")
    axis.set_interval([0.0, 0.0, -np.inf], [0.0, 0.0, np.inf])
    return axis


def test_a_tool_is_free_about_its_own_axis_however_it_leans(model: mujoco.MjModel) -> None:
    """Of an OrientationTask in the axes of the world the third row is the world's z."""
    worst = {}
    for own in (True, False):
        robot = arm(model)
        upright, start = robot.orientation("tip"), robot.position("tip")
        place = hurcules.PositionTask("place", robot, "tip")
        if own:
            axis = seen_axis(robot)
        else:
            axis = hurcules.OrientationTask("axis", robot, "tip")
            axis.set_weights([1.0, 1.0, 0.0])
        spin = hurcules.PostureTask("spin", robot, ["spin"])
        stack = [[place, axis], hurcules.StackLevel("spin", [spin], rho=0.0)]
        controller = hurcules.WholeBodyController(robot, stack)
        simulation = hurcules.Simulation(model=model, controller=controller)
        place.set_target(start)
        lean = turned([1.0, 0.0, 0.0], 0.5) @ upright
        axis.set_target(lean.T if own else lean)
        spin.set_target([1.0])
        simulation.step(3000)
        tip = simulation.data.site("tip")
        worst[own] = np.linalg.norm(np.cross(tip.xmat[2::3], lean[:, 2]))
        assert np.linalg.norm(tip.xpos - start) < 1e-4
        assert abs(controller.plan.configuration[5] - 1.0) < 1e-3
        # what is free is not short
        assert not own or not [s for level in controller.diagnostics() for s in level.shortfalls]
    assert worst[True] < 1e-3 and worst[False] > 0.1


def test_a_tool_leans_within_a_cone(model: mujoco.MjModel) -> None:
    robot = arm(model)
    upright, widest = robot.orientation("tip")[:, 2], np.cos(np.radians(15.0))

    def upright_part(robot: hurcules.Robot) -> tuple[list[float], np.ndarray]:
        axis = robot.orientation("tip")[:, 2]
        return [axis @ upright], np.cross(axis, upright)[None] @ robot.rotation_jacobian("tip")

    cone = hurcules.CustomTask("cone", robot, 1, upright_part)
    cone.set_target([0.0])
    cone.set_interval([widest], [np.inf])
    place = hurcules.PositionTask("place", robot, "tip")
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [cone, place, posture])
    simulation = hurcules.Simulation(model=model, controller=controller)
    posture.set_target([0.0, 0.3, 1.6, 0.0, 0.4, 0.0])  # leans by 0.84 rad
    least = 1.0
    for _ in range(2000):
        simulation.step(1)
        least = min(least, simulation.data.site("tip").xmat[2::3] @ upright)
    assert 14.0 < np.degrees(np.arccos(least)) < 15.2


@pytest.mark.parametrize("how", ["coordinate", "sensed, late", "sensed, told"])
def test_a_tool_follows_its_way_on_a_turntable(model: mujoco.MjModel, how: str) -> None:
    turns = how == "coordinate"
    robot = arm(model, [*JOINTS, "table"] if turns else JOINTS)
    place = hurcules.PositionTask("place", robot, "tip", reference="table")
    tilt = hurcules.OrientationTask("tilt", robot, "tip")
    if turns:
        table = hurcules.PostureTask("table", robot, ["table"])
        levels, channel = [table, [place, tilt]], hurcules.Twist(table, 1.0)
    else:
        levels, channel = [[place, tilt]], hurcules.JointRate("table", 1.0)
    controller = hurcules.WholeBodyController(
        robot, levels, {"table": channel}, base="held" if turns else "sensed"
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    data, start = simulation.data, place.target.copy()
    for _ in range(1500):
        there = start + np.array([0.02 * simulation.time, 0.0, 0.0])  # in the axes of the table
        rate = np.array([0.02, 0.0, 0.0])
        if how == "sensed, told":
            rate = rate + np.cross(data.joint("table").qvel[0] * UP, there)
        place.set_target(there, rate)
        simulation.step(1, {"table": [0.3]})
    table_frame = data.body("table")
    at = table_frame.xmat.reshape(3, 3).T @ (data.site("tip").xpos - table_frame.xpos)
    off = np.linalg.norm(at - there)
    if how == "sensed, late":
        assert off > 5e-3
    else:
        assert off < 3e-4


WAY, SPEED = np.array([0.0, 0.4, 0.0]), 0.1  # [m] aside, [m/s]


def test_a_tool_waits_on_its_path_before_a_range(model: mujoco.MjModel) -> None:
    robot = arm(model)
    limits = hurcules.JointLimits("limits", robot)
    limits.set_range("turn", -0.3, 0.3)
    tool = hurcules.PoseTask("tool", robot, "tip")
    controller = hurcules.WholeBodyController(robot, [limits, tool])
    simulation = hurcules.Simulation(model=model, controller=controller)
    start, upright, along = robot.position("tip"), robot.orientation("tip"), WAY / 0.4
    s, across = 0.0, 0.0
    for _ in range(2000):
        speed = SPEED * max(0.0, 1.0 - np.linalg.norm(tool.error[:3]) / 0.002)
        tool.set_target(start + s * along, upright, [*speed * along, 0.0, 0.0, 0.0])
        simulation.step(1)
        s += speed * simulation.dt
        off = simulation.data.site("tip").xpos - start
        across = max(across, np.linalg.norm(off - (off @ along) * along))
    assert 0.1 < s < 0.3 and across < 1e-3
    assert np.abs(controller.qd_des).max() < 1e-3
    assert "turn upper limit" in str(controller.diagnostics()[-1].shortfalls[0])


def test_a_tool_stays_on_a_path_whose_way_is_a_coordinate() -> None:
    spec = mujoco.MjSpec.from_string(ARM)
    way = spec.worldbody.add_body(name="way", gravcomp=1.0)
    way.add_joint(name="s", type=mujoco.mjtJoint.mjJNT_SLIDE, range=[0.0, 0.5])
    way.add_geom(size=[0.01, 0.0, 0.0], mass=1.0, contype=0, conaffinity=0)
    model = hurcules.with_motors(spec)
    robot = hurcules.Robot(model, joints=[*JOINTS, "s"])
    robot.set_configuration([*START, 0.0])
    limits = hurcules.JointLimits("limits", robot)
    limits.set_range("turn", -0.3, 0.3)
    start, along, column = robot.position("tip"), WAY / 0.4, robot.coordinate("s")

    def beside(robot: hurcules.Robot) -> tuple[np.ndarray, np.ndarray]:
        rows = robot.position_jacobian("tip").copy()
        rows[:, column] -= along
        return robot.position("tip") - start - robot.configuration[column] * along, rows

    path = hurcules.CustomTask("path", robot, 3, beside)
    path.set_target(np.zeros(3))
    tilt = hurcules.OrientationTask("tilt", robot, "tip")
    goes = hurcules.PostureTask("goes", robot, ["s"])
    goes.max_lead = 0.005
    stack = [limits, [path, tilt], hurcules.StackLevel("goes", [goes], rho=0.0)]
    controller = hurcules.WholeBodyController(robot, stack, {"s": hurcules.Twist(goes, 1.0)})
    simulation = hurcules.Simulation(model=model, controller=controller)
    across = 0.0
    for tick in range(2000):
        simulation.step(1, {"s": [SPEED]})
        off = simulation.data.site("tip").xpos - start
        across = max(across, np.linalg.norm(off - (off @ along) * along))
        if tick == 500:
            assert abs(controller.qd_des[column] - SPEED) < 1e-4
    assert 0.1 < controller.q_des[column] < 0.3 and across < 1e-4
    assert "turn upper limit" in str(controller.diagnostics()[-1].shortfalls[0])


def test_a_light_wrist_with_dry_friction_stays_on_its_path() -> None:
    """0.01 N m on 1e-4 kg m^2: 15 mrad off when friction was not fed forward."""

    def off_its_turn(friction: str) -> float:
        light = f'armature="0.0001" frictionloss="{friction}"/><geom mass="0.01"'
        spin = 'name="spin" axis="0 0 1"'
        text = ARM.replace(f"{spin}/><geom", f"{spin} {light}")
        model = hurcules.with_motors(mujoco.MjSpec.from_string(text))
        robot = arm(model)
        tool = hurcules.PoseTask("tool", robot, "tip")
        controller = hurcules.WholeBodyController(robot, [tool])
        simulation = hurcules.Simulation(model=model, controller=controller)
        start, upright, worst = robot.position("tip"), robot.orientation("tip"), 0.0
        while simulation.time < 6.0:
            angle, rate = 0.3 - 0.3 * np.cos(simulation.time), 0.3 * np.sin(simulation.time)
            tool.set_target(start, turned(UP, angle) @ upright, [0.0, 0.0, 0.0, 0.0, 0.0, rate])
            simulation.step(1)
            axis = 0.3 - 0.3 * np.cos(simulation.time)
            data = simulation.data
            mujoco.mj_kinematics(model, data)
            x = data.site("tip").xmat[::3]
            wanted = (turned(UP, axis) @ upright)[:, 0]
            worst = max(worst, np.linalg.norm(np.cross(x, wanted)))
        return worst

    assert off_its_turn("0.01") < off_its_turn("0.0") + 1e-3


@pytest.mark.parametrize("control", ["velocity", "acceleration"])
def test_a_tool_goes_no_harder_than_its_acceleration(model: mujoco.MjModel, control: str) -> None:
    """A way d of trapezoidal speed takes d / v + v / a; K brings the last part home."""
    robot = arm(model)
    place = hurcules.PositionTask("place", robot, "tip")
    tilt = hurcules.OrientationTask("tilt", robot, "tip")
    place.set_max_speed(0.2)
    place.set_max_acceleration(0.4)
    controller = hurcules.WholeBodyController(robot, [place, tilt], control=control)
    simulation = hurcules.Simulation(model=model, controller=controller)
    start = robot.position("tip")
    goals = start + np.array([[0.0, 0.25, 0.0], [0.0, -0.05, -0.15]])
    places = []
    for goal, seconds in ((goals[0], 0.9), (goals[1], 4.0)):  # turned round in mid-way
        place.set_target(goal)
        for _ in range(round(seconds / simulation.dt)):
            simulation.step(1)
            places.append(controller.plan.position("tip"))
    speed = np.diff(places, axis=0) / simulation.dt
    hardest = np.linalg.norm(np.diff(speed, axis=0), axis=1).max() / simulation.dt
    assert 0.3 < hardest < 1.05 * 0.4
    assert 0.19 < np.linalg.norm(speed, axis=1).max() < 0.202
    assert np.linalg.norm(places[-1] - goals[1]) < 1e-3
    state = controller.state()
    place.set_max_acceleration(np.inf)
    controller.restore(state)
    assert place.max_acceleration == 0.4


def test_a_bound_of_acceleration_forgets_what_was_not_followed(model: mujoco.MjModel) -> None:
    """Rows without weight meanwhile, an interval, gains of rows: each jumped or crept."""
    for change in ("weights", "interval", "gain"):
        robot = arm(model)
        place = hurcules.PositionTask("place", robot, "tip")
        posture = hurcules.PostureTask("posture", robot)
        place.set_max_speed(0.2)
        place.set_max_acceleration(0.4)
        if change == "interval":
            place.set_interval([-1e-3] * 3, [1e-3] * 3)
        if change == "gain":
            place.set_gain([5.0, 5.0, 100.0])
            place.set_weights([1.0, 1.0, 0.0])
        controller = hurcules.VelocityController(
            robot, hurcules.VelocityControllerOptions(dt=0.002)
        )
        controller.set_stack(hurcules.Stack([place, posture]))
        start, places = robot.position("tip"), []
        place.set_target(start + np.array([0.0, 0.25, 0.0]))
        for tick in range(3000):
            if change == "weights" and tick in (400, 1500):
                place.set_weights(0.0 if tick == 400 else 1.0)
            robot.set_configuration(controller.step(robot))
            places.append(robot.position("tip"))
        here = np.array(places)[500 if change == "weights" else 0 :, :2]
        changes = np.diff(here, n=2, axis=0) / 0.002**2
        began = 0 if change != "weights" else 1000
        assert np.linalg.norm(changes[began:], axis=1).max() < 0.5, change
        assert abs(here[-1, 1] - start[1] - 0.25) < 2e-3, change


def test_a_bound_of_acceleration_outlives_numbers_that_are_none(model: mujoco.MjModel) -> None:
    robot, broken = arm(model), False

    def height(robot: hurcules.Robot) -> tuple[list[float], np.ndarray]:
        rows = robot.position_jacobian("tip")[2:]
        return [robot.position("tip")[2]], rows * np.nan if broken else rows

    task = hurcules.CustomTask("height", robot, 1, height)
    task.set_max_acceleration(0.5)
    controller = hurcules.VelocityController(robot)
    controller.set_stack(hurcules.Stack([task]))
    goal = robot.position("tip")[2] - 0.05
    task.set_target([goal])
    for tick in range(4000):
        broken = tick < 10
        robot.set_configuration(controller.step(robot))
    assert abs(robot.position("tip")[2] - goal) < 1e-4


@pytest.mark.parametrize("control", ["velocity", "torque"])
def test_a_light_follower_with_dry_friction_takes_none_of_its_leader(control: str) -> None:
    """2 N m slide from 2 mrad/s on, 0.01 N m on 2 g never: as one, 0.48 rad off."""
    worst = {}
    for friction in (0.0, 0.01):
        text = f"""<mujoco><option timestep="0.002" gravity="0 0 0"/>
          <worldbody><body><joint name="arm" axis="0 0 1" armature="0.1" frictionloss="2"/>
            <geom type="capsule" size="0.03" fromto="0 0 0 0.4 0 0" mass="1" contype="0"/>
            <body pos="0.4 0 0"><joint name="finger" axis="0 0 1" frictionloss="{friction}"/>
              <geom size="0.01" pos="0.02 0 0" mass="0.002" contype="0"/></body></body>
          </worldbody><actuator><motor joint="arm" ctrlrange="-50 50"/></actuator>
          <equality><joint joint1="finger" joint2="arm" polycoef="0 -0.5 0 0 0"/></equality>
          </mujoco>"""
        model = mujoco.MjModel.from_xml_string(text)
        robot = hurcules.Robot(model)
        posture = hurcules.PostureTask("posture", robot)
        controller = hurcules.WholeBodyController(robot, [posture], control=control)
        simulation = hurcules.Simulation(model=model, controller=controller)
        worst[friction] = 0.0
        while simulation.time < 4.0:
            time = simulation.time
            posture.set_target([0.3 - 0.3 * np.cos(time)], [0.3 * np.sin(time)])
            simulation.step(1)
            off = simulation.data.qpos[0] - 0.3 + 0.3 * np.cos(simulation.time)
            worst[friction] = max(worst[friction], abs(off))
    assert worst[0.01] < worst[0.0] + 2e-3 and worst[0.0] < 6e-3
