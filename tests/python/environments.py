"""Shared by the tests of the environments: one of each, and how runs are compared."""

import pickle
from collections.abc import Iterator
from typing import Any

import gymnasium
import numpy as np
import pytest
from numpy.typing import NDArray

from hurcules_envs.base import HurculesEnv
from hurcules_envs.single import SingleEnv

IDS = ["hurcules_envs:Hurcules/Stretch-v0"]  # the others stand on `Environment`: test_env_core.py


@pytest.fixture(params=IDS)
def env(request: pytest.FixtureRequest) -> Iterator[HurculesEnv]:
    """Each environment, unwrapped."""
    made = gymnasium.make(request.param, disable_env_checker=True)
    unwrapped = made.unwrapped
    assert isinstance(unwrapped, HurculesEnv)
    yield unwrapped
    made.close()


def single(name: str, **options: Any) -> SingleEnv:
    """One of those that stand on `Environment`, unwrapped, in "fast"."""
    env = gymnasium.make(name, fidelity="fast", **options).unwrapped
    assert isinstance(env, SingleEnv)
    return env


def action_of(env: SingleEnv, **given: float) -> NDArray[np.float32]:
    """An action by the names of its numbers; the others are 0."""
    unknown = set(given) - set(env.action_names)
    assert not unknown, unknown
    return np.array([given.get(name, 0.0) for name in env.action_names], np.float32)


def rollout(env: HurculesEnv, seed: int, steps: int) -> list[Any]:
    """What reset and random steps return."""
    actions = np.random.default_rng(seed).uniform(-1, 1, (steps, *env.action_space.shape))
    taken: list[Any] = [env.reset(seed=seed)]
    return taken + [env.step(action.astype(np.float32)) for action in actions]


def same(a: Any, b: Any) -> bool:
    """Whether two results are equal to the last bit."""
    return bool(pickle.dumps(a) == pickle.dumps(b))


def rows(text: str) -> list[list[list[str]]]:
    """The tables of a docstring, without their headings."""
    tables: list[list[list[str]]] = []
    inside = False
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.strip().startswith("|"):
            inside = False
        elif not inside:
            inside = True
            tables.append([])
        elif not set(cells[0]) <= {"-"}:
            tables[-1].append(cells)
    return tables


def assert_tables_are_true(env: SingleEnv, *, texts: bool = False) -> None:
    """The tables in the text of an environment tell its actions, observation and reward.

    Args:
        env: of which.
        texts: the last column says what the groups of the observation say.
    """
    actions, observations, reward = rows(type(env.environment).__doc__ or "")
    assert [row[1] for row in actions] == env.action_names
    assert [float(row[2]) for row in actions] == env.action_scale.tolist()
    assert [row[3] for row in actions] == env.action_units
    place = 0
    for row, group in zip(observations, env.environment.observation, strict=True):
        first, _, last = row[0].partition("-")
        assert (int(first), int(last or first) + 1) == (place, place + group.size)
        assert (row[1], float(row[2]), row[3]) == (group.name, group.bound, group.unit)
        assert not texts or row[4] == group.text
        place += group.size
    assert env.observation_space.shape == (place,)
    assert [row[0] for row in reward] == list(env.environment.terms)
