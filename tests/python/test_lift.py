"""The operator who lifts the leading legs: at an edge, higher when that does not help, and no more.

Strategy: the law alone, fed with places and times; then a post of two units, which no track climbs
by itself (it is higher than the wheel), in the physics.
"""

from __future__ import annotations

import math

from hurcules import trials
from hurcules.trials.lift import Lift
from hurcules.trials.postures import Posture

STRAIGHT = Posture(math.pi, 0.8)
DT = 0.1


def rises(lift: Lift, places: list[float], start: float = 0.0) -> list[float]:
    """By how much the legs are lifted [rad] at these places, one each DT."""
    found = []
    for i, place in enumerate(places):
        posture = lift(STRAIGHT, place, start + i * DT, ready=True)
        found.append(round(math.pi - posture.knee, 6))
    return found


def test_a_robot_that_goes_on_keeps_its_posture() -> None:
    assert set(rises(Lift(), [0.03 * i for i in range(50)])) == {0.0}


def test_at_an_edge_it_lifts_higher_and_higher_then_begins_again() -> None:
    found = rises(Lift(), 60 * [1.0])
    in_turn = [rise for i, rise in enumerate(found) if i == 0 or rise != found[i - 1]]
    assert in_turn == [0.0, 0.2, 0.4, 0.6, 0.0, 0.2]


def test_behind_the_edge_the_legs_come_down() -> None:
    lift = Lift()
    assert rises(lift, 15 * [1.0])[-1] == 0.2
    found = rises(lift, [1.1, 1.3, 1.5, 1.6, 1.8], start=1.5)
    assert found == [0.2, 0.2, 0.2, 0.0, 0.0]


def test_it_waits_for_legs_that_are_still_moving() -> None:
    lift = Lift()
    postures = [lift(STRAIGHT, 1.0, i * DT, ready=False) for i in range(60)]
    assert all(posture == STRAIGHT for posture in postures)


def test_an_edge_higher_than_the_wheel_is_climbed() -> None:
    # seed 2: a post of 0.2 m at the edge of the field, the wheel's radius is 0.14 m; without a lift
    # the robot stood before it until its time was up
    done = trials.repeat(trials.method("e2828"), 0.1, "rescue", 2)
    assert done.fault == ""
