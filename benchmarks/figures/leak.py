"""Draws docs/leak.png: what smooth hand-over costs the level that gives a direction back.

The sweeps are those of sweeps.py, rho 0.1. The leak is by how much the levels below move the
rows of the singular level; its bound is max(sigma w) sum |residual| / (2 rho), the residuals those
that the levels below have where each begins (cpp/hurcules/solver/problem/nullspace_bases.hpp).

Run:  python benchmarks/figures/leak.py [FILE]    ten seconds
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from sweeps import PROBLEMS, N, Sweep

from hurcules import rhqp

DOCS = Path(__file__).parents[2] / "docs"

RHO, SMOOTH = 0.1, rhqp.SolverOptions(handover="smooth")
SIGMAS = np.linspace(0.005, 0.2, 40)


def weight(sigma: np.ndarray) -> np.ndarray:
    """How much of a direction of this singular value goes to unit rows below."""
    h = np.where(sigma < RHO, (1 - (sigma / RHO) ** 2) ** 2, 0.0)
    return np.sqrt(h * RHO**2 / (1 - h + h * RHO**2))


def leak(one: Sweep, sigma: float) -> tuple[float, float]:
    """The leak, and the sum of the residuals that the levels below begin with."""
    levels = one.at(sigma, RHO)
    first = 3 if one.boxed else 2  # level behind the singular one
    ends = [rhqp.Solver(N, SMOOTH).solve(levels[:k]).x for k in range(first, len(levels) + 1)]
    below = zip(levels[first:], ends, strict=False)
    residuals = sum(float(np.linalg.norm(v.lower - v.A @ x)) for v, x in below)
    return float(np.linalg.norm(levels[first - 1].A @ (ends[-1] - ends[0]))), residuals


def main() -> None:
    """Draws leak / sum |residual| over sigma, and the bound."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else DOCS / "leak.png")
    figure, axes = plt.subplots(figsize=(6.5, 3.6), layout="constrained")
    fine = np.linspace(1e-4, RHO, 2000)
    bound = float((fine * weight(fine)).max() / (2 * RHO))
    axes.axhline(bound, color="black", linewidth=0.8, label="bound")
    print(f"bound {bound:.4f}; weight {weight(np.array([0.01, 0.05, 0.09])).round(3)}")
    for boxed in (False, True):
        for algorithmic in (False, True):
            name = ("algorithmic" if algorithmic else "kinematic") + (", box" if boxed else "")
            found = np.array(
                [
                    [leak(Sweep(algorithmic, boxed, seed), float(s)) for s in SIGMAS]
                    for seed in range(PROBLEMS)
                ]
            )
            part = found[..., 0] / found[..., 1]
            axes.semilogy(SIGMAS, np.maximum(part.max(axis=0), 1e-17), label=name)
            print(f"{name}: leak at most {part.max():.4f} of the residuals, ", end="")
            print(f"{found[..., 0].max():.3f} in all, {part[:, SIGMAS > RHO].max():.0e} above rho")
    axes.set(xlabel="sigma", ylabel="leak / sum of |residual|", ylim=(1e-17, 1))
    axes.legend(fontsize="small")
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
