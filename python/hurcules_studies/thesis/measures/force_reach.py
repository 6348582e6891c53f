"""K08 to K11: both hands reach out along the ground, pressing with 5 N (section 5.6.3).

By accelerations, inner velocity loop, in the physics, with elbow springs. The thesis prints neither
posture nor speed; ours were sought so that the hip meets its limit at 8 s and the shoulders theirs
at 11 s. A posture task below the gaze holds what the eleven rows of the thesis leave free: without
it the turn of the upper arm drifts off at 2 rad/s once the elbow is straight.
"""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from hurcules import ForceLoop
from hurcules_studies.thesis.claim import Finding, Line, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import G
from hurcules_studies.thesis.measures.force_loops import DESIRED
from hurcules_studies.thesis.measures.force_second_order import second
from hurcules_studies.thesis.measures.press_robot import Log, PressRobot, Setting, ramped
from hurcules_studies.thesis.measures.registry import measures

THESIS = (8.0, 11.0, 12.0)  # [s] hip; shoulders and hip; singularity
REACH = 0.0767  # [m/s]
START, STOP, END = 4.88, 16.5, 17.5  # [s]
REST, MAX_LEAD = 10.0, 5e-3  # [1/s], [m] of hands that are led on beyond their reach
BEYOND = 20.0  # [s] until when they are
ARM = ("LSP", "LSR", "LSY", "LEB", "RSP", "RSR", "RSY", "REB")


@cache
def reach(compliance: float, method: str = "lexicographic", end: float = END) -> Log:
    """Down to the ground, then ahead along it."""
    gains = second(ForceLoop.Velocity, compliance=compliance)
    robot = PressRobot(Setting(gains=gains, environment=G, f_max=1e6, method=method))
    robot.settle()
    return robot.follow(ramped(REACH, START, STOP), ramped(-0.02, 1.5, 60.0), end)


@cache
def led_on(rest: float, max_lead: float) -> Log:
    """The same, on for 3 s beyond the reach, then 2 s at rest."""
    setting = Setting(
        gains=second(ForceLoop.Velocity), environment=G, f_max=1e6, rest=rest, max_lead=max_lead
    )
    robot = PressRobot(setting)
    robot.settle()
    return robot.follow(ramped(REACH, START, BEYOND), ramped(-0.02, 1.5, 60.0), BEYOND + 2.0)


def speeds(log: Log, *names: str) -> NDArray[np.float64]:
    """Largest of some coordinates, all by default, (ticks,) [rad/s]."""
    columns = [log.of(name) for name in names or log.names]
    return np.asarray(np.abs(log.qd[:, columns]).max(axis=1))


def mean(values: NDArray[np.float64], log: Log, start: float, end: float) -> float:
    """Between two times."""
    return float(values[log.part(start, end)].mean())


def swings(log: Log, *names: str) -> float:
    """Largest speed in the last second of being led on, of all coordinates by default [rad/s]."""
    return float(speeds(log, *names)[log.part(BEYOND - 1.0, BEYOND)].max())


def weakest(log: Log) -> float:
    """Least pressing force then, negative [N]."""
    return float(log.force[log.part(BEYOND - 1.0, BEYOND)].max())


def lines_of(log: Log, values: NDArray[np.float64], *names: str, start: float = 4.0) -> list[Line]:
    """Of some coordinates."""
    part = log.part(start)
    return [line(name, log.time[part], values[part, log.of(name)]) for name in names]


def over_time(title: str, label: str, lines: list[Line], levels: tuple[float, ...] = ()) -> Plot:
    """With the times of the thesis."""
    return Plot(title, "time [s]", label, lines, thesis_marks=THESIS, levels=levels)


@measures("K08")
def outstretched() -> Finding:
    """Speeds of arms and whole robot around the time at which the elbows are straight.

    In the notes: hands that are led on beyond the reach, as in the thesis and as they should be.
    """
    log = reach(0.05)
    straight = min(log.when("LEB", -1)[0], log.when("REB", -1)[0])
    arm, whole = speeds(log, *ARM), speeds(log)
    hard = np.abs(log.qdd).max(axis=1)
    shown = ("KN", "HIP", "LSP", "LEB")
    swing, still = led_on(0.0, np.inf), led_on(REST, MAX_LEAD)
    return Finding(
        {
            "straight": straight,
            "arms": mean(arm, log, 12.4, 12.6) / mean(arm, log, 10.4, 10.6),
            "bounded": float(hard[log.part(11.5, 15.0)].max() / hard[log.part(7.0, 11.5)].max()),
            "whole": mean(whole, log, 13.4, 13.6) / mean(whole, log, 11.9, 12.0),
        },
        [
            Note("largest speed of the arms before", float(arm.max()), "rad/s"),
            Note("led on beyond the reach: elbows", swings(swing, "LEB", "REB"), "rad/s"),
            Note("with rest and maximum lead: elbows", swings(still, "LEB", "REB"), "rad/s"),
            Note("with rest and maximum lead: fastest joint", swings(still), "rad/s"),
            Note("force read then, with rest and maximum lead, least", weakest(still), "N"),
        ],
        [
            over_time("Speeds, C = 0.05", "[rad/s]", lines_of(log, log.qd, *shown)),
            over_time("Accelerations, C = 0.05", "[rad/s^2]", lines_of(log, log.qdd, *shown)),
        ],
    )


