"""Draws docs/sweeps.png: a row comes to depend on others, sigma from 1 down to 1e-12.

n = 19, levels of 3, 3, 3, 3, 3, 2, 2 unit equality rows. Row 2 of the second level is, but for
sigma, in the span of the rows of its own level (kinematic singularity) or of the level above
(algorithmic); without limits and in a box |x| <= 1. The worst of 20 problems is drawn: |x|; the
slope |dx| / |dsigma| between neighbours, where a jump stands out by as much as the grid is fine.
Below, every answer once more: what an option changes in x, smooth hand-over beside the strict rule
and adaptive beside no regularisation, over the smallest singular value of all levels (no change at
all is drawn at 1e-16).

Run:  python benchmarks/figures/sweeps.py [FILE]    ten seconds
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from hurcules import rhqp

DOCS = Path(__file__).parents[2] / "docs"

N, ROWS, PROBLEMS, A_DECADE = 19, (3, 3, 3, 3, 3, 2, 2), 20, 40
SIGMAS = np.logspace(0, -12, 12 * A_DECADE + 1)
KINDS = {
    "rho = 0, strict": (0.0, rhqp.SolverOptions(), "tab:gray"),
    "rho = 0.1, strict": (0.1, rhqp.SolverOptions(), "tab:red"),
    "rho = 0.1, smooth": (0.1, rhqp.SolverOptions(handover="smooth"), "tab:blue"),
    "rho = 0.1, adaptive, strict": (
        0.1,
        rhqp.SolverOptions(regularization="adaptive"),
        "tab:orange",
    ),
}
EFFECTS = {
    "rho = 0.1, smooth": "rho = 0.1, strict",
    "rho = 0.1, adaptive, strict": "rho = 0, strict",
}


class Sweep:
    """A hierarchy whose second level has a row that depends on others at sigma = 0."""

    def __init__(self, algorithmic: bool, boxed: bool, seed: int) -> None:
        rng = np.random.default_rng(seed)
        self.boxed = boxed
        self.rows = [rng.standard_normal((m, N)) for m in ROWS]
        self.rows = [A / np.linalg.norm(A, axis=1)[:, None] for A in self.rows]
        self.targets = [rng.uniform(-1, 1, m) for m in ROWS]
        source = self.rows[0] if algorithmic else self.rows[1][:2]
        self.inside = rng.standard_normal(len(source)) @ source
        self.inside /= np.linalg.norm(self.inside)
        outside = rng.standard_normal(N)
        seen = np.linalg.qr(np.vstack([self.rows[0], self.rows[1][:2]]).T)[0]
        outside -= seen @ (seen.T @ outside)
        self.outside = outside / np.linalg.norm(outside)

    def at(self, sigma: float, rho: float) -> list[rhqp.Level]:
        """The levels at sigma."""
        rows = [A.copy() for A in self.rows]
        rows[1][2] = np.sqrt(1 - sigma**2) * self.inside + sigma * self.outside
        levels = [rhqp.Level(A, y, y, rho=rho) for A, y in zip(rows, self.targets, strict=True)]
        box = [rhqp.Bounds(np.full(N, -1.0), np.full(N, 1.0))] if self.boxed else []
        return box + levels


def sweep(one: Sweep, name: str) -> tuple[np.ndarray, int]:
    """Answers at each sigma, (sigmas, n), and the number of answers that are not proven."""
    rho, options, _ = KINDS[name]
    solver = rhqp.Solver(N, options)
    solutions = [solver.solve(one.at(sigma, rho)) for sigma in SIGMAS]
    unproven = sum(not solution.optimality <= 1e-9 for solution in solutions)
    return np.array([solution.x for solution in solutions]), unproven


def worst(lengths: np.ndarray) -> np.ndarray:
    """The largest of all problems at each sigma, from (problems, sigmas, n)."""
    return np.linalg.norm(lengths, axis=2).max(axis=0)


def draw(axes: np.ndarray, algorithmic: bool, boxed: bool) -> None:
    """Three panels of one kind of singularity."""
    title = ("algorithmic" if algorithmic else "kinematic") + (", box" if boxed else "")
    problems = [Sweep(algorithmic, boxed, seed) for seed in range(PROBLEMS)]
    weak, answers = SIGMAS[1:] < 1e-6, {}
    for name, (_, _, colour) in KINDS.items():
        runs = [sweep(one, name) for one in problems]
        x = answers[name] = np.array([run[0] for run in runs])
        size, step = worst(x), worst(np.diff(x, axis=1))
        slope = step / -np.diff(SIGMAS)
        axes[0].loglog(SIGMAS, size, color=colour, label=name)
        axes[1].loglog(SIGMAS[1:], slope, color=colour)
        print(f"{title}; {name}: |x| <= {size.max():.3g}, |dx| <= {step[weak].max():.2g} and slope")
        print(f"  <= {slope[weak].max():.2g} below 1e-6; {sum(run[1] for run in runs)} not proven")
    least = np.array([[smallest(one.at(sigma, 0.1)) for sigma in SIGMAS] for one in problems])
    for name, plain in EFFECTS.items():
        effect = np.linalg.norm(answers[name] - answers[plain], axis=2)
        style = {"marker": ".", "markersize": 1, "linestyle": "none", "color": KINDS[name][2]}
        axes[2].loglog(least.ravel(), np.maximum(effect, 1e-16).ravel(), **style)
        regular = least >= 0.1
        print(f"  {name} beside {plain}: at most {effect[regular].max():.1g}", end="")
        print(f" on {regular.sum()} of {regular.size} answers without a singular value below 0.1")
    axes[0].set(title=title, ylim=(0.5, 1e7))
    axes[1].set(xlabel="sigma", ylim=(1e-4, 1e13))
    axes[2].set(xlabel="smallest singular value of all levels", ylim=(3e-17, 1e3))


def smallest(levels: list[rhqp.Level]) -> float:
    """The smallest singular value of a level in what is left to it; 0 where a rank is lost."""
    reports = rhqp.Solver(N).solve(levels).levels
    return min(float(r.singular_values.min()) for r in reports if len(r.singular_values))


def main() -> None:
    """Draws the panels."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else DOCS / "sweeps.png")
    figure, panels = plt.subplots(
        3, 4, figsize=(13, 8.5), sharex="row", sharey="row", layout="constrained"
    )
    for column in range(4):
        draw(panels[:, column], algorithmic=column % 2 == 1, boxed=column >= 2)
    span = {"xlim": (1, 1e-12), "xticks": 10.0 ** np.arange(-10, 0, 3)}
    panels[0, 0].set(ylabel="largest |x|", **span)
    panels[1, 0].set(ylabel="largest |dx| / |dsigma|", **span)
    panels[2, 0].set(ylabel="what the option changes in x", xlim=(1, 1e-3))
    panels[0, 0].legend(fontsize="small")
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
