"""R01, R02, R05 to R10, R12: identities of sections 2.2, 3.3 and 3.4, asked of the solver itself.

With y = e_i the solver's answers are the columns of the stacked inverse J#; with a last level
"x = e_i", those of P_k. Its factors are tested in C++, claims_decomposition_test.cpp.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from hurcules import rhqp
from hurcules_studies.thesis.claim import Finding, Plot, line
from hurcules_studies.thesis.measures.problems import (
    Array,
    largest,
    levels_with,
    point,
    solver,
    unit_rows,
)
from hurcules_studies.thesis.measures.registry import measures

N, SEEDS = 9, 50
METHODS = ("lexicographic", "rhqp_thesis")  # both: for equality levels they agree


def deficient(seed: int, rho: float) -> list[rhqp.Level]:
    """Level 1 repeats a row of level 0 and sums two others, level 2 repeats a row of its own."""
    rng = np.random.default_rng(seed)
    A, B, C = (unit_rows(3, N, rng) for _ in range(3))
    B[0] = A[2]
    B[2] = A[0] - 2.0 * A[1]
    C[2] = C[1]
    return [point(M, rng.uniform(-1, 1, 3), rho) for M in (A, B, C)]


RANKS = (3, 1, 2)  # of these levels, in the directions that are free for each


def stacked(levels: Sequence[rhqp.Level]) -> Array:
    """J of all levels below each other, (sum m, n)."""
    return np.vstack([np.zeros((0, N)), *(level.A for level in levels)])


def inverse(levels: Sequence[rhqp.Level], method: str) -> Array:
    """J#, (n, sum m), column by column from the solver's answers to unit targets."""
    ends = np.cumsum([level.rows for level in levels])
    columns = []
    for unit in np.eye(int(ends[-1])):
        targets = np.split(unit, ends[:-1])
        columns.append(solver(N, method).solve(levels_with(levels, targets)).x)
    return np.array(columns).T


def projector(levels: Sequence[rhqp.Level], method: str) -> Array:
    """P_k, (n, n): what a level below these can reach, column by column."""
    at_rest = levels_with(levels, [np.zeros(level.rows) for level in levels])
    return np.array(
        [solver(N, method).solve([*at_rest, point(np.eye(N), e, 0.0)]).x for e in np.eye(N)]
    ).T


def conditions(A: Array, X: Array, tolerance: float = 1e-9) -> int:
    """How many of the four Moore-Penrose conditions X meets as an inverse of A (2.2.9-12)."""
    pairs = ((A @ X @ A, A), (X @ A @ X, X), ((A @ X).T, A @ X), ((X @ A).T, X @ A))
    return sum(bool(np.abs(one - other).max() < tolerance) for one, other in pairs)


@dataclass(frozen=True)
class Parts:
    """A problem with the projectors before and after each level."""

    levels: list[rhqp.Level]
    P: list[Array]  # P[k] leaves levels 0 .. k - 1 alone

    def Y2(self, k: int) -> Array:
        """Y_k Y_k' = P_(k-1) - P_k, (n, n)."""
        return self.P[k] - self.P[k + 1]


@cache
def parts(seed: int, rho: float, method: str) -> Parts:
    """One of the problems, taken apart by the answers of a method."""
    levels = deficient(seed, rho)
    P = [np.eye(N)] + [projector(levels[: k + 1], method) for k in range(len(levels))]
    return Parts(levels, P)


def each() -> list[Parts]:
    """All problems by both methods."""
    return [parts(seed, 0.1, method) for method in METHODS for seed in range(SEEDS)]


