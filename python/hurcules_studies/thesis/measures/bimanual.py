"""M13 to M16: both hands hold one object (Figures 4.19 to 4.21).

The thesis prints neither postures nor speeds; ours were sought so that the right elbow meets its
limit at 5 s and leaves it at 12 s while the object goes to the left, and so that both elbows meet
theirs when the object comes to the body.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.registry import measures
from hurcules_studies.thesis.measures.whole_body import Body, Log, Setting, follow


def posture(SP: float, SR: float, EB: float, WP: float = 0.0) -> dict[str, float]:
    """Both arms alike."""
    arms = {"SP": SP, "SR": SR, "EB": EB, "WP": WP}
    body = {"KN": 2.017, "HIP": -0.91, "NKP": 0.21}
    return body | {side + joint: angle for side in "LR" for joint, angle in arms.items()}


ASIDE = posture(0.5, 0.3, 2.35)
ASIDE_SPEED = np.array([-0.0083, 0.0167, 0.0])  # [m/s]
ASIDE_SECONDS = 20.0
TO_BODY = posture(0.9, 0.3, 2.2)
OTHER = posture(0.6, 0.3, 2.2)  # of the two, the one in which Algorithm 1 keeps the elbows
PULL = np.array([-0.03, 0.0, 0.0])  # [m/s]
REVERSAL, PULL_SECONDS = 3.7, 8.0  # [s]
SETTINGS = {
    "RHQP": Setting("rhqp_thesis", as_printed=True),
    "default": Setting(),
    "RHQP, free": Setting("rhqp_thesis", as_printed=True, clamped=False),
    "HQP": Setting("hqp", as_printed=True, clamped=False),
    "DLS-HQP": Setting("dls_hqp", as_printed=True, max_iterations=12),
}


@cache
def aside(name: str) -> Log:
    """The object goes to the left and to the body."""
    both = {"lhpos": ASIDE_SPEED, "rhpos": ASIDE_SPEED}
    return follow(Body(ASIDE, SETTINGS[name]), lambda _: both, ASIDE_SECONDS, 100.0)


@cache
def to_body(name: str, other: bool = False) -> Log:
    """The object comes to the body, then goes back."""
    pull, push = ({"lhpos": v, "rhpos": v} for v in (PULL, -PULL))
    body = Body(OTHER if other else TO_BODY, SETTINGS[name])
    return follow(body, lambda t: pull if t < REVERSAL else push, PULL_SECONDS)


def joints(log: Log, title: str, names: tuple[str, ...], marks: tuple[float, ...] = ()) -> Plot:
    """Positions of some coordinates."""
    lines = [line(name, log.time, log.q[:, log.of(name)]) for name in names]
    return Plot(title, "time [s]", "[rad]", lines, marks=marks)


def iterations(logs: dict[str, Log]) -> Plot:
    """Of some methods."""
    lines = [line(name, log.time, log.iterations) for name, log in logs.items()]
    return Plot("Iterations", "time [s]", "", lines)


def wrist_speed(log: Log, window: float = 1.0) -> tuple[float, float, float]:
    """Least |LWP| [rad], its time [s], and the largest speed of that wrist around it [rad/s]."""
    bend = np.abs(log.q[:, log.of("LWP")])
    moment = int(bend.argmin())
    time = float(log.time[moment])
    around = np.abs(log.time - time) < window
    return float(bend[moment]), time, float(log.speed("LWY", "LWP", "LWY2")[around].max())


@measures("M13")
def internal_singularity() -> Finding:
    """The wrist's bend is zero, so that both roll axes align; Algorithm 1 without speed limits."""
    ours, printed = aside("default"), aside("RHQP, free")
    bend, time, speed = wrist_speed(printed)
    hqp = wrist_speed(aside("HQP"))
    wrist = ("LWY", "LWP", "LWY2")
    lines = [
        line(f"{label} {name}", log.time, log.qd[:, log.of(name)])
        for label, log in (("RHQP", printed), ("HQP", aside("HQP")))
        for name in ("LWY", "LWY2")
    ]
    return Finding(
        {
            "bend": bend,
            "rhqp": speed,
            "default": wrist_speed(ours)[2],
            "largest": float(max(np.abs(log.qd).max() for log in (ours, printed))),
        },
        [
            Note("both axes align at", time, "s"),
            Note("largest speed of the left wrist there, HQP", hqp[2], "rad/s"),
        ],
        [
            joints(printed, "Left wrist, RHQP", wrist, (time,)),
            Plot("Speeds of the left wrist", "time [s]", "[rad/s]", lines, marks=(time,)),
        ],
    )


