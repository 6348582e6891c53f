"""Both hands on the handle of a sled: how they hold it, and whether they still do (E2830).

The fingers close along the way and the bar lies between them, so that not friction but the spindle
bears what the sled pulls: one of the two fingers is pushed open. Two hands of F = 400 N pull

    m (mu g + a) / (cos b + mu sin b) <= 2 F

a sled of mass m on runners of friction mu, whose bar rises by b: 182 kg at a steady speed, 129 kg
while the robot starts with a = 2 m/s^2.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules import Error, Simulation
from hurcules_studies.field_tests.postures import Posture

__all__ = ["PULLING", "Grasp"]

# the lower legs in front, the hands above them: the pull tips the robot no further than its toes
PULLING = Posture(math.pi, 0.8)
# [rad] of both arms: hands at the handle, 0.38 m apart, fingers along it, closing along the bar
ARM = {"SP": 1.326, "SR": 0.478, "SY": -1.046, "EB": 0.921, "WY": -0.334, "WP": 1.263, "WY2": 1.332}
BAR = 0.42  # [rad] it rises: near atan(mu), where a sled pulls least
NEAR = 0.036  # [m] a finger, just off the handle
FINGERS = ("L_grip_1", "R_grip_1")
INSIDE = 0.1  # [m] where they are led to, 59 mm inside the handle: 32 mm ask for all their force
LOST = 0.02  # [m] that the handle may move in a hand: half the width of the pads


class Grasp:
    """Holds the handle with the full force of the grippers."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Puts the arms into their posture, the sled to the hands, and the fingers around it.

        Args:
            model: a robot with hands, and a sled.
            data: its state, legs and trunk in their posture; changed.

        Raises:
            Error: the robot has no hands.
        """
        names = {model.actuator(i).name for i in range(model.nu)}
        if not {"L_grip", "R_grip"} <= names:
            raise Error("a sled is grasped by hands: wanted the robot 'manipulation'")
        self._hands = [model.body(f"{side}_hand").id for side in "LR"]
        self._handle = model.site("sled_handle").id
        self._held: NDArray[np.float64] | None = None
        for side in "LR":
            for joint, angle in ARM.items():
                data.joint(f"{side}{joint}").qpos[0] = angle
            for finger in "12":
                data.joint(f"{side}_grip_{finger}").qpos[0] = NEAR
        data.joint("sled_bar").qpos[0] = BAR
        mujoco.mj_kinematics(model, data)
        self._bring_sled(data)
        mujoco.mj_forward(model, data)

    def close(self, simulation: Simulation) -> None:
        """Before a tick: leads the fingers so far in that their motors give all they have."""
        for finger in FINGERS:
            simulation.brakes.set_closed(finger, False)
            simulation.controller.move(finger, INSIDE)

    def begin(self, data: mujoco.MjData) -> None:
        """The fingers have closed: here the handle is to stay."""
        self._held = self._in_hands(data)

    def lost(self, data: mujoco.MjData) -> bool:
        """Whether the handle has moved in a hand, from where it was at the beginning."""
        if self._held is None:
            return False
        moved = np.linalg.norm(self._in_hands(data) - self._held, axis=1)
        return bool(moved.max() > LOST)

    def _bring_sled(self, data: mujoco.MjData) -> None:
        """Turns and moves the sled on the ground until its handle is between the hands."""
        left, right = (data.site(f"{side}_tcp").xpos for side in "LR")
        across, middle = left - right, (left + right) / 2
        yaw = math.atan2(-across[0], across[1])
        root = data.joint("sled_root").qpos
        before = data.site("sled_handle").xpos[:2] - root[:2]
        turn = np.array([[math.cos(yaw), -math.sin(yaw)], [math.sin(yaw), math.cos(yaw)]])
        root[:2] = middle[:2] - turn @ before
        root[3:7] = math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)

    def _in_hands(self, data: mujoco.MjData) -> NDArray[np.float64]:
        """The middle of the handle, seen from both hands (2, 3) [m]."""
        handle = data.site_xpos[self._handle]
        frames = ((data.xmat[hand].reshape(3, 3), data.xpos[hand]) for hand in self._hands)
        return np.array([axes.T @ (handle - place) for axes, place in frames])
