"""How a step of episodes side by side is judged, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hurcules
from hurcules import _core

NO, YES = np.array([False]), np.array([True])
PLACE = {read: i for i, (read, _) in enumerate(_core.judged())}
FELL = int(hurcules.Ending.Fell)


def judge(worst: float = 0.0, failed: Any = NO, ended: Any = NO, **read: float) -> Any:
    """One episode; `read` by the part of a name before its first "/", what is not said is 0."""
    values = np.zeros((1, 2 + len(PLACE)))
    values[0, :2] = 7.0  # of the environment's own
    for name, value in read.items():
        values[0, 2 + next(i for one, i in PLACE.items() if one.startswith(name))] = value
    terms, noted = [np.array([0.25]), np.array([0.5])], np.array([worst])
    result = _core.judge(values, terms, failed, ended, NO, noted)
    reward, *flags, told, finite = result
    assert reward == [0.75]
    assert finite
    assert told[:2].tolist() == [[0.25], [0.5]]
    return *(flag[0] for flag in flags), told[2:, 0], float(noted[0])


def test_an_episode_ends_by_a_fall_a_failure_or_success_in_this_order() -> None:
    for read, failed, ended, wanted in (
        (0, NO, NO, (False, False, 0)),
        (0, NO, YES, (False, True, int(hurcules.Ending.Completed))),
        (0, YES, YES, (True, True, int(hurcules.Ending.Missed))),
        (FELL, YES, NO, (True, True, FELL)),
        (int(hurcules.Ending.Completed), NO, NO, (False, False, 0)),  # the task says when it ends
    ):
        assert judge(failed=failed, ended=ended, ending=read)[:3] == wanted


@pytest.mark.parametrize(
    ("read", "worst", "costs"),
    [
        ({}, 0.0, 0.0),
        ({"self_contacts": 1.0}, 0.0, 1.0),
        ({"excess_now/position": 4.9e-3, "excess/position": 4.9e-3}, 0.0, 0.0),
        ({"excess_now/position": 5.1e-3}, 0.0, 1.0),
        ({"excess/position": 6e-3}, 0.0, 1.0),  # within the step
        ({"excess/position": 6e-3}, 6e-3, 0.0),  # long ago
    ],
)
def test_a_step_costs(read: dict[str, float], worst: float, costs: float) -> None:
    *_, told, noted = judge(worst, **read)
    assert told[0] == costs
    assert noted == read.get("excess/position", 0.0)


def test_what_is_told_of_a_robot_that_cannot_tip() -> None:
    *_, told, _ = judge(**{"monitor/static": np.nan, "time": 1.5})
    assert (told[PLACE["monitor/static_margin_m"]], told[PLACE["time"]]) == (0.0, 1.5)


def test_arrays_of_another_size_are_refused() -> None:
    one, two = np.zeros(1), np.zeros(2)
    values = np.zeros((1, len(PLACE)))
    for wrong in (
        (values[:, 1:], [one], NO, NO, NO, one),
        (values, [two], NO, NO, NO, one),
        (values, [one], NO, NO, np.zeros(2, bool), one),
        (values, [one], NO, NO, NO, two),
    ):
        with pytest.raises(hurcules.Error, match="judge wants values and claims"):
            _core.judge(*wrong)


def test_an_action_is_cut_and_an_observation_put_together() -> None:
    cut, finite = _core.clipped(np.array([[2.0, -0.5], [-3.0, 1.0]]))
    assert finite
    assert cut.tolist() == [[1.0, -0.5], [-1.0, 1.0]]
    assert not _core.clipped(np.array([np.nan]))[1]
    rows = np.arange(12.0).reshape(2, 6)
    parts, bound = [rows[:, 4:], rows[:, ::-3]], np.full(4, 8.0, np.float32)
    (seen, goal), finite = _core.seen(parts, bound, np.full((2, 3), 0.5), [rows[:, :1] + 9.0])
    assert finite
    assert seen.dtype == goal.dtype == np.float32
    assert seen.tolist() == [[4.5, 5.5, 5.5, 2.0], [8.0, 8.0, 8.0, 8.0]]
    assert goal.tolist() == [[9.0], [15.0]]
    for part, of_goal in ((np.nan, 0.0), (0.0, np.inf)):
        arrays = [np.full((1, 1), part)], bound[:1], None, [np.full((1, 1), of_goal)]
        assert not _core.seen(*arrays)[1]
    for wrong in (
        (parts[:1], bound),
        ([*parts, rows], bound),
        (parts, bound, np.zeros((1, 4))),
        (parts, bound[:3]),
    ):
        with pytest.raises(hurcules.Error, match="2 rows, the parts of"):
            _core.seen(*wrong)
    with pytest.raises(hurcules.Error, match="of 2 rows"):
        _core.seen(parts, bound, None, [np.zeros((1, 3))])


def test_rewards_that_are_not_finite_are_told() -> None:
    values, worst, none = np.zeros((2, len(PLACE))), np.zeros(2), np.zeros(2, bool)
    result = _core.judge(values, [np.array([0.0, np.nan])], none, none, none, worst)
    assert not result[-1]


def test_how_far_poses_are_apart() -> None:
    one, other = np.zeros((2, 14)), np.zeros((2, 14))
    one[0, 7:10] = 1.0, 2.0, 2.0
    one[:, 3] = one[:, 10] = 1.0
    angle = 0.5
    other[:, 3::7], other[:, 6::7] = -2.0 * np.cos(angle / 2), -2.0 * np.sin(angle / 2)
    assert _core.distances(one, other, 7).tolist() == [[0.0, 3.0], [0.0, 0.0]]
    cosines = _core.half_angle_cosines(one, other, 7)
    assert cosines.shape == (2, 2)
    np.testing.assert_allclose(2.0 * np.arccos(cosines), angle, atol=1e-12)
    fine = np.full((1, 3), 1.0 + 1e-12)
    assert _core.distances(fine, np.ones((1, 3)), 3).item() > 0.0
    assert _core.distances(fine, np.ones((1, 3)), 3, rounded=True).item() == 0.0
    for wrong in ((one, other[:1], 7), (one, other, 5), (one, other, 2)):
        with pytest.raises(hurcules.Error, match="goals want two arrays of one shape"):
            _core.distances(*wrong)


def test_rows_in_a_number() -> None:
    rows = np.array([[1.0, 2.0, 3.0], [4.0, 0.0, 2.0]])
    assert _core.all_below(rows, 4.0).tolist() == [True, False]
    assert _core.means(rows, -2.0).tolist() == [-4.0, -4.0]
    assert _core.squares(rows[:, 1:]).tolist() == [13.0, 4.0]
    nine = np.arange(9.0)[None]
    assert _core.squares(nine).item() == 204.0


def test_what_is_held_without_a_break_is_done() -> None:
    held, done, fresh = np.zeros((2, 1)), np.zeros((2, 1)), []
    for now in ([1, 1], [1, 0], [1, 1], [0, 1]):
        fresh.append(_core.hold(np.array(now, bool), 0.1, 0.3, held, done).tolist())
    assert held.ravel().tolist() == [0.0, 0.2]
    assert done.ravel().tolist() == [1.0, 0.0]
    assert fresh == [[0, 0], [0, 0], [1, 0], [0, 0]]
    with pytest.raises(hurcules.Error, match="each of 3 episodes"):
        _core.hold(np.zeros(3, bool), 0.1, 0.3, held, done)


def test_a_point_in_a_spring_starts_with_what_its_place_gained_in_velocity() -> None:
    free = np.array([[0.5, 0.25], [-2.0, 0.75]])
    before, velocity, deflection, rate = (np.full((1, 3), x) for x in (1.0, 2.0, 0.1, 0.0))
    points = _core.swing(np.full((1, 3), 1.4), free, 0.1, before, velocity, deflection, rate)
    # from 2 to 4 m/s: the deflection's rate is -2 m/s where the step begins
    np.testing.assert_allclose(velocity, 4.0)
    np.testing.assert_allclose(deflection, 0.5 * 0.1 - 0.25 * 2.0)
    np.testing.assert_allclose(rate, -2.0 * 0.1 - 0.75 * 2.0)
    np.testing.assert_allclose(points, 1.4 + deflection)
    assert before.tolist() == [[1.4, 1.4, 1.4]]
    for law, last in ((free, rate[:, :2].copy()), (free[:1], rate)):
        with pytest.raises(hurcules.Error, match="five arrays of one shape"):
            _core.swing(points, law, 0.1, before, velocity, deflection, last)
