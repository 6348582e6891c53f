"""The mission `lift` in the physics: a limp person of 75 kg, friction alone, no weld.

Strategy: one whole run with everything nominal, judged by what the person's body does in MuJoCo's
data, beside what the mission says of itself. The approach to a person who lies turned, up to the
first contact, by geometry from MuJoCo's data. Other persons, places and frictions: the success map
of docs/lift.md (benchmarks/lift_sweep.py), which takes an hour.
"""

from __future__ import annotations

import re

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import Error, lift
from hurcules.casualties import contact_limit
from hurcules.legend import reason_words
from hurcules.report import plots


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
def test_the_report_has_the_limits_of_contacts_that_the_mission_judges_by(run) -> None:
    log = run[0].log()
    forces = plots.region_forces(log)
    worst = max(contact / contact_limit(name) for name, (contact, _) in forces.items())
    assert worst == pytest.approx(log["casualty/contact_share"].max(), rel=1e-6)
    carries = max(force for _, force in forces.values())
    assert carries == pytest.approx(log["casualty/support_n"].max(), rel=1e-6)


@pytest.mark.slow
def test_no_commanded_velocity_jumps_between_phases(run) -> None:
    simulation, _ = run
    log = simulation.log()
    assert log["phase"][-1] == simulation.phases.index("rest")
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


def seen_from_above(simulation: hurcules.Simulation) -> tuple[np.ndarray, ...]:
    """The person's centre and the robot's [m]; its direction; the body, pelvis to chest [m]."""
    model = simulation.model
    data = mujoco.MjData(model)
    data.qpos[:] = simulation.data.qpos
    mujoco.mj_forward(model, data)
    person, robot = (
        data.subtree_com[model.body_rootid[model.body(name).id], :2]
        for name in ("casualty_pelvis", "lower_leg_L")
    )
    heel, toe = (data.geom(f"L_lower_{end}").xpos[:2] for end in ("heel", "toe"))
    body = data.body("casualty_thorax").xpos - data.body("casualty_pelvis").xpos
    return person, robot, (toe - heel) / np.linalg.norm(toe - heel), body[:2]


@pytest.mark.parametrize(("yaw", "offset"), [(0.30, (0.10, -0.15)), (-0.2, (0.0, 0.1))])
def test_the_stand_is_square_before_the_person(yaw: float, offset: tuple[float, float]) -> None:
    simulation = hurcules.Simulation(
        "lift", variation=0.0, parameters={"yaw": yaw, "offset": offset}
    )
    simulation.step(20)
    person, robot, ahead, _ = seen_from_above(simulation)
    off = lift.mission().setup.stand_off
    to_stand = person - off * np.array([np.cos(yaw), np.sin(yaw)]) - robot
    bearing = np.arctan2(ahead[0] * to_stand[1] - ahead[1] * to_stand[0], ahead @ to_stand)
    log = simulation.log()
    assert log["casualty/stand_rad"][-1] == pytest.approx(bearing, abs=0.02)
    assert log["casualty/stand_ahead_m"][-1] == pytest.approx(ahead @ to_stand, abs=0.01)
    assert log["casualty/heading_rad"][-1] == pytest.approx(yaw, abs=0.02)


@pytest.mark.slow
def test_a_person_who_lies_turned_lies_square_before_he_is_touched() -> None:
    simulation = hurcules.Simulation(
        "lift", variation=0.0, parameters={"yaw": 0.30, "offset": (-0.10, -0.15)}
    )
    lay = seen_from_above(simulation)[0]
    while simulation.phase != "press":
        assert not simulation.finished, simulation.reason
        simulation.step(20)
    person, robot, ahead, body = seen_from_above(simulation)
    way = person - robot
    assert np.linalg.norm(person - lay) < 0.005  # not touched
    assert abs(ahead @ body) / np.linalg.norm(body) < 0.06
    assert abs(ahead[0] * way[1] - ahead[1] * way[0]) < 0.06  # the way goes to his centre
    assert ahead @ way == pytest.approx(lift.mission().setup.stand_off, abs=0.04)


@pytest.mark.parametrize(
    "placed, back, found",
    [
        ({"yaw": 1.5}, 0.8, "this far from square across the way 1.50 rad, wanted is at most 0.34"),
        ({"yaw": -0.4}, 0.8, "across the way -0.40 rad, wanted is at least -0.34 rad"),
        ({"offset": (-1.3, 0.0)}, 0.0, "ahead by -0.30 m, wanted is at least 0.5 m"),
    ],
)
def test_from_who_lies_badly_it_steps_back_says_what_it_found_and_asks(
    placed: dict[str, object], back: float, found: str
) -> None:
    simulation = hurcules.Simulation("lift", variation=0.0, parameters=placed, record=False)
    began = simulation.data.body("pelvis").xpos[0]
    while not simulation.question and simulation.time < 10.0:
        simulation.step(50)
    assert found in reason_words(simulation.question)
    assert began - simulation.data.body("pelvis").xpos[0] == pytest.approx(back, abs=0.25)
    simulation.answer(True)  # looks again, and asks again: a yes is no push
    simulation.step(600)
    assert simulation.phase == "see him"
    assert simulation.question
    simulation.answer(False)
    simulation.step(2)
    assert simulation.finished
    assert found in reason_words(simulation.reason)


