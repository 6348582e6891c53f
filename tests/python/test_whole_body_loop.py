"""The closed loop on robots that are not Hurcules: channels, stacks, batches, what is refused.

Strategy: a planar arm of text under gravity, in the physics. What the loop is made of has C++ tests
(tests/cpp/sim/whole_body_test.cpp); here is what Python adds, and how it reads.
"""

from collections.abc import Callable
from pathlib import Path

import mujoco
import numpy as np
import pytest

import hurcules

ARM = """<mujoco><option timestep="0.002" integrator="implicitfast"/>
  <compiler angle="radian"/>
  <default><joint axis="0 1 0" armature="0.05" damping="0.5" range="-2.5 2.5"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="2" contype="0"/></default>
  <worldbody><body pos="0 0 1"><joint name="j1"/><geom/>
    <body pos="0.4 0 0"><joint name="j2"/><geom/>
      <body pos="0.4 0 0"><joint name="j3"/><geom/><site name="tip" pos="0.4 0 0"/>
        <body pos="0.4 0 0"><joint name="finger" type="slide" axis="1 0 0" range="0 0.05"/>
          <geom fromto="0 0 0 0.02 0 0" size="0.01" mass="0.1"/></body>
      </body></body></body></worldbody>
  <actuator><motor joint="j1" forcerange="-200 200"/><motor joint="j2" forcerange="-200 200"/>
    <motor joint="j3" forcerange="-100 100"/><motor joint="finger" forcerange="-20 20"/></actuator>
</mujoco>"""
PLANE = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]
START = [0.3, 0.8, -0.6]

Channels = Callable[[hurcules.PositionTask], dict[str, object]]


def simulate(channels: Channels, **options: object) -> hurcules.Simulation:
    """The arm at its start, its tip above the posture."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=PLANE)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [tip, posture], channels(tip), **options)
    return hurcules.Simulation(model=model, controller=controller)


def twist(tip: hurcules.PositionTask) -> dict[str, object]:
    return {"tip": hurcules.Twist(tip, 0.5), "finger": hurcules.JointRate("finger", 0.1)}


def looks(channel: Callable[[hurcules.GazeTask], object]) -> hurcules.Simulation:
    """The arm with the point that its tip looks at as a channel."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    gaze = hurcules.GazeTask("gaze", robot, "tip")
    levels = [gaze, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, levels, {"gaze": channel(gaze)})
    return hurcules.Simulation(model=model, controller=controller)


def at(simulation: hurcules.Simulation) -> np.ndarray:
    return simulation.data.site("tip").xpos[[0, 2]].copy()


def test_a_command_is_given_by_name_or_as_one_array() -> None:
    one, other = simulate(twist), simulate(twist)
    assert one.command_names == ["tip_0", "tip_1", "finger"]
    assert one.command_scale.tolist() == [0.5, 0.5, 0.1]
    assert one.step(250, {"tip": [-0.2, 0.1]}) == 250
    other.step(250, [-0.2, 0.1, 0.0])
    assert np.array_equal(one.state(), other.state(), equal_nan=True)
    assert one.time == pytest.approx(0.5)


@pytest.mark.parametrize("law", ["velocity", "acceleration"])
def test_a_twist_leads_and_nothing_holds(law: str) -> None:
    simulation = simulate(twist, control=law)
    start = at(simulation)
    simulation.step(500, {"tip": [-0.1, 0.05]})
    simulation.step(1000)
    assert at(simulation) - start == pytest.approx([-0.1, 0.05], abs=1e-3)


def test_a_delta_counts_from_the_measured_value_and_zero_leaves_the_target() -> None:
    simulation = simulate(lambda tip: {"tip": hurcules.Delta(tip, 0.2)})
    start = at(simulation)
    simulation.step(1000, {"tip": [-0.1, 0.05]})
    simulation.step(500, {"tip": [0.0, 0.0]})
    assert at(simulation) - start == pytest.approx([-0.1, 0.05], abs=1e-3)


def test_a_target_is_set() -> None:
    simulation = simulate(lambda tip: {"tip": hurcules.Target(tip)})
    wanted = at(simulation) + np.array([-0.2, -0.1])
    simulation.step(2000, {"tip": wanted})
    assert at(simulation) == pytest.approx(wanted, abs=1e-3)


