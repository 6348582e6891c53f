"""Environments: steps a second, times real time, what Python adds, and vectors beside each other.

All of a table is measured in turns in one process; CPU time where one thread works, wall time where
two do. Numbers of a busy machine compare as ratios only: `--figures` gives medians over rounds in
which everything that is compared takes its turn.

Run:  python benchmarks/environments.py [--seconds 2] [--rounds 3] [IDS]
      python benchmarks/environments.py --figures [--seconds 1] [--rounds 9] [memory stretch ...]
"""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from statistics import median
from typing import Any
from unittest.mock import patch

import gymnasium
import mujoco
import numpy as np
from mujoco import rollout

import hurcules
import hurcules_envs
from hurcules import scenes
from hurcules_envs.stretch_goal import DISTANCE, LATERAL, Stretch
from hurcules_envs.vector import NativeVectorEnv

IDS = [name for name in hurcules_envs.ENVIRONMENTS if name != "Hurcules/Stretch-v0"]
REACH = "Hurcules/Reach-v0"
Clock = Callable[[], float]
Step = Callable[[], None]


class LimpStretch(Stretch):
    """`Stretch-v1` before a person who has joints."""

    @staticmethod
    def _spec() -> mujoco.MjSpec:
        return scenes.make(
            "casualty", robot="rescue", mass=75, lying="back", distance=DISTANCE, lateral=LATERAL
        )

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Any]) -> None:
        """He lies where the scene has him."""


def rate(step: Step, seconds: float, clock: Clock) -> float:
    """Calls a second."""
    for _ in range(3):
        step()
    count, start = 0, clock()
    while (spent := clock() - start) < seconds:
        step()
        count += 1
    return count / spent


def rates(steps: Mapping[str, Step], clock: Clock, wanted: argparse.Namespace) -> dict[str, Any]:
    """By name calls a second in each round, all in turn."""
    rounds = [
        {name: rate(step, wanted.seconds, clock) for name, step in steps.items()}
        for _ in range(wanted.rounds)
    ]
    return {name: np.array([one[name] for one in rounds]) for name in steps}


def stepper(vector: gymnasium.vector.VectorEnv, seed: int) -> Step:
    """Random actions on a vector of environments."""
    vector.reset(seed=seed)
    generator = np.random.default_rng(seed)
    actions = generator.uniform(-1, 1, (64, *vector.action_space.shape)).astype(np.float32)
    turn = iter(range(10**9))
    return lambda: vector.step(actions[next(turn) % 64]) and None


def bare(vector: gymnasium.vector.VectorEnv, ticks: int) -> Step:
    """The same simulations at the same commands without observation, reward and the rest."""
    vector.reset(seed=0)
    names = list(vector.batch[0].command_names)
    places = [names.index(name) for name in vector.action_names if name in names]
    generator = np.random.default_rng(0)
    commands = np.zeros((64, vector.num_envs, len(names)))
    if len(places) == len(vector.action_names):  # else an environment turns its actions: hold
        drawn = generator.uniform(-1, 1, (64, vector.num_envs, len(places)))
        commands[:, :, places] = drawn * vector.action_scale
    turn, steps = iter(range(10**9)), int(20 / (ticks * vector.batch[0].dt))

    def step() -> None:
        k = next(turn)
        if k % steps == steps - 1:  # an episode of 20 s, as the environment would end it
            vector.reset(seed=k)
        vector.batch.step(ticks, commands[k % 64])

    return step


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


def tables(wanted: argparse.Namespace) -> None:
    """Prints the tables of all environments."""

    def best(step: Step, clock: Clock = time.process_time) -> float:
        return max(rate(step, wanted.seconds, clock) for _ in range(wanted.rounds))

    print("16 episodes on one core: steps a second, times real time, and what is not simulation;")
    print("one episode: steps a second, and what is not simulation")
    row = "{:26} {:10} {:>10} {:>8} {:>9} | {:>9} {:>9}"
    print(
        row.format("environment", "fidelity", "steps/s", "x real", "us/step", "steps/s", "us/step")
    )
    for name in wanted.ids or IDS:
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
    for name in (wanted.ids or IDS)[:1]:
        for fidelity in fidelities(name):
            vectors = beside_gymnasium(name, fidelity)
            cells = [best(stepper(v, 0), time.perf_counter) * 16 for v in vectors.values()]
            for vector in vectors.values():
                vector.close()
            print(row.format(name, fidelity, *(f"{cell:.0f}" for cell in cells)))


def beside_gymnasium(name: str, fidelity: str) -> dict[str, gymnasium.vector.VectorEnv]:
    """16 episodes each way."""
    ways: dict[str, dict[str, Any]] = {
        "one thread": {"threads": 1},
        "two threads": {"threads": 2},
        "Sync": {"vectorization_mode": "sync"},
        "Async": {"vectorization_mode": "async"},
    }
    return {
        way: gymnasium.make_vec(name, num_envs=16, fidelity=fidelity, **options)
        for way, options in ways.items()
    }


