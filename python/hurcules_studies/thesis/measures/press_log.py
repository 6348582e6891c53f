"""What a robot that presses its hands on the ground did, tick by tick."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "Log", "empty_log"]

DT = 1e-3  # [s]


@dataclass
class Log:
    """Every tick; (ticks, ...).

    Attributes:
        time: [s].
        names: of the coordinates.
        q: [rad], qd: [rad/s], qdd: [rad/s^2]: the commanded motion; qdd by differences of qd.
        force: (ticks, 2) [N] as read, left and right; negative presses down.
        contact: (ticks, 2, 3) [N] of the arms on what they touch, as the physics has it.
        hand: (ticks, 3) [m] left tip as it is; planned: as commanded.
        state: (ticks, 2) 0 free, 1 contact, 2 stopped, 3 sensor lost.
        active: (ticks, n) -1, 0, 1.
        changes: (ticks,) of the working set.
        errors: (ticks, 4) norms: hpos, hpitch, pel, gaze.
        servo: (ticks,) [rad] largest error of a coordinate's joint.
        base: (ticks, 3) [m] of the knee frame.
    """

    names: list[str]
    time: Array
    q: Array
    qd: Array
    force: Array
    contact: Array
    hand: Array
    planned: Array
    state: Array
    active: Array
    changes: Array
    errors: Array
    servo: Array
    base: Array

    @property
    def qdd(self) -> Array:
        """By differences."""
        return np.asarray(np.diff(self.qd, axis=0, prepend=self.qd[:1]) / DT)

    def of(self, name: str) -> int:
        """Column of a coordinate."""
        return self.names.index(name)

    def when(self, name: str, side: int) -> tuple[float, float]:
        """When a limit is first taken and first left after that [s]; NaN for never."""
        held = self.active[:, self.of(name)] == side
        if not held.any():
            return float("nan"), float("nan")
        on = int(held.argmax())
        off = held[on:].argmin()
        return float(self.time[on]), float(self.time[on + off]) if off else float("nan")

    def part(self, start: float, end: float = np.inf) -> NDArray[np.bool_]:
        """The ticks between two times."""
        return (self.time >= start) & (self.time < end)

    def touched(self, side: int = 0) -> float:
        """When the force of a hand is first regulated [s]; NaN for never."""
        on = self.state[:, side] == 1
        return float(self.time[on.argmax()]) if on.any() else float("nan")


def empty_log(names: list[str], ticks: int) -> Log:
    """Room for this many ticks."""
    n = len(names)
    sizes = {"time": (), "q": (n,), "qd": (n,), "force": (2,), "contact": (2, 3), "hand": (3,)}
    sizes |= {"planned": (3,), "state": (2,), "active": (n,), "changes": (), "errors": (4,)}
    sizes |= {"servo": (), "base": (3,)}
    return Log(names, **{name: np.zeros((ticks, *size)) for name, size in sizes.items()})
