"""A limp person in a model: another mass, other clothes, another place."""

from __future__ import annotations

import math

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["LimpPerson"]

OWN = 75.0  # [kg] of the person that is built; others are as large, and as much denser


class LimpPerson:
    """The person of `hurcules.lift.spec` in a model.

    Attributes:
        centre: (3,) [m] of the body where it lies at first.
    """

    def __init__(self, model: mujoco.MjModel, qpos: NDArray[np.float64]) -> None:
        """Finds the parts.

        Args:
            model: with the prefix "casualty_".
            qpos: (nq,) where the person lies.
        """
        self._own = model
        self._root = model.joint("casualty_root").qposadr[0]
        pelvis = model.body("casualty_pelvis").id
        self._bodies = np.flatnonzero(model.body_rootid == pelvis)
        touched = np.isin(model.geom_bodyid, self._bodies) & (model.geom_contype != 0)
        self._clothes = np.flatnonzero(touched)
        self._scratch = mujoco.MjData(model)
        self._scratch.qpos[:] = qpos
        mujoco.mj_kinematics(model, self._scratch)
        mujoco.mj_comPos(model, self._scratch)
        self.centre = np.array(self._scratch.subtree_com[pelvis])

    def configure(self, model: mujoco.MjModel, mass: float, friction: float) -> None:
        """Writes mass [kg] and friction of the clothes into a copy of the model."""
        ratio = mass / OWN
        model.body_mass[self._bodies] = ratio * self._own.body_mass[self._bodies]
        model.body_inertia[self._bodies] = ratio * self._own.body_inertia[self._bodies]
        model.geom_friction[self._clothes, 0] = friction
        mujoco.mj_setConst(model, self._scratch)

    def place(self, qpos: NDArray[np.float64], ahead: float, left: float, yaw: float) -> None:
        """Moves the person in qpos (nq,) by [m] and turns the body about its centre by [rad]."""
        root = slice(self._root, self._root + 7)
        turn, quat = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]), np.zeros(4)
        mujoco.mju_mulQuat(quat, turn, qpos[root][3:])
        lever = qpos[root][:2] - self.centre[:2]
        c, s = math.cos(yaw), math.sin(yaw)
        x = self.centre[0] + c * lever[0] - s * lever[1]
        y = self.centre[1] + s * lever[0] + c * lever[1]
        qpos[root] = [x + ahead, y + left, qpos[root][2] + 0.002, *quat]
