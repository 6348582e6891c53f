"""Draws docs/force.png: force control in the physics, from the runs of K05, K11, K17, K18.

Upper row: both hands go down onto ground that lies 30 mm higher than expected, by law; the entry
with a blend and without; impact with and without the elbow springs. Lower row: the reach along the
ground: the force as read, the limits in turn, the commanded speeds.

Run:  python benchmarks/figures/force.py [FILE]    five minutes
"""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.axes import Axes

from hurcules import ForceGains
from hurcules_studies.thesis.measures.force_entry import entered
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_lowering import by_law, lowered
from hurcules_studies.thesis.measures.force_reach import reach
from hurcules_studies.thesis.measures.press_robot import Setting
from hurcules_studies.thesis.measures.press_scene import Surface

DOCS = Path(__file__).parents[2] / "docs"

DESIRED = -5.0  # [N]


def laws(axes: Axes) -> None:
    """The laws of section 5.4 by accelerations."""
    for name in ("P", "PI", "velocity"):
        log = by_law(name)
        axes.plot(log.time, log.force[:, 0], label=name)
    axes.set(title="Laws, ground 30 mm off", xlim=(3.5, 7.0), ylabel="force read [N]")


def entry(axes: Axes) -> None:
    """Speed of the hip where the force control begins."""
    for label, blend in (("at once", 0.0), ("blend 0.1 s", 0.1)):
        log = entered(blend)
        part = log.part(20.5, 22.0)
        axes.plot(log.time[part], log.qd[part, log.of("HIP")], label=label)
    axes.set(title="Entry at 2.5 N: hip", ylabel="[rad/s]")


def impact(axes: Axes) -> None:
    """Forces on the floor at 0.05 m/s."""
    gains = ForceGains(compliance=0.01)
    for label, surface, told in (("rigid", Surface(springs=False), 5e4), ("spring", Surface(), G)):
        log = lowered(Setting(surface, gains, told, f_max=1e6), 0.05, 3.5)
        part = log.part(2.0)
        axes.plot(log.time[part], log.contact[part, 0, 2], label=label, lw=0.8)
    axes.set(title="Impact at 0.05 m/s", ylabel="force on the ground [N]")


def slide(axes: tuple[Axes, Axes, Axes]) -> None:
    """The reach of K08 to K11."""
    log = reach(0.05)
    for C in (0.05, 0.10):
        one = reach(C)
        axes[0].plot(one.time, one.force[:, 0], label=f"C = {C:g} m/N", lw=0.8)
    axes[0].set(title="Reach: force read", ylabel="[N]", ylim=(-9, 0.5))
    for name in ("HIP", "LSP", "KN", "LEB"):
        axes[1].plot(log.time, log.q[:, log.of(name)], label=name)
        axes[2].plot(log.time, log.qd[:, log.of(name)], label=name)
    axes[1].set(title="Limits: 8, 11, 11 s; elbow straight 12 s", ylabel="[rad]")
    axes[2].set(title="Speeds", ylabel="[rad/s]")
    for one in axes:
        one.set_xlim(3.0, 17.5)
        for time in (8.0, 11.0, 12.0):
            one.axvline(time, color="0.8", lw=0.8, zorder=0)


def main() -> None:
    """Draws the six."""
    target = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "force.png"
    figure, axes = plt.subplots(2, 3, figsize=(13, 6.5), layout="constrained")
    laws(axes[0, 0])
    entry(axes[0, 1])
    impact(axes[0, 2])
    slide(tuple(axes[1]))
    for one in axes.flat:
        one.legend(frameon=False, fontsize=8)
        one.set_xlabel("time [s]")
        one.grid(alpha=0.2)
    for one in (axes[0, 0], axes[1, 0]):
        one.axhline(DESIRED, color="0.3", lw=0.8, ls="--", zorder=0)
    figure.savefig(target, dpi=90)


if __name__ == "__main__":
    main()
