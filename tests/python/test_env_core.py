"""Strategy: each registered environment that is written over arrays, in its fastest fidelity.

What Gymnasium's checker wants, sameness of bits alone and side by side, resets, states, bad input.
"""

import copy
import json
import pickle
import re
import signal
import warnings
from contextlib import nullcontext

import gymnasium as gym
import numpy as np
import pytest
from gymnasium.error import ResetNeeded
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import AutoresetMode

import hurcules
import hurcules_envs  # noqa: F401  registers
from environments import rows
from hurcules_envs.evaluation import evaluate
from hurcules_envs.registry import (
    fidelities_of,
    make_environment,
    make_episodes,
    steps_of_episode,
)
from hurcules_envs.stretch import StretchEnv

FAST = {"fidelity": "kinematic"}
IDS = [
    ("Hurcules/Reach-v0", FAST),
    ("Hurcules/Reach-v0", {"fidelity": "fast", "robot": "manipulation", "sparse": True}),
    ("Hurcules/Reach-v0", {**FAST, "action": "delta"}),
    ("Hurcules/Reach-v0", {**FAST, "action": "pose"}),
    ("Hurcules/ReachJoint-v0", FAST),
    ("Hurcules/ReachPrecise-v0", FAST),
    ("Hurcules/ReachPreciseJoint-v0", FAST),
    ("Hurcules/Drive-v0", FAST),
    ("Hurcules/DriveJoint-v0", FAST),
    ("Hurcules/StretchJoint-v1", FAST),
    ("Hurcules/Drive-v0", {"fidelity": "fast", "terrain": "stairs"}),
    ("Hurcules/Drive-v0", {**FAST, "flat": True}),
    ("Hurcules/Drive-v0", {"fidelity": "fast", "terrain": "ramps"}),
]


def same(one, other):
    if isinstance(one, dict):
        return all(np.array_equal(one[name], other[name]) for name in one)
    return np.array_equal(one, other)


def row(observation, i):
    if not isinstance(observation, dict):
        return observation[i]
    return {name: v[i] for name, v in observation.items()}


@pytest.mark.parametrize(("name", "options"), IDS)
def test_an_environment_passes_gymnasiums_checker_without_a_warning(name, options):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        env = gym.make(name, **options)
        check_env(env.unwrapped, skip_render_check=True)
        env.close()
        env.close()


@pytest.mark.parametrize(("name", "options"), IDS[-3::2] + IDS[:1])
def test_side_by_side_and_on_two_threads_it_has_the_bits_that_it_has_alone(name, options):
    singles = [gym.make(name, **options) for _ in range(3)]
    vectors = [gym.make_vec(name, num_envs=3, threads=t, **options) for t in (1, 2)]
    alone = [env.reset(seed=7 + i)[0] for i, env in enumerate(singles)]
    together = [vector.reset(seed=7)[0] for vector in vectors]
    generator = np.random.default_rng(0)
    for _ in range(25):
        for observation in together:
            assert all(same(alone[i], row(observation, i)) for i in range(3))
        actions = generator.uniform(-1, 1, vectors[0].action_space.shape).astype(np.float32)
        steps = [vector.step(actions) for vector in vectors]
        together = [step[0] for step in steps]
        for i, env in enumerate(singles):
            alone[i], reward, _, _, info = env.step(actions[i])
            for step in steps:
                assert step[1][i] == reward
                assert step[4]["self_distance"][i] == info["self_distance"]


@pytest.mark.parametrize(("name", "options"), [IDS[0], IDS[-1]])
def test_a_state_goes_on_with_the_same_bits_in_another_instance(name, options):
    env, other = gym.make(name, **options).unwrapped, gym.make(name, **options).unwrapped
    env.reset(seed=1)
    other.reset(seed=2)
    generator = np.random.default_rng(3)
    actions = generator.uniform(-1, 1, (40, *env.action_space.shape)).astype(np.float32)
    lengths = set()
    for action in actions[:15]:
        env.step(action)
        state = env.get_state()
        assert np.isfinite(state[~np.isinf(state)]).all()
        lengths.add(len(state))
    assert len(lengths) == 1
    other.set_state(env.get_state())
    assert same(env.observe(), other.observe())
    for action in actions[15:]:
        one, reward, *_ = env.step(action)
        two, again, *_ = other.step(action)
        assert same(one, two)
        assert reward == again
    with pytest.raises(hurcules.Error, match="wanted shape"):
        env.set_state(env.get_state()[:-1])
    with pytest.raises(hurcules.Error, match="wanted shape"):
        gym.make("Hurcules/ReachJoint-v0", **FAST).unwrapped.set_state(env.get_state())


