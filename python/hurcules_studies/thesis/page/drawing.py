"""The plots of a claim, side by side, as SVG."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from hurcules.report.style import ACCENT, GREY, LINES, grid, mark, svg
from hurcules_studies.thesis.claim import Plot

__all__ = ["draw"]

_STYLES: dict[str, dict[str, Any]] = {
    "line": {},
    "dots": {"linestyle": "", "marker": "o", "markersize": 3.5},
    "dashed": {"linestyle": (0, (5, 2)), "linewidth": 1.1},
    "faint": {"linewidth": 0.8, "alpha": 0.55},
}


def draw(plots: Sequence[Plot]) -> str:
    """One picture of up to three plots.

    Upright lines: orange where it happened here, grey where the thesis says that it happened.
    """
    figure, places = grid(1, len(plots), 2.7 if len(plots) > 1 else 2.5, sharex=False)
    for place, plot in zip(places, plots, strict=True):
        _draw(place, plot)
    return svg(figure)


def _draw(place: Axes, plot: Plot) -> None:
    for one, colour in zip(plot.lines, _colours(len(plot.lines)), strict=True):
        y = np.array([np.nan if value is None else value for value in one.y])
        place.plot(one.x, y, color=colour, label=one.label, **_STYLES[one.style])
    for level in plot.levels:
        place.axhline(level, color=ACCENT, linewidth=1.0, linestyle=(0, (5, 2)))
    for time in plot.thesis_marks:
        place.axvline(time, color=GREY, linewidth=1.6, alpha=0.6, zorder=1)
    mark(place, plot.marks)
    if "x" in plot.log:
        place.set_xscale("log")
    if "y" in plot.log:
        place.set_yscale("log")
    place.set_title(plot.title)
    place.set_xlabel(plot.x_label)
    place.set_ylabel(plot.y_label)
    if any(one.label for one in plot.lines):
        place.legend(fontsize=7.5, loc="best", handlelength=1.4, labelspacing=0.25)


def _colours(count: int) -> list[str]:
    return [LINES[i % len(LINES)] for i in range(count)]
