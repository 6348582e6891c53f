"""The solver and its peers behind one call: a hierarchy in, x and the time of the solver out.

Each takes the hierarchy in the form that it wants beforehand; only the solver's own calls count.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from ctypes import c_int
from typing import Protocol

import daqp
import numpy as np
from motions import N

from hierarchies import to_levels
from hurcules import rhqp
from oracle import OracleError, Rows, null_space, one_sided, quadratic

try:
    import proxsuite
except ImportError:  # not needed by the tests: pip install proxsuite
    proxsuite = None

Array = np.ndarray


class Peer(Protocol):
    """What the benchmarks ask of a solver."""

    name: str

    def solve(self, levels: list[Rows]) -> tuple[Array, float]:
        """The answer, (n,), and the time that it took [s]."""
        ...


def timed(call: Callable[..., object], *arguments: object) -> tuple[object, float]:
    """What the call returns and how long it took [s]."""
    begin = time.perf_counter()
    answer = call(*arguments)
    return answer, time.perf_counter() - begin


class Ours:
    """hurcules.rhqp, through its Python binding.

    Args:
        warm: working sets of the last solve.
        handover: "strict" or "smooth".
    """

    def __init__(self, warm: bool = False, handover: str = "strict") -> None:
        self.name = "hurcules" + (", warm" if warm else "")
        self.name += "" if handover == "strict" else f", {handover}"
        self._warm = warm
        self._solver = rhqp.Solver(N, rhqp.SolverOptions(handover=handover))

    def solve(self, levels: list[Rows]) -> tuple[Array, float]:
        """See Peer."""
        given = to_levels(levels)
        if not self._warm:
            self._solver.reset()
        solution, seconds = timed(self._solver.solve, given)
        return solution.x.copy(), seconds


class DaqpHierarchy:
    """daqp with break points: strict levels, without regularisation, in one call.

    Its first levels come as rows of A like all others: versions around 0.9 answered wrongly for
    simple bounds or equality rows in a hierarchy, so the answers are checked here too.
    """

    name = "daqp, hierarchy"

    def solve(self, levels: list[Rows]) -> tuple[Array, float]:
        """See Peer."""
        lower = np.concatenate([v.lower for v in levels])
        upper = np.concatenate([v.upper for v in levels])
        ends = np.cumsum([len(v.lower) for v in levels]).astype(c_int)
        A = np.vstack([v.A for v in levels])
        sense = np.zeros(len(lower), dtype=c_int)
        answer, seconds = timed(daqp.solve, None, None, A, upper, lower, sense, ends)
        return answer[0], seconds


class Weighted:
    """All levels in one QP, a level ten times the next; not the same problem."""

    name = "daqp, one weighted QP"

    def solve(self, levels: list[Rows]) -> tuple[Array, float]:
        """See Peer."""
        free = [~v.equal if not v.bounds else np.zeros(N, dtype=bool) for v in levels]
        size = N + sum(int(f.sum()) for f in free)
        H, f = 1e-6 * np.eye(size), np.zeros(size)
        rows, lower, upper, slack = [], [levels[0].lower], [levels[0].upper], N
        for k, (v, loose) in enumerate(zip(levels[1:], free[1:], strict=True)):
            weight = 100.0**-k
            H[:N, :N] += weight * v.A[~loose].T @ v.A[~loose]
            f[:N] -= weight * v.A[~loose].T @ v.lower[~loose]
            count = int(loose.sum())
            row = np.zeros((count, size))
            row[:, :N] = v.A[loose]
            row[:, slack : slack + count] = np.eye(count)
            H[slack : slack + count, slack : slack + count] += weight * np.eye(count)
            rows.append(row)
            lower.append(v.lower[loose])
            upper.append(v.upper[loose])
            slack += count
        wide = np.hstack([np.eye(N), np.zeros((N, size - N))])
        A, lo, up = np.vstack([wide, *rows]), np.concatenate(lower), np.concatenate(upper)
        answer, seconds = timed(daqp.solve, H, f, A, up, lo, np.zeros(len(lo), dtype=c_int))
        return answer[0][:N], seconds


def quadprog_qp(H: Array, g: Array, C: Array, lower: Array, upper: Array) -> tuple[Array, Array]:
    """Min 1/2 y'H y - g'y, lower <= C y <= upper: the minimiser, and which rows push."""
    stacked, d = one_sided(C, lower, upper)
    y, multipliers = quadratic(H, g, stacked, d)
    pushes = np.zeros(len(C), dtype=bool)
    has_lower, has_upper = lower > -1e20, upper < 1e20
    pushes[has_lower] |= multipliers[: has_lower.sum()] > 1e-9
    pushes[has_upper] |= multipliers[has_lower.sum() :] > 1e-9
    return y, pushes


def proxsuite_qp(H: Array, g: Array, C: Array, lower: Array, upper: Array) -> tuple[Array, Array]:
    """See quadprog_qp."""
    done = proxsuite.proxqp.dense.solve(
        H,
        -g,
        None,
        None,
        C,
        np.maximum(lower, -1e20),
        np.minimum(upper, 1e20),
        eps_abs=1e-9,
        eps_rel=0.0,
    )
    return done.x, np.abs(done.z) > 1e-7


class Cascade:
    """One QP a level in the free directions of the levels above; rows above never get worse.

    Counted is the time inside the QP calls only: a cascade in C++ pays little more. Levels without
    regularisation get 1e-4, since the QPs want a positive definite matrix. With `frozen` a row that
    pushed becomes an equality for the levels below, as the literature has it.
    """

    def __init__(self, name: str, frozen: bool = False) -> None:
        self.name = f"{name}, cascade" + (", frozen rows" if frozen else "")
        self._qp = {"quadprog": quadprog_qp, "proxsuite": proxsuite_qp}[name]
        self._frozen = frozen

    def solve(self, levels: list[Rows]) -> tuple[Array, float]:
        """See Peer."""
        x, Z, seconds = np.zeros(N), np.eye(N), 0.0
        above = Rows(np.zeros((0, N)), np.zeros(0), np.zeros(0))
        for level in levels:
            if Z.shape[1] == 0:
                break
            rho = 0.0 if level.bounds else max(level.rho, 1e-4)
            free = ~level.equal
            if not level.bounds:
                problem = self._level(level, rho, x, Z, above)
                (y, pushes), spent = timed(self._qp, *problem)
                seconds += spent
                x = x + Z @ y[: Z.shape[1]]
                if self._frozen:
                    held = pushes[: len(above.A)]
                    Z = null_space(above.A[held], Z)
            Z = null_space(level.A[level.equal], Z)
            above = Rows(
                np.vstack([above.A, level.A[free]]),
                np.append(above.lower, level.lower[free]),
                np.append(above.upper, level.upper[free]),
            )
        return x, seconds

    @staticmethod
    def _level(level: Rows, rho: float, x: Array, Z: Array, above: Rows) -> tuple[Array, ...]:
        equal, free = level.equal, ~level.equal
        E, F = level.A[equal] @ Z, level.A[free] @ Z
        o, m = Z.shape[1], len(F)
        H = np.eye(o + m)
        H[:o, :o] = E.T @ E + rho**2 * np.eye(o)
        g = np.zeros(o + m)
        g[:o] = E.T @ (level.lower[equal] - level.A[equal] @ x)
        C = np.block([[above.A @ Z, np.zeros((len(above.A), m))], [F, np.eye(m)]])
        at, own = above.A @ x, level.A[free] @ x
        lower = np.append(np.minimum(above.lower - at, 0.0), level.lower[free] - own)
        upper = np.append(np.maximum(above.upper - at, 0.0), level.upper[free] - own)
        return H, g, C, lower, upper


def attempt(peer: Peer, levels: list[Rows]) -> tuple[Array | None, float]:
    """The answer and its time [s]; no answer when the peer gives up or returns no numbers."""
    try:
        x, seconds = peer.solve(levels)
    except (OracleError, ValueError):
        return None, np.nan
    return (x, seconds) if np.isfinite(x).all() else (None, seconds)


def violations(levels: Sequence[Rows], x: Array) -> Array:
    """Norm of the violation of each level, (levels,)."""
    values = [v.A @ x for v in levels]
    return np.array(
        [
            np.linalg.norm(a - np.clip(a, v.lower, v.upper))
            for a, v in zip(values, levels, strict=True)
        ]
    )
