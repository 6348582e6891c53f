"""M04 to M12: the left hand goes out of reach, the right one stays (Figures 4.14 to 4.18).

The thesis prints neither posture nor speed. Ours stretch the left arm at 17 s; the right arm's
start was sought so that its elbow and its shoulder roll meet their limits when the thesis says.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.standing import led
from hurcules_studies.thesis.measures.whole_body import DT, LEVELS, Body, Log, Setting, follow

START = {
    "KN": 2.017,
    "HIP": -0.91,
    "NKY": 0.17,
    "NKP": 0.21,
    "LSP": 0.10,
    "LSR": 0.05,
    "LSY": 0.10,
    "LEB": 2.05,
    "LWP": 0.2,
    "RSP": 0.543,
    "RSR": 0.070,
    "RSY": 0.034,
    "REB": 1.95,
    "RWY": -0.3,
    "RWP": -0.2,
}
SPEED = np.array([0.025, 0.001, -0.001])  # [m/s] of the left hand
LOWER, RIGHT = ("KN", "HIP", "WST", "NKY", "NKP"), "R"
RUNAWAY = 100.0  # [rad/s] at which nobody needs to see more
# a solve of DLS-HQP takes 0.1241 ms an iteration at eight levels (Table 4.2): nine are over 1 ms
TOO_LATE = 9
SETTINGS = {
    "RHQP": (Setting("rhqp_thesis", as_printed=True), 35.0),
    "default": (Setting(), 35.0),
    "HQP": (Setting("hqp", as_printed=True, clamped=False), 25.0),
    "HQP, clamped": (Setting("hqp", as_printed=True), 25.0),
    "DLS-HQP": (Setting("dls_hqp", as_printed=True, max_iterations=12), 30.0),
    "DLS-HQP, in time": (
        Setting("dls_hqp", as_printed=True, max_iterations=12, too_late=TOO_LATE),
        27.0,
    ),
}


@cache
def run(name: str) -> Log:
    """The motion by one of the settings."""
    setting, seconds = SETTINGS[name]
    return follow(Body(START, setting), lambda _: {"lhpos": SPEED}, seconds, RUNAWAY)


def others(log: Log) -> Array:
    """Largest speed of right arm, lower body and neck, (ticks,) [rad/s]."""
    return log.speed(*(name for name in log.names if name[0] == RIGHT or name in LOWER))


def at(log: Log, time: float) -> int:
    """Tick of a time."""
    return min(round(time / DT), len(log.time) - 1)


def speeds(name: str, title: str, columns: tuple[str, ...], marks: tuple[float, ...] = ()) -> Plot:
    """Velocities of some coordinates."""
    log = run(name)
    lines = [line(one, log.time, log.qd[:, log.of(one)]) for one in columns]
    return Plot(title, "time [s]", "[rad/s]", lines, marks=marks)


LEFT_ARM = ("LSP", "LSR", "LSY", "LEB", "LWY", "LWP", "LWY2")
RIGHT_ARM = ("RSP", "RSR", "RSY", "REB", "RWY", "RWP", "RWY2")


@measures("M04")
def gradually() -> Finding:
    """The left arm's largest joint speed."""
    log = run("RHQP")
    peak = int(log.arm.argmax())
    after = log.arm[peak : at(log, 23.0)]
    drop = float(np.max(after[:-100] - after[100:]))
    half = peak + int(np.argmax(after < 0.5 * log.arm[peak]))
    return Finding(
        {
            "from": float(log.time[peak]),
            "half": float(log.time[half] - log.time[peak]),
            "drop": drop / float(log.arm[peak]),
            "low": float(log.arm[at(log, 22.0)] / log.arm[peak]),
            "largest": float(np.abs(log.qd).max()),
        },
        plots=[
            speeds("RHQP", "Left arm, RHQP", LEFT_ARM, (float(log.time[peak]),)),
            speeds("default", "Left arm, default", LEFT_ARM),
        ],
    )


