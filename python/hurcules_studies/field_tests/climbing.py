"""How a tracked robot with jointed legs climbs: which posture belongs to which place.

The lower legs are turned over to the front (knee angle pi) and the robot goes tail first: its upper
legs lead, the long lower legs trail. Two reasons, both of statics:

- Knees bend one way only, so the leading part can be raised from a straight track, never the
  middle. Standing on the lower legs, the upper ones can be raised onto an edge.
- Seen from an edge that bears it, a robot pitched by p balances where its centre of mass, h_c above
  the tracks, is h_c tan p behind. Tail first it has 0.85 m of track behind the knee and can shift
  its trunk towards the edge; knee first there are 0.55 m, and nothing higher than 0.19 m can be
  climbed without tipping over backwards.

Frame: x along the way, knees at x = k. Everything follows from the obstacle's own numbers.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

from hurcules.scenes.hurdle import Hurdle
from hurcules.scenes.ramps import Ramps
from hurcules.scenes.stairs import Stairs
from hurcules.scenes.step_field import StepField
from hurcules_studies.field_tests.postures import Posture

__all__ = ["ARMS", "STRETCHED", "OverField", "OverHurdle", "OverStairs"]

RADIUS = 0.14  # [m] of the tracks
UPPER, LOWER = 0.55, 0.85  # [m] between the axles of a leg
CLEARANCE = 0.05  # [m] of the raised tail over an edge
SLOW = 0.25  # [m/s] while the obstacle bears weight
STEADY = 1.0  # [rad] lean that keeps the weight on the lower legs while the tail is in the air
# [rad] lean on the obstacle: where the track tips over an edge, the tail reaches well ahead of the
# centre of mass and stops it
ACROSS = 0.8

APPROACH = 0.6  # [m] before the tail meets the edge it is raised
STRETCHED = Posture(math.pi, STEADY)  # one long track, the weight on the lower legs
# [rad] the knees a little past straight: more room under the battery, which else catches on posts
ARCHED = Posture(3.24, ACROSS)

# the toes in the air: on the upper legs alone it is easy to turn, and to come down from an edge
LIFTED = Posture(math.pi - 0.6, 0.0)

# centre of mass of both robots, within 2 cm along and 6 cm across the tracks: x, z [m] from the
# knees without the arm by which the trunk moves it, and that arm
CENTRE, ARM = (-0.157, 0.146), 0.27

# out of the way of the lower legs, and forward [rad]
ARMS = {"LSP": 1.9, "RSP": 1.9, "LEB": 0.6, "REB": 0.6}


def touch(edge: float, height: float, rise: float) -> float:
    """Where the knees are when the raised tail's track comes to lie on an edge [m].

    The knees stand on the ground; the track rises by `rise` from there and passes RADIUS below the
    line of its axles.

    Args:
        edge: x of the edge [m].
        height: of the edge [m].
        rise: of the upper legs [rad].
    """
    return edge - (RADIUS * (1 - math.cos(rise)) + height * math.cos(rise)) / math.sin(rise)


def highest(hip: float) -> float:
    """The highest edge [m] that the stretched robot is drawn over before it tips back.

    With the toes on the ground and the track pitched by p, the robot goes over an edge that bears
    it below its centre of mass, s before the toes' axle: s sin p + r (1 - cos p) high.

    Args:
        hip: lean of the trunk [rad].
    """
    ahead, above = CENTRE[0] + ARM * math.sin(hip), CENTRE[1] + ARM * math.cos(hip)
    heights = []
    for pitch in (0.01 * i for i in range(1, 120)):
        before = LOWER - ahead - (above + RADIUS) * math.tan(pitch)
        heights.append(before * math.sin(pitch) + RADIUS * (1 - math.cos(pitch)))
    return max(heights)


def lean_over(height: float) -> float:
    """The largest lean [rad], up to ACROSS, with which the stretched robot gets over an edge.

    The larger the lean, the farther the tail reaches ahead where the robot tips over the edge.
    """
    leans = (ACROSS - 0.05 * i for i in range(28))
    return next((hip for hip in leans if highest(hip) >= height), ACROSS)


def _between(x: float, begin: float, end: float) -> float:
    """Share of the way from begin to end, 0 before and 1 after."""
    return min(max((x - begin) / (end - begin), 0.0), 1.0)


@dataclass(frozen=True)
class OverStairs:
    """Up a flight tail first, down it knees first: the same posture at the same place."""

    stairs: Stairs

    def __call__(self, x: float) -> Posture:
        """The posture when the knees are at x [m]."""
        pitch = self.stairs.pitch
        start = touch(self.stairs.distance, self.stairs.riser, pitch)
        if x < start - APPROACH:
            return STRETCHED
        # the upper legs lie on the edges, the knees rise along them, the toes are on the ground yet
        climbed = max(0.0, x - start) * math.tan(pitch)
        rise = pitch - math.asin(min(climbed / LOWER, math.sin(pitch)))
        standing = STEADY - pitch
        share = _between(x, start, start + LOWER * math.cos(pitch))
        hip = standing + share * (ACROSS - standing)
        return Posture(math.pi - rise, hip, SLOW if x > start - 0.3 else math.inf)


@dataclass(frozen=True)
class OverHurdle:
    """Over a wall: the tail is put on it, the straight track is drawn over, the toes lifted off."""

    hurdle: Hurdle

    def __call__(self, x: float) -> Posture:
        """The posture when the knees are at x [m]."""
        wall = self.hurdle
        rise = math.asin(min(1.0, (wall.height + CLEARANCE) / UPPER))
        begin = touch(wall.distance, wall.height, rise)
        if x < begin - APPROACH:
            return STRETCHED
        share = _between(x, begin, begin + UPPER)
        lift = wall.end + 0.65 * LOWER + RADIUS
        if x > lift:
            return replace(LIFTED, speed=SLOW) if x < lift + LOWER else LIFTED
        standing = STEADY - rise
        hip = standing + share * (lean_over(wall.height) - standing)
        if x > wall.end + RADIUS:
            hip = ACROSS  # the tail comes down: the weight stays behind it

        return Posture(math.pi - (1 - share) * rise, hip, SLOW if x > begin - 0.3 else math.inf)


@dataclass(frozen=True)
class OverField:
    """Over rough ground in one posture; behind it the robot stands on its upper legs, to turn."""

    field: StepField | Ramps

    def __call__(self, x: float) -> Posture:
        """The posture when the knees are at x [m]."""
        return ARCHED if x < self.field.end + LOWER + RADIUS else LIFTED
