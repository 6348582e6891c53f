"""F01 to F05: the sequences of the field tests, each in one run and with a run that must fail."""

from __future__ import annotations

import re
from functools import cache
from typing import Any

import numpy as np

import hurcules
from hurcules import models, postures
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.rig import start
from hurcules_studies.thesis.measures.rover import Rover, flat
from hurcules_studies.thesis.measures.transformation import HOURS, MASS, MISSIONS, ways

SELF = "monitor/self_collision_distance_m"
STEP = re.compile(r"\((\d+)\)")
# of the casualty mission, as Figure 4.28 and its caption tell them
STEPS = ("approach", "press", "under", "lift", "raise", "carry", "sit down", "fold the right leg",
         "fold the left leg", "slide the bed out", "lay down", "arms out")  # fmt: skip
SAMPLE = 50  # rows of the log between two of a plot
WAY = 50.0  # [m] with the arms' brakes shut, then open
ARMS = ("SP", "SR", "SY", "EB")


def run(name: str, **parameters: Any) -> hurcules.Simulation:
    """A whole mission as nobody disturbs it."""
    simulation = hurcules.Simulation(name, 1, variation=0.0, parameters=parameters)
    while not simulation.finished:
        simulation.step(1000)
    return simulation


@cache
def ordnance() -> hurcules.Simulation:
    """The case of 20 kg, into the container."""
    return run("disposal")


@cache
def casualty() -> hurcules.Simulation:
    """The person of 75 kg, home on the bed."""
    return run("casualty")


def visited(simulation: hurcules.Simulation) -> list[str]:
    """The names of the phases, in the order in which they were entered."""
    phase = simulation.log()["phase"].astype(int)
    entered = np.flatnonzero(np.diff(phase, prepend=-1))
    return [simulation.phases[i] for i in phase[entered]]


def in_order(steps: list[int], phases: int) -> int:
    """How many of 1 .. phases come one after the other in steps."""
    wanted = 1
    for step in steps:
        if step == wanted:
            wanted += 1
    return min(wanted, phases + 1) - 1


def nearest(simulation: hurcules.Simulation) -> Plot:
    """The robot's distance from itself."""
    log = simulation.log()
    time, distance = log["time"][::SAMPLE], log[SELF][::SAMPLE]
    return Plot("Distance of the robot from itself", "time [s]", "[m]", [line("", time, distance)])


@measures("F01")
def ordnance_is_fetched() -> Finding:
    """The nominal run; then 30 kg on bars of friction 0.4, which no hand here can hold."""
    done = ordnance()
    notes = dict(zip(done.phases, done.phase_notes, strict=True))
    told = [note for name in visited(done) if (note := STEP.search(notes.get(name, "")))]
    heavy = run("disposal", mass=30.0, friction=0.4)
    return Finding(
        {
            "steps": in_order([int(note.group(1)) for note in told], 12),
            "success": int(done.success),
            "distance": float(np.nanmin(done.log()[SELF])),
            "heavy": int(heavy.success),
        },
        [
            Note("simulated time", done.time, "s"),
            *(Note(name, value) for name, value in done.figures().items()),
        ],
        [nearest(done)],
    )


@measures("F02")
def a_person_is_brought_home() -> Finding:
    """The nominal run; then a person half a metre beside where the arms go."""
    done = casualty()
    steps = [STEPS.index(name) + 1 for name in visited(done) if name in STEPS]
    beside = run("casualty", offset=(0.0, 0.5))
    return Finding(
        {
            "steps": in_order(steps, len(STEPS)),
            "success": int(done.success),
            "distance": float(np.nanmin(done.log()[SELF])),
            "beside": int(beside.success),
        },
        [
            Note("simulated time", done.time, "s"),
            *(Note(name, value) for name, value in done.figures().items()),
        ],
        [nearest(done)],
    )


def collisions(robot: str, **without: bool) -> int:
    """Pairs of bodies that meet from driving to standing and, if all is there, back."""
    model = models.load(robot)
    _, player = start(model, robot, "drive")
    moves = postures.stand_up(robot, **without)
    if without:
        swing = [move.name for move in moves].index("swing both lower legs over the front")
        moves = moves[: swing + 1]
    else:
        moves = [*moves, *postures.fold_back(robot)]
    return sum(len(result.collisions) for result in player.play(moves))


@measures("F03")
def no_transformation_meets_itself() -> Finding:
    """Both forms of the robot up and back; up without a turned waist, and without folded arms."""
    forms = models.names()
    return Finding(
        {
            "all": sum(collisions(form) for form in forms),
            "waist": min(collisions(form, turn_waist=False) for form in forms),
            "arms": min(collisions(form, fold_arms=False) for form in forms),
        }
    )


@measures("F04")
def seven_missions() -> Finding:
    """Seven times: 400 m there, the casualty mission as it ran, 400 m back with 120 kg."""
    there, back = ways()
    done = casualty()
    driving = MISSIONS * (there.seconds + back.seconds)
    working = MISSIONS * done.time
    battery = hurcules.Battery()
    battery.draw(MISSIONS * (there.energy + back.energy) / driving, driving)
    taken = MISSIONS * float(done.log()["charge"][0] - done.log()["charge"][-1])
    return Finding(
        {
            "time": (driving + working) / 3600.0,
            "charge": battery.charge - taken,
            "way": min(there.metres, back.metres),
        },
        [
            Note("driving", driving / 3600.0, "h"),
            Note("missions", working / 3600.0, "h"),
            Note("share of the battery that a mission takes", taken / MISSIONS),
            Note("hours that are left", HOURS - (driving + working) / 3600.0, "h"),
            Note("load on the way back", MASS, "kg"),
        ],
    )


def moved_in_driving(braked: bool) -> tuple[float, Array]:
    """[rad] by which an arm's joint moved at most; [N m] torques of the arms' motors at the end."""
    rover = Rover(flat())
    model = rover.model
    arms = [name for name in rover.physics.brakes.names if name[1:] in ARMS]
    for joint in arms:
        rover.physics.brakes.set_closed(joint, braked)
    arm_motors = [model.actuator(joint).id for joint in arms]
    trip = rover.drive(WAY)
    return trip.arms, np.abs(rover.data.actuator_force[arm_motors])


@measures("F05")
def arms_without_power() -> Finding:
    """50 m at 20 km/h from rest to rest, the arms' motors without power; brakes shut, then open."""
    (shut, torque), (opened, _) = moved_in_driving(True), moved_in_driving(False)
    return Finding(
        {"shut": shut, "torque": float(torque.max()), "open": opened},
    )
