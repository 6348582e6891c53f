"""What some repetitions tell about reliability: exact binomial statistics.

With f failures in n repetitions the confidence that the reliability is at least R is

    C = 1 - sum over i = 0..f of (n over i) (1 - R)^i R^(n - i).
"""

from __future__ import annotations

import math

from hurcules._core import Error

__all__ = ["confidence", "lower_bound", "repetitions_needed"]


def confidence(repetitions: int, failures: int, reliability: float) -> float:
    """Returns how sure one may be that the reliability is at least this.

    Args:
        repetitions: > 0.
        failures: from 0 to `repetitions`.
        reliability: probability of success, from 0 to 1.

    Raises:
        Error: a number out of its range.
    """
    _require_counts(repetitions, failures)
    _require_share("reliability", reliability)
    miss = 1.0 - reliability
    tail = sum(
        math.comb(repetitions, i) * miss**i * reliability ** (repetitions - i)
        for i in range(failures + 1)
    )
    return max(0.0, 1.0 - tail)


def repetitions_needed(reliability: float, wanted: float, failures: int = 0) -> int:
    """Returns the least number of repetitions that shows a reliability.

    Args:
        reliability: > 0 and < 1.
        wanted: confidence, > 0 and < 1.
        failures: that are allowed.

    Raises:
        Error: a number out of its range.
    """
    for name, value in (("reliability", reliability), ("wanted", wanted)):
        if not 0.0 < value < 1.0:
            raise Error(f"{name}: wanted a number between 0 and 1, got {value!r}")
    n = failures + 1
    while confidence(n, failures, reliability) < wanted:
        n += 1
    return n


def lower_bound(repetitions: int, failures: int, wanted: float = 0.95) -> float:
    """Returns the reliability that is reached or passed with this confidence (Clopper-Pearson).

    Args:
        repetitions: > 0.
        failures: from 0 to `repetitions`.
        wanted: confidence, from 0 to 1.

    Raises:
        Error: a number out of its range.
    """
    _require_counts(repetitions, failures)
    _require_share("wanted", wanted)
    if failures == repetitions:
        return 0.0
    low, high = 0.0, 1.0
    for _ in range(60):  # halves down to the last bit
        middle = (low + high) / 2
        if confidence(repetitions, failures, middle) >= wanted:
            low = middle
        else:
            high = middle
    return low


def _require_counts(repetitions: int, failures: int) -> None:
    if repetitions < 1 or not 0 <= failures <= repetitions:
        raise Error(f"wanted 0 <= failures <= repetitions > 0, got {failures} of {repetitions}")


def _require_share(name: str, value: float) -> None:
    if not 0.0 <= value <= 1.0:
        raise Error(f"{name}: wanted a number from 0 to 1, got {value!r}")
