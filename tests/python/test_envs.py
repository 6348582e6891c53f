"""The environments: Gymnasium's own checker, tables against spaces, determinism, states, wrong input.

Whether a policy can learn is not tested here.
"""

import copy
import json
import os
import pickle
import re
import subprocess
import sys
import warnings
from collections.abc import Iterator
from typing import Any

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env

import hurcules
import hurcules_envs
from hurcules_envs.base import HurculesEnv

IDS = [f"hurcules_envs:{name}" for name in hurcules_envs.ENVIRONMENTS]
Table = list[dict[str, str]]


@pytest.fixture(params=IDS)
def env(request: pytest.FixtureRequest) -> Iterator[HurculesEnv]:
    made = gymnasium.make(request.param, disable_env_checker=True)
    unwrapped = made.unwrapped
    assert isinstance(unwrapped, HurculesEnv)
    yield unwrapped
    made.close()


def tables(env: HurculesEnv) -> list[Table]:
    """The tables in the text of an environment's class: a list of rows, each by heading."""
    found: list[Table] = []
    headings: list[str] = []
    for line in (type(env).__doc__ or "").splitlines():
        cells = [cell.strip() for cell in line.strip().strip("|").split("|")]
        if not line.strip().startswith("|"):
            headings = []
        elif not headings:
            headings = cells
            found.append([])
        elif not set(cells[0]) <= {"-"}:
            found[-1].append(dict(zip(headings, cells, strict=True)))
    return found


def span(row: dict[str, str]) -> range:
    first, _, last = row["index"].partition("-")
    return range(int(first), int(last or first) + 1)


def rollout(env: HurculesEnv, seed: int, steps: int) -> list[Any]:
    actions = np.random.default_rng(seed).uniform(-1, 1, (steps, *env.action_space.shape))
    taken: list[Any] = [env.reset(seed=seed)]
    return taken + [env.step(action.astype(np.float32)) for action in actions]


def same(a: Any, b: Any) -> bool:
    return bool(pickle.dumps(a) == pickle.dumps(b))


@pytest.mark.parametrize("name", IDS)
def test_gymnasiums_checker_has_nothing_to_say(name: str) -> None:
    env = gymnasium.make(name)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        check_env(env.unwrapped)
    env.close()


def test_the_table_of_actions_is_true(env: HurculesEnv) -> None:
    table = tables(env)[0]
    assert [row["name"] for row in table] == env.action_names
    assert [float(row["scale"]) for row in table] == env.action_scale.tolist()
    assert [span(row) for row in table] == [range(i, i + 1) for i in range(len(table))]
    assert env.action_space == gymnasium.spaces.Box(-1, 1, (len(table),), np.float32)


def test_the_table_of_observations_is_true(env: HurculesEnv) -> None:
    box = env.observation_space
    assert isinstance(box, gymnasium.spaces.Box)
    spans = [(span(row), row) for row in tables(env)[1]]
    assert [i for indices, _ in spans for i in indices] == list(range(box.shape[0]))
    for indices, row in spans:
        stem = re.sub(r"/[A-Z]$", "", row["name"])
        assert {env.observation_names[i].startswith(f"{stem}/") for i in indices} == {True}, stem
        assert {box.low[i] for i in indices} == {np.float32(row["least"])}
        assert {box.high[i] for i in indices} == {np.float32(row["most"])}
    assert len(env.observation_names) == box.shape[0]


def test_the_table_of_the_reward_is_true(env: HurculesEnv) -> None:
    assert [row["term"] for row in tables(env)[2]] == list(env.terms)


def test_the_coordinates_stand_in_the_order_of_the_text(env: HurculesEnv) -> None:
    text = " ".join((type(env).__doc__ or "").split())
    positions = [name[2:] for name in env.observation_names if name.startswith("q/")]
    assert ", ".join(positions) in text


def test_the_terms_of_the_reward_sum_to_it(env: HurculesEnv) -> None:
    for _, reward, _, _, info in rollout(env, 1, 50)[1:]:
        assert reward == sum(info[f"reward_{term}"] for term in env.terms)