@measures("R01")
def projectors() -> Finding:
    """P_k against I - J+ J by numpy; conditions of the inverse of the level that repeats a row."""
    difference, symmetry, idempotence = [], [], []
    for one in each():
        for k in range(3):
            P, J = one.P[k + 1], stacked(one.levels[: k + 1])
            difference.append(P - (np.eye(N) - np.linalg.pinv(J, rcond=1e-10) @ J))
            symmetry.append(P - P.T)
            idempotence.append(P @ P - P)
    met = []
    for method in METHODS:
        for seed in range(SEEDS):
            last = deficient(seed, 0.0)[2:]
            met.append(conditions(last[0].A, inverse(last, method)))
    return Finding(
        {
            "difference": largest(difference),
            "symmetry": largest(symmetry),
            "idempotence": largest(idempotence),
            "conditions": min(met),
        }
    )


@measures("R02")
def strict_priority() -> Finding:
    """Levels of full rank, added one by one."""
    errors, moved = [], []
    for method in METHODS:
        for seed in range(SEEDS):
            rng = np.random.default_rng(seed)
            levels = [point(unit_rows(3, N, rng), rng.uniform(-1, 1, 3), 0.0) for _ in range(3)]
            x = np.zeros(N)
            for k in range(3):
                solution = solver(N, method).solve(levels[: k + 1])
                errors += solution.violations
                moved.append(stacked(levels[:k]) @ (solution.x - x))
                x = solution.x
    return Finding({"error": largest(errors), "moved": largest(moved)})


@measures("R05")
def resources() -> Finding:
    """H_k = J'J + rho^2 Y Y', h_k' = y'J on the free directions; then a level that uses them."""
    hessian, gradient, left = [], [], []
    rng = np.random.default_rng(0)
    for one in each():
        for k, level in enumerate(one.levels):
            H = level.A.T @ level.A + level.rho**2 * one.Y2(k)
            hessian.append(H @ one.P[k + 1])
            gradient.append(level.upper @ level.A @ one.P[k + 1])
    for method in METHODS:
        for seed in range(SEEDS):
            levels, wish = deficient(seed, 0.1), rng.uniform(-1, 1, N)
            x = solver(N, method).solve([*levels, point(np.eye(N), wish, 0.0)]).x
            left.append(parts(seed, 0.1, method).P[3] @ (x - wish))
    worst = [largest(values) for values in (hessian, gradient, left)]
    return Finding(dict(zip(("hessian", "gradient", "left"), worst, strict=True)))


@measures("R06")
def null_space() -> Finding:
    """The rank of Z Z' is its trace."""
    difference, columns = [], []
    for one in each():
        for k in range(3):
            P, J = one.P[k + 1], stacked(one.levels[: k + 1])
            difference.append(P - (np.eye(N) - np.linalg.pinv(J, rcond=1e-10) @ J))
            columns.append(np.trace(P) - (N - sum(RANKS[: k + 1])))
    return Finding({"difference": largest(difference), "columns": largest(columns)})


def split(one: Parts, k: int) -> tuple[Array, Array, Array]:
    """U (m, l), sigma (l,), V (m, m - l) of J_k P_(k-1)."""
    U, sigma, _ = np.linalg.svd(one.levels[k].A @ one.P[k])
    rank = int(np.sum(sigma > 1e-9))
    return U[:, :rank], sigma[:rank], U[:, rank:]


@measures("R07")
def errors() -> Finding:
    """The solver's own report of each level against the formulas of the thesis."""
    sums, v_off, u_off, v_regular = [], [], [], []
    u_bare: list[float] = []
    u_least: list[float] = []
    for rho in (0.0, 0.1, 1.0):
        for seed in range(SEEDS):
            one = parts(seed, rho, "lexicographic")
            x = np.zeros(N)
            for k, level in enumerate(one.levels):
                before = level.A @ x - level.upper
                solution = solver(N).solve(one.levels[: k + 1])
                x, report = solution.x, solution.levels[k]
                U, sigma, V = split(one, k)
                T = rho**2 / (sigma**2 + rho**2)  # 3.3.46
                v, u = V @ (V.T @ before), U @ (T * (U.T @ before))  # 3.3.78, 3.3.80
                sums.append(level.A @ x - level.upper - report.infeasible - report.regularized)
                v_off.append(report.infeasible - v)
                u_off.append(report.regularized - u)
                size = largest([report.regularized])
                (u_bare if rho == 0.0 else u_least).append(size)
                if k == 0:
                    v_regular.append(report.infeasible)
    return Finding(
        {
            "sum": largest(sums),
            "v": largest(v_off),
            "u": largest(u_off),
            "u_unregularized": max(u_bare),
            "u_regularized": min(u_least),
            "v_regular": largest(v_regular),
        }
    )


