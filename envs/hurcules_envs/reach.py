"""Hurcules/Reach-v0: the hands of a robot go to where they are wanted."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_envs.commands import channel_of
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start, tick_of
from hurcules_envs.robots import load_robot, sample_postures

__all__ = ["Reach"]

HOLD = 0.5  # [s] at the goal


class Reach(Environment):
    """Both hands reach goals that some posture without contact has.

    Two goals are never out of reach together, and never far from where the robot stands. The policy
    moves the references of the hands; limits come before them, posture after them.
    """

    task_description = "Bring each hand to its goal and hold it there."
    terms = ("distance", "success")

    def __init__(
        self,
        fidelity: str = "exact",
        action: str = "twist",
        robot: str = "rescue",
        frames: Sequence[str] | None = None,
        joints: Sequence[str] | None = None,
        tolerance: float = 0.03,
        sparse: bool = False,
        rate: float = 20.0,
    ) -> None:
        """Builds robot, controller and loop.

        Args:
            fidelity: "exact", "fast" or "kinematic".
            action: "twist", "delta" or "pose" of the hands.
            robot: "rescue", "manipulation" or the path of an MJCF file.
            frames: of a path: the frames of its hands.
            joints: of a path: its coordinates.
            tolerance: [m] of each hand.
            sparse: reward without the distance.
            rate: steps a second [Hz].

        Raises:
            hurcules.Error: a value that does not exist or is out of range.
        """
        if not 0.0 < tolerance < np.inf:
            raise hurcules.Error(f"tolerance: wanted a length > 0 [m], got {tolerance!r}")
        self.setup = load_robot(robot, frames, joints)
        self.postures = sample_postures(robot, frames, joints)
        self.tolerance, self.sparse, self.rate = tolerance, sparse, rate
        tick = tick_of(fidelity, rate)
        plan = self.setup.robot()
        plan.set_qpos(self.postures.qpos[0])
        hands = {
            f"hand_{i}": hurcules.PositionTask(f"hand_{i}", plan, frame)
            for i, frame in enumerate(self.setup.hands)
        }
        channels = {name: channel_of(action, hand) for name, hand in hands.items()}
        self.actions = {name: scale for name, (_, scale) in channels.items()}
        posture = hurcules.PostureTask("posture", plan)
        controller = hurcules.WholeBodyController(
            plan,
            [self.setup.limits(plan), list(hands.values()), posture],
            {name: channel for name, (channel, _) in channels.items()},
            dt=tick,
            support=self.setup.support,
            servo=self.setup.servo,
            torque_scaling=fidelity != "kinematic",
        )
        model = self.setup.model
        if fidelity != "kinematic":
            model = hurcules.models.with_timestep(model, tick)
        self.simulation = hurcules.Simulation(
            model=model, controller=controller, record=False, physics=fidelity != "kinematic"
        )
        h = len(hands)
        self.goal = 3 * h
        self.memory = {"goal": 3 * h, "held": 1, "done": 1}
        self.quantities = tuple(f"{w}/{n}" for w in ("value", "target") for n in hands) + tuple(
            f"velocity/{frame}" for frame in self.setup.hands
        )
        self.observation = (
            Group("hand", 3 * h, "m", 5.0, "hands in the world"),
            Group("velocity", 3 * h, "m/s", 5.0, "their velocities"),
            Group("lead", 3 * h, "m", 1.0, "references minus hands"),
        )
        self._hands = list(hands)

    def start(self, generator: np.random.Generator) -> Start:
        """A posture to start from, another one whose hands are the goals."""
        first, second = generator.choice(len(self.postures.qpos), 2, replace=False)
        return Start(self.postures.qpos[first], {"goal": self.postures.hands[second].ravel()})

    def remember(self, numbers: Numbers) -> None:
        """How long the hands have been at their goals."""
        at_goal = self._distances(numbers["goal"], self._hand(numbers)).max(axis=1) < self.tolerance
        held = numbers.memory["held"]
        held[:, 0] = np.where(at_goal, held[:, 0] + numbers.dt, 0.0)
        numbers.memory["done"][held >= HOLD - 1e-9] = 1.0

    def observe(self, numbers: Numbers) -> dict[str, Array]:
        """Hands, velocities, leads; the goals stand beside them."""
        hand = self._hand(numbers)
        target = np.concatenate([numbers[f"target/{name}"] for name in self._hands], axis=1)
        velocity = [numbers[f"velocity/{frame}"] for frame in self.setup.hands]
        return {
            "hand": hand,
            "velocity": np.concatenate(velocity, axis=1),
            "lead": target - hand,
        }

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """Where the hands are, and where they are wanted."""
        return self._hand(numbers), numbers["goal"]

    def reward(self, numbers: Numbers) -> dict[str, Array]:
        """Minus the mean distance, and 1 for all hands within the tolerance."""
        return self._terms(self._hand(numbers), numbers["goal"])

    def compute_reward(self, achieved: Array, desired: Array, info: Any) -> Array | float:
        """The reward of other goals, any leading axes."""
        terms = self._terms(np.asarray(achieved, float), np.asarray(desired, float))
        reward = terms["distance"] + terms["success"]
        return float(reward) if np.ndim(reward) == 0 else reward

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """All hands were at their goals for half a second."""
        return numbers["done"][:, 0] > 0.0

    def _terms(self, achieved: Array, desired: Array) -> dict[str, Array]:
        distance = self._distances(achieved, desired)
        shaped = 0.0 if self.sparse else 1.0
        return {
            "distance": -shaped * distance.mean(axis=-1),
            "success": (distance.max(axis=-1) < self.tolerance).astype(np.float64),
        }

    def _hand(self, numbers: Numbers) -> Array:
        return np.concatenate([numbers[f"value/{name}"] for name in self._hands], axis=1)

    @staticmethod
    def _distances(one: Array, other: Array) -> Array:
        """(..., h) [m]."""
        difference = (one - other).reshape(*one.shape[:-1], -1, 3)
        return np.linalg.norm(difference, axis=-1)
