"""Why an episode is over: what `info["ending"]` says."""

from __future__ import annotations

import re
from collections.abc import Mapping
from enum import IntEnum
from typing import Any

import numpy as np

import hurcules

__all__ = ["Ending"]


class Ending(IntEnum):
    """The endings of simulations, `hurcules.Ending`, and the limit of steps."""

    Running = 0
    Completed = 1
    Missed = 2
    TimeUp = 3
    Fell = 4
    Diverged = 5
    SolverFailed = 6
    Held = 7
    TimeLimit = 8

    @classmethod
    def of(cls, info: Mapping[str, Any], truncated: bool) -> Ending:
        """Of a step of a single environment, whose limit is a wrapper that `info` knows nothing of.

        Args:
            info: of the step.
            truncated: what the step gave.

        Raises:
            hurcules.Error: `info` has no ending, one that does not exist, or those of a vector.
        """
        given: Any = info.get("ending")
        if np.ndim(given) != 0 or given not in list(cls):
            raise hurcules.Error(
                f"info: wanted 'ending', a number from 0 to {max(cls)}, as a single environment "
                f"gives it, got {given!r}"
            )
        ending = cls(int(given))
        return cls.TimeLimit if truncated and ending == cls.Running else ending

    @property
    def text(self) -> str:
        """Its name in words: "time limit"."""
        return re.sub(r"(?<=[a-z])(?=[A-Z])", " ", self.name).lower()
