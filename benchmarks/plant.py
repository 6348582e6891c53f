"""The physics alone: how many times real time, and what a simulation takes in memory.

A robot stands on its brakes beside a person, no controller, 1 ms steps. Times are of the processor,
so that other programs disturb little; the least of several rounds.

    python benchmarks/plant.py [--seconds 2] [--rounds 5]
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import mujoco
from rich.console import Console
from rich.table import Table

import hurcules
from hurcules import models, scenes

POSTURES = ("drive", "ready")
COPIES = 20


def standing(robot: str, mass: int | None, posture: str) -> tuple[hurcules.Physics, float]:
    """A robot at rest on closed brakes, a person beside it or nobody; and its time step [s]."""
    model = (
        scenes.load("flat", robot) if mass is None else scenes.load("casualty", robot, mass=mass)
    )
    physics = hurcules.Physics(model, mujoco.MjData(model))
    physics.reset(posture)
    physics.brakes.reset(closed=True)
    physics.step(500)
    return physics, float(model.opt.timestep)


def times_real(physics: hurcules.Physics, dt: float, seconds: float, rounds: int) -> float:
    """Simulated time over processor time, the best round."""
    steps = round(seconds / dt)
    best = float("inf")
    for _ in range(rounds):
        begin = time.process_time()
        physics.step(steps)
        best = min(best, time.process_time() - begin)
    assert physics.is_sound
    return seconds / best


def resident() -> int:
    """[bytes] of memory that this process holds (Linux)."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * 4096


def memory() -> tuple[float, float]:
    """[MB] of a further simulation of the stretch: with a model of its own, and its data alone."""
    kept: list[object] = [hurcules.Simulation("stretch", 0, record=False)]
    begin = resident()
    for seed in range(COPIES):
        simulation = hurcules.Simulation("stretch", seed, record=False)
        simulation.step(50)
        kept.append(simulation)
    whole = (resident() - begin) / COPIES
    model = models.load("rescue")
    begin = resident()
    for _ in range(COPIES):
        data = mujoco.MjData(model)
        mujoco.mj_step(model, data)
        kept.append(data)
    return whole / 1e6, (resident() - begin) / COPIES / 1e6


def main() -> None:
    """Prints both."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=2.0, help="simulated, a round")
    parser.add_argument("--rounds", type=int, default=5)
    arguments = parser.parse_args()
    whole, data = memory()
    table = Table("robot", "person", "posture", "times real time")
    for robot in models.names():
        for mass in (None, 75, 120):
            for posture in POSTURES:
                physics, dt = standing(robot, mass, posture)
                speed = times_real(physics, dt, arguments.seconds, arguments.rounds)
                person = "none" if mass is None else f"{mass} kg"
                table.add_row(robot, person, posture, f"{speed:.1f}")
    console = Console()
    console.print(table)
    console.print(f"a simulation of the stretch: {whole:.1f} MB, of these a MjData: {data:.1f} MB")


if __name__ == "__main__":
    main()
