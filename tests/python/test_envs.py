"""What the environments do: reward, determinism, states, wrong input.

Whether a policy can learn is not tested here.
"""

import copy
from typing import Any

import numpy as np
import pytest

import hurcules
from environments import env, rollout, same
from hurcules_envs.base import HurculesEnv

__all__ = ["env"]


def test_the_terms_of_the_reward_sum_to_it(env: HurculesEnv) -> None:
    for _, reward, _, _, info in rollout(env, 1, 50)[1:]:
        assert reward == sum(info[f"reward_{term}"] for term in env.terms)


def described(key: str, text: str) -> bool:
    """Whether a table in the text has a row for this key of info."""
    return f"| {key.removeprefix('reward_')} " in text


def test_info_has_the_same_keys_and_shapes_from_reset_on(env: HurculesEnv) -> None:
    def shapes(info: dict[str, Any]) -> dict[str, tuple[type, tuple[int, ...]]]:
        return {key: (type(value), np.shape(value)) for key, value in info.items()}

    first, *later = rollout(env, 2, 5)
    wanted = shapes(first[1])
    assert [shapes(step[4]) for step in later] == [wanted] * 5
    assert {"is_success", "solver_status", "solver_factorizations", "solver_changes"} <= set(wanted)
    assert {"solver_iterations", "level_errors", "time"} <= set(wanted)
    assert {"limit_excess", "limit_excess_velocity", "limit_excess_torque"} <= set(wanted)
    assert type(env).__doc__ is not None
    assert [key for key in wanted if not described(key, str(type(env).__doc__))] == []
    assert all(info["solver_iterations"] == 1 + info["solver_changes"] for *_, info in later)


def test_two_environments_with_one_seed_agree_bit_for_bit(env: HurculesEnv) -> None:
    other = type(env)()
    assert same(rollout(env, 5, 50), rollout(other, 5, 50))
    assert not same(rollout(env, 5, 2), rollout(other, 6, 2))


def test_the_unseeded_reset_follows_from_the_last_seed(env: HurculesEnv) -> None:
    starts = []
    for _ in range(2):
        env.reset(seed=9)
        starts.append([env.reset()[0], env.reset()[0]])
    assert same(starts[0], starts[1])
    assert not same(starts[0][0], starts[0][1])


def test_a_state_that_is_set_goes_on_with_the_same_bits(env: HurculesEnv) -> None:
    rollout(env, 3, 120)
    state = env.get_state()
    action = np.full(env.action_space.shape, 0.3, np.float32)
    first = [env.step(action) for _ in range(300)]
    env.set_state(state)
    assert same(first, [env.step(action) for _ in range(300)])


def test_a_state_goes_over_to_another_environment(env: HurculesEnv) -> None:
    rollout(env, 3, 20)
    other = type(env)()
    other.set_state(env.get_state())
    action = np.full(env.action_space.shape, -0.2, np.float32)
    assert same([env.step(action) for _ in range(20)], [other.step(action) for _ in range(20)])


def test_a_state_with_nan_is_refused(env: HurculesEnv) -> None:
    state = env.get_state()
    state[2] = np.nan
    with pytest.raises(hurcules.Error, match=r"state: wanted numbers, got nan at \(2,\)"):
        env.set_state(state)


def test_a_step_takes_20_ms(env: HurculesEnv) -> None:
    assert env.dt == pytest.approx(0.02)


def test_a_state_of_another_size_is_refused(env: HurculesEnv) -> None:
    before = env.get_state()
    with pytest.raises(hurcules.Error):
        env.set_state(before[:-1])
    assert same(before, env.get_state())


@pytest.mark.parametrize("wrong", [[], None, "state", 1.0, [[1.0, 2.0]], ["a", "b"], [1.0, []]])
def test_what_is_no_state_is_refused(env: HurculesEnv, wrong: Any) -> None:
    before = env.get_state()
    with pytest.raises(hurcules.Error, match=r"state: wanted .*, got "):
        env.set_state(wrong)
    assert same(before, env.get_state())


