"""A loop of one's own: `WholeBodyController.tick`, without a Simulation.

Strategy: the planar arm of test_whole_body_loop.py, stepped by MuJoCo itself; the same bits as the
simulation is what says that nothing is left out. Then what is refused.
"""

import threading
import time
from collections.abc import Callable
from pathlib import Path

import gymnasium
import mujoco
import numpy as np
import pytest

import hurcules
from test_whole_body_loop import ARM, PLANE, START, twist


def own_loop(**options: object) -> tuple[hurcules.WholeBodyController, mujoco.MjData]:
    """The arm at its start and its controller."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=PLANE)
    posture = hurcules.PostureTask("posture", robot)
    channels = twist(tip) | {"delta": hurcules.Delta(posture, 0.5)}
    controller = hurcules.WholeBodyController(robot, [tip, posture], channels, **options)
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    return controller, data


@pytest.mark.parametrize("law", ["velocity", "acceleration", "torque"])
@pytest.mark.parametrize("base", ["held", "sensed"])
def test_it_has_the_bits_of_a_simulation(law: str, base: str) -> None:
    controller, data = own_loop(control=law, base=base)
    other, start = own_loop(control=law, base=base)
    simulation = hurcules.Simulation(model=start.model, controller=other)
    for command in ({"tip": [-0.2, 0.1], "finger": [0.05]}, {"delta": [0.1, 0.0, 0.2]}, None):
        for tick in range(100):
            data.ctrl[:] = controller.tick(data.qpos, data.qvel, command, first=tick == 0)
            mujoco.mj_step(data.model, data)
        simulation.step(100, command)
        assert np.array_equal(data.qpos, simulation.data.qpos)
        assert np.array_equal(data.ctrl, simulation.data.ctrl)
    assert controller.state() == other.state()


def test_it_goes_on_from_a_state_and_starts_anew() -> None:
    controller, data = own_loop()
    again, _ = own_loop()
    controller.tick(data.qpos, data.qvel, {"tip": [0.1, 0.0]})
    again.restore(controller.state())
    mujoco.mj_step(data.model, data)
    one, other = (each.tick(data.qpos, data.qvel) for each in (controller, again))
    assert np.array_equal(one, other)
    elsewhere = data.qpos + 0.4
    controller.reset(elsewhere)
    assert controller.q_des == pytest.approx(elsewhere[:3])
    controller.tick(elsewhere, 0.0 * data.qvel)


def test_a_force_task_reads_the_sensors_that_it_is_given() -> None:
    model = mujoco.MjModel.from_xml_string(
        ARM.replace("<actuator>", "<sensor><force name='push' site='tip'/></sensor><actuator>")
    )
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    gains = hurcules.ForceGains(dt=model.opt.timestep)
    force = hurcules.ForceTask("force", robot, "tip", axis=[1.0, 0.0, 0.0], gains=gains)
    controller = hurcules.WholeBodyController(robot, [force, hurcules.PostureTask("p", robot)])
    controller.sense(force, "push", 0)
    with pytest.raises(hurcules.Error, match="no sensors came"):
        controller.tick(robot.qpos, np.zeros(4))
    with pytest.raises(hurcules.Error, match="sensordata wants 3 numbers, 1 came"):
        controller.tick(robot.qpos, np.zeros(4), sensors=[1.0])
    controller.tick(robot.qpos, np.zeros(4), sensors=[12.0, 0.0, 0.0])
    assert force.force == pytest.approx(12.0)


Tick = Callable[[hurcules.WholeBodyController, mujoco.MjData], object]
REFUSED: dict[str, tuple[Tick, str]] = {
    "qpos": (lambda c, d: c.tick(d.qpos[:2], d.qvel), "qpos wants 4 numbers, 2 came"),
    "qvel": (lambda c, d: c.tick(d.qpos, [0.0, np.nan, 0.0, 0.0]), "qvel.*number 1 is nan"),
    "text": (lambda c, d: c.tick("here", d.qvel), "qpos wants real numbers"),  # type: ignore[arg-type]
    "channel": (lambda c, d: c.tick(d.qpos, d.qvel, {"hand": [0.0]}), "channel 'hand'"),
    "command": (lambda c, d: c.tick(d.qpos, d.qvel, [0.0]), r"wanted shape \(6,\), got \(1,\)"),
    "elsewhere": (lambda c, d: c.tick(d.qpos + 0.1, d.qvel), r"'j1' is at 0.4.*reset\(qpos\)"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_cannot_be_is_refused_and_changes_nothing(case: str) -> None:
    controller, data = own_loop()
    before = controller.state()
    tick, text = REFUSED[case]
    with pytest.raises(hurcules.Error, match=text):
        tick(controller, data)
    assert controller.state() == before


LENGTHS, MASSES = (0.15, 0.15, 0.2, 0.2, 0.15, 0.1, 0.08), (3, 3, 2.5, 2.5, 1.5, 1, 0.5)
ARM_7 = "".join(
    f'<body pos="0 0 {LENGTHS[i - 1] if i else 0.8}"><joint name="j{i}" damping="1" armature="0.1"'
    f' axis="{"0 1 0" if i % 2 else "0 0 1"}" range="{"-2 2" if i % 2 else "-2.9 2.9"}"/>'
    f'<geom type="capsule" size="0.035" fromto="0 0 0 0 0 {length}" mass="{MASSES[i]}"/>'
    for i, length in enumerate(LENGTHS)
)
MOTORS = "".join(
    f'<motor joint="j{i}" ctrlrange="-{most} {most}" forcerange="-{most} {most}"/>'
    for i, most in enumerate([150, 150, 100, 100, 40, 40, 20])
)


@pytest.mark.parametrize(("angle", "speed"), [(0.14, 0.0), (0.0, 10.0), (0.0, 100.0)])
def test_a_reading_that_was_wrong_once_dies_away(angle: float, speed: float) -> None:
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><compiler angle='radian'/><option timestep='0.001' integrator='implicitfast'/>"
        f"<worldbody>{ARM_7}<site name='hand' pos='0 0 0.08'/>{'</body>' * 7}</worldbody>"
        f"<actuator>{MOTORS}</actuator></mujoco>"
    )
    robot = hurcules.Robot(model)
    robot.set_configuration([0.0, 0.6, 0.0, 1.2, 0.0, 0.6, 0.0])
    hand = hurcules.PositionTask("hand", robot, "hand")
    tasks = [hand, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, tasks, {"hand": hurcules.Twist(hand, 0.3)})
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    steps = []
    for tick in range(8000):
        before = controller.qd_des if tick else np.zeros(7)
        wrong = tick == 700
        data.ctrl[:] = controller.tick(data.qpos + angle * wrong, data.qvel + speed * wrong)
        steps.append(np.abs(controller.qd_des - before).max())
        mujoco.mj_step(model, data)
    assert max(steps[7500:]) < 1e-4  # [rad/s] from tick to tick; it was 21, for good
    assert np.abs(data.qvel).max() < 1e-3


def test_a_state_of_another_length_is_refused() -> None:
    controller, data = own_loop()
    controller.tick(data.qpos, data.qvel)
    for wrong in ([*controller.state(), 0.0], controller.state()[:-1]):
        with pytest.raises(hurcules.Error, match=r"too long|ends early"):
            controller.restore(wrong)


def test_a_joint_that_is_suddenly_elsewhere_is_refused_and_nothing_changes() -> None:
    controller, data = own_loop()
    for _ in range(3):
        controller.tick(data.qpos, data.qvel, {"tip": [0.1, 0.0]})
    state = controller.state()
    for wrong in (np.rad2deg(data.qpos), data.qpos + 0.5):
        with pytest.raises(hurcules.Error, match=r"joint 'j1' is at .*, in the tick before at"):
            controller.tick(wrong, data.qvel, {"tip": [-0.1, 0.0]})
    assert controller.state() == state
    controller.tick(data.qpos + 0.05, data.qvel)
    controller.restore(state)
    controller.tick(data.qpos + 0.5, data.qvel)  # who restores says where it is
    controller.reset(data.qpos)
    controller.tick(data.qpos, data.qvel)


def test_one_wrong_speed_does_not_throw_the_arm() -> None:
    """The tip was off by 0.82 m: the reference followed what was taken for a push, at once."""
    controller, data = own_loop()
    tip = data.model.site("tip").id
    mujoco.mj_forward(data.model, data)
    start, off = data.site_xpos[tip].copy(), 0.0
    for tick in range(1500):
        speed = data.qvel + (20.0 if tick == 500 else 0.0) * (np.arange(4) == 0)
        data.ctrl[:] = controller.tick(data.qpos, speed)
        mujoco.mj_step(data.model, data)
        off = max(off, float(np.linalg.norm(data.site_xpos[tip] - start)))
    assert off < 0.02
    assert np.linalg.norm(data.site_xpos[tip] - start) < 1e-3


def test_the_state_of_another_controller_is_refused() -> None:
    controller, data = own_loop()
    robot = hurcules.Robot(data.model, joints=["j1", "j2", "j3"])
    posture = hurcules.PostureTask("other", robot)
    other = hurcules.WholeBodyController(robot, [posture], {"other": hurcules.Twist(posture, 1.0)})
    before = other.state()
    with pytest.raises(hurcules.Error, match="the state is that of another controller"):
        other.restore(controller.state())
    assert other.state() == before


def test_a_hand_that_a_wall_stops_is_told_of() -> None:
    """Its target gave way to the motors' limits, and all levels were said to be well."""
    wall = '<worldbody><geom type="box" size="0.05" contype="1" fromto="1.06 0 -1 1.06 0 2"/>'
    model = mujoco.MjModel.from_xml_string(ARM.replace("<worldbody>", wall))
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    tip = hurcules.PositionTask("tip", robot, "tip", axes=PLANE)
    controller = hurcules.WholeBodyController(robot, [tip, hurcules.PostureTask("p", robot)])
    simulation = hurcules.Simulation(model=model, controller=controller)
    assert not any(level.shortfalls for level in controller.diagnostics())
    wanted = tip.value + np.array([0.1, 0.0])
    tip.set_target(wanted)
    simulation.step(3000)
    level = next(one for one in controller.diagnostics() if one.level == "tip")
    told = level.shortfalls[-1]
    assert (told.task, told.unit) == ("tip", "m")
    assert told.short_by == pytest.approx(np.linalg.norm(tip.target - wanted), abs=1e-3)
    assert told.short_by > 0.02
    assert any(reason.startswith("torque limit of j") for reason in told.held_by)


