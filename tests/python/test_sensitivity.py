"""jvp and vjp of a solution against central finite differences of the solver itself.

Strategy: a random direction in all numbers of a hierarchy (A, lower, upper, rho together) over all
classes of hierarchies.py. A problem counts where the derivative exists: working set, violated rows
and ranks are the same on both sides of the point, and two steps, one of ten times the other, give
one difference to 1e-5: near a singular value of 1e-7 the difference itself is not known better.
Each class says how many must count. jvp and vjp are adjoint on all problems, counted or not.
HURCULES_PROBLEMS sets the number of problems a class.
"""

from __future__ import annotations

import os
from collections.abc import Iterator

import numpy as np
import pytest

import hurcules
from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from oracle import Rows

PROBLEMS = int(os.environ.get("HURCULES_PROBLEMS", "300"))
STEP = 1e-6

Generator = np.random.Generator


def direction(levels: list[Rows], rng: Generator, rows: str) -> list[rhqp.LevelChange]:
    """A random change of every number; equality rows stay equalities.

    rows: "stand"; "move", each by itself; or "turn", all by one matrix, so that rows which depend
    on each other still do.
    """
    n = levels[0].A.shape[1]
    turn = rng.standard_normal((n, n))
    changes = []
    for level in levels:
        lower = rng.standard_normal(level.lower.shape)
        upper = np.where(level.equal, lower, rng.standard_normal(level.lower.shape))
        A = rng.standard_normal(level.A.shape) if rows == "move" else level.A @ turn
        rho = 0.1 * float(rng.standard_normal()) if level.rho > 0 else 0.0
        stands = rows == "stand" or level.bounds
        changes.append(rhqp.LevelChange(None if stands else A, lower, upper, rho))
    return changes


def moved(levels: list[Rows], changes: list[rhqp.LevelChange], by: float) -> list[Rows]:
    return [
        Rows(
            level.A if change.A is None else level.A + by * change.A,
            level.lower + by * (0.0 if change.lower is None else change.lower),
            level.upper + by * (0.0 if change.upper is None else change.upper),
            level.rho + by * change.rho,
            level.bounds,
        )
        for level, change in zip(levels, changes, strict=True)
    ]


def piece(solution: rhqp.Solution) -> tuple:
    """What must stay the same for x to be smooth: who is held by whom, who is violated, ranks."""
    held = {(r.level, r.row, r.side.value, r.held_by) for r in solution.working_set}
    violated = [tuple(np.sign(np.where(np.abs(v) > 1e-9, v, 0.0))) for v in solution.violations]
    return held, violated, [level.rank for level in solution.levels]


def difference(
    n: int, levels: list[Rows], changes: list[rhqp.LevelChange], step: float
) -> np.ndarray | None:
    """Central difference of x, or None where x has a kink or a jump."""
    here = piece(rhqp.Solver(n).solve(to_levels(levels)))
    sides = [rhqp.Solver(n).solve(to_levels(moved(levels, changes, by))) for by in (-step, step)]
    if any(side.status != rhqp.Status.Solved or piece(side) != here for side in sides):
        return None
    return (sides[1].x - sides[0].x) / (2.0 * step)


def cases(name: str, rows: str) -> Iterator[tuple]:
    """(seed, solution, changes, difference) where the difference exists."""
    for seed in range(PROBLEMS):
        rng = np.random.default_rng([seed, len(name)])
        n, levels = CLASSES[name](rng)
        changes = direction(levels, rng, rows)
        wide, narrow = (difference(n, levels, changes, step) for step in (10 * STEP, STEP))
        if wide is None or narrow is None:
            continue
        if np.linalg.norm(wide - narrow) < 1e-5 * max(1.0, float(np.linalg.norm(narrow))):
            yield seed, rhqp.Solver(n).solve(to_levels(levels)), changes, narrow


