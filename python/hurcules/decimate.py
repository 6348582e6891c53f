"""Long series with fewer points, for pictures."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

__all__ = ["decimate"]

Array = NDArray[np.float64]


def decimate(time: Array, values: Array, buckets: int = 500) -> tuple[Array, Array]:
    """Fewer points with the same picture: the least and the greatest of each stretch of time.

    Args:
        time: (ticks,) [s].
        values: (ticks,).
        buckets: stretches, each of which leaves two points.
    """
    if len(time) <= 2 * buckets:
        return time, values
    kept = []
    for part in np.array_split(np.arange(len(time)), buckets):
        kept += sorted({part[np.argmin(values[part])], part[np.argmax(values[part])]})
    index = np.array([0, *kept, len(time) - 1])
    return time[index], values[index]