def test_a_target_that_gave_way_before_says_so_after_the_motors_have_recovered() -> None:
    arm = Path(gymnasium.__file__).parent / "envs/mujoco/assets/pusher_v5.xml"
    robot = hurcules.Robot(arm)
    hand = hurcules.PositionTask("hand", robot, "tips_arm")
    posture = hurcules.PostureTask("posture", robot)
    channels = {"hand": hurcules.Twist(hand, 0.3)}
    controller = hurcules.WholeBodyController(robot, [hand, posture], channels)
    simulation = hurcules.Simulation(model=arm, controller=controller)
    simulation.step(100, {"hand": [-0.1, 0.1, 0.1]})
    simulation.step(300, {"hand": [0.1, 0.25, 0.2]})
    simulation.step(300)
    told = [one for level in controller.diagnostics() for one in level.shortfalls]
    assert ["a torque limit before"] in [one.held_by for one in told]
    assert all(one.held_by for one in told)


@pytest.mark.parametrize("law", ["velocity", "acceleration", "torque"])
def test_control_is_that_of_stacks_that_do_not_say_it(law: str) -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    states = []
    for told in ("levels", "stack", "itself"):
        posture = hurcules.PostureTask("posture", robot)
        controller = hurcules.WholeBodyController(
            robot,
            [posture] if told == "levels" else None,
            {"posture": hurcules.Twist(posture, 1.0)},
            stacks={"stack": [posture], "itself": ([posture], law)} if told != "levels" else {},
            control=law if told != "itself" else "velocity",
        )
        controller.use("itself" if told == "itself" else "stack")
        for _ in range(20):
            controller.tick(robot.qpos, np.zeros(model.nv), {"posture": [0.3, 0.0, -0.1]})
        states.append(controller.q_des.tolist() + controller.demand.tolist())
    assert states[0] == states[1] == states[2]
    with pytest.raises(hurcules.Error, match="'nonsense' does not exist"):
        hurcules.WholeBodyController(robot, stacks={"a": [posture]}, control="nonsense")


