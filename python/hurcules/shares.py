"""What a number of successes says of a share."""

from __future__ import annotations

import math

__all__ = ["wilson"]


def wilson(successes: int, n: int) -> tuple[float, float]:
    """The 95 % interval of a share, lower and upper end (Wilson 1927)."""
    z, p = 1.96, successes / n
    middle = (p + z * z / (2 * n)) / (1 + z * z / n)
    half = z / (1 + z * z / n) * math.sqrt(p * (1 - p) / n + z * z / (4 * n * n))
    return max(0.0, middle - half), min(1.0, middle + half)
