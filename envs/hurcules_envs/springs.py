"""How hands swing that hang in springs, for the fidelity without physics.

The lower arms of the rescue robot turn about springs at their elbows, which no motor moves and no
plan knows. A policy that feeds back the hand at a high gain makes them swing; one that has never
seen them swing does not know. So without physics each hand is shown where a mass on such a spring
would be: e'' + 2 zeta omega e' + omega^2 e = -a, with the deflection e from the plan and the plan's
acceleration a, along each axis of the world alike.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules_envs.environment import Array

__all__ = ["Spring", "softest_spring"]


@dataclass(frozen=True)
class Spring:
    """A damped oscillator.

    Attributes:
        frequency: omega [rad/s].
        damping: zeta.
    """

    frequency: float
    damping: float

    def free(self, dt: float) -> Array:
        """(2, 2) what deflection and its rate become in dt [s] without acceleration."""
        decay = self.frequency * self.damping
        wave = np.sqrt(complex(self.frequency**2 - decay**2))  # imaginary where overdamped
        s, c = np.sin(wave * dt) / wave, np.cos(wave * dt)
        stiff = self.frequency**2
        return np.exp(-decay * dt) * np.real([[c + decay * s, s], [-stiff * s, c - decay * s]])


def softest_spring(model: mujoco.MjModel, data: mujoco.MjData) -> Spring | None:
    """The sprung hinge without a motor whose frequency is lowest; None: there is none.

    Args:
        model: of the robot.
        data: where it stands, after mj_forward; the inertia is that with all other joints still.
    """
    driven = set(model.actuator_trnid[:, 0])
    found = []
    for joint in range(model.njnt):
        stiffness = model.jnt_stiffness[joint]
        hinge = model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_HINGE
        if not hinge or joint in driven or stiffness <= 0.0:
            continue
        dof = model.jnt_dofadr[joint]
        unit, column = np.eye(model.nv)[dof], np.zeros(model.nv)
        mujoco.mj_mulM(model, data, column, unit)
        frequency = np.sqrt(stiffness / column[dof])
        found.append(Spring(frequency, model.dof_damping[dof] / (2 * frequency * column[dof])))
    return min(found, key=lambda one: one.frequency, default=None)
