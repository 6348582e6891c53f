"""Experts of the environments, and what hold, constant and random actions reach.

Run:  python benchmarks/contact_environments.py [--seeds 40] [--fidelity exact] [--trivial] [NAME]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import gymnasium
import numpy as np
from numpy.typing import NDArray

import hurcules_envs  # noqa: F401  registers
from hurcules_envs.contact import ContactEnvironment
from hurcules_envs.drive import Drive
from hurcules_envs.environment import Environment, Numbers
from hurcules_envs.episodes import Episodes
from hurcules_envs.reach import Reach
from hurcules_envs.registry import make_environment

NAMES = ("Press", "Valve", "Door", "Carry", "Lift")
Policy = Callable[[Numbers], NDArray[np.float64]]


def outcome(
    environment: Environment, seeds: int, most: int, policy: Policy
) -> tuple[list[int], float]:
    """Seeds that did not succeed within so many steps, and the mean steps of those that did."""
    episodes = Episodes(environment, seeds, 0)
    episodes.generators = [np.random.default_rng(seed) for seed in range(seeds)]
    episodes.reset()
    episodes.look(remember=None)
    done, over, steps = np.zeros(seeds, bool), np.zeros(seeds, bool), np.zeros(seeds)
    for _ in range(most):
        goes_on = ~over
        episodes.step(np.clip(policy(episodes.numbers), -1.0, 1.0), goes_on)
        seen = episodes.look(remember=goes_on)
        steps += goes_on
        done |= seen.info["is_success"] & goes_on
        over |= done | seen.terminated
        if over.all():
            break
    return np.flatnonzero(~done).tolist(), float(steps[done].mean()) if done.any() else 0.0


def constant(action: NDArray[np.float64], seeds: int) -> Policy:
    """The same action always."""
    return lambda _: np.tile(action, (seeds, 1))


def trivial(size: int, seeds: int) -> dict[str, Policy]:
    """Hold, both ends of each number of the action, of all together, and random actions."""
    generator = np.random.default_rng(0)
    rows = [np.zeros(size), np.ones(size), -np.ones(size)]
    rows += [sign * row for row in np.eye(size) for sign in (1.0, -1.0)]
    policies = {str(row.astype(int).tolist()): constant(row, seeds) for row in rows}
    policies["random"] = lambda _: generator.uniform(-1.0, 1.0, (seeds, size))
    return policies


def main() -> None:
    """Prints a line a policy."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("names", nargs="*", default=NAMES)
    parser.add_argument("--seeds", type=int, default=40)
    parser.add_argument("--fidelity", default="exact")
    parser.add_argument("--trivial", action="store_true", help="hold, constant and random actions")
    given = parser.parse_args()
    for name in given.names:
        spec = gymnasium.spec(f"Hurcules/{name}-v0")
        environment = make_environment(spec.kwargs["environment"], {"fidelity": given.fidelity})
        assert isinstance(environment, ContactEnvironment | Reach | Drive)
        policies: dict[str, Policy] = {"expert": environment.expert}
        if given.trivial:
            size = len(Episodes(environment, 1, 1).action_scale)
            policies = trivial(size, given.seeds)
        for title, policy in policies.items():
            start = time.perf_counter()
            most = spec.max_episode_steps or 0
            missed, steps = outcome(environment, given.seeds, most, policy)
            print(
                f"{name:6} {given.fidelity:6} {title:28} {given.seeds - len(missed):3} of "
                f"{given.seeds} succeed, {steps:4.0f} steps, {time.perf_counter() - start:4.0f} s"
                f"{'  missed: ' + str(missed) if missed and not given.trivial else ''}",
                flush=True,
            )


if __name__ == "__main__":
    main()
