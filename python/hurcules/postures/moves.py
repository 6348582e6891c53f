"""A move: joint angles to reach in a time, by way of others; nothing here knows the physics."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules._core import Error

__all__ = ["Move", "bend", "move", "standing"]

# coordinates that exist once; all others are an L and an R joint
_SINGLE = ("HIP", "WST", "NKY", "NKP")


@dataclass(frozen=True)
class Move:
    """Joint angles over time.

    A joint goes from where it is through its angles in `keys`, without a corner and without
    overshoot: a cubic between two keys, its slope at a key the harmonic mean of those of the
    straight lines on both sides, 0 at a turning point. A joint that no key names stays. The way
    along the keys follows u - sin(2 pi u) / (2 pi): it starts and ends at rest.

    Args:
        name: what happens.
        seconds: of the motion [s].
        keys: share of the way (0 to 1, rising, the last is 1), and angles there [rad] by joint.
        hold: rest at the end [s].
    """

    name: str
    seconds: float
    keys: tuple[tuple[float, Mapping[str, float]], ...] = field(default=())
    hold: float = 0.5

    def __post_init__(self) -> None:
        shares = [share for share, _ in self.keys]
        rising = all(a < b for a, b in zip([0.0, *shares], shares, strict=False))
        if not (self.seconds > 0 and self.hold >= 0):
            raise Error(f"move '{self.name}': seconds > 0 and hold >= 0 are wanted")
        if shares and not (rising and shares[-1] == 1.0):
            raise Error(f"move '{self.name}': shares want to rise from above 0 to 1, {shares} came")

    def joints(self) -> list[str]:
        """The joints that move, by name."""
        return sorted({joint for _, angles in self.keys for joint in angles})

    def target(self, joint: str, start: float, time: float) -> tuple[float, float]:
        """Where a joint shall be.

        Args:
            joint: its name.
            start: its angle before the move [rad].
            time: since the start of the move [s].

        Returns:
            Angle [rad] and speed [rad/s].
        """
        place, speed = self.targets(joint, start, [time])
        return float(place[0]), float(speed[0])

    def targets(
        self, joint: str, start: float, times: ArrayLike
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The same at many times at once.

        Args:
            joint: its name.
            start: its angle before the move [rad].
            times: (n,) since the start of the move [s].

        Returns:
            (n,) angles [rad] and (n,) speeds [rad/s].
        """
        u = np.clip(np.asarray(times, np.float64) / self.seconds, 0.0, 1.0)
        way = u - np.sin(2 * np.pi * u) / (2 * np.pi)
        rate = (1 - np.cos(2 * np.pi * u)) / self.seconds
        keys = [(share, angles[joint]) for share, angles in self.keys if joint in angles]
        if not keys:
            return np.full(u.shape, start), np.zeros(u.shape)
        at, angle = np.array([(0.0, start), *keys]).T
        lines = np.diff(angle) / np.diff(at)
        slopes = np.array([_slope(lines.tolist(), key) for key in range(len(at))])
        i = np.minimum(np.searchsorted(at[1:], way), len(lines) - 1)
        line, span = lines[i], np.diff(at)[i]
        x = (way - at[i]) / span
        # cubic of Hermite in x, and its derivative by the way
        bend0, bend1 = slopes[i] - line, line - slopes[i + 1]
        place = angle[i] + span * x * (line + (1 - x) * ((1 - x) * bend0 + x * bend1))
        slope = line + (1 - x) * (1 - 3 * x) * bend0 + x * (2 - 3 * x) * bend1
        return place, slope * rate


def _slope(lines: list[float], key: int) -> float:
    """Slope at a key between straight lines; at the ends that of the only one."""
    before, after = lines[max(key - 1, 0)], lines[min(key, len(lines) - 1)]
    return 2 * before * after / (before + after) if before * after > 0 else 0.0


def bend(angles: Mapping[str, float]) -> dict[str, float]:
    """Joint angles from those of coordinates: KN, SP, ... stand for both sides, LKN for one."""
    joints = {}
    for name, angle in angles.items():
        both = name not in _SINGLE and name[0] not in "LR"
        joints.update(dict.fromkeys(("L" + name, "R" + name) if both else (name,), angle))
    return joints


def move(name: str, seconds: float, hold: float = 0.5, **angles: float) -> Move:
    """A move straight to joint angles [rad], by coordinate (both sides) or joint."""
    return Move(name, seconds, ((1.0, bend(angles)),), hold)


def standing(
    name: str, seconds: float, *keys: tuple[float, float, float, float, float], hold: float = 0.5
) -> Move:
    """A move on the flat lower legs, by absolute angles.

    Args:
        name: what happens.
        seconds: of the motion [s].
        keys: share of the way, theta (elevation of the upper legs), lean (of the trunk from
            upright), a and b (upper and lower arm from straight down, forward) [rad].
        hold: rest at the end [s].
    """
    way = []
    for share, theta, lean, a, b in keys:
        angles = {"KN": math.pi - theta, "HIP": lean - theta, "SP": a + lean, "EB": b - a}
        way.append((share, bend(angles)))
    return Move(name, seconds, tuple(way), hold)
