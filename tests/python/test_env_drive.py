"""Drive on other ground than flat: what it sees of it, who may drive there, who comes across.

Strategy: heights beside the numbers of the scene; experts in "fast", a few episodes each. Not
tested: how often they succeed (docs/environments.md has it).
"""

import math

import gymnasium as gym
import numpy as np
import pytest

import hurcules
import hurcules_envs  # noqa: F401  registers
from hurcules_envs.climbing import climb
from hurcules_envs.evaluation import evaluate
from hurcules_envs.policy import Policy
from hurcules_envs.registry import make_episodes
from hurcules_envs.terrain import AHEAD, BESIDE, Heights, scene_of

DRIVE = "Hurcules/Drive-v0"


def drive(terrain, **options):
    return gym.make(DRIVE, fidelity="fast", terrain=terrain, **options).unwrapped


def spaces_of(env):
    return env.observation_space, env.action_space


def ground(observation):
    """(ahead, beside) of the group of that name."""
    return observation["observation"][15:240].reshape(len(AHEAD), len(BESIDE))


def test_heights_are_those_of_the_scene():
    stairs = hurcules.scenes.scene("stairs")
    heights = Heights(hurcules.scenes.make("stairs"))
    x = stairs.distance + stairs.run * np.array([-0.5, 0.5, 1.5, 2.5])
    points = np.stack([x, np.zeros(4)], axis=1)
    assert heights.at(points) == pytest.approx([0.0, 0.2, 0.4, 0.6], abs=1e-9)
    slope = Heights(hurcules.scenes.make("slope"))
    assert slope.at(np.array([3.0, 1.0])) == pytest.approx(3 * math.tan(math.pi / 6), abs=0.01)


@pytest.mark.parametrize("blind", [False, True])
def test_the_ground_is_looked_up_once_a_step(monkeypatch, blind):
    episodes = make_episodes(DRIVE, 2, 0, 1, fidelity="fast", terrain="stairs", blind=blind)
    calls = []
    around = Heights.around
    monkeypatch.setattr(Heights, "around", lambda *given: calls.append(1) or around(*given))
    episodes.look(remember=None)
    for _ in range(3):
        episodes.step(episodes.environment.expert(episodes.numbers))
        episodes.look(remember=np.ones(2, dtype=bool))
    assert len(calls) == (3 if blind else 4)  # blind, only the expert asks, three times


def test_the_grid_turns_with_the_robot():
    heights = Heights(hurcules.scenes.make("step_field"))
    place, sole = np.array([[3.0, 0.0, 0.0, 1.0]]), np.array([[0.1]])
    seen = heights.around(place, sole).reshape(len(AHEAD), len(BESIDE))
    assert np.ptp(seen) >= 0.2  # posts of several heights
    for i, j in ((0, 0), (14, 2), (17, 7)):  # it looks along y: to its left is -x
        there = np.array([3.0 - BESIDE[j], AHEAD[i]])
        assert seen[i, j] == heights.at(there) - 0.1
    assert not heights.around(place - [[50.0, 0.0, 0.0, 0.0]], sole).any()  # beyond the map


def test_what_is_seen_is_the_ground_under_it_and_ahead():
    env = drive("slope")
    seen = ground(env.reset(seed=0)[0])
    # its soles lie on the slope, along its heading it rises by tan(30 degrees), across it does not
    rises = np.diff(seen.mean(axis=1)) / np.diff(AHEAD)
    middle = np.abs(AHEAD[1:]) < 0.9  # beyond it the numbers are cut off at 1 m
    assert rises[middle] == pytest.approx(math.tan(math.pi / 6), abs=0.2)
    assert np.ptp(seen, axis=1).max() < 0.03
    assert drive("ramps").observation_space["observation"].shape == (244,)


def test_on_flat_ground_nothing_is_added_and_blind_leaves_it_out():
    flat, blind = drive("flat"), drive("ramps", blind=True)
    assert [group.name for group in flat.environment.observation][-1] == "margin"
    assert flat.observation_space == blind.observation_space
    env = drive("ramps")
    one, two = env.reset(seed=4)[0], blind.reset(seed=4)[0]
    assert np.array_equal(one["observation"][:15], two["observation"])


