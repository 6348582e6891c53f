"""A hand that is sent where it cannot go: the reference yields, no motor is asked for too much.

Strategy: both hands are driven down, into the robot's own tracks, for some seconds, then up again;
the same with a hand that an outside force holds. In free motion nothing yields.
Not tested: where it stops, that depends on the contact.
"""

import mujoco
import numpy as np
import pytest

import hurcules

DT = 1e-3


def command(simulation: hurcules.Simulation, **channels: float) -> np.ndarray:
    """Full scale of some channels, 1 or -1 each."""
    value = np.zeros(len(simulation.command_names))
    for name, share in channels.items():
        value[simulation.command_names.index(name)] = share
    return value * simulation.command_scale


def both(simulation: hurcules.Simulation, share: float) -> np.ndarray:
    return command(simulation, left_hand_z=share, right_hand_z=share)


def coordinates(log: dict[str, np.ndarray], what: str) -> np.ndarray:
    """(ticks, n) of a quantity."""
    return np.stack([series for name, series in log.items() if name.startswith(what + "/")], axis=1)


@pytest.fixture(scope="module")
def pressed() -> tuple[hurcules.Simulation, dict[str, np.ndarray]]:
    """8 s down, then 4 s up."""
    simulation = hurcules.Simulation("stretch", seed=0)
    simulation.step(8000, both(simulation, -1.0))
    simulation.step(4000, both(simulation, 1.0))
    assert not simulation.finished, simulation.reason
    return simulation, simulation.log()


def test_no_motor_is_asked_for_more_than_it_gives(pressed):
    simulation, log = pressed
    assert log["yielding"][4000:8000].mean() > 0.5  # it is blocked indeed
    violation = simulation.limit_violation()
    assert violation["commanded"] == {"position_rad": 0.0, "velocity": 0.0, "torque": 0.0}
    assert violation["torque"] == 0.0
    assert violation["velocity"] == 0.0
    assert violation["position_rad"] < 0.01


def test_no_reference_runs_away_from_the_robot(pressed):
    _, log = pressed
    assert np.abs(coordinates(log, "q_des") - coordinates(log, "q")).max() < 0.05
    assert log["error/hpos"].max() < 0.05  # of 8 s x 43 mm/s


def test_a_hand_that_is_sent_back_comes_at_once_and_without_a_jump(pressed):
    simulation, log = pressed
    back = slice(8000, None)
    assert log["yielding"][9000:].max() == 0.0
    # 20 rad/s^2 is what the controller lets a reference accelerate with
    speed = coordinates(log, "qd_des")[8500:]
    assert np.abs(np.diff(speed, axis=0)).max() <= 20.0 * DT * (1 + 1e-9)
    assert np.abs(coordinates(log, "qd")[back]).max() < 0.5
    raised = simulation.data.site("L_tcp").xpos[2]
    assert log["error/hpos"][-1] < 0.01
    assert raised > 0.1


def test_a_run_is_restored_while_it_yields(pressed):
    a = hurcules.Simulation("stretch", seed=0, record=False)
    b = hurcules.Simulation("stretch", seed=1, record=False)
    a.step(5000, both(a, -1.0))
    b.restore(a.state())
    for simulation in (a, b):
        simulation.step(500, both(a, -1.0))
    np.testing.assert_array_equal(a.state(), b.state())


def test_a_hand_that_somebody_holds_is_let_go_without_a_jump():
    simulation = hurcules.Simulation("stretch", seed=0)
    model, data = simulation.model, simulation.data
    body, site = model.body("L_larm").id, model.site("L_tcp").id
    simulation.step(2500)
    place = data.site_xpos[site].copy()
    forward = command(simulation, left_hand_x=1.0)
    # a spring of 100 kN/m up to 3 kN: 3 s at 43 mm/s would want 13 kN
    for _ in range(3000):
        stretched = place - data.site_xpos[site]
        stiffness = min(1e5, 3e3 / max(np.linalg.norm(stretched), DT))
        data.xfrc_applied[body, :3] = stiffness * stretched
        simulation.step(1, forward)
    held = len(simulation.log()["time"])
    data.xfrc_applied[body] = 0.0
    simulation.step(1500, 0.0 * forward)
    log = simulation.log()
    assert log["yielding"][:held].max() == 1.0
    assert log["error/hpos"].max() < 0.05
    violation = simulation.limit_violation()
    assert violation["commanded"]["torque"] == 0.0
    # the load springs off, no reference that ran ahead is caught up with
    assert violation["velocity"] == 0.0
    assert np.abs(coordinates(log, "qd")[held + 500 :]).max() < 0.05
    assert np.linalg.norm(data.site_xpos[site] - place) < 0.05
    assert not simulation.finished


def test_the_stretch_never_yields():
    simulation = hurcules.Simulation("stretch", seed=0)
    while not simulation.finished:
        simulation.step(1000)
    log = simulation.log()
    assert simulation.success
    assert log["yielding"].max() == 0.0
    # nor does it come near the share of the speed limits that the mission commands
    speed = coordinates(log, "qd_des")
    limits = [_speed_limit(simulation.model, name[3:]) for name in log if name.startswith("qd/")]
    assert (np.abs(speed) / limits).max() < 0.8


def _speed_limit(model: mujoco.MjModel, coordinate: str) -> float:
    joint = "LKN" if coordinate == "KN" else coordinate
    return float(model.numeric(f"velocity_limit_{joint}").data[0])
