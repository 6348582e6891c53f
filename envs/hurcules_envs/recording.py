"""Episodes as data for imitation: data sets of Minari, files of robomimic."""

from __future__ import annotations

import json
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import hurcules
from hurcules.validation import require_known

__all__ = ["record"]

Act = Callable[[Any, Any], Any]  # (environment, observation) -> action (k,)


FORMATS = ("minari", "robomimic")
GYM_TYPE = 2  # robomimic.envs.env_base.EnvType.GYM_TYPE


def record(
    environment: str,
    act: Act,
    episodes: int,
    out: Path,
    *,
    form: str = "minari",
    seed: int = 0,
    author: str = "expert",
    progress: Callable[[int], None] = lambda _: None,
    **options: Any,
) -> str:
    """Runs a policy and writes what happened as a data set.

    Reset with the seed of an episode, its actions alone give the same episode, bit for bit.

    Args:
        environment: id.
        act: the policy.
        episodes: how many are recorded; successful or not, the data say which.
        out: folder of data sets, as MINARI_DATASETS_PATH.
        form: "minari", or "robomimic": one HDF5 file, its demonstrations demo_0, demo_1, ...
        seed: of the first episode, the others follow.
        author: who acted, for the data set's description.
        progress: is told how many are done.
        options: of the environment.

    Returns:
        The id of the data set, or the path of the file.

    Raises:
        hurcules.Error: an unknown format, a package that it wants is not installed, or the data set
            exists.
    """
    require_known("format", form, FORMATS)
    out.mkdir(parents=True, exist_ok=True)
    write = _minari if form == "minari" else _robomimic
    return write(environment, act, episodes, out, seed, author, progress, options)


def _minari(
    environment: str,
    act: Act,
    episodes: int,
    out: Path,
    seed: int,
    author: str,
    progress: Callable[[int], None],
    options: dict[str, Any],
) -> str:
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


def _robomimic(
    environment: str,
    act: Act,
    episodes: int,
    out: Path,
    seed: int,
    author: str,
    progress: Callable[[int], None],
    options: dict[str, Any],
) -> str:
    """The layout of robomimic 0.3: data/demo_i with actions, rewards, dones, obs and next_obs."""
    try:
        import h5py
    except ImportError as error:
        raise hurcules.Error(f"robomimic's files want h5py: pip install h5py ({error})") from None
    path = out / f"{environment.split('/')[-1]}-{author}.hdf5"
    if path.exists():
        raise hurcules.Error(f"{path} exists: give another folder")
    part = path.with_suffix(".part")
    env: Any = gymnasium.make(environment, **options)
    about = {
        "env_name": environment, "env_version": hurcules.__version__, "type": GYM_TYPE,
        "env_kwargs": options,
    }  # fmt: skip
    try:
        with h5py.File(part, "w") as file:
            data = file.create_group("data")
            data.attrs["env_args"] = json.dumps(about)
            for episode in range(episodes):
                _demonstrate(env, act, seed + episode, data.create_group(f"demo_{episode}"))
                data.attrs["total"] = sum(int(demo.attrs["num_samples"]) for demo in data.values())
                progress(episode + 1)
        part.replace(path)
    finally:
        part.unlink(missing_ok=True)
        env.close()
    return str(path)


def _demonstrate(env: Any, act: Act, seed: int, demo: Any) -> None:
    """Runs an episode and writes it into a group of the file."""
    observation, _ = env.reset(seed=seed)
    seen, actions, rewards, dones, over = [_parts(observation)], [], [], [], False
    success = False
    while not over:
        action = np.asarray(act(env.unwrapped, observation), dtype=np.float32)
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        success = bool(info["is_success"])
        seen.append(_parts(observation))
        actions.append(action)
        rewards.append(float(reward))
        dones.append(int(over))
    demo.attrs["num_samples"], demo.attrs["seed"] = len(actions), seed
    demo.attrs["success"] = success
    for name, values in (("actions", actions), ("rewards", rewards), ("dones", dones)):
        demo.create_dataset(name, data=np.array(values))
    for name in seen[0]:
        demo.create_dataset(f"obs/{name}", data=np.stack([one[name] for one in seen[:-1]]))
        demo.create_dataset(f"next_obs/{name}", data=np.stack([one[name] for one in seen[1:]]))


def _parts(observation: Any) -> dict[str, Any]:
    """By name; robomimic calls what has no name flat."""
    return dict(observation) if isinstance(observation, dict) else {"flat": observation}