# Share of the problems that must count, a tenth or more below what was found: which of the rows
# that depend on each other are held is the solver's choice, and may be another on both sides.
COUNTED = {
    "stand": [0.8, 0.6, 0.7, 0.8, 0.6, 0.7, 0.5],
    "move": [0.8, 0.5, 0.25, 0.8, 0.35, 0.2, 0.35],  # rows that move alone no longer depend
    "turn": [0.8, 0.6, 0.7, 0.8, 0.5, 0.6, 0.5],
}


@pytest.mark.parametrize("rows", COUNTED)
@pytest.mark.parametrize("name", CLASSES)
def test_jvp_is_the_derivative(name: str, rows: str) -> None:
    compared, wrong = 0, []
    for seed, solution, changes, wanted in cases(name, rows):
        compared += 1
        error = float(np.linalg.norm(solution.jvp(changes) - wanted))
        if error > 1e-5 * max(1.0, float(np.linalg.norm(wanted))):
            wrong.append((seed, error))
    assert wrong == [], f"{len(wrong)} of {compared}; rng = default_rng([seed, {len(name)}])"
    assert compared >= COUNTED[rows][list(CLASSES).index(name)] * PROBLEMS


@pytest.mark.parametrize("rho", [1e-4, 1e-8])
@pytest.mark.parametrize("name", ["box_conflict", "mixed"])
def test_jvp_is_the_derivative_when_rho_is_next_to_nothing(name: str, rho: float) -> None:
    """Rounding of the violation would be divided by rho^2; targets and limits move."""
    compared = 0
    for seed in range(PROBLEMS // 3):
        rng = np.random.default_rng([seed, len(name)])
        n, levels = CLASSES[name](rng)
        for level in levels:
            level.rho = 0.0 if level.bounds else rho
        changes = [
            rhqp.LevelChange(lower=c.lower, upper=c.upper) for c in direction(levels, rng, "stand")
        ]
        wanted = difference(n, levels, changes, STEP)
        if wanted is None:
            continue
        got = rhqp.Solver(n).solve(to_levels(levels)).jvp(changes)
        np.testing.assert_allclose(got, wanted, atol=1e-5 * max(1.0, np.abs(wanted).max()))
        compared += 1
    assert compared >= 0.5 * (PROBLEMS // 3)


def inner(a: list[rhqp.LevelChange], b: list[rhqp.LevelChange]) -> tuple[float, float]:
    """The sum of all products, and the sum of their sizes."""
    products = [np.array([x.rho * y.rho for x, y in zip(a, b, strict=True)])]
    for x, y in zip(a, b, strict=True):
        for u, v in ((x.A, y.A), (x.lower, y.lower), (x.upper, y.upper)):
            if u is not None and v is not None:
                products.append((u * v).ravel())
    every = np.concatenate(products)
    return float(every.sum()), float(np.abs(every).sum())


@pytest.mark.parametrize("name", CLASSES)
def test_vjp_is_jvp_transposed(name: str) -> None:
    """<x_bar, jvp(d)> = <vjp(x_bar), d> to 1e-12 of the terms, rho > 0 and rho = 0."""
    for seed in range(PROBLEMS):
        rng = np.random.default_rng([seed, len(name)])
        n, levels = CLASSES[name](rng)
        solution = rhqp.Solver(n).solve(to_levels(levels))
        changes, x_bar = direction(levels, rng, "move"), rng.standard_normal(n)
        forward = float(x_bar @ solution.jvp(changes))
        backward, size = inner(solution.vjp(x_bar), changes)
        assert abs(forward - backward) <= 1e-12 * max(1.0, size), f"seed {seed}"


def test_vjp_of_equality_rows_is_the_filter_of_the_thesis() -> None:
    """One level: dx/db = A' (A A' + rho^2)^-1  [T 3.3.38]."""
    rng = np.random.default_rng(0)
    A, b = rng.standard_normal((3, 7)), rng.standard_normal(3)
    solution = rhqp.Solver(7).solve([rhqp.Level(A, b, b, 0.2)])
    wanted = A.T @ np.linalg.inv(A @ A.T + 0.04 * np.eye(3))
    rows = [solution.vjp(unit)[0] for unit in np.eye(7)]
    got = np.array([row.lower + row.upper for row in rows])
    np.testing.assert_allclose(got, wanted, atol=1e-13)


def test_sensitivity_is_that_of_its_solve_whatever_comes_later() -> None:
    n, levels = CLASSES["mixed"](np.random.default_rng(5))
    held = to_levels(levels)
    solver = rhqp.Solver(n)
    solution = solver.solve(held)
    x_bar = np.ones(n)
    wanted = rhqp.Solver(n).solve(held).vjp(x_bar)
    for level in held:
        level.A[...] = 7.0
        level.lower[...], level.upper[...] = -1.0, 1.0
    solver.solve(held)
    del solver
    for got, want in zip(solution.vjp(x_bar), wanted, strict=True):
        np.testing.assert_array_equal(got.lower, want.lower)


def test_changes_left_out_are_no_changes() -> None:
    b = np.array([1.0])
    solution = rhqp.Solver(2).solve(
        [rhqp.Level(np.array([[1.0, 0.0]]), b, b), rhqp.Level(np.array([[0.0, 1.0]]), b, b)]
    )
    np.testing.assert_array_equal(solution.jvp([]), [0.0, 0.0])
    one = rhqp.LevelChange(lower=[1.0], upper=[1.0])
    np.testing.assert_allclose(solution.jvp([None, one]), [0.0, 1.0], atol=1e-15)
    assert solution.vjp([0.0, 1.0])[1].A is not None
    bounds = rhqp.Solver(1).solve([rhqp.Bounds([1.0], [2.0])])
    assert bounds.vjp([1.0])[0].A is None
    np.testing.assert_array_equal(bounds.vjp([1.0])[0].lower, [1.0])


def test_wrong_changes_say_what_was_wanted() -> None:
    b = np.array([1.0])
    solution = rhqp.Solver(2).solve([rhqp.Level(np.array([[1.0, 0.0]]), b, b)])
    for wrong, text in (
        ([rhqp.LevelChange(lower=[1.0, 2.0])], "change of level 0: lower and upper"),
        ([rhqp.LevelChange(A=np.eye(2))], r"change of level 0: A must be \(1, 2\) or empty"),
        ([None, None], "at most 1, got 2"),
        ([1.0], "one is 1.0"),
        (3, "got 3"),
    ):
        with pytest.raises(hurcules.Error, match=text):
            solution.jvp(wrong)  # type: ignore[arg-type]
    with pytest.raises(hurcules.Error, match="length 2, got 1"):
        solution.vjp([1.0])


@pytest.mark.parametrize("method", [m for m in rhqp.method_names() if m != "lexicographic"])
def test_other_methods_say_that_they_have_no_derivative(method: str) -> None:
    b = np.array([1.0])
    level = rhqp.Level(np.array([[1.0, 0.0]]), b, b, 0.1)
    solution = rhqp.Solver(2, rhqp.SolverOptions(method=method)).solve([level])
    assert len(solution.multipliers) == 1
    with pytest.raises(hurcules.Error, match="only the method 'lexicographic'"):
        solution.vjp([1.0, 0.0])
    with pytest.raises(hurcules.Error, match="only the method 'lexicographic'"):
        _ = solution.levels


def test_an_unfinished_solve_has_no_derivative() -> None:
    for seed in range(20):
        n, levels = CLASSES["box_conflict"](np.random.default_rng([seed, 12]))
        solver = rhqp.Solver(n, rhqp.SolverOptions(max_changes=1))
        solution = solver.solve(to_levels(levels))
        if solution.status == rhqp.Status.IterationLimit:
            with pytest.raises(hurcules.Error, match="ended with iteration limit"):
                solution.vjp(np.ones(n))
            return
    pytest.fail("no problem met the limit")
