"""Claims R17 to R24 of the thesis: warm starts, release, cycling, and what regularisation costs.

Strategy as in test_claims_solver.py: Algorithm 1 on the methods named after it, the rest on the
default; "reference" numbers were computed apart from this code, "measured" ones are ours.
"""

from __future__ import annotations

import itertools

import numpy as np
import pytest

from hierarchies import to_levels
from hurcules import rhqp
from test_claims_solver import INF, conflict, equalities, largest, point, solver


def limit_q1(rho: float) -> rhqp.Level:
    """q1' <= 0 of n = 2."""
    return rhqp.Level(np.array([[1.0, 0.0]]), np.array([-INF]), np.array([0.0]), rho=rho)


def box_level(n: int, rho: float) -> rhqp.Level:
    return rhqp.Level(np.eye(n), np.full(n, -0.5), np.full(n, 0.5), rho=rho)


def test_R17_an_infeasible_start_gives_the_same_optimum() -> None:
    """3.4.2. Does not hold for Algorithm 1; holds for the default.

    Not even in the plane of Figure 3.5 (R15): from W = {A} it adds B and may not drop A any more,
    since A was strongly active on the way: (1, 0.5) instead of (1, 0). Started from the working set
    of other targets: default 100 of 100 the same answer as cold, rhqp_thesis 0 of 100 (measured).
    """
    limits = rhqp.Level(np.array([[0.6, 0.8], [1.0, 0.0]]), np.full(2, -INF), np.ones(2))
    first, second = (
        point([[1.0, 0.0], [0.0, 1.0]], goal, 0.0) for goal in ([0.0, 9.0], [3.0, 0.0])
    )
    for method, wanted in (("lexicographic", [1.0, 0.0]), ("rhqp_thesis", [1.0, 0.5])):
        one = solver(2, method)
        assert [row.row for row in one.solve([limits, first]).working_set if row.level == 0] == [0]
        np.testing.assert_allclose(one.solve([limits, second]).x, wanted, atol=1e-12)
    same = {"lexicographic": 0, "rhqp_thesis": 0}
    for seed in range(100):
        levels, other = to_levels(conflict(seed)), conflict(seed)
        rng = np.random.default_rng(1000 + seed)
        for level in other[1:]:
            level.lower = level.upper = rng.uniform(-2, 2, level.lower.size)
        for method in same:
            cold = solver(12, method).solve(levels).x
            warm = solver(12, method)
            warm.solve(to_levels(other))
            same[method] += bool(np.abs(warm.solve(levels).x - cold).max() < 1e-9)
    assert same == {"lexicographic": 100, "rhqp_thesis": 0}


def test_R18_lower_levels_do_not_drop_a_strongly_active_row() -> None:
    """3.4.2: level 1 pushes on x <= 0, level 2 would pull it off: its multiplier is negative."""
    levels = [limit_q1(0.0), point([[1.0, 0.0]], [1.0], 0.1), point([[1.0, 1.0]], [-1.0], 0.1)]
    thesis = solver(2, "rhqp_thesis").solve(levels)
    assert thesis.multipliers[1][0][0] == pytest.approx(1.0)
    assert thesis.multipliers[2][0][0] == pytest.approx(-0.0099, abs=1e-4)
    assert [(row.level, row.row) for row in thesis.working_set] == [(0, 0)]
    np.testing.assert_allclose(thesis.x, [0.0, -1 / 1.01], atol=1e-12)
    np.testing.assert_allclose(solver(2).solve(levels).x, thesis.x, atol=1e-12)


def test_R19_the_damped_inverse_gives_the_same_primal() -> None:
    """3.5.123-126: COD and DLS inverse against SVD; measured 3e-14, with limits 5e-14."""
    for seed in range(100):
        levels = to_levels(equalities(seed))
        ours, dls = solver(9, "rhqp_thesis").solve(levels), solver(9, "dls_hqp").solve(levels)
        np.testing.assert_allclose(dls.x, ours.x, atol=1e-12)
        levels = to_levels(conflict(seed))
        ours, dls = solver(12, "rhqp_thesis").solve(levels), solver(12, "dls_hqp").solve(levels)
        sets = [{(r.level, r.row, r.side) for r in s.working_set} for s in (ours, dls)]
        assert sets[0] == sets[1]
        np.testing.assert_allclose(dls.x, ours.x, atol=1e-11)