def test_a_channel_that_a_command_does_not_name_holds() -> None:
    # a Target went to zero
    simulation = simulate(
        lambda tip: {"tip": hurcules.Target(tip), "finger": hurcules.JointRate("finger", 0.1)}
    )
    where = at(simulation) + np.array([-0.1, 0.1])
    simulation.step(100, {"tip": where})
    simulation.step(1000, {"finger": [0.01]})
    assert at(simulation) == pytest.approx(where, abs=1e-3)
    simulation.step(100, {})  # names none: all hold
    simulation.step(100, {"tip": None})
    assert at(simulation) == pytest.approx(where, abs=1e-3)
    batch = hurcules.SimulationBatch(simulation, 1, threads=1)
    batch.step(100, {})
    simulation.step(100)
    assert np.array_equal(batch[0].state(), simulation.state())
    with pytest.raises(hurcules.Error, match="finite"):
        simulation.step(1, {"tip": [np.nan, np.nan]})
    with pytest.raises(hurcules.Error, match="finite"):
        simulation.step(1, [np.nan, np.nan, 0.0])


def test_what_an_operator_did_is_in_the_log_and_gives_the_same_bits(tmp_path: Path) -> None:
    # a target that was left alone was 0 in the log, a delta stood in each tick of its step
    def session() -> hurcules.Simulation:
        return simulate(
            lambda tip: {
                "tip": hurcules.Target(tip),
                "by": hurcules.Delta(tip, 0.2),
                "finger": hurcules.JointRate("finger", 0.1),
            }
        )

    first, again = session(), session()
    where = at(first) + np.array([-0.1, 0.1])
    first.step(40, {"tip": where})
    first.step(40, {"finger": [0.01]})
    first.step(40, {"by": [0.05, 0.0]})
    first.step(40)
    log = first.log()
    rows = np.column_stack([log[f"command/{name}"] for name in first.command_names])
    assert rows[0, :2] == pytest.approx(where)
    assert np.isnan(rows[1:, :2]).all()
    assert np.flatnonzero(rows[:, 2]).tolist() == [80]
    assert again.replay(log) == 160
    assert np.array_equal(first.data.qpos, again.data.qpos)
    assert np.array_equal(first.state(), again.state())
    with pytest.raises(hurcules.Error, match="no 'command/tip_0'"):
        again.replay(simulate(lambda tip: {}).log())
    file = tmp_path / "log.npz"
    np.savez(file, **log)
    third = session()
    assert third.replay(file) == 160
    assert np.array_equal(first.state(), third.state())
    file.write_text("no log")
    with pytest.raises(hurcules.Error, match=r"cannot read .*log\.npz as a log"):
        third.replay(str(file))


def test_a_reset_goes_back_to_its_own_start() -> None:
    own = hurcules.Simulation("stretch", seed=3, record=False)
    start = own.data.qpos.copy()
    own.step(5)
    own.reset()
    assert np.array_equal(own.data.qpos, start)
    own.reset(4)
    assert not np.array_equal(own.data.qpos, start)
    own.reset(seed=3)
    assert np.array_equal(own.data.qpos, start)


def test_what_does_not_belong_together_is_told() -> None:
    person = hurcules.lift.Person(mass=90)
    with pytest.raises(hurcules.Error, match=r"parameters: wanted a mapping.* got Person\(mass=90"):
        hurcules.Simulation("lift", parameters=person)  # type: ignore[arg-type]
    with pytest.raises(hurcules.Error, match="'lift' has a model and a controller of its own"):
        hurcules.Simulation("lift", model=hurcules.lift.model(person))


def test_the_point_that_a_gaze_looks_at_is_set() -> None:
    # a Target wanted as many numbers as rows, a gaze has two
    still = hurcules.Robot(mujoco.MjModel.from_xml_string(ARM), joints=["j1", "j2", "j3"])
    simulation = looks(hurcules.Target)
    simulation.step(1500, {"gaze": [1.0, 0.0, 0.9]})
    assert simulation.level_errors()[0] < 1e-3
    with pytest.raises(hurcules.Error, match="wants 1 or 3 numbers"):
        looks(lambda gaze: hurcules.Target(gaze, [1.0, 1.0]))
    with pytest.raises(hurcules.Error, match="'still' does not take"):
        looks(lambda gaze: hurcules.Target(hurcules.DampingTask("still", still)))


