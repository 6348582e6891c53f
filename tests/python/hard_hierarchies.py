"""Seeded random hierarchies of the kinds that break solvers (docs/solver-proof.md).

The easier kinds are in hierarchies.py; the bulk run in C++ has the same kinds (tests/cpp/support/
hierarchy_classes.hpp). Every class takes a generator and gives n and the levels.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hierarchies import Generator, box, degenerate, equality, mixed, unit_rows
from oracle import Rows

RHO = [0.0, 0.0, 1.0, 0.1, 0.03, *(10.0**-k for k in range(2, 10))]


def any_rho(rng: Generator) -> float:
    return float(rng.choice(RHO))


def whole(m: int, n: int, most: int, rng: Generator) -> np.ndarray:
    return rng.integers(-most, most + 1, (m, n)).astype(float)


def no_rows(n: int, rho: float = 0.0) -> Rows:
    return Rows(np.zeros((0, n)), np.zeros(0), np.zeros(0), rho)


def append(level: Rows, a: np.ndarray, lower: float, upper: float) -> None:
    level.A = np.vstack([level.A, a])
    level.lower, level.upper = np.append(level.lower, lower), np.append(level.upper, upper)


def pull(levels: list[Rows], n: int, rho: float, rng: Generator) -> None:
    """Tasks that press against the limits above them."""
    for _ in range(int(rng.integers(1, 5))):
        m = int(rng.integers(1, 4))
        A = whole(m, n, 2, rng) if rng.random() < 0.3 else unit_rows(m, n, rng)
        levels.append(equality(A, 2.0 * rng.standard_normal(m), rho))


def robot_like(rng: Generator) -> tuple[int, list[Rows]]:
    """Two arms on a base: lever arms [m], axes [-], millimetres; speed limits, some at zero."""
    n, rho = int(rng.integers(8, 25)), any_rho(rng)
    arm = (n - 2) // 2

    def jacobian(m: int, first: int, count: int, unit: float) -> np.ndarray:
        J = np.zeros((m, n))
        J[:, first : first + count] = unit * np.sqrt(count) * unit_rows(m, count, rng)
        J[:, :2] = rng.choice([0.05, 1.0]) * unit_rows(m, 2, rng)
        return J

    lower, upper = -rng.uniform(0, 1.5, n), rng.uniform(0, 1.5, n)
    lower[rng.random(n) < 0.1] = 0.0
    locked = rng.random(n) < 0.05
    lower[locked] = upper[locked] = 0.0
    levels = [Rows(np.eye(n), lower, upper, 0.0, bounds=True)]
    if rng.random() < 0.5:
        levels.append(Rows(jacobian(2, 0, n, 0.05), np.full(2, -0.02), np.full(2, 0.01)))
        levels.append(
            Rows(jacobian(1, 2, arm, 400.0), np.array([-np.inf]), rng.uniform(-50, 50, 1))
        )
    for first in (2, 2 + arm):
        reach = rng.choice([0.2, 1.0, 3.0])
        for m, unit in ((3, 0.4), (3, 1.0), (1, 0.05)):
            A = jacobian(m, first, arm, unit)
            levels.append(equality(A, reach * unit * rng.uniform(-1, 1, m), rho))
    if rng.random() < 0.5:
        levels.append(equality(np.eye(n), rng.standard_normal(n), rho))
    return n, levels


def crowded_vertex(rng: Generator) -> tuple[int, list[Rows]]:
    """More limits through one point than there are unknowns."""
    n, rho = int(rng.integers(2, 13)), any_rho(rng)
    m = int(rng.integers(n, 3 * n + 1))
    A = whole(m, n, 1, rng) if rng.random() < 0.5 else unit_rows(m, n, rng)
    vertex = whole(1, n, 2, rng)[0] * rng.integers(0, 2)
    levels = [Rows(A, np.full(m, -np.inf), A @ vertex, 0.0 if rng.random() < 0.7 else rho)]
    pull(levels, n, rho, rng)
    return n, levels


def facing_limits(rng: Generator) -> tuple[int, list[Rows]]:
    """Pairs of limits that leave a gap of 0, 1e-14, 1e-9 or 1e-3, as rows of their own."""
    n, rho = int(rng.integers(2, 13)), any_rho(rng)
    levels = [no_rows(n) for _ in range(int(rng.integers(1, 4)))]
    for _ in range(int(rng.integers(1, n + 1))):
        a = whole(1, n, 2, rng) if rng.random() < 0.3 else unit_rows(1, n, rng)
        limit = float(rng.choice([0.0, 0.5, rng.standard_normal()]))
        gap, scale = rng.choice([0.0, 1e-14, 1e-9, 1e-3]), rng.choice([1.0, -1.0, 0.5])
        append(levels[rng.integers(len(levels))], a, -np.inf, limit)
        facing = float(scale * (limit - gap))
        sides = (facing, np.inf) if scale > 0 else (-np.inf, facing)
        append(levels[rng.integers(len(levels))], scale * a, *sides)
    pull(levels, n, rho, rng)
    return n, levels


def thin_cones(rng: Generator) -> tuple[int, list[Rows]]:
    """Pairs of nearly opposite limits: wedges of angle 1e-1 .. 1e-5.

    Thinner ones, to 1e-8, stand in the C++ tests: their multipliers reach 1e9, and the least
    squares of the judge here, in double precision, no longer find them.
    """
    n, rho = int(rng.integers(2, 11)), any_rho(rng)
    cones = no_rows(n)
    for _ in range(int(rng.integers(1, n + 1))):
        a, off = unit_rows(1, n, rng), 10.0 ** rng.uniform(-5, -1) * unit_rows(1, n, rng)
        limit = float(rng.choice([0.0, 0.0, 1e-3, 1.0]))
        append(cones, a, -np.inf, limit)
        append(cones, -a + off, -np.inf, float(rng.choice([0.0, -limit, 1e-3])))
    levels = [cones]
    if rng.random() < 0.3:
        levels.insert(0, box(n, 1.0, rng))
    pull(levels, n, rho, rng)
    return n, levels


def repeats(rng: Generator) -> tuple[int, list[Rows]]:
    """Every row comes again, scaled by 1e-3 .. 2, in its own level or another."""
    n, rho = int(rng.integers(2, 13)), any_rho(rng)
    levels = [no_rows(n, float(rng.choice([0.0, rho]))) for _ in range(int(rng.integers(1, 4)))]
    for _ in range(int(rng.integers(1, n + 3))):
        a, lower = unit_rows(1, n, rng), float(rng.uniform(-1, 0.5))
        upper = lower + float(rng.choice([0.0, 0.2, 1.0]))
        for _ in range(int(rng.integers(1, 4))):
            scale = float(rng.choice([1.0, 1.0, 1e-3, 0.3, 2.0]))
            append(levels[rng.integers(len(levels))], scale * a, scale * lower, scale * upper)
    pull(levels, n, rho, rng)
    return n, levels


def several_bounds(rng: Generator) -> tuple[int, list[Rows]]:
    """Simple bounds at several priorities: tighter, disjoint, half open, locked."""
    n, rho = int(rng.integers(2, 17)), any_rho(rng)
    levels: list[Rows] = []
    for _ in range(int(rng.integers(2, 5))):
        lower = rng.uniform(-1, 0.5, n)
        upper = lower + rng.choice([0.0, 0.2, 1.0, 1.0, 2.0], n)
        lower[rng.random(n) < 0.1] = -np.inf
        upper[rng.random(n) < 0.1] = np.inf
        levels.append(Rows(np.eye(n), lower, upper, 0.0, bounds=True))
        if rng.random() < 0.7:
            pull(levels, n, rho, rng)
    return n, levels


def weights(rng: Generator) -> tuple[int, list[Rows]]:
    """One direction asked for several values with different weights: {2x = 4; x = 8} gives 3.2."""
    n, rho = int(rng.integers(1, 7)), any_rho(rng)
    levels = [box(n, 2.0, rng)] if rng.random() < 0.5 else []
    for _ in range(int(rng.integers(1, 4))):
        a, level = whole(1, n, 2, rng), no_rows(n, rho)
        for _ in range(int(rng.integers(2, 5))):
            weight = float(rng.choice([-1.0, 0.5, 1.0, 2.0, 1e-3, 1e3]))
            target = weight * float(rng.integers(-8, 9))
            append(level, weight * a, target, target + float(rng.choice([0.0, 0.0, 1.0])))
        levels.append(level)
    return n, levels


def scales(rng: Generator) -> tuple[int, list[Rows]]:
    """Rows and levels of sizes 1e-3 .. 1e3, answers of size 1e-3 .. 1e3."""
    n, levels = mixed(rng)
    size, rho = 10.0 ** rng.uniform(-3, 3), any_rho(rng)
    for level in levels:
        m = level.lower.size
        rows = 10.0 ** (rng.uniform(-1.5, 1.5) + rng.uniform(-1.5, 1.5, m))
        if level.bounds:
            rows = np.ones(m)
        else:
            level.rho = rho
        level.A = level.A * rows[:, None]
        level.lower, level.upper = level.lower * size * rows, level.upper * size * rows
    return n, levels


def singular(rng: Generator) -> tuple[int, list[Rows]]:
    """A row of a level stands 1e-1 .. 1e-12 off the span of the rows before it."""
    n, rho = int(rng.integers(2, 20)), any_rho(rng)
    levels, seen = [box(n, float(rng.choice([0.3, 3.0])), rng)], np.zeros((0, n))
    for _ in range(int(rng.integers(1, 7))):
        m = int(rng.integers(1, 4))
        A = unit_rows(m, n, rng)
        if seen.shape[0]:
            near = rng.standard_normal(seen.shape[0]) @ seen
            A[-1] = near / np.linalg.norm(near) + 10.0 ** rng.uniform(-12, -1) * A[-1]
        seen = np.vstack([seen, A])
        levels.append(equality(A, rng.standard_normal(m), rho))
    return n, levels


def tiny_rho(rng: Generator) -> tuple[int, list[Rows]]:
    """Duplicates, zero rows and mixed levels with a regularisation of 1e-3 .. 1e-9."""
    n, levels = degenerate(rng)
    rho = 10.0 ** float(rng.integers(-9, -2))
    for level in levels:
        if not level.bounds:
            level.rho = rho
    return n, levels


def large(rng: Generator) -> tuple[int, list[Rows]]:
    """Up to 60 unknowns: a box that binds, tasks and intervals."""
    n, rho = int(rng.integers(30, 61)), any_rho(rng)
    levels = [box(n, 0.5, rng)]
    for _ in range(int(rng.integers(4, 9))):
        m = int(rng.integers(2, 8))
        levels.append(equality(unit_rows(m, n, rng), 2.0 * rng.standard_normal(m), rho))
        lower = rng.uniform(-2, 1, 3)
        levels.append(Rows(unit_rows(3, n, rng), lower, lower + rng.choice([0.5, 2.0], 3), rho))
    return n, levels


HARD_CLASSES: dict[str, Callable[[Generator], tuple[int, list[Rows]]]] = {
    "robot_like": robot_like,
    "crowded_vertex": crowded_vertex,
    "facing_limits": facing_limits,
    "thin_cones": thin_cones,
    "repeats": repeats,
    "several_bounds": several_bounds,
    "weights": weights,
    "scales": scales,
    "singular": singular,
    "tiny_rho": tiny_rho,
    "large": large,
}