def test_what_is_returned_is_never_written_again(env: HurculesEnv) -> None:
    observation, info = env.reset(seed=0)
    kept = copy.deepcopy((observation, info))
    step = env.step(env.action_space.sample())
    kept_step = copy.deepcopy(step)
    env.step(env.action_space.sample())
    env.reset(seed=1)
    assert same(kept, (observation, info))
    assert same(kept_step, step)


def test_zero_holds(env: HurculesEnv) -> None:
    env.reset(seed=0)
    hand = env.simulation.data.site("L_tcp").xpos
    for _ in range(50):
        env.step(np.zeros(env.action_space.shape, np.float32))
    settled = hand.copy()
    for _ in range(50):
        env.step(np.zeros(env.action_space.shape, np.float32))
    assert np.linalg.norm(hand - settled) < 1e-3


def test_the_operators_actions_bring_the_hands_forward(env: HurculesEnv) -> None:
    env.reset(seed=0)
    progress = 0.0
    for _ in range(250):
        progress += env.step(env.operator_action())[4]["reward_progress"]
    # 3 s of stretch at 0.0215 m/s, 10 a metre
    assert progress == pytest.approx(10 * 3 * 0.0215, rel=0.1)


def test_random_actions_never_leave_the_space_nor_command_beyond_a_limit(env: HurculesEnv) -> None:
    rng = np.random.default_rng(0)
    env.reset(seed=0)
    action = env.action_space.sample()
    for step in range(400):
        if step % 20 == 0:  # long pushes reach further than noise
            action = rng.choice([-1.0, 1.0], env.action_space.shape).astype(np.float32)
        observation, reward, over, _, _ = env.step(action)
        assert env.observation_space.contains(observation)
        assert np.isfinite(reward)
        if over:
            break
    assert env.simulation.limit_violation()["commanded"]["position_rad"] == 0.0


@pytest.mark.parametrize("wrong", [np.zeros(3), np.zeros((11, 1)), 0.0, [[0.0] * 11]])
def test_an_action_of_another_shape_is_refused(env: HurculesEnv, wrong: Any) -> None:
    env.reset(seed=0)
    with pytest.raises(hurcules.Error, match=r"action: wanted shape \(11,\), got "):
        env.step(wrong)


@pytest.mark.parametrize("wrong", ["x", {}, None, [0.0, [1.0]], ["0"] * 11, [1j] * 11])
def test_an_action_that_is_no_numbers_is_refused(env: HurculesEnv, wrong: Any) -> None:
    env.reset(seed=0)
    with pytest.raises(hurcules.Error, match="action: wanted an array of numbers, got "):
        env.step(wrong)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_an_action_that_is_not_finite_is_refused(env: HurculesEnv, wrong: float) -> None:
    env.reset(seed=0)
    before = env.get_state()
    action = np.zeros(env.action_space.shape, np.float32)
    action[4] = wrong
    with pytest.raises(hurcules.Error, match=f"wanted finite numbers, got {wrong} at index 4"):
        env.step(action)
    assert same(before, env.get_state())


def test_wrong_arguments_are_refused_with_what_there_is(env: HurculesEnv) -> None:
    with pytest.raises(hurcules.Error, match=r"render mode 'smell' does not exist.* rgb_array"):
        type(env)(render_mode="smell")
    with pytest.raises(hurcules.Error, match="variation"):
        type(env)(variation=-1.0)
    with pytest.raises(hurcules.Error, match="no options exist, got speed"):
        env.reset(options={"speed": 3})


def test_a_fall_ends_the_episode_and_costs(env: HurculesEnv) -> None:
    env.reset(seed=0)
    for _ in range(200):
        env.simulation.data.body("waist").xfrc_applied[:3] = (-9000.0, 0.0, 0.0)
        _, _, terminated, truncated, info = env.step(np.zeros(11, np.float32))
        if terminated:
            break
    assert (terminated, truncated) == (True, False)
    assert info["reward_fall"] == -10.0
    assert info["is_success"] is False
    assert info["ending"] == int(env.unwrapped.simulation.ending) != 0
