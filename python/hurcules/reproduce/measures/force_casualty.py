"""K20: the arms go under a person of 75 kg who lies across the way, with and without force control.

In the velocity form, as the thesis' experiment (section 5.7.2), on the stiff floor. Without force
control the operator leaves the tips 45 mm above the ground.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np

from hurcules import ForceGains
from hurcules.reproduce.claim import Finding, Note, Plot, line
from hurcules.reproduce.measures.force_ideal import G
from hurcules.reproduce.measures.marks import measures
from hurcules.reproduce.measures.press_robot import DT, PressRobot, Setting, ramped
from hurcules.reproduce.measures.press_scene import Surface
from hurcules.reproduce.measures.problems import Array

MASS, DISTANCE = 75, 2.12  # [kg], [m] of the middle of the person from the knee axis
# tips 0.05 m above the ground and 1.74 m from the knee axis, lower arms 0.38 rad below the
# horizontal: flatter, they would meet the robot's own tracks
POSTURE = {"KN": 1.9044, "HIP": 0.36, "NKP": -1.0024}
POSTURE |= {side + joint: q for side in "LR" for joint, q in (("SP", 1.9613), ("EB", 0.8128))}
AHEAD, DOWN = 0.08, 0.025  # [m/s]
BEGIN, START, END = 1.5, 4.5, 9.8  # [s] down, ahead, end
TOUCHED = 0.002  # [m] that the chest has moved


@dataclass(frozen=True)
class Scoop:
    """One approach; (ticks,).

    Attributes:
        time: [s].
        tip: [m] the left one, ahead.
        chest: [m] by which the chest has moved ahead.
        push: [N] of both arms, ahead.
    """

    time: Array
    tip: Array
    chest: Array
    push: Array

    @property
    def touched(self) -> int:
        """Tick in which the chest begins to move."""
        return int((self.chest > TOUCHED).argmax())

    @property
    def pushed(self) -> float:
        """Share of the tip's way since then by which the chest moved."""
        return float(np.ptp(self.chest[self.touched :]) / np.ptp(self.tip[self.touched :]))


@cache
def scoop(force: bool) -> Scoop:
    """With force control on the ground, or by motion alone above it."""
    surface = Surface(casualty=MASS, distance=DISTANCE)
    gains = ForceGains(compliance=0.05)
    robot = PressRobot(Setting(surface, gains, G, force=force, f_max=1e6), POSTURE)
    robot.settle(BEGIN)
    # the ramps of a speed take 0.3 s: 5 mm down
    down = ramped(-DOWN, BEGIN, 1e3 if force else BEGIN + 0.5)
    ahead = ramped(AHEAD, START, 1e3)
    chest, tip = robot.data.body("casualty_chest"), robot.data.site("L_tcp")
    begin, rows = float(chest.xpos[0]), []
    while robot.time < END:
        robot.tick(ahead(robot.time), down(robot.time))
        push = robot.press(0)[0] + robot.press(1)[0]
        rows.append((robot.time, tip.xpos[0], chest.xpos[0] - begin, push))
    return Scoop(*np.array(rows).T)


@measures("K20")
def under_a_person() -> Finding:
    """How much of the way of the tips the person is pushed, from the first touch on."""
    pressed, above = scoop(True), scoop(False)
    both = {"pressing 5 N": pressed, "above the ground": above}
    moved = [
        line(label, one.tip[one.time > START], 1e3 * one.chest[one.time > START])
        for label, one in both.items()
    ]
    pushes = [line(label, one.time, _smooth(one.push)) for label, one in both.items()]
    return Finding(
        {
            "above": above.pushed,
            "pressing": pressed.pushed,
            "deeper": (1.0 - pressed.pushed) / (1.0 - above.pushed),
        },
        [Note("largest push with force control", float(_smooth(pressed.push).max()), "N")],
        [
            Plot("Chest over tip", "place of the tip [m]", "chest moved [mm]", moved),
            Plot("Push of both arms", "time [s]", "[N]", pushes),
        ],
    )


def _smooth(values: Array, seconds: float = 0.1) -> Array:
    width = round(seconds / DT)
    return np.asarray(np.convolve(values, np.ones(width) / width, "same"))
