"""The solver against an independent oracle on thousands of seeded problems (solver.md section 1).

Strategy: each level is handed to quadprog (oracle.py), which shares nothing with the C++ solver; x
must agree to 1e-6 of its size. Every problem is cold; warm starts are compared with cold ones in
test_solver.py. Not tested here: speed. HURCULES_PROBLEMS sets the number of problems a class (bulk
runs are this test with a larger count).
"""

from __future__ import annotations

import os
from pathlib import Path

import numpy as np
import pytest

from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from oracle import Oracle, Rows, equality_rows_only

PROBLEMS = int(os.environ.get("HURCULES_PROBLEMS", "750"))
AGREES = 1e-6


def difference(x: np.ndarray, reference: np.ndarray) -> float:
    return float(np.abs(x - reference).max() / max(1.0, np.abs(reference).max()))


def report(folder: Path, name: str, seed: int, levels: list[Rows], text: str) -> str:
    """Writes the failing input so that it can be loaded, and says how to make it again."""
    path = folder / f"{name}_{seed}.txt"
    with np.printoptions(precision=17, threshold=10**6):
        path.write_text("\n".join(repr(level) for level in levels))
    return f"{name}, seed {seed}: {text}; rng = default_rng([{seed}, {len(name)}]); input in {path}"


@pytest.mark.parametrize("name", CLASSES)
def test_agrees_with_the_oracle(name: str, tmp_path: Path) -> None:
    wrong = []
    for seed in range(PROBLEMS):
        n, levels = CLASSES[name](np.random.default_rng([seed, len(name)]))
        solution = rhqp.Solver(n).solve(to_levels(levels))
        reference = Oracle(n).solve(levels)
        off = difference(solution.x, reference)
        if off > AGREES or solution.optimality > 1e-6 or solution.status != rhqp.Status.Solved:
            text = f"|dx| {off:.1e}, optimality {solution.optimality:.1e}, {solution.status}"
            wrong.append(report(tmp_path, name, seed, levels, text))
    assert not wrong, f"{len(wrong)} of {PROBLEMS} wrong:\n" + "\n".join(wrong[:5])


def test_the_oracle_tells_right_from_wrong() -> None:
    """Negative control: leaving out the limits of a binding box is found on most problems."""
    found = 0
    for seed in range(50):
        n, levels = CLASSES["box_conflict"](np.random.default_rng([seed, len("box_conflict")]))
        without = rhqp.Solver(n).solve(to_levels(levels[1:]))
        found += difference(without.x, Oracle(n).solve(levels)) > AGREES
    assert found > 40


def test_the_oracle_agrees_with_the_recursion_for_equalities() -> None:
    """Equality rows only.

    The closed recursion (3.3.36)-(3.3.39) by SVD, a second oracle for the first.
    """
    for seed in range(100):
        n, levels = CLASSES["no_conflict"](np.random.default_rng([seed, 3]))
        levels = [level for level in levels if not level.bounds]
        assert difference(Oracle(n).solve(levels), equality_rows_only(n, levels)) < 1e-9
