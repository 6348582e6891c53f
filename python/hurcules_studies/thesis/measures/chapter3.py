"""E01 to E05: the mobile arm's examples, on HQP, Algorithm 1 and the default.

The range of E04 and E05 is on Algorithm 1, as printed: there a working row counts as an equality,
which the default does not do (docs/solver.md, section 2).
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.mobile_arm import (
    DT,
    Motion,
    Start,
    hand,
    move,
    point_and_range,
    two_points,
)
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures

# the last of each is near the singularity
POINTS: tuple[Start, ...] = ((0.0, 1.2), (-0.5, 2.5), (1.5, 0.7), (2.0, 1.57), (0.0, 0.02))
RANGES: tuple[Start, ...] = ((0.0, 1.2), (-0.5, 2.5), (1.0, 0.7), (0.35, 2.2), (0.0, 0.02))


def settled(values: Array, limit: float) -> float:
    """The time [s] from which on the values stay below a limit."""
    above = np.flatnonzero(values >= limit)
    return 0.0 if above.size == 0 else DT * float(above[-1] + 1)


def distance(motion: Motion, s1: float, s2: float) -> Array:
    """From the target, (steps + 1,) [m]."""
    return np.hypot(hand(motion.q) - s1, motion.q[:, 0] - s2)


def beyond(motion: Motion) -> Array:
    """g2, g3: how far the base is outside 0.2 to 0.5, (steps + 1,) [m]."""
    base = motion.q[:, 0]
    return np.maximum(0.0, np.maximum(0.2 - base, base - 0.5))


def picture(
    title: str,
    motions: Sequence[Motion],
    value: Callable[[Motion], Array],
    label: str,
    log: str = "",
) -> Plot:
    """A value of five runs over time."""
    lines = [line("", motion.time, value(motion)) for motion in motions]
    return Plot(title, "time [s]", label, lines, log=log)


@measures("E01")
def within_reach() -> Finding:
    """Arrival: the distance stays below 0.05 m."""

    def runs(method: str) -> list[Motion]:
        return [move(two_points(0.5, 1.0), start, method) for start in POINTS]

    def arrivals(motions: list[Motion]) -> list[float]:
        return [settled(distance(motion, 0.5, 1.0), 0.05) for motion in motions]

    hqp, ours, default = runs("hqp"), runs("rhqp_thesis"), runs("lexicographic")
    times, times_hqp = arrivals(ours), arrivals(hqp)
    ends = [distance(motion, 0.5, 1.0)[-1] for motion in hqp + ours + default]
    off = np.abs(np.array(arrivals(default)) - times).max()

    def away(motion: Motion) -> Array:
        return distance(motion, 0.5, 1.0)

    return Finding(
        {
            "distance": max(ends),
            "hqp_first": min(times_hqp),
            "hqp_last": max(times_hqp),
            "hqp_3s": max(times_hqp),
            "first": min(times[:4]),
            "last": max(times[:4]),
            "singular": times[4],
            "rhqp_5s": max(times),
            "default": float(off),
        },
        plots=[
            picture("HQP", hqp, away, "distance [m]"),
            picture("RHQP", ours, away, "distance [m]"),
        ],
    )


@measures("E02")
def near_singular() -> Finding:
    """The start (0, 0.02)."""
    motions = {
        method: move(two_points(0.5, 1.0), POINTS[4], method)
        for method in ("hqp", "rhqp_thesis", "lexicographic")
    }
    lines = [
        line(label, motions[name].time[:-1], np.abs(motions[name].velocity).max(axis=1) + 1e-9)
        for label, name in (("HQP", "hqp"), ("RHQP", "rhqp_thesis"))
    ]
    return Finding(
        {
            "hqp": motions["hqp"].peak,
            "rhqp": motions["rhqp_thesis"].peak,
            "default": motions["lexicographic"].peak,
        },
        plots=[Plot("Largest joint velocity", "time [s]", "[rad/s]", lines, log="y")],
    )


@measures("E03")
def out_of_reach() -> Finding:
    """HQP at the singularity is chaotic; what stays is the order of its speeds."""
    target = two_points(2.0, 0.0)
    ours = [move(target, start, "rhqp_thesis") for start in POINTS]
    default = [move(target, start, "lexicographic") for start in POINTS]
    hqp = [move(target, start, "hqp") for start in POINTS]
    turns = np.array([motion.q[-1][1] / (2 * np.pi) for motion in ours + default])
    boundary = move(target, (0.3, 0.0), "hqp")

    def g1(motion: Motion) -> Array:
        return np.abs(hand(motion.q) - 2.0) + 1e-9

    return Finding(
        {
            "g1": max(float(g1(motion)[-1]) for motion in ours + default),
            "q1": max(abs(motion.q[-1][0] - 1.0) for motion in ours + default),
            "turn": float(np.abs(turns - np.round(turns)).max()),
            "hqp_g1": min(float(g1(motion)[-1]) for motion in hqp),
            "hqp_peak": min(motion.peak for motion in hqp),
            "boundary": float(g1(boundary)[-1]),
        },
        [Note("largest peak velocity, HQP", max(motion.peak for motion in hqp), "rad/s")],
        [
            picture("HQP", hqp, g1, "|g1| [m]", "y"),
            picture("RHQP", ours, g1, "|g1| [m]", "y"),
            picture("RHQP", ours, lambda m: np.abs(m.q[:, 0]), "|g2| [m]"),
        ],
    )


@measures("E04")
def range_kept() -> Finding:
    """|g1| at 3 s is at step 30; "met" as in E01, within 0.05 m."""
    runs = {
        method: [move(point_and_range(0.1, 0.2, 0.5), start, method) for start in RANGES]
        for method in ("hqp", "rhqp_thesis")
    }
    at_3s = {
        method: [float(abs(hand(motion.q)[30] - 0.1)) for motion in motions]
        for method, motions in runs.items()
    }
    motions = runs["hqp"] + runs["rhqp_thesis"]
    return Finding(
        {
            "g1": max(float(abs(hand(motion.q)[-1] - 0.1)) for motion in motions),
            "range": max(float(beyond(motion)[-1]) for motion in motions),
            "hqp_least": min(at_3s["hqp"]),
            "hqp_most": max(at_3s["hqp"]),
            "least": min(at_3s["rhqp_thesis"]),
            "most": max(at_3s["rhqp_thesis"]),
            "hqp_3s": max(at_3s["hqp"]),
            "rhqp_4s": max(float(abs(hand(motion.q)[40] - 0.1)) for motion in runs["rhqp_thesis"]),
        },
        plots=[
            picture("HQP", runs["hqp"], lambda m: hand(m.q) - 0.1, "g1 [m]"),
            picture("RHQP", runs["rhqp_thesis"], lambda m: hand(m.q) - 0.1, "g1 [m]"),
            picture("RHQP", runs["rhqp_thesis"], beyond, "outside the range [m]"),
        ],
    )


@measures("E05")
def range_given_up() -> Finding:
    """The range gives way to the hand."""
    levels = point_and_range(2.0, 0.2, 0.5)
    ours = [move(levels, start, "rhqp_thesis") for start in RANGES]
    hqp = [move(levels, start, "hqp") for start in RANGES]
    first = beyond(ours[0])
    return Finding(
        {
            "g1": max(float(abs(hand(motion.q)[-1] - 2.0)) for motion in ours),
            "g2_least": min(float(beyond(motion)[-1]) for motion in ours),
            "g2_most": max(float(beyond(motion)[-1]) for motion in ours),
            "q2": max(float(abs(motion.q[-1][1])) for motion in ours),
            "at_1s": float(first[10]),
            "at_2s": float(first[20]),
            "at_4s": float(first[40]),
            "at_10s": float(first[100]),
            "hqp_g1": min(float(abs(hand(motion.q)[-1] - 2.0)) for motion in hqp),
            "hqp_peak": min(motion.peak for motion in hqp),
        },
        plots=[
            picture("HQP", hqp, lambda m: np.abs(hand(m.q) - 2.0), "|g1| [m]"),
            picture("RHQP", ours, lambda m: np.abs(hand(m.q) - 2.0), "|g1| [m]"),
            picture("RHQP", ours, beyond, "outside the range [m]"),
        ],
    )
