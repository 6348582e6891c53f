"""Draws docs/sweeps.png: a row comes to depend on others, sigma from 1 down to 1e-12.

n = 19, levels of 3, 3, 3, 3, 3, 2, 2 unit equality rows. Row 2 of the second level is, but for
sigma, in the span of the rows of its own level (kinematic singularity) or of the level above
(algorithmic); without limits and in a box |x| <= 1. The worst of 20 problems is drawn.

Run:  python docs/make_sweeps.py [FILE]    ten seconds
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from hurcules import rhqp

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


def sweep(one: Sweep, rho: float, options: rhqp.SolverOptions) -> tuple[np.ndarray, ...]:
    """|x| at each sigma, |dx| between neighbours, and the optimality of each answer."""
    solver = rhqp.Solver(N, options)
    solutions = [solver.solve(one.at(sigma, rho)) for sigma in SIGMAS]
    xs = np.array([solution.x for solution in solutions])
    step = np.linalg.norm(np.diff(xs, axis=0, prepend=xs[:1]), axis=1)
    return np.linalg.norm(xs, axis=1), step, np.array([s.optimality for s in solutions])


def draw(axes: np.ndarray, algorithmic: bool, boxed: bool) -> None:
    """Two panels of one kind of singularity."""
    title = ("algorithmic" if algorithmic else "kinematic") + (", box" if boxed else "")
    for name, (rho, options, colour) in KINDS.items():
        ends = [sweep(Sweep(algorithmic, boxed, seed), rho, options) for seed in range(PROBLEMS)]
        size, step, proof = (np.max(part, axis=0) for part in zip(*ends, strict=True))
        axes[0].loglog(SIGMAS, size, color=colour, label=name)
        axes[1].loglog(SIGMAS, np.maximum(step, 1e-16), color=colour)
        weak = SIGMAS < 1e-6
        print(f"{title}; {name}: |x| <= {size.max():.3g}, |dx| <= {step.max():.3g}, ", end="")
        print(f"{step[weak].max():.2g} below 1e-6; {(proof > 1e-9).sum()} not proven")
    axes[0].set(title=title, ylim=(0.5, 1e7))
    axes[1].set(xlabel="sigma", ylim=(1e-16, 1e7))


def main() -> None:
    """Draws the eight panels."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("sweeps.png"))
    figure, panels = plt.subplots(
        2, 4, figsize=(13, 6), sharex=True, sharey="row", layout="constrained"
    )
    for column in range(4):
        draw(panels[:, column], algorithmic=column % 2 == 1, boxed=column >= 2)
    panels[0, 0].set(ylabel="largest |x|", xlim=(1, 1e-12), xticks=10.0 ** np.arange(-10, 0, 3))
    panels[1, 0].set(ylabel=f"largest |dx| in 1/{A_DECADE} of a decade")
    panels[0, 0].legend(fontsize="small")
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
