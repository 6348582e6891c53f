"""Seeded random hierarchies, by class of difficulty."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hurcules import rhqp
from oracle import Rows

Generator = np.random.Generator


def box(n: int, width: float, rng: Generator, centred: bool = True) -> Rows:
    centre = np.zeros(n) if centred else rng.uniform(-0.5, 0.5, n) * width
    return Rows(np.eye(n), centre - width, centre + width, 0.0, bounds=True)


def equality(A: np.ndarray, target: np.ndarray, rho: float) -> Rows:
    return Rows(A, target, target.copy(), rho)


def unit_rows(m: int, n: int, rng: Generator) -> np.ndarray:
    A = rng.standard_normal((m, n))
    return A / np.linalg.norm(A, axis=1, keepdims=True)


def to_levels(levels: list[Rows]) -> list[rhqp.Level]:
    """The levels as our solver takes them."""
    return [
        rhqp.Bounds(level.lower, level.upper)
        if level.bounds
        else rhqp.Level(level.A, level.lower, level.upper, level.rho)
        for level in levels
    ]


def sizes(rng: Generator) -> tuple[int, list[int]]:
    n = int(rng.integers(2, 20))
    return n, [int(rng.integers(1, 4)) for _ in range(int(rng.integers(1, 7)))]


def regularisation(rng: Generator) -> float:
    return float(rng.choice([0.0, 0.03, 0.1, 1.0]))


def no_conflict(rng: Generator) -> tuple[int, list[Rows]]:
    n, rows = sizes(rng)
    rho, x = regularisation(rng), rng.uniform(-0.3, 0.3, n)
    levels = [box(n, 5.0, rng)]
    for m in rows:
        A = unit_rows(m, n, rng)
        levels.append(equality(A, A @ x, rho))
    return n, levels


def box_conflict(rng: Generator) -> tuple[int, list[Rows]]:
    n, rows = sizes(rng)
    rho = regularisation(rng)
    levels = [box(n, 0.5, rng, centred=bool(rng.integers(2)))]
    for m in rows:
        levels.append(equality(unit_rows(m, n, rng), rng.uniform(-2, 2, m), rho))
    return n, levels


def level_conflict(rng: Generator) -> tuple[int, list[Rows]]:
    """More rows than unknowns, rows of later levels partly in the span of earlier ones."""
    n, rows = sizes(rng)
    rho = regularisation(rng)
    levels, seen = [box(n, 1.0, rng)], np.zeros((0, n))
    for m in rows:
        A = unit_rows(m, n, rng)
        if seen.shape[0] and rng.random() < 0.6:
            A[0] = rng.standard_normal(seen.shape[0]) @ seen
            A[0] /= max(1e-3, float(np.linalg.norm(A[0])))
        seen = np.vstack([seen, A])
        levels.append(equality(A, rng.uniform(-2, 2, m), rho))
    return n, levels


def mixed(rng: Generator) -> tuple[int, list[Rows]]:
    """Equalities, intervals and one-sided rows at every level, box anywhere."""
    n, rows = sizes(rng)
    levels = []
    for m in rows:
        A = unit_rows(m, n, rng) * rng.choice([0.1, 1.0, 10.0])
        lower = rng.uniform(-2, 1, m)
        upper = lower + rng.choice([0.0, 0.5, 2.0], m)
        kind = rng.integers(0, 4, m)
        lower[(kind == 1) & (lower < upper)] = -np.inf
        upper[(kind == 2) & (lower < upper)] = np.inf
        levels.append(Rows(A, lower, upper, regularisation(rng)))
    if rng.random() < 0.7:
        levels.insert(int(rng.integers(0, len(levels))), box(n, 1.0, rng))
    return n, levels


def near_singular(rng: Generator) -> tuple[int, list[Rows]]:
    """A row of a level differs by 1e-1 .. 1e-8 from the span of the rows before it; regularised."""
    n, levels = box_conflict(rng)
    rho = float(rng.choice([0.03, 0.1, 1.0]))
    seen = np.zeros((0, n))
    for level in levels[1:]:
        level.rho = rho
        if seen.shape[0]:
            near = rng.standard_normal(seen.shape[0]) @ seen
            near /= np.linalg.norm(near)
            off = unit_rows(1, n, rng)[0]
            level.A[-1] = near + 10.0 ** float(rng.uniform(-8, -1)) * off
        seen = np.vstack([seen, level.A])
    return n, levels


def degenerate(rng: Generator) -> tuple[int, list[Rows]]:
    """Duplicates, zero rows, opposite rows, limits through one vertex, empty levels."""
    n, levels = mixed(rng)
    for level in levels:
        if level.bounds or level.A.shape[0] == 0:
            continue
        what = rng.integers(0, 4)
        i = int(rng.integers(level.A.shape[0]))
        if what == 0:
            level.A[i] = 0.0
        elif what == 1:
            level.A = np.vstack([level.A, level.A[i]])
            level.lower = np.append(level.lower, level.lower[i])
            level.upper = np.append(level.upper, level.upper[i])
        elif what == 2 and len(levels) > 1:
            level.A[i] = -levels[0].A[0]
    levels.insert(
        int(rng.integers(len(levels) + 1)), Rows(np.zeros((0, n)), np.zeros(0), np.zeros(0))
    )
    return n, levels


def whole_numbers(rng: Generator) -> tuple[int, list[Rows]]:
    """Small n and small integers: ties, exact vertices, exact dependence everywhere."""
    n = int(rng.integers(1, 4))
    levels = []
    for _ in range(int(rng.integers(1, 5))):
        m = int(rng.integers(1, 4))
        lower = rng.integers(-2, 3, m).astype(float)
        upper = lower + rng.integers(0, 3, m)
        levels.append(
            Rows(rng.integers(-2, 3, (m, n)).astype(float), lower, upper, regularisation(rng))
        )
    return n, levels


CLASSES: dict[str, Callable[[Generator], tuple[int, list[Rows]]]] = {
    "no_conflict": no_conflict,
    "box_conflict": box_conflict,
    "level_conflict": level_conflict,
    "mixed": mixed,
    "near_singular": near_singular,
    "degenerate": degenerate,
    "whole_numbers": whole_numbers,
}
