"""Environments: steps a second, times real time, what Python adds, and vectors beside each other.

All of a table is measured in turns in one process; CPU time where one thread works, wall time where
two do. Numbers of a busy machine compare as ratios only.

Run:  python benchmarks/environments.py [--seconds 2] [--rounds 3]
"""

from __future__ import annotations

import argparse
import time
from collections.abc import Callable

import gymnasium
import numpy as np

import hurcules_envs

IDS = [name for name in hurcules_envs.ENVIRONMENTS if name != "Hurcules/Stretch-v0"]


def rate(step: Callable[[], None], seconds: float, clock: Callable[[], float]) -> float:
    """Calls a second."""
    for _ in range(3):
        step()
    count, start = 0, clock()
    while (spent := clock() - start) < seconds:
        step()
        count += 1
    return count / spent


def stepper(vector: gymnasium.vector.VectorEnv, seed: int) -> Callable[[], None]:
    """Random actions on a vector of environments."""
    vector.reset(seed=seed)
    generator = np.random.default_rng(seed)
    actions = generator.uniform(-1, 1, (64, *vector.action_space.shape)).astype(np.float32)
    turn = iter(range(10**9))
    return lambda: vector.step(actions[next(turn) % 64]) and None


def bare(vector: gymnasium.vector.VectorEnv, ticks: int) -> Callable[[], None]:
    """The same simulations without observation, reward and the rest."""
    vector.reset(seed=0)
    size = len(vector.batch[0].command_scale)
    commands = np.zeros((vector.num_envs, size))
    return lambda: vector.batch.step(ticks, commands)


def fidelities(name: str) -> list[str]:
    """Those that an environment has."""
    found = []
    for fidelity in ("exact", "fast", "kinematic"):
        try:
            gymnasium.make_vec(name, num_envs=1, fidelity=fidelity).close()
            found.append(fidelity)
        except ValueError:
            continue
    return found


def main() -> None:
    """Prints the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=1.0, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=3, help="the best of these counts")
    parser.add_argument("ids", nargs="*", default=IDS)
    wanted = parser.parse_args()

    def best(step: Callable[[], None], clock: Callable[[], float] = time.process_time) -> float:
        return max(rate(step, wanted.seconds, clock) for _ in range(wanted.rounds))

    print("16 episodes on one core: steps a second, times real time, and what is not simulation;")
    print("one episode: steps a second, and what is not simulation")
    row = "{:26} {:10} {:>10} {:>8} {:>9} | {:>9} {:>9}"
    print(
        row.format("environment", "fidelity", "steps/s", "x real", "us/step", "steps/s", "us/step")
    )
    for name in wanted.ids:
        for fidelity in fidelities(name):
            cells = []
            for n in (16, 1):
                vector = gymnasium.make_vec(name, num_envs=n, threads=1, fidelity=fidelity)
                period = 1.0 / vector.environment.rate
                ticks = round(period / vector.environment.simulation.dt)
                whole = best(stepper(vector, 0)) * n
                alone = best(bare(vector, ticks)) * n
                cells.append((whole, whole * period, 1e6 / whole - 1e6 / alone))
            (many, real, added), (one, _, alone_added) = cells
            print(row.format(name, fidelity, f"{many:.0f}", f"{real:.0f}", f"{added:.1f}",
                             f"{one:.0f}", f"{alone_added:.0f}"))  # fmt: skip

    print("\n16 episodes, wall time, steps a second: one thread, two, Gymnasium's Sync and Async")
    row = "{:26} {:10} {:>9} {:>9} {:>9} {:>9}"
    for name in wanted.ids[:1]:
        for fidelity in fidelities(name):
            cells = []
            for options in (
                {"threads": 1},
                {"threads": 2},
                {"vectorization_mode": "sync"},
                {"vectorization_mode": "async"},
            ):
                vector = gymnasium.make_vec(name, num_envs=16, fidelity=fidelity, **options)
                cells.append(best(stepper(vector, 0), time.perf_counter) * 16)
                vector.close()
            print(row.format(name, fidelity, *(f"{cell:.0f}" for cell in cells)))


if __name__ == "__main__":
    main()
