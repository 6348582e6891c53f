"""Sensors and monitors from Python: options reach the loop, readings and figures come back.

What each of them does is tested in tests/cpp/sim; here are the wall, the typical sensors, and
what a run says of a lost encoder.
"""

import json
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from rich.console import Console

import hurcules
from hurcules import (
    FaultKind,
    MonitorOptions,
    RangeFinder,
    SensorFault,
    SensorModel,
    SensorOptions,
    Simulation,
)
from hurcules import run as runs
from hurcules.run import FAILED, RunOptions, run


@pytest.fixture(scope="module")
def realistic() -> Simulation:
    simulation = Simulation(seed=2, sensors=hurcules.sensors.realistic(), record=True)
    simulation.step(60)
    return simulation


def test_every_typical_model_is_of_a_sensor_that_exists(realistic: Simulation) -> None:
    assert set(hurcules.sensors.realistic().models) == set(realistic.sensor_entries())


def test_another_robot_gets_those_that_it_has() -> None:
    # "site 'lidar' does not exist", then "sensor 'imu_acceleration' does not exist"
    model = mujoco.MjModel.from_xml_string(
        """<mujoco><worldbody><body><joint name="hinge" axis="0 1 0"/>
        <geom type="capsule" fromto="0 0 0 0.3 0 0" size="0.02" mass="1"/></body></worldbody>
        <actuator><motor joint="hinge" forcerange="-20 20"/></actuator></mujoco>"""
    )
    robot = hurcules.Robot(model)
    controller = hurcules.WholeBodyController(robot, [hurcules.PostureTask("posture", robot)])
    options = hurcules.sensors.realistic(robot)
    simulation = Simulation(model=model, controller=controller, sensors=options, record=False)
    simulation.step(10)
    assert set(options.models) == set(simulation.sensor_entries())
    assert "encoder_position" in options.models and "imu_rate" not in options.models
    whole = hurcules.Robot(hurcules.models.load("rescue", "flat"))
    assert set(hurcules.sensors.realistic(whole).models) == set(hurcules.sensors.realistic().models)


def test_readings_have_the_entries_that_are_named(realistic: Simulation) -> None:
    readings, entries = realistic.sensors(), realistic.sensor_entries()
    assert set(readings) == set(entries) | {"range"}
    for name, (unit, names) in entries.items():
        assert unit
        assert readings[name].shape == (len(names),)
    assert readings["range"].shape == realistic.ray_angles().shape == (361,)


def test_readings_differ_from_the_truth_by_about_their_noise(realistic: Simulation) -> None:
    names = realistic.sensor_entries()["encoder_position"][1]
    truth = [realistic.data.joint(name).qpos[0] for name in names]
    error = np.abs(realistic.sensors()["encoder_position"] - truth)
    assert 0 < np.max(error) < 1e-3  # 19 bits are 12 urad; a tick of delay at some mrad/s


def test_without_sensors_the_readings_are_the_physics() -> None:
    simulation = Simulation(record=False)
    simulation.step(30)
    names = simulation.sensor_entries()["encoder_speed"][1]
    truth = [simulation.data.joint(name).qvel[0] for name in names]
    assert simulation.sensors()["encoder_speed"].tolist() == truth
    assert "range" not in simulation.sensors()
    assert simulation.ray_angles().size == 0


def test_the_scanner_sees_the_ground_ahead_where_the_head_looks_at_it() -> None:
    options = SensorOptions(range=RangeFinder(rays=91, angle=1.0, period=5))
    simulation = Simulation(record=False, sensors=options)
    simulation.step(10)
    scan, angles = simulation.sensors()["range"], simulation.ray_angles()
    site = simulation.data.site("lidar")
    x, y = site.xmat.reshape(3, 3)[:, 0], site.xmat.reshape(3, 3)[:, 1]
    hit = np.isfinite(scan)
    assert np.any(hit)
    heights = [
        site.xpos[2] + r * (np.cos(a) * x + np.sin(a) * y)[2]
        for r, a in zip(scan[hit], angles[hit], strict=True)
    ]
    # on the ground, or on the person who lies there: at most 0.3 m above it
    assert min(heights) > -0.02 and max(heights) < 0.35


