"""Judging a policy: success, falls, limits and self-contact over many episodes."""

from __future__ import annotations

import sys
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hurcules.shares import wilson
from hurcules_envs.checks import require_whole
from hurcules_envs.endings import Ending
from hurcules_envs.episodes import Episodes
from hurcules_envs.pictures import Eyes
from hurcules_envs.policy import Policy
from hurcules_envs.registry import full_id, make_episodes, steps_of_episode

__all__ = ["SEED", "Evaluation", "evaluate"]

SEED = 10_000  # of the first episode: none of training


@dataclass(frozen=True)
class Evaluation:
    """How a policy did.

    Attributes:
        episodes: how many.
        success: share of them.
        low: lower end of its 95 % interval (Wilson).
        high: upper end.
        mean_return: sum of rewards, mean.
        mean_length: steps, mean.
        falls: share that ended by a fall.
        failures: share that failed otherwise, of the task say, see `ending` in info.
        limit_excess: worst, measured [rad].
        self_contacts: share of steps in which the robot touched itself.
        mean_cost: sum of `cost` in info, mean.
        endings: how many episodes were over by each `Ending`, by its name.
    """

    episodes: int
    success: float
    low: float
    high: float
    mean_return: float
    mean_length: float
    falls: float
    failures: float
    limit_excess: float
    self_contacts: float
    mean_cost: float
    endings: dict[str, int]


def evaluate(
    act: Callable[[Any], NDArray[Any]] | str | Path,
    environment: str,
    episodes: int = 100,
    seed: int = SEED,
    threads: int = 0,
    watch: Callable[[Episodes, NDArray[np.bool_]], None] | None = None,
    **options: Any,
) -> Evaluation:
    """Runs a policy once in each of many episodes.

    Args:
        act: actions (n, k) for observations (n, ...); a `Policy`, or what one is read from, is
            checked against the environment first.
        environment: id, "Reach-v0" say.
        episodes: how many, side by side.
        seed: of the first; they are not those of training.
        threads: 0 for one a processor.
        watch: is shown the episodes after each step, and (n,) which of them took it.
        options: of the environment, and ranges of what differs between episodes; `cameras` and
            `camera_size` as `gymnasium.make` takes them.

    Raises:
        hurcules.Error: `episodes` is no whole number >= 1, an option does not exist, or the policy
            is of another environment.
    """
    require_whole("episodes", episodes, 1)
    if isinstance(act, str | Path):
        act = Policy(act)
    environment = full_id(environment)
    drawn = {key: options.pop(key) for key in ("cameras", "camera_size") if key in options}
    batch = make_episodes(environment, episodes, seed, threads, **options)
    eyes = Eyes(batch, **drawn)
    if isinstance(act, Policy):
        act.check(environment, eyes.observation_space, batch.single_action_space)
    seen = batch.look(remember=None)
    running = np.ones(episodes, dtype=bool)
    success, failed = np.zeros(episodes, dtype=bool), np.zeros(episodes, dtype=bool)
    endings = np.full(episodes, Ending.TimeLimit)
    returns, lengths = np.zeros(episodes), np.zeros(episodes)
    touching, excess, cost = 0.0, 0.0, 0.0
    shape = (episodes, len(batch.action_scale))
    with closing(eyes):
        for _ in range(steps_of_episode(environment, options) or sys.maxsize):
            parts = eyes.look(seen.observation, running)
            batch.step(batch.checked(act(parts), shape), running)  # those that are over stand still
            seen = batch.look(remember=running)
            if watch is not None:
                watch(batch, running)
            info = seen.info
            returns[running] += seen.reward[running]
            lengths[running] += 1
            touching += float((info["self_contacts"][running] > 0).sum())
            cost += float(info["cost"][running].sum())
            excess = max(excess, float(info["limit_excess"][running].max()))
            success[running] = info["is_success"][running]
            failed[running] = info["failed"][running]
            ended = running & seen.terminated
            endings[ended] = info["ending"][ended]
            running &= ~ended
            if not running.any():
                break
    low, high = wilson(int(success.sum()), episodes)
    fell = endings == Ending.Fell
    return Evaluation(
        episodes=episodes,
        success=float(success.mean()),
        low=low,
        high=high,
        mean_return=float(returns.mean()),
        mean_length=float(lengths.mean()),
        falls=float(fell.mean()),
        failures=float((failed & ~fell).mean()),
        limit_excess=excess,
        self_contacts=touching / float(lengths.sum()),
        mean_cost=cost / episodes,
        endings={one.name: n for one in Ending if (n := int((endings == one).sum()))},
    )