@pytest.mark.parametrize("vector", [False, True])
def test_a_state_of_another_rate_is_refused(vector):
    def made(rate):
        options = {"rate": rate, "max_episode_steps": 9, **FAST}
        if vector:
            env = gym.make_vec("Hurcules/Drive-v0", num_envs=2, **options)
        else:
            env = gym.make("Hurcules/Drive-v0", **options).unwrapped
        env.reset(seed=0)
        return env

    with pytest.raises(hurcules.Error, match="state: wanted one of rate=10 Hz, got one of 20 Hz"):
        made(10.0).set_state(made(20.0).get_state())


def test_a_state_of_another_ground_is_refused():
    def made(**options):
        env = gym.make("Hurcules/Drive-v0", fidelity="fast", **options).unwrapped
        env.reset(seed=0)
        return env

    ramps = made(terrain="ramps").get_state()
    made(terrain="ramps").set_state(ramps)
    for other in ({"terrain": "slope"}, {"terrain": "ramps", "terrain_seed": 2}):
        with pytest.raises(hurcules.Error, match="wanted one of this model"):
            made(**other).set_state(ramps)


def test_numbers_say_what_is_in_them_and_rewards_want_as_many_infos_as_goals():
    env = gym.make("Hurcules/Reach-v0", **FAST).unwrapped
    with pytest.raises(ResetNeeded, match=r"before observe\(\)"):
        env.observe()
    env.reset(seed=0)
    numbers = env._episodes.numbers
    assert next(iter(env.environment.memory)) in numbers
    assert "q/NO" not in numbers
    goals = np.zeros((4, env.environment.goal))
    with pytest.raises(hurcules.Error, match=r"wanted an info for each goal, got 3 for \(4,\)"):
        env.compute_reward(goals, goals, [{}] * 3)


def copied(env):
    return pickle.loads(pickle.dumps(env))


@pytest.mark.parametrize("how", [copy.deepcopy, copied])
@pytest.mark.parametrize(
    ("name", "options"),
    [
        ("Hurcules/Reach-v0", {**FAST, "action_delay": (0, 2)}),
        ("Hurcules/Press-v0", {"fidelity": "fast"}),
        ("Hurcules/Rescue-v0", {}),
    ],
)
def test_a_copy_goes_on_and_begins_the_next_episode_alike(name, options, how):
    env = gym.make(name, **options)
    env.reset(seed=1, options={"observation_noise": 0.01} if options else None)
    actions = 0.3 * np.random.default_rng(3).uniform(-1, 1, (6, *env.action_space.shape))
    for action in actions[:3].astype(np.float32):
        env.step(action)
    other = how(env)
    assert other.spec.id == env.spec.id
    assert repr(other.unwrapped.observe()) == repr(env.unwrapped.observe())
    for action in actions[3:].astype(np.float32):
        assert repr(other.step(action)) == repr(env.step(action))
    assert repr(other.reset()) == repr(env.reset())


@pytest.mark.parametrize("how", [copy.deepcopy, copied])
def test_a_copy_of_a_vector_goes_on_and_begins_the_next_episodes_alike(how):
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, max_episode_steps=6, **FAST)
    vector.reset(seed=1, options={"action_delay": (0, 2)})
    actions = np.random.default_rng(3).uniform(-1, 1, (12, *vector.action_space.shape))
    for action in actions[:3].astype(np.float32):
        vector.step(action)
    other = how(vector)
    for action in actions[3:].astype(np.float32):
        assert repr(other.step(action)) == repr(vector.step(action))