def test_the_log_holds_what_is_not_ideal_and_only_that() -> None:
    options = SensorOptions(models={"imu_rate": SensorModel(noise=0.1)})
    simulation = Simulation(sensors=options)
    simulation.step(5)
    names = {name for name in simulation.channels if name.startswith("sensor/")}
    assert names == {f"sensor/imu_rate/{axis}" for axis in "xyz"}
    assert not [name for name in Simulation().channels if name.startswith("sensor/")]


@pytest.mark.parametrize(
    ("options", "text"),
    [
        (lambda: SensorOptions(models={"gps": SensorModel()}), "sensor 'gps' does not exist; the"),
        (lambda: SensorOptions(models={"load": SensorModel(noise=-1)}), "noise wants a number >="),
        (lambda: SensorOptions(models={"load": SensorModel(bias=np.nan)}), "bias wants a number"),
        (lambda: SensorOptions(models={"load": SensorModel(delay=-1)}), "delay wants 0 to 1000"),
        (lambda: SensorOptions(models={"load": SensorModel(delay=2000)}), "2000 came"),
        (lambda: SensorOptions(range=RangeFinder(rays=3, site="eye")), "site 'eye' does not exist"),
        (lambda: SensorOptions(range=RangeFinder(rays=-3)), "rays wants 0 to 100000, -3 came"),
        (lambda: SensorOptions(faults=[SensorFault("load/x")]), "entry of sensor 'load', 'x' does"),
    ],
)
def test_what_cannot_be_is_refused(options: Any, text: str) -> None:
    with pytest.raises(hurcules.Error, match=text):
        Simulation(sensors=options())


def test_monitors_are_figures_and_channels() -> None:
    simulation = Simulation(monitors=MonitorOptions(min_margin=5.0))
    simulation.step(50)
    seen, figures = simulation.monitors(), simulation.figures()
    assert set(seen) <= set(figures)
    assert 0 < figures["static_margin_m"] <= seen["static_margin_m"] < 1
    log = simulation.log()
    assert figures["power_W"] == np.max(log["monitor/power_W"])
    assert figures["tip_angle_rad"] == np.min(log["monitor/tip_angle_rad"])
    assert (0.0, "alarm: static_margin_m below 5") in simulation.events()
    assert set(simulation.motor_temperatures()) > {"LKN", "HIP", "L_lower_belt"}
    assert all(25 <= t < 40 for t in simulation.motor_temperatures().values())
    nearest = simulation.nearest_pair()
    assert nearest is None or nearest in simulation.self_collision_pairs()


