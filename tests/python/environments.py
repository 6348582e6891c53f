"""Shared by the tests of the environments: one of each, and how runs are compared."""

import pickle
from collections.abc import Iterator
from typing import Any

import gymnasium
import numpy as np
import pytest

from hurcules_envs.base import HurculesEnv

IDS = ["hurcules_envs:Hurcules/Stretch-v0"]  # the others stand on `Environment`: test_env_core.py


@pytest.fixture(params=IDS)
def env(request: pytest.FixtureRequest) -> Iterator[HurculesEnv]:
    """Each environment, unwrapped."""
    made = gymnasium.make(request.param, disable_env_checker=True)
    unwrapped = made.unwrapped
    assert isinstance(unwrapped, HurculesEnv)
    yield unwrapped
    made.close()


def rollout(env: HurculesEnv, seed: int, steps: int) -> list[Any]:
    """What reset and random steps return."""
    actions = np.random.default_rng(seed).uniform(-1, 1, (steps, *env.action_space.shape))
    taken: list[Any] = [env.reset(seed=seed)]
    return taken + [env.step(action.astype(np.float32)) for action in actions]


def same(a: Any, b: Any) -> bool:
    """Whether two results are equal to the last bit."""
    return bool(pickle.dumps(a) == pickle.dumps(b))