def test_a_state_has_what_was_set_of_its_tasks() -> None:
    controller, data = own_loop()
    tip = controller.task("tip")
    tip.set_gain([3.0, 4.0])
    tip.set_weights([1.0, 0.5])
    tip.set_max_speed(0.2)
    again, _ = own_loop()
    again.restore(controller.state())
    for _ in range(50):
        one, other = (
            each.tick(data.qpos, data.qvel, {"tip": [0.2, -0.3]}) for each in (controller, again)
        )
        assert np.array_equal(one, other)
    assert again.task("tip").max_speed == 0.2
    plain, _ = own_loop()
    plain.restore(again.state())
    assert plain.state() == again.state()
    by_torques, _ = own_loop(control="torque")
    with pytest.raises(hurcules.Error, match="another controller: of other coordinates, tasks, st"):
        by_torques.restore(controller.state())


@pytest.mark.parametrize("first", ["move_joints", "move"])
def test_joints_that_no_stack_moves_any_more_stop_within_the_limit(first: str) -> None:
    limits = hurcules.VelocityControllerOptions(max_acceleration=5.0)
    controller, data = own_loop(velocity=limits)
    for _ in range(300):
        data.ctrl[:] = controller.tick(data.qpos, data.qvel, {"tip": [0.2, 0.1]})
        mujoco.mj_step(data.model, data)
    before = controller.qd_des
    assert np.abs(before).max() > 0.1
    if first == "move_joints":
        controller.move_joints()
    else:
        controller.move("finger", 0.0)
    places = [controller.q_des]
    for _ in range(400):
        data.ctrl[:] = controller.tick(data.qpos, data.qvel)
        mujoco.mj_step(data.model, data)
        places.append(controller.q_des)
    speeds = np.diff([places[0] - before * controller.dt, *places], axis=0) / controller.dt
    assert np.abs(np.diff(speeds, axis=0)).max() <= 5.0 * controller.dt * 1.001
    assert not controller.qd_des.any()
    ran_on = np.abs(places[-1] - places[0]).max()  # v^2 / (2 a)
    assert ran_on == pytest.approx(np.abs(before).max() ** 2 / 10.0, rel=0.05)


