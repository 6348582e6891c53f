"""Test methods: their statistics are exact, their runs repeat, stop where they should, log faults.

Strategy: statistics against the printed table of response-robot-tests.md section C1 [C1] and
against draws; runs with few repetitions at settings that geometry decides. Not tested: the largest
settings themselves, which are results.
"""

import json
import math

import numpy as np
import pytest

import hurcules
from hurcules import scenes, trials

# [C1] minimum n for 0 / 1 / 2 / 3 failures at confidence 80, 85, 90, 95 %
TABLE = {
    0.80: ((8, 14, 21, 27), (9, 16, 23, 29), (11, 18, 25, 32), (14, 22, 30, 37)),
    0.85: ((10, 19, 28, 36), (12, 22, 31, 39), (15, 25, 34, 43), (19, 30, 40, 50)),
    0.90: ((16, 29, 42, 54), (19, 33, 46, 59), (22, 38, 52, 65), (29, 46, 61, 76)),
    0.95: ((32, 59, 85, 110), (37, 67, 94, 119), (45, 77, 105, 132), (59, 93, 124, 153)),
}
# nothing differs, for runs whose outcome is to be certain
SAME = trials.Variation(friction=(1.0, 1.0), payload=0.0, offset=0.0, yaw=0.0)


@pytest.mark.parametrize("reliability", TABLE)
def test_the_least_numbers_of_repetitions_are_the_printed_ones(reliability):
    for wanted, row in zip((0.80, 0.85, 0.90, 0.95), TABLE[reliability], strict=True):
        found = tuple(trials.repetitions_needed(reliability, wanted, f) for f in range(4))
        assert found == row, wanted


@pytest.mark.parametrize(
    "n, failures, reliability, percent", [(10, 0, 0.80, 89), (30, 0, 0.90, 96), (30, 3, 0.80, 88)]
)
def test_the_printed_examples_come_out(n, failures, reliability, percent):  # [C1]
    assert round(100 * trials.confidence(n, failures, reliability)) == percent


def test_confidence_is_the_share_of_draws_with_more_failures():
    draws = np.random.default_rng(2).binomial(20, 1 - 0.8, size=200_000)
    for failures in (0, 2, 5):
        share = (draws > failures).mean()
        assert trials.confidence(20, failures, 0.8) == pytest.approx(share, abs=5e-3)


@pytest.mark.parametrize("n, failures", [(10, 0), (30, 3), (100, 40)])
def test_the_lower_bound_has_exactly_the_confidence(n, failures):
    bound = trials.lower_bound(n, failures, 0.95)
    assert trials.confidence(n, failures, bound) == pytest.approx(0.95, abs=1e-9)
    assert trials.lower_bound(n, n) == 0.0


def test_bad_counts_and_shares_are_refused():
    for call in (
        lambda: trials.confidence(0, 0, 0.5),
        lambda: trials.confidence(5, 6, 0.5),
        lambda: trials.confidence(5, 0, 1.5),
        lambda: trials.lower_bound(5, -1),
        lambda: trials.repetitions_needed(1.0, 0.9),
        lambda: trials.run("e2801", repetitions=0),
        lambda: trials.run("e2801", speed=0.0),
    ):
        with pytest.raises(hurcules.Error, match="wanted"):
            call()
    with pytest.raises(hurcules.Error, match=r"'e9999' does not exist; .*e2801"):
        trials.run("e9999")


@pytest.mark.parametrize("name", trials.METHODS)
def test_every_setting_of_a_method_is_a_scene_and_they_get_harder(name):
    method = trials.method(name)
    assert list(method.settings) == sorted(method.settings)
    for setting in method.settings or (None,):
        assert scenes.scene(method.scene, **method.values(setting)).end > 2.0


def test_a_run_stops_at_the_first_setting_that_is_not_passed_and_says_why():
    result = trials.run("e2801", repetitions=1, settings=(0.2, 1.5, 0.3), variation=SAME)
    assert [one.setting for one in result.settings] == [0.2, 1.5]
    assert result.passed and result.largest == 0.2
    good, bad = result.settings
    assert good.failures == 0 and good.metres_per_minute == pytest.approx(36, rel=0.05)
    assert bad.failures == 1 and bad.faults[0].fault == "tip-over" and bad.faults[0].x > 1.5
    assert good.confidence_80 == pytest.approx(0.2) and bad.confidence_80 == 0.0
    assert json.loads(json.dumps(result.as_dict()))["settings"][0]["setting"] == 0.2


def test_the_same_seed_gives_the_same_repetition_and_another_differs():
    method = trials.Method("", "gap", "width", (0.1,))
    first, again, other = (trials.repeat(method, 0.1, "rescue", seed) for seed in (5, 5, 6))
    assert first == again and first.fault == ""
    assert first.seconds != other.seconds or first.x != other.x


def test_too_little_friction_is_a_fault_not_an_error():
    slippery = trials.Variation(friction=(0.33, 0.33), payload=0.0)  # 0.3; tan 25 = 0.47
    settings = (math.radians(25),)
    result = trials.run("e2803", repetitions=1, settings=settings, variation=slippery)
    assert not result.passed and result.largest is None
    assert result.settings[0].faults[0].fault in ("stuck", "off the lane")


def test_another_driver_takes_the_place_of_ours():
    calls = []

    def sleeper(model, data, speed):
        calls.append(speed)

    result = trials.run("e2801", repetitions=1, settings=(0.1,), driver=sleeper, speed=2.0)
    assert result.settings[0].faults[0].fault == "stuck"
    assert len(calls) > 100 and set(calls) == {2.0}
