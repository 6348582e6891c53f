"""Draws docs/continuity.png: does the answer jump while the numbers of a hierarchy move?

The paths and the peers are those of benchmarks/continuity.py. Above, |dx| / step along one path on
which a row is let go: a jump is a peak, ten times as high with a tenth of the step. Below, the
worst of 24 paths over the step: level where the answer is continuous, a slope of minus one where
it jumps.

Run:  python benchmarks/figures/continuity.py [FILE]    about two minutes
"""

import sys
from itertools import pairwise
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1]))

from continuity import KINDS, STEPS, targets_move, worst_slopes
from continuity import Path as TargetPath
from motions import with_rho
from peers import Cascade, DaqpHierarchy, Ours, Peer, attempt

DOCS = Path(__file__).parents[2] / "docs"

# a path on which a row is let go
SEED, WINDOW = 7, (0.3, 0.42)
TRACED = {2e-3: "tab:orange", 2e-4: "tab:blue"}
ONE_PATH: tuple[tuple[Peer, float, str], ...] = (
    (Ours(warm=True), 0.1, "default"),
    (Cascade("quadprog", frozen=True), 0.1, "rows pushed against are frozen"),
    (DaqpHierarchy(), 0.0, "daqp, hierarchy, rho = 0"),
)
PATHS, LENGTH = 24, 0.4
LINES: tuple[tuple[Peer, float, str, str], ...] = (
    (Ours(warm=True), 0.1, "default, rho = 0.1", "o-C0"),
    (Ours(warm=True, handover="smooth"), 0.1, "smooth hand-over, rho = 0.1", "s--C9"),
    (Ours(warm=True), 0.0, "default, rho = 0", "^-C7"),
    (Cascade("quadprog", frozen=True), 0.1, "frozen rows, rho = 0.1", "v-C3"),
    (DaqpHierarchy(), 0.0, "daqp, rho = 0", "d:C1"),
)


def slopes(peer: Peer, rho: float, path: TargetPath, step: float) -> np.ndarray:
    """|dx| / step along the path, not a number where there is no answer."""
    ends = [attempt(peer, with_rho(path(s), rho))[0] for s in np.arange(*WINDOW, step)]
    moves = [
        np.nan if a is None or b is None else float(np.linalg.norm(b - a))
        for a, b in pairwise(ends)
    ]
    return np.array(moves) / step


def draw_one_path(panels: np.ndarray) -> None:
    """A panel for each solver."""
    for (peer, rho, name), axes in zip(ONE_PATH, panels, strict=True):
        for step, colour in reversed(TRACED.items()):
            path = targets_move(np.random.default_rng(SEED))
            slope = slopes(peer, rho, path, step)
            s = WINDOW[0] + step * np.arange(len(slope))
            axes.semilogy(s, slope, color=colour, linewidth=1, label=f"step {step:g}")
            print(f"{name}, step {step:g}: worst {np.nanmax(slope):.0f}, ", end="")
            print(f"{np.isnan(slope).sum()} missing")
        axes.set(title=f"one path: {name}", xlabel="path of the targets", ylim=(1, 1e3))
    panels[0].set(ylabel="|dx| / step")
    panels[0].legend()


def draw_all_paths(panels: np.ndarray) -> None:
    """A panel for each kind of path."""
    for (kind, make), axes in zip(KINDS.items(), panels, strict=True):
        rng = np.random.default_rng(1)
        paths = [make(rng) for _ in range(PATHS)]
        for peer, rho, name, style in LINES:
            worst, _ = worst_slopes(peer, rho, paths, LENGTH)
            axes.loglog(STEPS, worst, style, label=name, linewidth=1, markersize=4)
            print(f"{kind}, {name}: {', '.join(f'{slope:.0f}' for slope in worst)}")
        axes.set_title(f"{PATHS} paths: {kind}", fontsize="medium")
        axes.set(xlabel="step", ylim=(10, 1e7))
        axes.invert_xaxis()
    panels[0].set(ylabel="worst |dx| / step")
    panels[0].legend(fontsize="x-small")


def main() -> None:
    """Draws the panels."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else DOCS / "continuity.png")
    figure = plt.figure(figsize=(13, 7), layout="constrained")
    above, below = figure.subfigures(2)
    draw_one_path(above.subplots(1, len(ONE_PATH), sharey=True))
    draw_all_paths(below.subplots(1, len(KINDS), sharey=True))
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
