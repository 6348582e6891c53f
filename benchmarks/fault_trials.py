"""Provokes faults in a mission: trials that go on from the phases of one nominal run.

`rescue_faults.py` and `disposal_faults.py` say which faults; here is what they share. The nominal
run is done once and kept beside OUT.jsonl at the start of each phase. Each trial goes on from
there; its seed draws the phase, the moment and the direction. Trials that OUT.jsonl already holds
are left out.
"""

from __future__ import annotations

import argparse
from collections import Counter, defaultdict
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from sweeps import append, held

import hurcules
from hurcules import Mission

__all__ = [
    "Bench",
    "Trial",
    "direction",
    "emptied",
    "overrun",
    "shove",
    "slip",
    "with_rows",
    "with_weak",
]

FULL = hurcules.Condition(quantity="charge", above=False, value=1.0)
AFTER = 8.0  # [s] that a trial takes
TICKS = 20  # of the control between two looks
SLIPPERY = 0.02  # friction of wet ice

Row = dict[str, Any]
Random = np.random.Generator


@dataclass
class Trial:
    """A simulation in some phase, and what is done to it at each time since then [s]."""

    simulation: hurcules.Simulation
    phase: str
    act: Callable[[float], None] = field(default=lambda _: None)
    what: str = ""
    seconds: float = AFTER
    until: str = ""  # a phase that ends it, "": none


@dataclass(frozen=True)
class Bench:
    """A mission and its faults.

    Attributes:
        simulate: the mission as it stands.
        faults: by name, what makes a trial; the order decides what the seeds draw.
        body: which must not fall, with all that hangs on it.
        largest: columns of the log by the name under which a trial keeps their largest value.
        last: and their last one.
        safety: phases of the way to safety, in which a trial may take longer.
        safety_seconds: [s] so long.
        outcome: what came of a trial, in a word or two.
    """

    simulate: Callable[[], hurcules.Simulation]
    faults: Mapping[str, Callable[[Random], Trial]]
    body: str
    largest: Mapping[str, str]
    last: Mapping[str, str]
    safety: tuple[str, ...]
    safety_seconds: float
    outcome: Callable[[Row], str]

    def states(self, path: Path) -> dict[str, np.ndarray]:
        """The state at the start of each phase of the nominal run."""
        if not path.exists():
            simulation, found = self.simulate(), {}
            while not simulation.finished:
                found.setdefault(simulation.phase, simulation.state())
                simulation.step(TICKS)
            if not simulation.success:
                raise SystemExit(f"the nominal run failed: {simulation.reason}")
            np.savez_compressed(path, **found)
        with np.load(path) as file:
            return dict(file)

    def run(self, fault: str, seed: int, kept: Mapping[str, np.ndarray]) -> Row:
        """One trial: the phases that it went through, how it ended, how fast the body came down."""
        trial = self.faults[fault](np.random.default_rng([seed, list(self.faults).index(fault)]))
        simulation = trial.simulation
        simulation.restore(kept[trial.phase])
        largest = hurcules.Quantities(simulation, list(self.largest.values()))
        last = hurcules.Quantities(simulation, list(self.last.values()))
        body = simulation.model.body(self.body).id
        begin, phases = simulation.time, [simulation.phase]
        fastest, most = 0.0, np.zeros(len(self.largest))
        height = simulation.data.subtree_com[body, 2]
        while not simulation.finished:
            time = simulation.time - begin
            if phases[-1] == trial.until:
                break
            if time >= (self.safety_seconds if phases[-1] in self.safety else trial.seconds):
                break
            trial.act(time)
            simulation.step(TICKS)
            now = simulation.data.subtree_com[body, 2]
            fastest, height = max(fastest, (height - now) / (TICKS * simulation.dt)), now
            most = np.maximum(most, simulation.read(largest))
            if simulation.phase != phases[-1]:
                phases.append(simulation.phase)
        return {
            "fault": fault,
            "seed": seed,
            "what": trial.what,
            "phases": phases,
            "finished": simulation.finished,
            "reason": simulation.reason,
            "seconds": simulation.time - begin,
            "down_mps": fastest,
            "height_m": float(height),
            "robot_fell": simulation.reason.startswith("fell"),
            **dict(zip(self.largest, most.tolist(), strict=True)),
            **dict(zip(self.last, simulation.read(last).tolist(), strict=True)),
        }

    def show(self, path: Path) -> None:
        """How often what came of each fault."""
        table: dict[str, Counter[str]] = defaultdict(Counter)
        for trial in held(path):
            table[trial["fault"]][self.outcome(trial)] += 1
        for fault, counts in table.items():
            print(f"{fault:8} {', '.join(f'{word} {n}' for word, n in counts.most_common())}")

    def _words(self, trial: Row) -> tuple[Any, ...]:
        what = trial["fault"], trial["seed"], trial["what"]
        return (*what, self.outcome(trial), trial["reason"])

    def main(self, text: str, first: int = 0) -> None:
        """Runs what is missing.

        Args:
            text: what the program says of itself.
            first: of the seeds.
        """
        parser = argparse.ArgumentParser(description=text.splitlines()[0])
        parser.add_argument("out", type=Path)
        parser.add_argument("--faults", default=",".join(self.faults))
        parser.add_argument("--seeds", type=int, default=5)
        parser.add_argument("--show", action="store_true")
        arguments = parser.parse_args()
        if not arguments.show:
            kept = self.states(arguments.out.with_suffix(".npz"))
            done = {(trial["fault"], trial["seed"]) for trial in held(arguments.out)}
            trials = (
                self.run(fault, seed, kept)
                for seed in range(first, first + arguments.seeds)
                for fault in arguments.faults.split(",")
                if (fault, seed) not in done
            )
            append(arguments.out, trials, self._words)
        self.show(arguments.out)


