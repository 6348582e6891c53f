"""report.html of `hurcules reproduce`: each claim with its numbers, plots and verdict; one file."""

from __future__ import annotations

import datetime
import platform
from collections import Counter
from collections.abc import Mapping
from importlib.resources import files
from pathlib import Path
from typing import Any

import jinja2

from hurcules import _core
from hurcules._version import __version__
from hurcules.report.style import applied
from hurcules.summary import processor
from hurcules_studies.thesis.claim import Claim, Verdict
from hurcules_studies.thesis.claims import CLAIMS, LETTERS
from hurcules_studies.thesis.judge import interval, shown
from hurcules_studies.thesis.page.drawing import draw
from hurcules_studies.thesis.result import Result

__all__ = ["write"]

MARKS = {  # class of a verdict in the page
    Verdict.HOLDS: "yes",
    Verdict.IN_PART: "other",
    Verdict.ANOTHER_NUMBER: "other",
    Verdict.NOT: "no",
    Verdict.PENDING: "open",
    Verdict.ERROR: "error",
}


def write(path: Path, results: Mapping[str, Result]) -> None:
    """Writes the page.

    Args:
        path: the file.
        results: by id, in the order of the page.

    Raises:
        OSError: the file cannot be written.
    """
    source = files(__package__).joinpath("template.html").read_text("utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    counts = Counter(result.verdict for result in results.values())
    with applied():
        claims = [_claim(CLAIMS[name], result) for name, result in results.items()]
    letters = dict.fromkeys(name[0] for name in results)
    page = environment.from_string(source).render(
        version=__version__,
        mujoco=_core.build["mujoco"],
        processor=processor(),
        system=platform.platform(terse=True),
        date=datetime.date.today().isoformat(),
        counts=[(counts[verdict], str(verdict), MARKS[verdict]) for verdict in Verdict],
        chapters=[
            (letter, LETTERS[letter], [one for one in claims if one["id"][0] == letter])
            for letter in letters
        ],
    )
    path.write_text(page, encoding="utf-8")


def _claim(claim: Claim, result: Result) -> dict[str, Any]:
    finding = result.finding
    rows = [
        {
            "what": one.what,
            "measured": shown(finding.values[name], one.unit),
            "thesis": one.thesis,
            "wanted": interval(one),
            "fitted": one.fitted,
            "missed": not one.met(finding.values[name]),
        }
        for name, one in claim.expected.items()
        if name in finding.values
    ]
    return {
        "id": claim.id,
        "source": claim.source,
        "statement": claim.statement,
        "solvers": ", ".join(claim.solvers),
        "caveat": claim.caveat,
        "verdict": str(result.verdict),
        "mark": MARKS[result.verdict],
        "explained": result.explained,
        "reason": result.reason,
        "remark": finding.remark,
        "rows": rows,
        "notes": [(note.what, shown(note.value, note.unit)) for note in finding.notes],
        "seconds": f"{result.seconds:.1f}",
        "svg": draw(finding.plots) if finding.plots else "",
    }