def test_a_speed_limit_that_is_lowered_is_braked_for() -> None:
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    limits = hurcules.JointLimits("limits", robot)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot,
        [limits, posture],
        {"posture": hurcules.Twist(posture, 1.0)},
        velocity=hurcules.VelocityControllerOptions(max_acceleration=5.0),
    )
    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    speeds = []
    for tick in range(600):
        if tick == 400:
            limits.set_max_velocities(0.1)
        data.ctrl[:] = controller.tick(data.qpos, data.qvel, {"posture": [-0.8, 0.0, 0.0]})
        mujoco.mj_step(model, data)
        speeds.append(controller.qd_des)
    change = np.abs(np.diff(speeds, axis=0)).max()
    assert np.abs(speeds[399]).max() == pytest.approx(0.8, rel=0.05)
    assert np.abs(speeds[-1]).max() <= 0.1 + 1e-12
    assert change <= 5.0 * controller.dt * 1.001


@pytest.mark.parametrize("what", ["restore", "state", "use", "move_joints", "hold_targets"])
def test_another_thread_may_change_it_between_ticks(what: str) -> None:
    """Each change waits for the tick: with none of them waiting this aborted, or was torn."""
    controller, data = own_loop()
    fresh = controller.state()
    calls: dict[str, Callable[[], object]] = {
        "restore": lambda: controller.restore(fresh),
        "state": controller.state,
        "use": lambda: controller.use("stack"),
        "move_joints": controller.move_joints,
        "hold_targets": controller.hold_targets,
    }
    done, stop = [0], threading.Event()

    def change() -> None:
        while not stop.is_set():
            calls[what]()
            done[0] += 1

    other = threading.Thread(target=change)
    other.start()
    for _ in range(1500):
        assert np.isfinite(controller.tick(data.qpos, data.qvel, {"tip": [0.1, 0.0]})).all()
    stop.set()
    other.join()
    assert done[0] > 0


