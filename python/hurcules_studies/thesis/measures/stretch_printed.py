"""The stretch by Algorithm 1 with limits as printed, followed by the servo in the physics.

The mission's default bounds brake a joint before its limit, so that its control errors hardly show
a switch; the thesis takes a limit within one step (4.3.9 with T = 1). Stack, start and command are
those of the mission.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import mujoco
import numpy as np

import hurcules
from hurcules import Stack, StackLevel, models
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.standing import led
from hurcules_studies.thesis.measures.whole_body import DT, Setting

SPEED = 0.0215  # [m/s] of both hands
SETTLE, SECONDS = 2.0, 32.0  # [s] of rest before; of the motion, past the last switch


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


@dataclass(frozen=True)
class Run:
    """What the physics made of the motion.

    Attributes:
        time: (ticks,) [s] since the hands move.
        errors: (ticks, joints) [rad] of those that the hierarchy moves.
        joints: their names.
        switches: [s] the three that the thesis names.
        jumps: [rad/s] of any joint's commanded speed at these three.
    """

    time: Array
    errors: Array
    joints: list[str]
    switches: dict[str, float]
    jumps: dict[str, float]


@cache
def run_printed() -> Run:
    """Plans the motion, and follows it."""
    stretch = Stretch(Setting("rhqp_thesis", as_printed=True))
    names = stretch.robot.coordinate_names
    q, qd, active = stretch.motion()
    time = np.asarray(DT * np.arange(len(q)) - SETTLE, dtype=np.float64)
    hip = active[:, names.index("HIP")] != 0
    shoulder = (active[:, names.index("LSP")] != 0) | (active[:, names.index("RSP")] != 0)
    switches = {
        "hip stops": float(time[np.argmax(hip)]),
        "hip released": float(time[len(hip) - np.argmax(hip[::-1])]),
        "shoulder stops": float(time[np.argmax(shoulder)]),
    }
    jump = np.abs(np.diff(qd, axis=0)).max(axis=1)
    jumps = {name: float(jump[np.abs(time[1:] - at) < 0.01].max()) for name, at in switches.items()}
    led_by = led(stretch.model, stretch.qpos, q, qd)
    joints = led_by.names[: led_by.moved]
    return Run(time, led_by.error[:, : led_by.moved], joints, switches, jumps)