@measures("M05")
def diverges() -> Finding:
    """HQP, first without and then with the joints' speed limits."""
    free, clamped = run("HQP"), run("HQP, clamped")
    limits = Body(START).limits.max_velocity
    fast = np.sign(clamped.qd) * (np.abs(clamped.qd) > 0.5 * limits)
    turns = 0
    for column in fast.T:
        moving = column[column != 0]
        turns += int(np.sum(moving[1:] != moving[:-1]))
    beyond = np.max(np.abs(clamped.qd) / limits)
    return Finding(
        {
            "peak": float(np.abs(free.qd).max()),
            "when": float(free.time[np.argmax(np.abs(free.qd).max(axis=1) > 10.0)]),
            "clamped": float(beyond),
            "turns": turns,
            "posture": float(clamped.errors[:, 2:4].max()),
        },
        plots=[
            speeds("HQP", "Left arm, HQP", LEFT_ARM),
            speeds("HQP, clamped", "Left arm, HQP with speed limits", LEFT_ARM),
        ],
    )


@measures("M06")
def cycles() -> Finding:
    """DLS-HQP with at most 12 iterations; then with zero where that takes longer than the tick."""
    log, late = run("DLS-HQP"), run("DLS-HQP, in time")
    first = float(log.time[log.capped][0]) if log.capped.any() else float("nan")
    window = (log.time >= first) & (log.time < first + 2.0)
    cycling = (late.time >= first) & (late.time < first + 2.0)
    still = np.abs(late.qd).max(axis=1) == 0.0
    stops = int(np.sum(still[1:] & ~still[:-1]))
    iterations = [line(name, run(name).time, run(name).iterations) for name in ("RHQP", "DLS-HQP")]
    return Finding(
        {
            "first": first,
            "last": float(log.time[log.capped][-1]) if log.capped.any() else float("nan"),
            "share": float(log.capped[window].mean()),
            "iterations": float(log.iterations.max()),
            "stops": stops,
        },
        [
            Note(
                "share of the 2 s in which all speeds are zero, in time",
                float(still[cycling].mean()),
            )
        ],
        [
            Plot(
                "Iterations (after Fig. 4.16)",
                "time [s]",
                "",
                iterations,
                thesis_marks=(24.0, 26.0),
            ),
            speeds("DLS-HQP, in time", "Left arm, DLS-HQP in time", LEFT_ARM),
        ],
    )


@measures("M07")
def few_iterations() -> Finding:
    """Iterations are changes of the working set + 1."""
    log, default = run("RHQP"), run("default")
    lines = [
        line("RHQP", log.time, log.iterations),
        line("default", default.time, default.iterations),
    ]
    return Finding(
        {
            "iterations": float(log.iterations.max()),
            "default": default.changes(),
        },
        [Note("the same in the first ticks, from rest", default.changes(0.0))],
        plots=[Plot("Iterations", "time [s]", "", lines)],
    )


@measures("M08")
def limits() -> Finding:
    """REB at its upper limit, RSR at its lower one; the excess over any of the 38 limits."""
    log, default = run("RHQP"), run("default")
    elbow, shoulder = log.first("REB", 1), log.first("RSR", -1)
    held = sum(bool(log.active[:, i].any()) for i in range(len(log.names)))
    lines = [line(name, log.time, log.q[:, log.of(name)]) for name in ("REB", "RSR")]
    marks = (elbow, shoulder)
    return Finding(
        {
            "elbow": elbow,
            "shoulder": shoulder,
            "default_elbow": default.first("REB", 1),
            "default_shoulder": default.first("RSR", -1),
            "held": held,
            "excess": max(log.excess, default.excess),
        },
        plots=[
            Plot("RHQP", "time [s]", "[rad]", lines, marks, (24.5, 33.0), (2.48, -0.02)),
            speeds("RHQP", "Right arm, RHQP", RIGHT_ARM, marks),
            speeds("default", "Right arm, default", RIGHT_ARM),
        ],
    )


@measures("M09")
def waist_helps() -> Finding:
    """Half a second before and after the elbow's limit."""
    log = run("RHQP")
    when, waist = log.first("REB", 1), np.abs(log.qd[:, log.of("WST")])
    before, after = waist[at(log, when - 0.5)], waist[at(log, when + 0.5)]
    return Finding(
        {"when": when, "ratio": float(after / before)},
        plots=[speeds("RHQP", "Lower body and neck", LOWER, (when,))],
    )


