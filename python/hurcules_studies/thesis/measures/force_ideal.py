"""A force task on a robot that follows exactly, on a spring: the law alone.

A slide without mass or motor is the one row of the stack. The ground is f = G (s - r) and is read
exactly, at this tick.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import mujoco
import numpy as np

import hurcules
from hurcules import ForceGains, ForceLoop, Stack, StackLevel
from hurcules_studies.thesis.claim import Plot, line
from hurcules_studies.thesis.measures.force_loops import DESIRED
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "START", "G", "Run", "forces", "press"]

DT = 1e-3  # [s]
SLIDE = """
<mujoco>
  <worldbody><body><joint name="z" type="slide" axis="0 0 1"/><geom size="0.05"/>
    <site name="tip"/></body></worldbody>
</mujoco>
"""
START = -2.6  # [N] just beyond f_min: the law works from the first tick on
G = 1100.0  # [N/m] the elbow's spring as felt at the tip of the scoop


@dataclass(frozen=True)
class Run:
    """Of a press; (ticks,).

    Attributes:
        time: [s].
        force: [N] what is read.
        speed: [m/s] as commanded.
        contact: 0 free, 1 contact, 2 stopped, 3 sensor lost.
    """

    time: Array
    force: Array
    speed: Array
    contact: Array


def press(
    gains: ForceGains,
    seconds: float,
    stiffness: float = G,
    above: float = 0.0,
    read: Callable[[int, float], float] | None = None,
    f_max: float = 1e6,
    told: float | None = None,
) -> Run:
    """Presses on a spring, from START on, at rest.

    Args:
        gains: of the law.
        seconds: of the run.
        stiffness: [N/m] of the spring; the law is told.
        above: [m] of the spring's rest over the reference.
        read: from tick and force to the reading, other than the force.
        f_max: [N].
        told: [N/m] that the law takes the spring for; None: what it is.
    """
    robot = hurcules.Robot(mujoco.MjModel.from_xml_string(SLIDE))
    robot.set_configuration([START / stiffness])
    task = hurcules.ForceTask(
        "force",
        robot,
        "tip",
        gains=gains,
        environment=stiffness if told is None else told,
        contact=hurcules.ContactOptions(f_max=f_max),
        blend=0.0,
    )
    task.set_target([-above])
    controller: hurcules.VelocityController | hurcules.AccelerationController
    if gains.loop == ForceLoop.FirstOrder:
        options = hurcules.VelocityControllerOptions(law="thesis", enforce_limits=False)
        controller = hurcules.VelocityController(robot, options)
    else:
        second = hurcules.AccelerationControllerOptions(
            law="thesis", rest=0.0, enforce_limits=False
        )
        controller = hurcules.AccelerationController(robot, second)
    controller.set_stack(Stack([StackLevel("force", [task], 0.0)]))
    count = round(seconds / DT)
    force, speed, state = np.zeros(count), np.zeros(count), np.zeros(count)
    for i in range(count):
        place = float(robot.configuration[0])
        force[i] = stiffness * place
        task.sense(robot, force[i] if read is None else read(i, force[i]))
        controller.step(robot)
        speed[i] = (float(robot.configuration[0]) - place) / DT
        state[i] = int(task.contact)
    return Run(np.asarray(DT * np.arange(count)), force, speed, state)


def forces(title: str, runs: dict[str, Run], dashed: dict[str, Array] | None = None) -> Plot:
    """Forces over time, with the desired one."""
    lines = [line(label, run.time, run.force) for label, run in runs.items()]
    time = next(iter(runs.values())).time
    lines += [line(label, time, values, "dashed") for label, values in (dashed or {}).items()]
    return Plot(title, "time [s]", "force [N]", lines, levels=(DESIRED,))