def test_flat_ground_is_seen_where_it_is_asked_for():
    env, plain = (
        gym.make(DRIVE, fidelity="fast", **given).unwrapped for given in ({"blind": False}, {})
    )
    one, two = env.reset(seed=4)[0], plain.reset(seed=4)[0]
    assert np.array_equal(one["observation"][:15], two["observation"])
    assert np.abs(one["observation"][15:]).max() < 1e-3


def test_the_climbing_expert_is_a_function_of_what_is_seen():
    """What it remembers stands in the observation, so that a network can learn what it does."""
    episodes = make_episodes(
        DRIVE, 3, 1100, 1, fidelity="fast", terrain="step_field", terrain_seed=2
    )
    environment, phases = episodes.environment, set()
    for t in range(80):
        seen = episodes.look(remember=np.full(3, t > 0)).observation["observation"].astype(float)
        groups = environment.groups_of(seen)
        speed, rate, legs = climb(groups)
        action = np.clip(np.stack([speed / 1.5, rate, legs / 0.3], axis=1), -1.0, 1.0)
        assert action == pytest.approx(environment.expert(episodes.numbers), abs=1e-4)
        phases |= set(groups["held"].sum(axis=1))
        # the first one is driven; the others are held: nobody drives them
        episodes.step(np.where([[True], [False], [False]], action, 0.0))
    assert phases == {0.0, 1.0, 2.0, 3.0}


def test_a_policy_of_flat_ground_drives_blind_and_else_is_told_the_sizes():
    given = {"fidelity": "fast", "terrain": "rough_road"}
    sizes = r"does not fit .*wanted the inputs .*\(244\).*\(15\).*blind=True"
    with pytest.raises(hurcules.Error, match=sizes):
        evaluate("Drive-v0", "Drive-v0", 1, **given)
    with pytest.raises(hurcules.Error, match=r"does not fit") as other:
        Policy("Reach-v0").check(DRIVE, *spaces_of(drive("flat")))
    assert "blind" not in str(other.value)
    assert evaluate("Drive-v0", "Drive-v0", 2, blind=True, **given).success == 1.0


@pytest.mark.parametrize(
    ("terrain", "least", "most"),
    [("slope", 10, 30), ("ramps", 5, 15), ("stairs", 25, 35)],
)
def test_a_seed_draws_how_steep_a_terrain_is(terrain, least, most):
    """Degrees, of the text of the class."""
    steep = [
        angle
        for seed in range(1, 9)
        for name, angle in scene_of(terrain, seed).items()
        if name in ("angle", "pitch")
    ]
    assert len(set(steep)) == 8
    assert least <= np.degrees(min(steep)) < np.degrees(max(steep)) <= most
    assert scene_of(terrain, 5) == scene_of(terrain, 5)


@pytest.mark.parametrize(
    ("terrain", "seed"), [("slope", 0), ("ramps", 1), ("stairs", 0), ("stairs", 3)]
)
def test_the_expert_comes_across_and_standing_still_does_not(terrain, seed):
    for act, wanted in ((lambda e: e.environment.expert(e.numbers), 1.0), (None, 0.0)):
        episodes = make_episodes(
            DRIVE, 3, 900, 2, fidelity="fast", terrain=terrain, terrain_seed=seed
        )
        running, done = np.ones(3, dtype=bool), np.zeros(3, dtype=bool)
        episodes.look(remember=None)
        for _ in range(300 if act else 30):
            action = act(episodes) if act else np.zeros((3, 3))
            episodes.step(episodes.checked(action, (3, 3)), running)
            seen = episodes.look(remember=running)
            done |= running & seen.info["is_success"]
            running &= ~seen.terminated
        assert done.mean() == wanted


