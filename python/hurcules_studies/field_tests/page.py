"""report.html of a test method: its scene, its settings with what they are worth, its faults."""

from __future__ import annotations

from importlib.resources import files
from pathlib import Path
from typing import Any

import jinja2
import numpy as np
from numpy.typing import NDArray

from hurcules.report.style import data_address, jpeg

__all__ = ["HEADINGS", "faults", "rows", "write"]

HEADINGS = ("setting", "n", "failed", "C(0.8)", "C(0.9)", "R at 95 %", "m/min", "J/m", "faults")
PICTURE_WIDTH = 1040  # [pixels]


def rows(summary: dict[str, Any]) -> list[list[str]]:
    """A row for each setting, as in HEADINGS.

    C(R): confidence that the reliability is at least R; R at 95 %: the reliability that is reached
    or passed with this confidence (Clopper-Pearson).
    """
    return [
        [
            one["shown"],
            str(one["repetitions"]),
            str(one["failures"]),
            f"{100 * one['confidence_80']:.0f} %",
            f"{100 * one['confidence_90']:.0f} %",
            f"{100 * one['lower_bound_95']:.0f} %",
            f"{one['metres_per_minute']:.1f}" if one["metres_per_minute"] else "-",
            f"{one['drive_energy_per_metre']:.0f}",
            faults(one),
        ]
        for one in summary["settings"]
    ]


def faults(setting: dict[str, Any]) -> str:
    """The faults of a setting by kind: "2 stuck, 1 tip-over"."""
    kinds = [fault["fault"] for fault in setting["faults"]]
    return ", ".join(f"{kinds.count(kind)} {kind}" for kind in dict.fromkeys(kinds)) or "-"


def write(
    path: Path,
    summary: dict[str, Any],
    picture: NDArray[np.uint8] | None,
    video: Path | str,
) -> None:
    """Writes the page.

    Args:
        path: the file.
        summary: as `hurcules_studies.field_tests.command.summarize` returns it.
        picture: of the scene (height, width, 3), None where there is no renderer.
        video: the film, or why there is none.

    Raises:
        OSError: the file cannot be written.
    """
    source = files(__package__).joinpath("page.html").read_text("utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    page = environment.from_string(source).render(
        summary=summary,
        headings=HEADINGS,
        rows=rows(summary),
        picture="" if picture is None else jpeg(picture, PICTURE_WIDTH),
        video=data_address(video.read_bytes(), "video/mp4") if isinstance(video, Path) else "",
        without_video=video,
    )
    path.write_text(page, encoding="utf-8")
