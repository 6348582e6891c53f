"""The regularised hierarchical quadratic program: levels of bounded rows by priority.

Level k asks `lower <= A x <= upper` and takes what the levels above leave:

    solver = rhqp.Solver(3)
    solution = solver.solve([rhqp.Bounds(-ones, ones), rhqp.Level(A, b, b, rho=0.1)])
    solution.x, solution.status, solution.violations
    solution.levels[1].rank, solution.levels[1].infeasible
    solution.vjp(x_bar), solution.jvp(changes)        # how x moves with A, lower, upper, rho

A level holds float64 arrays in C order and does not copy them: write into them and solve again. A
solution keeps what it needs and never changes.
"""

from hurcules._core import (
    ActiveRow,
    Bounds,
    BoundsStack,
    Level,
    LevelChange,
    LevelReport,
    LevelStack,
    Side,
    Solution,
    Solver,
    SolverOptions,
    Status,
    method_names,
    solve_batch,
)

__all__ = [
    "ActiveRow",
    "Bounds",
    "BoundsStack",
    "Level",
    "LevelChange",
    "LevelReport",
    "LevelStack",
    "Side",
    "Solution",
    "Solver",
    "SolverOptions",
    "Status",
    "method_names",
    "solve_batch",
]