def test_from_who_lies_too_near_it_steps_back_and_goes_on() -> None:
    simulation = hurcules.Simulation(
        "lift", variation=0.0, parameters={"offset": (-0.8, 0.0)}, record=False
    )
    stands = hurcules.Quantities(simulation, ["casualty/stand_ahead_m"])
    while simulation.phase in ("settle", "step back") and simulation.time < 6.0:
        simulation.step(50)
    assert simulation.phase == "approach"
    assert float(simulation.read(stands)[0]) > 0.4


def test_an_arm_in_the_way_of_the_tips_is_asked_about_and_not_run_over() -> None:
    lies = {"pose": "back", "arms": "out"}
    simulation = hurcules.Simulation("lift", variation=0.0, parameters=lies, record=False)
    found = r"left hand lies away from the hips by (0\.8\d) m, wanted is at most 0.6 m"
    for _ in range(3):  # a yes looks again, and is no push
        simulation.step(2100)
        assert simulation.phase == "see him"
        told = re.search(found, reason_words(simulation.question))
        assert told and float(told[1]) == pytest.approx(0.87, abs=0.015)  # he settles
        simulation.answer(True)
    simulation.step(600)
    assert simulation.finished
    assert re.search(found, reason_words(simulation.reason))
    assert simulation.figures()["contact_share"] == 0.0


def test_arms_over_the_belly_or_at_the_sides_are_in_nobodys_way() -> None:
    for arms in ("sides", "folded"):
        simulation = hurcules.Simulation(
            "lift", variation=0.0, parameters={"mass": 120, "arms": arms}, record=False
        )
        simulation.step(1600)
        assert simulation.phase not in ("settle", "step back", "see him")


@pytest.mark.parametrize("pose, after", [("front", "let down"), ("back", "lower")])
def test_who_lies_on_the_front_is_laid_down_in_a_way_of_his_own(pose: str, after: str) -> None:
    simulation = hurcules.Simulation("lift", variation=0.0, parameters={"pose": pose}, record=False)
    simulation.step(1)
    simulation.go("lower")
    simulation.step(2)
    assert simulation.phase == after
    names = simulation.phases
    assert tuple(names[names.index("rest") + 1 :]) == lift.ON_THE_FRONT
    rows = {row.name: row for row in lift.mission().rows.phases}
    assert rows["rest"].last
    assert rows[lift.ON_THE_FRONT[-1]].next == "withdraw"


@pytest.mark.slow
def test_the_face_of_who_lay_on_the_right_side_is_not_pressed_as_he_is_laid_down() -> None:
    simulation = hurcules.Simulation("lift", variation=0.0, parameters={"pose": "right"})
    while not simulation.finished:
        simulation.step(20)
        if simulation.question and simulation.phase == "settle":
            simulation.answer(True)
    assert simulation.success, simulation.reason
    log = simulation.log()
    down = np.maximum.accumulate(log["phase"] == simulation.phases.index("let down"))
    assert down.sum() * simulation.dt > 45.0  # all of it
    assert log["casualty/force/face"][down].max() <= contact_limit("face")
    assert log["casualty/face_up"][down].max() < -0.5  # on his front still


def test_a_stand_off_below_zero_is_told() -> None:
    wrong = lift.mission()
    wrong.setup.stand_off = -1.0
    model = lift.model(lift.Person())
    with pytest.raises(Error, match="stand-off >= 0"):
        hurcules.Simulation(model=model, controller=lift.controller(model), mission=wrong)


def test_a_person_that_there_is_not_is_told() -> None:
    with pytest.raises(Error, match="no parameter 'weight'; there are: mass, offset"):
        lift.person({"weight": 75})
    with pytest.raises(Error, match="offset wants two numbers"):
        lift.person({"offset": (0.1,)})
    with pytest.raises(Error, match="mass"):
        lift.model(lift.Person(mass=60))
    with pytest.raises(Error, match="arms wants one of sides, out, folded, got 'up'"):
        lift.model(lift.Person(arms="up"))
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
        "front",
        "--arms=out",
    ]
    assert lift.parameters_of(words) == {
        "mass": 90,
        "offset": (0.05, -0.1),
        "yaw": 0.2,
        "friction": 0.6,
        "pose": "front",
        "arms": "out",
    }
    assert lift.parameters_of(["--mass", "90.0"]) == {"mass": 90}
    with pytest.raises(Error, match=r"got '90\.5'"):
        lift.parameters_of(["--mass", "90.5"])
    with pytest.raises(Error, match="no such option: --weight"):
        lift.parameters_of(["--weight", "75"])
    with pytest.raises(Error, match="--mass: wanted a whole number, got 'heavy'"):
        lift.parameters_of(["--mass", "heavy"])
