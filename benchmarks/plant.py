"""The physics alone: how many times real time, and what a simulation takes in memory.

A robot stands on its brakes beside a person, no controller, 1 ms steps; or it turns in place, where
every contact of its tracks slides. Times are of the processor, so that other programs disturb
little; the least of several rounds. A standing robot is stepped in turn with MuJoCo's own mj_step
on the same model, its brakes as dry friction, its belts without traction: what remains below us.

    python benchmarks/plant.py [--seconds 2] [--rounds 5]
"""

from __future__ import annotations

import argparse
import copy
import time
from collections.abc import Callable
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import mujoco
from rich.console import Console
from rich.table import Table

import hurcules
from hurcules import models, scenes

POSTURES = ("drive", "ready")
COPIES = 20
# on a driven belt: turns either robot in place at about 0.6 rad/s, against damping
BELT_TORQUE = 500.0  # [N m]
BELT_DAMPING = 100.0  # [N m s/rad]


@dataclass
class Plant:
    """A robot at rest on closed brakes or turning in place, a person beside it or nobody."""

    robot: str
    mass: int | None
    posture: str
    turning: bool

    def __post_init__(self) -> None:
        scene, values = ("casualty", {"mass": self.mass}) if self.mass else ("flat", {})
        self.model = scenes.load(scene, self.robot, **values)
        self.data = mujoco.MjData(self.model)
        self.physics = hurcules.Plant(self.model, self.data)
        self.physics.reset(self.posture)
        self.physics.brakes.reset(closed=True)
        if self.turning:
            self._turn()
        self.physics.step(500)

    def _turn(self) -> None:
        for side, torque in (("L", -BELT_TORQUE), ("R", BELT_TORQUE)):
            belt = f"{side}_lower_belt"
            self.model.dof_damping[self.model.joint(belt).dofadr] = BELT_DAMPING
            self.physics.brakes.set_closed(belt, False)
            self.data.actuator(f"{side}_drive").ctrl = torque

    def braked(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """The same model and state with all brakes as dry friction of the joints."""
        model, brakes = copy.copy(self.model), self.physics.brakes
        for joint in brakes.names:
            model.dof_frictionloss[model.joint(joint).dofadr] = brakes.max_load(joint)
        return model, copy.copy(self.data)


def seconds_of(action: Callable[[], object]) -> float:
    """[s] of processor time that this takes."""
    begin = time.process_time()
    action()
    return time.process_time() - begin


def times_real(plant: Plant, seconds: float, rounds: int) -> tuple[float, float]:
    """Simulated time over processor time, the best round: of our step, of mj_step alone."""
    model, data = plant.braked()
    steps = round(seconds / model.opt.timestep)
    ours = bare = float("inf")
    for _ in range(rounds):
        ours = min(ours, seconds_of(lambda: plant.physics.step(steps)))
        bare = min(bare, seconds_of(lambda: mujoco.mj_step(model, data, steps)))
    assert plant.physics.is_sound
    return seconds / ours, seconds / bare


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
    table = Table("robot", "person", "posture", "motion", "times real time", "mj_step alone")
    for robot, mass, posture in product(models.names(), (None, 75, 120), POSTURES):
        for turning in (False, True) if posture == "drive" else (False,):
            plant = Plant(robot, mass, posture, turning)
            ours, bare = times_real(plant, arguments.seconds, arguments.rounds)
            person = f"{mass} kg" if mass else "none"
            motion, floor = ("turns", "") if turning else ("stands", f"{bare:.1f}")
            table.add_row(robot, person, posture, motion, f"{ours:.1f}", floor)
    console = Console()
    console.print(table)
    console.print(f"a simulation of the stretch: {whole:.1f} MB, of these a MjData: {data:.1f} MB")


if __name__ == "__main__":
    main()
