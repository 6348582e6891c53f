"""A phase that parks: the robot's tracks in the physics, on flat ground, beside a case.

Strategy: a table of two phases, to a pose that counts from the case and back to where the run
began; judged by what MuJoCo's data say of the robot. A run that goes on from a snapshot ends with
the same bits. What cannot be reached is told, what makes no sense is refused. How it parks is
tests/cpp/control/parking_test.cpp's matter.
"""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

import hurcules
from hurcules import Error, Mission, disposal

ROWS = """
[mission]
name = "park"

[[phase]]
name = "there"
stack = "joints"
park = { body = "ordnance_case", ahead = -2.4, left = 0.3, heading = 0.3 }
within = 60.0
late = ["abort"]

[[phase]]
name = "back"
stack = "joints"
park = { speed = 0.4 }
within = 60.0
late = ["abort"]
"""
YAW = 0.2  # [rad] of the case


def loop(text: str = ROWS) -> hurcules.Simulation:
    model = disposal.model(disposal.Job(yaw=YAW))
    mission = Mission.read(tomllib.loads(text))
    controller = disposal.controller(model)
    return hurcules.Simulation(
        mission, model=model, controller=controller, variation=0.0, record=False
    )


def pose(simulation: hurcules.Simulation) -> np.ndarray:
    """Of the robot on the ground: its centre of mass [m], its heading [rad]."""
    body = simulation.data.body("upper_legs")
    ahead = body.xmat.reshape(3, 3)[:, 0]
    return np.array([*body.subtree_com[:2], np.arctan2(ahead[1], ahead[0])])


def drive(simulation: hurcules.Simulation, phase: str) -> None:
    """Until the phase is over."""
    while simulation.phase == phase and not simulation.finished:
        simulation.step(20)


@pytest.fixture(scope="module")
def run() -> tuple[hurcules.Simulation, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """The simulation at its end; poses at the start and between both phases, two states.

    The states are those on the way and at the end.
    """
    simulation = loop()
    simulation.step(1)
    begin = pose(simulation)
    simulation.step(4000)
    middle = simulation.state()
    drive(simulation, "there")
    there = pose(simulation)
    drive(simulation, "back")
    return simulation, begin, there, middle, simulation.state()


def test_it_parks_where_the_body_is(run) -> None:
    simulation, _, there, _, _ = run
    case = simulation.data.body("ordnance_case").xpos[:2]
    turn = np.array([[np.cos(YAW), -np.sin(YAW)], [np.sin(YAW), np.cos(YAW)]])
    assert there[:2] == pytest.approx(case + turn @ [-2.4, 0.3], abs=0.03)
    assert there[2] == pytest.approx(YAW + 0.3, abs=0.03)


def test_it_comes_back_to_its_start_and_stands(run) -> None:
    simulation, begin, there, _, _ = run
    assert simulation.success, simulation.reason
    assert np.linalg.norm(there[:2] - begin[:2]) > 0.3
    assert pose(simulation) == pytest.approx(begin, abs=0.03)
    assert simulation.controller.drive.braked


def test_it_goes_on_from_a_snapshot_with_the_same_bits(run) -> None:
    _, _, _, middle, end = run
    copy = loop()
    copy.restore(middle)
    drive(copy, "there")
    drive(copy, "back")
    assert (copy.state() == end).all()


def test_a_place_that_is_not_reached_is_as_good_as_late() -> None:
    simulation = loop(ROWS.replace("within = 60.0", "within = 1000.0"))
    simulation.model.geom_friction[:, 0] = 1e-4  # ice: it does not move
    simulation.step(60_000)
    assert simulation.finished
    assert simulation.reason == "phase 'there': took too long"


def test_it_is_saved_printed_and_drawn() -> None:
    mission = Mission.read(tomllib.loads(ROWS))
    assert Mission.read(tomllib.loads(mission.toml())) == mission
    assert "parks at -2.4 0.3, heading 0.3, from ordnance_case" in mission.table()
    assert "parks at 0 0, heading 0, from its start" in mission.table()
    assert "joints, parks by ordnance_case" in mission.drawing()


@pytest.mark.parametrize(
    "old, new, wanted",
    [
        ('"ordnance_case"', '"wardrobe"', "body 'wardrobe' does not exist; there are: "),
        ("within = 60.0\n", "", "it wants `within`"),
        ("left = 0.3", "left = inf", "a pose to park at wants finite numbers"),
        ("left = 0.3", "speed = 0.0", "wants a speed and a yaw rate above 0, 0 came"),
        ("left = 0.3", "beside = 0.3", "beside"),
        ("within", "lead.drive = { rate = [0.1, 0.0] }\nwithin", "drives the tracks elsewhere"),
    ],
)
def test_a_mistake_is_told_with_its_row(old: str, new: str, wanted: str) -> None:
    with pytest.raises(Error, match="phase 'there'") as raised:
        loop(ROWS.replace(old, new, 1))
    assert wanted in str(raised.value)


def test_a_robot_without_tracks_parks_nowhere() -> None:
    model = disposal.model(disposal.Job())
    robot = hurcules.Robot(model)
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(robot, [posture], {})
    with pytest.raises(Error, match="phase 'there': parking wants a channel"):
        hurcules.Simulation(Mission.read(tomllib.loads(ROWS)), model=model, controller=controller)
