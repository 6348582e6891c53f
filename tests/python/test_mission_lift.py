"""The mission `lift` in the physics: a limp person of 75 kg, friction alone, no weld.

Strategy: one whole run with everything nominal, judged by what the person's body does in MuJoCo's
data, beside what the mission says of itself. Other persons, places and frictions: the success map
of docs/lift.md (benchmarks/lift_sweep.py), which takes an hour.
"""

from __future__ import annotations

import numpy as np
import pytest

import hurcules
from hurcules import Error, lift


@pytest.fixture(scope="module")
def run() -> tuple[hurcules.Simulation, dict[str, list[np.ndarray]]]:
    """The simulation at its end, and by phase where the person's trunk was."""
    simulation = hurcules.Simulation("lift", variation=0.0)
    places: dict[str, list[np.ndarray]] = {}
    while not simulation.finished:
        simulation.step(100)
        body = simulation.data.body("casualty_thorax").xpos.copy()
        places.setdefault(simulation.phase, []).append(body)
    return simulation, places


@pytest.mark.slow
def test_a_person_is_lifted_held_and_laid_down(run) -> None:
    simulation, places = run
    assert simulation.success, simulation.reason
    start, held = places["settle"][-1], np.array(places["hold"])
    assert len(held) >= 99  # 10 s
    assert held[:, 2].min() > start[2] + 0.8
    assert np.ptp(held[:, 2]) < 0.03
    # he lies again, on his back or on a side, and nothing of the robot touches him
    assert places["rest"][-1][2] < 0.2
    model, data = simulation.model, simulation.data
    pairs = [{model.geom(geom).name for geom in contact.geom} for contact in data.contact]
    his = {name for pair in pairs for name in pair if name.startswith("casualty_")}
    assert his
    assert set().union(*(pair for pair in pairs if pair & his)) - his == {"floor"}


@pytest.mark.slow
def test_no_commanded_velocity_jumps_between_phases(run) -> None:
    simulation, _ = run
    log = simulation.log()
    assert log["phase"][-1] == len(simulation.phases) - 1
    most = 20.0 * simulation.dt  # [rad/s] one tick of the acceleration limit
    for channel, values in log.items():
        if channel.startswith("qd_des/"):
            assert np.abs(np.diff(values)).max() <= most + 1e-9, channel


@pytest.mark.slow
def test_the_robot_stays_on_its_tracks_and_within_its_limits(run) -> None:
    simulation, _ = run
    assert simulation.limit_violation()["commanded"]["position_rad"] == 0.0
    assert simulation.figures()["static_margin_m"] > 0.05
    assert simulation.figures()["push_N"] < 500.0


def test_a_person_that_there_is_not_is_told() -> None:
    with pytest.raises(Error, match="no parameter 'weight'; there are: mass, offset"):
        lift.person({"weight": 75})
    with pytest.raises(Error, match="offset wants two numbers"):
        lift.person({"offset": (0.1,)})
    with pytest.raises(Error, match="mass"):
        lift.model(lift.Person(mass=60))
    with pytest.raises(Error, match="takes no parameters"):
        hurcules.Simulation("stretch", parameters={"mass": 75})


def test_the_command_line_names_the_person() -> None:
    words = [
        "--mass",
        "90",
        "--offset=0.05,-0.1",
        "--yaw",
        "0.2",
        "--friction",
        "0.6",
        "--pose",
        "left",
    ]
    assert lift.parameters_of(words) == {
        "mass": 90,
        "offset": (0.05, -0.1),
        "yaw": 0.2,
        "friction": 0.6,
        "pose": "left",
    }
    with pytest.raises(Error, match="no such option: --weight"):
        lift.parameters_of(["--weight", "75"])
    with pytest.raises(Error, match="--mass: cannot read 'heavy'"):
        lift.parameters_of(["--mass", "heavy"])
