"""Provokes troubles and faults in the mission `casualty`: one line of JSON a trial.

    python benchmarks/rescue_faults.py OUT.jsonl [--faults push,moved,...] [--seeds 5] [--show]

The nominal run has a person of 75 kg, everything as expected (`fault_trials.py`). A trial ends 8 s
after its phase began (`slip`: 18 s, `home`: 12 s), or when the person has been laid down.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import mujoco
import numpy as np
from fault_trials import Bench, Trial, emptied, overrun, shove, slip, with_weak

import hurcules
from hurcules import Mission, lift

CARRIED = ("raise", "carry", "sit down", "fold the right leg", "turn to the right")
SEATED = ("lay down", "home")
STANDING = ("lift", "raise", "carry")
MOTORS = ("LEB", "REB", "HIP", "LKN", "LSP")
CELL = "casualty_force_skull"  # some force


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


def push(random: np.random.Generator) -> Trial:
    """200 N on the trunk."""
    return shove(simulate(), random, CARRIED + SEATED, "torso", 200.0)


def moved(random: np.random.Generator, force: float = 150.0) -> Trial:
    """150 N on the chest of the person, half of whom weighs 370 N."""
    return shove(simulate(), random, STANDING, "casualty_thorax", force)


def weakened(joint: str, share: float) -> mujoco.MjModel:
    """The scene, in which the motor of a joint gives a share of its torque."""
    return with_weak(lift.model(lift.Person()), joint, share)


def weak(random: np.random.Generator, share: float = 0.7) -> Trial:
    """A motor gives 70 % of its torque from the lift on."""
    motor = str(random.choice(MOTORS))
    return Trial(simulate(weakened(motor, share)), "lift", what=motor)


def deafen(simulation: hurcules.Simulation, side: str) -> None:
    """The force sensor of the arm "L" or "R" reads 0 from now on."""
    controller = simulation.controller
    controller.sense(controller.task(f"{side}_press"), CELL, sign=1e-9)


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


def no_battery() -> Mission:
    """The mission with a battery as good as empty."""
    return emptied(lift.mission("casualty"))


def empty(random: np.random.Generator) -> Trial:
    """The battery counts as empty."""
    phase = str(random.choice(("settle", "stand", "lift", "raise", "carry", "lay down")))
    return Trial(simulate(mission=no_battery()), phase)


FAULTS: dict[str, Callable[[np.random.Generator], Trial]] = {
    "push": push,
    "moved": moved,
    "thrown": partial(moved, force=300.0),  # as much as no friction holds
    "weak": weak,
    "failing": partial(weak, share=0.3),
    "deaf": deaf,
    "slip": lambda random: slip(simulate(), random, ("approach", "under"), 18.0),
    "empty": empty,
    "overrun": lambda random: overrun(simulate(), random, ("under", "lift", *CARRIED, *SEATED)),
    "home": lambda random: slip(simulate(), random, ("home",), 12.0),
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
    return "stopped" if trial["finished"] and trial["reason"] != "completed" else "went on"


BENCH = Bench(
    simulate=simulate,
    faults=FAULTS,
    body="casualty_pelvis",
    largest={"support_N": "casualty/support_n"},
    last={"on_ground": "casualty/on_ground", "ahead_m": "base/x"},
    safety=("lower", "set down", "withdraw"),
    safety_seconds=35.0,
    outcome=outcome,
)

if __name__ == "__main__":
    BENCH.main(__doc__ or "")
