"""How a step of episodes side by side is judged, by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import hurcules
from hurcules import _core

NO, YES = np.array([False]), np.array([True])
PLACE = {name: i for i, name in enumerate(_core.judged())}
FELL = int(hurcules.Ending.Fell)


def judge(worst: float = 0.0, failed: Any = NO, ended: Any = NO, **read: float) -> Any:
    """One episode; `read` by the part of a name before its first "/", what is not said is 0."""
    values = np.zeros((1, 2 + len(PLACE)))
    values[0, :2] = 7.0  # of the environment's own
    for name, value in read.items():
        values[0, 2 + next(i for one, i in PLACE.items() if one.startswith(name))] = value
    terms, noted = [np.array([0.25]), np.array([0.5])], np.array([worst])
    result = _core.judge(values, terms, failed, ended, NO, np.array([[3.0]]), noted)
    assert result[0] == [0.75]
    return *(one[..., 0] for one in result[1:]), float(noted[0])


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


def test_what_is_told_beside_and_of_a_robot_that_cannot_tip() -> None:
    *_, told, _ = judge(**{"monitor/static": np.nan, "time": 1.5})
    assert (told[PLACE["monitor/static_margin_m"]], told[PLACE["time"]], told[-1]) == (
        0.0,
        1.5,
        3.0,
    )


def test_arrays_of_another_size_are_refused() -> None:
    one, two = np.zeros(1), np.zeros(2)
    values, beside = np.zeros((1, len(PLACE))), np.zeros((0, 1))
    for wrong in (
        (values[:, 1:], [one], NO, NO, NO, beside, one),
        (values, [two], NO, NO, NO, beside, one),
        (values, [one], NO, NO, np.zeros(2, bool), beside, one),
        (values, [one], NO, NO, NO, np.zeros((0, 2)), one),
        (values, [one], NO, NO, NO, beside, two),
    ):
        with pytest.raises(hurcules.Error, match="judge wants values, claims"):
            _core.judge(*wrong)


def test_an_action_is_cut_and_an_observation_put_together() -> None:
    cut, finite = _core.clipped(np.array([[2.0, -0.5], [-3.0, 1.0]]))
    assert finite
    assert cut.tolist() == [[1.0, -0.5], [-1.0, 1.0]]
    assert not _core.clipped(np.array([np.nan]))[1]
    rows = np.arange(12.0).reshape(2, 6)
    parts, bound = [rows[:, 4:], rows[:, ::-3]], np.full(4, 8.0, np.float32)
    seen, finite = _core.seen(parts, bound, np.full((2, 4), 0.5))
    assert finite
    assert seen.dtype == np.float32
    assert seen.tolist() == [[4.5, 5.5, 5.5, 2.5], [8.0, 8.0, 8.0, 8.0]]
    assert not _core.seen([np.full((1, 1), np.nan)], bound[:1])[1]
    with pytest.raises(hurcules.Error, match="2 rows and 4 columns"):
        _core.seen(parts[:1], bound)
