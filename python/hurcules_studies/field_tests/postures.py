"""Postures of a driver: lower legs, trunk and speed; all other joints on their brakes.

The lower legs lie folded back beside the upper ones (knee 0), or are turned over to the front (knee
pi), where they and the upper legs make one long track. `climbing` chooses between them by place.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hurcules import JointRates, Simulation

__all__ = ["FLAT", "JOINTS", "POSTURE", "Plan", "Posture", "PostureMover", "always", "angles"]

RATE = 0.4  # [rad/s], below the peak speeds 0.5 and 0.6
SETTLED = 0.005  # [rad] here a brake takes over
EPSILON = 1e-9  # [rad] of rounding
WAITING = 0.15  # [rad] so far behind its posture the robot stands and waits for it


@dataclass(frozen=True)
class Posture:
    """What a driver may choose."""

    knee: float = 0.0  # [rad] of both lower legs, from -0.35 to 3.25
    hip: float = 0.0  # [rad] lean of the trunk against the upper legs, forward
    speed: float = math.inf  # [m/s] at most


FLAT = Posture()

# the posture at a place: x of the knee axis along the way [m]
Plan = Callable[[float], Posture]

JOINTS = ("LKN", "RKN", "HIP")  # that a posture moves
POSTURE = JointRates(JOINTS, RATE)  # its channel


def always(posture: Posture) -> Plan:
    """The plan that knows one posture."""
    return lambda x: posture


class PostureMover:
    """Commands knees and hip to the posture that is wanted; there their brakes take over."""

    def __init__(self, simulation: Simulation, posture: Posture) -> None:
        """Of a robot that stands in a posture.

        Args:
            simulation: its loop, with the channel `posture`, brakes shut.
            posture: to begin with.
        """
        self._controller, self._brakes = simulation.controller, simulation.brakes
        self._dt = simulation.dt
        self._joints = [simulation.controller.joints.index(joint) for joint in JOINTS]
        self._goal = angles(posture)
        self._moving = False

    def __call__(self, posture: Posture) -> NDArray[np.float64]:
        """The rates of `JOINTS` in the next tick [rad/s], (3,); its channel bounds them."""
        self._goal = angles(posture)
        behind = self._behind()
        error = np.abs(self._controller.joint_error[self._joints]).max()
        there = np.abs(behind).max() < EPSILON
        if not self._moving and not there:
            self._move(True)
        elif self._moving and there and error < SETTLED:
            self._move(False)
        return behind / self._dt

    @property
    def pace(self) -> float:
        """Share of the speed at which the robot may go on: 0 far behind its posture."""
        return max(0.0, 1.0 - float(np.abs(self._behind()).max()) / WAITING)

    def _move(self, moving: bool) -> None:
        self._moving = moving
        for joint in JOINTS:
            self._brakes.set_closed(joint, not moving)

    def _behind(self) -> NDArray[np.float64]:
        """What the servos' references lack of the posture [rad], (3,)."""
        return self._goal - self._controller.joint_places[self._joints]


def angles(posture: Posture) -> NDArray[np.float64]:
    """Of `JOINTS` [rad], (3,)."""
    return np.array([posture.knee, posture.knee, posture.hip])
