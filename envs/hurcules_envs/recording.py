"""Episodes as data for imitation: run once, kept one by one, then written as a data set.

Each episode is a file from the moment it ends, in a folder `NAME.part` beside the data set. The
data set appears when it is whole, and the folder goes. A recording that was stopped, by a full disk
say, has lost nothing that was finished: the same command goes on with it.
"""

from __future__ import annotations

import json
import re
import shutil
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import hurcules
from hurcules.output import WriteError, differing
from hurcules.validation import require_known
from hurcules_envs.checks import require_whole
from hurcules_envs.data_formats import FORMATS
from hurcules_envs.endings import Ending
from hurcules_envs.episode_data import Episode, Recording
from hurcules_envs.registry import full_id, steps_of_episode

__all__ = ["Act", "Again", "record", "record_episode"]

# (environment, observation) -> action (k,), or None: the episode ends here
Act = Callable[[Any, Any], Any]


class Again(Exception):
    """Raised by who acts: this attempt does not count, the episode begins anew."""


def record(
    environment: str,
    act: Act,
    episodes: int,
    out: str | Path,
    *,
    form: str = "minari",
    seed: int = 0,
    author: str = "expert",
    source: str = "",
    check: Callable[[Any], object] = lambda _: None,
    progress: Callable[[int, int], None] = lambda _, __: None,
    **options: Any,
) -> str:
    """Runs a policy and writes what happened as a data set.

    Reset with the seed of an episode, its actions alone give the same episode, bit for bit.

    Args:
        environment: id, "Reach-v0" say.
        act: the policy, or a person: a function of the environment and what is seen, an array or a
            dictionary, that gives the action (k,), None where the episode ends here, or raises
            `Again`. The loop underneath is `env.simulation`.
        episodes: how many are recorded; successful or not, the data say which.
        out: folder of data sets, as MINARI_DATASETS_PATH.
        form: "minari"; "robomimic", one HDF5 file, its demonstrations demo_0, demo_1, ...; or
            "lerobot", a folder.
        seed: of the first episode, the others follow.
        author: who acts, for the data set's name: letters, digits, "_" and "-".
        source: which policy, so that a recording that was stopped goes on with no other.
        check: is given the environment before anything is written; raises where it does not fit.
        progress: is told how many are done, at first 0, and how many of them succeeded.
        options: of the environment, and `max_episode_steps`; at another `rate` episodes last as
            long, unless it is given.

    Returns:
        The id of the data set, or the path of the file or folder.

    Raises:
        hurcules.Error: no function that acts, an unknown format, a package that it wants is not
            installed, the data set exists, more episodes are kept than are wanted, or it could not
            be written; the text says how many episodes are kept, and where.
    """
    require_known("format", form, FORMATS)
    if not callable(act):
        raise hurcules.Error(f"act: wanted a function of environment and observation, got {act!r}")
    written = FORMATS[form]
    recording = _wanted(environment, episodes, seed, author, source, options)
    target = Path(out) / written.place(recording)
    if target.exists():
        raise hurcules.Error(
            f"{target} exists: give another folder, and for more episodes the seed after its last"
        )
    part = target.with_name(target.name + ".part")
    paths = [part / f"{i:06d}.npz" for i in range(episodes)]
    env: Any = gymnasium.make(recording.environment, **recording.options)
    try:
        check(env.unwrapped)
        written.require()
        with _told(target, paths):
            part.mkdir(parents=True, exist_ok=True)
            _same(recording, part / "recording.json")
        succeeded = 0
        progress(0, succeeded)
        for i, path in enumerate(paths):
            if path.exists():
                episode = Episode.load(path)
            else:
                episode = _counted(env, act, seed + i)
                with _told(target, paths):
                    episode.save(path)
            succeeded += episode.success
            progress(i + 1, succeeded)
        with _told(target, paths):
            _remove(part / "whole")
            written.write(recording, env, map(Episode.load, paths), part / "whole")
            (part / "whole" / written.place(recording)).replace(target)
    except BaseException as error:
        if _kept(paths) not in str(error):
            error.add_note(_kept(paths))
        raise
    finally:
        env.close()
        if not any(path.exists() for path in paths):
            _remove(part)
    _remove(part)
    return written.identifier(recording, target)


