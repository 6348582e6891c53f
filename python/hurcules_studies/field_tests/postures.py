"""Postures of a driver: lower legs, trunk and speed; all other joints on their brakes.

The lower legs lie folded back beside the upper ones (knee 0), or are turned over to the front (knee
pi), where they and the upper legs make one long track. `climbing` chooses between them by place.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules._core import JointPid, JointPidOptions
from hurcules.driving.brakes import release_joint

__all__ = ["FLAT", "Plan", "Posture", "PostureMover", "always"]

RATE = 0.4  # [rad/s], below the peak speeds 0.5 and 0.6
SETTLED = 0.005  # [rad] here a brake takes over
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

# joint: inertia that its servo reckons with [kg m^2], bandwidth [rad/s]
_JOINTS = {"LKN": (60.0, 15.0), "RKN": (60.0, 15.0), "HIP": (200.0, 12.0)}


def always(posture: Posture) -> Plan:
    """The plan that knows one posture."""
    return lambda x: posture


class PostureMover:
    """Moves knees and hip to the posture that is wanted, at a limited rate, then brakes them."""

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, posture: Posture, steps: int
    ) -> None:
        """Puts the robot into a posture.

        Args:
            model: with a robot whose joints are braked.
            data: its state, changed.
            posture: to begin with.
            steps: of the physics between two calls.
        """
        self._model = model
        self._dt = steps * float(model.opt.timestep)
        self._motors = [model.actuator(joint).id for joint in _JOINTS]
        self._qpos = [int(model.jnt_qposadr[model.joint(joint).id]) for joint in _JOINTS]
        self._dofs = [int(model.jnt_dofadr[model.joint(joint).id]) for joint in _JOINTS]
        inertia, omega = np.array(list(_JOINTS.values())).T
        peak = model.actuator_forcerange[self._motors, 1]
        self._servo = JointPid(
            JointPidOptions(
                K=3 * omega * inertia, K_P=omega, K_I=omega**2 / 3, max_torque=peak, dt=self._dt
            )
        )
        self._goal = self._wanted = _angles(posture)
        self._moving = False
        data.qpos[self._qpos] = self._wanted

    def __call__(self, data: mujoco.MjData, posture: Posture) -> None:
        """One period: moves on, or leaves the joints to their brakes."""
        self._goal = _angles(posture)
        if not self._moving and np.array_equal(self._goal, self._wanted):
            return
        if not self._moving:
            self._start(data)
        move = np.clip(self._goal - self._wanted, -RATE * self._dt, RATE * self._dt)
        self._wanted = self._wanted + move
        error = self._wanted - data.qpos[self._qpos]
        torque = self._servo.compute(error, move / self._dt - data.qvel[self._dofs])
        data.ctrl[self._motors] = torque
        if not move.any() and np.abs(error).max() < SETTLED:
            self._stop(data)

    @property
    def pace(self) -> float:
        """Share of the speed at which the robot may go on: 0 far behind its posture."""
        behind = float(np.abs(self._goal - self._wanted).max())
        return max(0.0, 1.0 - behind / WAITING)

    def _start(self, data: mujoco.MjData) -> None:
        self._moving = True
        self._servo.reset()
        self._wanted = data.qpos[self._qpos].copy()
        for joint in _JOINTS:
            release_joint(self._model, joint, braked=False)

    def _stop(self, data: mujoco.MjData) -> None:
        self._moving = False
        data.ctrl[self._motors] = 0.0
        for joint in _JOINTS:
            release_joint(self._model, joint, braked=True)


def _angles(posture: Posture) -> np.ndarray:
    return np.array([posture.knee, posture.knee, posture.hip])
