"""How far an answer is from the definition of solver.md section 1, without any other solver.

x_k is the answer of the levels 0 .. k alone. On the directions that the equality rows above leave
free, with v the violations of level k and N the rows above that stand at a limit (signed),

    rho^2 (x_k - x_{k-1}) + A' v + N' mu = 0    for some mu >= 0,

and where rho is 0 or tiny the step must be the smallest of those with the same violations:

    (x_k - x_{k-1}) + F' lambda + N' nu = 0     for some nu >= 0,

F being the equality and the violated rows. mu and nu come from nonnegative least squares, so
nothing of the solver is used but its x. Rounding of the rows is no fault: weights mu cost 1e-15 mu,
and a row that stands out by sigma from those before it gives a direction that is known to
1e-15 / sigma.
"""

from __future__ import annotations

import numpy as np

from hierarchies import to_levels
from hurcules import rhqp
from oracle import Rows

RANK = 1e-10  # of equality rows, solver.md section 1
DISTINCT = 1e-13  # other rows have no rank to lose: less than this is rounding
AT_LIMIT = 1e-9  # relative to |a| max(1, |x|)
ROUNDING = 1e-6  # 1e-15 counts as 1e-9
TINY = 1e-4  # rho relative to |a|: rho^2 |t| is lost in the rounding of the violations


def answers_by_level(n: int, levels: list[Rows]) -> list[np.ndarray]:
    """The answer after each level, (n,) each.

    The equality rows of the levels below stay with a regularisation that pins them, so that the
    solve takes the same path to its level as the whole one.
    """
    pinned = [
        Rows(level.A[level.equal], *[level.lower[level.equal]] * 2, 1e100) for level in levels
    ]
    return [
        rhqp.Solver(n).solve(to_levels(levels[:k] + pinned[k:])).x
        for k in range(1, len(levels) + 1)
    ]


def nonnegative_least_squares(C: np.ndarray, b: np.ndarray) -> np.ndarray:
    """The y >= 0 (m,) that makes |b + C'y| smallest, C (m, n) (Lawson and Hanson)."""
    y, held = np.zeros(C.shape[0]), np.zeros(C.shape[0], dtype=bool)
    for _ in range(3 * C.shape[0] + 30):
        pull = np.where(held, -np.inf, -(C @ (b + C.T @ y)))
        if held.all() or pull.max() <= 1e-14 * np.linalg.norm(b):
            break
        held[np.argmax(pull)] = True
        while held.any():
            wanted = np.zeros_like(y)
            wanted[held] = np.linalg.lstsq(C[held].T, -b, rcond=None)[0]
            stop = held & (wanted <= 0.0)
            if not stop.any():
                y = wanted
                break
            way = float((y[stop] / np.maximum(y[stop] - wanted[stop], 1e-300)).min())
            y = y + way * (wanted - y)
            held &= ~(stop & (y <= 1e-15 * np.abs(wanted).max()))
            y[~held] = 0.0
    return y


class Basis:
    """Orthonormal directions of the rows taken so far."""

    def __init__(self, n: int) -> None:
        self.Q = np.zeros((0, n), dtype=np.longdouble)
        self.rows = np.zeros((0, n))  # that gave them, at length one
        # their smallest singular value: when they change by one, Q turns by one over it
        self.weakest = 1.0

    def remove(self, y: np.ndarray) -> np.ndarray:
        """What of y is outside."""
        rest = y.astype(np.longdouble)
        for _ in range(2):
            for q in self.Q:
                rest = rest - (q @ rest) * q
        return rest.astype(float)

    def take(self, rows: np.ndarray, least: float = RANK) -> Basis:
        """This basis and the directions of further rows (m, n) that stand out by `least`."""
        basis = Basis(rows.shape[1])
        basis.Q, basis.rows, basis.weakest = self.Q, self.rows, self.weakest
        for a in rows:
            rest, size = basis.remove(a), float(np.linalg.norm(a))
            out = float(np.linalg.norm(rest))
            if out > least * size:
                basis.rows = np.vstack([basis.rows, a / size])
                unit = rest.astype(np.longdouble)
                basis.Q = np.vstack([basis.Q, unit / np.sqrt(unit @ unit)])
        if len(basis.rows) > len(self.rows):
            basis.weakest = float(np.linalg.svd(basis.rows, compute_uv=False)[-1])
        return basis

    def left_over(self, y: np.ndarray, pushing: np.ndarray, scale: float) -> float:
        """What of y no nonnegative weights on the rows `pushing` balance, relative to `scale`."""
        free = np.array([self.remove(a) for a in pushing]).reshape(-1, y.size)
        out = np.linalg.norm(free, axis=1)
        free, weakest = free[out > RANK], min([self.weakest, *out[out > RANK]])
        b = self.remove(y)
        weight = nonnegative_least_squares(free, b)
        left = float(np.linalg.norm(b + free.T @ weight))
        return left / ((scale + ROUNDING * float(weight.sum())) * (1.0 + ROUNDING / weakest))


