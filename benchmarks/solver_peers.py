"""The solver beside what PyPI has, on the robot's shape.

N = 19, a box, levels 3, 3, 3, 3, 3, 2, 2, rho 0.1.

Peers: one QP after the other (quadprog, the oracle of the tests), and all levels in one weighted QP
(daqp), which is not the same problem. Every figure is a ratio to ours in the same process; |dx| is
the distance to the cascade.

    python benchmarks/solver_peers.py [--problems 100]
"""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from ctypes import c_int
from pathlib import Path

import daqp
import numpy as np
from rich.console import Console
from rich.table import Table

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "python"))

from hierarchies import box, equality, to_levels, unit_rows
from hurcules import rhqp
from oracle import Oracle, Rows

N, ROWS, RHO = 19, (3, 3, 3, 3, 3, 2, 2), 0.1


def problem(rng: np.random.Generator, width: float, reach: float) -> list[Rows]:
    """Levels over a box of half that width; targets up to `reach` make it bind."""
    x = rng.uniform(-0.3, 0.3, N)
    levels = [box(N, width, rng)]
    for m in ROWS:
        A = unit_rows(m, N, rng)
        levels.append(equality(A, A @ x if reach == 0 else rng.uniform(-reach, reach, m), RHO))
    return levels


def weighted(levels: list[Rows]) -> tuple:
    """One QP, a level ten times the next."""
    H, f = 1e-6 * np.eye(N), np.zeros(N)
    for k, level in enumerate(levels[1:]):
        weight = 10.0 ** -(2 * k)
        H += weight * level.A.T @ level.A
        f -= weight * level.A.T @ level.lower
    return H, f, np.zeros((0, N)), levels[0].upper, levels[0].lower, np.zeros(N, dtype=c_int)


def median_us(calls: list[Callable[[], object]]) -> float:
    """Median time of the calls [us]."""
    times = []
    for call in calls:
        begin = time.perf_counter()
        call()
        times.append(time.perf_counter() - begin)
    return 1e6 * float(np.median(times))


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--problems", type=int, default=100)
    count = parser.parse_args().problems
    table = Table(
        "set",
        "ours cold [us]",
        "ours warm",
        "quadprog cascade",
        "daqp, one weighted QP",
        "worst |dx| to cascade",
        title=f"median of {count} problems; columns 3 to 5 as ratios to ours cold",
    )
    for name, width, reach in (("no conflict", 5.0, 0.0), ("box conflicts", 0.5, 2.0)):
        rng = np.random.default_rng(1)
        problems = [problem(rng, width, reach) for _ in range(count)]
        levels = [to_levels(p) for p in problems]
        solvers = [rhqp.Solver(N) for _ in problems]
        cold = median_us(
            [lambda s=s, p=p: s.solve(p) for s, p in zip(solvers, levels, strict=True)]
        )
        warm = median_us(
            [lambda s=s, p=p: s.solve(p) for s, p in zip(solvers, levels, strict=True)]
        )
        cascade = median_us([lambda p=p: Oracle(N).solve(p) for p in problems])
        arguments = [weighted(p) for p in problems]
        one = median_us([lambda a=a: daqp.solve(*a) for a in arguments])
        off = max(
            float(np.abs(s.solve(p).x - Oracle(N).solve(q)).max())
            for s, p, q in zip(solvers, levels, problems, strict=True)
        )
        table.add_row(
            name,
            f"{cold:.1f}",
            f"{warm / cold:.2f}",
            f"{cascade / cold:.1f}",
            f"{one / cold:.2f}",
            f"{off:.1e}",
        )
    Console().print(table)


if __name__ == "__main__":
    main()
