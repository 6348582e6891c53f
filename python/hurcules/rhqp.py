"""The regularised hierarchical quadratic program: levels of bounded rows by priority.

Level k asks `lower <= A x <= upper` and takes what the levels above leave:

    solver = rhqp.Solver(3)
    solution = solver.solve([rhqp.Bounds(-ones, ones), rhqp.Level(A, b, b, rho=0.1)])
    solution.x, solution.status, solution.violations
"""

from hurcules._core import (
    ActiveRow,
    Bounds,
    Level,
    Side,
    Solution,
    Solver,
    SolverOptions,
    Status,
    method_names,
)

__all__ = [
    "ActiveRow",
    "Bounds",
    "Level",
    "Side",
    "Solution",
    "Solver",
    "SolverOptions",
    "Status",
    "method_names",
]