def test_a_state_begins_the_next_episodes_alike_and_an_instance_that_has_not_begun():
    env = gym.make("Hurcules/Press-v0", fidelity="fast").unwrapped
    with pytest.raises(ResetNeeded, match=r"call reset\(\) before step\(\)"):
        env.step(np.zeros(env.action_space.shape, np.float32))
    with pytest.raises(ResetNeeded, match=r"call reset\(\) before get_state\(\)"):
        env.get_state()
    env.reset(seed=4)
    state = env.get_state()
    fresh = gym.make("Hurcules/Press-v0", fidelity="fast").unwrapped
    fresh.set_state(state)  # begins it too
    assert same(fresh.observe(), env.observe())
    assert repr(fresh.reset()) == repr(env.reset())
    assert repr(fresh.reset()) == repr(env.reset())
    env.set_state(state)
    fresh.set_state(state)
    assert repr(fresh.reset()) == repr(env.reset())
    env.np_random = np.random.Generator(np.random.MT19937(1))
    env.reset()
    with pytest.raises(hurcules.Error, match=r"np_random: wanted a .* of MT19937"):
        env.get_state()
    with pytest.raises(hurcules.Error, match="a generator of random numbers"):
        fresh.set_state(np.where(state == state, state + 0.5, state))
    state[3] = np.nan
    with pytest.raises(hurcules.Error, match=r"state: wanted numbers, got nan at \(0, 3\)"):
        fresh.set_state(state)


def test_an_observation_is_never_written_again():
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, **FAST)
    kept, _ = vector.reset(seed=0)
    copies = {name: values.copy() for name, values in kept.items()}
    first, *_, info = vector.step(np.ones((2, 6), np.float32))
    time = info["time"].copy()
    vector.step(np.ones((2, 6), np.float32))
    assert same(kept, copies)
    assert not same(first, copies)
    assert (info["time"] == time).all()


def limited(mode):
    return gym.make_vec(
        "Hurcules/Reach-v0", num_envs=2, max_episode_steps=3, autoreset_mode=mode, **FAST
    )


def test_the_step_after_an_end_is_the_reset():
    vector = limited(AutoresetMode.NEXT_STEP)
    vector.reset(seed=0)
    actions = np.ones((2, 6), np.float32)
    ends = [vector.step(actions)[3].all() for _ in range(8)]
    assert ends == [False, False, True, False, False, False, True, False]
    assert vector.metadata["autoreset_mode"] == AutoresetMode.NEXT_STEP


def test_in_the_same_step_the_last_observation_is_kept_beside_the_new_one():
    vector, plain = limited(AutoresetMode.SAME_STEP), gym.make("Hurcules/Reach-v0", **FAST)
    vector.reset(seed=4)
    plain.reset(seed=4)
    action = np.full(6, 0.5, np.float32)
    for k in range(3):
        observation, _, _, truncated, info = vector.step(np.tile(action, (2, 1)))
        expected, *_ = plain.step(action)
        assert truncated.all() == (k == 2)
    assert same(info["final_obs"][0], expected)
    assert info["final_info"]["time"][0] == pytest.approx(0.15)
    assert info["time"][0] == 0.0
    again, _ = plain.reset()
    assert same(row(observation, 0), again)


def test_without_autoreset_who_is_over_is_reset_by_a_mask():
    vector = limited(AutoresetMode.DISABLED)
    vector.reset(seed=0)
    actions = np.zeros((2, 6), np.float32)
    for _ in range(3):
        *_, info = vector.step(actions)
    with pytest.raises(hurcules.Error, match="reset_mask"):
        vector.step(actions)
    vector.reset(options={"reset_mask": np.array([True, True])})
    *_, info = vector.step(actions)
    assert info["time"] == pytest.approx([0.05, 0.05])
    with pytest.raises(hurcules.Error, match="at least one true"):
        vector.reset(options={"reset_mask": np.array([False, False])})


