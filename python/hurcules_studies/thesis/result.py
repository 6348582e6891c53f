"""A claim that was dealt with, as it is kept in OUT/claims/ID.json, and what it was made from."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict, dataclass
from functools import cache
from pathlib import Path
from typing import Any

import hurcules
import hurcules_studies
from hurcules import _core, models
from hurcules_studies.thesis.claim import Claim, Expected, Finding, Line, Note, Plot, Verdict
from hurcules_studies.thesis.judge import judge

__all__ = ["Result", "dump", "fingerprint", "from_finding", "load", "row", "without_finding"]

# parts of the packages that show results and make none
SHOWS = (
    "hurcules/cli.py",
    "hurcules/doctor.py",
    "hurcules/plugins.py",
    "hurcules/run.py",
    "hurcules/video.py",
    "hurcules/report/",
    "hurcules_studies/field_tests/command",
    "hurcules_studies/field_tests/page",
    "hurcules_studies/thesis/command",
    "hurcules_studies/thesis/page",
    "hurcules_studies/thesis/run",
    "hurcules_studies/thesis/table",
)


@dataclass(frozen=True)
class Result:
    """What became of a claim.

    Attributes:
        reason: why it does not simply hold, or could not be measured; "" where it holds.
        explained: whether the reason is known and fits the numbers.
        seconds: [s] that measuring it took; a run shared by several claims counts for the first.
    """

    id: str
    verdict: Verdict
    reason: str
    explained: bool
    finding: Finding
    seconds: float

    @property
    def done(self) -> bool:
        """Whether nobody has to look at it: measured, and it holds or is explained."""
        return self.verdict not in (Verdict.PENDING, Verdict.ERROR) and self.explained


def from_finding(claim: Claim, finding: Finding, seconds: float) -> Result:
    """The result of a claim that was measured."""
    finding.values = {name: float(value) for name, value in finding.values.items()}
    finding.notes = [Note(note.what, float(note.value), note.unit) for note in finding.notes]
    verdict, reason, explained = judge(claim, finding)
    return Result(claim.id, verdict, reason, explained, finding, seconds)


def without_finding(name: str, verdict: Verdict, reason: str) -> Result:
    """The result of a claim that was not measured."""
    return Result(name, verdict, reason, False, Finding({}), 0.0)


def row(claim: Claim, result: Result) -> dict[str, Any]:
    """The row of claims.json: plain data, None for what is not finite."""
    values = result.finding.values
    return {
        "id": claim.id,
        "source": claim.source,
        "statement": claim.statement,
        "solvers": list(claim.solvers),
        "missing": claim.missing,
        "caveat": claim.caveat,
        "expected": {name: _expected(one) for name, one in claim.expected.items()},
        "measured": {name: _finite(value) for name, value in values.items()},
        "notes": [
            {"what": note.what, "value": _finite(note.value), "unit": note.unit}
            for note in result.finding.notes
        ],
        "verdict": str(result.verdict),
        "reason": result.reason,
        "explained": result.explained,
        "remark": result.finding.remark,
        "seconds": round(result.seconds, 3),
    }


def _expected(one: Expected) -> dict[str, Any]:
    return {
        "what": one.what,
        "unit": one.unit,
        "low": _finite(one.low),
        "high": _finite(one.high),
        "thesis": one.thesis,
        "fitted": one.fitted,
    }


def _finite(value: float) -> float | None:
    return value if abs(value) < float("inf") else None  # NaN compares false


def dump(result: Result) -> str:
    """The text that is kept; JSON with NaN and Infinity, for `load` alone."""
    return json.dumps({"fingerprint": fingerprint(), **asdict(result)}) + "\n"


def load(path: Path) -> Result | None:
    """The kept result; None where there is none of this version and code."""
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        if kept.pop("fingerprint") != fingerprint():
            return None
        found = kept.pop("finding")
        finding = Finding(
            found["values"],
            [Note(**note) for note in found["notes"]],
            [_plot(plot) for plot in found["plots"]],
            found["remark"],
        )
        return Result(**{**kept, "verdict": Verdict(kept["verdict"])}, finding=finding)
    except (OSError, ValueError, KeyError, TypeError, AttributeError):
        return None  # nothing was kept, or half of it, or something else: measure again


def _plot(plot: dict[str, Any]) -> Plot:
    lines = [Line(**line) for line in plot.pop("lines")]
    sides: dict[str, Any] = {
        name: tuple(plot.pop(name)) for name in ("marks", "thesis_marks", "levels")
    }
    return Plot(lines=lines, **sides, **plot)


@cache
def fingerprint() -> str:
    """What all results depend on: version, compiled module, Python that measures, models."""
    digest = hashlib.sha256(hurcules.__version__.encode())
    sources = [
        path
        for package in (hurcules, hurcules_studies)
        for path in Path(str(package.__file__)).parent.rglob("*.py")
        if not _shows(path.relative_to(Path(str(package.__file__)).parents[1]))
    ]
    for path in (Path(_core.__file__), *sorted(sources), *sorted(models.folder().rglob("*.xml"))):
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def _shows(path: Path) -> bool:
    return path.as_posix().startswith(SHOWS)