@measures("M14")
def taken_and_left() -> Finding:
    """When each method takes and leaves the limit of the right elbow."""
    logs = {name: aside(name) for name in ("RHQP", "default", "DLS-HQP")}
    on = {name: log.first("REB", 1) for name, log in logs.items()}
    off = {name: log.last("REB", 1) for name, log in logs.items()}
    return Finding(
        {
            "on": on["default"],
            "off": off["default"],
            "rhqp_on": on["RHQP"],
            "rhqp_off": off["RHQP"],
            "shoulder": logs["default"].first("RSR", -1),
            "rhqp_iterations": float(logs["RHQP"].iterations.max()),
            "changes": logs["default"].changes(),
            "dls_later": off["DLS-HQP"] - off["default"],
            "dls_capped": float(logs["DLS-HQP"].capped.sum()),
            "excess": max(log.excess for log in logs.values()),
        },
        plots=[
            joints(
                logs["default"], "Default", ("REB", "RSR", "LEB"), (on["default"], off["default"])
            ),
            joints(
                logs["DLS-HQP"], "DLS-HQP", ("REB", "RSR", "LEB"), (on["DLS-HQP"], off["DLS-HQP"])
            ),
            iterations(logs),
        ],
    )


def kept_after(log: Log) -> float:
    """How long after the reversal the later elbow is still held [s]."""
    return max(log.last(name, 1) for name in ("LEB", "REB")) - REVERSAL


@measures("M15")
def pull_then_push() -> Finding:
    """Default and Algorithm 1, in both postures."""
    logs = {name: to_body(name) for name in ("RHQP", "default")}
    on = max(logs["default"].first(name, 1) for name in ("LEB", "REB"))
    other = {name: kept_after(to_body(name, other=True)) for name in ("RHQP", "default")}
    lines = [
        line(f"{name}, {label}", log.time, log.errors[:, 4])
        for label, pair in (("", logs),)
        for name, log in pair.items()
    ]
    return Finding(
        {
            "on": on,
            "default": kept_after(logs["default"]),
            "rhqp": kept_after(logs["RHQP"]),
            "other_default": other["default"],
            "other_rhqp": other["RHQP"],
            "pel": float(max(log.errors[-1, 4] for log in logs.values())),
        },
        plots=[
            joints(logs["RHQP"], "RHQP", ("LEB", "REB"), (on, REVERSAL)),
            joints(logs["default"], "Default", ("LEB", "REB"), (on, REVERSAL)),
            Plot("Pelvis and body", "time [s]", "error [m, rad]", lines, marks=(on, REVERSAL)),
        ],
    )


@measures("M16")
def dls_keeps() -> Finding:
    """DLS-HQP in both postures."""
    logs = {"first posture": to_body("DLS-HQP"), "second posture": to_body("DLS-HQP", other=True)}
    kept = [kept_after(log) for log in logs.values()]
    given = [float(log.errors[-1, 4]) for log in logs.values()]
    return Finding(
        {"kept": max(kept), "pel": max(given)},
        plots=[
            joints(log, f"DLS-HQP, {label}", ("LEB", "REB"), (REVERSAL,))
            for label, log in logs.items()
        ],
    )
