"""hurcules.rhqp from Python.

The face, properties of the definition, and what bad input is answered with.

Strategy: properties on seeded problems and answers that a hand can compute. Not tested here:
agreement with an independent solver (test_solver_oracle.py) and allocation (C++ tests).
"""

from __future__ import annotations

import numpy as np
import pytest

import hurcules
from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from test_solver_oracle import difference


def problem(seed: int, name: str = "box_conflict") -> tuple[int, list]:
    return CLASSES[name](np.random.default_rng([seed, len(name)]))


def test_solution_carries_what_the_interface_promises() -> None:
    n, levels = problem(1)
    solution = rhqp.Solver(n).solve(to_levels(levels))
    assert solution.x.shape == (n,)
    assert [v.shape for v in solution.violations] == [level.lower.shape for level in levels]
    for level, violation in zip(levels, solution.violations, strict=True):
        value = level.A @ solution.x
        np.testing.assert_allclose(
            violation, value - np.clip(value, level.lower, level.upper), atol=1e-12
        )
    assert solution.factorizations >= len(levels)
    for active in solution.working_set:
        level = levels[active.level]
        limit = level.upper if active.side == rhqp.Side.Upper else level.lower
        assert active.level <= active.held_by
        if active.level < active.held_by and limit[active.row] != 0 and active.multiplier > 1e-9:
            assert level.A[active.row] @ solution.x == pytest.approx(limit[active.row], abs=1e-9)


def test_multipliers_balance_the_gradient_of_each_level() -> None:
    """rho^2 (x_k - x_{k-1}) + sum_j A_j' mu_kj = 0 on all of R^n  [T 3.4.100-116]."""
    for seed in range(30):
        n, levels = problem(seed)
        if levels[1].rho == 0:
            continue
        solution = rhqp.Solver(n).solve(to_levels(levels))
        x_above = np.zeros(n)
        for k in range(1, len(levels) + 1):
            x = rhqp.Solver(n).solve(to_levels(levels[:k])).x
            if k > 1:
                mu = solution.multipliers[k - 1]
                g = levels[k - 1].rho ** 2 * (x - x_above)
                g = g + sum(levels[j].A.T @ mu[j] for j in range(k))
                assert np.linalg.norm(g) < 1e-8 * max(1.0, max(np.linalg.norm(m) for m in mu))
            x_above = x


@pytest.mark.parametrize("name", CLASSES)
def test_warm_equals_cold_on_a_walk(name: str) -> None:
    for seed in range(40):
        n, levels = problem(seed, name)
        rng = np.random.default_rng(seed)
        warm = rhqp.Solver(n)
        for _ in range(8):
            for level in levels:
                if not level.bounds and level.lower.size:
                    shift = 0.02 * rng.standard_normal(level.lower.size)
                    level.lower, level.upper = level.lower + shift, level.upper + shift
            cold = rhqp.Solver(n).solve(to_levels(levels))
            assert difference(warm.solve(to_levels(levels)).x, cold.x) < 1e-6, f"{name} {seed}"


def takes_more_than_one_factorization(name: str, problems: int) -> list[int]:
    """Seeds whose second, unchanged solve factors a level twice or changes a working set."""
    seeds = []
    for seed in range(problems):
        n, levels = problem(seed, name)
        solver = rhqp.Solver(n)
        cold = solver.solve(to_levels(levels))
        warm = solver.solve(to_levels(levels))
        assert difference(warm.x, cold.x) < 1e-8, f"{name}, seed {seed}"
        filled = sum(level.lower.size > 0 for level in levels)
        if warm.factorizations != filled or warm.changes:
            seeds.append(seed)
    return seeds


# share of problems whose known set may be refused, of 200 measured: where held rows depend on each
# other, exactly (4.5 % and 1 %) or but for 1e-8 (0.5 %: a row broken by 4e-13 at the cold answer)
REFUSED = {"degenerate": 0.06, "whole_numbers": 0.06, "near_singular": 0.005}
INDEPENDENT = [name for name in CLASSES if name not in REFUSED]


@pytest.mark.parametrize("name", INDEPENDENT)
def test_one_factorization_a_level_when_warm_and_unchanged(name: str) -> None:
    assert takes_more_than_one_factorization(name, 200) == []


@pytest.mark.parametrize("name", REFUSED)
def test_one_factorization_mostly_where_held_rows_depend_on_each_other(name: str) -> None:
    assert len(takes_more_than_one_factorization(name, 200)) <= REFUSED[name] * 200


def test_row_order_and_scale_of_a_level_change_nothing() -> None:
    for seed in range(40):
        n, levels = problem(seed, "mixed")
        before = rhqp.Solver(n).solve(to_levels(levels)).x
        rng = np.random.default_rng(seed)
        for level in levels:
            if level.bounds:
                continue
            order = rng.permutation(level.lower.size)
            scale = float(rng.uniform(0.5, 2.0))
            # a level scaled by s with rho scaled by s is the same level
            level.A, level.rho = level.A[order] * scale, level.rho * scale
            level.lower, level.upper = level.lower[order] * scale, level.upper[order] * scale
        assert difference(rhqp.Solver(n).solve(to_levels(levels)).x, before) < 1e-7, f"seed {seed}"


