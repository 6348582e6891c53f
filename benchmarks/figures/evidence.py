"""Draws docs/evidence.png from docs/evidence.json, what benchmarks/evidence.py measured.

Left: success of the deterministic policy while it learns, median and range of the seeds. Then, a
dot a seed: success without physics and in it; what was measured in the physics, of the actions
drawn in training and of the last policy: excess over limits, self-contact.

Run:  python benchmarks/figures/evidence.py [JSON] [FILE]
Prints the tables of docs/evidence.md too.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes

DOCS = Path(__file__).parents[2] / "docs"
COLOURS = {
    "twist": "#1b6ca8",
    "delta": "#2a9d6f",
    "joint": "#d1495b",
    "least squares": "#8d6a9f",
}
ENOUGH = 0.8  # share of successes that counts as learnt

Row = dict[str, Any]


def of(rows: list[Row], layer: str, algorithm: str = "ppo") -> list[Row]:
    """The runs of a layer."""
    return [row for row in rows if (row["layer"], row["algorithm"]) == (layer, algorithm)]


def first(row: Row) -> float:
    """Steps to 80 % success, inf for never."""
    return next((n for n, share in row["curve"] if share >= ENOUGH), np.inf)


def training(row: Row, name: str) -> list[float]:
    """A figure of the actions drawn in training, at each look at them."""
    return [look[name] for look in row["training"]]


def curves(axes: Axes, rows: list[Row]) -> None:
    """Success while it learns."""
    for layer, colour in COLOURS.items():
        found = of(rows, layer)
        if not found:
            continue
        steps = np.array(found[0]["curve"])[:, 0] / 1000.0
        shares = 100.0 * np.array([np.array(row["curve"])[:, 1] for row in found])
        axes.plot(steps, np.median(shares, axis=0), color=colour, label=layer)
        axes.fill_between(steps, shares.min(axis=0), shares.max(axis=0), color=colour, alpha=0.15)
    axes.set_title("Success of the policy while it learns, median and range", fontsize=10)
    axes.set(xlabel="steps [1000]", ylabel="success [%]")
    axes.legend(frameon=False, fontsize=8)


def pairs(axes: Axes, rows: list[Row], title: str, names: tuple[str, str], value: Any) -> None:
    """Two figures of each run, by layer: a dot a seed, a bar for the median."""
    for place, (layer, colour) in enumerate(COLOURS.items()):
        for k, mark in enumerate(("o", "s")):
            values = [value(row, k) for row in of(rows, layer)]
            if not values:
                continue
            x = place + 0.36 * (k - 0.5)
            axes.bar(x, np.median(values), 0.32, color=colour, alpha=(0.25, 0.6)[k])
            axes.scatter([x] * len(values), values, s=14, color=colour, marker=mark, zorder=3)
    axes.set_title(f"{title}: left {names[0]}, right {names[1]}", fontsize=10)
    axes.set_xlim(-0.5, len(COLOURS) - 0.5)
    axes.set_xticks(range(len(COLOURS)), [name.replace(" ", "\n") for name in COLOURS])


def excess(row: Row, k: int) -> float:
    """[mrad] worst over a limit: in training, of the last policy."""
    return 1e3 * (max(training(row, "limit_excess")), row["exact"]["limit_excess"])[k]


def contact(row: Row, k: int) -> float:
    """[%] of the steps with self-contact: in training, of the last policy."""
    trained = float(np.mean(training(row, "self_contacts")))
    return 100.0 * (trained, row["exact"]["self_contacts"])[k]


def success(row: Row, k: int) -> float:
    """[%] without physics, in it."""
    return 100.0 * row[("kinematic", "exact")[k]]["success"]


def spread(values: list[float], text: str = "{:.0f}") -> str:
    """Median and range in words."""

    def word(value: float) -> str:
        return text.format(value) if np.isfinite(value) else "never"

    low, high = word(min(values)), word(max(values))
    middle = word(float(np.median(values)))
    return middle if low == high else f"{middle} ({low} to {high})"


def table(rows: list[Row], algorithm: str) -> str:
    """What the page says, a line a layer."""
    lines = [
        "| layer | seeds | steps to 80 % | `kinematic` | `exact` | other robot |"
        " over a limit [mrad], training | `exact` | self-contact, training | `exact` |"
        " falls, training | `exact` |",
        "|" + "---|" * 12,
    ]
    for layer in COLOURS:
        found = of(rows, layer, algorithm)
        if not found:
            continue
        other = [100.0 * row["manipulation"]["success"] for row in found if "manipulation" in row]
        falls = [100.0 * float(np.mean(training(row, "falls"))) for row in found]
        cells = [
            layer, str(len(found)), spread([round(first(row), -3) for row in found], "{:,.0f}"),
            *(spread([success(row, k) for row in found]) + " %" for k in (0, 1)),
            spread(other) + " %" if other else "",
            *(spread([excess(row, k) for row in found], "{:.1f}") for k in (0, 1)),
            *(spread([contact(row, k) for row in found], "{:.2g}") + " %" for k in (0, 1)),
            spread(falls) + " %",
            spread([100.0 * row["exact"]["falls"] for row in found]) + " %",
        ]  # fmt: skip
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    """Draws, prints."""
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "evidence.json"
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else DOCS / "evidence.png"
    rows = json.loads(source.read_text())
    figure, axes = plt.subplots(2, 2, figsize=(11, 7.5), layout="constrained")
    curves(axes[0, 0], rows)
    pairs(axes[0, 1], rows, "Success [%]", ("kinematic", "exact"), success)
    pairs(axes[1, 0], rows, "Over a limit, measured [mrad]", ("training", "exact"), excess)
    pairs(axes[1, 1], rows, "Steps with self-contact [%]", ("training", "exact"), contact)
    axes[1, 0].set_yscale("symlog", linthresh=1.0)
    axes[1, 0].set_ylim(0.0, 1000.0)
    for one in axes.flat:
        one.grid(alpha=0.2)
        one.set_axisbelow(True)
    figure.savefig(target, dpi=90)
    for algorithm in ("ppo", "her"):
        if any(row["algorithm"] == algorithm for row in rows):
            print(f"{algorithm}\n\n{table(rows, algorithm)}\n")


if __name__ == "__main__":
    main()
