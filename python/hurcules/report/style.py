"""The look of the plots, and how long series become small pictures."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterable
from contextlib import AbstractContextManager
from io import BytesIO, StringIO
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray
from PIL import Image

from hurcules.decimate import decimate

__all__ = [
    "ACCENT",
    "GREY",
    "INK",
    "LINES",
    "applied",
    "axes",
    "below",
    "cells",
    "data_address",
    "decimate",
    "grid",
    "jpeg",
    "mark",
    "side_by_side",
    "svg",
]

Array = NDArray[np.float64]

WIDTH = 8.0  # [inches] of a picture that fills the page
INK, GREY, FAINT, ACCENT = "#22272e", "#6b7480", "#e4e7eb", "#d9480f"
# quiet colours for lines that share axes; the accent is kept for limits and events
LINES = ("#22272e", "#2b6cb0", "#5a9bd4", "#2f855a", "#7fb685", "#805ad5", "#b794f4", "#8b949e")

_RC: Any = {
    "font.family": "sans-serif",
    "font.size": 9,
    "axes.edgecolor": GREY,
    "axes.labelcolor": INK,
    "axes.linewidth": 0.7,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.titlesize": 9.5,
    "axes.titlelocation": "left",
    "axes.axisbelow": True,
    "axes.grid": True,
    "grid.color": FAINT,
    "grid.linewidth": 0.6,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "lines.linewidth": 1.3,
    "legend.frameon": False,
    "svg.fonttype": "none",
    "svg.hashsalt": "hurcules",
}


def applied() -> AbstractContextManager[None]:
    """The look, for as long as the `with` block lasts: figures are made and written inside."""
    return matplotlib.rc_context(_RC)


def grid(rows: int, columns: int, height: float, sharex: bool = True) -> tuple[Figure, list[Axes]]:
    """A picture of rows x columns plots, `height` inches each row, over one time if `sharex`."""
    figure = Figure(figsize=(WIDTH, height * rows), layout="constrained")
    plots = figure.subplots(rows, columns, sharex=sharex, squeeze=False)
    return figure, list(plots.flat)


def axes(height: float) -> tuple[Figure, Axes]:
    """A picture of one plot, `height` inches high."""
    figure, plots = grid(1, 1, height)
    return figure, plots[0]


def cells(count: int, width: float = 3.3, height: float = 2.1) -> list[tuple[Figure, Axes]]:
    """Pictures of one plot each, `width` x `height` inches, for `side_by_side`."""
    figures = [Figure(figsize=(width, height), layout="constrained") for _ in range(count)]
    return [(figure, figure.subplots()) for figure in figures]


def below(plot: Axes) -> None:
    """The legend of a cell, below its axis: there the layout makes room for all of it."""
    plot.figure.legend(loc="outside lower center", ncols=2)


def side_by_side(drawn: Iterable[tuple[Figure, Axes]]) -> str:
    """The pictures of `cells` as HTML: as many in a row as fit."""
    return f'<div class="cells">{"".join(svg(figure) for figure, _ in drawn)}</div>'


def mark(plot: Axes, times: Iterable[float]) -> None:
    """Fine upright lines where something happened [s]."""
    for time in times:
        plot.axvline(time, color=ACCENT, linewidth=0.8, linestyle=(0, (4, 3)), alpha=0.7, zorder=1)


def svg(figure: Figure) -> str:
    """The picture as SVG to stand inside a page."""
    text = StringIO()
    figure.savefig(text, format="svg", transparent=True, metadata={"Date": None})
    source = text.getvalue()
    return source[source.index("<svg") :]


def jpeg(picture: NDArray[np.uint8], width: int) -> str:
    """A picture (height, width, 3) as a data address for a page, made `width` pixels wide."""
    image = Image.fromarray(picture)
    height = round(width * image.height / image.width)
    image = image.resize((width, height), Image.Resampling.LANCZOS)
    return data_address(_encoded(image), "image/jpeg")


def data_address(content: bytes, kind: str) -> str:
    """The content of a file as an address, so that a page needs no other file."""
    return f"data:{kind};base64,{b64encode(content).decode()}"


def _encoded(image: Any) -> bytes:
    buffer = BytesIO()
    image.save(buffer, format="JPEG", quality=86, optimize=True)
    return buffer.getvalue()