def test_a_vector_wants_a_reset_of_all_episodes_before_a_step():
    vector = limited(AutoresetMode.DISABLED)
    actions = np.zeros((2, 6), np.float32)
    with pytest.raises(ResetNeeded, match=r"episodes \[0, 1\] have not begun: call reset\(\)"):
        vector.step(actions)
    vector.reset(options={"reset_mask": np.array([True, False])})
    with pytest.raises(ResetNeeded, match=r"episodes \[1\] have not begun"):
        vector.step(actions)
    vector.reset(options={"reset_mask": np.array([False, True])})
    state = vector.get_state()
    one, *_ = vector.step(actions)
    restored = limited(AutoresetMode.DISABLED)
    restored.set_state(state)  # begins them too
    assert same(restored.step(actions)[0], one)


def test_a_vector_says_what_was_wanted():
    vector = limited(AutoresetMode.NEXT_STEP)
    vector.reset(seed=0)
    state = vector.get_state()
    n = state.shape[1]
    for bad, text in (
        (state[0], rf"state: wanted shape \(2, {n}\), got \({n},\): it belongs to another"),
        (state[:, :-1], rf"state: wanted shape \(2, {n}\), got \(2, {n - 1}\)"),
        ("left", "state: wanted an array of numbers, got 'left'"),
        (np.where(np.arange(n) == 1, np.nan, state), r"state: wanted numbers, got nan at \(0, 1\)"),
        (np.where(np.arange(n) == n - 2, np.nan, state), "state: steps, over: wanted numbers, got"),
    ):
        with pytest.raises(hurcules.Error, match=text):
            vector.set_state(bad)
    for seed, text in (
        ([1, 2, 3], r"a whole number, or 2 of them, got \[1, 2, 3\]"),
        ("x", "a whole number, or 2 of them, got 'x'"),
        (1.5, "a whole number, or 2 of them, got 1.5"),
        (-1, "whole numbers >= 0, got -1"),
        ([0, 0.5], "whole numbers >= 0, got 0.5"),
    ):
        with pytest.raises(hurcules.Error, match="seed: wanted " + text):
            vector.reset(seed=seed)
    for options, text in (
        ({"num_envs": 2.0}, "num_envs: wanted a whole number >= 1, got 2.0"),
        ({"num_envs": 2, "threads": "all"}, "threads: wanted a whole number >= 0, got 'all'"),
        ({"num_envs": 2, "max_episode_steps": 0}, "max_episode_steps: wanted a whole number >= 1"),
    ):
        with pytest.raises(hurcules.Error, match=text):
            gym.make_vec("Hurcules/Reach-v0", **options, **FAST)
    assert gym.make_vec("Hurcules/Reach-v0", num_envs=np.int64(3), **FAST).num_envs == 3


@pytest.mark.parametrize(("name", "options"), [IDS[0], IDS[5]])
def test_a_goal_environment_passes_stable_baselines3s_checker_too(name, options):
    checker = pytest.importorskip(
        "stable_baselines3.common.env_checker", reason="pip install 'hurcules[train]'"
    )
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        checker.check_env(gym.make(name, **options).unwrapped, skip_render_check=True)


@pytest.mark.parametrize(("name", "options"), [IDS[0], IDS[5], IDS[6], IDS[8]])
@pytest.mark.parametrize("sparse", [False, True])
def test_the_reward_of_a_step_is_that_of_its_goals_and_info(name, options, sparse):
    """To the bit: of one episode, of several, with one info for all or one for each."""
    env = gym.make(name, sparse=sparse, **options).unwrapped
    vector = gym.make_vec(name, num_envs=4, sparse=sparse, **options)
    env.reset(seed=1)
    vector.reset(seed=1)
    env.action_space.seed(0)
    vector.action_space.seed(0)
    for _ in range(20):
        seen, reward, _, _, info = env.step(env.action_space.sample())
        assert env.compute_reward(seen["achieved_goal"], seen["desired_goal"], info) == reward
        seen, reward, _, _, info = vector.step(vector.action_space.sample())
        compute = vector.compute_reward
        goals = seen["achieved_goal"], seen["desired_goal"]
        assert compute(*goals, info).tolist() == reward.tolist()
        each = [{key: info[key][i] for key in info} for i in range(4)]
        assert compute(*goals, each).tolist() == reward.tolist()
        others = goals[0], goals[0][::-1].copy()  # where somebody else is
        rewards = [compute(*row) for row in zip(*others, each, strict=True)]
        assert compute(*others, np.array(each)).tolist() == rewards
    assert reward == pytest.approx(sum(info[f"reward_{t}"] for t in vector.environment.terms))