def test_an_arm_whose_gripper_is_left_out_rests_at_any_period() -> None:
    """Light fingers loosen the arm by nothing; a slow servo let it fall at 10 ms."""
    finger = """<body name="jaw" pos="{x} 0 0.02"><joint name="jaw" type="slide" axis="0 0 1"
      range="0 0.04"/><geom size="0.01" mass="0.02"/></body>"""
    links = ""
    for k in range(3, 0, -1):
        inside = links or finger.format(x=0.3)
        links = f"""<body name="l{k}" pos="{0.0 if k == 1 else 0.3} 0 0">
          <joint name="j{k}" axis="{"0 0 1" if k == 1 else "0 1 0"}" range="-3 3"/>
          <geom type="capsule" size="0.03" fromto="0 0 0 0.3 0 0" mass="2"/>{inside}</body>"""
    motors = "".join(f'<motor joint="{name}"/>' for name in ("j1", "j2", "j3", "jaw"))
    text = f"""<mujoco><compiler angle="radian"/><option timestep="0.001"/>
      <worldbody>{links}</worldbody><actuator>{motors}</actuator></mujoco>"""
    for joints in (None, ["j1", "j2", "j3"]):
        model = mujoco.MjModel.from_xml_string(text)
        robot = hurcules.Robot(model, joints=joints)
        posture = hurcules.PostureTask("posture", robot)
        controller = hurcules.WholeBodyController(robot, [posture], dt=0.01)
        data = mujoco.MjData(model)
        data.qpos[:] = robot.qpos
        data.qvel[0] = 0.05
        for _ in range(400):
            data.ctrl[:] = controller.tick(data.qpos, data.qvel)
            for _ in range(10):
                mujoco.mj_step(model, data)
        assert np.abs(data.qvel).max() < 1e-4
        assert np.abs(controller.joint_error[:3]).max() < 1e-4


def test_a_force_that_is_read_no_more_is_a_lost_sensor() -> None:
    """The driver of the sensor has died: patience is 10 ms; one that reads now and then is not."""
    for reads_on in (True, False):
        model = mujoco.MjModel.from_xml_string(ARM)
        robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
        robot.set_configuration(START)
        press = hurcules.ForceTask("press", robot, "tip", gains=hurcules.ForceGains(dt=0.002))
        posture = hurcules.PostureTask("posture", robot)
        controller = hurcules.WholeBodyController(
            robot, [press, posture], {"press": hurcules.Twist(press, 0.3)}
        )
        data = mujoco.MjData(model)
        data.qpos[:] = robot.qpos
        states = []
        for tick in range(100):
            if tick < 50 or (reads_on and tick % 4 == 0):
                press.sense(controller.plan, 0.0)
            if tick == 52:  # whoever cancels a motion does not make the sensor one that never was
                controller.hold_targets()
            data.ctrl[:] = controller.tick(data.qpos, data.qvel, {"press": [-0.05]})
            mujoco.mj_step(model, data)
            states.append(press.contact)
        lost = hurcules.ContactState.SensorLost
        assert (lost in states) is not reads_on
        if not reads_on:
            assert 54 <= states.index(lost) <= 61


def test_a_task_in_python_is_measured_by_one_thread_at_a_time() -> None:
    """`hold_targets` runs its Python, which gives the lock away: the tick waits all the same."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model, joints=["j1", "j2", "j3"])
    robot.set_configuration(START)
    inside, most = [0], [0]

    def height(at: hurcules.Robot) -> tuple[np.ndarray, np.ndarray]:
        inside[0] += 1
        most[0] = max(most[0], inside[0])
        time.sleep(2e-4)
        inside[0] -= 1
        return at.position("tip")[2:], at.position_jacobian("tip")[2:]

    task = hurcules.CustomTask("height", robot, 1, height)
    controller = hurcules.WholeBodyController(robot, [task])
    stop = threading.Event()

    def hold() -> None:
        while not stop.is_set():
            controller.hold_targets()

    other = threading.Thread(target=hold)
    other.start()
    for _ in range(200):
        controller.tick(robot.qpos, np.zeros(model.nv))
    stop.set()
    other.join()
    assert most[0] == 1
