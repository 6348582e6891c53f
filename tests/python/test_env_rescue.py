"""Rescue-v0: what its actions add. What it has in common with Dispose-v0: test_env_missions.py."""

import pytest

import hurcules_envs  # noqa: F401  registers
from environments import action_of, single

NAME = "Hurcules/Rescue-v0"


def test_hands_that_are_led_up_rise() -> None:
    heights = []
    for given in ({}, {"up": 1.0}):
        env = single(NAME)
        env.reset(seed=1)
        for _ in range(20):
            env.step(action_of(env, **given))
        heights.append(env.numbers["position/L_tcp"][0, 2])
    assert heights[1] - heights[0] == pytest.approx(0.05, abs=0.01)
