"""A loose thing or person in a model: another mass, another friction, another place."""

from __future__ import annotations

import math
from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

__all__ = ["Loose", "limp_person"]

PERSON = 75.0  # [kg] of the person that is built; others are as large, and as much denser


class Loose:
    """A body with a free joint, and all that hangs on it.

    Attributes:
        centre: (3,) [m] of its mass, where it lies at first.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        qpos: NDArray[np.float64],
        body: str,
        *,
        mass: float,
        surface: Sequence[str] = (),
    ) -> None:
        """Finds its parts.

        Args:
            model: in which it is.
            qpos: (nq,) where it lies.
            body: with the free joint.
            mass: [kg] of it in the model.
            surface: geoms whose friction differs; none: all that are touched.
        """
        self._own, self._mass = model, mass
        root = model.body(body)
        self._root = model.jnt_qposadr[root.jntadr[0]]
        self._bodies = np.flatnonzero(model.body_rootid == root.id)
        touched = np.isin(model.geom_bodyid, self._bodies) & (model.geom_contype != 0)
        named = np.array([model.geom(name).id for name in surface], int)
        self._surface = named if surface else np.flatnonzero(touched)
        self._scratch = mujoco.MjData(model)
        self._scratch.qpos[:] = qpos
        mujoco.mj_kinematics(model, self._scratch)
        mujoco.mj_comPos(model, self._scratch)
        self.centre = np.array(self._scratch.subtree_com[root.id])

    def configure(self, model: mujoco.MjModel, mass: float, friction: float) -> None:
        """Writes mass [kg] and sliding friction into a copy of the model."""
        ratio = mass / self._mass
        model.body_mass[self._bodies] = ratio * self._own.body_mass[self._bodies]
        model.body_inertia[self._bodies] = ratio * self._own.body_inertia[self._bodies]
        model.geom_friction[self._surface, 0] = friction
        mujoco.mj_setConst(model, self._scratch)

    def place(self, qpos: NDArray[np.float64], ahead: float, left: float, yaw: float) -> None:
        """Moves it in qpos (nq,) by [m] and turns it about its centre by [rad]; 2 mm up."""
        root = slice(self._root, self._root + 7)
        turn, quat = np.array([math.cos(yaw / 2), 0.0, 0.0, math.sin(yaw / 2)]), np.zeros(4)
        mujoco.mju_mulQuat(quat, turn, qpos[root][3:])
        lever = qpos[root][:2] - self.centre[:2]
        c, s = math.cos(yaw), math.sin(yaw)
        x = self.centre[0] + c * lever[0] - s * lever[1]
        y = self.centre[1] + s * lever[0] + c * lever[1]
        qpos[root] = [x + ahead, y + left, qpos[root][2] + 0.002, *quat]


def limp_person(model: mujoco.MjModel, qpos: NDArray[np.float64]) -> Loose:
    """The person of `hurcules.lift.spec`, whose friction is that of all clothes."""
    return Loose(model, qpos, "casualty_pelvis", mass=PERSON)
