"""What an operator does whose robot hangs on something: backs off and passes beside it."""

from __future__ import annotations

__all__ = ["Retreat"]

BACK = 0.5  # [m] to back off, until nothing under the battery (0.42 m long) holds it any more
PATIENCE = 4.0  # [s] at most for it, twice what it takes
# [m] beside the line: half the battery (0.105 m), which has a post of up to 0.1 m under its middle,
# and half that post
ASIDE = 0.16
SIDES = 1, -1, 0  # left of the line, right of it, on it once more
GAIN, SLANT = 3.0, 0.45  # [rad/m], [rad] at most: how the robot looks aside to come there


class Retreat:
    """Leads the robot back from where it is held, and on again farther left or right.

    Attributes:
        backs_off: the robot is to go the other way.
        slant: [rad] by which it is to look left of its way.
    """

    def __init__(self) -> None:
        self.backs_off = False
        self.slant = 0.0
        self._done = 0
        self._edge = self._since = 0.0  # [m], [s] where and when it began

    def begin(self, onward: float, time: float) -> None:
        """Backs off, unless all has been tried."""
        if self._done < len(SIDES):
            self._done += 1
            self.backs_off = True
            self._edge, self._since = onward, time

    def go_on(self, onward: float, left: float, time: float) -> None:
        """One period.

        Args:
            onward: how far the robot came [m], growing on its way.
            left: [m] of the line to keep to.
            time: [s].
        """
        if self.backs_off and (onward < self._edge - BACK or time > self._since + PATIENCE):
            self.backs_off = False
        self.slant = 0.0
        if self._done and not self.backs_off:
            error = ASIDE * SIDES[self._done - 1] - left
            self.slant = min(max(GAIN * error, -SLANT), SLANT)

    def forget(self) -> None:
        """The place is behind the robot."""
        self._done = 0
