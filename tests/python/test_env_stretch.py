"""Stretch-v1: its tables, its ends, and that neither one command nor chance solves it.

Bits, states and resets are those of all environments: test_env_core.py, test_env_contact.py.
"""

import warnings
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray

import hurcules_envs  # noqa: F401  registers
from environments import assert_tables_are_true
from hurcules_envs.single import SingleEnv

NAME = "Hurcules/Stretch-v1"


def single(fidelity: str = "kinematic", **options: Any) -> SingleEnv:
    env = gym.make(NAME, fidelity=fidelity, **options).unwrapped
    assert isinstance(env, SingleEnv)
    return env


def run(env: SingleEnv, action: Any) -> dict[str, Any]:
    """An episode under a constant action, None for the expert; its last info."""
    for _ in range(300):
        expert = env.environment.expert(env.numbers)[0] if action is None else action
        _, reward, terminated, _, info = env.step(np.asarray(expert, np.float32))
        terms = [info[f"reward_{term}"] for term in env.environment.terms]
        assert reward == pytest.approx(sum(terms), rel=1e-12, abs=1e-15)
        if terminated:
            break
    return info


def ahead(share: float) -> NDArray[np.float64]:
    action = np.zeros(11)
    action[[0, 3]] = share
    return action


@pytest.mark.parametrize("fidelity", ["kinematic", "fast"])
def test_gymnasiums_checker_has_nothing_to_say(fidelity: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(gym.make(NAME, fidelity=fidelity).unwrapped, skip_render_check=True)


def test_nor_has_that_of_stable_baselines3() -> None:
    checker = pytest.importorskip(
        "stable_baselines3.common.env_checker", reason="pip install 'hurcules[train]'"
    )
    env = single(observation_noise=0.01, action_delay=(0, 2))
    checker.check_env(env, skip_render_check=True)


def test_the_tables_in_the_text_are_true() -> None:
    assert_tables_are_true(single(), texts=True)


@pytest.mark.parametrize("fidelity", ["kinematic", "fast"])
def test_the_expert_succeeds(fidelity: str) -> None:
    env = single(fidelity)
    for seed in range(4):
        _, info = env.reset(seed=seed)
        info = run(env, None)
        assert (info["is_success"], info["missed"], info["fell"]) == (True, 0.0, 0.0)
        assert info["reward_success"] == 10.0
        assert info["limit_excess"] < 2e-3  # [rad]
        assert info["self_contacts"] == 0


@pytest.mark.parametrize("share", [1.0, 0.6, 0.3])
def test_who_only_drives_ahead_does_not_succeed(share: float) -> None:
    env = single()
    missed = 0.0
    for seed in range(4):
        env.reset(seed=seed)
        info = run(env, ahead(share))
        assert not info["is_success"]
        assert info["fell"] == 0.0  # nothing fell
        missed += info["missed"]
    if share > 0.5:
        assert missed >= 3


def test_a_fall_is_told_from_a_miss() -> None:
    env = single("fast")
    env.reset(seed=0, options={"push": 1e4, "friction": 2.0})
    info = run(env, np.zeros(11))
    assert (info["fell"], info["missed"], info["is_success"]) == (1.0, 0.0, False)
    assert (info["reward_fall"], info["reward_missed"]) == (-10.0, 0.0)


def test_goals_person_and_start_differ() -> None:
    env = single()
    found = []
    for seed in range(6):
        _, info = env.reset(seed=seed)
        goal = env._episodes.memory["goal"][0]
        found.append([info["person_x"], info["person_y"], info["person_yaw"], *goal, *env.qpos[7:]])
    spread = np.std(found, axis=0)
    assert (spread[:9] > 0.02).all()
    assert (spread[9:] > 5e-3).sum() >= 9  # joints of legs, trunk and arms


def test_the_person_stands_where_the_model_of_the_episode_says() -> None:
    env = single("fast")
    _, info = env.reset(seed=2)
    chest = env.numbers["position/casualty_chest"][0]
    off = chest[:2] - [info["person_x"], info["person_y"]]
    # the chest lies 0.40 m from the pelvis towards the head, to the left
    turned = [-np.sin(info["person_yaw"]), np.cos(info["person_yaw"])]
    assert off @ turned == pytest.approx(0.40, abs=0.02)
