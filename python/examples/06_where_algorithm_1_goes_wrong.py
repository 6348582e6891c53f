"""Where Algorithm 1 of the thesis goes wrong: problems by `rhqp_thesis` and by the default.

Run:  python python/examples/06_where_algorithm_1_goes_wrong.py
"""

import numpy as np

from hurcules import rhqp

METHODS = ("rhqp_thesis", "lexicographic")
ROW = "{:50}  {:>16}  {:>12}"


def solve(levels, method, n):
    """The solution by a method, cold."""
    return rhqp.Solver(n, rhqp.SolverOptions(method=method, max_iterations=10_000)).solve(levels)


def equal(rows, target, rho=0.1):
    """A level of equality rows."""
    return rhqp.Level(rows, target, target, rho=rho)


print(ROW.format("", "Algorithm 1", "right"))

# a limit with rho = 0.1, as all levels of the thesis have it
one, goal = np.ones(1), equal(np.eye(1), np.array([5.0]))
thesis = solve([rhqp.Level(np.eye(1), -one, one, rho=0.1), goal], "rhqp_thesis", 1)
right = solve([rhqp.Bounds(-one, one), goal], "lexicographic", 1)
print(ROW.format("speed at a limit of 1", *(f"{s.x[0]:.3f}" for s in (thesis, right))))

# a box of 0.5, then seven levels of unit rows that want more than it allows: n = 19, cold
ends = []
for seed in range(60):
    rng = np.random.default_rng(seed)
    levels = [rhqp.Bounds(np.full(19, -0.5), np.full(19, 0.5))]
    for m in (3, 3, 3, 3, 3, 2, 2):
        J = rng.standard_normal((m, 19))
        levels.append(equal(J / np.linalg.norm(J, axis=1)[:, None], rng.uniform(-2, 2, m)))
    both = [solve(levels, method, 19) for method in METHODS]
    active = [np.sum(np.abs(s.x) > 0.5 - 1e-9) for s in both]
    ends.append([[np.linalg.norm(s.violations[1]) for s in both], active])
for what, mean in zip(("error of the first task", "active limits"), np.mean(ends, 0), strict=True):
    print(ROW.format(f"{what}, mean of 60", *mean.round(2)))

# Figure 3.5: the point below A and B nearest to (3, 0), from W = {A}: S never lets go of A
limits = rhqp.Level(np.array([[0.6, 0.8], [1.0, 0.0]]), np.full(2, -np.inf), np.ones(2))
pair = [rhqp.Solver(2, rhqp.SolverOptions(method=method)) for method in METHODS]
for point in (np.array([0.0, 9.0]), np.array([3.0, 0.0])):
    x = [s.solve([limits, equal(np.eye(2), point, 0.0)]).x.round(9) for s in pair]
print(ROW.format("Figure 3.5 from W = {A}", *(str(each + 0.0) for each in x)))

# limits, then two nearly singular tasks: more changes than there are working sets, so for ever
half = np.full(4, 0.5)
hold, pull = [[-1, -1, 2, -1], [-1.1, -1.1, 2.1, -1]], [[-1, -2, -2, 2], [-1.1, -1.9, -1.9, 2]]
tasks = [equal(np.array(hold), np.zeros(2)), equal(np.array(pull), np.array([1.0, -1.0]))]
thesis = solve([rhqp.Level(np.eye(4), -half, half, rho=0.1), *tasks], "rhqp_thesis", 4)
right = solve([rhqp.Bounds(-half, half), *tasks], "lexicographic", 4)
print(ROW.format("changes near a singularity", f"{thesis.changes}, no end", right.changes))
