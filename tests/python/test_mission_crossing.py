"""The mission `crossing`: the rescue with a terrain between the start and the person.

Strategy: the ground is measured in the compiled model, by rays from above; the robot drives over
the first of what is in its way in the physics. Whole runs take too long here: docs/casualty.md,
benchmarks/lift_sweep.py.
"""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
import pytest

import hurcules
from hurcules import cli, lift

X = np.arange(-1.95, 10.0, 0.1)  # [m] where the ground is looked at
Y = np.linspace(-2.0, 2.0, 21)


def ground(**parameters: Any) -> np.ndarray:
    """Heights [m] at X, Y."""
    model = lift.model(lift.person(parameters, "crossing"))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    fixed = np.array([1, 0, 0, 0, 0, 0], np.uint8)  # neither robot nor person
    hit, down = np.zeros(1, np.int32), np.array([0.0, 0.0, -1.0])
    rays = [
        mujoco.mj_ray(model, data, np.array([x, y, 3.0]), down, fixed, 1, -1, hit)
        for x in X
        for y in Y
    ]
    return 3.0 - np.array(rays).reshape(len(X), len(Y))


@pytest.mark.parametrize("terrain", ["road", "ramps"])
@pytest.mark.parametrize("way, rise", [(5.0, 0.10), (7.0, 0.20)])
def test_the_ground_is_rough_on_the_way_alone(terrain: str, way: float, rise: float) -> None:
    heights = ground(terrain=terrain, way=way, rise=rise)
    end = lift.NEAR + way
    level = (lift.NEAR > X) | ((end < X) & (end + lift.BEYOND + 2.5 > X))  # up to the person
    assert np.abs(heights[level]).max() < 1e-6
    assert heights.min() > -1e-6
    seen = heights[(lift.NEAR < X) & (end > X)].max()
    assert 0.75 * rise < seen <= rise + 0.01  # of a road the highest point may lie elsewhere
    inside = heights[(lift.NEAR + 0.8 < X) & (end - 0.8 > X)]
    assert np.ptp(inside, axis=0).min() > 0.25 * rise  # along every line of driving


def test_the_person_lies_beyond_it_as_he_does_without() -> None:
    places = []
    for person in (lift.Person(), lift.Away(way=6.0)):
        data = mujoco.MjData(model := lift.model(person))
        mujoco.mj_forward(model, data)
        places.append(data.body("casualty_thorax").xpos.copy())
    assert places[1] - places[0] == pytest.approx([6.0 + lift.NEAR + lift.BEYOND, 0.0, 0.0])


def test_the_ground_is_drawn_by_its_number() -> None:
    one, same, other = ground(), ground(ground=0), ground(ground=1)
    assert np.array_equal(one, same)
    assert np.abs(one - other).max() > 0.01


@pytest.mark.parametrize(
    "words, told",
    [
        (["crossing", "--terrain", "moon"], "terrain wants one of flat, road, ramps, got 'moon'"),
        (["crossing", "--rise", "2"], "rise wants a number from 0.07 to 0.5 m, got 2.0"),
        (["crossing", "--way", "1"], "way wants a number from 2 to 20 m, got 1.0"),
        (["crossing", "--ground", "-1"], "ground wants a whole number >= 0, got -1"),
        (["crossing", "--ground", "1.5"], "--ground: wanted a whole number, got '1.5'"),
        (["casualty", "--terrain", "road"], "no such option: --terrain"),
    ],
)
def test_what_there_is_not_is_refused(
    words: list[str], told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert cli.main(["run", *words, "--seconds", "0.1", "--no-video"]) == 2
    assert told in " ".join(capsys.readouterr().err.split())


@pytest.mark.parametrize("terrain, least", [("road", 0.02), ("ramps", 0.08)])
def test_it_drives_onto_the_terrain_with_its_arms_up(terrain: str, least: float) -> None:
    simulation = hurcules.Simulation(
        "crossing", parameters={"terrain": terrain}, variation=0.0, record=False
    )
    data, highest = simulation.data, 0.0
    while data.body("upper_legs").xpos[0] < lift.NEAR + 1.0 and not simulation.finished:
        simulation.step(50)
        highest = max(highest, float(data.body("upper_legs").xpos[2]))
    assert simulation.phase == "cross", simulation.reason
    level = lift.model(lift.Person()).body("upper_legs").pos[2]
    assert highest > level + least
    tips = [data.site(f"{side}_tcp").xpos for side in "LR"]
    assert min(tip[2] for tip in tips) > 0.3
    assert abs(data.body("upper_legs").xpos[1]) < 0.1


def test_what_carries_the_person_is_watched_as_in_the_rescue_on_the_flat() -> None:
    flat = {row.name: row for row in lift.mission("casualty").rows.phases}
    rows = lift.mission("crossing").rows
    names = [row.name for row in rows.phases]
    assert names[:4] == ["arms up", "cross", "arms down", "settle"]
    assert [name for name in names[3:] if name != "rims up"] == list(flat)
    assert names.index("rims up") == names.index("home") - 1
    own = {row.name: row for row in rows.phases}
    assert [name for name in flat if own[name] != flat[name]] == ["home", "arms low"]
    assert own["arms low"].keys == flat["arms low"].keys  # it goes on to the rims
    watched = {trouble.when.quantity for trouble in own["home"].troubles}
    assert {"casualty/head_mps2", "casualty/on_ground", "base_rotation/y"} <= watched
    measures = {one.name for one in lift.mission("casualty").rows.measures} - {"way_home_m"}
    assert {one.name for one in rows.measures} == measures | {"home_x_m"}
