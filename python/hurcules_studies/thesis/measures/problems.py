"""Seeded random hierarchies, and small helpers, shared by the claims on the solver."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules import rhqp

__all__ = [
    "INF",
    "Array",
    "conflict",
    "equalities",
    "equality",
    "largest",
    "levels_with",
    "point",
    "solver",
    "unit_rows",
]

INF = np.inf
Array = NDArray[np.float64]


def solver(n: int, method: str = "lexicographic", **options: int) -> rhqp.Solver:
    """A solver of n unknowns with this method."""
    return rhqp.Solver(n, rhqp.SolverOptions(method=method, **options))  # type: ignore[arg-type]


def point(rows: ArrayLike, target: ArrayLike, rho: float) -> rhqp.Level:
    """Equalities: rows (m, n), target (m,)."""
    y = np.asarray(target, dtype=float)
    return rhqp.Level(np.asarray(rows, dtype=float), y, y, rho=rho)


equality = point


def unit_rows(m: int, n: int, rng: np.random.Generator) -> Array:
    """Random rows of length 1, (m, n)."""
    A = rng.standard_normal((m, n))
    return np.asarray(A / np.linalg.norm(A, axis=1, keepdims=True))


def conflict(seed: int, n: int = 12, rho: float = 0.1) -> list[rhqp.Level]:
    """A box of 0.5 and four levels of three unit rows that want more than it allows."""
    rng = np.random.default_rng(seed)
    tasks = [point(unit_rows(3, n, rng), rng.uniform(-2, 2, 3), rho) for _ in range(4)]
    return [rhqp.Bounds(np.full(n, -0.5), np.full(n, 0.5)), *tasks]


def equalities(seed: int, n: int = 9, rho: float = 0.1) -> list[rhqp.Level]:
    """Three levels; level 1 repeats a direction of level 0, level 2 is near the span of both."""
    rng = np.random.default_rng(seed)
    A, B, C = unit_rows(3, n, rng), unit_rows(3, n, rng), unit_rows(2, n, rng)
    B[0] = A[2]
    C[0] = 0.7 * A[0] - 0.7 * B[1] + 1e-4 * C[0]
    return [point(M, rng.uniform(-1, 1, M.shape[0]), rho) for M in (A, B, C)]


def levels_with(levels: Sequence[rhqp.Level], targets: Iterable[Array]) -> list[rhqp.Level]:
    """The same equality levels with other targets, (m,) each."""
    return [point(level.A, y, level.rho) for level, y in zip(levels, targets, strict=True)]


def largest(values: Iterable[ArrayLike]) -> float:
    """The largest magnitude in some arrays; 0 where there is nothing."""
    sizes = (np.abs(np.asarray(value)) for value in values)
    return max((float(size.max()) for size in sizes if size.size), default=0.0)