def _wanted(
    environment: str,
    episodes: int,
    seed: int,
    author: str,
    source: str,
    options: Mapping[str, Any],
) -> Recording:
    if not isinstance(environment, str):
        raise hurcules.Error(f"environment: wanted an id, Reach-v0 say, got {environment!r}")
    require_whole("episodes", episodes, 1)
    if not re.fullmatch(r"[\w-]+", author, re.ASCII):
        raise hurcules.Error(f"author: wanted letters, digits, '_' and '-', got {author!r}")
    name, plain = full_id(environment), json.loads(json.dumps(options, default=_plain))
    if "rate" in plain:  # episodes last as long at any
        plain = {"max_episode_steps": steps_of_episode(name, plain)} | plain
    return Recording(name, episodes, seed, author, source, plain)


def _plain(value: Any) -> Any:
    """Options as JSON has them: arrays are lists, paths are texts."""
    return value.tolist() if isinstance(value, np.ndarray | np.generic) else str(value)


@contextmanager
def _told(target: Path, paths: Sequence[Path]) -> Iterator[None]:
    """What could not be written, with what is kept."""
    try:
        yield
    except (OSError, ImportError, RuntimeError) as error:  # the last is HDF5's word for the first
        reason = getattr(error, "strerror", None) or error
        told = f"{target} could not be written: {reason}. {_kept(paths)}"
        raise WriteError(told.strip()) from error


def _kept(paths: Sequence[Path]) -> str:
    kept = sum(path.exists() for path in paths)
    if not kept:
        return ""
    return (
        f"{kept} of {len(paths)} episodes are kept in {paths[0].parent}; the same command goes on "
        f"with them, and for {kept} episodes it writes these alone"
    )


def _same(recording: Recording, path: Path) -> None:
    """A recording that goes on is the one that was stopped."""
    settings = asdict(recording) | {"version": hurcules.__version__}
    settings = json.loads(json.dumps(settings))
    earlier = json.loads(path.read_text() or "{}") if path.exists() else {}
    wanted = {name: settings.get(name) for name in earlier if name != "episodes"}
    if others := differing(earlier, wanted):
        raise hurcules.Error(
            f"{path.parent} holds another recording that was stopped: {', '.join(others)}; "
            "delete it or give another folder"
        )
    kept = len(list(path.parent.glob("*.npz")))
    if kept > recording.episodes:
        raise hurcules.Error(
            f"{path.parent} holds {kept} episodes that are finished, {recording.episodes} were "
            "wanted: ask for all of them, delete it or give another folder"
        )
    path.write_text(json.dumps(settings, indent=1) + "\n")


def _remove(folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)


def _counted(env: Any, act: Act, seed: int) -> Episode:
    while True:
        try:
            return record_episode(env, act, seed)
        except Again:
            continue


def record_episode(env: Any, act: Act, seed: int) -> Episode:
    """One episode as a policy acts, reset with this seed.

    Raises:
        hurcules.Error: it ended before its first step, or an action that is none.
        Again: the policy did.
    """
    observation, info = env.reset(seed=seed)
    seen, told, steps, over = [_parts(observation)], [info], [], False
    while not over:
        chosen = act(env.unwrapped, observation)
        if chosen is None:
            break
        # what is done is what is recorded
        action = np.clip(np.asarray(chosen, dtype=np.float32), -1.0, 1.0)
        observation, reward, terminated, truncated, info = env.step(action)
        over = terminated or truncated
        if "ending" in info:
            info = {**info, "ending": np.int64(Ending.of(info, truncated))}
        seen.append(_parts(observation))
        told.append(info)
        steps.append((action, reward, terminated, truncated))
    if not steps:
        raise hurcules.Error("the episode ended before its first step; `Again` begins it anew")
    steps[-1] = (*steps[-1][:3], steps[-1][3] or not over)  # who acts may cut it too
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
