"""Solve a hierarchy: three unknowns, limits first, then two wishes that cannot both be met.

Run:  python python/examples/01_solve_a_hierarchy.py
"""

import numpy as np

from hurcules import rhqp

# level 0: each unknown stays within +-1 (simple bounds, never regularised)
limits = rhqp.Bounds(-np.ones(3), np.ones(3))

# level 1: x0 + x1 + x2 = 2, an equality: lower == upper
total = rhqp.Level(np.array([[1.0, 1.0, 1.0]]), np.array([2.0]), np.array([2.0]))

# level 2: x0 = 1.5 (against the limits) and x1 - x2 at least 0.5
wishes = rhqp.Level(
    np.array([[1.0, 0.0, 0.0], [0.0, 1.0, -1.0]]),
    np.array([1.5, 0.5]),
    np.array([1.5, np.inf]),
)

solver = rhqp.Solver(3)
solution = solver.solve([limits, total, wishes])

print(f"x = {solution.x.round(4)}   {solution.status.name}")
for level, violation in enumerate(solution.violations):
    print(f"level {level}: violated by {np.abs(violation).max():.3g}")
for row in solution.working_set:
    print(f"held: row {row.row} of level {row.level} at its {row.side.name.lower()} side")
print(f"cold: {solution.factorizations} factorizations, {solution.changes} changes")

# the same again: the solver remembers which rows held, so that one factorization a level is enough
again = solver.solve([limits, total, wishes])
print(f"warm: {again.factorizations} factorizations, {again.changes} changes")
print(f"own proof of optimality, worst residual: {again.optimality:.1e}")
