"""K20: the arms go under a person of 75 kg who lies across the way, with and without force control.

In the velocity form, as the thesis' experiment (section 5.7.2), on the stiff floor. Without force
control the operator leaves the edges of the tips 27 mm above the ground.

A wedge that rises by a, friction m, under a part of the weight W_part pushes with

    W_part tan(a + atan m);

the person stays as long as that is less than what holds the rest on the ground, mu (W - W_part).
Pressing, the lower arms rise by 5.8 degrees and their wedge by 3.6 more: with m = 0.2 and mu = 0.45
the person stays up to W_part = 0.54 W, with m = 0.35 up to 0.45 W.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import numpy as np

from hurcules import ForceGains
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.press_robot import DT, PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.press_scene import Surface
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures

MASS, DISTANCE = 75, 2.18  # [kg], [m] of the middle of the person from the knee axis
# edges of the tips 50 mm above the ground, tips 1.80 m from the knee axis and so the elbows just
# ahead of the robot's own tracks; lower arms 0.12 rad below the horizontal
POSTURE = {"KN": 1.7628, "HIP": 0.36, "NKP": -1.0421}
POSTURE |= {side + joint: q for side in "LR" for joint, q in (("SP", 1.9645), ("EB", 1.2251))}
HIGH = 0.050  # [m] of the edges in that posture
GAZE = (1.85, 0.0, 0.05)  # [m] as far ahead as the neck can look from there
AHEAD, DOWN = 0.08, 0.025  # [m/s]
BEGIN, START, END = 1.5, 4.5, 9.8  # [s] down, ahead, end
LOWERED = 1.0  # [s] to a height above the ground
TOUCHED = 0.002  # [m] that the chest has moved
LEFT = 0.027  # [m] without force control: 45 mm at the middle of the blade
HEIGHTS = (0.010, 0.020, LEFT, 0.035, 0.045, HIGH)


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


def approach(height: float | None = None) -> Iterator[PressRobot]:
    """The robot after each tick: with force control on the ground, or by motion alone above it.

    Args:
        height: [m] of the edges above the ground; None: pressing 5 N.
    """
    force = height is None
    surface = Surface(casualty=MASS, distance=DISTANCE)
    gains = ForceGains(compliance=0.05)
    robot = PressRobot(Setting(surface, gains, G, force=force, f_max=1e6), POSTURE)
    robot.gaze.set_target(GAZE)
    robot.settle(BEGIN)
    down = ramped(-DOWN, BEGIN, 1e3)
    if height is not None:  # the ramps of a speed take 0.3 s
        down = ramped((height - HIGH) / (LOWERED - 0.3), BEGIN, BEGIN + LOWERED)
    ahead = ramped(AHEAD, START, 1e3)
    while robot.time < END:
        robot.tick(ahead(robot.time), down(robot.time))
        yield robot


@cache
def scoop(height: float | None = None) -> Scoop:
    """One approach, at a height of the edges [m] as in `approach`."""
    rows = []
    for robot in approach(height):
        chest, tip = robot.data.body("casualty_chest"), robot.data.site("L_tcp")
        push = robot.press(0)[0] + robot.press(1)[0]
        rows.append((robot.time, tip.xpos[0], chest.xpos[0], push))
    table = np.array(rows)
    table[:, 2] -= table[0, 2]
    return Scoop(*table.T)


@measures("K20")
def under_a_person() -> Finding:
    """How much of the way of the tips the person is pushed, from the first touch on."""
    pressed, above = scoop(), scoop(LEFT)
    both = {"pressing 5 N": pressed, "above the ground": above}
    moved = [
        line(label, one.tip[one.time > START], 1e3 * one.chest[one.time > START])
        for label, one in both.items()
    ]
    pushes = [line(label, one.time, _smooth(one.push)) for label, one in both.items()]
    shares = {1e3 * height: scoop(height).pushed for height in HEIGHTS}
    return Finding(
        {
            "above": above.pushed,
            "pressing": pressed.pushed,
            "deeper": (1.0 - pressed.pushed) / (1.0 - above.pushed),
        },
        [
            Note("largest push with force control", float(_smooth(pressed.push).max()), "N"),
            *(Note(f"without, edges {mm:.0f} mm high", share) for mm, share in shares.items()),
        ],
        [
            Plot("Chest over tip", "place of the tip [m]", "chest moved [mm]", moved),
            Plot("Push of both arms", "time [s]", "[N]", pushes),
            Plot(
                "Without force control",
                "edges above the ground [mm]",
                "share of the way pushed",
                [line("", np.array(list(shares)), np.array(list(shares.values())))],
                levels=(pressed.pushed,),
            ),
        ],
    )


def _smooth(values: Array, seconds: float = 0.1) -> Array:
    width = round(seconds / DT)
    return np.asarray(np.convolve(values, np.ones(width) / width, "same"))
