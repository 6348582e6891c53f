"""solution.levels: rank, singular values, and the violation split into v_k + u_k.

Strategy: closed forms of the thesis where no limit is in the way, and numpy's own least squares on
the rows that a level may not move where limits are held. The violation of a level is meant when the
level is solved; levels below may still improve inequality rows (multipliers[k][k] has it).
"""

from __future__ import annotations

import numpy as np
import pytest

from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from oracle import null_space

PROBLEMS = 100


@pytest.mark.parametrize("rho", [0.0, 0.03, 0.1, 1.0])
def test_split_of_free_levels_is_that_of_the_thesis(rho: float) -> None:
    """With r = y - J x_above: v = -V V'r, u = -U T U'r, T = rho^2 / (sigma^2 + rho^2)."""
    rng = np.random.default_rng(1)
    for n, sizes in ((9, (3, 4)), (4, (2, 5)), (3, (5, 2))):
        x, Z, levels = np.zeros(n), np.eye(n), []
        for m in sizes:
            A, b = rng.standard_normal((m, n)), rng.standard_normal(m)
            levels.append(rhqp.Level(A, b, b, rho))
            report = rhqp.Solver(n).solve(levels).levels[-1]
            if Z.shape[1] == 0:
                assert report.rank == 0 and report.singular_values.size == 0
                continue
            U, sigma, Vt = np.linalg.svd(A @ Z, full_matrices=False)
            r = b - A @ x
            regularized = -U @ (rho**2 / (sigma**2 + rho**2) * (U.T @ r))  # T 3.3.80
            np.testing.assert_allclose(report.singular_values, sigma, atol=1e-13)
            np.testing.assert_allclose(report.regularized, regularized, atol=1e-12)
            np.testing.assert_allclose(report.infeasible, U @ (U.T @ r) - r, atol=1e-12)
            assert report.rank == sigma.size and report.rho == rho
            x = x + Z @ Vt.T @ (sigma / (sigma**2 + rho**2) * (U.T @ r))
            Z = null_space(A, Z)


@pytest.mark.parametrize("name", CLASSES)
def test_the_parts_add_up_and_regularisation_costs_nothing_without_rho(name: str) -> None:
    costly = 0
    for seed in range(PROBLEMS):
        n, levels = CLASSES[name](np.random.default_rng([seed, len(name)]))
        solution = rhqp.Solver(n).solve(to_levels(levels))
        assert sum(report.rank for report in solution.levels) <= n
        for k, report in enumerate(solution.levels):
            total = report.infeasible + report.regularized
            np.testing.assert_allclose(total, solution.multipliers[k][k], atol=1e-12)
            assert report.rho == levels[k].rho
            if report.rho == 0:
                assert not report.regularized.any()
            costly += bool(report.regularized.any())
    assert costly > 20


@pytest.mark.parametrize("name", ["box_conflict", "mixed"])
def test_infeasible_part_is_the_smallest_against_what_holds(name: str) -> None:
    """By numpy: least squares of the violated rows in the directions that nothing above holds."""
    checked = 0
    for seed in range(PROBLEMS):
        n, levels = CLASSES[name](np.random.default_rng([seed, len(name)]))
        solution = rhqp.Solver(n).solve(to_levels(levels))
        for k, level in enumerate(levels):
            if level.rho == 0 or level.bounds:
                continue
            held = [r for r in solution.working_set if r.held_by == k]
            above = [other.A[other.equal] for other in levels[:k]]
            above += [levels[r.level].A[[r.row]] for r in held if r.level < k]
            own = level.equal.copy()
            own[[r.row for r in held if r.level == k]] = True
            Z = null_space(np.vstack([*above, np.zeros((0, n))]), np.eye(n))
            report = solution.levels[k]
            e = (report.infeasible + report.regularized)[own]
            rows = level.A[own] @ Z
            removable = rows @ np.linalg.lstsq(rows, e, rcond=1e-10)[0]
            np.testing.assert_allclose(report.regularized[own], removable, atol=1e-9)
            checked += 1
    assert checked > 100


def test_rank_counts_what_a_level_takes() -> None:
    A, b = np.array([[1.0, 0.0, 0.0]]), np.array([1.0])
    twice, mixed = np.vstack([A, 2 * A]), np.array([[1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    levels = [
        rhqp.Bounds(-np.ones(3), np.ones(3)),
        rhqp.Level(A, b, b),
        rhqp.Level(twice, np.zeros(2), np.zeros(2)),
        rhqp.Level(mixed, np.zeros(2), np.array([0.0, 9.0])),
    ]
    reports = rhqp.Solver(3).solve(levels).levels
    assert [report.rank for report in reports] == [0, 1, 0, 1]
    np.testing.assert_allclose(reports[2].singular_values, [0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(reports[3].singular_values, [1.0], atol=1e-15)
    np.testing.assert_allclose(reports[2].infeasible, [1.0, 2.0], atol=1e-14)


def test_reports_are_of_their_solve_whatever_comes_later() -> None:
    A, b = np.array([[3.0, 4.0]]), np.array([1.0])
    level = rhqp.Level(A, b, b, 0.1)
    solver = rhqp.Solver(2)
    solution = solver.solve([level])
    A[...] = 1.0
    solver.solve([level])
    np.testing.assert_allclose(solution.levels[0].singular_values, [5.0], atol=1e-15)
