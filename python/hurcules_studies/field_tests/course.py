"""Where a repetition leads: the line to keep to, the legs of the way, and the lane."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hurcules.scenes import Scene
from hurcules.scenes.flat import Pylons
from hurcules.scenes.hurdle import Hurdle
from hurcules.scenes.ramps import Ramps
from hurcules.scenes.step_field import StepField
from hurcules_studies.field_tests.methods import Method, Way

__all__ = ["Course", "Leg", "Oval", "Path", "Place", "Straight", "make_course"]

Array = NDArray[np.float64]

LENGTH = 1.2  # [m] the rear of the robot behind its base, and some room
TURNING = 1.5  # [m] the same for a robot with its lower legs in front, and room to turn round
HALF_LANE = 1.2  # [m]


@dataclass(frozen=True)
class Place:
    """A place beside a path."""

    offset: float  # [m] to the left of the path
    heading: float  # [rad] of the path there
    curvature: float  # [1/m] > 0 to the left
    straight: float  # [m] to the next curve, 0 in one


class Path(Protocol):
    """A line on the ground."""

    @property
    def radius(self) -> float:
        """Of its curves [m], inf for none."""
        ...

    def at(self, x: float, y: float) -> Place:
        """Returns the nearest place of the path."""
        ...


@dataclass
class Straight:
    """The line y = 0; a robot that turns round on it changes the heading."""

    heading: float = 0.0  # [rad] 0 or pi

    radius = math.inf

    def at(self, x: float, y: float) -> Place:
        """Returns the nearest place of the path."""
        return Place(y * math.cos(self.heading), self.heading, 0.0, math.inf)


@dataclass(frozen=True)
class Oval:
    """Round two pylons at (0, radius) and (spacing, radius), counter-clockwise."""

    spacing: float  # [m]
    radius: float  # [m]

    @property
    def length(self) -> float:
        """Of a lap [m]."""
        return 2 * self.spacing + 2 * math.pi * self.radius

    def at(self, x: float, y: float) -> Place:
        """Returns the nearest place of the path."""
        if 0.0 <= x <= self.spacing:
            away = y > self.radius
            offset = 2 * self.radius - y if away else y
            left = x if away else self.spacing - x
            return Place(offset, math.pi if away else 0.0, 0.0, left)
        dx, dy = x - (self.spacing if x > 0.0 else 0.0), y - self.radius
        heading = math.atan2(dy, dx) + math.pi / 2
        return Place(self.radius - math.hypot(dx, dy), heading, 1 / self.radius, 0.0)


@dataclass
class Leg:
    """A part of the way: to x = goal, or that many turns round a centre."""

    speed: float  # [m/s] < 0 tail first
    length: float  # [m]
    goal: float = 0.0  # [m] along x
    hold: float = 0.0  # [s] to stand still at its end
    heading: float = 0.0  # [rad] of the robot, 0 or pi
    mirror: float | None = None  # [m] x that counts as 0; the way is told backwards from there
    turns: int = 0  # round `centre` instead of to `goal`
    centre: tuple[float, float] = (0.0, 0.0)  # [m]
    _turned: float = field(default=0.0, repr=False)
    _bearing: float | None = field(default=None, repr=False)

    def done(self, qpos: Array) -> bool:
        """Whether the base is there; to be asked at every period."""
        if not self.turns:
            return bool(self.onward * (self.goal - qpos[0]) <= 0.0)
        bearing = math.atan2(qpos[1] - self.centre[1], qpos[0] - self.centre[0])
        if self._bearing is not None:
            self._turned += math.remainder(bearing - self._bearing, 2 * math.pi)
        self._bearing = bearing
        return self._turned >= 2 * math.pi * self.turns

    def place(self, x: float) -> float:
        """Where a posture's plan finds the robot [m]."""
        return x if self.mirror is None else self.mirror - x

    def further(self, one: float, other: float) -> float:
        """The one of two places that is farther on the way."""
        grows = self.onward > 0.0 or self.mirror is not None
        return max(one, other) if grows else min(one, other)

    @property
    def onward(self) -> float:
        """1 where x grows on the way, -1 where it falls."""
        return math.copysign(1.0, self.speed * math.cos(self.heading))


@dataclass(frozen=True)
class Course:
    """The way of one repetition."""

    path: Path
    legs: list[Leg]
    lifts: bool = False  # its leading legs where it gets stuck, then backs off

    def on_lane(self, qpos: Array) -> bool:
        """Whether the base is on the lane."""
        return abs(self.path.at(float(qpos[0]), float(qpos[1])).offset) <= HALF_LANE


def make_course(chosen: Method, setting: float | None, scene: Scene, speed: float | None) -> Course:
    """Returns the way of a method at a setting.

    Args:
        chosen: the method.
        setting: of its parameter.
        scene: that it is run on.
        speed: [m/s] instead of the method's own; sustained speed is its own setting.
    """
    pace = speed or chosen.speed
    if chosen.way is Way.Laps:
        assert isinstance(scene, Pylons) and setting is not None
        oval = Oval(scene.spacing, scene.side)
        centre = (scene.spacing / 2, scene.side)
        return Course(oval, [Leg(setting, oval.length, turns=1, centre=centre)])
    if chosen.way is Way.There:
        ahead = -1.0 if chosen.grasps else 1.0  # what the hands hold is before the robot
        goal = ahead * chosen.distance
        return Course(Straight(), [Leg(ahead * pace, chosen.distance, goal, chosen.hold)])
    goal = scene.end + (TURNING if chosen.turns_round else LENGTH)
    if not chosen.climbs:
        return Course(Straight(), [Leg(pace, goal, goal, chosen.hold), Leg(-pace, goal, 0.0)])
    there = Leg(-pace, goal, goal, chosen.hold, heading=math.pi)
    back = Leg(pace, goal, 0.0, heading=math.pi)
    if chosen.turns_round:
        assert isinstance(scene, (Hurdle, Ramps, StepField))
        # the obstacle looks the same from behind: its far side is the near one of the way back
        back = Leg(-pace, goal, 0.0, heading=0.0, mirror=scene.distance + scene.end)
    return Course(Straight(math.pi), [there, back], chosen.lifts)
