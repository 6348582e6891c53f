"""Gymnasium environments of Hurcules; importing this package registers them.

`gymnasium.make("hurcules_envs:Hurcules/Stretch-v0")` imports it by itself.
"""

from gymnasium.envs.registration import register

import hurcules  # noqa: F401  # first of all: it chooses MuJoCo's OpenGL
from hurcules_envs.registry import register as register_environment

# id: (entry point as text, so that a spec can be stored; steps of 20 ms)
_STEPS = {"Hurcules/Stretch-v0": ("hurcules_envs.stretch:StretchEnv", 3000)}

ENVIRONMENTS = tuple(_STEPS)

__all__ = ["ENVIRONMENTS"]

register_environment("Hurcules/Reach-v0", "hurcules_envs.reach:Reach", 100)

for _id, (_entry_point, _most) in _STEPS.items():
    register(id=_id, entry_point=_entry_point, max_episode_steps=_most)
