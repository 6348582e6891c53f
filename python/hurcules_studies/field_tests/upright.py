"""How upright a robot stands, whichever of its legs it stands on."""

from __future__ import annotations

import math

import mujoco

__all__ = ["Upright"]


class Upright:
    """Tells a robot that lies from one that climbs or stands up."""

    def __init__(self, model: mujoco.MjModel) -> None:
        """Of a model with a robot."""
        self._upper, self._lower = model.body("upper_legs").id, model.body("lower_leg_L").id
        self._knee = int(model.jnt_qposadr[model.joint("LKN").id])

    def cosine(self, data: mujoco.MjData) -> float:
        """Of the tilt of the upper or the lower legs, whichever lie flatter."""
        # a lower leg that is turned over to the front has its top below; the robot stands on it
        # from a knee angle of about pi/2 on
        side = 1.0 if data.qpos[self._knee] < math.pi / 3 else -1.0
        return max(float(data.xmat[self._upper, 8]), side * float(data.xmat[self._lower, 8]))
