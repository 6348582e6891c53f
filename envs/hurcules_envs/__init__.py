"""Gymnasium environments of Hurcules; importing this package registers them.

`gymnasium.make("hurcules_envs:Hurcules/Stretch-v0")` imports it by itself.
"""

import gymnasium

import hurcules  # noqa: F401  # first of all: it chooses MuJoCo's OpenGL
from hurcules_envs.endings import Ending
from hurcules_envs.registry import register

# id: (class, steps until an episode is truncated, options)
_ENVIRONMENTS: dict[str, tuple[str, int, dict[str, object]]] = {
    "Hurcules/Reach-v0": ("hurcules_envs.reach:Reach", 100, {}),
    "Hurcules/ReachPrecise-v0": ("hurcules_envs.reach:ReachPrecise", 150, {}),
    "Hurcules/Drive-v0": ("hurcules_envs.drive:Drive", 300, {}),
    "Hurcules/Press-v0": ("hurcules_envs.press:Press", 300, {}),
    "Hurcules/Valve-v0": ("hurcules_envs.valve:Valve", 200, {}),
    "Hurcules/Door-v0": ("hurcules_envs.door:Door", 240, {}),
    "Hurcules/Carry-v0": ("hurcules_envs.carry:Carry", 300, {}),
    "Hurcules/Stretch-v1": ("hurcules_envs.stretch_goal:Stretch", 300, {}),
    "Hurcules/Lift-v0": ("hurcules_envs.lift:Lift", 600, {}),
    "Hurcules/Rescue-v0": ("hurcules_envs.rescue:Rescue", 1600, {}),
    "Hurcules/Casualty-v0": ("hurcules_envs.casualty:Casualty", 5000, {}),
    "Hurcules/Dispose-v0": ("hurcules_envs.dispose:Dispose", 6000, {}),
}

# joints commanded in place of hands and forces, for comparison
for _name in (
    "Reach-v0", "ReachPrecise-v0", "Drive-v0", "Press-v0", "Valve-v0", "Door-v0", "Carry-v0",
    "Stretch-v1", "Lift-v0",
):  # fmt: skip
    _class, _steps, _ = _ENVIRONMENTS[f"Hurcules/{_name}"]
    _twin = _name.replace("-", "Joint-")
    _ENVIRONMENTS[f"Hurcules/{_twin}"] = (_class, _steps, {"action": "joint"})

ENVIRONMENTS = ("Hurcules/Stretch-v0", *_ENVIRONMENTS)

__all__ = ["ENVIRONMENTS", "Ending", "register"]

gymnasium.register(
    id="Hurcules/Stretch-v0",
    entry_point="hurcules_envs.stretch:StretchEnv",
    max_episode_steps=3000,
)
for _id, (_class, _steps, _options) in _ENVIRONMENTS.items():
    register(_id, _class, _steps, **_options)