def show(what: str, values: np.ndarray, unit: str, digits: int = 2) -> None:
    """A figure: the median of its rounds, the least and the largest."""
    least, most = values.min(), values.max()
    print(f"{what:62} {median(values):9.{digits}f} {unit:8} "
          f"({least:.{digits}f} to {most:.{digits}f})", flush=True)  # fmt: skip


def stretch_figures(wanted: argparse.Namespace) -> None:
    """The scene of the stretch with a limp person, a frozen one, and at 4 ms."""
    kinds = {
        "limp": (f"{__name__}:LimpStretch", "exact"),
        "frozen": ("hurcules_envs.stretch_goal:Stretch", "exact"),
        "fast": ("hurcules_envs.stretch_goal:Stretch", "fast"),
    }
    vectors = {k: NativeVectorEnv(path, 4, 100, 1, fidelity=f) for k, (path, f) in kinds.items()}
    found = rates({k: stepper(v, 0) for k, v in vectors.items()}, time.process_time, wanted)
    for kind, values in found.items():
        show(f"stretch, {kind}: times real time, a core", values * 4 * 0.05, "", 1)
    show("stretch, exact: person frozen against limp", found["frozen"] / found["limp"], "x")
    show("stretch: fast against exact with him limp", found["fast"] / found["limp"], "x")


def reach_figures(wanted: argparse.Namespace) -> None:
    """Reach without physics on one core: whole steps, the simulations alone, and Python's part."""
    for n in (1, 16, 256):
        vector = gymnasium.make_vec(REACH, num_envs=n, threads=1, fidelity="kinematic")
        plain = gymnasium.make_vec(REACH, num_envs=n, threads=1, fidelity="kinematic", safe=False)
        ticks = round(1.0 / vector.environment.rate / vector.environment.simulation.dt)
        steps = {"whole": stepper(vector, 0), "bare": bare(vector, ticks)}
        steps["plain"] = stepper(plain, 0)
        found = rates(steps, time.process_time, wanted)
        show(f"Reach kinematic, {n} episodes: steps, a core", found["whole"] * n, "/s", 0)
        show(f"Reach kinematic, {n} episodes, safe=False", found["plain"] * n, "/s", 0)
        show(f"Reach kinematic, {n} episodes: simulation and control alone", found["bare"] * n,
             "/s", 0)  # fmt: skip
        show(f"Reach kinematic, {n} episodes: Python and reading, a step and episode",
             1e6 / n * (1.0 / found["whole"] - 1.0 / found["bare"]), "us", 1)  # fmt: skip


def tick_figures(wanted: argparse.Namespace) -> None:
    """A tick of the controller, from what is sensed to the servo, by the clock of the loop."""
    for name, fidelity in ((REACH, "exact"), ("Hurcules/Stretch-v1", "exact")):
        with patch.object(hurcules, "Simulation", partial(hurcules.Simulation, timed=True)):
            vector = gymnasium.make_vec(name, num_envs=1, threads=1, fidelity=fidelity)
        timed = vector.environment.simulation
        scale = np.array(timed.command_scale)
        generator, medians = np.random.default_rng(0), []
        for _ in range(wanted.rounds):
            timed.reset()
            for _ in range(20):
                timed.step(50, generator.uniform(-1, 1, scale.shape) * np.minimum(scale, 0.3))
            stages = timed.timings()
            spent = sum(stages[s] for s in ("sense", "kinematics", "hierarchy", "solve", "servo"))
            medians.append(1e6 * float(np.median(spent)))
        show(f"{name} {fidelity}: controller, median of its ticks", np.array(medians), "us", 1)


def thread_figures(wanted: argparse.Namespace) -> None:
    """Two threads against one, and what the machine gives two processes of their own."""
    for fidelity in ("kinematic", "fast"):
        vectors = beside_gymnasium(REACH, fidelity)
        found = rates({k: stepper(v, 0) for k, v in vectors.items()}, time.perf_counter, wanted)
        for vector in vectors.values():
            vector.close()
        one = found["one thread"]
        show(f"Reach {fidelity}, 16 episodes: two threads against one", found["two threads"] / one,
             "x")  # fmt: skip
        for way in ("Sync", "Async"):
            better = np.maximum(one, found["two threads"])
            show(f"Reach {fidelity}, 16 episodes: native against {way}", better / found[way], "x")
    command = [sys.executable, str(Path(__file__)), "--worker", "--seconds", str(wanted.seconds)]
    ceiling = []
    for _ in range(wanted.rounds):
        alone = workers(command, 1)
        ceiling.append(workers(command, 2) / alone)
    show("ceiling: two processes, one episode's vector each, against one", np.array(ceiling), "x")


