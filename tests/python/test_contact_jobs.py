"""What docs say of forces in several directions, and of loads that the model does not have.

Strategy: hands on three slides or on one hinge; forces are those of MuJoCo's contacts, the load
that a servo bears is that of a polynomial's roots.
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from taring import rest_and_tare

AXES = np.eye(3)
SLIDES = "".join(
    f'<joint name="{{0}}{name}" type="slide" axis="{axis}"/>'
    for name, axis in zip("xyz", ("1 0 0", "0 1 0", "0 0 1"), strict=True)
)
HAND = (
    '<body name="{0}" pos="0 {1} 0.3">' + SLIDES + '<geom size="0.02" mass="2" contype="0" '
    'conaffinity="0"/><body><site name="{0}tip"/><geom name="{0}pad" type="box" '
    'size="0.04 0.01 0.04" mass="0.1"/></body></body>'
)


def hands(names: str, places: tuple[float, ...], things: str = "") -> mujoco.MjModel:
    """Hands on slides, each with a force sensor behind its pad."""
    motors = "".join(f'<motor joint="{hand}{axis}"/>' for hand in names for axis in "xyz")
    cells = "".join(f'<force name="{hand}" site="{hand}tip"/>' for hand in names)
    bodies = "".join(HAND.format(hand, place) for hand, place in zip(names, places, strict=True))
    return mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="0.001" cone="elliptic" impratio="10"/><worldbody>'
        f"{bodies}{things}</worldbody><actuator>{motors}</actuator><sensor>{cells}</sensor>"
        "</mujoco>"
    )


def exerted(model: mujoco.MjModel, data: mujoco.MjData, geom: str) -> np.ndarray:
    """(3,) [N] in W of a geom on what it touches."""
    own, total, force = model.geom(geom).id, np.zeros(3), np.zeros(6)
    for i, contact in enumerate(data.contact):
        if own in contact.geom:
            mujoco.mj_contactForce(model, data, i, force)
            on_second = contact.frame.reshape(3, 3).T @ force[:3]
            total += on_second if contact.geom[0] == own else -on_second
    return total


def carried(reference: str) -> tuple[np.ndarray, np.ndarray]:
    """Two hands squeeze a box, lift it, move it aside: squeezes [N], the box's way (3,) [m]."""
    box = (
        '<geom type="box" size="1 1 0.1" pos="0 0 0.099"/><body name="box" pos="0 0 0.3">'
        '<freejoint/><geom type="box" size="0.1 0.1 0.1" mass="2"/></body>'
    )
    model = hands("LR", (0.112, -0.115), box)
    robot = hurcules.Robot(model, [f"{hand}{axis}" for hand in "LR" for axis in "xyz"])
    left = hurcules.PositionTask("left", robot, "Ltip")
    gains = hurcules.ForceGains(compliance=5e-4)
    squeeze = hurcules.ForceTask(
        "squeeze", robot, "Rtip", reference, AXES[1], force_des=40.0, max_rate=20.0, gains=gains
    )
    beside = hurcules.PositionTask("beside", robot, "Rtip", reference, AXES[[0, 2]])
    channels = {
        "left": hurcules.Twist(left, 0.3),
        "beside": hurcules.Twist(beside, 0.3),
        "squeeze": hurcules.Twist(squeeze, 0.3),
    }
    controller = hurcules.WholeBodyController(robot, [squeeze, [left, beside]], channels)
    controller.sense(squeeze, "R")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    closes = {"squeeze": [0.02]}
    simulation.step(2000, closes)
    with_left = {"beside": [0.0, 0.05]} if not reference else {}
    simulation.step(1000, closes | {"left": [0.0, 0.0, 0.05]} | with_left)
    start = simulation.data.body("box").xpos.copy()
    forces = []
    for _ in range(1000):
        simulation.step(1, closes | {"left": [0.0, 0.05, 0.0]})
        forces.append(exerted(model, simulation.data, "Rpad")[1])
    way = simulation.data.body("box").xpos - start
    assert start[2] == pytest.approx(0.35, abs=2e-3)
    return np.array(forces), way


def test_a_squeeze_that_is_told_in_the_other_hand_is_kept_while_both_move() -> None:
    forces, way = carried("Ltip")
    np.testing.assert_allclose(way, [0.0, 0.05, 0.0], atol=1e-3)
    np.testing.assert_allclose(forces, 40.0, atol=4.0)


