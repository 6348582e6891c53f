"""Draws docs/continuity.png: |dx| / step while the targets of conflicting levels move.

The path and the peers are those of benchmarks/continuity.py: where the answer jumps, a step of a
tenth makes a peak ten times as high.

Run:  python docs/make_continuity.py [FILE]    about half a minute
"""

import sys
from itertools import pairwise
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

sys.path.insert(0, str(Path(__file__).parent.parent / "benchmarks"))

from continuity import Path as TargetPath
from continuity import targets_move
from motions import with_rho
from peers import Cascade, DaqpHierarchy, Ours, Peer, attempt

# a path on which a row is let go
SEED, WINDOW = 7, (0.3, 0.42)
STEPS = {2e-3: "tab:orange", 2e-4: "tab:blue"}
PEERS: tuple[tuple[Peer, float, str], ...] = (
    (Ours(warm=True), 0.1, "default"),
    (Cascade("quadprog", frozen=True), 0.1, "rows pushed against are frozen"),
    (DaqpHierarchy(), 0.0, "daqp, hierarchy, rho = 0"),
)


def slopes(peer: Peer, rho: float, path: TargetPath, step: float) -> np.ndarray:
    """|dx| / step along the path, not a number where there is no answer."""
    ends = [attempt(peer, with_rho(path(s), rho))[0] for s in np.arange(*WINDOW, step)]
    moves = [
        np.nan if a is None or b is None else float(np.linalg.norm(b - a))
        for a, b in pairwise(ends)
    ]
    return np.array(moves) / step


def main() -> None:
    """Draws a panel for each solver."""
    target = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).with_name("continuity.png"))
    figure, panels = plt.subplots(1, 3, figsize=(13, 3.6), sharey=True, layout="constrained")
    for (peer, rho, name), axes in zip(PEERS, panels, strict=True):
        for step, colour in reversed(STEPS.items()):
            path = targets_move(np.random.default_rng(SEED))
            slope = slopes(peer, rho, path, step)
            s = WINDOW[0] + step * np.arange(len(slope))
            axes.semilogy(s, slope, color=colour, linewidth=1, label=f"step {step:g}")
            print(f"{name}, step {step:g}: worst {np.nanmax(slope):.0f}, ", end="")
            print(f"{np.isnan(slope).sum()} missing")
        axes.set(title=name, xlabel="path of the targets")
    panels[0].set(ylabel="|dx| / step")
    panels[0].legend()
    figure.savefig(target, dpi=80)


if __name__ == "__main__":
    main()
