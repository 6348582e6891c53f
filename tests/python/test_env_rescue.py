"""Rescue-v0: the mission under a zero action, what actions add, phases that are asked for.

Strategy: bits against the mission alone, and against each other alone, side by side and after a
state; one episode of the expert, in "fast". How often it succeeds: docs/environments.md.
"""

import warnings
from typing import Any

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from numpy.typing import NDArray

import hurcules
import hurcules_envs  # noqa: F401  registers
from environments import assert_tables_are_true
from hurcules_envs.single import SingleEnv

NAME = "Hurcules/Rescue-v0"
ZERO = np.zeros(11, np.float32)


def single(**options: Any) -> SingleEnv:
    env = gym.make(NAME, fidelity="fast", **options).unwrapped
    assert isinstance(env, SingleEnv)
    return env


def action(**given: float) -> NDArray[np.float32]:
    names = [
        "speed", "yaw_rate", "ahead", "left", "up", "pitch", "press", "lean", "shoulders",
        "elbows", "phase",
    ]  # fmt: skip
    return np.array([given.get(name, 0.0) for name in names], np.float32)


def test_gymnasiums_checker_has_nothing_to_say() -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(single(), skip_render_check=True)


def test_nor_has_that_of_stable_baselines3() -> None:
    checker = pytest.importorskip(
        "stable_baselines3.common.env_checker", reason="pip install 'hurcules[train]'"
    )
    checker.check_env(single(mass=(0.9, 1.1), action_delay=(0, 2)), skip_render_check=True)


def test_the_tables_in_the_text_are_true() -> None:
    assert_tables_are_true(single())


def test_a_zero_action_is_the_mission_to_the_bit() -> None:
    environment = single().environment
    model = environment.simulation.model
    plans = [hurcules.lift.controller(model) for _ in range(2)]
    alone, added = (
        hurcules.Simulation(
            hurcules.lift.mission("lift"), model=model, controller=plan, variation=0.0,
            record=False, adds_command=adds,
        )
        for plan, adds in zip(plans, (False, True), strict=True)
    )  # fmt: skip
    zero = np.zeros(len(alone.command_names))
    for _ in range(60):  # into the approach
        alone.step(12)
        added.step(12, zero)
        assert np.array_equal(alone.data.qpos, added.data.qpos)
    assert (alone.phase, added.phase) == ("approach", "approach")


def test_an_action_is_added_to_the_command_of_the_phase() -> None:
    plain, pushed = single(), single()
    for env in (plain, pushed):
        env.reset(seed=1)
    for _ in range(20):  # a second of `settle`, in which the tracks stand
        plain.step(ZERO)
        pushed.step(action(speed=1.0))
    ahead = pushed.qpos[0] - plain.qpos[0]
    assert ahead == pytest.approx(0.1, abs=0.03)  # 0.1 m/s, ramped
    heights = []
    for env, given in ((plain, ZERO), (pushed, action(up=1.0))):
        env.reset(seed=1)
        for _ in range(20):
            env.step(given)
        heights.append(env.numbers["position/L_tcp"][0, 2])
    assert heights[1] - heights[0] == pytest.approx(0.05, abs=0.01)


def test_a_phase_is_asked_for_once_until_the_number_comes_back() -> None:
    env = single()
    _, info = env.reset(seed=0)
    assert info["phase"] == 0.0
    seen = []
    for given in (1.0, 1.0, 0.0, 1.0, -1.0, -1.0):
        *_, info = env.step(action(phase=given))
        seen.append(env.environment.simulation.phases[int(info["phase"])])
    # `turn left` is over at once where nothing is to be turned
    assert seen[0] in ("turn left", "turn right", "approach")
    assert seen[1] in (seen[0], "turn right", "approach")
    assert env.environment.simulation.phases.index(seen[3]) > 1
    assert info["reward_phase"] == 0.0  # who goes back gains nothing


def test_alone_side_by_side_and_after_a_state_the_bits_are_the_same() -> None:
    vector = gym.make_vec(NAME, num_envs=2, threads=2, fidelity="fast")
    alone, other = single(), single()
    seen, info = vector.reset(seed=3)
    first, told = alone.reset(seed=3)
    other.reset(seed=8)
    assert np.array_equal(seen[0], first)
    for key in ("mass", "friction", "ahead", "left", "yaw"):
        assert info[key][0] == told[key] != info[key][1]
    generator = np.random.default_rng(0)
    for step in range(30):
        actions = generator.uniform(-1, 1, (2, 11)).astype(np.float32)
        together, single_step = vector.step(actions), alone.step(actions[0])
        assert np.array_equal(together[0][0], single_step[0])
        if step == 15:
            other.set_state(alone.get_state())
        if step > 15:
            again = other.step(actions[0])
            assert np.array_equal(again[0], single_step[0])
            assert again[1:] == single_step[1:]


@pytest.mark.slow
def test_the_mission_as_it_stands_succeeds_and_the_terms_sum_to_the_reward() -> None:
    env = single()
    env.reset(seed=3)
    furthest, total = 0.0, 0.0
    for _ in range(1600):
        _, reward, terminated, _, info = env.step(env.environment.expert(env.numbers)[0])
        terms = [info[f"reward_{term}"] for term in env.environment.terms]
        assert reward == pytest.approx(sum(terms), rel=1e-12, abs=1e-15)
        assert info["furthest"] >= furthest
        furthest, total = info["furthest"], total + info["reward_phase"]
        if terminated:
            break
    assert (info["is_success"], info["failed"], info["fell"], info["missed"]) == (1, 0, 0, 0)
    assert info["reward_success"] == 10.0
    assert total == pytest.approx(10.0)
    assert 0.0 < info["pushed_m"] < 0.5


def test_a_fall_ends_it_and_is_told() -> None:
    env = single()
    env.reset(seed=0, options={"push": 1e4, "friction": 2.0})
    for _ in range(300):
        *_, terminated, _, info = env.step(ZERO)
        if terminated:
            break
    assert (info["fell"], info["missed"], info["is_success"], info["failed"]) == (1, 0, 0, 1)
    assert info["reward_failure"] == -10.0