@pytest.mark.parametrize("rho", [0.0, 0.1])
def test_R20_rhqp_releases_what_dls_hqp_keeps(rho: float) -> None:
    """3.5, 4.3.4: reference (-0.4975, -0.4975) in 2 iterations; without u_k (0, -0.9901) stays."""
    towards, away = point([[1.0, 1.0]], [1.0], 0.1), point([[1.0, 1.0]], [-1.0], 0.1)
    ended = {}
    for method in ("lexicographic", "rhqp_thesis", "dls_hqp"):
        one = solver(2, method)
        assert len(one.solve([limit_q1(rho), towards]).working_set) == 1
        ended[method] = one.solve([limit_q1(rho), away])
    np.testing.assert_allclose(ended["lexicographic"].x, [-0.4975, -0.4975], atol=5e-5)
    np.testing.assert_allclose(ended["rhqp_thesis"].x, [-0.4975, -0.4975], atol=5e-5)
    assert ended["rhqp_thesis"].changes + 1 == 2
    np.testing.assert_allclose(ended["dls_hqp"].x, [0.0, -0.9901], atol=5e-5)
    assert ended["dls_hqp"].changes == 0
    # and its own residual says that this is not the optimum
    assert ended["dls_hqp"].status == rhqp.Status.ReducedAccuracy
    assert ended["dls_hqp"].optimality > 0.1


def test_R21_without_the_regularisation_error_the_set_cycles() -> None:
    """3.5, Figure 4.16: reference 3 iterations to (-0.495, -0.2827, -0.4762, -0.495)."""
    levels = [
        box_level(4, 0.1),
        point([[1, 0, 1, 2], [1, -0.1, 1.2, 2]], [-2.0, -2.0], 0.1),
        point([[-2, 2, -1, -2], [-2, 2, 1, 2]], [-2.0, 2.0], 0.1),
    ]
    thesis = solver(4, "rhqp_thesis").solve(levels)
    np.testing.assert_allclose(thesis.x, [-0.495, -0.2827, -0.4762, -0.495], atol=1e-4)
    assert thesis.changes + 1 == 3
    for cap in (12, 1000):  # thesis 4.3.3: 12
        dls = solver(4, "dls_hqp", max_iterations=cap).solve(levels)
        assert dls.status == rhqp.Status.IterationLimit
        assert dls.changes + 1 == cap


def test_R22_regularisation_of_a_task_moves_lower_ones() -> None:
    """3.3.80, 4.3.3: 0 without regularisation, growing with it; measured 9.1e-3 at rho = 0.1."""
    moved = []
    for rho in (0.0, 0.01, 0.03, 0.1, 0.3):
        levels = [point([[1.0, 0.0]], [1.0], rho), point([[0.6, 0.8]], [0.0], rho)]
        moved.append(abs(solver(2).solve(levels).violations[1][0]))
    assert moved[0] < 1e-15
    assert all(a < b for a, b in itertools.pairwise(moved))
    # level 0 stops at 1 / (1 + rho^2), level 1 answers by 0.8^2 / (0.8^2 + rho^2)
    assert moved[3] == pytest.approx(0.6 / 1.01 * 0.01 / 0.65, rel=1e-9)


def test_R23_adaptive_regularisation_costs_nothing_away_from_singularity() -> None:
    """3.3.3, 4.3.3: rho^2 = rho_0^2 (1 - (sigma / eps)^2) below eps, else 0; one row (cos, sigma).

    The task asks the row of length sigma for 1: exact above eps, bounded by 1 / (2 rho_0) below.
    """
    rho_0, eps = 0.1, 0.1
    x = []
    for sigma in np.logspace(0, -12, 121):
        rho = rho_0 * np.sqrt(max(0.0, 1.0 - (sigma / eps) ** 2))
        solution = solver(2).solve([point([[0.0, sigma]], [1.0], rho)])
        if sigma >= eps:
            assert abs(solution.violations[0][0]) < 1e-14
        x.append(abs(solution.x[1]))
    assert max(x) < 1.2 / eps
    assert x[-1] < 1e-9


@pytest.mark.parametrize("method", ["rhqp_thesis", "dls_hqp"])
def test_R24_a_regularised_limit_moves_at_99_percent(method: str) -> None:
    """B0.9: sigma^2 / (sigma^2 + rho^2) = 0.990 of the limit at rho = 0.1; the default: all."""
    goal = point([[1.0]], [5.0], 0.1)
    limit = rhqp.Level(np.array([[1.0]]), np.array([-1.0]), np.array([1.0]), rho=0.1)
    assert solver(1, method).solve([limit, goal]).x[0] == pytest.approx(0.990, abs=1e-3)
    exact = rhqp.Bounds(-np.ones(1), np.ones(1))
    assert solver(1).solve([exact, goal]).x[0] == 1.0
    assert largest(solver(1).solve([exact, goal]).violations[:1]) == 0.0
