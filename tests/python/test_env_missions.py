"""Rescue-v0, Casualty-v0 and Dispose-v0, missions that are corrected: what they have in common.

Strategy: bits of a zero action against the mission alone, and of episodes against each other alone,
side by side and after a state; phases that are asked for; one whole episode of the expert, in
"fast". How often it succeeds: docs/environments.md.
"""

import copy
import warnings
from collections.abc import Callable
from dataclasses import dataclass

import gymnasium as gym
import mujoco
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import hurcules
import hurcules_envs  # noqa: F401  registers
from environments import action_of, assert_tables_are_true, single
from hurcules import disposal, lift

NAMES = ["Hurcules/Rescue-v0", "Hurcules/Dispose-v0", "Hurcules/Casualty-v0"]


@dataclass(frozen=True)
class Acts:
    """What acts in an environment."""

    mission: Callable[[], hurcules.Mission]
    controller: Callable[[mujoco.MjModel], hurcules.WholeBodyController]


ACTS = {
    NAMES[0]: Acts(lambda: lift.mission("lift"), lift.controller),
    NAMES[1]: Acts(disposal.mission, disposal.controller),
    NAMES[2]: Acts(lambda: lift.mission("casualty"), lift.controller),
}


@pytest.mark.parametrize("name", NAMES)
def test_gymnasiums_checker_has_nothing_to_say(name: str) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(single(name), skip_render_check=True)


@pytest.mark.parametrize("name", NAMES)
def test_nor_has_that_of_stable_baselines3(name: str) -> None:
    checker = pytest.importorskip(
        "stable_baselines3.common.env_checker", reason="pip install 'hurcules[train]'"
    )
    checker.check_env(single(name, mass=(0.9, 1.1), action_delay=(0, 2)), skip_render_check=True)


@pytest.mark.parametrize("name", NAMES)
def test_the_tables_in_the_text_are_true(name: str) -> None:
    assert_tables_are_true(single(name))


@pytest.mark.parametrize("name", NAMES)
def test_a_zero_action_is_the_mission_to_the_bit(name: str) -> None:
    acts, env = ACTS[name], single(name)
    _, info = env.reset(seed=0)
    nominal = env.environment.simulation.model
    model = copy.copy(nominal)
    drawn = {key: np.array([info[key]]) for key in env.environment.parameters}
    env.environment.configure(model, drawn)
    alone = hurcules.Simulation(
        acts.mission(), model=model, controller=acts.controller(nominal), variation=0.0,
        record=False,
    )  # fmt: skip
    alone.reset(start=env.qpos)
    assert np.array_equal(alone.data.qpos, env.qpos)
    for _ in range(60):  # into the approach
        *_, info = env.step(action_of(env))
        alone.step(round(0.05 / alone.dt))
        assert np.array_equal(alone.data.qpos, env.qpos)
    assert info["phase"] == alone.phases.index(alone.phase) > 0


@pytest.mark.parametrize("name", NAMES)
def test_an_action_is_added_to_the_command_of_the_phase(name: str) -> None:
    plain, pushed = single(name), single(name)
    for env in (plain, pushed):
        env.reset(seed=1)
    for _ in range(20):  # a second of `settle`, in which the tracks stand
        plain.step(action_of(plain))
        pushed.step(action_of(pushed, speed=1.0))
    ahead = pushed.qpos[0] - plain.qpos[0]
    assert ahead == pytest.approx(0.1, abs=0.03)  # 0.1 m/s, ramped


@pytest.mark.parametrize("name", NAMES)
def test_a_phase_is_asked_for_once_until_the_number_comes_back(name: str) -> None:
    env = single(name)
    _, info = env.reset(seed=0)
    assert info["phase"] == 0.0
    seen = []
    for given in (1.0, 1.0, 0.0, 1.0, -1.0, -1.0):
        *_, info = env.step(action_of(env, phase=given))
        seen.append(env.environment.simulation.phases[int(info["phase"])])
    # `turn left` is over at once where nothing is to be turned
    assert seen[0] in ("turn left", "turn right", "approach")
    assert seen[1] in (seen[0], "turn right", "approach")
    assert env.environment.simulation.phases.index(seen[3]) > 1
    assert info["reward_phase"] == 0.0  # who goes back gains nothing


@pytest.mark.parametrize("name", NAMES)
def test_alone_side_by_side_and_after_a_state_the_bits_are_the_same(name: str) -> None:
    vector = gym.make_vec(name, num_envs=2, threads=2, fidelity="fast")
    alone, other = single(name), single(name)
    seen, info = vector.reset(seed=3)
    first, told = alone.reset(seed=3)
    other.reset(seed=8)
    assert np.array_equal(seen[0], first)
    for key in ("mass", "friction", "ahead", "left", "yaw"):
        assert info[key][0] == told[key] != info[key][1]
    generator = np.random.default_rng(0)
    for step in range(30):
        actions = generator.uniform(-1, 1, vector.action_space.shape).astype(np.float32)
        together, single_step = vector.step(actions), alone.step(actions[0])
        assert np.array_equal(together[0][0], single_step[0])
        if step == 15:
            other.set_state(alone.get_state())
        if step > 15:
            again = other.step(actions[0])
            assert np.array_equal(again[0], single_step[0])
            assert again[1:] == single_step[1:]


@pytest.mark.slow
@pytest.mark.parametrize("name, steps", [(NAMES[0], 1600), (NAMES[1], 6000), (NAMES[2], 5000)])
def test_the_mission_as_it_stands_succeeds_and_the_terms_sum_to_the_reward(
    name: str, steps: int
) -> None:
    env = single(name)
    env.reset(seed=3)
    furthest, total = 0.0, 0.0
    for _ in range(steps):
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


@pytest.mark.parametrize("name", NAMES)
def test_a_fall_ends_it_and_is_told(name: str) -> None:
    env = single(name)
    env.reset(seed=0, options={"push": 1e4, "friction": 2.0})
    for _ in range(300):
        *_, terminated, _, info = env.step(action_of(env))
        if terminated:
            break
    assert (info["fell"], info["missed"], info["is_success"], info["failed"]) == (1, 0, 0, 1)
    assert info["ending"] == int(hurcules.Ending.Fell)
    assert info["reward_failure"] == -10.0
