"""jvp, vjp and level reports where weak directions are handed over or rho follows them.

Strategy: a row of the second level stands out of the span of others by sigma below rho (kinematic:
of its level, algorithmic: of the level above), with and without a box, so that the directions of
all levels below turn and change their weights with A, rho and each other. The derivative must be
the central finite difference of the solver itself, jvp and vjp adjoint, and a report that of dense
algebra. The same for rho that is adapted to the smallest singular value, and for both together.
Away from singularities the derivatives of test_sensitivity.py hold bit by bit.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest

from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from oracle import Rows
from test_sensitivity import STEP, inner, moved, piece

N, ROWS, RHO, SEEDS = 12, (2, 3, 2, 2), 0.1, 25
OPTIONS = {
    "smooth": rhqp.SolverOptions(handover="smooth"),
    "adaptive": rhqp.SolverOptions(regularization="adaptive", singular_threshold=0.3),
    "both": rhqp.SolverOptions(
        handover="smooth", regularization="adaptive", singular_threshold=0.3
    ),
}
SIGMAS = (0.08, 0.03, 0.01, 1e-3)

Generator = np.random.Generator


def rows(m: int, rng: Generator) -> np.ndarray:
    """Of different lengths: the longest row below counts for a hand-over."""
    A = rng.standard_normal((m, N))
    return A * (rng.uniform(0.8, 1.2, m) / np.linalg.norm(A, axis=1))[:, None]


def singular(algorithmic: bool, boxed: bool, sigma: float, rng: Generator) -> list[Rows]:
    """Equality levels of several rho; a row of the second stands out by sigma."""
    levels = []
    for k, m in enumerate(ROWS):
        y = rng.uniform(-1, 1, m)
        levels.append(Rows(rows(m, rng), y, y.copy(), RHO * (1 + 0.1 * k)))
    source = levels[0].A if algorithmic else levels[1].A[:2]
    inside = rng.standard_normal(len(source)) @ source
    inside /= np.linalg.norm(inside)
    seen = np.linalg.qr(np.vstack([levels[0].A, levels[1].A[:2]]).T)[0]
    outside = rng.standard_normal(N)
    outside -= seen @ (seen.T @ outside)
    outside /= np.linalg.norm(outside)
    levels[1].A[2] = np.sqrt(1 - sigma**2) * inside + sigma * outside
    box = Rows(np.eye(N), np.full(N, -0.6), np.full(N, 0.6), bounds=True)
    return [box, *levels] if boxed else levels


def direction(levels: list[Rows], rng: Generator) -> list[rhqp.LevelChange]:
    """Every number moves; equality rows stay equalities."""
    changes = []
    for level in levels:
        y = rng.standard_normal(level.lower.shape)
        A = None if level.bounds else rng.standard_normal(level.A.shape)
        rho = 0.0 if level.bounds else float(rng.standard_normal())
        upper = rng.standard_normal(y.shape) if level.bounds else y
        changes.append(rhqp.LevelChange(A, y, upper, rho))
    return changes


def solve(levels: list[Rows], options: rhqp.SolverOptions) -> rhqp.Solution:
    return rhqp.Solver(N, options).solve(to_levels(levels))


def cases(sigma: float) -> Iterator[tuple[bool, list[Rows], Generator]]:
    for seed in range(SEEDS):
        for algorithmic in (False, True):
            for boxed in (False, True):
                rng = np.random.default_rng([seed, algorithmic, boxed])
                yield boxed, singular(algorithmic, boxed, sigma, rng), rng


@pytest.mark.parametrize("sigma", SIGMAS)
@pytest.mark.parametrize("name", OPTIONS)
def test_jvp_is_the_derivative_at_singularities(name: str, sigma: float) -> None:
    options, compared, wrong = OPTIONS[name], 0, []
    # x is curved over about sigma: steps that are small beside it
    step = min(STEP, 1e-4 * sigma)
    for boxed, levels, rng in cases(sigma):
        changes = direction(levels, rng)
        here = solve(levels, options)
        sides = [solve(moved(levels, changes, by), options) for by in (-step, step)]
        if any(piece(side) != piece(here) for side in sides):
            assert boxed  # without limits there are no pieces
            continue
        compared += 1
        wanted = (sides[1].x - sides[0].x) / (2.0 * step)
        error = np.linalg.norm(here.jvp(changes) - wanted) / max(1.0, np.linalg.norm(wanted))
        wrong += [float(error)] if error > 1e-5 else []
    assert wrong == []
    assert compared >= 3 * SEEDS  # of four kinds


@pytest.mark.parametrize("sigma", SIGMAS)
@pytest.mark.parametrize("name", OPTIONS)
def test_vjp_is_jvp_transposed_at_singularities(name: str, sigma: float) -> None:
    for _, levels, rng in cases(sigma):
        solution = solve(levels, OPTIONS[name])
        changes, x_bar = direction(levels, rng), rng.standard_normal(N)
        forward = float(x_bar @ solution.jvp(changes))
        backward, size = inner(solution.vjp(x_bar), changes)
        assert abs(forward - backward) <= 1e-12 * max(1.0, size)


def test_hand_over_is_what_is_differentiated() -> None:
    """Negative control: the derivative of the strict rule is another one."""
    for boxed, levels, rng in cases(0.03):
        changes = direction(levels, rng)
        smooth = solve(levels, OPTIONS["smooth"]).jvp(changes)
        strict = solve(levels, rhqp.SolverOptions()).jvp(changes)
        assert boxed or np.linalg.norm(smooth - strict) > 1e-2


def weight(sigma: float, rho: float, p: float) -> float:
    """How much of a direction goes back (docs/solver.md, section 6)."""
    h = max(0.0, 1 - (sigma / rho) ** 2) ** 2
    return float(np.sqrt(h * p**2 / ((1 - h) + h * p**2)))


@pytest.mark.parametrize("sigma", [0.5, *SIGMAS, 0.0])
def test_reports_behind_a_hand_over_are_those_of_dense_algebra(sigma: float) -> None:
    for boxed, levels, _ in cases(sigma):
        solution = solve(levels, OPTIONS["smooth"])
        B = np.eye(N)
        for k, (level, report) in enumerate(zip(levels, solution.levels, strict=True)):
            total = report.infeasible + report.regularized
            np.testing.assert_allclose(total, solution.multipliers[k][k], atol=1e-11)
            if level.bounds:
                assert boxed and report.rank == 0
                continue
            _, values, Vt = np.linalg.svd(level.A @ B)
            receivers = [v.rho / np.linalg.norm(v.A, axis=1).max() for v in levels[k + 1 :]]
            w = [weight(v, level.rho, min(receivers)) if receivers else 0.0 for v in values]
            if not receivers:
                w = [float(v < 1e-10) for v in values]
            np.testing.assert_allclose(report.singular_values, values, atol=1e-10)
            assert report.rank == (values > 1e-10).sum()
            np.testing.assert_allclose(report.handed_over, w, atol=1e-9)
            B = B @ Vt.T * [*w, *np.ones(B.shape[1] - len(w))]
            B = B[:, np.linalg.norm(B, axis=0) > 0]


@pytest.mark.parametrize("name", ["box_conflict", "level_conflict", "mixed", "near_singular"])
@pytest.mark.parametrize("options", OPTIONS)
def test_vjp_is_jvp_transposed_on_classes(name: str, options: str) -> None:
    for seed in range(60):
        rng = np.random.default_rng([seed, len(name)])
        n, levels = CLASSES[name](rng)
        solution = rhqp.Solver(n, OPTIONS[options]).solve(to_levels(levels))
        changes = [
            rhqp.LevelChange(
                None if v.bounds else rng.standard_normal(v.A.shape),
                rng.standard_normal(v.lower.shape),
                rng.standard_normal(v.upper.shape),
                0.0 if v.bounds else float(rng.standard_normal()),
            )
            for v in levels
        ]
        x_bar = rng.standard_normal(n)
        forward = float(x_bar @ solution.jvp(changes))
        backward, size = inner(solution.vjp(x_bar), changes)
        assert abs(forward - backward) <= 1e-11 * max(1.0, size), f"seed {seed}"
