"""The solver beside what PyPI has, on the robot's shape: n = 19, a box, levels 3,3,3,3,3,2,2.

Peers: daqp's hierarchy, one QP after the other (quadprog; proxsuite if installed), and all levels
in one weighted QP, which is not the same problem. Times are ratios to ours, cold, in the same
process and through the same Python, the least of several rounds for each problem. None of the peers
is regularised, so all answers are for rho = 0. An answer is off when the violation of some level is
not the exact one (that of the tests' oracle) to 1e-6; by how much is told for the first such level,
since what comes below it is then another problem.

    python benchmarks/solver_peers.py [--problems 100] [--rounds 3]
"""

from __future__ import annotations

import argparse

import numpy as np
from motions import CONFLICTS, Conflict, N, problem, with_rho
from peers import Cascade, DaqpHierarchy, Ours, Peer, Weighted, attempt, proxsuite, violations
from rich.console import Console
from rich.table import Table

from oracle import Oracle, Rows

OFF, WRONG = 1e-6, 1e-3


def peers() -> list[Peer]:
    """Ours first."""
    cascades = ["quadprog", *(["proxsuite"] if proxsuite else [])]
    return [Ours(), DaqpHierarchy(), *(Cascade(name) for name in cascades), Weighted()]


def first_difference(mine: np.ndarray, exact: np.ndarray) -> float:
    """By how much the violation of the first level that is off is off; 0 if none is."""
    off = np.flatnonzero(np.abs(mine - exact) > OFF)
    return float(abs(mine[off[0]] - exact[off[0]])) if len(off) else 0.0


def least(peer: Peer, problems: list[list[Rows]], rounds: int) -> list[tuple]:
    """Answer and least time of each problem; a round goes over all problems."""
    runs = [[attempt(peer, p) for p in problems] for _ in range(rounds)]
    return [
        (tries[-1][0], min(seconds for _, seconds in tries)) for tries in zip(*runs, strict=True)
    ]


def regularised(problems: list[list[Rows]], rounds: int) -> dict[str, list[tuple]]:
    """Ours as we advise it, cold and the second time that a solver sees the same problem."""
    given = [with_rho(p, 0.1) for p in problems]
    warm = Ours(warm=True)
    return {
        "hurcules, rho 0.1": least(Ours(), given, rounds),
        "hurcules, rho 0.1, warm": [least(warm, [p], rounds + 1)[0] for p in given],
    }


def compare(conflict: Conflict, count: int, rounds: int) -> list[list[str]]:
    """A row of the table for each peer."""
    rng = np.random.default_rng(1)
    problems = [problem(conflict, rng) for _ in range(count)]
    exact = [violations(p, Oracle(N).solve(p)) for p in problems]
    runs = {peer.name: least(peer, problems, rounds) for peer in peers()}
    ours = float(np.median([seconds for _, seconds in runs["hurcules"]]))
    judged = {name: errors(run, problems, exact) for name, run in runs.items()}
    runs |= regularised(problems, rounds)
    rows = [[n, *times(run, ours), *judged.get(n, ("", "", ""))] for n, run in runs.items()]
    return [[f"{conflict.name}, {1e6 * ours:.1f} us", *rows[0]], *(["", *row] for row in rows[1:])]


def times(run: list[tuple], ours: float) -> list[str]:
    """Median as a ratio to ours, and p99 to the median."""
    seconds = np.array([s for _, s in run])
    median = np.nanmedian(seconds)
    return [f"{median / ours:.2f}", f"{np.nanquantile(seconds, 0.99) / median:.1f}"]


def errors(run: list[tuple], problems: list[list[Rows]], exact: list[np.ndarray]) -> list[str]:
    """How many answers are off or missing, off by 1e-3, and by how much at most."""
    failed = sum(x is None for x, _ in run)
    excesses = np.array(
        [
            first_difference(violations(p, x), e)
            for (x, _), p, e in zip(run, problems, exact, strict=True)
            if x is not None
        ]
    )
    missing = f", {failed} failed" if failed else ""
    return [
        f"{np.sum(excesses > 0.0)}{missing}",
        f"{np.sum(excesses > WRONG)}",
        f"{excesses.max(initial=0.0):.0e}",
    ]


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--problems", type=int, default=100)
    parser.add_argument("--rounds", type=int, default=3)
    given = parser.parse_args()
    table = Table(
        "set, ours [us]",
        "solver",
        "time / ours",
        "p99 / median",
        "off",
        "by 1e-3",
        "at most",
        title=f"{given.problems} problems a set; cold and rho 0 unless said",
    )
    for conflict in CONFLICTS:
        for row in compare(conflict, given.problems, given.rounds):
            table.add_row(*row)
        table.add_section()
    Console(width=120).print(table)


if __name__ == "__main__":
    main()