@pytest.mark.parametrize(
    ("name", "goal"), [("Reach-v0", 6), ("ReachPrecise-v0", 14), ("Drive-v0", 4)]
)
def test_goals_of_two_shapes_are_refused(name, goal):
    """They were broadcast against each other, or failed in the words of numpy."""
    env = gym.make(f"Hurcules/{name}", **FAST).unwrapped
    vector = gym.make_vec(f"Hurcules/{name}", num_envs=2, **FAST)
    for shapes in (
        ((5, goal // 2), (5, goal)), ((5, goal), (goal,)), ((5, 3), (5, 3)), ((), (goal,)),
    ):  # fmt: skip
        text = rf"one shape (..., {goal}), got {shapes[0]} and {shapes[1]}"
        for one in (env, vector):
            with pytest.raises(hurcules.Error, match=re.escape(text)):
                one.compute_reward(*map(np.ones, shapes), {})


def test_the_reward_of_a_drive_counts_the_way_that_it_came():
    drive = make_environment("hurcules_envs.drive:Drive", FAST)
    here, goal = np.array([0.0, 0.0, 1.0, 0.0]), np.array([3.0, 4.0, 1.0, 0.0])
    info = {"before_x": -0.6, "before_y": -0.8, "before_cos": 1.0, "before_sin": 0.0, "speed": 1.0}
    assert drive.compute_reward(here, goal, info) == pytest.approx(1.0)  # 6 m were left, now 5 m
    assert drive.compute_reward(goal, goal, {"speed": 0.2}) == 0.0  # still moves
    assert drive.compute_reward(goal, goal, {}) == 10.0


@pytest.mark.parametrize(
    ("name", "options", "units"),
    [
        ("Reach-v0", {}, ["m/s"] * 6),
        ("Reach-v0", {"action": "delta"}, ["m"] * 6),
        ("ReachPrecise-v0", {}, ["m/s"] * 6 + ["rad/s"] * 6),
        ("ReachPrecise-v0", {"action": "pose"}, ["m"] * 6 + ["rad"] * 6),
        ("ReachJoint-v0", {}, ["rad/s"] * 13),
        ("Drive-v0", {}, ["m/s", "rad/s", "rad/s"]),
        ("DriveJoint-v0", {}, ["rad/s"] * 13 + ["m/s", "rad/s"]),
    ],
)
def test_actions_have_units(name, options, units):
    env = gym.make(f"Hurcules/{name}", **FAST, **options).unwrapped
    assert env.action_units == units
    vector = gym.make_vec(f"Hurcules/{name}", num_envs=1, **FAST, **options)
    assert vector.action_units == units


@pytest.mark.parametrize("name", ["ReachPreciseJoint-v0", "DriveJoint-v0", "StretchJoint-v1"])
def test_a_twin_moves_the_coordinate_that_is_commanded_and_ends_its_observation_with_them(name):
    env = gym.make(f"Hurcules/{name}", **FAST).unwrapped
    seen, _ = env.reset(seed=0)
    action = np.zeros(env.action_space.shape, np.float32)
    moving = env.action_names.index("joints_3")
    action[moving] = -1.0
    before = env.numbers["q"].copy()
    for _ in range(4):
        seen, _, terminated, _, info = env.step(action)
    moved = (env.numbers["q"] - before)[0]
    assert not terminated and moved[3] < -0.1 * env.action_scale[moving]
    assert abs(moved).argmax() == 3 and np.delete(abs(moved), 3).max() < 1e-3
    flat = seen["observation"] if isinstance(seen, dict) else seen
    assert np.allclose(flat[-len(moved) :], env.numbers["q"][0], atol=1e-6)
    assert info["commanded_excess"] == 0.0
    with pytest.raises(hurcules.Error, match="action 'torque' does not exist; there are: twist"):
        gym.make(f"Hurcules/{name}", action="torque", **FAST)


def test_specs_and_environments_can_be_stored():
    env = gym.make("Hurcules/Drive-v0", **FAST)
    again = pickle.loads(pickle.dumps(env.unwrapped))
    assert again.action_names == env.unwrapped.action_names
    assert json.loads(env.spec.to_json())["id"] == "Hurcules/Drive-v0"


@pytest.mark.parametrize(
    ("path", "options", "steps", "least"),
    [
        ("hurcules_envs.reach:Reach", FAST, 100, 0.9),
        ("hurcules_envs.reach:ReachPrecise", FAST, 150, 0.8),
        ("hurcules_envs.drive:Drive", FAST, 200, 1.0),
        ("hurcules_envs.drive:Drive", {"fidelity": "fast"}, 200, 1.0),
    ],
)
def test_the_expert_succeeds_and_holding_or_constant_actions_do_not(path, options, steps, least):
    name = f"Hurcules/{path.split(':')[1]}-v0"
    count = 20 if options == FAST else 4

    def success(act):
        vector = gym.make_vec(name, num_envs=count, max_episode_steps=steps, **options)
        vector.reset(seed=100)
        done = np.zeros(count, dtype=bool)
        running = np.ones(count, dtype=bool)
        for _ in range(steps):
            *_, terminated, truncated, info = vector.step(act(vector))
            done |= running & info["is_success"]
            running &= ~(terminated | truncated)
        return done.mean()

    assert success(lambda v: v.environment.expert(v.numbers)) >= least
    if options == FAST:
        size = gym.make(name, **options).action_space.shape
        for constant in (np.zeros(size), np.ones(size), -np.ones(size)):
            assert success(lambda v, c=constant: np.tile(c, (count, 1))) == 0.0


BAD = [
    ({"fidelity": "best"}, "fidelity 'best' does not exist"),
    ({"action": "torque"}, "action 'torque' does not exist"),
    ({"robot": "spot"}, "robot: wanted"),
    ({"robot": __file__}, "wants frames"),
    ({"robot": 3}, "robot: wanted manipulation, rescue or the path of a model, got 3"),
    ({"tolerance": -1.0}, "tolerance: wanted"),
    ({"tolerance": "3 cm"}, "tolerance: wanted a number > 0, got '3 cm'"),
    ({"rate": 1000.0}, "rate: wanted"),
    ({"rate": "20"}, "rate: wanted 10 to 100 Hz, got '20'"),
    ({"sparse": "false"}, "sparse: wanted True or False, got 'false'"),
    ({"safe": 0}, "safe: wanted True or False, got 0"),
    ({"colour": "red"}, "option 'colour' does not exist"),
]


@pytest.mark.parametrize(("options", "text"), BAD)
def test_a_bad_option_says_what_was_wanted(options, text):
    with pytest.raises(hurcules.Error, match=text):
        make_environment("hurcules_envs.reach:Reach", options)


def test_flat_ground_has_no_seed_and_other_ground_none_below_zero():
    cases = {"flat": (1, "flat ground has none, got 1"), "stairs": (-1, "whole number >= 0, got")}
    for terrain, (seed, text) in cases.items():
        with pytest.raises(hurcules.Error, match=f"terrain_seed: .*{text}"):
            gym.make("Hurcules/Drive-v0", fidelity="fast", terrain=terrain, terrain_seed=seed)


def test_the_table_of_the_actions_of_drive_is_that_of_its_channels():
    env = gym.make("Hurcules/Drive-v0", **FAST).unwrapped
    table = rows(type(env.environment).__doc__)[0]
    assert [row[1] for row in table] == env.action_names
    assert [row[2] for row in table] == env.action_units
    assert [float(row[3]) for row in table] == env.action_scale.tolist()


def test_options_beside_those_of_the_class_are_listed_and_checked():
    with pytest.raises(
        hurcules.Error, match=r"there are: fidelity, .*, flat, render_mode, cameras, "
    ):
        gym.make("Hurcules/Drive-v0", colour="red", **FAST)
    with pytest.raises(
        hurcules.Error,
        match="safe, flat, threads, autoreset_mode, cameras, camera_size, width, height, friction",
    ):
        gym.make_vec("Hurcules/Reach-v0", num_envs=2, colour="red", **FAST)
    for make in (gym.make, gym.make_vec):
        with pytest.raises(hurcules.Error, match="flat: wanted True or False, got 'false'"):
            make("Hurcules/Reach-v0", flat="false", **FAST)


def test_judged_and_trained_episodes_last_as_long_at_any_rate():
    assert steps_of_episode("Hurcules/Reach-v0", {"rate": 10.0}) == 50
    assert steps_of_episode("Hurcules/Reach-v0", {}) == 100
    judged = evaluate(lambda seen: np.zeros((2, 6)), "Hurcules/Reach-v0", 2, rate=10.0, **FAST)
    assert judged.mean_length == 50


def test_another_rate_tells_how_long_episodes_last():
    text = "at rate=50 an episode of 100 steps lasts 2 s, .* 5 s: max_episode_steps=250"
    action = np.zeros(6, np.float32)
    for steps, warns in ((None, pytest.warns(UserWarning, match=text)), (250, nullcontext())):
        given = {"rate": 50, "max_episode_steps": steps} if steps else {"rate": 50}
        vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, **given, **FAST)
        env = gym.make("Hurcules/Reach-v0", **given, **FAST)
        env.reset(seed=0)
        while not env.step(action)[3]:
            pass
        for one in (env, vector):
            with warnings.catch_warnings(), warns:
                warnings.simplefilter("error" if steps else "always")
                one.reset(seed=0)


def test_a_bad_action_says_what_was_wanted():
    env = gym.make("Hurcules/Reach-v0", **FAST).unwrapped
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, **FAST)
    env.reset(seed=0)
    vector.reset(seed=0)
    for action, text in (
        (np.zeros(5), "wanted shape"),
        (np.full(6, np.nan), "wanted finite numbers"),
        ("left", "wanted an array of numbers"),
        (np.zeros(6, bool), r"action: wanted an array of numbers, got array\(\[False"),
    ):
        with pytest.raises(hurcules.Error, match=text):
            env.step(action)
    with pytest.raises(hurcules.Error, match=r"index \(1, 2\)"):
        bad = np.zeros((2, 6))
        bad[1, 2] = np.inf
        vector.step(bad)
    for one in (env, vector):
        with pytest.raises(hurcules.Error, match="options: wanted a dictionary, got 3"):
            one.reset(options=3)
    with pytest.raises(hurcules.Error, match="autoreset mode 'never' does not exist; there are: N"):
        gym.make_vec("Hurcules/Reach-v0", num_envs=2, autoreset_mode="never", **FAST)
    with pytest.raises(hurcules.Error, match="reset option 'goal' does not exist; there are: fric"):
        env.reset(options={"goal": 1})


