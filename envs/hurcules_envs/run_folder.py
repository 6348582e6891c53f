"""The folder of a training: which run it holds, so that another never takes its place."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import hurcules
from hurcules.output import Output, differing, write_whole

__all__ = ["ALGORITHMS", "open_run", "write_settings"]

ALGORITHMS = ("ppo", "sac", "her")
FREE = ("steps", "out")  # may be others where a run goes on
CHECKPOINTS = ("checkpoint.zip", "rllib")  # of Stable-Baselines3, of RLlib


def open_run(out: Path, settings: Mapping[str, Any]) -> None:
    """Makes the folder; refuses one in which a run of other settings was begun.

    Args:
        out: the folder.
        settings: of the run, as JSON has them; those of FREE may differ from the earlier run's.

    Raises:
        hurcules.Error: the folder holds another run, or one whose settings are broken, or cannot be
            made or written.
    """
    Output(out, ())
    written = out / "settings.json"
    if not written.exists() or not any((out / name).exists() for name in CHECKPOINTS):
        return  # nothing is lost
    try:
        earlier = json.loads(written.read_text())
    except ValueError as error:
        raise hurcules.Error(f"{written} is broken: give another folder ({error})") from error
    wanted = {
        key: settings.get(key) for key in dict.fromkeys([*settings, *earlier]) if key not in FREE
    }
    if others := differing(earlier, wanted):
        raise hurcules.Error(f"{out} holds another run: {', '.join(others)}; give another folder")


def write_settings(out: Path, settings: Mapping[str, Any]) -> None:
    """Writes settings.json."""
    write_whole(out / "settings.json", (json.dumps(settings, indent=2) + "\n").encode())