def test_info_has_the_same_keys_and_shapes_from_reset_on(env: HurculesEnv) -> None:
    def shapes(info: dict[str, Any]) -> dict[str, tuple[type, tuple[int, ...]]]:
        return {key: (type(value), np.shape(value)) for key, value in info.items()}

    first, *later = rollout(env, 2, 5)
    wanted = shapes(first[1])
    assert [shapes(step[4]) for step in later] == [wanted] * 5
    assert {"is_success", "solver_status", "solver_factorizations", "solver_changes"} <= set(wanted)
    assert {"level_errors", "limit_excess", "time"} <= set(wanted)


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


def test_a_state_of_another_size_is_refused(env: HurculesEnv) -> None:
    with pytest.raises(hurcules.Error):
        env.set_state(env.get_state()[:-1])


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


@pytest.mark.parametrize("wrong", [np.nan, np.inf, -np.inf])
def test_an_action_that_is_not_finite_is_refused(env: HurculesEnv, wrong: float) -> None:
    env.reset(seed=0)
    before = env.get_state()
    action = np.zeros(env.action_space.shape, np.float32)
    action[4] = wrong
    with pytest.raises(hurcules.Error, match="action: wanted finite numbers"):
        env.step(action)
    assert same(before, env.get_state())


def test_wrong_arguments_are_refused_with_what_there_is(env: HurculesEnv) -> None:
    with pytest.raises(hurcules.Error, match="render mode 'smell' does not exist.* rgb_array"):
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


@pytest.mark.parametrize("name", IDS)
def test_the_spec_and_the_environment_can_be_stored(name: str) -> None:
    env = gymnasium.make(name)
    assert env.spec is not None
    again = gymnasium.make(gymnasium.envs.registration.EnvSpec.from_json(env.spec.to_json()))
    pickled = pickle.loads(pickle.dumps(env.unwrapped))
    starts = [e.reset(seed=4)[0] for e in (env, again, pickled)]
    assert same(starts[0], starts[1])
    assert same(starts[0], starts[2])
    for e in (env, again, pickled, pickled):  # twice does no harm
        e.close()


@pytest.mark.parametrize("name", IDS)
def test_the_time_limit_truncates(name: str) -> None:
    env = gymnasium.make(name, max_episode_steps=3)
    env.reset(seed=0)
    ends = [env.step(np.zeros(11, np.float32))[2:4] for _ in range(3)]
    env.close()
    assert ends == [(False, False), (False, False), (False, True)]


@pytest.mark.parametrize("name", IDS)
def test_vectors_of_environments_step(name: str) -> None:
    envs = gymnasium.make_vec(name, num_envs=2, vectorization_mode="sync")
    observations, _ = envs.reset(seed=7)
    single = gymnasium.make(name)
    assert np.array_equal(observations[0], single.reset(seed=7)[0])
    assert envs.step(envs.action_space.sample())[0].shape == observations.shape
    single.close()
    envs.close()


def test_pictures_are_drawn(env: HurculesEnv) -> None:
    drawing = type(env)(render_mode="rgb_array")
    drawing.reset(seed=0)
    picture = drawing.render()
    drawing.close()
    assert picture is not None
    assert (picture.shape, picture.dtype) == ((368, 640, 3), np.uint8)
    assert picture.std() > 10


def test_drawing_does_not_disturb_the_run(env: HurculesEnv) -> None:
    drawing = type(env)(render_mode="rgb_array")
    for e in (env, drawing):
        e.reset(seed=0)
    action = np.full(11, 0.5, np.float32)
    for _ in range(5):
        drawing.render()
        assert same(env.step(action), drawing.step(action))
    drawing.close()


def test_without_a_renderer_the_remedy_is_named() -> None:
    program = f"""
import gymnasium, hurcules
env = gymnasium.make({IDS[0]!r}, render_mode="rgb_array")
env.reset(seed=0)
try:
    env.render()
except hurcules.Error as error:
    print(error)
"""
    done = subprocess.run(
        [sys.executable, "-c", program],
        env={**os.environ, "MUJOCO_GL": "disable"},
        capture_output=True,
        text=True,
    )
    assert done.stdout.startswith("no usable renderer (")
    assert "apt-get install" in done.stdout


def test_state_and_info_are_plain_numbers(env: HurculesEnv) -> None:
    _, info = env.reset(seed=0)
    plain = {key: value.tolist() if isinstance(value, np.ndarray) else value for key, value in info.items()}
    assert json.loads(json.dumps(plain)) == plain
    assert env.get_state().dtype == np.float64