@measures("K09")
def limits_in_turn() -> Finding:
    """Limits as the controller takes and leaves them, and the commanded angles."""
    log = reach(0.05)
    on, off = log.when("HIP", 1)
    robot = PressRobot(Setting())
    excess = float(max((log.q - robot.joint.upper).max(), (robot.joint.lower - log.q).max()))
    upper = [float(robot.joint.upper[log.of(name)]) for name in ("HIP", "LSP")]
    return Finding(
        {
            "hip_on": on,
            "hip_off": off,
            "left": log.when("LSP", 1)[0],
            "right": log.when("RSP", 1)[0],
            "excess": max(excess, 0.0),
        },
        [Note("largest error of a joint behind its command", float(log.servo.max()), "rad")],
        [
            over_time(
                "Joints at their limits",
                "[rad]",
                lines_of(log, log.q, "HIP", "LSP", "RSP", "KN"),
                tuple(upper),
            ),
            over_time(
                "Pelvis task",
                "error [m]",
                [line("", log.time[log.part(4.0)], log.errors[log.part(4.0), 2])],
            ),
        ],
    )


@measures("K10")
def iterations() -> Finding:
    """Of Algorithm 1, and changes of the default solver, which hands weak directions down."""
    printed, ours = reach(0.05, "rhqp_thesis", 14.0), reach(0.05)
    steps = printed.changes + 1.0
    hip, shoulder = printed.when("HIP", 1)[0], printed.when("LSP", 1)[0]
    near = [printed.part(at - 0.5, at + 0.5) for at in (hip, shoulder)]
    part = printed.part(4.0)
    return Finding(
        {
            "hip": hip,
            "hip_steps": float(steps[near[0]].max()),
            "shoulder": shoulder,
            "shoulder_steps": float(steps[near[1]].max()),
            "elsewhere": float(np.percentile(steps[part], 99)),
        },
        [
            Note("hip released, Algorithm 1", printed.when("HIP", 1)[1], "s"),
            Note("hip released, default", ours.when("HIP", 1)[1], "s"),
            Note("most changes of the default at 8 s", _most(ours, 8.0)),
            Note("most changes of the default at 11 s", _most(ours, 11.0)),
        ],
        [over_time("Iterations", "", [line("Algorithm 1", printed.time[part], steps[part])])],
    )


def _most(log: Log, at: float) -> float:
    return float(log.changes[log.part(at - 0.5, at + 0.5)].max())


@measures("K11")
def compliances() -> Finding:
    """C = 0.05 and 0.10 m/N: force as read over the reach, with every switch of a limit in it."""
    logs = {C: reach(C) for C in (0.05, 0.10)}
    errors, force, moves, contact = {}, {}, {}, {}
    for C, log in logs.items():
        part = log.part(8.0, 15.5)
        error = log.force[part] - DESIRED
        errors[C] = float(np.sqrt((error**2).mean()))
        force[C] = float(log.force[part].mean())
        vertical = np.gradient(log.planned[:, 2], 1e-3)[part]
        moves[C] = float(np.sqrt((vertical**2).mean()))
        contact[C] = float(
            (np.convolve(log.contact[:, 0, 2], np.ones(10), "same")[part] < 0).mean()
        )
    lines = []
    for C, log in logs.items():
        part = log.part(4.0)
        lines.append(line(f"C = {C:g}", log.time[part], log.force[part, 0]))
    return Finding(
        {
            "force": force[0.05],
            "force_10": force[0.10],
            "visible": errors[0.05],
            "less": errors[0.10] / errors[0.05],
            "speeds": moves[0.10] / moves[0.05],
            "contact": min(contact.values()),
        },
        [
            Note("mean force on the ground, C = 0.05", _true(logs[0.05]), "N"),
            Note("rms error, C = 0.10", errors[0.10], "N"),
        ],
        [over_time("Force read, left hand", "[N]", lines, (DESIRED,))],
    )


def _true(log: Log) -> float:
    return float(log.contact[log.part(8.0, 15.5), 0, 2].mean())
