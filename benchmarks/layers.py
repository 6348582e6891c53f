"""The action layers that evidence.py compares on Reach and Press; some are no part of the package.

`LeastSquares` and `PressLeastSquares` are what many write first: resolved rates by damped least
squares, for forces with a plain admittance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

import hurcules
import hurcules_envs
from hurcules_envs.environment import Array, Numbers
from hurcules_envs.press import MOST, Press
from hurcules_envs.reach import Reach

DAMPING = 0.05  # [m/rad] of the least squares
SPEED = 0.3  # [m/s] that 1 in the action means, as for "twist"
TOUCH = 2.5  # [N] of the hand's reading from which on it presses, as in `ForceTask`
COMPLIANCE = 0.01  # [m/s/N] of the admittance: half of a force's error is gone after a step
SLIDE = 0.1  # [m/s] that 1 in the action means in Press
GAIN = 5.0  # [1/s] with which a velocity controller has errors vanish
AHEAD = 1.0 / 6.0  # [s] of full speed that a delta is at most, as in Reach
# of the expert's actions: its episodes then succeed as often as those of "twist"
PRESS_JOINT_PUSH = 0.02


def resolved(plan: hurcules.Robot, frames: Sequence[str], q: Array, v: Array) -> Array:
    """Velocities of the joints by damped least squares, J' (J J' + lambda^2 I)^-1 v.

    Args:
        plan: is moved.
        frames: h of them.
        q: (m, n) [rad] measured.
        v: (m, 3 h) [m/s] of the frames.

    Returns:
        (m, n) [rad/s].
    """
    rates = np.empty_like(q)
    for i in range(len(q)):
        plan.set_configuration(q[i])
        J = np.vstack([plan.position_jacobian(frame) for frame in frames])
        rates[i] = J.T @ np.linalg.solve(J @ J.T + DAMPING**2 * np.eye(len(J)), v[i])
    return rates


class LeastSquares(Reach):
    """Hands' twists turned into velocities of the joints by damped least squares.

    With the Jacobian of both hands at the measured posture, once a step of the policy. The
    velocities are then clipped joint by joint, to the same ranges, speeds and accelerations as all
    others: a joint that is clipped bends the path of the hands. Nothing keeps the posture, parts of
    the robot apart, or its balance.
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
        return {"joints": resolved(self._plan, self.setup.hands, numbers["q"], action["hands"])}


class PressDelta(Press):
    """References beside the measured hand in place of velocities; the force as in `Press`."""

    def controller(
        self,
        plan: hurcules.Robot,
        levels: Sequence[Any],
        channels: Mapping[str, Any],
        **options: Any,
    ) -> hurcules.WholeBodyController:
        """That of `Press` with two other channels."""
        ahead = {name: AHEAD * self.actions[name] for name in ("slide", "down")}
        deltas = {name: hurcules.Delta(channels[name].task, ahead[name]) for name in ahead}
        return super().controller(plan, levels, {**channels, **deltas}, **options)

    def _build(self, model: Any, tick: float) -> None:
        super()._build(model, tick)
        self.units = {**self.units, "slide": "m", "down": "m"}
        self.actions = {
            name: most * (1.0 if name == "force" else AHEAD) for name, most in self.actions.items()
        }

    def expert(self, numbers: Numbers) -> Array:
        """(n, 4) that of `Press`, so far ahead that the hierarchy moves the hand as fast."""
        action = super().expert(numbers)
        action[:, :3] /= GAIN * AHEAD
        return np.clip(action, -1.0, 1.0)


class PressJoint(Press):
    """The twin that commands joints, with an expert: that of `Press` by damped least squares.

    There is no force law. Where the hand reads 2.5 N, an admittance on this reading takes the place
    of what is commanded down: v = C (f_des - f), once a step of the policy.
    """

    def __init__(self, **options: Any) -> None:
        """As `Press`."""
        super().__init__(action="joint", **options)
        self._plan = hurcules.Robot(self.simulation.model)
        self._plan.set_qpos(self.simulation.data.qpos)
        self._plan.stand_on(self.support)
        self._rest = np.array(self._plan.configuration)

    def expert(self, numbers: Numbers) -> Array:
        """(n, k) what the expert of `Press` wants, by `rates`; other joints go back to the start.

        So they are pushed about too: a clone of an expert that leaves them alone breaks down where
        the drawn actions of a training move them.
        """
        wish = super().expert(numbers) * [SLIDE, SLIDE, SLIDE, MOST]
        rates = self.rates(wish[:, :2], wish[:, 2:3], wish[:, 3:], numbers)
        rates = np.where(rates == 0.0, self._rest - numbers["q"], rates)  # 1 /s
        return np.clip(rates / self.actions["joints"], -1.0, 1.0)

    def rates(self, slide: Array, down: Array, force: Array, numbers: Numbers) -> Array:
        """Velocities of the joints (m, n) [rad/s] for (m, 2), (m, 1) [m/s] and (m, 1) [N]."""
        reads = numbers["force/down"]
        down = np.where(reads > TOUCH, COMPLIANCE * (force - reads), down)
        twist = np.concatenate([slide, -down], axis=1)
        return resolved(self._plan, ["R_tcp"], numbers["q"], twist)


class PressLeastSquares(PressJoint):
    """The hand's twist turned into velocities of the joints, as in `LeastSquares`."""

    def __init__(self, **options: Any) -> None:
        """As `Press`."""
        super().__init__(**options)
        self.units = {"slide": "m/s", "down": "m/s", "force": "N"}
        self.actions = {"slide": SLIDE, "down": SLIDE, "force": MOST}
        self.components = {name: (name,) for name in ("down", "force")}
        self.components["slide"] = ("slide_0", "slide_1")
        self.observation = tuple(one for one in Press.observation if one.name != "lead")

    def expert(self, numbers: Numbers) -> Array:
        """(n, 4) that of `Press`."""
        return Press.expert(self, numbers)

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """The velocities of the joints."""
        rates = self.rates(action["slide"], action["down"], action["force"], numbers)
        return {"joints": rates}


REACH, PRESS = "Hurcules/Reach-v0", "Hurcules/Press-v0"
# "Reach-": its network sees the way to the goal; "Press": it has that recipe
PLAIN, PRESS_PLAIN = "Hurcules/Reach-LeastSquares-v0", "Hurcules/Press-LeastSquares-v0"
PRESS_DELTA, PRESS_JOINT = "Hurcules/Press-Delta-v0", "Hurcules/Press-Joint-v0"
hurcules_envs.register(PLAIN, "layers:LeastSquares", 100)
hurcules_envs.register(PRESS_PLAIN, "layers:PressLeastSquares", 300)
hurcules_envs.register(PRESS_DELTA, "layers:PressDelta", 300)
hurcules_envs.register(PRESS_JOINT, "layers:PressJoint", 300)

# by environment and layer the id of what is learnt, and its options
LAYERS: Mapping[str, Mapping[str, tuple[str, Mapping[str, Any]]]] = {
    "Reach": {
        "twist": (REACH, {}),
        "delta": (REACH, {"action": "delta"}),
        "joint": ("Hurcules/ReachJoint-v0", {}),
        "least squares": (PLAIN, {}),
    },
    "Press": {
        "twist": (PRESS, {}),
        "delta": (PRESS_DELTA, {}),
        "joint": (PRESS_JOINT, {}),
        "least squares": (PRESS_PLAIN, {}),
    },
}
