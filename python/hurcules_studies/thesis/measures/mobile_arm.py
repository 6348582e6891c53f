"""The mobile arm of Chapter 3 (Figure 3.1): a base q1 on a line and a unit arm at the angle q2.

s1 = q1 + cos q2 is where the hand is, s2 = q1 where the base is. Velocities come from a hierarchy,
positions from Euler steps, as in sections 3.3.4 and 3.4.4.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from hurcules import rhqp
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "Motion", "hand", "move", "point_and_range", "two_points"]

DT = 0.1  # [s]  3.3.4
RHO = 0.5  # 3.3.4, both levels; 3.4.4, all three

Levels = Callable[[Array], list[rhqp.Level]]
Start = tuple[float, float]


@dataclass(frozen=True)
class Motion:
    """One run: time (steps + 1,) [s], q (steps + 1, 2), velocity (steps, 2)."""

    time: Array
    q: Array
    velocity: Array

    @property
    def peak(self) -> float:
        """The largest joint velocity."""
        return float(np.abs(self.velocity).max())


def hand(q: Array) -> Array:
    """s1 of one configuration or of many, (..., 2) -> (...)."""
    return np.asarray(q[..., 0] + np.cos(q[..., 1]))


def task(row: list[float], velocity: float) -> rhqp.Level:
    """An equality level of one row."""
    y = np.array([velocity])
    return rhqp.Level(np.array([row]), y, y, rho=RHO)


def two_points(s1: float, s2: float) -> Levels:
    """Hand first, base second, K1 = K2 = 1 (3.2.8-10)."""

    def levels(q: Array) -> list[rhqp.Level]:
        return [task([1.0, -np.sin(q[1])], s1 - float(hand(q))), task([1.0, 0.0], s2 - q[0])]

    return levels


def point_and_range(s1: float, lower: float, upper: float) -> Levels:
    """Hand first with K1 = 1, then the base within a range with K2 = K3 = 10 (3.4.118-121)."""

    def levels(q: Array) -> list[rhqp.Level]:
        base = rhqp.Level(
            np.array([[1.0, 0.0]]),
            np.array([10.0 * (lower - q[0])]),
            np.array([10.0 * (upper - q[0])]),
            rho=RHO,
        )
        return [task([1.0, -np.sin(q[1])], s1 - float(hand(q))), base]

    return levels


def move(levels: Levels, start: Start, method: str, seconds: float = 10.0) -> Motion:
    """Follows the solutions of a method for a time."""
    solver = rhqp.Solver(2, rhqp.SolverOptions(method=method))
    q, velocity = [np.array(start)], []
    for _ in range(round(seconds / DT)):
        velocity.append(solver.solve(levels(q[-1])).x)
        q.append(q[-1] + DT * velocity[-1])
    return Motion(
        np.asarray(DT * np.arange(len(q)), dtype=np.float64), np.array(q), np.array(velocity)
    )
