"""S06: the stretch by Algorithm 1 with limits as printed, followed by the servo in the physics.

The mission's default bounds brake a joint before its limit, so that its control errors hardly show
a switch; the thesis takes a limit within one step (4.3.9 with T = 1). Stack, start and command are
those of the mission.
"""

from __future__ import annotations

from functools import cache

import mujoco
import numpy as np

import hurcules
from hurcules import Stack, StackLevel, models
from hurcules.reproduce.claim import Finding, Note, Plot, line
from hurcules.reproduce.measures.marks import measures
from hurcules.reproduce.measures.problems import Array
from hurcules.reproduce.measures.standing import Followed, drives_of, led
from hurcules.reproduce.measures.whole_body import DT, Setting

SPEED = 0.0215  # [m/s] of both hands
SETTLE, SECONDS = 2.0, 32.0  # [s] of rest before; of the motion, past the last switch
WINDOW = 0.2  # [s] in which a change of control errors counts as a spike
AFTER = 0.3  # [s] that a spike may last


class Stretch:
    """The mission's stack on the reference alone: joint < hpos < hpitch < pel < gaze."""

    def __init__(self, setting: Setting) -> None:
        self.model = models.load(mission="stretch")
        self.robot = robot = hurcules.Robot(self.model)
        robot.set_keyframe("stretch")
        self.qpos = robot.qpos
        robot.stand_on("lower_leg_L")
        limits = hurcules.JointLimits("joint", robot)
        for coordinate, (lower, upper) in hurcules.mode_ranges("rescue_ready").items():
            limits.set_range(coordinate, lower, upper)
        self.hands = [hurcules.PositionTask(f"{s}hpos", robot, f"{s}_tcp") for s in "LR"]
        pitches = [hurcules.AngleTask(f"{s}hpitch", robot, f"{s}_tcp") for s in "LR"]
        pelvis = hurcules.PositionTask("pel", robot, "pelvis", axes=np.array([[1.0, 0.0, 0.0]]))
        gaze = hurcules.GazeTask("gaze", robot, "gaze")
        rho = setting.rho
        groups = (("hpos", self.hands), ("hpitch", pitches), ("pel", [pelvis]), ("gaze", [gaze]))
        levels = [StackLevel(name, tasks, rho) for name, tasks in groups]
        self.controller = hurcules.VelocityController(robot, setting.options)
        self.controller.set_stack(Stack([limits, *levels]))
        for task in (*self.hands, *pitches, pelvis, gaze):
            task.hold(robot)
        gaze.set_target(_near_side(self.model))

    def motion(self) -> tuple[Array, Array, Array]:
        """Rest, then both hands forward: q, qd and the limits held, (ticks, n) each."""
        rest, ticks = round(SETTLE / DT), round((SETTLE + SECONDS) / DT)
        n, robot = self.robot.size, self.robot
        q, qd, active = (np.zeros((ticks, n)) for _ in range(3))
        forward = np.array([SPEED, 0.0, 0.0])
        for i in range(ticks):
            q[i] = robot.configuration
            if i < rest:
                continue
            for hand in self.hands:
                hand.advance(forward, DT)
            qd[i] = self.controller.compute(robot)
            active[i] = self.controller.active_limits
            robot.set_configuration(self.controller.integrate(q[i]))
        return q, qd, active


def _near_side(model: mujoco.MjModel) -> Array:
    """What the camera looks at [m]."""
    world = hurcules.Robot(model)
    world.set_keyframe("stretch")
    return np.asarray(world.position("casualty_near_side"))


@cache
def run(method: str) -> tuple[Followed, dict[str, float]]:
    """What the physics makes of it, time from the start of the stretch; when limits switch."""
    stretch = Stretch(Setting(method, as_printed=method != "lexicographic"))
    names = stretch.robot.coordinate_names
    q, qd, active = stretch.motion()
    hip = active[:, names.index("HIP")] != 0
    shoulder = (active[:, names.index("LSP")] != 0) | (active[:, names.index("RSP")] != 0)
    time = DT * np.arange(len(q)) - SETTLE
    switches = {
        "hip": float(time[np.argmax(hip)]),
        "released": float(time[len(hip) - 1 - np.argmax(hip[::-1])]),
        "shoulder": float(time[np.argmax(shoulder)]),
    }
    drives = drives_of(stretch.robot, stretch.model, q)
    return led(stretch.model, stretch.qpos, drives, q, qd), switches


def spikes(method: str) -> tuple[dict[str, float], Plot, dict[str, float]]:
    """Changes of control errors within 0.2 s at the switches, over the usual; and a picture."""
    followed, switches = run(method)
    time = followed.time - SETTLE
    width = round(WINDOW / DT)
    errors = followed.of("LKN", "RKN", "HIP", "WST", "LS", "LE", "RS", "RE", "NK")
    change = np.abs(errors[width:] - errors[:-width]).max(axis=1)
    when = time[width:]
    near = {
        name: (when > at - 0.05) & (when < at + WINDOW + AFTER) for name, at in switches.items()
    }
    # the start of the motion is a switch of its own
    elsewhere = (when > 1.0) & ~np.any(list(near.values()), axis=0)
    usual = float(np.percentile(change[elsewhere], 90))
    sizes = {name: float(change[part].max()) / usual for name, part in near.items()}
    sizes["elsewhere"] = float(change[elsewhere].max()) / usual
    shown = [
        line(name, time[2000:], 1e3 * followed.error[2000:, followed.names.index(name)])
        for name in ("HIP", "LKN", "LSP", "LEB")
    ]
    title = "Algorithm 1, as printed" if method == "rhqp_thesis" else "Default"
    plot = Plot(f"Control errors, {title}", "time [s]", "[mrad]", shown,
                marks=tuple(switches.values()), thesis_marks=(15.0, 25.0))  # fmt: skip
    return sizes, plot, switches


@measures("S06")
def switching() -> Finding:
    """Of any joint: where the hip stops, is released and the shoulder stops, against the rest."""
    printed, plot, switches = spikes("rhqp_thesis")
    ours, soft, _ = spikes("lexicographic")
    return Finding(
        {
            "stop": printed["hip"],
            "release": min(printed["released"], printed["shoulder"]),
            "elsewhere": printed["elsewhere"] / min(printed["hip"], printed["released"]),
        },
        [
            Note("hip stops", switches["hip"], "s"),
            Note("hip released", switches["released"], "s"),
            Note("default, change where the hip stops over the usual", ours["hip"]),
            Note("default, where it is released", ours["released"]),
        ],
        [plot, soft],
    )