def direction(random: Random) -> np.ndarray:
    """Some way along the ground, (3) of length 1."""
    angle = random.uniform(-np.pi, np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def shove(
    simulation: hurcules.Simulation,
    random: Random,
    phases: tuple[str, ...],
    body: str,
    force: float,
) -> Trial:
    """A force [N] on a body for half a second, in one of the phases."""
    phase = str(random.choice(phases))
    start, along = random.uniform(0.3, 2.5), direction(random)

    def act(time: float) -> None:
        on = start <= time < start + 0.5
        simulation.data.body(body).xfrc_applied[:3] = force * along * on

    what = f"at {start:.1f} s, {np.degrees(np.arctan2(along[1], along[0])):.0f} degrees"
    return Trial(simulation, phase, act, what)


def overrun(simulation: hurcules.Simulation, random: Random, phases: tuple[str, ...]) -> Trial:
    """A tick of the control takes 20 to 100 ms: so long the motors get what they had."""
    phase = str(random.choice(phases))
    start, late = random.uniform(0.3, 2.5), int(random.integers(20, 101))
    over = False

    def act(time: float) -> None:
        nonlocal over
        if time >= start and not over:
            over = True
            simulation.plant.step(late)  # of 1 ms

    return Trial(simulation, phase, act, f"{late} ms at {start:.1f} s")


def slip(
    simulation: hurcules.Simulation,
    random: Random,
    phases: tuple[str, ...],
    seconds: float,
    friction: float = SLIPPERY,
) -> Trial:
    """Ground as smooth as wet ice, in phases that are to take less than so many seconds.

    The larger friction of two geoms rules, so that the tracks' own 0.01 is made smaller too.
    """
    phase = str(random.choice(phases))
    model, start = simulation.model, random.uniform(0.0, 2.0)
    geoms = [
        i
        for i in range(model.ngeom)
        if model.geom(i).name == "floor" or model.body(model.geom_bodyid[i]).name.endswith("_track")
    ]
    own = model.geom_friction[geoms, 0]

    def act(time: float) -> None:
        model.geom_friction[geoms, 0] = np.minimum(own, friction) if time >= start else own

    return Trial(simulation, phase, act, f"at {start:.1f} s", seconds=seconds)


def with_weak(model: mujoco.MjModel, joint: str, share: float) -> mujoco.MjModel:
    """The model, in which the motor of a joint gives a share of its torque."""
    motor = model.actuator_trnid[: model.nu, 0].tolist().index(model.joint(joint).id)
    model.actuator_forcerange[motor] *= share
    return model


def with_rows(mission: Mission, change: Callable[[hurcules.Phase], None]) -> Mission:
    """The mission with rows that are changed in place."""
    phases = mission.rows.phases
    for row in phases:
        change(row)
    table = hurcules.MissionTable(
        phases=phases, safety=mission.rows.safety, measures=mission.rows.measures
    )
    return Mission(mission.setup, table)


def emptied(mission: Mission) -> Mission:
    """A battery as good as empty: what counts as that is all that it can have."""

    def change(row: hurcules.Phase) -> None:
        row.troubles = [
            hurcules.Trouble(when=FULL, reactions=trouble.reactions)
            if trouble.when.quantity == "charge"
            else trouble
            for trouble in row.troubles
        ]

    return with_rows(mission, change)