def test_rows_of_a_level_may_differ_in_length_by_ten_million() -> None:
    limits = rhqp.Bounds(np.full(12, -3.0), np.full(12, 3.0))
    for seed in range(100):
        rng = np.random.default_rng(seed)
        levels, rows = [limits], []
        for _ in range(3):
            A, wish = rng.normal(size=(6, 12)), 2.0 * rng.normal(size=6)
            slack = np.abs(rng.normal(size=6)) * (rng.random(6) < 0.4)
            length = 10.0 ** rng.uniform(-3.5, 3.5, 6)
            levels.append(
                rhqp.Level(length[:, None] * A, length * (wish - slack), length * (wish + slack))
            )
            rows.append(length)
        whole = rhqp.Solver(12).solve(levels)
        for k in range(2, 4):
            above = rhqp.Solver(12).solve(levels[:k])
            for length, alone, beside in zip(
                rows[: k - 1], above.violations[1:], whole.violations[1:], strict=False
            ):
                np.testing.assert_allclose(beside / length, alone / length, atol=1e-8)


def test_absent_sides_are_infinite_or_large() -> None:
    rows = np.array([[1.0, 0.0]])
    goal = rhqp.Level(np.eye(2), np.array([3.0, 1.0]), np.array([3.0, 1.0]))
    x = [
        rhqp.Solver(2).solve([rhqp.Level(rows, np.array([low]), np.array([2.0])), goal]).x
        for low in (-np.inf, -1e20, -1e30)
    ]
    for each in x:
        np.testing.assert_allclose(each, [2.0, 1.0], atol=1e-12)


def test_reset_makes_the_next_solve_cold() -> None:
    n, levels = problem(3)
    solver = rhqp.Solver(n)
    cold = solver.solve(to_levels(levels))
    assert solver.solve(to_levels(levels)).changes == 0
    solver.reset()
    again = solver.solve(to_levels(levels))
    assert again.changes == cold.changes > 0
    assert np.array_equal(again.x, cold.x)


def test_a_solution_does_not_change_with_the_next_solve() -> None:
    n, levels = problem(4)
    solver = rhqp.Solver(n)
    solution = solver.solve(to_levels(levels))
    kept = solution.x.copy()
    solver.solve(to_levels(levels[:1]))
    assert np.array_equal(solution.x, kept)


def test_iteration_limit_is_a_status_with_a_feasible_point() -> None:
    n, levels = next(problem(s) for s in range(99) if problem(s)[0] > 10)
    solver = rhqp.Solver(n, rhqp.SolverOptions(max_changes=1))
    solution = solver.solve(to_levels(levels))
    assert solution.status == rhqp.Status.IterationLimit
    assert np.abs(solution.violations[0]).max() < 1e-12
    assert solution.final_levels < len(levels)


@pytest.mark.parametrize(
    ("make", "text"),
    [
        (lambda: rhqp.Level(np.eye(2), np.zeros(3), np.zeros(3)), "A must be (3, 2)"),
        (lambda: rhqp.Level(np.eye(2), np.zeros(2), np.zeros(3)), "one length, got 2 and 3"),
        (
            lambda: rhqp.Level(np.eye(2), np.ones(2), np.zeros(2)),
            "row 0: lower must not exceed upper",
        ),
        (lambda: rhqp.Level(np.eye(2) * np.nan, np.zeros(2), np.ones(2)), "A must be finite"),
        (lambda: rhqp.Level(np.eye(2), np.array([0, np.nan]), np.ones(2)), "row 1: a bound is NaN"),
        (
            lambda: rhqp.Level(np.eye(2), np.zeros(2), np.ones(2), rho=-1.0),
            "rho must be finite and >= 0",
        ),
        (lambda: rhqp.Bounds(np.ones(2), np.zeros(2)), "lower must not exceed upper"),
        (
            lambda: rhqp.Level(np.ones(2), np.zeros(2), np.ones(2)),
            "shape (m, n), (2,) of float64 came",
        ),
        (
            lambda: rhqp.Level(np.eye(2), 0.0, np.ones(2)),
            "lower wants real numbers of shape (m,), () of",
        ),
        (lambda: rhqp.Level(np.eye(2) * 1j, np.zeros(2), np.ones(2)), "(2, 2) of complex128 came"),
        (
            lambda: rhqp.Level([[1, 2], [3]], np.zeros(2), np.ones(2)),
            "A wants real numbers of shape (m, n)",
        ),
        (
            lambda: rhqp.Level(np.eye(2), np.zeros(2), np.ones(2), rho="x"),
            "rho wants a number >= 0, got 'x'",
        ),
        (lambda: rhqp.Solver(2).solve(None), "solve wants a list of Level and Bounds, got None"),
        (lambda: rhqp.Solver(2).solve([1]), "level 0 wants to be a Level or Bounds, got 1"),
        (lambda: rhqp.Solver(10**9), "takes up to 10000 unknowns, got 1000000000"),
        (lambda: rhqp.Solver(0), "at least one unknown"),
        (
            lambda: rhqp.Solver(2, rhqp.SolverOptions(method="magic")),
            "'magic' does not exist; there are: lexicographic",
        ),
        (lambda: rhqp.Solver(2, rhqp.SolverOptions(max_changes=0)), "max_changes must be positive"),
        (
            lambda: rhqp.Solver(3).solve([rhqp.Level(np.eye(2), np.zeros(2), np.ones(2))]),
            "level 0: A must be (2, 3)",
        ),
        (
            lambda: rhqp.Solver(3).solve([rhqp.Bounds(np.zeros(2), np.ones(2))]),
            "bounds must have length 3",
        ),
    ],
)
def test_bad_input_says_what_was_wanted_and_what_came(make, text: str) -> None:
    with pytest.raises(hurcules.Error) as error:
        make()
    assert text in str(error.value)
    assert isinstance(error.value, ValueError)
