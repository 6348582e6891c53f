"""Dispose-v0: in which phases an action leads which joints.

What it has in common with Rescue-v0: test_env_missions.py.
"""

import numpy as np
import pytest

import hurcules_envs  # noqa: F401  registers
from environments import action_of, single

NAME = "Hurcules/Dispose-v0"


@pytest.mark.parametrize(
    "phase, led",
    [
        ("approach", {"joints": {"HIP"}}),  # arms rest behind their brakes
        ("lean forward", {"joints": {"HIP", "LSP", "RSP"}}),
        ("lift", {}),  # the hands are led
        ("raise", {"posture": {"HIP", "LSP", "RSP"}}),
    ],
)
def test_joints_are_led_where_no_stack_of_hands_rules(phase: str, led: dict) -> None:
    env = single(NAME)
    env.reset(seed=0)
    environment, numbers = env.environment, env.numbers
    numbers._values = numbers._values.copy()  # to be written to
    numbers["phase"][:] = environment.simulation.phases.index(phase)
    parts = {name: np.zeros((1, 1)) for name in environment.actions}
    parts |= {"hands": np.zeros((1, 3)), "tracks": np.zeros((1, 2))}
    parts |= {"lean": np.full((1, 1), 0.1), "shoulders": np.full((1, 1), -0.1)}
    given = environment.command(parts, numbers)
    names = environment.simulation.controller.plan.coordinate_names
    joints = [
        name.removeprefix("joints_")
        for name in environment.simulation.command_names
        if name.startswith("joints_")
    ]
    found = {
        channel: {one for one, rate in zip(all_of, given[channel][0], strict=True) if rate != 0.0}
        for channel, all_of in (("joints", joints), ("posture", names))
    }
    assert found == {"joints": set(), "posture": set()} | led


def test_fingers_that_are_led_close() -> None:
    places = []
    for given in ({}, {"squeeze": 1.0}):
        env = single(NAME)
        env.reset(seed=1)
        for _ in range(20):
            env.step(action_of(env, **given))
        joint = env.environment.simulation.model.joint("L_grip_1")
        places.append(env.qpos[joint.qposadr[0]])
    assert places[1] - places[0] == pytest.approx(0.002, abs=0.0005)