def test_a_training_that_was_stopped_goes_on(tmp_path):
    training = pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    from stable_baselines3 import PPO

    from hurcules_envs.policy import Policy

    options = training.TrainOptions(
        "Hurcules/Reach-v0",
        steps=1024,
        episodes=8,
        options=FAST,
        out=tmp_path,
        checkpoint_every=512,
    )
    training.train(options)
    checkpoint = (tmp_path / "checkpoint.zip").stat().st_mtime_ns
    more = training.TrainOptions(**{**vars(options), "steps": 2048})
    seen = []
    training.train(more, lambda done, _: seen.append(done))
    assert seen[:2] == [0, 1024 + 8]
    assert (tmp_path / "checkpoint.zip").stat().st_mtime_ns > checkpoint
    with pytest.raises(hurcules.Error, match="another run: seed"):
        training.train(training.TrainOptions(**{**vars(options), "seed": 1}))
    policy = Policy(tmp_path)
    assert policy.metadata["steps"] == "2048"
    model = PPO.load(tmp_path / "policy.zip", device="cpu")
    vector = gym.make_vec(policy.environment, num_envs=4, **policy.options)
    observation, _ = vector.reset(seed=0)
    wanted, _ = model.predict(observation, deterministic=True)
    assert np.allclose(policy(observation), wanted, atol=1e-5)


