"""Draws docs/sensitivity.png: the derivative jvp beside central differences of the solver.

All numbers of a hierarchy (A, lower, upper, rho) move along a random direction; a problem counts at
a step where working set, violated rows and ranks are the same on both sides. The difference of
an exact derivative falls with the square of the step until rounding takes over.

Run:  python benchmarks/figures/sensitivity.py [FILE]    about half a minute
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[2] / "tests" / "python"))

from hierarchies import CLASSES, to_levels
from hurcules import rhqp
from test_sensitivity import difference, direction

DOCS = Path(__file__).parents[2] / "docs"

PROBLEMS, STEPS = 30, np.logspace(-2, -11, 10)
AT = 4  # the step whose figures are printed


def errors(name: str, seed: int) -> np.ndarray:
    """|difference - jvp| / max(1, |jvp|) at each step, not a number where a piece ends."""
    rng = np.random.default_rng([seed, len(name)])
    n, levels = CLASSES[name](rng)
    # rows that depend on each other still do: "turn"
    changes = direction(levels, rng, "turn")
    exact = rhqp.Solver(n).solve(to_levels(levels)).jvp(changes)
    ends = [difference(n, levels, changes, float(step)) for step in STEPS]
    return np.array([np.nan if end is None else np.linalg.norm(end - exact) for end in ends]) / max(
        1.0, float(np.linalg.norm(exact))
    )


def main() -> None:
    """Draws the median and the worst of each class."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else DOCS / "sensitivity.png")
    figure, panels = plt.subplots(1, 2, figsize=(10, 3.6), sharey=True, layout="constrained")
    for name in CLASSES:
        found = np.array([errors(name, seed) for seed in range(PROBLEMS)])
        for axes, middle in zip(panels, (np.nanmedian, np.nanmax), strict=True):
            axes.loglog(STEPS, middle(found, axis=0), label=name)
        at, count = found[:, AT], np.isfinite(found[:, AT]).sum()
        print(f"{name}: at step {STEPS[AT]:.0e} {count} of {PROBLEMS} count, ", end="")
        print(f"median {np.nanmedian(at):.1e}, worst {np.nanmax(at):.1e}")
    for axes, title in zip(panels, ("median", "worst"), strict=True):
        axes.set(xlabel="step of the difference", title=f"{title} of {PROBLEMS} problems a class")
        axes.invert_xaxis()
    panels[0].set(ylabel="|difference - jvp| / max(1, |jvp|)")
    panels[0].legend(fontsize="small")
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
