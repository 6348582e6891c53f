"""Demonstrations: what a scripted expert does, with mistakes that it mends."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_envs.registry import full_id, make_episodes, steps_of_episode

__all__ = ["Demonstrations", "ask_expert", "demonstrate"]

KEPT = 0.8  # how much of a push is left a step later


@dataclass(frozen=True)
class Demonstrations:
    """Steps of all episodes, side by side: m of them.

    Attributes:
        observations: (m, o), or of a goal environment a dictionary of such arrays.
        actions: (m, k) what the expert wanted to do, in [-1, 1].
        rewards: (t, n) of each step of each episode, 0 after its end.
        going: (t, n) which steps there are; rewards[going] is in the order of the observations.
        successes: (n,) which episodes succeeded.
    """

    observations: Any
    actions: NDArray[np.float32]
    rewards: NDArray[np.float64]
    going: NDArray[np.bool_]
    successes: NDArray[np.bool_]

    def returns(self, gamma: float) -> NDArray[np.float32]:
        """(m,) sum of the discounted rewards from each step on."""
        found, after = np.zeros_like(self.rewards), np.zeros(self.rewards.shape[1])
        for t in reversed(range(len(self.rewards))):
            after = found[t] = self.rewards[t] + gamma * after
        return found[self.going].astype(np.float32)


def ask_expert(name: str, episodes: Any, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """What the scripted expert wants to do now.

    Args:
        name: id of the environment.
        episodes: what has its `environment` and `numbers`.
        shape: of actions, (n, k).

    Raises:
        hurcules.Error: the environment has no expert, or one for another action: velocities of
            joints, say.
    """
    expert = getattr(getattr(episodes, "environment", None), "expert", None)
    wanted = None if expert is None else expert(episodes.numbers)
    if wanted is None or wanted.shape != shape:
        raise hurcules.Error(f"{name} has no expert for its action")
    return wanted


def demonstrate(
    name: str,
    episodes: int,
    seed: int = 0,
    noise: float = 0.3,
    act: Callable[[Any], NDArray[Any]] | None = None,
    **options: Any,
) -> Demonstrations:
    """The scripted expert acts while noise pushes its actions about, so that it has to mend.

    What is kept is what it wanted to do (Laskey et al., DART, 2017). Actions of 0 are not pushed.
    With `act` a policy acts in its place, and the expert says what it would have done there (Ross,
    Gordon and Bagnell, DAgger, 2011).

    Args:
        name: id of the environment, "Reach-v0" say.
        episodes: how many, side by side.
        seed: of episodes and noise.
        noise: standard deviation of the pushes.
        act: actions (n, k) for observations (n, ...), a `Policy` say; None: the expert acts.
        options: of the environment.

    Raises:
        hurcules.Error: the environment has no expert for its action.
    """
    name = full_id(name)
    batch = make_episodes(name, episodes, 1000 + seed, **options)
    shape = (episodes, len(batch.action_scale))
    seen = batch.look(remember=None)
    generator, push = np.random.default_rng(seed), np.zeros(shape)
    going, successes = np.ones(episodes, dtype=bool), np.zeros(episodes, dtype=bool)
    kept: list[tuple[Any, ...]] = []
    for _ in range(steps_of_episode(name, options) or sys.maxsize):
        before, wanted = _chosen(seen.observation, going), ask_expert(name, batch, shape)
        acted = wanted if act is None else act(seen.observation)
        fresh = generator.normal(0.0, noise, shape)
        push = KEPT * push + np.sqrt(1.0 - KEPT**2) * fresh
        batch.step(np.clip(acted + push * (acted != 0.0), -1.0, 1.0), going)
        seen = batch.look(remember=going)
        kept.append((before, wanted[going], np.where(going, seen.reward, 0.0), going))
        successes |= going & seen.info["is_success"]
        going = going & ~seen.terminated
        if not going.any():
            break
    observations, actions, rewards, steps = zip(*kept, strict=True)
    parts = {part: np.concatenate([one[part] for one in observations]) for part in observations[0]}
    return Demonstrations(
        parts if len(parts) > 1 else parts["observation"],
        np.concatenate(actions).astype(np.float32),
        np.array(rewards),
        np.array(steps),
        successes,
    )


def _chosen(seen: Mapping[str, NDArray[Any]], rows: NDArray[np.bool_]) -> dict[str, NDArray[Any]]:
    return {part: values[rows] for part, values in seen.items()}
