"""Gears, power and battery from Python; a planned motion that a player follows.

Strategy: balances and numbers of the model; the rest of `Physics`: test_whole_body_tasks.py, and
C++ (tests/cpp/sim).
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, postures
from hurcules_studies.thesis.measures.rig import start
from hurcules_studies.thesis.measures.rover import BELTS, Powered, Rover, flat


@pytest.fixture
def world() -> tuple[mujoco.MjData, hurcules.Plant, Powered]:
    model = models.load("rescue")
    data = mujoco.MjData(model)
    physics = hurcules.Plant(model, data)
    physics.reset("drive")
    physics.brakes.reset(True)
    return data, physics, Powered(model, physics)


def test_shut_brakes_take_only_standby(world) -> None:
    data, physics, powered = world
    before = data.qpos.copy()
    for _ in range(500):
        physics.step()
        powered.read()
    assert np.abs(data.qpos - before)[7:].max() < 2e-3
    assert powered.meter.total == pytest.approx(300.0)  # computers and sensors
    assert powered.energy == pytest.approx(150.0)
    assert powered.work == pytest.approx(0.0, abs=1e-9)


def test_an_open_brake_takes_the_power_of_its_coil(world) -> None:
    data, physics, powered = world
    physics.brakes.set_closed("LSP", False)
    before = float(data.joint("LSP").qpos[0])
    for _ in range(300):
        physics.step()
        powered.read()
    assert powered.meter.total == pytest.approx(312.0)  # a coil of 12 W
    assert abs(float(data.joint("LSP").qpos[0]) - before) > 0.01


def test_a_drive_gives_what_its_gear_allows(world) -> None:
    _, physics, _ = world
    assert physics.ratio(BELTS[0]) == 3.0 and physics.ratio("LSP") == 1.0
    assert physics.effort_range(BELTS[0], 0.0) == pytest.approx((-600.0, 600.0))
    with pytest.raises(hurcules.Error, match="'LSP' has no transmission"):
        physics.effort_range("LSP", 0.0)
    with pytest.raises(hurcules.Error, match=r"'nose'.*LSP"):
        physics.ratio("nose")


def test_a_robot_that_drives_takes_more_than_its_work() -> None:
    rover = Rover(flat())
    rover.controller.drive(1.0)
    rover.run(1.5)
    way, resistance = float(rover.data.qpos[0]), 0.06 * 680.0 * 9.81
    motion = 0.5 * 1.05 * 680.0  # of the robot and, about a twentieth, of its belts
    assert rover.powered.work == pytest.approx(resistance * way + motion, rel=0.15)
    assert rover.powered.energy > rover.powered.work / 0.9 + 1.5 * 300.0


def test_a_battery_is_emptied_by_what_it_gives_and_loses() -> None:
    battery = hurcules.Battery(capacity=1e4, voltage=50.0, resistance=0.1)
    battery.draw(1000.0, 2.0)
    assert battery.energy == pytest.approx(1e4 - 2000.0 - battery.lost)
    assert battery.charge == battery.energy / 1e4 and not battery.empty
    battery.draw(1000.0, 60.0)
    assert battery.empty
    with pytest.raises(hurcules.Error, match="capacity"):
        hurcules.Battery(capacity=0.0)


def test_a_player_follows_a_planned_motion_and_is_watched() -> None:
    model = models.load("rescue")
    data, player = start(model, "rescue", "ready")
    looks: list[float] = []
    player.watch = lambda: looks.append(float(data.time))
    begin = player.reference[player.joints.index("LEB")]
    u = np.linspace(0.0, 1.0, 1500)[:, None]
    q = begin + 0.2 * (u - np.sin(2 * np.pi * u) / (2 * np.pi))
    qd = 0.2 * (1 - np.cos(2 * np.pi * u)) / 1.5
    result = player.follow("bend", ["LEB"], q, qd)
    assert len(looks) == 1500
    assert float(data.joint("LEB").qpos[0]) == pytest.approx(begin + 0.2, abs=7e-3)
    assert result.error["LEB"] < 7e-3 and not result.collisions
    with pytest.raises(hurcules.Error, match="no motor at LWY"):
        player.follow("bend", ["LWY"], q, qd)
    with pytest.raises(hurcules.Error, match=r"\(ticks, 1\) are wanted"):
        player.follow("bend", ["LEB"], q[:, 0], qd)
    with pytest.raises(hurcules.Error, match="no motor at LWY"):
        player.play([postures.move("a", 1.0, LWY=1.0)])
