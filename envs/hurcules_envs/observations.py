"""The observation of all environments: groups of numbers with unit and bounds."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from gymnasium import spaces

__all__ = ["GROUPS", "Group", "observation_space"]


class Group(NamedTuple):
    """What the names with one prefix have in common."""

    unit: str
    bound: float  # largest magnitude; what is beyond is cut off
    least: float | None = None  # smallest value, where it is not -bound


# by the part of a name before the first "/"; bounds lie well outside what a standing robot does
GROUPS = {
    "q": Group("rad", 4.0),
    "qd": Group("rad/s", 10.0),
    "lag": Group("rad", 2.0),
    "to_lower": Group("rad", 8.0),
    "to_upper": Group("rad", 8.0),
    "task_error": Group("m or rad", 5.0),
    "active_rows": Group("1", 64.0, 0.0),
    "base": Group("m", 100.0),
    "base_rotation": Group("rad", 3.2),
    "base_velocity": Group("m/s", 20.0),
    "base_spin": Group("rad/s", 20.0),
    "target_in_base": Group("m", 100.0),
}


def observation_space(names: Sequence[str]) -> spaces.Box[np.float32]:
    """The box of observations with these names, float32."""
    groups = [GROUPS[name.split("/")[0]] for name in names]
    high = np.array([group.bound for group in groups], dtype=np.float32)
    low = np.array([-g.bound if g.least is None else g.least for g in groups], dtype=np.float32)
    return spaces.Box(low, high, dtype=np.float32)
