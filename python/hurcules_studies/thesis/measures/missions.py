"""F01 to F06: the sequences of the field tests, each in one run and with a run that must fail."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

import hurcules
from hurcules import lift, models, postures
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
BLADES = [f"{side}_scoop_{part}" for side in "LR" for part in ("blade", "tip", "flange")]
SMOOTH, ROUGH = 0.2, 2.0  # friction of the blades: the robot's, and ten times that
TIP, HARD = 5.0, 100.0  # [N] that a tip presses on the ground: the mission's, and twenty times that


@dataclass(frozen=True)
class Done:
    """What became of a mission.

    Attributes:
        success: it met all its criteria.
        time: [s] simulated.
        visited: names and notes of its phases, in the order in which they were entered.
        figures: by name.
        nearest: [m] of the robot from itself.
        charge: share of the battery that it took.
        plot: of the robot's distance from itself.
    """

    success: bool
    time: float
    visited: list[tuple[str, str]]
    figures: dict[str, float]
    nearest: float
    charge: float
    plot: Plot

    @property
    def notes(self) -> list[Note]:
        """Its figures, for the page."""
        figures = [Note(name, value) for name, value in self.figures.items()]
        return [Note("simulated time", self.time, "s"), *figures]


def run(name: str, **parameters: Any) -> Done:
    """A whole mission as nobody disturbs it."""
    simulation = hurcules.Simulation(name, 1, variation=0.0, parameters=parameters)
    while not simulation.finished:
        simulation.step(1000)
    log = simulation.log()
    phase = log["phase"].astype(int)
    entered = phase[np.flatnonzero(np.diff(phase, prepend=-1))]
    time, distance = log["time"][::SAMPLE], log[SELF][::SAMPLE]
    return Done(
        simulation.success,
        simulation.time,
        [(simulation.phases[i], simulation.phase_notes[i]) for i in entered],
        simulation.figures(),
        float(np.nanmin(log[SELF])),
        float(log["charge"][0] - log["charge"][-1]),
        Plot("Distance of the robot from itself", "time [s]", "[m]", [line("", time, distance)]),
    )


@cache
def casualty() -> Done:
    """The person of 75 kg, home on the bed."""
    return run("casualty")


def in_order(steps: list[int], phases: int) -> int:
    """How many of 1 .. phases come one after the other in steps."""
    wanted = 1
    for step in steps:
        if step == wanted:
            wanted += 1
    return min(wanted, phases + 1) - 1


@measures("F01")
def ordnance_is_fetched() -> Finding:
    """The nominal run; then 30 kg on bars of friction 0.4, which no hand here can hold."""
    done, heavy = run("disposal"), run("disposal", mass=30.0, friction=0.4)
    told = [int(step.group(1)) for _, note in done.visited if (step := STEP.search(note))]
    return Finding(
        {
            "steps": in_order(told, 12),
            "success": int(done.success),
            "distance": done.nearest,
            "heavy": int(heavy.success),
        },
        done.notes,
        [done.plot],
    )


@measures("F02")
def a_person_is_brought_home() -> Finding:
    """The nominal run; a person half a metre beside the arms; one who lies on the front."""
    done = casualty()
    beside, front = run("casualty", offset=(0.0, 0.5)), run("casualty", pose="front")
    steps = [STEPS.index(name) + 1 for name, _ in done.visited if name in STEPS]
    return Finding(
        {
            "steps": in_order(steps, len(STEPS)),
            "success": int(done.success),
            "distance": done.nearest,
            "beside": int(beside.success),
            "front": int(front.success),
        },
        done.notes,
        [done.plot],
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
    taken = MISSIONS * done.charge
    return Finding(
        {
            "time": (driving + working) / 3600.0,
            "charge": battery.charge - taken,
            "way": min(there.metres, back.metres),
        },
        [
            Note("driving", driving / 3600.0, "h"),
            Note("missions", working / 3600.0, "h"),
            Note("share of the battery that a mission takes", done.charge),
            Note("hours that are left", HOURS - (driving + working) / 3600.0, "h"),
            Note("load on the way back", MASS, "kg"),
        ],
    )


def moved_in_driving(braked: bool) -> tuple[float, Array]:
    """[rad] by which an arm's joint moved at most; [N m] torques of the arms' motors at the end.

    Behind shut brakes the motors give nothing of themselves; with open ones they are cut off.
    """
    rover = Rover(flat())
    model = rover.model
    arms = [name for name in rover.physics.brakes.names if name[1:] in ARMS]
    arm_motors = [model.actuator(joint).id for joint in arms]
    if not braked:
        model.actuator_gainprm[arm_motors, 0] = 0.0
    for joint in arms:
        rover.physics.brakes.set_closed(joint, braked)
    trip = rover.drive(WAY)
    return trip.arms, np.abs(rover.data.actuator_force[arm_motors])


@measures("F05")
def arms_without_power() -> Finding:
    """50 m at 20 km/h from rest to rest, the arms' motors without power; brakes shut, then open."""
    (shut, torque), (opened, _) = moved_in_driving(True), moved_in_driving(False)
    return Finding(
        {"shut": shut, "torque": float(torque.max()), "open": opened},
    )


def goes_under(friction: float, force: float) -> tuple[bool, float, float]:
    """The mission `lift` until the arms are under the person, or it has given up.

    Args:
        friction: of the blades.
        force: [N] of a tip on the ground. The trouble of `press` that an elbow bears more than its
            force sensor tells of is left out, which 100 N would set off.

    Returns:
        Whether they are, the largest push [N], and how far the person was pushed [m].
    """
    found = lift.mission()
    phases = found.rows.phases
    for phase in phases:
        if phase.name == "press":
            phase.troubles = []
    rows = hurcules.MissionTable(
        phases=phases, safety=found.rows.safety, measures=found.rows.measures
    )
    model = lift.model(lift.Person())
    for name in BLADES:
        model.geom(name).friction[0] = friction
    controller = lift.controller(model)
    simulation = hurcules.Simulation(
        hurcules.Mission(found.setup, rows), model=model, controller=controller, variation=0.0,
        record=False,
    )  # fmt: skip
    for task in (controller.task(f"{side}_press") for side in "LR"):
        if isinstance(task, hurcules.ForceTask):
            task.set_force(-force)
    seen = hurcules.Quantities(simulation, ["casualty/push_n", "casualty/moved_m"])
    push = moved = 0.0
    while not simulation.finished and simulation.phase not in ("lift", "withdraw"):
        simulation.step(20)
        if simulation.phase == "under":
            now, moved = simulation.read(seen)
            push = max(push, now)
    return simulation.phase == "lift", push, moved


@measures("F06")
def the_arms_go_under() -> Finding:
    """As the mission has it; with blades of friction 2.0; with tips that press 100 N each."""
    smooth, rough = goes_under(SMOOTH, TIP), goes_under(ROUGH, TIP)
    pressed = goes_under(SMOOTH, HARD)
    return Finding(
        {
            "under": int(smooth[0]),
            "push": rough[1] / smooth[1],
            "rough": int(rough[0]),
            "pressed": int(pressed[0]),
        },
        [
            Note("push, friction 0.2", smooth[1], "N"),
            Note("push, friction 2.0", rough[1], "N"),
            Note("person pushed, friction 0.2", smooth[2], "m"),
            Note("person pushed, friction 2.0", rough[2], "m"),
        ],
    )
