"""Provokes troubles and faults in the mission `disposal`: one line of JSON a trial.

    python benchmarks/disposal_faults.py OUT.jsonl [--faults push,moved,...] [--seeds 5] [--show]

The nominal run has a case of 20 kg, friction 0.6, no errors of the cameras (`fault_trials.py`). A
trial ends 8 s after its phase began where the fault does not say more, or when the case has been
set down.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import mujoco
import numpy as np
from fault_trials import (
    Bench,
    Trial,
    direction,
    emptied,
    overrun,
    shove,
    slip,
    with_rows,
    with_weak,
)

import hurcules
from hurcules import Condition, Lead, Mission, Phase, Trouble, disposal

FIRST_SEED = 3100
CARRIED = ("raise", "hold", "sit down", "fold the right leg", "turn to the right", "transport")
DRIVEN = ("approach", "draw near", "transport", "over the container")
HELD = ("close", "squeeze", "raise", "sit down", "transport")
MOTORS = ("HIP", "LKN", "LSP", "REB", "LWP", "L_grip_1", "R_grip_1")
DEAD = "load/on_rest"  # a column that stays at 0: nothing else of the robot bears the case
FALLS = 0.5  # [m/s] of the case: it is dropped
BACK = ("set down", "to the ground", "open", "hands up", "back off")


def simulate(
    model: mujoco.MjModel | None = None, mission: Mission | None = None
) -> hurcules.Simulation:
    """The mission, maybe with a model or a table of one's own."""
    model = model or disposal.model(disposal.Job())
    return hurcules.Simulation(
        mission or disposal.mission(),
        model=model,
        controller=disposal.controller(model),
        variation=0.0,
        record=False,
    )


def push(random: np.random.Generator) -> Trial:
    """200 N on the trunk."""
    return shove(simulate(), random, (*CARRIED, "put in"), "torso", 200.0)


def moved(random: np.random.Generator) -> Trial:
    """Somebody pushes the case by some 0.1 m before it is held: 250 N for 0.2 s."""
    simulation = simulate()
    phase = str(random.choice(("approach", "draw near", "over the bars", "down to the bars")))
    start, along = random.uniform(0.2, 2.5), direction(random)
    case = simulation.data.body("ordnance_case")

    def act(time: float) -> None:
        case.xfrc_applied[:3] = 250.0 * along * (start <= time < start + 0.2)

    what = f"at {start:.1f} s, {np.degrees(np.arctan2(along[1], along[0])):.0f} degrees"
    return Trial(simulation, phase, act, what, seconds=150.0, until="raise")


def weak(random: np.random.Generator, share: float = 0.7) -> Trial:
    """A motor gives 70 % of its torque, from the lift or from the sitting down on."""
    motor, phase = str(random.choice(MOTORS)), str(random.choice(("lift", "sit down")))
    model = with_weak(disposal.model(disposal.Job()), motor, share)
    return Trial(simulate(model), phase, what=motor, seconds=24.0)


def deafened(side: str) -> Mission:
    """The mission in which the force sensor of the fingers of one hand reads 0."""
    lost = f"load/{side}_grip_n"

    def at(when: Condition) -> Condition:
        if when.quantity == lost:
            when.quantity = DEAD
        return when

    def change(row: Phase) -> None:
        row.done = [at(when) for when in row.done]
        row.troubles = [Trouble(when=at(one.when), reactions=one.reactions) for one in row.troubles]
        leads: list[Lead] = row.leads
        for lead in leads:
            if lead.hold == lost:
                lead.hold = DEAD
        row.leads = leads

    return with_rows(disposal.mission(), change)


def deaf(random: np.random.Generator) -> Trial:
    """The force sensor of a hand reads 0 from the start of a phase on."""
    side, phase = str(random.choice(("left", "right"))), str(random.choice(HELD))
    return Trial(simulate(mission=deafened(side)), phase, what=side, seconds=40.0)


def link(random: np.random.Generator) -> Trial:
    """It asks on the way, and its question is lost: nobody answers."""
    after = float(np.round(random.uniform(1.5, 3.0), 1))

    def change(row: Phase) -> None:
        if row.name == "transport":
            row.within = after

    simulation = simulate(mission=with_rows(disposal.mission(), change))
    return Trial(simulation, "transport", what=f"asks after {after} s", seconds=after + 35.0)


def empty(random: np.random.Generator) -> Trial:
    """The battery counts as empty."""
    phase = str(random.choice(("settle", "approach", "open the arms", "lift", "transport")))
    return Trial(simulate(mission=emptied(disposal.mission())), phase)


FAULTS: dict[str, Callable[[np.random.Generator], Trial]] = {
    "push": push,
    "moved": moved,
    "weak": weak,
    "deaf": deaf,
    "slip": lambda random: slip(simulate(), random, DRIVEN, 62.0),
    "overrun": lambda random: overrun(simulate(), random, (*CARRIED, "put in")),
    "empty": empty,
    "link": link,
    "ice": lambda random: slip(simulate(), random, DRIVEN, 62.0, friction=0.001),
}


def outcome(trial: dict[str, Any]) -> str:
    """In a word or two what came of it."""
    told = trial["waited"] > 0.0 or trial["finished"] or set(BACK) & set(trial["phases"])
    if trial["robot_fell"]:
        return "the robot fell"
    if trial["sinking_mps"] > FALLS:
        return "dropped, told" if told else "dropped silently"
    if "back off" in trial["phases"] or "open" in trial["phases"]:
        where = "let go" if "set down" not in trial["phases"] else "set down"
        return where if trial["on_ground"] > 0.9 else f"{where}, not on the ground"
    if trial["waited"] > 0.0:
        return "stood still"
    return "ended" if trial["finished"] and trial["reason"] != "completed" else "went on"


BENCH = Bench(
    simulate=simulate,
    faults=FAULTS,
    body="ordnance_case",
    largest={
        "sinking_mps": "load/sinking_mps",
        "off_m": "load/off_m",
        "waited": "mission/waiting",
        "left_grip_N": "load/left_grip_n",
        "right_grip_N": "load/right_grip_n",
        "motor_C": "monitor/motor_temperature_C",
    },
    last={
        "on_ground": "load/on_ground",
        "on_left": "load/on_left_hand",
        "on_right": "load/on_right_hand",
        "in_container": "load/in_container",
    },
    safety=BACK,
    safety_seconds=60.0,
    outcome=outcome,
)

if __name__ == "__main__":
    BENCH.main(__doc__ or "", FIRST_SEED)
