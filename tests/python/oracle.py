"""Independent oracle: each level of a hierarchy handed to a trusted QP solver (quadprog).

Level k, from the solution x of the levels above, with Z an orthonormal basis of the free directions
(by SVD):

    min 1/2 |violation of the level's rows at x + Z t|^2 + 1/2 rho^2 |t|^2
    s.t. no inequality row above gets worse

Own inequality rows get a slack variable each, so that the QP is strictly convex for rho > 0. For
rho = 0 the level is solved by proximal steps, and then the smallest step that keeps what the level
settled is a second QP. Nothing here is shared with the C++ solver: no chain, no working set, no
tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import quadprog

ABSENT = 1e20
RANK = 1e-10


class OracleError(Exception):
    """The oracle cannot judge this problem."""


@dataclass
class Rows:
    """One level: lower <= A x <= upper, (m, n), (m,), (m,)."""

    A: np.ndarray
    lower: np.ndarray
    upper: np.ndarray
    rho: float = 0.0
    bounds: bool = False

    @property
    def equal(self) -> np.ndarray:
        """Which rows are equalities, (m,)."""
        return self.lower == self.upper


def null_space(A: np.ndarray, Z: np.ndarray) -> np.ndarray:
    """Directions of Z (n, o) that the rows of A leave free; a row counts by its direct.

    Ion, not its length.
    """
    if A.shape[0] == 0 or Z.shape[1] == 0:
        return Z
    norm = np.linalg.norm(A, axis=1, keepdims=True)
    projected = (A / np.where(norm > 0, norm, 1.0)) @ Z
    _, sigma, vt = np.linalg.svd(projected)
    return Z @ vt[int(np.sum(sigma > RANK)) :].T


def one_sided(A: np.ndarray, lower: np.ndarray, upper: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """C, d with C y >= d, absent sides left out."""
    has_lower, has_upper = lower > -ABSENT, upper < ABSENT
    C = np.vstack([A[has_lower], -A[has_upper]])
    return C, np.concatenate([lower[has_lower], -upper[has_upper]])


def quadratic(
    H: np.ndarray, g: np.ndarray, C: np.ndarray, d: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Min 1/2 y'H y - g'y  s.t. C y >= d; the minimiser and the multipliers."""
    size = np.linalg.norm(C, axis=1)
    keep = np.flatnonzero(size > 1e-11)
    # quadprog is at its best on rows of one size; on rows that stand there twice it may cycle
    unit = np.column_stack([C, d])[keep] / size[keep, None]
    once = np.sort(np.unique(unit.round(12), axis=0, return_index=True)[1])
    C, d, keep = unit[once, :-1], unit[once, -1], keep[once]
    if C.shape[0] == 0:
        return np.linalg.solve(H, g), np.zeros(size.shape)
    # rounding can make rows that meet in one point look inconsistent: give them that much room
    for room in (0.0, 1e-13, 1e-12, 1e-11, 1e-10):
        try:
            y, *_, lagrangian, _ = quadprog.solve_qp(H, g, C.T.copy(), d - room)
        except ValueError:
            continue
        multipliers = np.zeros(size.shape)
        multipliers[keep] = lagrangian / size[keep]
        return y, multipliers
    raise OracleError("quadprog finds the rows of a level inconsistent")


