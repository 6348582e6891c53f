"""claims.md of `hurcules reproduce`: id, source, verdict and measured numbers, a row a claim."""

from __future__ import annotations

import datetime
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

from hurcules._version import __version__
from hurcules.summary import processor
from hurcules_studies.thesis.claim import Claim, Verdict
from hurcules_studies.thesis.claims import CLAIMS, LETTERS
from hurcules_studies.thesis.judge import interval, shown
from hurcules_studies.thesis.result import Result

__all__ = ["write"]

HEAD = """# The claims of the thesis, measured

Written by `hurcules reproduce` on {date} (hurcules {version}, {processor}).
What each claim says, its plots and the rest of its numbers: `report.html` and `claims.json` of the
same command.

{counts}.
"""
COLUMNS = "| claim | source | verdict | measured (wanted) |\n|---|---|---|---|\n"


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
    )
    for letter in dict.fromkeys(name[0] for name in results):
        mine = [name for name in results if name[0] == letter]
        text += f"\n## {LETTERS[letter]}\n\n{COLUMNS}"
        text += "".join(f"| {_row(CLAIMS[name], results[name])} |\n" for name in mine)
    path.write_text(text, encoding="utf-8")


def _row(claim: Claim, result: Result) -> str:
    numbers = "; ".join(
        f"{one.what} {shown(result.finding.values[name], one.unit)} ({interval(one)})"
        for name, one in claim.expected.items()
        if name in result.finding.values
    )
    told = numbers if result.verdict == Verdict.HOLDS else result.reason
    cells = (claim.id, claim.source, str(result.verdict), told)
    return " | ".join(cell.replace("|", "\\|") for cell in cells)
