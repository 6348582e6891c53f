"""The physics from Python: brakes, gears, power, battery; a planned motion that a player follows.

Strategy: balances and numbers of the model; the physics itself is tested in C++ (tests/cpp/sim).
"""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import models, postures
from hurcules.reproduce.measures.rig import start
from hurcules.reproduce.measures.rover import BELTS, Rover, flat


@pytest.fixture
def world() -> tuple[mujoco.MjModel, mujoco.MjData, hurcules.Physics]:
    model = models.load("rescue")
    data = mujoco.MjData(model)
    physics = hurcules.Physics(model, data)
    physics.reset("drive")
    return model, data, physics


def test_shut_brakes_hold_and_take_only_standby(world) -> None:
    _, data, physics = world
    physics.shut_brakes()
    before = data.qpos.copy()
    physics.step(500)
    assert np.abs(data.qpos - before)[7:].max() < 1e-3 and physics.is_sound
    assert physics.power == pytest.approx(300.0)  # computers and sensors
    assert physics.energy == pytest.approx(150.0) and physics.work == pytest.approx(0.0, abs=0.1)
    assert abs(physics.brake_load("LSP")) > 1.0


def test_open_brakes_take_power_and_let_go(world) -> None:
    _, data, physics = world
    physics.shut_brakes()
    physics.set_brake("LSP", False)
    before = float(data.joint("LSP").qpos[0])
    physics.step(300)
    assert physics.power == pytest.approx(312.0)  # a coil of 12 W
    assert abs(float(data.joint("LSP").qpos[0]) - before) > 0.01


def test_a_drive_gives_what_its_gear_allows(world) -> None:
    _, _, physics = world
    assert physics.ratio(BELTS[0]) == 3.0 and physics.ratio("LSP") == 1.0
    low, high = physics.effort_range(BELTS[0], 0.0)
    assert (low, high) == pytest.approx((-600.0, 600.0))
    with pytest.raises(hurcules.Error, match="'LSP' has no transmission"):
        physics.effort_range("LSP", 0.0)


def test_energy_and_work_are_sums_of_the_powers() -> None:
    rover = Rover(flat())
    rover.controller.drive(1.0)
    work = energy = 0.0
    for _ in range(300):
        before = (rover.physics.work, rover.physics.energy)
        rover.period()
        gained = (rover.physics.work - before[0], rover.physics.energy - before[1])
        # two steps a period, of nearly the same power
        assert gained[1] == pytest.approx(2e-3 * rover.physics.power, rel=0.2)
        work, energy = work + gained[0], energy + gained[1]
    assert work == pytest.approx(rover.physics.work)
    assert energy == pytest.approx(rover.physics.energy)
    assert rover.physics.energy > rover.physics.work + 0.6 * 300.0
    rover.physics.reset("drive")
    assert rover.physics.energy == 0.0


def test_a_battery_is_emptied_by_what_it_gives_and_loses() -> None:
    battery = hurcules.Battery(capacity=1e4, voltage=50.0, resistance=0.1)
    battery.draw(1000.0, 2.0)
    assert battery.energy == pytest.approx(1e4 - 2000.0 - battery.lost)
    assert battery.charge == battery.energy / 1e4 and not battery.empty
    battery.draw(1000.0, 60.0)
    assert battery.empty
    with pytest.raises(hurcules.Error, match="capacity"):
        hurcules.Battery(capacity=0.0)


def test_bad_names_and_numbers_are_refused(world) -> None:
    model, _, physics = world
    with pytest.raises(hurcules.Error, match=r"'nose'.*LSP"):
        physics.set_brake("nose", True)
    with pytest.raises(hurcules.Error, match=r"'sleep'.*drive"):
        physics.reset("sleep")
    with pytest.raises(hurcules.Error, match="steps >= 0"):
        physics.step(-1)
    with pytest.raises(hurcules.Error, match="of another one"):
        hurcules.Physics(model, mujoco.MjData(models.load("manipulation")))


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
