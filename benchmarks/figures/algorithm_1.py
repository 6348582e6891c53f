"""Draws docs/algorithm-1.png: where Algorithm 1 of the thesis goes wrong, beside the default.

Run:  python benchmarks/figures/algorithm_1.py [FILE]    about half a minute
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

import hurcules
from hurcules import rhqp

DOCS = Path(__file__).parents[2] / "docs"

METHODS = {"rhqp_thesis": ("Algorithm 1", "tab:red"), "lexicographic": ("default", "tab:blue")}
N = 19


def solver(n: int, method: str) -> rhqp.Solver:
    """A solver by the name of its method."""
    return rhqp.Solver(n, rhqp.SolverOptions(method=method))


def conflict(seed: int, width: float) -> list[rhqp.Level]:
    """A box, then seven levels of unit rows that want up to 2."""
    rng = np.random.default_rng(seed)
    levels = [rhqp.Bounds(np.full(N, -width), np.full(N, width))]
    for m in (3, 3, 3, 3, 3, 2, 2):
        A = rng.standard_normal((m, N))
        y = rng.uniform(-2, 2, m)
        levels.append(rhqp.Level(A / np.linalg.norm(A, axis=1)[:, None], y, y, rho=0.1))
    return levels


def draw_errors(axes: plt.Axes) -> None:
    """Error of the first task by both methods, for boxes from narrow to wide."""
    for width, colour in ((0.3, "tab:purple"), (0.5, "tab:red"), (1.0, "tab:orange")):
        ends = [
            [
                np.linalg.norm(solver(N, method).solve(conflict(seed, width)).violations[1])
                for method in ("lexicographic", "rhqp_thesis")
            ]
            for seed in range(60)
        ]
        axes.loglog(*np.transpose(ends), ".", color=colour, label=f"limits of {width}")
        print(f"limits of {width}: default, Algorithm 1 {np.mean(ends, axis=0).round(3)}")
    axes.plot([5e-3, 3], [5e-3, 3], "k-", linewidth=0.5)
    axes.set(xlabel="default", ylabel="Algorithm 1", title="error of the first task, 60 problems")
    axes.legend()


def draw_plane(axes: plt.Axes) -> None:
    """Figure 3.5 of the thesis, started with A in the working set."""
    limits = rhqp.Level(np.array([[0.6, 0.8], [1.0, 0.0]]), np.full(2, -np.inf), np.ones(2))
    axes.plot([-1, 3], [2.0, -1.0], "k-", [1, 1], [-1, 2], "k-", linewidth=0.8)
    axes.annotate("A", (-0.2, 1.5))
    axes.annotate("B", (1.05, 1.7))
    axes.plot(3, 0, "k*", label="goal")
    for method, (name, colour) in METHODS.items():
        one = solver(2, method)
        for goal in (np.array([0.0, 9.0]), np.array([3.0, 0.0])):
            x = one.solve([limits, rhqp.Level(np.eye(2), goal, goal)]).x
        axes.plot(*x, "o", color=colour, label=f"{name}: ({x[0]:.1f}, {abs(x[1]):.1f})")
    axes.set(xlim=(-1, 3.3), ylim=(-1, 2), aspect="equal", title="Figure 3.5 from W = {A}")
    axes.legend(loc="upper right")


def draw_stretch(axes: plt.Axes) -> None:
    """How far the hands are off in the mission, whose limits bound accelerations too."""
    for method, (name, colour) in METHODS.items():
        simulation = hurcules.Simulation("stretch", seed=0, method=method)
        times, errors = [], []
        hands = simulation.levels.index("hpos")
        while simulation.time < 20.0 and not simulation.finished:
            simulation.step(50)
            times.append(simulation.time)
            errors.append(max(simulation.level_errors()[hands], 1e-6))
        axes.semilogy(times, errors, color=colour, label=name)
        print(f"stretch, {name}: largest hand error {max(errors):.2g} m")
    axes.set(xlabel="time [s]", ylabel="hands [m]", title="stretch: error of the hands")
    axes.legend()


def main() -> None:
    """Draws the three panels."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else DOCS / "algorithm-1.png")
    figure, panels = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    for draw, axes in zip((draw_errors, draw_plane, draw_stretch), panels, strict=True):
        draw(axes)
    figure.savefig(target, dpi=90)


if __name__ == "__main__":
    main()
