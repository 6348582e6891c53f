"""H19: the monitors of self-collision and centre of mass beside RHQP."""

from __future__ import annotations

import math
from functools import cache

import mujoco
import numpy as np

import hurcules
from hurcules import MonitorOptions
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.registry import measures

SLOPE = math.radians(55.0)  # nose down: ten degrees more than the stretched-out robot bears


@cache
def watched() -> hurcules.Simulation:
    """The mission with monitors."""
    simulation = hurcules.Simulation("stretch", seed=0)
    while not simulation.finished:
        simulation.step(1000)
    return simulation


def unwatched() -> hurcules.Simulation:
    """The same without."""
    options = MonitorOptions(on=False)
    simulation = hurcules.Simulation("stretch", seed=0, record=False, monitors=options)
    while not simulation.finished:
        simulation.step(1000)
    return simulation


def arms_that_meet() -> hurcules.Simulation:
    """Both lower arms swung inwards before the chest, then a tick."""
    simulation = hurcules.Simulation("stretch", seed=0)
    angles = {"SP": 0.9, "EB": 1.6}
    for side in "LR":
        for joint, angle in angles.items():
            simulation.data.joint(f"{side}{joint}").qpos[0] = angle
        simulation.data.joint(f"{side}SY").qpos[0] = -1.2
    mujoco.mj_forward(simulation.model, simulation.data)
    simulation.step(1)
    return simulation


def on_a_slope() -> hurcules.Simulation:
    """Gravity as on a slope, nose down, then a tick."""
    simulation = hurcules.Simulation("stretch", seed=0)
    simulation.model.opt.gravity[:] = [9.81 * math.sin(SLOPE), 0.0, -9.81 * math.cos(SLOPE)]
    mujoco.mj_forward(simulation.model, simulation.data)
    simulation.step(1)
    return simulation


def alarms(simulation: hurcules.Simulation) -> int:
    """How many were raised so far."""
    return sum(text.startswith("alarm") for _, text in simulation.events())


@measures("H19")
def beside_the_controller() -> Finding:
    """Same bits with and without; values over the stretch; two postures that must be seen."""
    run = watched()
    log, worst = run.log(), run.figures()
    same = np.array_equal(run.data.qpos, unwatched().data.qpos)
    meet, tips = arms_that_meet(), on_a_slope()
    names = ("monitor/self_collision_distance_m", "monitor/static_margin_m")
    labels = ("own parts apart", "centre of mass inside the edge")
    lines = [line(label, log["time"], log[name]) for label, name in zip(labels, names, strict=True)]
    return Finding(
        {
            "same": float(same),
            "distance": worst["self_collision_distance_m"],
            "margin": worst["static_margin_m"],
            "meet": meet.monitors()["self_collision_distance_m"],
            "tips": tips.monitors()["static_margin_m"],
            "alarms": min(alarms(meet), alarms(tips)),
        },
        [
            Note("pairs of parts that are watched", len(run.self_collision_pairs())),
            Note("alarms in the stretch", alarms(run)),
        ],
        [Plot("In the stretch", "time [s]", "[m]", lines)],
    )
