"""Does the answer jump? Worst |dx| / step along paths of hierarchies, step by step finer.

The hierarchies are those of "conflicting levels" (n = 19, a box, rows of lower levels in the span
of those above). Along a path either the targets move, or all rows turn together against the box,
or one row of a level comes to depend on others and leaves them again (those of its own level, a
kinematic singularity, or of the level above, an algorithmic one; "box conflicts", else independent
rows), by a speed of one. A continuous answer has a slope that settles as the step shrinks, a jump
one that grows tenfold with each column. Finer steps are taken where the coarser ones moved most.

With targets that move, our answer is continuous by its definition. With rows that turn, no strict
hierarchy is: where levels hold x at a corner of its limits, a small turn can open or shut the only
way that a lower level has. With a row that comes to depend on others the strict rule jumps where a
rank changes; smooth hand-over does not, from the regularised levels to the regularised.

    python benchmarks/continuity.py [--paths 24] [--length 0.4]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable

import numpy as np
from motions import CONFLICTS, N, problem, with_rho
from peers import Cascade, DaqpHierarchy, Ours, Peer, Weighted, attempt
from rich.console import Console
from rich.table import Table

from oracle import Rows

STEPS = (2e-3, 2e-4, 2e-5, 2e-6)
WORST = 5  # steps of a line that are taken again in ten finer ones


Path = Callable[[float], list[Rows]]


def targets_move(rng: np.random.Generator) -> Path:
    """The targets of all levels but the box move along a direction of unit length."""
    box, *levels = problem(CONFLICTS[2], rng)
    direction = [rng.normal(size=len(v.lower)) for v in levels]
    length = np.linalg.norm(np.concatenate(direction))
    along = [(v, d / length) for v, d in zip(levels, direction, strict=True)]
    return lambda s: [box, *(Rows(v.A, v.lower + s * d, v.upper + s * d) for v, d in along)]


def rows_turn(rng: np.random.Generator) -> Path:
    """All rows turn together, so that what depends on each other goes on doing so."""
    box, *levels = problem(CONFLICTS[2], rng)
    K = rng.normal(size=(N, N))
    K = (K - K.T) / np.linalg.norm(K - K.T, 2)
    return lambda s: [box, *(Rows(v.A + s * v.A @ K, v.lower, v.upper) for v in levels)]


def row_weakens(rng: np.random.Generator, above: bool) -> Path:
    """Row 2 of the second level leaves the span of rows of its own level, or of that above."""
    levels = problem(CONFLICTS[1], rng)
    weak = levels[2]
    source = levels[1].A if above else weak.A[:2]
    inside = rng.normal(size=len(source)) @ source
    inside /= np.linalg.norm(inside)
    outside = rng.normal(size=N)
    outside -= outside @ inside * inside
    outside /= np.linalg.norm(outside)

    def at(s: float) -> list[Rows]:
        # a third of a step beside the dependence itself, so that no grid meets it
        sigma = s - 0.2 + STEPS[0] / 3
        A = weak.A.copy()
        A[2] = np.sqrt(1 - sigma**2) * inside + sigma * outside
        return [*levels[:2], Rows(A, weak.lower, weak.upper), *levels[3:]]

    return at


def row_weakens_in_its_level(rng: np.random.Generator) -> Path:
    """Kinematic singularity."""
    return row_weakens(rng, above=False)


def row_weakens_on_the_level_above(rng: np.random.Generator) -> Path:
    """Algorithmic singularity."""
    return row_weakens(rng, above=True)


KINDS: dict[str, Callable[[np.random.Generator], Path]] = {
    "targets move": targets_move,
    "rows turn": rows_turn,
    "row weakens, own level": row_weakens_in_its_level,
    "row weakens, level above": row_weakens_on_the_level_above,
}


def move(peer: Peer, path: Path, rho: float, s: float, step: float) -> float:
    """|dx| from s to s + step; not a number where an answer is missing."""
    before, after = (attempt(peer, with_rho(path(at), rho))[0] for at in (s, s + step))
    return np.nan if before is None or after is None else float(np.linalg.norm(after - before))


def worst_slopes(
    peer: Peer, rho: float, paths: list[Path], length: float
) -> tuple[list[float], int]:
    """Worst slope over all paths for each size of step, and the number of missing steps."""
    worst, missing = [0.0] * len(STEPS), 0
    for path in paths:
        starts = np.arange(0.0, length, STEPS[0])
        for k, step in enumerate(STEPS):
            moves = np.array([move(peer, path, rho, s, step) for s in starts])
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
    parser.add_argument("--paths", type=int, default=24)
    parser.add_argument("--length", type=float, default=0.4)
    given = parser.parse_args()
    table = Table("worst |dx| / step", "solver", "rho", *(f"{s:g}" for s in STEPS), "no answer")
    cases: list[tuple[Peer, float]] = [
        (Ours(warm=True), 0.1),
        (Ours(warm=True, handover="smooth"), 0.1),
        (Ours(warm=True), 0.0),
        (Cascade("quadprog", frozen=True), 0.1),
        (DaqpHierarchy(), 0.0),
        (Weighted(), 0.0),
    ]
    for name, kind in KINDS.items():
        rng = np.random.default_rng(1)
        paths = [kind(rng) for _ in range(given.paths)]
        for peer, rho in cases:
            worst, missing = worst_slopes(peer, rho, paths, given.length)
            figures = (f"{slope:.0f}" for slope in worst)
            table.add_row(name, peer.name, f"{rho:g}", *figures, f"{missing}")
        table.add_section()
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
