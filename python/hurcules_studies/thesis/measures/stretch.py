"""S01 to S06: one run of the mission stretch, seed 0, closed loop in the physics; Algorithm 1."""

from __future__ import annotations

from functools import cache

import numpy as np

import hurcules
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.stretch_printed import Run, run_printed

Log = dict[str, Array]

THESIS = (15.0, 25.0)  # [s]
WINDOW = 0.2  # [s] in which a change of control errors counts as a spike


@cache
def run() -> tuple[Log, dict[str, float], float]:
    """Log from the start of the stretch on, the mission's figures, worst commanded excess [rad]."""
    simulation = hurcules.Simulation("stretch", seed=0)
    while not simulation.finished:
        simulation.step(1000)
    log = simulation.log()
    start = log["time"][log["phase"] == 1][0] - simulation.dt
    stretching = log["phase"] == 1
    part = {name: values[stretching] for name, values in log.items()}
    part["time"] = part["time"] - start
    excess = simulation.limit_violation()["commanded"]["position_rad"]
    return part, simulation.figures(), float(excess)


def at(log: Log, name: str, time: float) -> float:
    """A channel at a time."""
    return float(log[name][np.searchsorted(log["time"], time)])


def picture(log: Log, title: str, names: dict[str, str], label: str, scale: float = 1.0) -> Plot:
    """Channels over time, with what happened here and in the thesis."""
    figures = run()[1]
    lines = [line(text, log["time"], scale * log[name]) for name, text in names.items()]
    marks = (figures["hip_locked_s"], figures["hip_released_s"])
    return Plot(title, "time [s]", label, lines, marks=marks, thesis_marks=THESIS)


@measures("S01")
def one_command() -> Finding:
    """Commands of the operator, in the order of the mission's channels."""
    log, figures, _ = run()
    commands = {name: values for name, values in log.items() if name.startswith("command/")}
    forward = ("command/left_hand_x", "command/right_hand_x")
    used = [name for name, values in commands.items() if np.any(values)]
    others = [np.abs(values).max() for name, values in commands.items() if name not in forward]
    return Finding(
        {
            "commands": len(used),
            "other": float(max(others)),
            "way": figures["stretched_m"],
        },
        plots=[picture(log, "Commands", {forward[0]: "left", forward[1]: "right"}, "[m/s]")],
    )


@measures("S02")
def hip_stops() -> Finding:
    """The hip is held from its limit to its release."""
    log, figures, _ = run()
    stop, free = figures["hip_locked_s"], figures["hip_released_s"]
    held = (log["time"] > stop + 1.0) & (log["time"] < free - 0.1)
    before = (log["time"] > 1.0) & (log["time"] < stop - 0.2)
    knee = np.abs(log["qd_des/KN"])
    later = abs(at(log, "qd_des/KN", stop + 1.0))
    return Finding(
        {
            "hip": stop,
            "rhqp_hip": run_printed().switches["hip stops"],
            "hip_speed": float(np.abs(log["qd_des/HIP"][held]).max()),
            "knee_before": float(knee[before].max()) / later,
            "pelvis_at": figures["pelvis_error_at_hip_locked_m"],
            "pelvis_later": at(log, "error/pel", stop + 5.0),
        },
        plots=[
            picture(log, "Hip and knee", {"q_des/HIP": "HIP", "q_des/KN": "KN"}, "[rad]"),
            picture(log, "Speeds", {"qd_des/HIP": "HIP", "qd_des/KN": "KN"}, "[rad/s]"),
            picture(log, "Pelvis task", {"error/pel": ""}, "error [m]"),
        ],
    )


@measures("S03")
def hip_released() -> Finding:
    """Shoulder pitch of either arm."""
    log, figures, _ = run()
    free, printed = figures["hip_released_s"], run_printed().switches
    return Finding(
        {
            "shoulder": figures["shoulder_locked_s"],
            "released": free,
            "apart": abs(free - figures["shoulder_locked_s"]),
            "rhqp_shoulder": printed["shoulder stops"],
            "rhqp_released": printed["hip released"],
            "rhqp_apart": abs(printed["hip released"] - printed["shoulder stops"]),
            "hip_speed": abs(at(log, "qd_des/HIP", free + 1.0)),
        },
        plots=[
            picture(log, "Shoulder pitch", {"q_des/LSP": "LSP", "q_des/RSP": "RSP"}, "[rad]"),
            picture(
                log,
                "Held by a limit (1: upper)",
                {"active/HIP": "HIP", "active/LSP": "LSP"},
                "",
            ),
        ],
    )