def test_a_level_within_its_interval_has_no_error() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=[[0.0, 0.0, 1.0]])
    controller = hurcules.WholeBodyController(robot, [tip, hurcules.PostureTask("rest", robot)])
    simulation = hurcules.Simulation(model=model, controller=controller)
    tip.set_target(tip.target - 0.05)  # the tip is 50 mm above
    tip.set_interval([-0.1], [0.1])
    simulation.step(1)
    assert tip.error[0] == pytest.approx(0.05, abs=0.005)
    level = simulation.levels.index("tip")
    assert simulation.commanded_level_errors()[level] == 0.0
    assert simulation.level_errors()[level] == 0.0
    tip.set_interval([-0.1], [0.02])
    simulation.step(1)
    assert simulation.commanded_level_errors()[level] == pytest.approx(tip.error[0] - 0.02)
    assert simulation.level_errors()[level] == pytest.approx(0.03, abs=1e-3)


@pytest.mark.parametrize("channels", [twist, lambda tip: {}], ids=["twist", "no channel"])
def test_a_twist_that_rests_leaves_a_target_that_is_led_alone(channels: Channels) -> None:
    # it took the feed-forward away: 41 mm behind at 0.2 m/s
    simulation = simulate(channels)
    tip = simulation.controller.tasks[0]
    start, velocity = at(simulation), np.array([-0.2, 0.1])
    for tick in range(1000):
        tip.set_target(start + velocity * 0.002 * tick, velocity)
        simulation.step()
    assert np.linalg.norm(tip.error) < 2e-3


def test_joints_follow_a_motion_and_a_stack_takes_over() -> None:
    simulation = simulate(twist)
    u = np.linspace(0.002, 1.0, 500)[:, np.newaxis]
    way, rate = START[1] + 0.2 * u**2 * (3 - 2 * u), 0.2 * 6 * u * (1 - u) / 1.0
    assert simulation.follow(["j2"], way, rate) == 500
    assert simulation.controller.active is None
    simulation.controller.use("stack")
    simulation.step(500)
    assert simulation.controller.active == "stack"
    assert simulation.data.qpos[1] == pytest.approx(START[1] + 0.2, abs=1e-3)
    assert np.abs(simulation.controller.joint_error).max() < 1e-3
    with pytest.raises(hurcules.Error, match=r"'j2' goes from .* row 499 wants 9"):
        simulation.follow(["j2"], np.append(way[:-1], [[9.0]], axis=0), rate)


def same(batch: hurcules.SimulationBatch, states: list[np.ndarray]) -> None:
    for one, other in zip(batch.state(), states, strict=True):
        assert np.array_equal(one, other, equal_nan=True)


def test_a_batch_has_the_bits_of_each_alone() -> None:
    simulation = simulate(twist)
    simulation.step(100, {"tip": [-0.1, 0.0]})
    commands = np.linspace(-0.2, 0.2, 8).reshape(4, 2)
    one, two = (hurcules.SimulationBatch(simulation, 4, threads=n) for n in (1, 2))
    tip = hurcules.Quantities(simulation, ["value/tip", "finished"])
    one.step(200, {"tip": commands})
    read = two.step_and_read(200, tip, {"tip": commands})
    assert np.array_equal(read, one.read(tip))
    same(one, two.state())
    assert one.qpos.shape == (4, 4) and one.time.tolist() == pytest.approx([0.6] * 4)
    simulation.step(200, {"tip": commands[2]})
    assert np.array_equal(one.state()[2], simulation.state(), equal_nan=True)
    states = one.state()
    one.step(50, mask=[True, False, False, False])
    assert one.time.tolist() == pytest.approx([0.7, 0.6, 0.6, 0.6])
    one.restore(states)
    same(one, states)
    one.reset([0, 0, 0, 0], mask=[False, True, False, False])
    assert one.time.tolist() == pytest.approx([0.6, 0.0, 0.6, 0.6])


def test_models_of_a_batch_may_differ_in_their_numbers() -> None:
    simulation = simulate(twist)
    models = [mujoco.MjModel.from_xml_string(ARM) for _ in range(2)]
    models[1].body_mass[:] *= 1.5
    batch = hurcules.SimulationBatch(simulation, 2, models=models)
    batch.step(100, {"tip": [[-0.1, 0.0]] * 2})
    assert not np.array_equal(batch.qpos[0], batch.qpos[1])


def test_a_controller_runs_in_one_loop_at_a_time() -> None:
    first = simulate(twist)
    first.step(100, {"tip": [-0.2, 0.1]})
    there, state = at(first), first.state()
    second = hurcules.Simulation(model=first.model, controller=first.controller)
    second.step(10)
    with pytest.raises(hurcules.Error, match="another loop has taken the controller"):
        first.step(1)
    assert np.array_equal(at(first), there)
    first.restore(state)
    first.step(1)
    with pytest.raises(hurcules.Error, match="reset it first"):
        second.step(1)
    first.controller.reset(first.data.qpos)
    first.controller.tick(first.data.qpos, first.data.qvel)
    with pytest.raises(hurcules.Error, match="another loop"):
        first.step(1)
    first.reset()
    assert first.step(1) == 1


