"""K19: the twelve phases of figure 5.6, one after the other, in the physics.

Postures are played by the servos (hurcules.postures); from the lowering to the confirmation the
stack of section 5.6.1 leads, by accelerations with the inner velocity loop. No person lies there:
what happens to one is the matter of K20 and of the field missions.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from hurcules import ForceLoop, postures
from hurcules_studies.thesis.claim import Finding, Plot, line
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_loops import DESIRED
from hurcules_studies.thesis.measures.force_second_order import second
from hurcules_studies.thesis.measures.press_robot import Log, PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.registry import measures

WAY = 1.0  # [m] that it drives
TRACK_RADIUS = 0.14  # [m]
LOWER, REACH, UP = 4.0, 5.0, 3.0  # [s] of the phases under task control
OUT = 0.06  # [m/s] up, in the confirmation


@dataclass
class Sequence:
    """The phases as they went.

    Attributes:
        names, ends: of the phases, [s].
        collisions: of the robot with itself.
        margin: [m] least distance of the centre of mass from the edge of the support.
        drove: [m].
        logs: of the phases under task control.
        height: [m] of the tips in the end.
    """

    names: list[str] = field(default_factory=list)
    ends: list[float] = field(default_factory=list)
    collisions: set[tuple[str, str]] = field(default_factory=set)
    margin: float = math.inf
    drove: float = 0.0
    logs: dict[str, Log] = field(default_factory=dict)
    height: float = 0.0

    def played(self, name: str, results: list[postures.Result], time: float) -> None:
        """A phase made of moves."""
        self.names.append(name)
        self.ends.append(time)
        for result in results:
            self.collisions |= result.collisions
            self.margin = min(self.margin, result.margin)


def to_lowering() -> postures.Move:
    """From ready to where the lowering begins: the start of K08, 0.05 m above the ground."""
    keys = ((0.35, 1.3, 0.7, 0.45, 1.5), (0.75, 1.2, 1.2, 0.2, 1.25))
    return postures.standing("hands ahead", 14, *keys, (1.0, 1.147, 1.4181, -0.1379, 0.957))


def run() -> Sequence:
    """All twelve."""
    done = Sequence()
    robot = PressRobot(Setting(gains=second(ForceLoop.Velocity), environment=G), {}, "drive")
    model, data = robot.model, robot.data
    player = postures.Player(model, data, simulation=robot.simulation)
    turn = WAY / TRACK_RADIUS
    drive = postures.move("drive", 5.0, L_lower_belt=turn, R_lower_belt=turn)
    begin = float(data.qpos[0])
    opening, waist, fold, legs, *ready = postures.stand_up("rescue")
    phases = {
        "drive": [drive],
        "open arms": [opening],
        "waist": [waist],
        "fold": [fold],
        "legs": [legs],
        "ready": [*ready, to_lowering()],
    }
    for name, moves in phases.items():
        done.played(name, player.play(moves), data.time)
        if name == "drive":
            done.drove = float(data.qpos[0]) - begin
    press(robot, done)
    player = postures.Player(model, data, simulation=robot.simulation)
    embrace = postures.standing("embrace", 5, (1.0, 1.147, 1.418, -0.3, 1.62))
    lift = [
        postures.standing("lift", 8, (1.0, 1.3, 0.8, -0.3, 1.65)),
        postures.standing("carry", 10, (1.0, math.pi / 2, 0.0, -0.1, 1.75)),
    ]
    for name, move in zip(("embrace", "lift", "lift up"), (embrace, *lift), strict=True):
        done.played(name, player.play([move]), data.time)
    done.height = float(min(data.site(f"{side}_tcp").xpos[2] for side in "LR"))
    return done


def press(robot: PressRobot, done: Sequence) -> None:
    """Lowering, acquisition, confirmation: the stack takes over from the moves."""
    robot.begin()
    robot.settle()
    still, down = ramped(0.0, 0.0, 1.0), ramped(-0.02, robot.time, 1e3)
    for name, x, z, seconds in (
        ("lowering", still, down, LOWER),
        ("acquisition", ramped(0.05, robot.time + LOWER, robot.time + LOWER + REACH), down, REACH),
        ("confirm", still, None, UP),
    ):
        if z is None:  # to move out of contact is the matter of motion alone
            robot.enable(False)
            z = ramped(OUT, robot.time, robot.time + UP)
        done.logs[name] = robot.follow(x, z, robot.time + seconds)
        seen = postures.Result(name)
        postures.look(robot.model, robot.data, seen)
        done.played(name, [seen], robot.data.time)


@measures("K19")
def twelve_phases() -> Finding:
    """Which phases came, and what the hands did in those with contact."""
    done = run()
    lower, slide, confirm = (done.logs[name] for name in ("lowering", "acquisition", "confirm"))
    touching = np.convolve(slide.contact[:, 0, 2], np.ones(10), "same") < 0
    after = confirm.part(confirm.time[-1] - 0.5)
    lines = [line(name, log.time, log.force[:, 0]) for name, log in done.logs.items()]
    return Finding(
        {
            "phases": len(done.names),
            "drove": done.drove,
            "collisions": len(done.collisions),
            "margin": done.margin,
            "lowering": abs(float(lower.force[-500:, 0].mean()) - DESIRED),
            "acquisition": float(touching.mean()),
            "confirm": float(np.abs(confirm.contact[after]).max()),
            "motion_only": float((confirm.state[after] != 0).mean()),
            "height": done.height,
        },
        plots=[
            Plot("Force read, left hand", "time [s]", "[N]", lines, levels=(DESIRED,)),
            Plot(
                "Ends of the phases",
                "time [s]",
                "phase",
                [line("", done.ends, list(range(1, len(done.ends) + 1)), "dots")],
            ),
        ],
        remark="; ".join(
            f"{name} until {end:.0f} s" for name, end in zip(done.names, done.ends, strict=True)
        ),
    )
