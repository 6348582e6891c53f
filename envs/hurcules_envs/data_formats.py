"""Recorded episodes as the data sets of others: Minari, robomimic, LeRobot."""

from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.util import find_spec
from inspect import signature
from io import BytesIO
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_envs.episode_data import Episode, Recording
from hurcules_envs.registry import spec_of

__all__ = ["FORMATS", "Format"]

GYM_TYPE = 2  # robomimic.envs.env_base.EnvType.GYM_TYPE
MINARI_PATH = "MINARI_DATASETS_PATH"


@dataclass(frozen=True)
class Format:
    """A kind of data set.

    Attributes:
        package: that writes it, and how it is installed.
        place: of the data set in the folder of all.
        write: writes one from a recording, its environment and the episodes, into such a folder.
        path_is_id: the data set is known by its path, not by its place.
    """

    package: tuple[str, str]
    place: Callable[[Recording], str]
    write: Callable[[Recording, Any, Iterable[Episode], Path], None]
    path_is_id: bool = True

    def require(self) -> None:
        """Throws hurcules.Error where the package is not installed."""
        module, install = self.package
        if find_spec(module) is None:
            raise hurcules.Error(f"this format wants {module}: pip install {install}")

    def identifier(self, recording: Recording, target: Path) -> str:
        """What its readers want to be told."""
        return str(target) if self.path_is_id else self.place(recording)


def _minari_place(recording: Recording) -> str:
    name = recording.name.removesuffix("-v0").lower()
    return f"hurcules/{name}/{recording.author}-v0"


def _minari(recording: Recording, env: Any, episodes: Iterable[Episode], out: Path) -> None:
    import minari
    from minari.data_collector import EpisodeBuffer

    out.mkdir()
    before = os.environ.get(MINARI_PATH)
    os.environ[MINARI_PATH] = str(out.resolve())
    dataset: Any = None
    create = minari.create_dataset_from_buffers
    as_seen = {"jpeg_encoding": False} if "jpeg_encoding" in signature(create).parameters else {}
    try:
        for i, one in enumerate(episodes):  # pictures of all together may be more than the memory
            buffer = EpisodeBuffer(
                id=i,
                seed=one.seed,
                observations=one.observations.get("flat", one.observations),
                actions=one.actions,
                rewards=one.rewards.tolist(),
                terminations=one.terminated.tolist(),
                truncations=one.truncated.tolist(),
                infos=dict(one.infos),
            )
            if dataset is not None:
                dataset.update_dataset_from_buffer([buffer])
                continue
            dataset = create(
                _minari_place(recording),
                [buffer],
                env=env,
                eval_env=spec_of(recording.environment),
                algorithm_name=recording.author,
                description=env.unwrapped.task_description,
                author="The Hurcules developers",
                author_email="none",
                code_permalink="none",
                **as_seen,
            )
    finally:
        del os.environ[MINARI_PATH]
        if before is not None:
            os.environ[MINARI_PATH] = before


def _robomimic_place(recording: Recording) -> str:
    return f"{recording.name}-{recording.author}.hdf5"


def _robomimic(recording: Recording, env: Any, episodes: Iterable[Episode], out: Path) -> None:
    """The layout of robomimic 0.3: data/demo_i with actions, rewards, dones, obs and next_obs.

    The filter key "success" leaves those that succeeded.
    """
    import h5py

    about = {
        "env_name": recording.environment, "env_version": hurcules.__version__, "type": GYM_TYPE,
        "env_kwargs": dict(recording.options),
    }  # fmt: skip
    whole = BytesIO()  # HDF5 does not let go of a file on a full disk
    with h5py.File(whole, "w") as file:
        data = file.create_group("data")
        data.attrs["env_args"] = json.dumps(about)
        total, succeeded = 0, []
        for i, one in enumerate(episodes):
            demo = data.create_group(f"demo_{i}")
            demo.attrs["num_samples"], demo.attrs["seed"] = len(one.actions), one.seed
            demo.attrs["success"] = one.success
            succeeded += [f"demo_{i}"] * one.success
            demo.create_dataset("actions", data=one.actions)
            demo.create_dataset("rewards", data=one.rewards)
            demo.create_dataset("dones", data=one.done.astype(int))
            for name, values in one.observations.items():
                packed: dict[str, Any] = {}
                if _is_picture(values):  # each is read alone
                    packed = {"compression": "gzip", "chunks": (1, *values.shape[1:])}
                demo.create_dataset(f"obs/{name}", data=values[:-1], **packed)
                demo.create_dataset(f"next_obs/{name}", data=values[1:], **packed)
            total += len(one.actions)
        data.attrs["total"] = total
        file["mask/success"] = np.array(succeeded, dtype="S")
    out.mkdir()
    (out / _robomimic_place(recording)).write_bytes(whole.getbuffer())