def test_an_interrupted_training_goes_on_where_it_was(tmp_path):
    training = pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    options = training.TrainOptions(
        "Hurcules/Reach-v0", steps=2048, episodes=8, options=FAST, out=tmp_path
    )
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        with pytest.raises(KeyboardInterrupt):
            training.train(
                options, lambda done, _: signal.raise_signal(signal.SIGINT) if done == 512 else None
            )
    finally:
        signal.signal(signal.SIGINT, before)
    assert (tmp_path / "policy.onnx").exists()  # the policy so far
    (tmp_path / "policy.onnx").unlink()
    seen = []
    training.train(options, lambda done, _: seen.append(done))
    assert seen[:2] == [0, 512 + 8]
    assert (tmp_path / "policy.onnx").exists()


def test_full_swings_of_both_hands_touch_nothing_and_pass_no_limit():
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=4, fidelity="fast")
    vector.reset(seed=3)
    generator = np.random.default_rng(0)
    for step in range(60):
        if step % 10 == 0:
            actions = generator.choice([-1.0, 1.0], vector.action_space.shape)
        *_, info = vector.step(actions)
        assert (info["self_contacts"] == 0).all()
        assert (info["self_distance"] > 0.02).all()
    assert info["commanded_excess"].max() == 0.0
    assert info["limit_excess"].max() < 5e-3  # [rad], measured


