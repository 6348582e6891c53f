"""Force control in the physics: both hands of the rescue robot on the ground, by its elbow springs.

Strategy: the rig of the claims K05 to K20, for a few seconds each. The force that is asked for (5 N
down [T §5.6.2]), what the laws make of it, impact, sliding, an emergency stop. The claims and their
longer runs: `hurcules reproduce K`; the laws alone: C++ tests.
"""

from __future__ import annotations

import numpy as np
import pytest

from hurcules import ForceGains
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_lowering import by_law, lowered, pressed, steady
from hurcules_studies.thesis.measures.press_robot import PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.press_scene import Surface

GAINS = ForceGains(compliance=0.05)  # [m/s/N], the thesis'
SERVO_FRICTION = 0.1  # [N] of steady error that the dry friction of the joints leaves


@pytest.mark.parametrize("stiffness", [1e3, 1e4, 0.0], ids=["soft", "firm", "floor"])
def test_both_hands_reach_the_force_on_soft_and_on_stiff_ground(stiffness: float) -> None:
    surface = Surface(stiffness=stiffness)
    told = 1.0 / (1.0 / G + (1.0 / stiffness if stiffness else 0.0))  # both springs in a row
    log = lowered(Setting(surface, GAINS, told), speed=0.03, end=4.5)
    end = log.part(3.5)
    for side in (0, 1):
        assert log.force[end, side].mean() == pytest.approx(-5.0, abs=SERVO_FRICTION)
        assert (log.state[end, side] == 1).all()
    # standing still, friction holds some of it: up to tan(0.6) times 0.35 of what is pressed
    assert -9.0 < pressed(log)[end].mean() < -3.5


def test_a_stiffness_that_is_learnt_does_as_well() -> None:
    log = lowered(Setting(gains=GAINS), speed=0.03, end=4.5)
    assert log.force[log.part(3.5), 0].mean() == pytest.approx(-5.0, abs=SERVO_FRICTION)


def test_the_laws_end_where_their_formulas_say() -> None:
    # K02: (C G f_d - G r) / (1 + C G) = -5.5 N with C = 0.05 m/N, C G = 55, r = 30 mm
    assert steady(by_law("P")) == pytest.approx(-5.5, abs=0.1)
    velocity = by_law("velocity")  # K04
    assert steady(velocity) == pytest.approx(-5.0, abs=0.02)
    settled = velocity.part(velocity.touched() + 0.5)
    assert np.abs(velocity.force[settled] + 5.0).max() < 0.25


def test_springs_keep_an_impact_on_the_floor_below_the_limit() -> None:
    # K18: 50 N at 0.05 m/s; measured 35 N, and 126 N with rigid elbows
    setting = Setting(gains=GAINS, environment=G)
    log = lowered(setting, speed=0.05, end=3.5)
    assert -50.0 < log.contact[:, :, 2].min() < -5.0
    assert (log.state[log.part(3.0)] == 1).all()


def test_contact_is_kept_while_both_hands_slide() -> None:
    robot = PressRobot(Setting(gains=GAINS, environment=G))
    robot.settle()
    log = robot.follow(ramped(0.06, 3.5, 60.0), ramped(-0.03, 1.5, 60.0), 6.0)
    part = log.part(3.5)
    assert np.ptp(log.hand[part, 0]) > 0.1
    for side in (0, 1):
        touching = np.convolve(log.contact[part, side, 2], np.ones(10), "same") < 0
        assert touching.all()
        assert log.force[part, side].mean() == pytest.approx(-5.0, abs=0.25)
        assert np.abs(log.force[part, side] + 5.0).max() < 2.5


def test_a_hand_that_strikes_hard_stops_and_stays() -> None:
    surface = Surface(springs=False)
    log = lowered(Setting(surface, GAINS, 1e4, f_max=60.0), speed=0.05, end=4.0)
    assert (log.state[log.part(3.5)] == 2).all()  # stopped
    still = log.part(3.5)
    assert np.ptp(log.planned[still, 2]) < 1e-3
