"""The picture of runs that differ in their seed: success, and each figure beside its bounds."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from textwrap import fill
from typing import Any

from matplotlib.axes import Axes
from matplotlib.ticker import MaxNLocator

from hurcules.figures import describe, readable
from hurcules.report.style import ACCENT, GREY, LINES, applied, grid

__all__ = ["write"]

COLUMNS = 3
STYLES = {True: (LINES[1], "o"), False: (ACCENT, "X"), None: (GREY, "o")}  # by success
WORDS = {True: "succeeded", False: "failed", None: "stopped, as asked"}


def write(path: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Writes it as PNG; figures that are the same in all runs and have no bounds are left out.

    Args:
        path: of the file.
        rows: of `runs.jsonl`, one or more.
    """
    wanted = {name: limits for row in rows for name, limits in row["wanted"].items()}
    values: dict[str, set[float]] = {}
    for row in rows:
        for name, value in row["figures"].items():
            if value is not None:
                values.setdefault(name, set()).add(value)
    telling = [name for name, some in values.items() if name in wanted or len(some) > 1]
    first = sorted(telling, key=lambda name: name not in wanted)  # those that decide
    with applied():
        figure, plots = grid(math.ceil((1 + len(first)) / COLUMNS), COLUMNS, 1.9)
        _success(plots[0], rows)
        for plot, name in zip(plots[1:], first, strict=False):
            _figure(plot, name, rows, wanted.get(name, {}))
        for plot in plots[1 + len(first) :]:
            plot.set_axis_off()
        for plot in plots[max(0, len(first) + 1 - COLUMNS) : len(first) + 1]:
            plot.set_xlabel("seed")
            plot.tick_params(labelbottom=True)
        figure.savefig(path, format="png", dpi=130)


def _success(plot: Axes, rows: Sequence[dict[str, Any]]) -> None:
    levels = [one for one in WORDS if any(row["success"] is one for row in rows)]
    _dots(plot, rows, [levels.index(row["success"]) for row in rows])
    plot.set_yticks(range(len(levels)), [WORDS[one] for one in levels])
    plot.set_ylim(len(levels) - 0.5, -0.5)
    plot.xaxis.set_major_locator(MaxNLocator(integer=True))
    good, ended = (sum(row["success"] in some for row in rows) for some in ([True], [True, False]))
    plot.set_title(f"{good} of {ended} succeeded")


def _figure(
    plot: Axes, name: str, rows: Sequence[dict[str, Any]], limits: dict[str, float | None]
) -> None:
    given = [row for row in rows if row["figures"].get(name) is not None]
    _dots(plot, given, [row["figures"][name] for row in given])
    for limit in limits.values():
        if limit is not None:
            plot.axhline(limit, color=ACCENT, linewidth=1.0, linestyle=(0, (5, 2)))
    plot.yaxis.set_major_locator(MaxNLocator(4))
    plot.yaxis.set_major_formatter(lambda value, _: readable(name, value))
    plot.set_title(fill(describe(name).label, 28))


def _dots(plot: Axes, rows: Sequence[dict[str, Any]], values: Sequence[float]) -> None:
    for row, value in zip(rows, values, strict=True):
        colour, marker = STYLES[row["success"]]
        plot.plot(row["seed"], value, marker, color=colour, markersize=4.5)