def test_a_squeeze_that_is_told_in_the_world_stays_behind() -> None:
    forces, way = carried("")  # 40 N by 5e-4 m/s/N are 0.02 m/s of 0.05
    assert forces.min() < 1.0
    assert way[2] < -0.04  # the box fell


@pytest.mark.parametrize("control", ["velocity", "acceleration"])
def test_a_hand_follows_a_pull_at_the_compliance(control: str) -> None:
    model = hands("H", (0.0,))
    robot = hurcules.Robot(model)
    gains = hurcules.ForceGains(compliance=5e-3)
    contact = hurcules.ContactOptions(frozen_move=0.0)  # a pull that stays keeps its bits
    follows = [
        hurcules.ForceTask(
            name, robot, "Htip", axis=axis, force_des=0.0, gains=gains, contact=contact
        )
        for name, axis in zip(["ahead", "left", "up"], AXES, strict=True)
    ]
    controller = hurcules.WholeBodyController(robot, [follows], control=control)
    for task in follows:
        controller.sense(task, "H")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    data = simulation.data
    rest_and_tare(simulation, *follows)
    tool, tip = int(model.site("Htip").bodyid[0]), data.site("Htip")
    data.xfrc_applied[tool, :3] = [15.0, 0.0, -8.0]
    simulation.step(1000)
    start = tip.xpos.copy()
    simulation.step(1000)
    np.testing.assert_allclose(tip.xpos - start, [0.075, 0.0, -0.04], atol=1e-3)
    data.xfrc_applied[:] = 0.0
    simulation.step(500)
    start = tip.xpos.copy()
    simulation.step(1000)
    np.testing.assert_allclose(tip.xpos, start, atol=5e-4)


@pytest.mark.parametrize("control", ["velocity", "acceleration"])
def test_a_surface_that_comes_adds_its_speed_over_the_compliance(control: str) -> None:
    table = '<body name="table" mocap="true"><geom type="box" size="1 1 0.1"/></body>'
    model = hands("H", (0.0,), table)
    robot = hurcules.Robot(model)
    gains = hurcules.ForceGains(compliance=1e-3)
    press = hurcules.ForceTask(
        "press", robot, "Htip", force_des=-20.0, environment=2e3, gains=gains
    )
    beside = hurcules.PositionTask("beside", robot, "Htip", axes=AXES[:2])
    channels = {"press": hurcules.Twist(press, 0.3)}
    controller = hurcules.WholeBodyController(robot, [press, beside], channels, control=control)
    controller.sense(press, "H")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    data = simulation.data
    rest_and_tare(simulation, press)
    simulation.step(6000, {"press": [-0.05]})
    forces = []
    for _ in range(1500):
        data.mocap_pos[0, 2] += 5e-6  # [m] a tick: 5 mm/s
        simulation.step(1, {"press": [-0.05]})
        forces.append(exerted(model, data, "Hpad")[2])
    assert np.mean(forces[:10]) == pytest.approx(-20.0, abs=1.0)
    assert np.mean(forces[-300:]) == pytest.approx(-20.0 - 5e-3 / 1e-3, abs=0.5)


def hole(half: float, chamfer: float) -> str:
    """A square hole about the origin, half as wide as `half` [m], its edge at z = 0."""
    walls = ""
    for axis, turn in (("1 0", "0 {0} 0"), ("0 1", "{1} 0 0")):
        for sign in (1.0, -1.0):
            out = sign * np.array([float(number) for number in axis.split()])
            side = 0.03 * np.abs(out) + 0.06 * (1.0 - np.abs(out))
            x, y = (half + 0.03) * out
            walls += (
                f'<geom type="box" size="{side[0]} {side[1]} 0.03" pos="{x} {y} '
                f'{-0.03 - chamfer}" friction="0.2"/>'
            )
            # its upper face goes up at 45 degrees from the edge of the wall
            x, y = (half + 0.5 * chamfer + 0.02 / np.sqrt(2.0)) * out
            z = -0.5 * chamfer - 0.02 / np.sqrt(2.0)
            length, wide = chamfer / np.sqrt(2.0), 0.5 * half + 0.01
            size = np.where(np.abs(out) > 0.0, length, wide)
            angles = turn.format(-45.0 * sign, 45.0 * sign)
            walls += (
                f'<geom type="box" size="{size[0]} {size[1]} 0.02" pos="{x} {y} {z}" '
                f'euler="{angles}" friction="0.2"/>'
            )
    return walls


