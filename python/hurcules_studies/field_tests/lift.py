"""What an operator does whose robot gets stuck at an edge: lifts its leading legs onto it."""

from __future__ import annotations

import math
from dataclasses import replace

from hurcules_studies.field_tests.climbing import STEADY, UPPER
from hurcules_studies.field_tests.postures import Posture
from hurcules_studies.field_tests.retreat import Retreat

__all__ = ["Lift"]

PROGRESS = 0.02  # [m] that count as one
STALLED = 1.0  # [s] without any: the robot is stuck
# [rad] by which the legs are lifted: not, higher and higher, and laid down
LIFTS = 0.0, 0.2, 0.4, 0.6, 0.0


class Lift:
    """Lifts the upper legs, which lead, where the robot gets stuck; lays them down behind the edge.

    The trunk leans over the lower legs, so that it is these which stay on the ground. What does not
    help at any height may lie under the battery: the robot backs off, and comes again beside it.

    Attributes:
        retreat: where the robot is to go.
    """

    def __init__(self) -> None:
        self.retreat = Retreat()
        self._tried = 0
        self._furthest = self._edge = -1e9  # [m]
        self._since = 0.0  # [s]

    def __call__(
        self, posture: Posture, onward: float, left: float, time: float, ready: bool
    ) -> Posture:
        """One period.

        Args:
            posture: that the plan wants.
            onward: how far the robot came [m], growing on its way.
            left: [m] of its line.
            time: [s].
            ready: the robot has reached the posture that was wanted last.
        """
        self.retreat.go_on(onward, left, time)
        if self.retreat.backs_off:
            self._furthest, self._since = onward, time
        elif onward > self._furthest + PROGRESS or not ready:
            self._furthest = max(onward, self._furthest)
            self._since = time
        elif time - self._since > STALLED:
            self._edge, self._since = onward, time
            self._try_next(time)
        if onward > self._edge + UPPER:
            self._tried = 0
            self.retreat.forget()
        rise = LIFTS[self._tried]
        if rise == 0.0:
            return posture
        return replace(posture, knee=math.pi - rise, hip=STEADY - rise)

    def _try_next(self, time: float) -> None:
        self._tried = (self._tried + 1) % len(LIFTS)
        if self._tried == 0:
            self.retreat.begin(self._edge, time)
