"""What an operator does whose robot gets stuck at an edge: lifts its leading legs onto it."""

from __future__ import annotations

import math
from dataclasses import replace

from hurcules.trials.climbing import STEADY, UPPER
from hurcules.trials.postures import Posture

__all__ = ["Lift"]

PROGRESS = 0.02  # [m] that count as one
STALLED = 1.0  # [s] without any: the robot is stuck
STEP, MOST = 0.2, 0.5  # [rad] by which the legs are lifted higher; not from here on


class Lift:
    """Lifts the upper legs, which lead, where the robot gets stuck; lays them down behind the edge.

    The trunk leans over the lower legs, so that it is these which stay on the ground.
    """

    def __init__(self) -> None:
        self._rise = 0.0
        self._furthest = self._edge = -1e9  # [m]
        self._since = 0.0  # [s]

    def __call__(self, posture: Posture, onward: float, time: float, ready: bool) -> Posture:
        """One period.

        Args:
            posture: that the plan wants.
            onward: how far the robot came [m], growing on its way.
            time: [s].
            ready: the robot has reached the posture that was wanted last.
        """
        if onward > self._furthest + PROGRESS or not ready:
            self._furthest = max(onward, self._furthest)
            self._since = time
        elif time - self._since > STALLED:
            # what did not help at any height may lie under the battery: laid down, then once more
            self._rise = self._rise + STEP if self._rise < MOST else 0.0
            self._edge, self._since = onward, time
        if onward > self._edge + UPPER:
            self._rise = 0.0
        if self._rise == 0.0:
            return posture
        return replace(posture, knee=math.pi - self._rise, hip=STEADY - self._rise)
