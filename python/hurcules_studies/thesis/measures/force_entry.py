"""K17: the force control begins, in the velocity form with C = 0.05 m/s/N, in the physics.

Down so slowly that the reading reaches f_min at 21 s, as in figure 5.17; once as the thesis does
it, at once, and once with the blend that is our default.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from hurcules import ForceGains
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_loops import DESIRED
from hurcules_studies.thesis.measures.press_robot import DT, Log, PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.registry import measures

THESIS = 21.0  # [s]
DOWN = 0.00209  # [m/s]
BEGIN, END = 1.5, 23.0  # [s]
JOINTS = ("KN", "HIP", "NKP", "LSP", "LEB", "RSP", "REB")  # those that lower both hands
WINDOW = round(0.02 / DT)  # ticks in which a change of speed is a jump


@cache
def entered(blend: float) -> Log:
    """From the air into contact."""
    gains = ForceGains(compliance=0.05)
    robot = PressRobot(Setting(gains=gains, environment=G, blend=blend))
    robot.settle()
    return robot.follow(lambda _: 0.0, ramped(-DOWN, BEGIN, 60.0), END)


def jumps(log: Log) -> NDArray[np.float64]:
    """Change of each joint's speed within the window around the entry, over its speed before."""
    at = int((log.state[:, 0] == 1).argmax())
    columns = [log.of(name) for name in JOINTS]
    before = np.abs(log.qd[at - 5 * WINDOW : at - WINDOW, columns]).mean(axis=0)
    change = np.abs(log.qd[at - 2 : at + WINDOW, columns] - log.qd[at - 3, columns]).max(axis=0)
    return np.asarray(change / before)


@measures("K17")
def joint_speeds_jump() -> Finding:
    """Jumps without a blend and with it."""
    at_once, blended = entered(0.0), entered(0.1)
    touched = at_once.touched()
    plots = []
    for title, log in (("At once", at_once), ("Blend of 0.1 s", blended)):
        part = log.part(touched - 0.5, touched + 1.0)
        lines = [line(n, log.time[part], log.qd[part, log.of(n)]) for n in ("HIP", "LSP", "LEB")]
        plots.append(Plot(title, "time [s]", "[rad/s]", lines, thesis_marks=(THESIS,)))
    part = at_once.part(touched - 0.5, touched + 1.0)
    readings = [
        line(label, log.time[part], log.force[part, 0])
        for label, log in (("at once", at_once), ("blend", blended))
    ]
    plots.append(Plot("Reading", "time [s]", "[N]", readings, levels=(-2.5, DESIRED)))
    end = blended.part(END - 1.0)
    return Finding(
        {
            "when": touched,
            "all": float(jumps(at_once).min()),
            "blend": float(jumps(blended).max() / jumps(at_once).max()),
            "force": abs(float(blended.force[end, 0].mean()) - DESIRED),
        },
        [
            Note(
                "speed of the hip before",
                float(np.abs(at_once.qd[-2500, at_once.of("HIP")])),
                "rad/s",
            )
        ],
        plots,
    )