# what a goal environment's parts are called; of others the state is all there is
_LEROBOT_KEYS = {
    "flat": "observation.state",
    "observation": "observation.state",
    "achieved_goal": "observation.achieved_goal",
    "desired_goal": "observation.environment_state",
}


def _lerobot_key(name: str) -> str:
    return _LEROBOT_KEYS.get(name, f"observation.images.{name}")


def _is_picture(values: NDArray[Any]) -> bool:
    return values.dtype == np.uint8


def _lerobot_place(recording: Recording) -> str:
    return f"{recording.name}-{recording.author}-lerobot"


def _lerobot(recording: Recording, env: Any, episodes: Iterable[Episode], out: Path) -> None:
    """State, pictures, action and task text. meta/hurcules.json says what replays an episode.

    A frame is what was seen, what was done then, and what came of it (`next.`).
    """
    import datasets
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    datasets.disable_progress_bars()
    root, dataset = out / _lerobot_place(recording), None
    out.mkdir()
    seeds = []
    for one in episodes:
        if dataset is None:
            dataset = LeRobotDataset.create(
                f"hurcules/{root.name}",
                fps=env.metadata["render_fps"],
                features=_features(one, env.unwrapped),
                root=root,
                robot_type=_robot_type(recording, env.unwrapped.model),
                use_videos=False,
            )
        for k in range(len(one.actions)):
            frame = {_lerobot_key(name): seen[k] for name, seen in one.observations.items()}
            frame["action"] = one.actions[k]
            frame["next.reward"] = one.rewards[k : k + 1].astype(np.float32)
            frame["next.done"] = one.done[k : k + 1]
            frame["next.success"] = one.infos["is_success"][k + 1 : k + 2].astype(bool)
            dataset.add_frame(frame | {"task": env.unwrapped.task_description})
        for name in ("next.reward", "next.done", "next.success"):
            # numbers: from numpy 2.4 on, LeRobot 0.4.4 makes none of arrays of one
            dataset.episode_buffer[name] = np.ravel(dataset.episode_buffer[name])
        dataset.save_episode()
        seeds.append(one.seed)
    if dataset is None:
        return
    dataset.finalize()
    about = {
        "environment": recording.environment, "options": dict(recording.options),
        "author": recording.author, "seeds": seeds, "version": hurcules.__version__,
    }  # fmt: skip
    (root / "meta" / "hurcules.json").write_text(json.dumps(about, indent=1) + "\n")


def _robot_type(recording: Recording, model: mujoco.MjModel) -> str | None:
    """The robot that was asked for, else that of the package whose bodies are there."""
    if "robot" in recording.options:
        return str(recording.options["robot"])
    there = {model.body(i).name for i in range(model.nbody)}
    for name in hurcules.models.names():
        bodies = {body.name for body in hurcules.models.make(name).bodies}
        if {body for body in bodies if "bed" not in body} <= there:  # it may be without its bed
            return name
    return None


def _features(episode: Episode, env: Any) -> dict[str, dict[str, Any]]:
    """The columns of a data set of LeRobot."""
    numbers = env.observation_names
    columns: dict[str, dict[str, Any]] = {}
    for name, values in episode.observations.items():
        picture = _is_picture(values)
        columns[_lerobot_key(name)] = {
            "dtype": "image" if picture else "float32",
            "shape": values.shape[1:],
            "names": ["height", "width", "channels"] if picture else None,
        }
        if name in ("flat", "observation") and values.shape[1:] == (len(numbers),):
            columns[_lerobot_key(name)]["names"] = numbers
    shape = episode.actions.shape[1:]
    columns["action"] = {"dtype": "float32", "shape": shape, "names": list(env.action_names)}
    for name, kind in (("reward", "float32"), ("done", "bool"), ("success", "bool")):
        columns[f"next.{name}"] = {"dtype": kind, "shape": (1,), "names": None}
    return columns


FORMATS = {
    "minari": Format(("minari", "'hurcules[data]'"), _minari_place, _minari, path_is_id=False),
    "robomimic": Format(("h5py", "h5py"), _robomimic_place, _robomimic),
    "lerobot": Format(("lerobot", "'lerobot>=0.4'"), _lerobot_place, _lerobot),
}