def sides_at_limit(
    A: np.ndarray, lower: np.ndarray, upper: np.ndarray, x: np.ndarray
) -> np.ndarray:
    """Unit normals, pointing out, of the rows that stand at a limit."""
    norm = np.linalg.norm(A, axis=1)
    value, allowed = A @ x, AT_LIMIT * norm * max(1.0, float(np.abs(x).max()))
    unit = A / np.where(norm > 0, norm, 1.0)[:, None]
    over, under = value >= upper - allowed, value <= lower + allowed
    return np.vstack([unit[over & (norm > 0)], -unit[under & (norm > 0)]])


def level_residual(levels: list[Rows], k: int, x: np.ndarray, x_above: np.ndarray) -> float:
    """The worst relative residual of level k: rows above broken, forces, smallest step."""
    level, n = levels[k], x.size
    scale = max(1.0, float(np.abs(x).max()))
    above, pushing, worst = Basis(n), np.zeros((0, n)), 0.0
    for other in levels[:k]:
        above = above.take(other.A[other.equal])
        before, now = other.A @ x_above, other.A @ x
        lower = np.where(other.equal, before, np.minimum(other.lower, before))
        upper = np.where(other.equal, before, np.maximum(other.upper, before))
        size = np.maximum(np.linalg.norm(other.A, axis=1), 1e-300) * scale
        worst = max(worst, float((np.maximum(now - upper, lower - now) / size).max(initial=0.0)))
        free = ~other.equal
        found = sides_at_limit(other.A[free], lower[free], upper[free], x)
        pushing = np.vstack([pushing, found])
    if level.lower.size == 0:
        return max(worst, float(np.abs(x - x_above).max()) / scale)
    norm, step = np.linalg.norm(level.A, axis=1), x - x_above
    v = level.A @ x - np.clip(level.A @ x, level.lower, level.upper)
    forces = level.rho**2 * float(np.linalg.norm(step)) + float(np.abs(v) @ norm)
    forces = max(forces, 1e-3 * (float(norm.max()) ** 2 + level.rho**2) * scale)
    if forces > 0.0:
        worst = max(worst, above.left_over(level.rho**2 * step + level.A.T @ v, pushing, forces))
    if level.rho <= TINY * float(norm.max()):
        violated = ~level.equal & (np.abs(v) > AT_LIMIT * norm * scale)
        inside = ~level.equal & ~violated
        own = sides_at_limit(level.A[inside], level.lower[inside], level.upper[inside], x)
        both = np.vstack([pushing, own])
        settled = above.take(level.A[level.equal]).take(level.A[violated], DISTINCT)
        worst = max(worst, settled.left_over(step, both, scale))
    return worst


def residual(n: int, levels: list[Rows], x: list[np.ndarray]) -> float:
    """The worst residual of all levels; x as answers_by_level gives it."""
    above = [np.zeros(n), *x[:-1]]
    return max(level_residual(levels, k, x[k], above[k]) for k in range(len(levels)))
