"""Draws docs/evidence.png from docs/evidence.json, what benchmarks/evidence.py measured.

A row an environment. Success of the deterministic policy while it learns, median and range of the
seeds. Then, a dot a seed: success in the fidelity that it learns in and in `exact`; what was
measured in the physics, of the actions drawn in training and of the last policy: excess over
limits, and self-contact of Reach, the largest force of Press.

Run:  python benchmarks/figures/evidence.py [JSON] [FILE]
Prints the tables of docs/evidence.md too.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Callable
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
LEARNT_IN = {"Reach": "kinematic", "Press": "fast"}  # fidelity by environment
ENOUGH = 0.8  # share of successes that counts as learnt

Row = dict[str, Any]


def of(rows: list[Row], layer: str, environment: str) -> list[Row]:
    """The runs of a layer."""
    return [row for row in rows if (row["layer"], row["environment"]) == (layer, environment)]


def first(row: Row) -> float:
    """Steps to 80 % success, inf for never."""
    return next((n for n, share in row["curve"] if share >= ENOUGH), np.inf)


def training(row: Row, name: str) -> list[float]:
    """A figure of the actions drawn in training, at each look at them."""
    return [look[name] for look in row["training"]]


def curves(axes: Axes, rows: list[Row], environment: str) -> None:
    """Success while it learns."""
    for layer, colour in COLOURS.items():
        found = of(rows, layer, environment)
        if not found:
            continue
        steps = np.array(found[0]["curve"])[:, 0] / 1000.0
        shares = 100.0 * np.array([np.array(row["curve"])[:, 1] for row in found])
        axes.plot(steps, np.median(shares, axis=0), color=colour, label=layer)
        axes.fill_between(steps, shares.min(axis=0), shares.max(axis=0), color=colour, alpha=0.15)
    axes.set_title(f"{environment}: success while it learns, median and range", fontsize=10)
    axes.set(xlabel="steps [1000]", ylabel="success [%]")
    axes.legend(frameon=False, fontsize=8)


def pairs(
    axes: Axes, rows: list[Row], environment: str, title: str, names: tuple[str, str], value: Any
) -> None:
    """Two figures of each run, by layer: a dot a seed, a bar for the median."""
    for place, (layer, colour) in enumerate(COLOURS.items()):
        for k, mark in enumerate(("o", "s")):
            values = [value(row, k) for row in of(rows, layer, environment)]
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


def share(name: str) -> Callable[[Row, int], float]:
    """[%] of the episodes that ended so: in training, of the last policy."""
    return lambda row, k: 100.0 * (float(np.mean(training(row, name))), row["exact"][name])[k]


def force(row: Row, k: int) -> float:
    """[N] largest on the plate: in training, of the last policy."""
    return (max(training(row, "force")), row["exact"]["force"])[k]


def success(row: Row, k: int) -> float:
    """[%] in the fidelity that it learnt in, in `exact`."""
    return 100.0 * row[(LEARNT_IN[row["environment"]], "exact")[k]]["success"]


def spread(values: list[float], text: str = "{:.0f}") -> str:
    """Median and range in words."""

    def word(value: float) -> str:
        return text.format(value) if np.isfinite(value) else "never"

    low, high = word(min(values)), word(max(values))
    middle = word(float(np.median(values)))
    return middle if low == high else f"{middle} ({low} to {high})"


def table(rows: list[Row], environment: str) -> str:
    """What the page says, a line a layer."""
    pressed = environment == "Press"
    kinds = [
        ("over a limit [mrad]", excess, "{:.1f}", ""),
        ("self-contact", contact, "{:.2g}", " %"),
        ("falls", share("falls"), "{:.0f}", " %"),
    ]
    if pressed:
        kinds += [
            ("over 100 N", share("failures"), "{:.0f}", " %"),
            ("largest force [N]", force, "{:.0f}", ""),
        ]
    titles = ["layer", "seeds", *(["clone"] if pressed else []), "steps to 80 %"]
    titles += [f"`{LEARNT_IN[environment]}`", "`exact`"]
    titles += [] if pressed else ["other robot"]
    titles += [title for kind in kinds for title in (f"{kind[0]}, training", "`exact`")]
    lines = ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles)]
    for layer in COLOURS:
        found = of(rows, layer, environment)
        if not found:
            continue
        cells = [layer, str(len(found))]
        if pressed:
            cells += [spread([100.0 * row["curve"][0][1] for row in found]) + " %"]
        cells += [spread([round(first(row), -3) for row in found], "{:,.0f}")]
        cells += [spread([success(row, k) for row in found]) + " %" for k in (0, 1)]
        if not pressed:
            there = [row["manipulation"] for row in found if "manipulation" in row]
            other = [100.0 * one["success"] for one in there]
            cells += [spread(other) + " %" if other else ""]
        for _, value, text, unit in kinds:
            cells += [spread([value(row, k) for row in found], text) + unit for k in (0, 1)]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines)


def main() -> None:
    """Draws, prints."""
    source = Path(sys.argv[1]) if len(sys.argv) > 1 else DOCS / "evidence.json"
    target = Path(sys.argv[2]) if len(sys.argv) > 2 else DOCS / "evidence.png"
    rows = json.loads(source.read_text())
    both = ("training", "exact")
    shown = [name for name in LEARNT_IN if any(row["environment"] == name for row in rows)]
    figure, axes = plt.subplots(
        len(shown), 4, figsize=(20, 3.8 * len(shown)), layout="constrained", squeeze=False
    )
    for name, (left, middle, right, last) in zip(shown, axes, strict=True):
        curves(left, rows, name)
        pairs(middle, rows, name, "Success [%]", (LEARNT_IN[name], "exact"), success)
        pairs(right, rows, name, "Over a limit, measured [mrad]", both, excess)
        right.set_yscale("symlog", linthresh=1.0)
        right.set_ylim(0.0, 1000.0)
        if name == "Press":
            pairs(last, rows, name, "Largest force on the plate [N]", both, force)
        else:
            pairs(last, rows, name, "Steps with self-contact [%]", both, contact)
        print(f"{name}\n\n{table(rows, name)}\n")
    for one in axes.flat:
        one.grid(alpha=0.2)
        one.set_axisbelow(True)
    figure.savefig(target, dpi=90)


if __name__ == "__main__":
    main()
