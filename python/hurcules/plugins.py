"""What other packages add to the command line, by the entry points that they declare.

| group | an entry is |
|---|---|
| `hurcules.commands` | a function: a command of its own, as `hurcules reproduce` |
| `hurcules.methods` | a `Methods`: more that `hurcules run` can run, as `hurcules run e2803` |
| `hurcules.policies` | a function that runs an episode of a policy, as `hurcules run --policy` |
| `hurcules.environments` | names of gymnasium environments of the entry's package |
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from importlib.metadata import entry_points
from pathlib import Path
from typing import Any, Protocol

from rich.console import Console

__all__ = [
    "MethodOptions", "Methods", "PolicyOptions", "commands", "environments", "method_groups",
    "policy_runner",
]  # fmt: skip


@dataclass(frozen=True)
class MethodOptions:
    """What `hurcules run METHOD` was asked for."""

    method: str
    words: tuple[str, ...] = ()  # --PARAMETER VALUE ...
    robot: str = "rescue"
    repetitions: int = 10
    seed: int = 0
    speed: float | None = None  # [m/s]
    workers: int = 1
    out: Path | None = None  # out/METHOD, where the last run lies
    video: bool = True


@dataclass(frozen=True)
class PolicyOptions:
    """What `hurcules run --policy` was asked for."""

    policy: str  # file, folder or name
    environment: str | None = None  # that of the policy
    fidelity: str = "exact"
    robot: str | None = None  # that of the policy
    frames: Sequence[str] = ()  # of its hands, where it is a file
    seed: int = 0
    out: Path | None = None
    video: bool = True
    settings: Sequence[str] = ()  # NAME=VALUE, other options of the environment
    replaces: bool = False  # an earlier run of whatever kind; without `out` any run does


class Methods(Protocol):
    """Test methods that `hurcules run` knows beside the missions."""

    @property
    def kind(self) -> str:
        """What they are called in `hurcules list`."""

    def titles(self) -> Mapping[str, str]:
        """The names, each with a title."""

    def run(self, options: MethodOptions, console: Console) -> int:
        """Runs one of them and returns the exit code."""


def commands() -> dict[str, Callable[..., Any]]:
    """The functions that become commands, by name."""
    return {name: function for name, _, function in _entries("hurcules.commands")}


def method_groups() -> list[Methods]:
    """Everything that knows test methods."""
    return [methods for _, _, methods in _entries("hurcules.methods")]


def policy_runner() -> Callable[[PolicyOptions, Console], int] | None:
    """What runs an episode of a policy and returns the exit code; None: nothing does."""
    return next((run for _, _, run in _entries("hurcules.policies")), None)


def environments() -> list[str]:
    """The environments as `gymnasium.make` wants them, "PACKAGE:NAME"."""
    return [
        f"{package}:{name}"
        for _, package, names in _entries("hurcules.environments")
        for name in names
    ]


def _entries(group: str) -> Iterator[tuple[str, str, Any]]:
    """Name, module and object of each entry; warns of one that cannot be loaded, and goes on."""
    for entry in sorted(entry_points(group=group)):
        try:
            yield entry.name, entry.module, entry.load()
        except Exception as error:
            text = f"{entry.value} ({group}) cannot be loaded: {type(error).__name__}: {error}"
            print(f"hurcules: warning: {text}", file=sys.stderr)
