"""The action layers that evidence.py compares on Reach; the last one is not part of the package.

`LeastSquares` is what many write first: resolved rates by damped least squares.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

import hurcules_envs
from hurcules_envs.environment import Array, Numbers
from hurcules_envs.reach import Reach

DAMPING = 0.05  # [m/rad] of the least squares
SPEED = 0.3  # [m/s] that 1 in the action means, as for "twist"


class LeastSquares(Reach):
    """Hands' twists turned into velocities of the joints by damped least squares.

    qdot = J' (J J' + lambda^2 I)^-1 v with the Jacobian J of both hands at the measured posture,
    once a step of the policy. The velocities are then clipped joint by joint, to the same ranges,
    speeds and accelerations as all others: a joint that is clipped bends the path of the hands.
    Nothing keeps the posture, parts of the robot apart, or its balance.
    """

    def __init__(
        self,
        fidelity: str = "exact",
        robot: str = "rescue",
        sparse: bool = False,
        rate: float = 20.0,
    ) -> None:
        """As `Reach`."""
        super().__init__(fidelity, "joint", robot, sparse=sparse, rate=rate, safe=False)
        names = tuple(f"{name}_{axis}" for name in self._names for axis in "xyz")
        self.actions, self.components = {"hands": SPEED}, {"hands": names}
        self.observation = self.observation[:1]  # the hands, as for "twist"
        self._plan = self.setup.robot()

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """The hands alone."""
        return {"hand": self._hands(numbers)}

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """The velocities of the joints."""
        rates = np.empty_like(numbers["q"])
        for i, (q, v) in enumerate(zip(numbers["q"], action["hands"], strict=True)):
            self._plan.set_configuration(q)
            J = np.vstack([self._plan.position_jacobian(frame) for frame in self.setup.hands])
            square = J @ J.T + DAMPING**2 * np.eye(len(J))
            rates[i] = J.T @ np.linalg.solve(square, v)
        return {"joints": rates}


REACH = "Hurcules/Reach-v0"
PLAIN = "Hurcules/Reach-LeastSquares-v0"  # "Reach-": its network sees the way to the goal
hurcules_envs.register(PLAIN, "layers:LeastSquares", 100)

# by layer the id of the environment and its options
LAYERS: Mapping[str, tuple[str, Mapping[str, Any]]] = {
    "twist": (REACH, {}),
    "delta": (REACH, {"action": "delta"}),
    "joint": ("Hurcules/ReachJoint-v0", {}),
    "least squares": (PLAIN, {}),
}