def test_the_trunk_turns_with_the_knees_where_it_climbs():
    env = drive("stairs")
    env.reset(seed=0)
    for _ in range(15):
        env.step(np.array([0.0, 0.0, -1.0], np.float32))
    qpos = {name: float(env.data.joint(name).qpos[0]) for name in ("LKN", "RKN", "HIP")}
    assert qpos["LKN"] == pytest.approx(math.pi - 0.45, abs=0.05)
    assert qpos["RKN"] == pytest.approx(qpos["LKN"], abs=0.01)
    assert qpos["HIP"] - 1.0 == pytest.approx(qpos["LKN"] - math.pi, abs=0.02)


def test_an_expert_that_is_held_goes_on_with_the_same_bits_from_a_state():
    one, two = drive("step_field", terrain_seed=2), drive("step_field", terrain_seed=2)
    one.reset(seed=102)
    two.reset(seed=0)
    for _ in range(70):
        one.step(one.environment.expert(one.numbers)[0].astype(np.float32))
    two.set_state(one.get_state())
    assert np.array_equal(one.observe()["observation"], two.observe()["observation"])
    for _ in range(10):
        a, b = (e.environment.expert(e.numbers)[0].astype(np.float32) for e in (one, two))
        assert np.array_equal(a, b)
        assert one.step(a)[1] == two.step(b)[1]


def test_its_twin_of_joints_climbs_too():
    env = gym.make("Hurcules/DriveJoint-v0", fidelity="fast", terrain="stairs").unwrapped
    assert [group.name for group in env.environment.observation][-2:] == ["aside", "q"]
    seen, _ = env.reset(seed=0)
    assert env.observation_space.contains(seen)
    assert env.observation_space.contains(env.step(env.action_space.sample())[0])


def bang_bang(safe, steps=80):
    """Four robots whose legs go up while they drive slowly, then full speed: (contacts, speeds)."""
    vector = gym.make_vec(
        DRIVE, num_envs=4, threads=1, fidelity="fast", safe=safe, autoreset_mode="Disabled"
    ).unwrapped
    vector.reset(seed=2)
    contacts, speeds = 0, []
    for step in range(steps):
        turn = 1.0 if step // 5 % 2 else -1.0
        drive = [1.0, turn] if step > 40 else [0.2, 0.4 * turn]
        action = np.tile(np.array([*drive, 1.0], np.float32), (4, 1))
        observation, _, _, _, info = vector.step(action)
        contacts += int((info["self_contacts"] > 0).sum())
        speeds.append(np.abs(observation["observation"][:, 4]).max())
    return contacts, np.array(speeds)


def test_legs_do_not_touch_the_arms_and_drive_slowly_where_they_are_up():
    contacts, speeds = bang_bang(safe=True)
    assert contacts == 0
    assert speeds.max() < 0.8  # [m/s] 0.5 commanded, springs of the tracks swing
    touched, fast = bang_bang(safe=False)
    assert touched > 0
    assert fast.max() > 0.8


def test_folded_it_drives_as_fast_as_without_the_levels():
    for safe in (True, False):
        env = gym.make(DRIVE, fidelity="kinematic", safe=safe).unwrapped
        env.reset(seed=0)
        for _ in range(20):
            observation, *_ = env.step(np.array([1.0, 0.0, 0.0], np.float32))
        assert observation["observation"][4] == pytest.approx(1.5, abs=0.01)


def test_legs_fold_where_it_is_to_drive_fast():
    env = gym.make(DRIVE, fidelity="kinematic").unwrapped
    env.reset(seed=0)
    for legs, speed, knee in ((1.0, 0.3, 0.09), (1.0, 1.0, 0.0), (1.0, 0.3, 0.3), (1.0, 1.0, 0.6)):
        for _ in range(round(abs(knee - env.observe()["observation"][13]) / 0.03)):
            observation, *_ = env.step(np.array([speed, 0.0, legs], np.float32))
        assert observation["observation"][13] == pytest.approx(knee, abs=0.03)
        assert observation["observation"][4] < (1.6 if knee == 0.0 else 0.55)


def test_safe_levels_are_those_of_flat_ground():
    assert not drive("stairs").environment.safe
    with pytest.raises(hurcules.Error, match="safe: wanted flat ground, got stairs"):
        drive("stairs", safe=True)
