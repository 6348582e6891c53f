"""What is right, in 130 digits: for answers that nothing in double or long double can judge.

    solver_proof --once --json --class thin_cones --rho 0.1 --seed 849 \
      | python benchmarks/exact_referee.py

Reads problems with our answers after each level, one a line. Every level is solved again from our
answer of the level above, as the point of least distance under its rows (solver.md, section 1; rho
= 0 is 1e-45), by nonnegative least squares (Lawson and Hanson, chapter 23). Two answers of it: to
the limits as they are, and moved outwards by 1e-12 |a| max(1, |x|), for limits that are known to
rounding leave x a play, in cones of 1e-8 rad 1e-4 of it. Printed are, a level:

    dx       our answer to the exact one
    play     the exact one to that with the wider limits
    worse    by how much a row above got worse in ours, relative to |a| max(1, |x|)
    violation, above exact      |violation| of ours, and how far that is above the exact one
    step, above exact           |t| of ours, likewise

Right is an answer with dx of the size of the play or below, or one that is neither more violated
nor longer than the exact one beyond rounding. Needs mpmath.
"""

from __future__ import annotations

import json
import sys

from mpmath import fdot, matrix, mp, mpf, sqrt

mp.dps = 130
NO_RHO = mpf(10) ** -45
RANK = mpf(10) ** -10  # solver.md, section 1
ABSENT = mpf(10) ** 20
PLAY = mpf("1e-12")

Numbers = list[mpf]


def dot(a: Numbers, b: Numbers) -> mpf:
    """The product of two vectors."""
    return fdot(zip(a, b, strict=True))


def length(a: Numbers) -> mpf:
    """The length of a vector."""
    return sqrt(dot(a, a))


def positive_solution(G: list[Numbers], b: Numbers) -> Numbers | None:
    """The x of G x = b, None where G is not positive definite to 100 digits."""
    try:
        return list(mp.cholesky_solve(matrix(G), matrix(b)))
    except (ValueError, ZeroDivisionError):
        return None


def weights(columns: list[Numbers], b: Numbers) -> Numbers:
    """The y >= 0 with the least |sum y_i column_i - b|."""
    y, held = [mpf(0)] * len(columns), []
    for _ in range(20 * len(columns) + 50):
        rest = [b[k] - fdot((y[i], columns[i][k]) for i in held) for k in range(len(b))]
        pulls = {i: dot(c, rest) for i, c in enumerate(columns) if i not in held}
        entering = max(pulls, key=pulls.__getitem__, default=None)
        if entering is None or pulls[entering] <= mpf(10) ** -100:
            break
        held.append(entering)
        while held:
            G = [[dot(columns[i], columns[j]) for j in held] for i in held]
            wanted = positive_solution(G, [dot(columns[i], b) for i in held])
            if wanted is None:
                held.remove(entering)
                break
            gone = [(i, w) for i, w in zip(held, wanted, strict=True) if w <= 0]
            way = min((y[i] / (y[i] - w) for i, w in gone), default=mpf(1))
            for i, w in zip(held, wanted, strict=True):
                y[i] += way * (w - y[i])
            if not gone:
                break
            for i, _w in gone:
                if y[i] <= mpf(10) ** -110:
                    y[i] = mpf(0)
                    held.remove(i)
    return y


def nearest(rows: list[Numbers], least: Numbers) -> Numbers:
    """The shortest z with row_i z >= least_i."""
    if all(value <= 0 for value in least):
        return [mpf(0)] * len(rows[0])
    sizes = [length(row) for row in rows]
    columns = [
        [c / s for c in row] + [value / s]
        for row, value, s in zip(rows, least, sizes, strict=True)
        if s > 0
    ]
    b = [mpf(0)] * len(rows[0]) + [mpf(1)]
    y = weights(columns, b)
    total = [fdot((w, c[k]) for w, c in zip(y, columns, strict=True)) for k in range(len(b))]
    return [value / (1 - total[-1]) for value in total[:-1]]


def free_directions(rows: list[Numbers], n: int) -> list[Numbers]:
    """An orthonormal basis of what equality rows leave free."""
    basis: list[Numbers] = []

    def add(a: Numbers, least: mpf) -> None:
        for q in basis:
            part = dot(q, a)
            a = [x - part * y for x, y in zip(a, q, strict=True)]
        if len(basis) < n and length(a) > least:
            basis.append([x / length(a) for x in a])

    for row in rows:
        if length(row) > 0:
            add([x / length(row) for x in row], RANK)
    rank = len(basis)
    for i in range(n):
        add([mpf(int(i == j)) for j in range(n)], mpf("0.01"))
    return basis[rank:]