def test_a_peg_finds_its_hole_by_two_forces_of_none_and_one_along() -> None:
    model = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="0.001" cone="elliptic" impratio="10"/><worldbody>'
        f'{hole(0.0102, 0.003)}<body pos="0.0015 -0.001 0.03">{SLIDES.format("")}'
        '<geom size="0.02" mass="2" contype="0" conaffinity="0"/><body><site name="tip"/>'
        '<geom name="peg" type="cylinder" size="0.01 0.025" pos="0 0 -0.005" mass="0.1" '
        'friction="0.2"/></body></body></worldbody><actuator><motor joint="x"/>'
        '<motor joint="y"/><motor joint="z"/></actuator><sensor><force name="cell" site="tip"/>'
        "</sensor></mujoco>"
    )
    robot = hurcules.Robot(model)
    gains = hurcules.ForceGains(compliance=2e-4)
    light = hurcules.ContactOptions(f_min=1.0)
    down = hurcules.ForceTask(
        "down", robot, "tip", force_des=-15.0, max_rate=20.0, gains=gains, contact=light
    )
    aside = [
        hurcules.ForceTask(
            name, robot, "tip", "", axis, force_des=0.0, max_rate=20.0, gains=gains, contact=light
        )
        for name, axis in zip("xy", AXES[:2], strict=True)
    ]
    channels = {"down": hurcules.Twist(down, 0.3)}
    controller = hurcules.WholeBodyController(robot, [[down, *aside]], channels)
    for task in (down, *aside):
        controller.sense(task, "cell")
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    rest_and_tare(simulation, down, *aside)
    most = 0.0
    for _ in range(5000):
        simulation.step(1, {"down": [-0.02]})
        most = max(most, float(np.linalg.norm(exerted(model, simulation.data, "peg"))))
    tip = simulation.data.site("tip").xpos
    assert tip[2] < -0.01  # the peg's end is 30 mm lower
    np.testing.assert_allclose(tip[:2], 0.0, atol=3e-4)
    assert most < 40.0


def speeds(load: float, told: bool) -> list[float]:
    """Largest [rad/s] in the second and in the sixth second of a joint that is led and rests.

    Args:
        load: what its inertia is, in those of the model.
        told: the model learns of it after a tenth of a second.
    """
    arm = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="0.001"/><worldbody><body><joint name="j" axis="0 0 1"/>'
        '<geom size="0.1" mass="1" pos="0.3 0 0"/></body></worldbody>'
        '<actuator><motor joint="j"/></actuator></mujoco>'
    )
    robot = hurcules.Robot(arm)
    posture = hurcules.PostureTask("posture", robot)
    channels = {"joint": hurcules.Twist(posture, 1.0)}
    controller = hurcules.WholeBodyController(robot, [posture], channels)
    real = mujoco.MjModel.from_xml_string(
        '<mujoco><option timestep="0.001"/><worldbody><body><joint axis="0 0 1"/>'
        f'<geom size="0.1" mass="{load}" pos="0.3 0 0"/></body></worldbody>'
        '<actuator><motor joint="j"/></actuator></mujoco>'.replace("<joint ", '<joint name="j" ')
    )
    data = mujoco.MjData(real)
    seen = np.zeros(6000)
    for tick in range(6000):
        if told and tick == 100:
            arm.body_mass[1] *= load
            arm.body_inertia[1] *= load
        command = {"joint": [0.3 if tick < 300 else 0.0]}
        data.ctrl[:] = controller.tick(data.qpos, data.qvel, command)
        mujoco.mj_step(real, data)
        seen[tick] = abs(data.qvel[0])
    return [float(seen[1000:2000].max()), float(seen[5000:].max())]


def test_a_servo_bears_nine_times_the_inertia_that_it_knows() -> None:
    early, late = speeds(8.0, told=False)
    assert late < 0.2 * early
    early, late = speeds(10.0, told=False)
    assert late > 2.0 * early


def test_a_load_that_is_told_does_not_swing() -> None:
    assert speeds(12.0, told=True)[1] < 1e-6