@measures("R08")
def rebuilt() -> Finding:
    """W = (U V) a level, Y from the solver's projectors, S = W' J Y (3.3.62-66)."""
    difference, orthogonality, sigma_off = [], [], []
    for seed in range(SEEDS):
        one = parts(seed, 0.1, "lexicographic")
        reports = solver(N).solve(one.levels).levels
        W, Y = np.zeros((0, 0)), np.zeros((N, 0))
        for k in range(3):
            U, sigma, V = split(one, k)
            values, vectors = np.linalg.eigh(one.Y2(k))
            Y = np.hstack([Y, vectors[:, values > 0.5]])
            block = np.hstack([U, V])
            W = np.block(
                [
                    [W, np.zeros((W.shape[0], block.shape[1]))],
                    [np.zeros((block.shape[0], W.shape[1])), block],
                ]
            )
            J = stacked(one.levels[: k + 1])
            S = W.T @ J @ Y
            difference.append(W @ S @ Y.T - J)
            orthogonality.append(W.T @ W - np.eye(W.shape[1]))
            found = np.sort(reports[k].singular_values)[::-1][: sigma.size]
            sigma_off.append(found - sigma)
    return Finding(
        {
            "difference": largest(difference),
            "orthogonality": largest(orthogonality),
            "sigma": largest(sigma_off),
        }
    )


@measures("R09")
def regularized_inverse() -> Finding:
    """J# from unit targets, then x of other targets."""
    difference, met = [], []
    for method in METHODS:
        for seed in range(SEEDS):
            levels = deficient(seed, 0.1)
            X = inverse(levels, method)
            y = np.concatenate([level.upper for level in levels])
            difference.append(solver(N, method).solve(levels).x - X @ y)
            met.append(conditions(stacked(levels), X))
    return Finding({"difference": largest(difference), "conditions": max(met)})


@measures("R10")
def bare_inverse() -> Finding:
    """The same without regularisation."""
    difference, met, asymmetry = [], [], []
    for method in METHODS:
        for seed in range(SEEDS):
            levels = deficient(seed, 0.0)
            J, X = stacked(levels), inverse(levels, method)
            difference.append(X @ J - (np.eye(N) - parts(seed, 0.0, method).P[3]))
            met.append(conditions(J, X))
            asymmetry.append(float(np.abs(J @ X - (J @ X).T).max()))
    return Finding(
        {
            "difference": largest(difference),
            "least": min(met),
            "most": max(met),
            "asymmetry": min(asymmetry),
        }
    )


@measures("R12")
def multipliers() -> Finding:
    """The solver's recursion against 3.4.109, -J#' J_k' mu_k, J# of the levels above at rho = 0."""
    sizes, differences, wrong = [], [], 0
    for seed in range(SEEDS):
        levels = deficient(seed, 0.1)
        columns = solver(N, "rhqp_thesis").solve(levels).multipliers
        wrong += sum(len(column) != k + 1 for k, column in enumerate(columns))
        for k in range(1, 3):
            above = deficient(seed, 0.0)[:k]
            closed = -inverse(above, "rhqp_thesis").T @ (levels[k].A.T @ columns[k][k])
            differences.append(np.concatenate(columns[k][:k]) - closed)
            sizes.append(np.abs(closed).max())
    off = [largest([difference]) + 1e-17 for difference in differences]
    labels = ("Recursion against the closed form", "size of the multipliers", "difference")
    plot = Plot(*labels, [line("", sizes, off, "dots")], log="xy")
    return Finding({"difference": largest(differences), "triangular": wrong}, plots=[plot])
