"""Claims E01 to E05: the examples of Chapter 3 with the mobile arm (mobile_arm.py).

The thesis prints neither its starts nor its figures' values: starts and reference numbers come
from a simulation made apart from this code (same printed inputs, 3.2.10 without its misplaced
s_des, 3.4.117 with every violated row blocking). Equality tasks run on the default and on
Algorithm 1, which agree there; the range is on Algorithm 1, as printed.
"""

from __future__ import annotations

import numpy as np
import pytest

from mobile_arm import DT, Motion, hand, move, point_and_range, two_points

POINTS = [(0.0, 1.2), (-0.5, 2.5), (1.5, 0.7), (2.0, 1.57), (0.0, 0.02)]  # the last near singular
RANGES = [(0.0, 1.2), (-0.5, 2.5), (1.0, 0.7), (0.35, 2.2), (0.0, 0.02)]
REGULARIZED = ("lexicographic", "rhqp_thesis")


def settled(values: np.ndarray, limit: float) -> float:
    """The time [s] from which on the values stay below a limit."""
    above = np.flatnonzero(values >= limit)
    return 0.0 if above.size == 0 else DT * float(above[-1] + 1)


def distance(motion: Motion, s1: float, s2: float) -> np.ndarray:
    return np.hypot(hand(motion.q) - s1, motion.q[:, 0] - s2)


def beyond(motion: Motion) -> np.ndarray:
    """g2, g3: how far the base is outside 0.2 .. 0.5."""
    base = motion.q[:, 0]
    return np.maximum(0.0, np.maximum(0.2 - base, base - 0.5))


@pytest.mark.parametrize("method", REGULARIZED)
def test_E01_both_reach_a_target_within_reach(method: str) -> None:
    """Figure 3.3: HQP by 3 s, RHQP by 5 s. Reference: 2.9-3.7 s; 3.9-4.4 s, near singular 5.7 s."""
    hqp = [move(two_points(0.5, 1.0), start, "hqp", 10.0) for start in POINTS]
    ours = [move(two_points(0.5, 1.0), start, method, 10.0) for start in POINTS]
    for motion in hqp + ours:
        assert distance(motion, 0.5, 1.0)[-1] < 3e-3
    times = [settled(distance(motion, 0.5, 1.0), 0.05) for motion in hqp]
    assert (min(times), max(times)) == (pytest.approx(2.9), pytest.approx(3.7))
    times = [settled(distance(motion, 0.5, 1.0), 0.05) for motion in ours]
    assert (min(times[:4]), max(times[:4])) == (pytest.approx(3.9), pytest.approx(4.4))
    assert times[4] == pytest.approx(5.7)


@pytest.mark.parametrize("method", REGULARIZED)
def test_E02_near_a_singularity_hqp_is_fast(method: str) -> None:
    """Figure 3.3, case 5. Reference: peak velocity 75 against 1.3."""
    assert move(two_points(0.5, 1.0), POINTS[4], "hqp", 10.0).peak == pytest.approx(75.0, rel=0.01)
    assert move(two_points(0.5, 1.0), POINTS[4], method, 10.0).peak == pytest.approx(1.3, abs=0.05)


@pytest.mark.parametrize("method", REGULARIZED)
def test_E03_only_regularised_solutions_converge_out_of_reach(method: str) -> None:
    """Figure 3.4, 3.3.94: (|g1|, |g2|) -> (0, 1) at q = (1, 2 j pi). HQP: peaks 45-340, g1 > 1.

    HQP at the singularity is chaotic: its peaks here are 86 to 370, what stays is the order.
    """
    for start in POINTS:
        motion = move(two_points(2.0, 0.0), start, method, 10.0)
        assert abs(hand(motion.q[-1]) - 2.0) < 2e-3
        assert abs(motion.q[-1][0] - 1.0) < 2e-3
        turns = motion.q[-1][1] / (2 * np.pi)
        assert abs(turns - round(turns)) < 1e-2
        hqp = move(two_points(2.0, 0.0), start, "hqp", 10.0)
        assert abs(hand(hqp.q[-1]) - 2.0) > 1.0
        assert hqp.peak > 45.0


def test_E03_hqp_converges_from_the_boundary() -> None:
    """Figure 3.4: HQP converges only where the start happens to be on the reachable boundary."""
    motion = move(two_points(2.0, 0.0), (0.3, 0.0), "hqp", 10.0)
    assert abs(hand(motion.q[-1]) - 2.0) < 1e-4
    np.testing.assert_allclose(motion.q[-1], [1.0, 0.0], atol=1e-4)


def test_E04_a_range_at_the_second_level_is_kept() -> None:
    """Figures 3.6-3.7: 3 s (HQP), 4 s (RHQP). Reference |g1| at 3 s: 0.011-0.051, 0.016-0.103."""
    wanted = {"hqp": (0.011, 0.051), "rhqp_thesis": (0.016, 0.103)}
    for method, (least, most) in wanted.items():
        motions = [move(point_and_range(0.1, 0.2, 0.5), start, method, 10.0) for start in RANGES]
        errors = [np.abs(hand(motion.q) - 0.1) for motion in motions]
        for motion, error in zip(motions, errors, strict=True):
            assert error[-1] < 2e-4
            assert beyond(motion)[-1] < 1e-5
        at_3s = [error[30] for error in errors]
        assert (min(at_3s), max(at_3s)) == (
            pytest.approx(least, abs=5e-4),
            pytest.approx(most, abs=5e-4),
        )


def test_E05_a_range_that_conflicts_gives_way() -> None:
    """Figures 3.8-3.9, 3.4.122: (|g1|, |g2|) -> (0, 0.5), q2 -> 0; HQP never converges.

    Reference, start (0, 1.2): g2 = 0.03 at 1 s, 0.20 at 2 s, 0.44 at 4 s, 0.4996 at 10 s; all
    starts end at 0.499-0.500. HQP's speeds are chaotic: reference 60-420, here 23-365.
    """
    for start in RANGES:
        motion = move(point_and_range(2.0, 0.2, 0.5), start, "rhqp_thesis", 10.0)
        assert abs(hand(motion.q[-1]) - 2.0) < 1e-3
        assert 0.499 <= beyond(motion)[-1] <= 0.5
        assert abs(motion.q[-1][1]) < 0.05
        hqp = move(point_and_range(2.0, 0.2, 0.5), start, "hqp", 10.0)
        assert abs(hand(hqp.q[-1]) - 2.0) > 0.4
        assert hqp.peak > 20.0
    first = beyond(move(point_and_range(2.0, 0.2, 0.5), RANGES[0], "rhqp_thesis", 10.0))
    np.testing.assert_allclose(first[[10, 20, 40]], [0.03, 0.20, 0.44], atol=5e-3)
    assert first[100] == pytest.approx(0.4996, abs=5e-5)
