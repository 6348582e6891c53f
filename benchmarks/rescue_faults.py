"""Provokes troubles and faults in the mission `casualty`: one line of JSON a trial.

    python benchmarks/rescue_faults.py OUT.jsonl [--faults push,moved,...] [--seeds 5] [--show]

A nominal run (75 kg, everything as expected) is done once and kept beside OUT.jsonl at the start of
each phase. Each trial goes on from there: the seed draws the phase, the moment and the direction.
It ends 8 s later (`slip`: 18 s), or when the person has been laid down. Trials that OUT.jsonl
already holds are left out.
"""

from __future__ import annotations

import argparse
import json
from collections import Counter, defaultdict
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

import hurcules
from hurcules import Mission, lift

CARRIED = ("raise", "carry", "sit down", "fold the right leg", "turn to the right")
SEATED = ("lay down", "home")
STANDING = ("lift", "raise", "carry")
MOTORS = ("LEB", "REB", "HIP", "LKN", "LSP")
DEAD_CELL = "casualty_force_skull"  # a force that stays at 0
FULL = hurcules.Condition(quantity="charge", above=False, value=1.0)
AFTER, LOWERING = 8.0, 35.0  # [s]


@dataclass
class Trial:
    """A simulation in some phase, and what is done to it at each time since then [s]."""

    simulation: hurcules.Simulation
    phase: str
    act: Callable[[float], None] = field(default=lambda _: None)
    what: str = ""
    seconds: float = AFTER


def simulate(
    model: mujoco.MjModel | None = None, mission: Mission | None = None
) -> hurcules.Simulation:
    """The mission, maybe with a model or a table of one's own."""
    model = model or lift.model(lift.Person())
    return hurcules.Simulation(
        mission or lift.mission("casualty"),
        model=model,
        controller=lift.controller(model),
        variation=0.0,
        record=False,
    )


def states(path: Path) -> dict[str, np.ndarray]:
    """The state at the start of each phase of the nominal run."""
    if not path.exists():
        simulation, found = simulate(), {}
        while not simulation.finished:
            found.setdefault(simulation.phase, simulation.state())
            simulation.step(20)
        if not simulation.success:
            raise SystemExit(f"the nominal run failed: {simulation.reason}")
        np.savez_compressed(path, **found)
    with np.load(path) as file:
        return dict(file)


def direction(random: np.random.Generator) -> np.ndarray:
    """Some way along the ground, (3) of length 1."""
    angle = random.uniform(-np.pi, np.pi)
    return np.array([np.cos(angle), np.sin(angle), 0.0])


def shove(random: np.random.Generator, phases: tuple[str, ...], body: str, force: float) -> Trial:
    """A force for half a second."""
    simulation, phase = simulate(), str(random.choice(phases))
    start, along = random.uniform(0.3, 2.5), direction(random)

    def act(time: float) -> None:
        on = start <= time < start + 0.5
        simulation.data.body(body).xfrc_applied[:3] = force * along * on

    what = f"at {start:.1f} s, {np.degrees(np.arctan2(along[1], along[0])):.0f} degrees"
    return Trial(simulation, phase, act, what)


def push(random: np.random.Generator) -> Trial:
    """200 N on the trunk."""
    return shove(random, CARRIED + SEATED, "torso", 200.0)


def moved(random: np.random.Generator) -> Trial:
    """150 N on the chest of the person, half of whom weighs 370 N."""
    return shove(random, STANDING, "casualty_thorax", 150.0)


def thrown(random: np.random.Generator) -> Trial:
    """300 N: as much as no friction holds."""
    return shove(random, STANDING, "casualty_thorax", 300.0)


def weakened(joint: str, share: float) -> mujoco.MjModel:
    """The scene, in which the motor of a joint gives a share of its torque."""
    model = lift.model(lift.Person())
    motor = model.actuator_trnid[: model.nu, 0].tolist().index(model.joint(joint).id)
    model.actuator_forcerange[motor] *= share
    return model


def weak(random: np.random.Generator, share: float = 0.7) -> Trial:
    """A motor gives 70 % of its torque from the lift on."""
    motor = str(random.choice(MOTORS))
    return Trial(simulate(weakened(motor, share)), "lift", what=motor)


def failing(random: np.random.Generator) -> Trial:
    """30 %."""
    return weak(random, 0.3)


def deafen(simulation: hurcules.Simulation, side: str) -> None:
    """The force sensor of the arm "L" or "R" reads 0 from now on."""
    controller = simulation.controller
    controller.sense(controller.task(f"{side}_press"), DEAD_CELL)


