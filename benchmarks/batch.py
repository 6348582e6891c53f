"""solve_batch beside a loop: many independent hierarchies, from lists and from stacked arrays.

The hierarchies are those of motions.py, rho 0.1, all of one shape. The loop is one Solver that
forgets its working sets between the problems; the answers are the same bits. Times are the least of
several rounds, in turn, in microseconds a problem; gain: loop / batch.

    python benchmarks/batch.py [--problems 2000] [--rounds 5] [--threads 2]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import numpy as np
from motions import CONFLICTS, N, problem, with_rho
from rich.console import Console
from rich.table import Table

from hierarchies import to_levels
from hurcules import rhqp
from oracle import Rows


def stacked(problems: list[list[Rows]]) -> list[rhqp.LevelStack]:
    """The same hierarchies, an array a level."""
    stacks = []
    for levels in zip(*problems, strict=True):
        A, lower, upper = (
            np.array([getattr(v, a) for v in levels]) for a in ("A", "lower", "upper")
        )
        first = levels[0]
        limits = (lower, upper)
        stacks.append(
            rhqp.BoundsStack(*limits) if first.bounds else rhqp.LevelStack(A, *limits, first.rho)
        )
    return stacks


def in_a_loop(batch: list[list[rhqp.Level]]) -> list[rhqp.Solution]:
    """One solver, cold for each."""
    solver, solutions = rhqp.Solver(N), []
    for levels in batch:
        solver.reset()
        solutions.append(solver.solve(levels))
    return solutions


def differing(calls: dict[str, Callable[[], list[rhqp.Solution]]]) -> int:
    """How many answers have other bits than those of the loop; also warms up."""
    loop, *others = ([s.x.tobytes() for s in call()] for call in calls.values())
    return sum(x != y for other in others for x, y in zip(loop, other, strict=True))


def least(calls: dict[str, Callable[[], list[rhqp.Solution]]], rounds: int) -> dict[str, float]:
    """The least time of each call [s], in turn."""
    best = dict.fromkeys(calls, np.inf)
    for _ in range(rounds):
        for name, call in calls.items():
            begin = time.perf_counter()
            call()
            best[name] = min(best[name], time.perf_counter() - begin)
    return best


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter
    )
    parser.add_argument("--problems", type=int, default=2000)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--threads", type=int, default=2)
    given = parser.parse_args()
    many = given.threads
    table = Table("cold, n = 19", "loop [us]", "gain: lists, 1 thread", f"lists, {many} threads")
    for title in ("stacks, 1 thread", f"stacks, {many} threads", "other bits"):
        table.add_column(title)
    for conflict in CONFLICTS:
        rng = np.random.default_rng(1)
        problems = [with_rho(problem(conflict, rng), 0.1) for _ in range(given.problems)]
        batch, stacks = [to_levels(p) for p in problems], stacked(problems)
        calls = {
            "loop": lambda batch=batch: in_a_loop(batch),
            "lists 1": lambda batch=batch: rhqp.solve_batch(batch, 1),
            "lists": lambda batch=batch: rhqp.solve_batch(batch, many),
            "stacks 1": lambda stacks=stacks: rhqp.solve_batch(stacks, 1),
            "stacks": lambda stacks=stacks: rhqp.solve_batch(stacks, many),
        }
        other_bits = differing(calls)
        loop, *others = least(calls, given.rounds).values()
        gains = (f"{loop / other:.2f}" for other in others)
        table.add_row(conflict.name, f"{1e6 * loop / given.problems:.1f}", *gains, f"{other_bits}")
    Console(width=150).print(table)


if __name__ == "__main__":
    main()