class ReadLevel:
    """One level, its numbers exact."""

    def __init__(self, level: dict, n: int) -> None:
        def read(name: str) -> Numbers:
            return [mpf(float.fromhex(value)) for value in level[name]]

        self.lower, self.upper, self.x = read("lower"), read("upper"), read("x")
        numbers = read("A")
        identity = [[mpf(int(i == j)) for j in range(n)] for i in range(len(self.lower))]
        dense = [numbers[i * n : (i + 1) * n] for i in range(len(self.lower))]
        self.A = identity if level["bounds"] else dense
        self.rho = mpf(float.fromhex(level["rho"])) or NO_RHO

    def rows(self) -> zip:
        """(a, lower, upper) a row."""
        return zip(self.A, self.lower, self.upper, strict=True)

    def violation(self, x: Numbers) -> mpf:
        """Length of the violation at x."""
        return length([max(dot(a, x) - u, low - dot(a, x), mpf(0)) for a, low, u in self.rows()])


def exact(levels: list[ReadLevel], k: int, above: Numbers, play: mpf) -> Numbers:
    """The answer of level k from `above`, limits of rows above it moved outwards by `play`."""
    level, n = levels[k], len(above)
    equal = [a for other in levels[:k] for a, low, up in other.rows() if low == up]
    free, own, rows, least = free_directions(equal, n), len(level.A), [], []

    def limit(a: Numbers, low: mpf, up: mpf, slack: int, scale: mpf) -> None:
        """Adds  low <= a x - slack <= up in units (rho t, violation)."""
        e, here = [dot(z, a) / level.rho for z in free], dot(a, above)
        unit = [mpf(int(i == slack)) for i in range(own)]
        if up < ABSENT:
            rows.append([-c / scale for c in e] + unit)
            least.append((here - up) / scale)
        if low > -ABSENT:
            rows.append([c / scale for c in e] + [-c for c in unit])
            least.append((low - here) / scale)

    size = max([mpf(1)] + [abs(x) for x in level.x])
    for a, low, up in (row for other in levels[:k] for row in other.rows()):
        part = length([dot(z, a) for z in free])
        if low == up or part <= RANK * length(a):
            continue
        here, room = dot(a, above), play * length(a) * size
        limit(a, min(low, here) - room, max(up, here) + room, -1, length(a))
    for i, (a, low, up) in enumerate(level.rows()):
        limit(a, low, up, i, mpf(1))
    if not rows or not free:
        return above
    t = [value / level.rho for value in nearest(rows, least)[: len(free)]]
    return [x + fdot((s, z[j]) for s, z in zip(t, free, strict=True)) for j, x in enumerate(above)]


def worsened(levels: list[ReadLevel], k: int, above: Numbers) -> mpf:
    """By how much our level k made rows above it worse."""
    x = levels[k].x
    worst, size = mpf(0), max([mpf(1)] + [abs(value) for value in x])
    for a, low, up in (row for other in levels[:k] for row in other.rows() if any(row[0])):
        now, was = dot(a, x), dot(a, above)
        worse = abs(now - was) if low == up else max(now - max(up, was), min(low, was) - now)
        worst = max(worst, worse / length(a) / size)
    return worst


def report(problem: dict) -> None:
    """Prints what is exact of every level."""
    n = problem["n"]
    levels = [ReadLevel(level, n) for level in problem["levels"]]
    above = [mpf(0)] * n
    for k, level in enumerate(levels):
        answer, wide = exact(levels, k, above, mpf(0)), exact(levels, k, above, PLAY)

        def apart(a: Numbers, b: Numbers) -> mpf:
            return length([x - y for x, y in zip(a, b, strict=True)])

        violation, step = level.violation(level.x), apart(level.x, above)
        figures = {
            "dx": apart(level.x, answer),
            "play": apart(wide, answer),
            "worse": worsened(levels, k, above),
            "violation": violation,
            "above exact": violation - level.violation(answer),
            "step": step,
            "above exact ": step - apart(answer, above),
        }
        print(f"  level {k}", *(f"{name} {float(value):.2g}" for name, value in figures.items()))
        above = level.x


if __name__ == "__main__":
    for line in sys.stdin:
        if line.startswith("{"):
            report(json.loads(line))