def deaf(random: np.random.Generator) -> Trial:
    """A force sensor reads 0."""
    simulation, side = simulate(), str(random.choice(("L", "R")))
    phase = str(random.choice(("press", "under")))
    start = random.uniform(0.0, 2.0 if phase == "press" else 7.0)
    lost = False

    def act(time: float) -> None:
        nonlocal lost
        if time >= start and not lost:
            lost = True
            deafen(simulation, side)

    return Trial(simulation, phase, act, f"{side} at {start:.1f} s")


def slip(random: np.random.Generator) -> Trial:
    """The ground has friction 0.02, in phases that are to take 16 s at the most."""
    simulation, phase = simulate(), str(random.choice(("approach", "under")))
    start, floor = random.uniform(0.0, 2.0), simulation.model.geom("floor").id

    def act(time: float) -> None:
        simulation.model.geom_friction[floor, 0] = 0.02 if time >= start else 0.9

    return Trial(simulation, phase, act, f"at {start:.1f} s", seconds=18.0)


def emptied() -> Mission:
    """The mission with a battery as good as empty: what counts as that is all that it can have."""
    mission = lift.mission("casualty")
    phases = mission.rows.phases
    for row in phases:
        row.troubles = [
            hurcules.Trouble(when=FULL, reactions=trouble.reactions)
            if trouble.when.quantity == "charge"
            else trouble
            for trouble in row.troubles
        ]
    table = hurcules.MissionTable(
        phases=phases, safety=mission.rows.safety, measures=mission.rows.measures
    )
    return Mission(mission.setup, table)


def empty(random: np.random.Generator) -> Trial:
    """The battery counts as empty."""
    phase = str(random.choice(("settle", "stand", "lift", "raise", "carry", "lay down")))
    return Trial(simulate(mission=emptied()), phase)


FAULTS: dict[str, Callable[[np.random.Generator], Trial]] = {
    "push": push,
    "moved": moved,
    "thrown": thrown,
    "weak": weak,
    "failing": failing,
    "deaf": deaf,
    "slip": slip,
    "empty": empty,
}


def run(fault: str, seed: int, kept: dict[str, np.ndarray]) -> dict[str, Any]:
    """One trial: the phases that it went through, how it ended, how fast the person came down."""
    trial = FAULTS[fault](np.random.default_rng([seed, list(FAULTS).index(fault)]))
    simulation = trial.simulation
    simulation.restore(kept[trial.phase])
    read = hurcules.Quantities(simulation, ["casualty/on_ground", "casualty/support_n"])
    person = simulation.model.body("casualty_pelvis").id
    begin, phases = simulation.time, [simulation.phase]
    fastest, largest = 0.0, 0.0
    height = simulation.data.subtree_com[person, 2]
    while not simulation.finished:
        time = simulation.time - begin
        if time >= (LOWERING if phases[-1] in ("lower", "set down", "withdraw") else trial.seconds):
            break
        trial.act(time)
        simulation.step(20)
        now = simulation.data.subtree_com[person, 2]
        fastest, height = max(fastest, (height - now) / (20 * simulation.dt)), now
        largest = max(largest, float(simulation.read(read)[1]))
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
        "support_N": largest,
        "on_ground": float(simulation.read(read)[0]),
        "height_m": float(height),
        "robot_fell": simulation.reason.startswith("fell"),
    }


def outcome(trial: dict[str, Any]) -> str:
    """In a word or two what came of it."""
    if trial["robot_fell"]:
        return "the robot fell"
    if trial["down_mps"] > 0.8:
        return "the person fell"
    if "lower" in trial["phases"]:
        return "laid down" if trial["on_ground"] > 0.9 else "lowered, still on the arms"
    if "withdraw" in trial["phases"]:
        return "backed off"
    return "stopped" if trial["finished"] else "went on"


def show(path: Path) -> None:
    """How often what came of each fault."""
    table: dict[str, Counter[str]] = defaultdict(Counter)
    for line in path.read_text().splitlines():
        trial = json.loads(line)
        table[trial["fault"]][outcome(trial)] += 1
    for fault, counts in table.items():
        print(f"{fault:8} {', '.join(f'{word} {n}' for word, n in counts.most_common())}")


def main() -> None:
    """Runs what is missing."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--faults", default=",".join(FAULTS))
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--show", action="store_true")
    arguments = parser.parse_args()
    if not arguments.show:
        kept = states(arguments.out.with_suffix(".npz"))
        done = set()
        if arguments.out.exists():
            for line in arguments.out.read_text().splitlines():
                done.add((json.loads(line)["fault"], json.loads(line)["seed"]))
        with arguments.out.open("a") as file:
            for seed in range(arguments.seeds):
                for fault in arguments.faults.split(","):
                    if (fault, seed) in done:
                        continue
                    trial = run(fault, seed, kept)
                    file.write(json.dumps(trial) + "\n")
                    file.flush()
                    print(fault, seed, trial["what"], outcome(trial), trial["reason"], flush=True)
    show(arguments.out)


if __name__ == "__main__":
    main()