@pytest.mark.parametrize("path", ["hurcules_envs.reach:Reach", "hurcules_envs.drive:Drive"])
def test_the_table_of_the_observation_is_that_of_the_space(path):
    environment = make_environment(path, FAST)
    table = type(environment).__doc__.split("| group")[1].split("\n\n")[0].splitlines()[2:]
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in table]
    hands = 2  # of Hurcules, `h` in the table
    for row, group in zip(rows, environment.observation, strict=True):
        size = int(row[1].removesuffix(" h")) * (hands if row[1].endswith(" h") else 1)
        assert (row[0], size, row[2], float(row[3])) == (
            group.name,
            group.size,
            group.unit,
            group.bound,
        )
        assert row[4].strip() == group.text


@pytest.mark.parametrize(
    ("name", "known"),
    [
        ("Reach-v0", ("exact", "fast", "kinematic")),
        ("Stretch-v1", ("exact", "fast", "kinematic")),
        ("Valve-v0", ("exact", "fast")),  # without physics nothing is touched
        ("PressJoint-v0", ("exact", "fast")),
        ("Rescue-v0", ("exact", "fast")),
        ("Stretch-v0", ()),  # no choice
    ],
)
def test_the_last_fidelity_is_what_training_takes(name: str, known: tuple[str, ...]) -> None:
    assert fidelities_of(f"Hurcules/{name}") == known


def test_what_was_closed_is_not_used() -> None:
    vector = gym.make_vec("Hurcules/Reach-v0", num_envs=2, fidelity="kinematic")
    reach = gym.make("Hurcules/Reach-v0", fidelity="kinematic").unwrapped
    for env in (vector, reach, StretchEnv()):
        env.reset(seed=0)
        state = env.get_state()
        env.close()
        for call, use in {
            "reset": env.reset,
            "step": lambda env=env: env.step(np.zeros(env.action_space.shape)),
            "render": env.render,
            "get_state": env.get_state,
            "set_state": lambda env=env, state=state: env.set_state(state),
            "copy": lambda env=env: copy.deepcopy(env),
        }.items():
            with pytest.raises(gym.error.ClosedEnvironmentError, match=rf"{call}\(.*was closed"):
                use()


def test_a_limit_that_is_passed_by_what_servos_give_costs_nothing() -> None:
    episodes = make_episodes("Hurcules/Reach-v0", 4, 0, **FAST)
    read, places = episodes._read().copy(), episodes._places
    for worst, now, cost in (
        ([1e-9, 4e-3, 6e-3, 6e-3], [0.0, 4e-3, 0.0, 6e-3], [0, 0, 1, 1]),
        ([4e-3, 7e-3, 6e-3, 6e-3], [0.0, 0.0, 0.0, 6e-3], [0, 1, 0, 1]),
    ):
        read[:, places["excess/position"]] = np.array(worst)[:, None]
        read[:, places["excess_now/position"]] = np.array(now)[:, None]
        episodes._values = read.copy()
        assert episodes.look(remember=None).info["cost"].tolist() == cost
