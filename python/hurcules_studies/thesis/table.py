"""claims.md of `hurcules reproduce`: id, source, verdict and measured numbers, a row a claim."""

from __future__ import annotations

import datetime
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

from hurcules._version import __version__
from hurcules.summary import processor
from hurcules_studies.thesis.claim import Claim, Expected, Verdict
from hurcules_studies.thesis.claims import CLAIMS, LETTERS
from hurcules_studies.thesis.judge import interval, shown
from hurcules_studies.thesis.result import Result

__all__ = ["wanted", "write"]

HEAD = """# The claims of the thesis, measured

Written by `hurcules reproduce` on {date} (hurcules {version}, {processor}).
Plots and the rest of the numbers: `report.html` and `claims.json` of the same command.

{counts}.

How to read it:

- **Solver**: the method that ran. `default` is the product's own; `Algorithm 1` is RHQP as the
  thesis prints it, with the one repair of R14; HQP and DLS-HQP are the thesis' comparisons.
- **Fitted**: the thesis prints neither start postures nor operator speeds. A number marked *fitted*
  comes from a posture, a range, a speed or an end of the motion that was chosen so that it comes
  near the thesis. It shows that it can be so, not that it must. Claims with such numbers: {fitted}.
- **Reference**: numbers that small programs of our own gave, apart from this software. They are no
  numbers of the thesis.
- **Caveat**: what the numbers cannot show.
"""
COLUMNS = (
    "| claim | what it says | source | solver | verdict | measured (wanted) |\n"
    + 6 * "|---"
    + "|\n"
)


def write(path: Path, results: Mapping[str, Result]) -> None:
    """Writes the table.

    Args:
        path: the file.
        results: by id, in the order of the table.

    Raises:
        OSError: the file cannot be written.
    """
    found = Counter(result.verdict for result in results.values())
    counts = ", ".join(f"{found[verdict]} {verdict}" for verdict in Verdict if found[verdict])
    text = HEAD.format(
        date=datetime.date.today().isoformat(),
        version=__version__,
        processor=processor(),
        counts=f"{len(results)} claims: {counts}",
        fitted=" ".join(name for name in results if CLAIMS[name].fitted) or "none",
    )
    for letter in dict.fromkeys(name[0] for name in results):
        mine = [name for name in results if name[0] == letter]
        text += f"\n## {LETTERS[letter]}\n\n{COLUMNS}"
        text += "".join(f"| {_row(CLAIMS[name], results[name])} |\n" for name in mine)
    path.write_text(text, encoding="utf-8")


def _row(claim: Claim, result: Result) -> str:
    numbers = "; ".join(
        f"{one.what} {shown(result.finding.values[name], one.unit)} ({wanted(one)})"
        for name, one in claim.expected.items()
        if name in result.finding.values
    )
    told = [numbers, f"**{result.reason}**" if result.reason else ""]
    told.append(f"*Caveat: {claim.caveat}.*" if claim.caveat else "")
    solver = ", ".join(claim.solvers) or "-"
    text = ". ".join(one for one in told if one)
    cells = (claim.id, claim.statement, claim.source, solver, str(result.verdict), text)
    return " | ".join(cell.replace("|", "\\|") for cell in cells)


def wanted(one: Expected) -> str:
    """Where a number must lie, and what was fitted to bring it there."""
    return interval(one) + (f", *fitted: {one.fitted}*" if one.fitted else "")