def test_the_controller_of_a_mission_or_of_a_batch_runs_elsewhere() -> None:
    batch = hurcules.SimulationBatch(simulate(twist), 2)
    mission = hurcules.Simulation("stretch", record=False)
    for one, model in ((batch[1], simulate(twist).model), (mission, mission.model)):
        other = hurcules.Simulation(model=model, controller=one.controller)
        assert other.step(2) == 2


def test_a_limit_that_many_levels_hold_has_room_in_a_state() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    limits = hurcules.JointLimits("limits", robot)
    levels = [limits]
    for joint, angle in zip(robot.coordinate_names, START, strict=True):
        limits.set_range(joint, angle - 0.1, angle + 0.1)
    for i in range(8):  # each pulls elsewhere, beyond what the joints reach
        tip = hurcules.PositionTask(f"tip {i}", robot, "tip", axes=PLANE[1:])
        tip.set_target([tip.value[0] + 0.5 + 0.1 * i])
        tip.set_interval([-0.01], [0.01])
        levels.append(tip)
    controller = hurcules.WholeBodyController(robot, levels)
    simulation = hurcules.Simulation(model=model, controller=controller)
    sizes = set()
    for _ in range(100):
        simulation.step(10)
        sizes.add(len(simulation.state()))
    state = simulation.state()
    simulation.step(20)
    there = simulation.state()
    simulation.restore(state)
    simulation.step(20)
    assert np.array_equal(simulation.state(), there)
    assert len(sizes) == 1


def test_it_says_what_it_is() -> None:
    simulation = simulate(twist)
    assert "limits < tip < posture; channels: tip finger" in repr(simulation)


