"""A loop of one's own: `WholeBodyController.tick`, without a Simulation.

Strategy: the planar arm of test_whole_body_loop.py, stepped by MuJoCo itself; the same bits as the
simulation is what says that nothing is left out. Then what is refused.
"""

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
