"""What an episode does follows from its seed and its actions, whatever was before it.

Strategy: actions that jump between their ends, where distances and balance rule. The rewards after
a reset with a seed are those after another episode; after `set_state` those after the state was
taken. Of every environment the observation after `set_state` is the one that there was.
Not tested: other processes and threads (test_env_core.py).
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np
import pytest
from numpy.typing import NDArray

from hurcules_envs import ENVIRONMENTS
from hurcules_envs.registry import fidelities_of

CASES = [
    ("Reach-v0", "kinematic"),
    ("ReachPrecise-v0", "kinematic"),
    ("ReachPrecise-v0", "fast"),
    ("ReachJoint-v0", "kinematic"),
    ("Drive-v0", "kinematic"),
    ("Stretch-v1", "fast"),
    ("Door-v0", "fast"),
    ("Dispose-v0", "fast"),
]
STEPS, HOLD = 60, 10
TOUCHED = 50  # steps after which experts touch what they go for


def rewards(env: gymnasium.Env, actions: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.array([env.step(action)[1] for action in actions])


@pytest.mark.parametrize(("name", "fidelity"), CASES)
def test_seed_and_actions_decide(name: str, fidelity: str) -> None:
    env = gymnasium.make(f"Hurcules/{name}", fidelity=fidelity, max_episode_steps=10 * STEPS)
    size = env.action_space.shape[0]
    drawn = np.random.default_rng(0).choice([-1.0, 1.0], (STEPS // HOLD, size)).repeat(HOLD, 0)
    first, _ = env.reset(seed=7)
    once = rewards(env, drawn)
    env.reset(seed=3)
    rewards(env, -drawn[: STEPS // 2])
    again, _ = env.reset(seed=7)
    assert np.array_equal(gymnasium.spaces.flatten(env.observation_space, first),
                          gymnasium.spaces.flatten(env.observation_space, again))  # fmt: skip
    assert np.array_equal(rewards(env, drawn), once)

    env.reset(seed=7)
    half = rewards(env, drawn[: STEPS // 2])
    state = env.unwrapped.get_state()
    rest = rewards(env, drawn[STEPS // 2 :])
    assert np.array_equal(np.concatenate((half, rest)), once)
    env.unwrapped.set_state(state)
    assert np.array_equal(env.unwrapped.get_state(), state)
    assert np.array_equal(rewards(env, drawn[STEPS // 2 :]), rest)
    env.close()


@pytest.mark.parametrize("name", ENVIRONMENTS)
def test_after_a_state_the_observation_is_the_one_that_was(name: str) -> None:
    known = fidelities_of(name)
    options = {"fidelity": known[-1]} if known else {}
    env = gymnasium.make(name, disable_env_checker=True, **options).unwrapped
    env.reset(seed=3)
    random = np.random.default_rng(0).uniform(-1.0, 1.0, (TOUCHED, env.action_space.shape[0]))
    guided = known and "Joint" not in name and "Precise" not in name
    for action in random:
        given = env.environment.expert(env.numbers)[0] if guided else action
        seen, _, over, _, _ = env.step(given)
        if over:
            break
    state = env.get_state()
    env.reset(seed=4)
    for action in random[:5]:
        env.step(action)
    env.set_state(state)
    for one, other in zip(*map(parts, (seen, env.observe())), strict=True):
        assert np.array_equal(one, other)
    env.close()


def parts(observation: Any) -> list[NDArray[np.float32]]:
    return [*observation.values()] if isinstance(observation, dict) else [observation]