@measures("S04")
def gaze() -> Finding:
    """Of the measured motion and of the commanded one."""
    log, figures, _ = run()
    return Finding(
        {
            "gaze": figures["gaze_error_measured_max_rad"],
            "commanded": figures["gaze_error_max_rad"],
            "neck": float(np.ptp(log["q_des/NKP"])),
        },
        plots=[
            picture(log, "Gaze error, measured", {"measured_error/gaze": ""}, "[mrad]", 1e3),
            picture(log, "Neck tilt", {"q_des/NKP": ""}, "[rad]"),
        ],
    )


@measures("S05")
def pelvis_gives_way() -> Finding:
    """Errors of the commanded motion, and the excess over any position limit."""
    log, figures, excess = run()
    return Finding(
        {
            "pelvis": figures["pelvis_error_m"],
            "hand": figures["hand_error_max_m"],
            "hand_measured": figures["hand_error_final_m"],
            "pitch": figures["pitch_error_max_rad"],
            "excess": excess,
        },
        plots=[
            picture(log, "Pelvis task", {"error/pel": ""}, "error [m]"),
            picture(log, "Hands", {"error/hpos": ""}, "error [mm]", 1e3),
            picture(log, "Lower-arm pitch", {"error/hpitch": ""}, "error [mrad]", 1e3),
        ],
    )


def spikes(time: Array, errors: Array, stop: float, release: float) -> dict[str, float]:
    """Changes of any joint's error, (ticks, joints) [rad], at the switches [s] and elsewhere."""
    width = round(WINDOW / 1e-3)
    change = np.abs(errors[width:] - errors[:-width]).max(axis=1)
    when = time[width:]
    near = [(when > at - 0.05) & (when < at + WINDOW + 0.3) for at in (stop, release)]
    # the start of the motion is a switch of its own
    elsewhere = ~np.any(near, axis=0) & (when > 1.0)
    sizes = [float(change[part].max()) for part in near]
    usual = float(np.percentile(change[elsewhere], 90))
    return {
        "stop": sizes[0] / usual,
        "release": sizes[1] / usual,
        "largest": sizes[1] / float(change[elsewhere].max()),
    }


def printed_errors(one: Run) -> Plot:
    """Of some joints, with the switches here and in the thesis."""
    moving = one.time > 0.0
    lines = [
        line(name, one.time[moving], 1e3 * one.errors[moving, one.joints.index(name)])
        for name in ("HIP", "LKN", "LSP")
    ]
    marks = tuple(one.switches.values())
    return Plot(
        "Control errors, Algorithm 1", "time [s]", "[mrad]", lines, marks, thesis_marks=THESIS
    )


@measures("S06")
def switching() -> Finding:
    """Of the mission, and of Algorithm 1 with limits as printed."""
    log, figures, _ = run()
    names = [name for name in log if name.startswith("joint_error/") and "belt" not in name]
    errors = np.array([log[name] for name in names]).T
    ours = spikes(log["time"], errors, figures["hip_locked_s"], figures["hip_released_s"])
    one = run_printed()
    at = one.switches
    printed = spikes(one.time, one.errors, at["hip stops"], at["hip released"])
    shown = {"joint_error/HIP": "HIP", "joint_error/LKN": "LKN", "joint_error/LSP": "LSP"}
    return Finding(
        ours | {f"rhqp_{name}": value for name, value in printed.items()},
        [
            Note("largest control error, default", figures["joint_error_max_rad"], "rad"),
            *(
                Note(f"jump of the commanded speeds, RHQP, {name}", jump, "rad/s")
                for name, jump in one.jumps.items()
            ),
        ],
        [picture(log, "Control errors, default", shown, "[mrad]", 1e3), printed_errors(one)],
    )