def core_figures(wanted: argparse.Namespace) -> None:
    """64 episodes on 1, 2, 4, ... threads, and MuJoCo's own rollout of the same model beside it."""
    counts = [1]
    while 2 * counts[-1] <= len(os.sched_getaffinity(0)):
        counts.append(2 * counts[-1])
    for fidelity in ("kinematic", "fast"):
        make = partial(gymnasium.make_vec, REACH, num_envs=64, fidelity=fidelity)
        vectors = {n: make(threads=n) for n in counts}
        simulation = vectors[1].environment.simulation
        spec = mujoco.mjtState.mjSTATE_FULLPHYSICS
        start = np.empty((64, mujoco.mj_stateSize(simulation.model, spec)))
        for row in start:
            mujoco.mj_getState(simulation.model, simulation.data, row, spec)
        pools = {n: rollout.Rollout(nthread=n) for n in counts}
        datas = [mujoco.MjData(simulation.model) for _ in range(max(counts))]

        def physics(n: int, start: Any = start, model: Any = simulation.model,
                    pools: Any = pools, datas: Any = datas) -> None:  # fmt: skip
            pools[n].rollout([model] * 64, datas[:n], start, nstep=12)

        steps = {("steps", n): stepper(vector, 0) for n, vector in vectors.items()}
        steps |= {("rollout", n): partial(physics, n) for n in counts}
        found = rates(steps, time.perf_counter, wanted)
        for n in counts:
            own, peer = found["steps", n], found["rollout", n]
            show(f"Reach {fidelity}, 64 episodes, {n} threads: steps", 64 * own, "/s", 0)
            show("    against one thread", own / found["steps", 1], "x")
            show("    mujoco.rollout of the model alone, against one thread",
                 peer / found["rollout", 1], "x")  # fmt: skip


def workers(command: list[str], count: int) -> float:
    """Steps a second of so many processes at once, together."""
    started = [
        subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
        for _ in range(count)
    ]
    for one in started:  # all are ready before one begins
        assert one.stdout is not None
        one.stdout.readline()
    for one in started:
        assert one.stdin is not None
        one.stdin.write("go\n")
        one.stdin.flush()
    return sum(float(one.communicate()[0]) for one in started)


def work(wanted: argparse.Namespace) -> None:
    """One of them."""
    step = stepper(gymnasium.make_vec(REACH, num_envs=16, threads=1, fidelity="kinematic"), 0)
    print("ready", flush=True)
    sys.stdin.readline()
    print(rate(step, wanted.seconds, time.perf_counter), flush=True)


def memory_figures(wanted: argparse.Namespace) -> None:
    """Memory that an episode takes beside the first ones."""
    for name, fidelity in ((REACH, "kinematic"), (REACH, "fast"), ("Hurcules/Drive-v0", "fast"),
                           ("Hurcules/Lift-v0", "fast")):  # fmt: skip
        few = gymnasium.make_vec(name, num_envs=4, threads=1, fidelity=fidelity)
        stepper(few, 0)()
        before = resident()
        many = gymnasium.make_vec(name, num_envs=64, threads=1, fidelity=fidelity)
        stepper(many, 0)()
        show(f"{name} {fidelity}: an episode", np.array([(resident() - before) / 64]), "MB")


def resident() -> float:
    """[MB] of this process."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096 / 1e6


def collection_figures(wanted: argparse.Namespace) -> None:
    """Stable-Baselines3 collecting for PPO against the same vector with random actions."""
    from stable_baselines3.common.callbacks import ConvertCallback

    from hurcules_envs.sb3 import make_sb3
    from hurcules_envs.training import TrainOptions, make_model

    torch_threads()
    for episodes in (16, 64):
        vector = make_sb3(REACH, episodes, threads=1, fidelity="kinematic")
        model = make_model(TrainOptions(REACH), vector)
        model._setup_learn(1, None)
        callback = ConvertCallback(None)
        callback.init_callback(model)

        def collect(model: Any = model, callback: Any = callback) -> None:
            model.collect_rollouts(model.env, callback, model.rollout_buffer, model.n_steps)

        raw = stepper(
            gymnasium.make_vec(REACH, num_envs=episodes, threads=1, fidelity="kinematic"), 0
        )

        def steps(raw: Step = raw, n: int = model.n_steps) -> None:
            for _ in range(n):
                raw()

        found = rates({"sb3": collect, "raw": steps}, time.process_time, wanted)
        show(f"SB3 collection against the raw vector, {episodes} episodes",
             found["sb3"] / found["raw"], "x")  # fmt: skip


def torch_threads() -> None:
    """One: the machine's other cores are not measured."""
    import torch

    torch.set_num_threads(1)


FIGURES: dict[str, Callable[[argparse.Namespace], None]] = {
    "memory": memory_figures,
    "stretch": stretch_figures,
    "reach": reach_figures,
    "tick": tick_figures,
    "threads": thread_figures,
    "cores": core_figures,
    "collection": collection_figures,
}


def main() -> None:
    """Prints the tables, or the figures of docs/environments.md."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=1.0, help="of each measurement")
    parser.add_argument("--rounds", type=int, default=3, help="the best of these counts")
    parser.add_argument("--figures", action="store_true", help="the figures of the page instead")
    parser.add_argument("--worker", action="store_true", help=argparse.SUPPRESS)
    parser.add_argument("ids", nargs="*", help="of environments, or of --figures: "
                        + ", ".join(FIGURES))  # fmt: skip
    wanted = parser.parse_args()
    if wanted.worker:
        return work(wanted)
    if not wanted.figures:
        return tables(wanted)
    for name in wanted.ids or FIGURES:
        FIGURES[name](wanted)
    return None


if __name__ == "__main__":
    main()
