"""Hands that hang in springs swing without physics as they do in it.

Strategy: the oscillator against small steps of its equation; hands that are fed back at a gain
below and above the one where the springs of the rescue robot begin to swing for ever, measured in
the physics and without it. Strong motors on stiff springs do not swing. Lower arms keep
more than firm parts; an episode of random actions in which one used to hit the head.
"""

import gymnasium as gym
import mujoco
import numpy as np
import pytest

import hurcules_envs  # noqa: F401  registers
from hurcules_envs.robots import load_robot
from hurcules_envs.safety import FIRM
from hurcules_envs.springs import Spring, softest_spring


@pytest.mark.parametrize("damping", [0.0, 0.27, 3.0])
def test_a_deflection_decays_as_its_equation_says(damping):
    spring = Spring(18.0, damping)
    free, steps = spring.free(0.05), 20_000
    for start in ([1.0, 0.0], [0.0, 1.0]):
        e, rate = start
        for _ in range(steps):
            rate -= 0.05 / steps * (2 * damping * 18.0 * rate + 18.0**2 * e)
            e += 0.05 / steps * rate
        np.testing.assert_allclose(free @ start, [e, rate], rtol=1e-3, atol=1e-3)


def test_the_spring_is_that_of_the_model():
    found = {}
    for name in ("rescue", "manipulation"):
        setup = load_robot(name)
        data = mujoco.MjData(setup.model)
        data.qpos[:] = setup.robot().qpos
        mujoco.mj_forward(setup.model, data)
        found[name] = softest_spring(setup.model, data)
    # lower arm and scoop about the elbow: 11.5 kg at 0.30 m, 0.5 kg m^2 about its centre
    assert found["rescue"].frequency == pytest.approx(
        np.sqrt(500 / (11.5 * 0.3**2 + 0.5)), rel=0.02
    )
    assert found["manipulation"].frequency > 100.0


@pytest.mark.parametrize("fidelity", ["kinematic", "fast"])
def test_hands_settle_at_a_moderate_gain_and_swing_at_a_high_one(fidelity):
    errors = {}
    for gain in (4.0, 12.0):
        env = gym.make_vec("Hurcules/Reach-v0", num_envs=8, fidelity=fidelity)
        observation, _ = env.reset(seed=5)
        late = []
        for step in range(80):
            way = observation["desired_goal"] - observation["achieved_goal"]
            observation, *_ = env.step(np.clip(gain * way / 0.3, -1, 1).astype(np.float32))
            if step >= 60:
                late.append(np.abs(way).max(axis=1))
        errors[gain] = np.median(late)
        env.close()
    assert errors[4.0] < 0.01
    assert errors[12.0] > 0.03


@pytest.mark.parametrize("fidelity", ["fast", "exact"])
def test_hands_stay_where_they_start_while_nothing_is_commanded(fidelity):
    # springs that started without load let them sink by up to 53 mm; what is left is the suspension
    env = gym.make_vec("Hurcules/Reach-v0", num_envs=8, fidelity=fidelity)
    start, _ = env.reset(seed=0)
    for _ in range(20):
        seen, *_ = env.step(np.zeros(env.action_space.shape, np.float32))
        assert np.abs(seen["achieved_goal"] - start["achieved_goal"]).max() < 0.01
    env.close()


@pytest.mark.parametrize(
    ("name", "watched"), [("Stretch-v1", slice(None)), ("Lift-v0", slice(0, 4))]
)
def test_the_first_observation_is_measured(name, watched):
    # margins of monitors and readings of sensors were 0 until the first step
    env = gym.make(f"Hurcules/{name}", fidelity="fast")
    first, _ = env.reset(seed=0)
    then, *_ = env.step(np.zeros(env.action_space.shape, np.float32))
    np.testing.assert_allclose(first[watched], then[watched], atol=0.01)


def test_lower_arms_keep_more_than_firm_parts_and_have_rows_of_their_own():
    setup = load_robot("rescue")
    robot = setup.robot()
    kept = {task.name: task for task in setup.safety.levels(robot)[-1]}
    for name, task in kept.items():
        pairs = task.pairs(robot)
        hangs = [any("scoop" in geom for geom in pair) for pair in pairs]
        assert pairs
        assert all(hangs) if "springs" in name else not any(hangs)
        assert set(task.lower) == {setup.safety.apart_by if "springs" in name else FIRM["rescue"]}
        assert (task.error >= task.lower).all()  # as it stands, none has to move
    every = [set(pair) for pair in setup.safety.apart().pairs(robot) if "scoop" in "".join(pair)]
    assert len(every) == len(kept["self_collision in springs"].pairs(robot))


def test_a_hand_that_comes_fast_is_seen_in_time():
    """Benchmark random_actions, uniform, seed 300, episode 4: a hand hit the head by 6 mm."""
    random = np.random.default_rng(301)
    random.random((3, 16, 6))  # what frequencies and phases take
    env = gym.make_vec("Hurcules/Reach-v0", num_envs=1, fidelity="fast", max_episode_steps=400)
    env.reset(seed=304)
    nearest = []
    for step in range(170):
        if step % 10 == 0:
            action = random.uniform(-1.0, 1.0, (16, 6))[4:5]
        *_, info = env.step(action.astype(np.float32))
        nearest.append(info["self_distance"][0])
        assert info["self_contacts"][0] == 0
    assert min(nearest) > 0.015
    env.close()
