"""Native vectors of environments for Stable-Baselines3, which does not take Gymnasium's."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode
from numpy.typing import NDArray

import hurcules
from hurcules import extras
from hurcules_envs.registry import full_id, native_options, spec_of, steps_of_episode
from hurcules_envs.vector import NativeVectorEnv

with extras.importing(extras.remedy("train")):
    import torch
    from stable_baselines3.common.torch_layers import BaseFeaturesExtractor
    from stable_baselines3.common.vec_env import VecEnv

__all__ = ["GoalFeatures", "Sb3VecEnv", "Standardised", "make_sb3"]


SCALE = 3.0  # of the way to a goal, beside velocities and angles
PARTS = ("observation", "way")
LEAST = 1e-3  # standard deviation of a number that does not change


class Sb3VecEnv(VecEnv):
    """A `NativeVectorEnv` in mode SAME_STEP as a VecEnv of Stable-Baselines3.

    The info of an episode is whole in its last step; before that it holds `is_success` and `cost`,
    and in goal environments what `compute_reward` takes (`HerReplayBuffer(copy_info_dict=True)`).
    """

    def __init__(self, environment: NativeVectorEnv) -> None:
        if environment.autoreset_mode != AutoresetMode.SAME_STEP:
            raise ValueError(f"wanted autoreset mode SAME_STEP, got {environment.autoreset_mode}")
        self.environment = environment
        self.render_mode = environment.render_mode
        self._seeds: list[int] | None = None
        self._names: list[str] = []  # of what stands in each info
        self._returns = np.zeros(environment.num_envs)
        self._lengths = np.zeros(environment.num_envs, dtype=int)
        super().__init__(
            environment.num_envs,
            environment.single_observation_space,
            environment.single_action_space,
        )

    def reset(self) -> Any:
        """Starts all episodes; what `set_options` was given holds from then on.

        Raises:
            hurcules.Error: options that differ between the episodes: ranges do that.
        """
        options = self._options[0] if self._options else {}
        if any(other != options for other in self._options):
            raise hurcules.Error("set_options: wanted the same options for all episodes")
        observation, info = self.environment.reset(seed=self._seeds, options=options)
        self._names = ["is_success", "cost"]
        if self.environment.environment.goal:
            self._names += [name for name in info if name.startswith("reward_")]
            self._names += self.environment.environment.tell(self.environment.numbers)
        self.reset_infos = [self._one(info, i) for i in range(self.num_envs)]
        self._seeds = None
        self._reset_options()
        self._returns[:], self._lengths[:] = 0.0, 0
        return observation

    def seed(self, seed: int | None = None) -> list[int | None]:
        """Episode i gets seed + i at the next reset."""
        if seed is None:
            return [None] * self.num_envs
        self._seeds = [seed + i for i in range(self.num_envs)]
        return list(self._seeds)

    def step_async(self, actions: NDArray[Any]) -> None:
        """Keeps the actions for `step_wait`."""
        self._actions = actions

    def step_wait(self) -> Any:
        """Takes the step; ended episodes are reset, their last observation stands in their info."""
        observation, reward, terminated, truncated, info = self.environment.step(self._actions)
        done = terminated | truncated
        self._returns += reward
        self._lengths += 1
        rows = zip(*(info[name].tolist() for name in self._names), strict=True)
        infos: list[dict[str, Any]] = [dict(zip(self._names, row, strict=True)) for row in rows]
        for i in np.flatnonzero(done):
            infos[i] = self._one(info["final_info"], int(i)) | {
                "terminal_observation": info["final_obs"][i],
                "TimeLimit.truncated": bool(truncated[i] and not terminated[i]),
                "episode": {"r": float(self._returns[i]), "l": int(self._lengths[i]), "t": 0.0},
            }
        self._returns[done], self._lengths[done] = 0.0, 0
        return observation, reward.astype(np.float32), done, infos

    def get_images(self) -> Sequence[NDArray[np.uint8] | None]:
        """A picture of each episode in render mode "rgb_array"; `render` tiles them."""
        return self.environment.render() or [None] * self.num_envs

    def close(self) -> None:
        """Closes the environment."""
        self.environment.close()

    def get_attr(self, attr_name: str, indices: Any = None) -> list[Any]:
        """An attribute of the vector, once for each episode asked for."""
        return [getattr(self.environment, attr_name) for _ in self._get_indices(indices)]

    def set_attr(self, attr_name: str, value: Any, indices: Any = None) -> None:
        """Sets an attribute of the vector; a range (`friction`) from the next episodes on.

        Raises:
            hurcules.Error: there is no such attribute, or some of the episodes only were meant.
        """
        if len(list(self._get_indices(indices))) < self.num_envs:
            raise hurcules.Error("set_attr: wanted all episodes: an attribute is the vector's")
        if not hasattr(self.environment, attr_name):
            raise hurcules.Error(f"set_attr: the vector has no attribute '{attr_name}'")
        setattr(self.environment, attr_name, value)

    def env_method(self, method_name: str, *args: Any, indices: Any = None, **kwargs: Any) -> Any:
        """Calls a method of the vector once; `compute_reward` with all rows."""
        if method_name == "compute_reward":
            return [self.environment.compute_reward(*args, **kwargs)]
        result = getattr(self.environment, method_name)(*args, **kwargs)
        return [result for _ in self._get_indices(indices)]

    def env_is_wrapped(self, wrapper_class: Any, indices: Any = None) -> list[bool]:
        """Whether it is wrapped: `Monitor` is built in, others are not there."""
        return [wrapper_class.__name__ == "Monitor" for _ in self._get_indices(indices)]

    @staticmethod
    def _one(info: dict[str, Any], i: int) -> dict[str, Any]:
        return {n: v[i].item() for n, v in info.items() if not n.startswith("_")}


class GoalFeatures(BaseFeaturesExtractor):
    """What a network sees of a goal environment: the observation, and how far the goal is.

    Networks learn from differences at once what they learn from two places late.

    Args:
        observation_space: of the environment.
        parts: "observation", "way" or both. Without the observation, what is learnt holds at other
            places, and for other robots; without the way where the observation has the goal.
        factors: (m,) of the numbers of the observation, 0 for what is not seen; None: all as it is.
    """

    def __init__(
        self,
        observation_space: gymnasium.spaces.Dict,
        parts: Sequence[str] = PARTS,
        factors: Sequence[float] | None = None,
    ) -> None:
        sizes = {name: (space.shape or (0,))[0] for name, space in observation_space.items()}
        widths = {"observation": sizes["observation"], "way": sizes["achieved_goal"]}
        super().__init__(observation_space, sum(widths[part] for part in parts))
        self.parts = tuple(parts)
        self.factors = None if factors is None else torch.tensor(factors, dtype=torch.float32)

    def forward(self, observations: dict[str, torch.Tensor]) -> torch.Tensor:
        """(n, features)."""
        way = SCALE * (observations["desired_goal"] - observations["achieved_goal"])
        observation = observations["observation"]
        if self.factors is not None:
            observation = self.factors * observation
        seen = {"observation": observation, "way": way}
        return torch.cat([seen[part] for part in self.parts], dim=1)


class Standardised(BaseFeaturesExtractor):
    """An observation less its mean, over its standard deviation; both are part of the network.

    Lengths of millimetres and forces of hundreds of newtons become alike: as they are, a network
    does not see the former and drowns in the latter.
    """

    def __init__(self, observation_space: gymnasium.spaces.Box) -> None:
        size = observation_space.shape[0]
        super().__init__(observation_space, size)
        self.register_buffer("count", torch.zeros(()))
        self.register_buffer("mean", torch.zeros(size))
        self.register_buffer("scale", torch.ones(size))

    def update(self, observations: np.ndarray) -> None:
        """Takes observations (m, o) into account, as much as those before."""
        seen = torch.as_tensor(observations, dtype=torch.float32)
        share = len(seen) / (self.count + len(seen))
        mean = (1.0 - share) * self.mean + share * seen.mean(dim=0)
        squares = (1.0 - share) * ((self.scale - LEAST) ** 2 + (self.mean - mean) ** 2)
        squares += share * ((seen - mean) ** 2).mean(dim=0)
        self.scale.copy_(torch.sqrt(squares) + LEAST)
        self.mean.copy_(mean)
        self.count += len(seen)

    def forward(self, observations: torch.Tensor) -> torch.Tensor:
        """(n, o)."""
        return (observations - self.mean) / self.scale


def make_sb3(
    name: str, num_envs: int, threads: int = 0, max_episode_steps: int | None = None, **options: Any
) -> Sb3VecEnv:
    """Makes a vector of environments for Stable-Baselines3.

    Args:
        name: id, "Reach-v0" say, or of one's own, "module:Own/Circle-v0".
        num_envs: how many episodes side by side.
        threads: 0 for one a processor.
        max_episode_steps: None: that of the environment, in proportion to `rate`.
        options: of the environment, by keyword; `cameras` and `camera_size` too.

    Raises:
        hurcules.Error: an environment without native vector, or an unknown option.
    """
    name = full_id(name)
    given = native_options(name, options)
    limit = max_episode_steps or steps_of_episode(name, options)
    vector = NativeVectorEnv(
        num_envs=num_envs,
        max_episode_steps=limit,
        threads=threads,
        autoreset_mode=AutoresetMode.SAME_STEP,
        **given,
    )
    vector.spec = spec_of(name)
    return Sb3VecEnv(vector)