REFUSED: dict[str, tuple[Callable[[], object], str]] = {
    "channel": (lambda: simulate(twist).step(1, {"hand": [0.0]}), "channel 'hand' does not exist"),
    "size": (lambda: simulate(twist).step(1, {"tip": [0.0] * 3}), r"wanted shape \(2,\)"),
    "nan": (lambda: simulate(twist).step(1, [np.nan, 0.0, 0.0]), "3 finite numbers"),
    "joint": (lambda: hurcules.Robot(mujoco.MjModel.from_xml_string(ARM), joints=["j9"]), "'j9'"),
    "stack": (lambda: simulate(twist).controller.use("walk"), "'walk' does not exist"),
    "control": (lambda: simulate(twist, control="force"), "'force' does not exist"),
    "base": (lambda: simulate(twist, base="flying"), "'flying' does not exist"),
    "spec": (lambda: simulate(lambda tip: {"tip": tip}), "wants Twist, Delta"),
    "coordinate": (
        lambda: simulate(lambda tip: {"j": hurcules.JointRate("j1", 1.0)}),
        "which the tasks move",
    ),
    "drive": (lambda: simulate(lambda tip: {"d": hurcules.Drive(1.0, 1.0)}), "its tracks"),
    "both": (lambda: hurcules.Simulation(model=mujoco.MjModel.from_xml_string(ARM)), "both"),
    "batch": (lambda: hurcules.SimulationBatch(simulate(twist), 0), "n >= 1"),
    "period": (lambda: simulate(twist, dt=0.003), "whole number of physics steps"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_is_refused(case: str) -> None:
    make, text = REFUSED[case]
    with pytest.raises(hurcules.Error, match=text):
        make()


@pytest.mark.parametrize(
    ("setting", "value", "said"),
    [("timestep", 5e-3, "time step of 5 ms"), ("iterations", 4, "4 iterations")],
)
def test_settings_with_which_tracks_go_wrong_are_warned_of(setting, value, said):
    model = hurcules.models.load("rescue")
    setattr(model.opt, setting, value)
    robot = hurcules.Robot(model)
    controller = hurcules.WholeBodyController(
        robot, [hurcules.PostureTask("posture", robot)], dt=5e-3
    )
    with pytest.warns(UserWarning, match=said):
        hurcules.Simulation(model=model, controller=controller)


@pytest.mark.parametrize("kind", [hurcules.Twist, hurcules.Delta])
def test_a_rate_moves_what_the_ruling_stack_measures_and_nothing_else(kind: type) -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=PLANE)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot, channels={"tip": kind(tip, 0.5)}, stacks={"reach": [tip, posture], "rest": [posture]}
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    start, target = at(simulation), tip.target
    simulation.step(250, {"tip": [-0.1, 0.05]})
    moved = tip.target
    assert np.abs(moved - target).min() > 0.01
    controller.use("rest")
    simulation.step(250, {"tip": [-0.2, 0.1]})
    assert not controller.command.any()
    assert np.array_equal(tip.target, moved)
    controller.use("reach")  # it goes where it was sent, no velocity is left over
    simulation.step(1500)
    assert np.array_equal(tip.target, moved)
    assert at(simulation) == pytest.approx(moved, abs=1e-3)
    assert start == pytest.approx(target)
    controller.move_joints()
    simulation.step(250, {"tip": [-0.2, 0.1]})
    assert np.array_equal(tip.target, moved)


@pytest.mark.parametrize("control", ["acceleration", "torque"])
def test_a_target_whose_acceleration_is_told_is_followed_without_lag(control: str) -> None:
    radius, turning = 0.05, 2.0  # [m], [rad/s]: 0.2 m/s^2, over K = 100 1/s^2 it is 2 mm
    worst = []
    for told in (False, True):
        simulation = simulate(lambda tip: {"tip": hurcules.Twist(tip, 0.5)}, control=control)
        tip = simulation.controller.task("tip")
        middle = tip.target - [radius, 0.0]
        off = 0.0
        for tick in range(3000):
            angle = turning * tick * simulation.dt
            out = radius * np.array([np.cos(angle), np.sin(angle)])
            way = turning * np.array([-out[1], out[0]])
            tip.set_target(middle + out, way, -(turning**2) * out if told else None)
            simulation.step()
            if tick > 1500:
                off = max(off, float(np.linalg.norm(tip.error)))  # of the reference
        worst.append(off)
    assert worst[1] < 0.1 * worst[0]
    assert worst[0] > 1e-3


SHARED = """
<mujoco>
  <default>
    <joint axis="0 1 0" range="-110 110" armature="0.05"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="1" contype="0" conaffinity="0"/>
  </default>
  <worldbody>
    <body><joint name="a"/><geom/>
      <body pos="0.4 0 0"><joint name="b"/><geom/>
        <body pos="0.4 0 0"><joint name="c"/><geom/><site name="tip" pos="0.4 0 0"/></body>
      </body>
    </body>
  </worldbody>
  <actuator><motor joint="a"/><motor joint="b"/><motor joint="c"/></actuator>
</mujoco>
"""


def test_errors_of_tasks_that_stacks_share_are_in_their_own_columns() -> None:
    model = mujoco.MjModel.from_xml_string(SHARED)
    robot = hurcules.Robot(model)
    robot.set_configuration([0.3, 0.5, 0.4])
    x = hurcules.PositionTask("x", robot, "tip", axes=[[1, 0, 0]])
    z = hurcules.PositionTask("z", robot, "tip", axes=[[0, 0, 1]])
    posture = hurcules.PostureTask("posture", robot)
    stacks = {"one": [[x, z], posture], "other": [[z, x], posture]}
    controller = hurcules.WholeBodyController(robot, stacks=stacks)
    simulation = hurcules.Simulation(model=model, controller=controller)
    controller.use("other")
    x.set_target(x.target + 0.5)  # far: an error along x alone
    simulation.step(5)
    names = ["task_error/x/0", "task_error/z/0"]
    along, up = simulation.read(hurcules.Quantities(simulation, names))
    assert abs(along) > 0.3 and abs(up) < 0.05


def test_drives_with_servos_of_their_own_do_not_lead_the_reference_astray() -> None:
    """Without torque scaling: with it their sag counted as a load (docs/loop.md)."""
    model = mujoco.MjModel.from_xml_string(
        ARM.replace("<motor ", '<position kp="1500" dampratio="1" ')
    )
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=PLANE)
    levels, channels = [tip, hurcules.PostureTask("posture", robot)], twist(tip)
    controller = hurcules.WholeBodyController(robot, levels, channels, torque_scaling=False)
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    start = controller.plan.position("tip")
    for tick in range(3000):
        controller.tick(data.qpos, data.qvel, {"tip": [-0.1, 0.1]} if tick < 500 else None)
        data.ctrl[:3] = controller.q_des
        mujoco.mj_step(model, data)
    assert np.allclose(controller.plan.position("tip") - start, [-0.1, 0.0, 0.1], atol=1e-4)
