"""From numbers to a verdict: the claim says where they must lie, and nothing else decides."""

from __future__ import annotations

import math

from hurcules._core import Error
from hurcules.figures import readable
from hurcules_studies.thesis.claim import Claim, Expected, Finding, Verdict

__all__ = ["interval", "judge", "shown"]


def judge(claim: Claim, finding: Finding) -> tuple[Verdict, str, bool]:
    """Compares what was measured with what the claim wants.

    Args:
        claim: with the numbers that it is judged by.
        finding: with a value for each of them.

    Returns:
        The verdict, the reason ("" where the claim holds), and whether that reason was known and
        fits the number; what is neither met nor explained needs somebody to look.

    Raises:
        Error: the names of the values are not those that the claim expects.
    """
    if set(finding.values) != set(claim.expected):
        wanted, came = sorted(claim.expected), sorted(finding.values)
        raise Error(f"claim {claim.id}: wanted values for {wanted}, got {came}")
    missed = [
        (expected, finding.values[name])
        for name, expected in claim.expected.items()
        if not expected.met(finding.values[name])
    ]
    reasons = [_reason(expected, value) for expected, value in missed]
    if claim.missing:
        reasons.append(f"not shown: {claim.missing}")
    if not missed:
        verdict = Verdict.IN_PART if claim.missing else Verdict.HOLDS
    else:
        verdict = Verdict.ANOTHER_NUMBER if all(e.figure for e, _ in missed) else Verdict.NOT
    explained = all(e.explained(value) for e, value in missed)
    return verdict, "; ".join(reasons), explained


def _reason(expected: Expected, value: float) -> str:
    said = f"{expected.what}: {shown(value, expected.unit)} instead of {interval(expected)}"
    if expected.explained(value):
        return f"{said} ({expected.why})"
    if expected.ours is None:
        return f"{said} (nobody has explained this)"
    low, high = (shown(side, expected.unit) for side in expected.ours)
    return f"{said} (explained only from {low} to {high}: {expected.why})"


def interval(expected: Expected) -> str:
    """Where a number must lie, in words."""
    low, high = shown(expected.low, expected.unit), shown(expected.high, expected.unit)
    if expected.low == expected.high:
        return low
    if math.isinf(expected.low):
        return f"at most {high}"
    return f"at least {low}" if math.isinf(expected.high) else f"{low} to {high}"


def shown(value: float, unit: str = "") -> str:
    """A number as a person reads it; whole numbers whole."""
    if not math.isfinite(value):
        return "none" if math.isnan(value) else str(value)
    if unit in ("s", "m", "rad", "N"):
        return readable(f"_{unit}", value)
    text = f"{value:.0f}" if value == round(value) and abs(value) < 1e6 else f"{value:.3g}"
    return f"{text} {unit}".rstrip()
