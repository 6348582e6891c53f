"""The operator whose robot gets stuck: lifts its leading legs, then backs off and comes aside.

Strategy: the laws alone, fed with places and times; then, in the physics, a post of two units,
which no track climbs by itself (it is higher than the wheel), and one that held the battery until
the time was up.
"""

from __future__ import annotations

import math

from hurcules_studies import field_tests
from hurcules_studies.field_tests.lift import Lift
from hurcules_studies.field_tests.postures import Posture
from hurcules_studies.field_tests.retreat import ASIDE, BACK, PATIENCE, SIDES, SLANT, Retreat

STRAIGHT = Posture(math.pi, 0.8)
DT = 0.1


def rises(lift: Lift, places: list[float], start: float = 0.0) -> list[float]:
    """By how much the legs are lifted [rad] at these places, one each DT."""
    found = []
    for i, place in enumerate(places):
        posture = lift(STRAIGHT, place, 0.0, start + i * DT, ready=True)
        found.append(round(math.pi - posture.knee, 6))
    return found


def changes(values: list[float]) -> list[float]:
    """The values without those that repeat the one before."""
    return [one for i, one in enumerate(values) if i == 0 or one != values[i - 1]]


def test_a_robot_that_goes_on_keeps_its_posture() -> None:
    lift = Lift()
    assert set(rises(lift, [0.03 * i for i in range(50)])) == {0.0}
    assert not lift.retreat.backs_off and lift.retreat.slant == 0.0


def test_at_an_edge_it_lifts_higher_and_higher_then_lays_down_and_only_then_backs_off() -> None:
    lift = Lift()
    assert changes(rises(lift, 50 * [1.0])) == [0.0, 0.2, 0.4, 0.6, 0.0]
    assert not lift.retreat.backs_off
    rises(lift, 8 * [1.0], start=5.0)
    assert lift.retreat.backs_off


def test_behind_the_edge_the_legs_come_down() -> None:
    lift = Lift()
    assert rises(lift, 15 * [1.0])[-1] == 0.2
    found = rises(lift, [1.1, 1.3, 1.5, 1.6, 1.8], start=1.5)
    assert found == [0.2, 0.2, 0.2, 0.0, 0.0]


def test_it_waits_for_legs_that_are_still_moving() -> None:
    lift = Lift()
    postures = [lift(STRAIGHT, 1.0, 0.0, i * DT, ready=False) for i in range(60)]
    assert all(posture == STRAIGHT for posture in postures)


def test_it_backs_off_so_far_then_looks_to_the_side_until_it_is_there() -> None:
    retreat = Retreat()
    retreat.begin(2.0, time=10.0)
    retreat.go_on(2.01 - BACK, 0.0, time=11.0)
    assert retreat.backs_off and retreat.slant == 0.0
    retreat.go_on(1.99 - BACK, 0.0, time=11.1)
    assert not retreat.backs_off and retreat.slant == SLANT
    retreat.go_on(1.8, ASIDE, time=12.0)
    assert retreat.slant == 0.0
    retreat.go_on(1.8, 2 * ASIDE, time=12.0)
    assert retreat.slant < 0.0
    retreat.forget()
    retreat.go_on(2.6, 0.0, time=13.0)
    assert retreat.slant == 0.0


def test_a_robot_that_cannot_back_off_comes_again_in_time() -> None:
    retreat = Retreat()
    retreat.begin(2.0, time=10.0)
    retreat.go_on(2.0, 0.0, time=10.0 + PATIENCE - DT)
    assert retreat.backs_off
    retreat.go_on(2.0, 0.0, time=10.0 + PATIENCE + DT)
    assert not retreat.backs_off


def test_it_backs_off_to_each_side_and_then_no_more() -> None:
    retreat = Retreat()
    sides = []
    for i in range(len(SIDES)):
        retreat.begin(2.0, 10.0 * i)
        retreat.go_on(1.0, 0.0, 10.0 * i)
        sides.append(math.copysign(1.0, retreat.slant) if retreat.slant else 0.0)
    assert sides == [1.0, -1.0, 0.0]
    retreat.begin(2.0, 40.0)
    assert not retreat.backs_off


def test_an_edge_higher_than_the_wheel_is_climbed() -> None:
    # seed 2: a post of 0.2 m at the edge of the field, the wheel's radius is 0.14 m; without a lift
    # the robot stood before it until its time was up
    done = field_tests.repeat(field_tests.method("e2828"), 0.1, "rescue", 2)
    assert done.fault == ""


def test_a_post_before_the_battery_is_passed_beside() -> None:
    # seed 8: a post of 0.12 m, 15 mm higher than the battery's lower side; whatever is lifted, the
    # battery comes to lie on it
    done = field_tests.repeat(field_tests.method("e2828"), 0.06, "rescue", 8)
    assert done.fault == ""
