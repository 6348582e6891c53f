"""What a robot does to a person: contacts over the limits of their regions, a head that is shaken.

A robot that pushes somebody who lies is a contact, judged by its force; one that carries is a
support, judged by its pressure (docs/design/test-methods.md): with more than 15 % of the weight on
the ground each force counts as a contact, as in the monitor of the missions.
"""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules.casualties import CARRIES, contact_limit
from hurcules_envs.environment import Array, Numbers

__all__ = ["HEAD", "Contacts", "harm"]

HEAD = 98.1  # [m/s^2] 10 g
MOST = 8  # contacts of a region with the robot that count, the strongest
PREFIX, ROBOT = "casualty_", "upper_legs"


def harm(share: Array, head: Array) -> Array:
    """(n,) what contacts have over their limits, and the head over 10 g, as shares of these.

    Args:
        share: (n,) largest force of a contact over the limit of its region.
        head: (n,) [m/s^2] of the head, gravity included.
    """
    return np.maximum(share - 1.0, 0.0) + np.maximum(head / HEAD - 1.0, 0.0)


class Contacts:
    """Contacts of the robot with the person of a scene, by region of the body.

    Attributes:
        quantities: what is read.
    """

    def __init__(self, spec: mujoco.MjSpec) -> None:
        """Adds a sensor for each region of the person `casualty_`."""
        start = f"{PREFIX}force_"
        names = [one.name for one in spec.sensors if one.name.startswith(start)]
        regions = [name.removeprefix(start) for name in names]
        for region in regions:
            sensor = spec.add_sensor(
                name=f"{PREFIX}touch_{region}",
                type=mujoco.mjtSensor.mjSENS_CONTACT,
                objtype=mujoco.mjtObj.mjOBJ_BODY,
                objname=PREFIX + region,
                reftype=mujoco.mjtObj.mjOBJ_XBODY,
                refname=ROBOT,
            )
            force, strongest = mujoco.mjtConDataField.mjCONDATA_FORCE, 2
            sensor.intprm[:3] = [1 << int(force), strongest, MOST]
        self._limits = np.array([contact_limit(region) for region in regions])
        self._touches = tuple(f"sensor/{PREFIX}touch_{region}" for region in regions)
        self._head = f"sensor/{PREFIX}head_acceleration"
        self.quantities = (*self._touches, self._head)

    def forces(self, numbers: Numbers) -> Array:
        """(n, regions) [N] sum of the normal forces of the robot."""
        forces = numbers.row(*self._touches).reshape(len(numbers.action), -1, MOST, 3)
        return np.asarray(np.abs(forces[..., 0]).sum(axis=-1))

    def share(self, numbers: Numbers, lying: NDArray[np.float64]) -> Array:
        """(n,) largest force over its limit; 0 of who is carried.

        Args:
            numbers: after a step.
            lying: (n,) share of the weight on the ground.
        """
        share = (self.forces(numbers) / self._limits).max(axis=1)
        return np.where(lying > CARRIES, share, 0.0)

    def support(self, numbers: Numbers, lying: NDArray[np.float64]) -> Array:
        """(n,) [N] largest force on a region of who is carried, else 0; see `share`."""
        return np.where(lying > CARRIES, 0.0, self.forces(numbers).max(axis=1))

    def head(self, numbers: Numbers) -> Array:
        """(n,) [m/s^2] of the head, gravity included."""
        return np.asarray(np.linalg.norm(numbers[self._head], axis=1))