class Oracle:
    """Solves a hierarchy level by level; `above` holds the inequality rows of the levels done."""

    def __init__(self, n: int) -> None:
        self.n = n

    def solve(self, levels: list[Rows]) -> np.ndarray:
        """The optimum of the levels in decreasing priority, (n,)."""
        x, Z = np.zeros(self.n), np.eye(self.n)
        above = (np.zeros((0, self.n)), np.zeros(0), np.zeros(0))
        for level in levels:
            x = self._level(level, x, Z, above)
            Z = null_space(level.A[level.equal], Z)
            free = ~level.equal
            above = tuple(
                np.concatenate([a, b])
                for a, b in zip(
                    above, (level.A[free], level.lower[free], level.upper[free]), strict=True
                )
            )
        return x

    def _level(self, level: Rows, x: np.ndarray, Z: np.ndarray, above: tuple) -> np.ndarray:
        if Z.shape[1] == 0 or level.A.shape[0] == 0:
            return x
        A, lower, upper = above
        limits = (A, np.minimum(lower, A @ x), np.maximum(upper, A @ x))
        if level.rho > 0.0:
            t, _ = self._regularized(level, level.rho, x, np.zeros(Z.shape[1]), Z, limits)
            return x + Z @ t
        return self._unregularized(level, x, Z, limits)

    def _regularized(
        self,
        level: Rows,
        rho: float,
        x: np.ndarray,
        centre: np.ndarray,
        Z: np.ndarray,
        limits: tuple,
    ) -> tuple[np.ndarray, np.ndarray]:
        """Y = (t, slack): min 1/2|A_eq(x + Z t) - b|^2 + 1/2|slack|^2 + 1/2 rho^2|t - centre|^2."""
        equal, free = level.equal, ~level.equal
        E, F = level.A[equal] @ Z, level.A[free] @ Z
        o, m = Z.shape[1], F.shape[0]
        H = np.zeros((o + m, o + m))
        H[:o, :o] = E.T @ E + rho**2 * np.eye(o)
        H[o:, o:] = np.eye(m)
        g = np.zeros(o + m)
        g[:o] = E.T @ (level.lower[equal] - level.A[equal] @ x) + rho**2 * centre
        A, lower, upper = limits
        at = A @ x
        C1, d1 = one_sided(np.hstack([A @ Z, np.zeros((A.shape[0], m))]), lower - at, upper - at)
        at = level.A[free] @ x
        C2, d2 = one_sided(
            np.hstack([F, np.eye(m)]), level.lower[free] - at, level.upper[free] - at
        )
        y, multipliers = quadratic(H, g, np.vstack([C1, C2]), np.concatenate([d1, d2]))
        return y[:o], multipliers[: C1.shape[0]]

    def _unregularized(
        self, level: Rows, x: np.ndarray, Z: np.ndarray, limits: tuple
    ) -> np.ndarray:
        size = max(1e-12, float(np.abs(level.A).max()))
        t = np.zeros(Z.shape[1])
        for _ in range(60):
            before = t
            t, multipliers = self._regularized(level, 1e-3 * size, x, before, Z, limits)
            if np.abs(t - before).max() < 1e-12 * max(1.0, np.abs(t).max()):
                break
        # smallest step: what the level settled stays, the rest of t is free
        A, lower, upper = limits
        value = level.A @ (x + Z @ t)
        violated = (value > level.upper + 1e-9) | (value < level.lower - 1e-9)
        C, _ = one_sided(A @ Z, lower, upper)
        pushing = multipliers > 1e-7 * max(1e-300, multipliers.max(initial=0.0))
        fixed = np.vstack([level.A[level.equal | violated] @ Z, C[pushing]])
        N = null_space(fixed, np.eye(Z.shape[1]))
        if N.shape[1] == 0:
            return x + Z @ t
        inside = ~level.equal & ~violated
        rows = np.vstack([A, level.A[inside]]) @ Z
        base = np.vstack([A, level.A[inside]]) @ x + rows @ (t - N @ (N.T @ t))
        low = np.concatenate([lower, level.lower[inside]]) - base
        high = np.concatenate([upper, level.upper[inside]]) - base
        C, d = one_sided(rows @ N, low - 1e-11, high + 1e-11)
        s, _ = quadratic(np.eye(N.shape[1]), np.zeros(N.shape[1]), C, d)
        return x + Z @ (t - N @ (N.T @ t) + N @ s)


def equality_rows_only(n: int, levels: list[Rows]) -> np.ndarray:
    """The recursion of the thesis for equality rows.

    X_k = x_{k-1} + Y S/(S^2 + rho^2) W' (y - J x_{k-1}).

    Equation (3.3.38) with the filter of (3.3.39), on the rows projected on the free directions.
    """
    x, Z = np.zeros(n), np.eye(n)
    for level in levels:
        if Z.shape[1] == 0:
            break
        w, sigma, yt = np.linalg.svd(level.A @ Z, full_matrices=False)
        kept = sigma > RANK
        filtered = sigma[kept] / (sigma[kept] ** 2 + level.rho**2)
        x = x + Z @ (yt[kept].T @ (filtered * (w[:, kept].T @ (level.lower - level.A @ x))))
        Z = null_space(level.A, Z)
    return x
