"""Episodes as data for imitation: run once, kept one by one, then written as a data set.

Each episode is a file from the moment it ends, in a folder `NAME.part` beside the data set. The
data set appears when it is whole, and the folder goes. A recording that was stopped, by a full disk
say, has lost nothing that was finished: the same command goes on with it.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Callable, Iterator
from dataclasses import asdict
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import hurcules
from hurcules.validation import require_known
from hurcules_envs.data_formats import FORMATS
from hurcules_envs.episode_data import Episode, Recording

__all__ = ["Act", "record", "record_episode"]

Act = Callable[[Any, Any], Any]  # (environment, observation) -> action (k,)


def record(
    environment: str,
    act: Act,
    episodes: int,
    out: Path,
    *,
    form: str = "minari",
    seed: int = 0,
    author: str = "expert",
    source: str = "",
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
        form: "minari"; "robomimic", one HDF5 file, its demonstrations demo_0, demo_1, ...; or
            "lerobot", a folder.
        seed: of the first episode, the others follow.
        author: who acts, for the data set's name and description.
        source: which policy, so that a recording that was stopped goes on with no other.
        progress: is told how many are done.
        options: of the environment.

    Returns:
        The id of the data set, or the path of the file or folder.

    Raises:
        hurcules.Error: an unknown format, a package that it wants is not installed, the data set
            exists, or it could not be written; the text says how many episodes are kept, and where.
    """
    require_known("format", form, FORMATS)
    written = FORMATS[form]
    written.require()
    recording = Recording(environment, episodes, seed, author, source, options)
    target = out / written.place(recording)
    if target.exists():
        raise hurcules.Error(f"{target} exists: give another folder")
    part = target.with_name(target.name + ".part")
    env: Any = gymnasium.make(environment, **options)
    try:
        part.mkdir(parents=True, exist_ok=True)
        _same(recording, part / "recording.json")
        for i, path in enumerate(_paths(recording, part)):
            if not path.exists():
                record_episode(env, act, seed + i).save(path)
            progress(i + 1)
        _remove(part / "whole")
        written.write(recording, env, _read(recording, part), part / "whole")
        (part / "whole" / written.place(recording)).replace(target)
    except (OSError, ImportError, RuntimeError) as error:  # the last is HDF5's word for the first
        kept = sum(path.exists() for path in _paths(recording, part))
        raise hurcules.Error(
            f"{target} could not be written: {error}. {kept} of {episodes} episodes are kept in "
            f"{part}; the same command goes on with them"
        ) from error
    finally:
        env.close()
        if not any(path.exists() for path in _paths(recording, part)):
            _remove(part)
    _remove(part)
    return written.identifier(recording, target)


def _same(recording: Recording, path: Path) -> None:
    """A recording that goes on is the one that was stopped."""
    settings = asdict(recording) | {"version": hurcules.__version__}
    settings = json.loads(json.dumps(settings))
    earlier = json.loads(path.read_text() or "{}") if path.exists() else {}
    differing = [n for n in earlier if n != "episodes" and earlier[n] != settings.get(n)]
    if differing:
        raise hurcules.Error(
            f"{path.parent} holds a recording that was stopped, with another "
            f"{', '.join(differing)}: delete it or give another folder"
        )
    path.write_text(json.dumps(settings, indent=1) + "\n")


def _paths(recording: Recording, part: Path) -> list[Path]:
    return [part / f"{i:06d}.npz" for i in range(recording.episodes)]


def _read(recording: Recording, part: Path) -> Iterator[Episode]:
    return (Episode.load(path) for path in _paths(recording, part))


def _remove(folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)


def record_episode(env: Any, act: Act, seed: int) -> Episode:
    """One episode as a policy acts, reset with this seed."""
    observation, info = env.reset(seed=seed)
    seen, told, steps, over = [_parts(observation)], [info], [], False
    while not over:
        action = np.asarray(act(env.unwrapped, observation), dtype=np.float32)
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        seen.append(_parts(observation))
        told.append(info)
        steps.append((action, reward, terminated, truncated))
    actions, rewards, terminated, truncated = zip(*steps, strict=True)
    return Episode(
        seed,
        {name: np.stack([one[name] for one in seen]) for name in seen[0]},
        np.stack(actions),
        np.array(rewards, dtype=float),
        np.array(terminated),
        np.array(truncated),
        {name: np.array([one[name] for one in told]) for name in told[0]},
    )


def _parts(observation: Any) -> dict[str, Any]:
    return dict(observation) if isinstance(observation, dict) else {"flat": observation}
