"""P05, P07: the servo on the robots in the physics, standing on their tracks."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import mujoco
import numpy as np

import hurcules
from hurcules import models
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.standing import DT, Followed, led

SUPPORT = "lower_leg_L"
REST = 1.5  # [s] before and after each posture
STAND = round(REST / DT)  # ticks in which the robot takes its stand, with integrals of zero
# the centre of 60 kg an arm lies 0.44 m from the elbow when it is carried (models/README.md)
LOAD_PLACE = (0.0, 0.0, -0.44)
# postures of the left arm, 7 joints each [rad]: reached out, sideways, folded, wrist turned
TUNING: tuple[Mapping[str, float], ...] = (
    {"LSP": 1.2, "LSR": 0.1, "LSY": 0.2, "LEB": 0.5, "LWY": 0.8, "LWP": 0.5, "LWY2": -0.8},
    {"LSP": 0.4, "LSR": 1.1, "LSY": -0.4, "LEB": 1.0, "LWY": -0.8, "LWP": -0.5, "LWY2": 0.8},
    {"LSP": 0.0, "LSR": 0.3, "LSY": 0.6, "LEB": 2.1, "LWY": 1.2, "LWP": 0.9, "LWY2": 0.4},
    {"LSP": 0.35, "LSR": 0.0, "LSY": 0.0, "LEB": 1.5, "LWY": 0.0, "LWP": 0.0, "LWY2": 0.0},
)
# both arms of the rescue robot, up and down again
LIFTING: tuple[Mapping[str, float], ...] = (
    {"LSP": 0.9, "RSP": 0.9, "LEB": 1.2, "REB": 1.2},
    {"LSP": 0.1, "RSP": 0.1, "LEB": 1.85, "REB": 1.85},
    {"LSP": 0.35, "RSP": 0.35, "LEB": 1.5, "REB": 1.5},
)


def way(
    robot: hurcules.Robot, postures: Sequence[Mapping[str, float]], seconds: float, rest: float
) -> tuple[Array, Array]:
    """Postures one after the other, with a smooth time law and a rest after each: q and qd."""
    q0, names = robot.configuration, robot.coordinate_names
    u = np.arange(round(seconds / DT)) * DT / seconds
    law, rate = u - np.sin(2 * np.pi * u) / (2 * np.pi), (1 - np.cos(2 * np.pi * u)) / seconds
    still = round(rest / DT)
    q, qd = [np.tile(q0, (still, 1))], [np.zeros((still, q0.size))]
    for posture in postures:
        goal = q0.copy()
        for name, angle in posture.items():
            goal[names.index(name)] = angle
        q += [q0 + law[:, None] * (goal - q0), np.tile(goal, (still, 1))]
        qd += [rate[:, None] * (goal - q0), np.zeros((still, q0.size))]
        q0 = goal
    return np.vstack(q), np.vstack(qd)


def ready(model: mujoco.MjModel) -> hurcules.Robot:
    """The robot as it stands ready."""
    robot = hurcules.Robot(model)
    robot.set_keyframe("ready")
    robot.stand_on(SUPPORT)
    return robot


def picture(title: str, runs: Mapping[str, Followed], *prefixes: str) -> Plot:
    """Errors of some joints, from when the robot has taken its stand."""
    lines = []
    for label, run in runs.items():
        for i, name in enumerate(run.names):
            if name.startswith(prefixes):
                text = f"{name} {label}".strip()
                lines.append(line(text, run.time[STAND:], 1e3 * run.error[STAND:, i]))
    return Plot(title, "time [s]", "error [mrad]", lines)


@measures("P05")
def tuning_postures() -> Finding:
    """Four postures, 3 s each, with rests between."""
    model = models.load("manipulation")
    robot = ready(model)
    qpos = robot.qpos
    q, qd = way(robot, TUNING, 3.0, REST)
    run = led(model, qpos, q, qd)
    arm = np.abs(run.of("LS", "LE", "LW"))
    others = np.abs(run.of("LKN", "RKN", "HIP", "WST"))[STAND:]
    return Finding(
        {
            "error": arm[STAND:].max(),
            "end": arm[-1].max(),
            "saturated": int(run.saturated[STAND:].sum()),
        },
        [Note("largest error of knees, hip and waist", float(others.max()), "rad")],
        [picture("Left arm", {"": run}, "LS", "LE", "LW")],
    )


def loaded(kilograms: float) -> mujoco.MjModel:
    """The rescue robot with a load on its lower arms, half on each."""
    spec = models.parse([models.path("rescue"), models.path("flat")])
    for side in "LR":
        if kilograms:
            arm = spec.body(f"{side}_larm")
            load = arm.add_body(name=f"{side}_load", pos=LOAD_PLACE)
            load.mass, load.inertia = kilograms / 2, [0.5, 0.5, 0.5]
            load.ipos, load.explicitinertial = [0.0, 0.0, 0.0], True
    return spec.compile()


@measures("P07")
def any_load() -> Finding:
    """The gains of the missions, with every load."""
    robot = ready(loaded(60.0))
    qpos = robot.qpos
    q, qd = way(robot, LIFTING, 3.0, REST)
    runs = {f"{load:g} kg": led(loaded(load), qpos, q, qd) for load in (0.0, 60.0, 120.0)}
    largest = {
        label: float(np.abs(run.of("LS", "LE", "RS", "RE"))[STAND:].max())
        for label, run in runs.items()
    }
    return Finding(
        {
            "load_0": largest["0 kg"],
            "load_60": largest["60 kg"],
            "load_120": largest["120 kg"],
            "saturated": sum(int(run.saturated[STAND:].sum()) for run in runs.values()),
        },
        plots=[
            picture("Shoulder pitch", runs, "LSP"),
            picture("Elbow", runs, "LEB"),
        ],
    )
