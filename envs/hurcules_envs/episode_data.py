"""What is recorded, and one episode of it as arrays in a file."""

from __future__ import annotations

import zipfile
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

import hurcules

__all__ = ["Episode", "Recording"]


@dataclass(frozen=True)
class Recording:
    """What is recorded.

    Attributes:
        environment: id.
        episodes: how many; successful or not, the data say which.
        seed: of the first episode, the others follow.
        author: who acts: "expert" or "policy".
        source: which policy; one that was stopped goes on with the same one only.
        options: of the environment.
    """

    environment: str
    episodes: int
    seed: int = 0
    author: str = "expert"
    source: str = ""
    options: Mapping[str, Any] = field(default_factory=dict)

    @property
    def name(self) -> str:
        """Of the environment, "Reach-v0"."""
        return self.environment.split("/")[-1]


@dataclass(frozen=True)
class Episode:
    """One episode of t steps.

    Attributes:
        seed: reset with it, the actions alone give the same episode, bit for bit.
        observations: by name (t + 1, m), pictures (t + 1, height, width, 3) of uint8; one that has
            no name is called "flat".
        actions: (t, k) in [-1, 1].
        rewards: (t,).
        terminated: (t,).
        truncated: (t,).
        infos: by name (t + 1,).
    """

    seed: int
    observations: dict[str, NDArray[Any]]
    actions: NDArray[np.float32]
    rewards: NDArray[np.float64]
    terminated: NDArray[np.bool_]
    truncated: NDArray[np.bool_]
    infos: dict[str, NDArray[Any]]

    @property
    def success(self) -> bool:
        """Whether it had what was wanted at its end."""
        return bool(self.infos["is_success"][-1])

    @property
    def done(self) -> NDArray[np.bool_]:
        """(t,) whether it was over."""
        return self.terminated | self.truncated

    def save(self, path: Path) -> None:
        """Writes it, whole or not at all."""
        arrays = {name: getattr(self, name) for name in _ARRAYS} | {"seed": np.array(self.seed)}
        arrays |= {f"observations/{name}": values for name, values in self.observations.items()}
        arrays |= {f"infos/{name}": values for name, values in self.infos.items()}
        beside = path.with_suffix(".new")
        with beside.open("wb") as file:
            np.savez(file, **arrays)
        beside.replace(path)

    @staticmethod
    def load(path: Path) -> Episode:
        """Reads what `save` wrote.

        Raises:
            hurcules.Error: it is no such file.
        """
        try:
            with np.load(path, allow_pickle=False) as file:
                arrays = dict(file)
            given: dict[str, Any] = {"observations": {}, "infos": {}, "seed": int(arrays["seed"])}
            for key in [key for key in arrays if "/" in key]:
                group, _, name = key.partition("/")
                given[group][name] = arrays[key]
            return Episode(**given, **{name: arrays[name] for name in _ARRAYS})
        except (ValueError, KeyError, TypeError, EOFError, zipfile.BadZipFile) as error:
            raise hurcules.Error(f"{path}: no episode ({error}); delete it") from error


_ARRAYS = ("actions", "rewards", "terminated", "truncated")