@measures("M10")
def gives_up() -> Finding:
    """Errors at the end over those at 10 s, and of the hands throughout."""
    log = run("RHQP")
    early, late = log.errors[at(log, 10.0)], log.errors[-1]
    index = {name: i for i, name in enumerate(LEVELS[1:])}
    most = log.errors.max(axis=0)
    hands = [
        line(name, log.time, 1e3 * log.errors[:, index[name]])
        for name in ("lhpos", "rhpos", "lhor", "rhor")
    ]
    below = [line(name, log.time, log.errors[:, index[name]]) for name in ("pel", "swivel", "gaze")]
    return Finding(
        {
            "pel": float(late[index["pel"]] / early[index["pel"]]),
            "swivel": float(most[index["swivel"]] / early[index["swivel"]]),
            "position": float(max(most[index["lhpos"]], most[index["rhpos"]])),
            "orientation": float(max(most[index["lhor"]], most[index["rhor"]])),
        },
        plots=[
            Plot("Given up", "time [s]", "error [m, rad]", below),
            Plot("Hands", "time [s]", "error [mm, mrad]", hands),
        ],
    )


@measures("M11")
def regularization_moves_others() -> Finding:
    """Right arm, lower body and neck, while nothing conflicts."""
    quiet = {name: others(run(name))[100 : at(run(name), 15.0)] for name in ("RHQP", "DLS-HQP")}
    hqp = others(run("HQP"))[: at(run("HQP"), 15.0)]
    zero = float(run("HQP").time[np.argmax(others(run("HQP")) > 1e-6)])
    lines = [
        line(name, run(name).time[:15000], others(run(name))[:15000] + 1e-12)
        for name in ("RHQP", "DLS-HQP", "HQP")
    ]
    return Finding(
        {
            "rhqp": float(quiet["RHQP"].min()),
            "rhqp_most": float(quiet["RHQP"].max()),
            "dls": float(quiet["DLS-HQP"].min()),
            "hqp": float(hqp.max()),
        },
        [Note("HQP: the others move by more than 1e-6 rad/s from", zero, "s")],
        [Plot("Largest speed of all but the left arm", "time [s]", "[rad/s]", lines, log="y")],
    )


def control_errors(name: str, start: float) -> tuple[Array, Array, list[str], float]:
    """Time [s], errors [rad] and joints of the physics that follows a motion; ticks saturated."""
    log = run(name)
    body = Body(START)
    q, qd = log.q[at(log, start) :], log.qd[at(log, start) :]
    body.robot.set_configuration(q[0])
    followed = led(body.model, body.robot.qpos, q, qd)
    late = followed.saturated[round(2.0 / DT) :].sum()
    return start + followed.time, followed.error, followed.names, float(late)


@measures("M12")
def spikes() -> Finding:
    """The physics from 20 s on; the first two seconds, from rest, are left out."""
    values, plots = {}, []
    for name, key in (("RHQP", "rhqp"), ("default", "default")):
        time, error, names, saturated = control_errors(name, 20.0)
        shown = time > 22.0
        change = np.abs(error[200:] - error[:-200]).max(axis=1)
        when = time[200:]
        events = (run(name).first("REB", 1), run(name).first("RSR", -1))
        near = [(when > e) & (when < e + 0.4) for e in events]
        usual = float(np.percentile(change[(when > 22.2) & ~near[0] & ~near[1]], 90))
        if key == "rhqp":
            values["elbow"] = float(change[near[0]].max()) / usual
            values["shoulder"] = float(change[near[1]].max()) / usual
        values[f"{key}_largest"] = float(np.abs(error[shown]).max())
        values[f"{key}_saturated"] = saturated
        lines = [
            line(joint, time[shown], 1e3 * error[shown, i])
            for i, joint in enumerate(names)
            if joint in ("LSP", "LEB", "RSP", "RSR", "REB", "RWY", "RWP", "RWY2")
        ]
        plots.append(Plot(f"Control errors, {name}", "time [s]", "[mrad]", lines, marks=events))
    return Finding(values, plots=plots)