def test_a_run_that_loses_an_encoder_says_so(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    class Broken(Simulation):
        """Its left elbow loses its encoder after a tenth of a second."""

        def __init__(self, *arguments: Any, **named: Any) -> None:
            fault = SensorFault("encoder_position/LEB", FaultKind.NotANumber, 0.1)
            options = SensorOptions(faults=[fault], hold_seconds=0.2)
            super().__init__(*arguments, **(named | {"sensors": options}))

    monkeypatch.setattr(runs, "Simulation", Broken)
    assert run(RunOptions(out=tmp_path, video=False), Console(quiet=True)) == FAILED
    summary = json.loads((tmp_path / "summary.json").read_text())
    assert summary["reason"] == "held since 0.100 s: encoder_position/LEB is not a number"
    assert summary["simulated_seconds"] == pytest.approx(0.3)
    assert summary["figures"]["static_margin_m"] > 0


def test_typical_sensors_want_a_robot() -> None:
    with pytest.raises(hurcules.Error, match="wants a Robot, or nothing; got 'stretch'"):
        hurcules.sensors.realistic("stretch")  # type: ignore[arg-type]


def side_by_side() -> hurcules.Simulation:
    """Two arms of three joints that stand in the world for themselves, towards each other."""
    link = (
        '<body name="{s}{i}" pos="{x} 0 {z}"><joint name="{s}j{i}" axis="0 1 0" range="-180 180"/>'
        '<geom type="capsule" size="0.03" fromto="0 0 0 0 0 0.3" mass="1"/>'
    )
    arms = "".join(
        "".join(link.format(s=s, i=i, x=x if i == 0 else 0, z=0.3 if i else 0) for i in range(3))
        + "</body>" * 3
        for s, x in (("L", -0.3), ("R", 0.3))
    )
    motors = "".join(f'<motor joint="{s}j{i}"/>' for s in "LR" for i in range(3))
    model = mujoco.MjModel.from_xml_string(
        f"<mujoco><worldbody>{arms}</worldbody><actuator>{motors}</actuator></mujoco>"
    )
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    channels = {"lead": hurcules.Twist(posture, 1.0)}
    controller = hurcules.WholeBodyController(robot, [posture], channels)
    sensors = hurcules.sensors.realistic(robot)
    return hurcules.Simulation(model=model, controller=controller, sensors=sensors)


def test_all_trees_of_a_robot_have_sensors_and_are_watched() -> None:
    simulation = side_by_side()
    joints = [f"{s}j{i}" for s in "LR" for i in range(3)]
    assert simulation.sensor_entries()["encoder_position"] == ("rad", joints)
    pairs = {
        frozenset(geom.split()[-1] for geom in pair) for pair in simulation.self_collision_pairs()
    }
    assert frozenset(("L2", "R2")) in pairs  # both last links
    contacts = hurcules.Quantities(simulation, ["self_contacts"])
    batch = hurcules.SimulationBatch(simulation, 1)
    touched = 0
    for _ in range(60):  # they lean towards each other
        batch.step_and_read(20, contacts, [[1.0, 0.0, 0.0, -1.0, 0.0, 0.0]])
        touched = max(touched, int(batch.read(contacts)[0, 0]))
    assert touched >= 1


def test_windings_warm_by_the_period_of_the_controller() -> None:
    """An arm that is held level for 20 s: the same temperature whatever the period is."""

    def after(period: float) -> float:
        model = mujoco.MjModel.from_xml_string(
            '<mujoco><option timestep="1e-3"/><worldbody><body><joint name="j" axis="0 1 0"/>'
            '<geom type="capsule" fromto="0 0 0 1 0 0" size="0.03" mass="2"/></body></worldbody>'
            '<actuator><motor joint="j" forcerange="-20 20"/></actuator><custom>'
            '<numeric name="velocity_limit_j" data="9"/><numeric name="power_limit_j" data="200"/>'
            "</custom></mujoco>"
        )
        robot = hurcules.Robot(model)
        controller = hurcules.WholeBodyController(
            robot, [hurcules.PostureTask("posture", robot)], dt=period
        )
        simulation = hurcules.Simulation(model=model, controller=controller, record=False)
        simulation.step(round(20.0 / period))
        return simulation.motor_temperatures()["j"]

    slow, fast = after(5e-3), after(1e-3)
    assert fast > 35.0  # from 25
    assert slow - 25.0 == pytest.approx(fast - 25.0, rel=0.01)


@pytest.mark.parametrize("trouble", ["Frozen", "NotANumber"])
def test_a_joint_without_a_brake_does_not_follow_an_encoder_that_is_lost(trouble: str) -> None:
    """Its servo went on with the stuck reading, and drove it into its stop while it was held."""
    plain = side_by_side()
    joint = "Lj1"
    fault = SensorFault(f"encoder_position/{joint}", getattr(FaultKind, trouble), 0.1)
    robot = hurcules.Robot(plain.model)
    posture = hurcules.PostureTask("posture", robot)
    channels = {"lead": hurcules.Twist(posture, 1.0)}
    simulation, twin = (
        hurcules.Simulation(
            model=plain.model,
            controller=hurcules.WholeBodyController(robot, [posture], channels),
            sensors=SensorOptions(faults=[fault]),
        )
        for _ in range(2)
    )
    lead = np.zeros(len(robot.coordinate_names))
    lead[robot.coordinate(joint)] = 1.0
    simulation.step(25, {"lead": lead})
    early = simulation.state()
    simulation.step(2000, {"lead": lead})
    assert "encoder_position/" + joint in simulation.reason
    log = simulation.log()
    held = log["time"] > 0.2
    assert np.abs(log[f"qd/{joint}"][held]).max() < 1.0  # the arm stands upright, and leans slowly
    assert np.abs(simulation.data.joint(joint).qpos[0]) < 0.5
    for one in (simulation, twin):
        one.restore(early)
        one.step(20, {"lead": lead})
    assert np.array_equal(simulation.state(), twin.state())  # its encoder is believed again
