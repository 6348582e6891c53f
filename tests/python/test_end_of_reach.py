"""Hands that press on the ground and are led beyond their reach by accelerations, in the physics.

Strategy: the rescue robot of the claims K08 to K11, led on for 3 s. With the law of the thesis the
elbows swing and let go of the ground, so the measurement sees a swing; with `rest` and a maximum
lead they stop and press on. Not tested here: the law itself
(tests/cpp/control/end_of_reach_test.cpp).
"""

import numpy as np
import pytest

import hurcules
from hurcules_studies.thesis.measures.force_reach import MAX_LEAD, REST, led_on, swings, weakest


def test_the_law_of_the_thesis_swings():
    log = led_on(0.0, np.inf)
    assert swings(log, "LEB", "REB") > 0.5
    assert weakest(log) > 0.0


def test_with_rest_and_a_maximum_lead_the_arms_stop_and_press_on():
    log = led_on(REST, MAX_LEAD)
    assert swings(log, "LEB", "REB") < 0.05
    assert swings(log) < 0.3  # the turn of the upper arms, 2 mrad at 30 Hz
    assert weakest(log) < -2.5
    assert float(log.errors[:, 0].max()) < 3 * MAX_LEAD


@pytest.mark.parametrize("max_lead", [0.0, -1.0, float("nan")])
def test_the_maximum_lead_is_a_positive_length(max_lead):
    robot = hurcules.Robot(hurcules.models.load("rescue"))
    task = hurcules.PositionTask("hand", robot, "L_tcp")
    assert task.max_lead == np.inf
    with pytest.raises(hurcules.Error, match="max_lead of 'hand'"):
        task.max_lead = max_lead
