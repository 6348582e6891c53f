"""Episodes as data for imitation: Minari data sets."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import hurcules

__all__ = ["record"]

Act = Callable[[Any, Any], Any]  # (environment, observation) -> action (k,)


def record(
    environment: str,
    act: Act,
    episodes: int,
    out: Path,
    *,
    seed: int = 0,
    author: str = "expert",
    progress: Callable[[int], None] | None = None,
    **options: Any,
) -> str:
    """Runs a policy and writes what happened as a Minari data set.

    Args:
        environment: id.
        act: the policy.
        episodes: how many are recorded; successful or not, `infos` say which.
        out: folder of data sets, as MINARI_DATASETS_PATH.
        seed: of the first episode, the others follow.
        author: who acted, for the data set's description.
        progress: is told how many are done.
        options: of the environment.

    Returns:
        The id of the data set.

    Raises:
        hurcules.Error: Minari is not installed, or the data set exists.
    """
    out.mkdir(parents=True, exist_ok=True)
    os.environ["MINARI_DATASETS_PATH"] = str(out.resolve())
    try:
        import minari
    except ImportError as error:
        raise hurcules.Error(
            f"recording wants Minari: pip install 'hurcules[data]' ({error})"
        ) from None
    name = environment.split("/")[-1].removesuffix("-v0").lower()
    identifier = f"hurcules/{name}/{author}-v0"
    if (out / identifier).exists():
        raise hurcules.Error(f"{out / identifier} exists: give another folder")
    collector = minari.DataCollector(gymnasium.make(environment, **options), record_infos=True)
    for episode in range(episodes):
        observation, _ = collector.reset(seed=seed + episode)
        over = False
        while not over:
            action = np.asarray(act(collector.unwrapped, observation), dtype=np.float32)
            observation, _, terminated, truncated, _ = collector.step(action)
            over = terminated or truncated
        if progress is not None:
            progress(episode + 1)
    collector.create_dataset(
        identifier,
        algorithm_name=author,
        description=collector.unwrapped.task_description,
        author="The Hurcules developers",
        code_permalink="none",
        eval_env=gymnasium.spec(environment),
    )
    collector.close()
    return identifier
