"""Does the answer jump? Worst |dx| / step while the targets move along a line, step by step finer.

The hierarchies are those of "conflicting levels" (n = 19, a box, rows of lower levels in the span
of those above). The direction of the line has unit length, so a continuous answer has a slope that
settles as the step shrinks, and a jump one that grows tenfold with each column. The finer steps are
taken where the coarser ones moved most.

    python benchmarks/continuity.py [--lines 24] [--length 0.4]
"""

from __future__ import annotations

import argparse

import numpy as np
from motions import CONFLICTS, moved, problem, with_rho
from peers import Cascade, DaqpHierarchy, Ours, Peer, Weighted, attempt
from rich.console import Console
from rich.table import Table

from oracle import Rows

STEPS = (2e-3, 2e-4, 2e-5, 2e-6)
WORST = 5  # steps of a line that are taken again in ten finer ones


def line(rng: np.random.Generator) -> tuple[list[Rows], list[np.ndarray]]:
    """Levels, and a direction of unit length in which the targets of all but the box move."""
    levels = problem(CONFLICTS[2], rng)
    direction = [
        np.zeros(len(v.lower)) if v.bounds else rng.normal(size=len(v.lower)) for v in levels
    ]
    length = np.linalg.norm(np.concatenate(direction))
    return levels, [d / length for d in direction]


def steps(
    peer: Peer, levels: list[Rows], direction: list[np.ndarray], at: list[float]
) -> np.ndarray:
    """|dx| of each step between the points of the line; not a number where an answer is missing."""
    answers = [attempt(peer, moved(levels, direction, s))[0] for s in at]
    missing = np.full(len(levels[0].lower), np.nan)
    x = np.array([missing if a is None else a for a in answers])
    return np.linalg.norm(np.diff(x, axis=0), axis=1)


def slopes(peer: Peer, rho: float, lines: int, length: float) -> tuple[np.ndarray, int]:
    """Worst slope over all lines for each size of step, and the number of missing steps."""
    rng = np.random.default_rng(1)
    worst, missing = np.zeros(len(STEPS)), 0
    for _ in range(lines):
        levels, direction = line(rng)
        levels = with_rho(levels, rho)
        starts = np.arange(0.0, length, STEPS[0])
        for k, step in enumerate(STEPS):
            moves = np.array([steps(peer, levels, direction, [s, s + step]) for s in starts])[:, 0]
            missing += int(np.isnan(moves).sum())
            moves = np.nan_to_num(moves)
            worst[k] = max(worst[k], moves.max() / step)
            # ten finer steps in each of those that moved most
            starts = (starts[np.argsort(moves)[-WORST:], None] + step * np.arange(10) / 10).ravel()
    return worst, missing


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--lines", type=int, default=24)
    parser.add_argument("--length", type=float, default=0.4)
    given = parser.parse_args()
    table = Table("worst |dx| / step", "rho", *(f"{s:g}" for s in STEPS), "no answer")
    cases: list[tuple[Peer, float]] = [
        (Ours(warm=True), 0.1),
        (Ours(warm=True), 0.0),
        (Cascade("quadprog", frozen=True), 0.1),
        (DaqpHierarchy(), 0.0),
        (Weighted(), 0.0),
    ]
    for peer, rho in cases:
        worst, missing = slopes(peer, rho, given.lines, given.length)
        table.add_row(peer.name, f"{rho:g}", *(f"{slope:.0f}" for slope in worst), f"{missing}")
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
