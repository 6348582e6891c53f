"""Postures of a driver: lower legs as flippers, trunk leant; all other joints on their brakes.

The lower legs lie folded back beside the upper ones. Raised (knee > 0) they free the rear, pressed
down (knee < 0) they lift it; the trunk's lean shifts the centre of mass.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules._core import JointPid, JointPidOptions
from hurcules.trials.brakes import release_joint

__all__ = ["FLAT", "Posture", "PostureMover"]

RATE = 0.4  # [rad/s], below the peak speeds 0.5 and 0.6
SETTLED = 0.005  # [rad] here a brake takes over


@dataclass(frozen=True)
class Posture:
    """Angles that a driver may choose."""

    knee: float = 0.0  # [rad] of both lower legs, from -0.35 (pressed down) to 0.9 (raised)
    hip: float = 0.0  # [rad] lean of the trunk, forward


FLAT = Posture()

# joint: inertia that its servo reckons with [kg m^2], bandwidth [rad/s]
_JOINTS = {"LKN": (60.0, 15.0), "RKN": (60.0, 15.0), "HIP": (200.0, 12.0)}


class PostureMover:
    """Moves knees and hip to what belongs to the robot's place, at a limited rate."""

    def __init__(
        self,
        model: mujoco.MjModel,
        data: mujoco.MjData,
        postures: Sequence[tuple[float, Posture]],
        steps: int,
    ) -> None:
        """Puts the robot into the first posture.

        Args:
            model: with a robot whose joints are braked.
            data: its state, changed.
            postures: each from which x on [m], growing.
            steps: of the physics between two calls.
        """
        self._model, self._postures = model, postures
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
        self._wanted = self._angles(postures[0][1])
        self._moving = False
        data.qpos[self._qpos] = self._wanted

    def __call__(self, data: mujoco.MjData) -> None:
        """One period: moves on, or leaves the joints to their brakes."""
        goal = self._angles(self.posture(float(data.qpos[0])))
        if not self._moving and np.array_equal(goal, self._wanted):
            return
        if not self._moving:
            self._start(data)
        move = np.clip(goal - self._wanted, -RATE * self._dt, RATE * self._dt)
        self._wanted = self._wanted + move
        error = self._wanted - data.qpos[self._qpos]
        torque = self._servo.compute(error, move / self._dt - data.qvel[self._dofs])
        data.ctrl[self._motors] = torque
        if not move.any() and np.abs(error).max() < SETTLED:
            self._stop(data)

    def posture(self, x: float) -> Posture:
        """The posture at a place [m]."""
        return [posture for start, posture in self._postures if x >= start][-1]

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

    @staticmethod
    def _angles(posture: Posture) -> np.ndarray:
        return np.array([posture.knee, posture.knee, posture.hip])
