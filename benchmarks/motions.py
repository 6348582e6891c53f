"""The recipe of robot_problems.hpp for the peers that are called from Python, on numpy's seeds."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "tests" / "python"))

from hierarchies import box
from oracle import Rows

N, ROWS = 19, (3, 3, 3, 3, 3, 2, 2)


@dataclass(frozen=True)
class Conflict:
    """How far x_des reaches, and the shares of rows that depend on those above or are intervals."""

    name: str
    reach: float
    dependent: float = 0.0
    inequality: float = 0.0


CONFLICTS = (
    Conflict("no conflict", 0.5),
    Conflict("box conflicts", 1.55),
    Conflict("conflicting levels", 2.6, 0.2),
    Conflict("mixed levels", 2.8, 0.2, 0.35),
)


def problem(conflict: Conflict, rng: np.random.Generator) -> list[Rows]:
    """A box |x| <= 1 and levels of unit rows that ask for A x = A x_des."""
    desired = rng.uniform(-conflict.reach, conflict.reach, N)
    levels, above = [box(N, 1.0, rng)], np.zeros((0, N))
    for m in ROWS:
        rows = [_row(conflict, desired, above, rng) for _ in range(m)]
        A, lower, upper = (np.array(part) for part in zip(*rows, strict=True))
        levels.append(Rows(A, lower, upper))
        above = np.vstack([above, A])
    return levels


def _row(
    conflict: Conflict, desired: np.ndarray, above: np.ndarray, rng: np.random.Generator
) -> tuple[np.ndarray, float, float]:
    dependent = len(above) > 0 and rng.random() < conflict.dependent
    a = rng.uniform(-1, 1, len(above)) @ above if dependent else rng.uniform(-1, 1, N)
    a /= np.linalg.norm(a)
    middle = a @ desired + (0.5 * conflict.reach * rng.uniform(-1, 1) if dependent else 0.0)
    if rng.random() >= conflict.inequality:
        return a, middle, middle
    half = 0.5 * rng.uniform(0, 0.5)
    kind = rng.integers(3)
    return a, middle - half if kind != 1 else -np.inf, middle + half if kind != 2 else np.inf


def with_rho(levels: list[Rows], rho: float) -> list[Rows]:
    """The same levels, all but bounds regularised so."""
    return [Rows(v.A, v.lower, v.upper, 0.0 if v.bounds else rho, v.bounds) for v in levels]
