"""The plots of a report, after Figures 4.24 to 4.26 of the thesis: each makes SVG of a log."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from itertools import cycle, product

import numpy as np
from matplotlib.axes import Axes
from numpy.typing import NDArray

from hurcules._core import MonitorOptions
from hurcules.casualties import CARRIES, contact_limit
from hurcules.legend import joint_words, level_words, region_words
from hurcules.report.style import (
    ACCENT,
    GREY,
    INK,
    LINES,
    axes,
    below,
    cells,
    decimate,
    mark,
    side_by_side,
    svg,
)

__all__ = [
    "active_limits",
    "control_errors",
    "joint_positions",
    "joint_velocities",
    "load",
    "monitors",
    "of_model",
    "person",
    "quantities",
    "region_forces",
    "solver_work",
    "task_errors",
    "tick_times",
]

Array = NDArray[np.float64]
Log = dict[str, Array]  # see hurcules.recording.CHANNELS

MOVES = 0.02  # [rad] a coordinate that moves less is left out of the plots of joints


def joint_positions(log: Log, events: Sequence[float], sliding: Sequence[str] = ()) -> str:
    """Each coordinate that moves, with its limits; shaded while a limit holds it."""
    names = moving(log)
    drawn = cells(len(names))
    for (_, plot), name in zip(drawn, names, strict=True):
        plot.plot(*decimate(log["time"], log[f"q/{name}"]), color=INK)
        _draw_limits(plot, log, name)
        mark(plot, events)
        plot.set_title(_title(name))
        plot.set_xlabel("time [s]")
        plot.set_ylabel("position [m]" if name in sliding else "position [rad]")
    return side_by_side(drawn)


def joint_velocities(log: Log, events: Sequence[float], sliding: Sequence[str] = ()) -> str:
    """Reference velocities of the coordinates (Figure 4.26 a)."""
    names = moving(log)
    series = {name: log[f"qd_des/{name}"] for name in names}
    units = _units(names, sliding, "rad/s", "m/s")
    return _lines(log["time"], series, events, f"reference velocity [{units}]")


def control_errors(log: Log, events: Sequence[float], sliding: Sequence[str] = ()) -> str:
    """Reference minus measured position of the joints (Figure 4.26 b)."""
    joints = _after(log, "joint_error/")
    # the joint of a coordinate has its name, or L before it: both knees are one coordinate
    shown = [j for name in moving(log) for j in joints if j in (name, f"L{name}")]
    series = {name: 1e3 * log[f"joint_error/{name}"] for name in shown}
    units = _units(moving(log), sliding, "mrad", "mm")
    return _lines(log["time"], series, events, f"control error [{units}]")


def task_errors(log: Log, events: Sequence[float]) -> str:
    """The error of each level below the limits."""
    names = [name for name in _after(log, "error/") if np.any(log[f"error/{name}"])]
    drawn = cells(len(names))
    for (_, plot), name in zip(drawn, names, strict=True):
        plot.plot(*decimate(log["time"], log[f"error/{name}"]), color=INK)
        mark(plot, events)
        plot.set_title(f"{level_words(name)} ({name})")
        plot.set_xlabel("time [s]")
        plot.set_ylabel("error [m, rad]")
        plot.ticklabel_format(axis="y", scilimits=(-3, 3))
    return side_by_side(drawn)


def active_limits(log: Log, events: Sequence[float]) -> str:
    """When which position limit holds a coordinate."""
    names = [name for name in coordinates(log) if np.any(log[f"active/{name}"])]
    figure, plot = axes(0.7 + 0.28 * max(1, len(names)))
    for row, name in enumerate(names):
        for side, shade in ((1, ACCENT), (-1, GREY)):
            spans = _spans(log["time"], log[f"active/{name}"] == side)
            plot.broken_barh(spans, (row - 0.32, 0.64), color=shade, linewidth=0)
    mark(plot, events)
    plot.set_yticks(range(len(names)), [_title(name) for name in names], color=INK)
    plot.set_ylim(max(1, len(names)) - 0.4, -0.6)
    plot.set_xlim(log["time"][0], log["time"][-1])
    plot.set_xlabel("time [s]    (orange: upper limit, grey: lower limit)")
    return svg(figure)


# of the monitors: what is drawn, its title, and the threshold of its alarm (MonitorOptions)
_MONITORS = (
    ("self_collision_distance_m", "distance to itself [m]", "min_distance"),
    ("static_margin_m", "static margin [m]", "min_margin"),
    ("pressure_margin_m", "pressure margin [m]", ""),
    ("tip_angle_rad", "tip angle [rad]", "min_tip_angle"),
    ("energy_margin_J", "energy margin [J]", ""),
    ("motor_temperature_C", "hottest motor [°C]", "max_temperature"),
)


def monitors(log: Log, events: Sequence[float]) -> str:
    """What the monitors saw, with the thresholds of their alarms where these are near."""
    seen = [one for one in _MONITORS if not np.all(np.isnan(log[f"monitor/{one[0]}"]))]
    drawn = cells(len(seen))
    defaults = MonitorOptions()
    for (_, plot), (name, title, threshold) in zip(drawn, seen, strict=True):
        values = log[f"monitor/{name}"]
        plot.plot(*decimate(log["time"], values), color=INK)
        mark(plot, events)
        plot.set_title(title)
        plot.set_xlabel("time [s]")
        if not threshold:
            continue
        limit = getattr(defaults, threshold)
        low, high = float(np.min(values)), float(np.max(values))
        # zero, or the threshold where it is in sight, belongs into the picture
        if low - 3 * (high - low) - abs(limit) <= limit <= high + 3 * (high - low):
            plot.axhline(limit, color=ACCENT, linewidth=1.0, linestyle=(0, (5, 2)))
    return side_by_side(drawn)


_OF_MODEL = ("position/", "distance/", "joint/", "joint_velocity/", "sensor/", "contact_force/")


def of_model(log: Log) -> list[str]:
    """The columns that a mission's table asked for, beside those of every run."""
    return [name for name in log if name.startswith(_OF_MODEL)]


def quantities(log: Log, events: Sequence[float]) -> str:
    """What the table of a mission reads of its model."""
    drawn = cells(len(names := of_model(log)))
    for (_, plot), name in zip(drawn, names, strict=True):
        plot.plot(*decimate(log["time"], log[name]), color=INK, linewidth=0.9)
        mark(plot, events)
        plot.set_title(name)
        plot.set_xlabel("time [s]")
    return side_by_side(drawn)


SUPPORT = 1200.0  # [N] on a region of the person: what the missions' tables stop at
# of the person: channel, title, and what it should stay below
_PERSON = (
    ("contact_share", "contact force over its region's limit", 1.0),
    ("support_n", "largest force that carries a region [N]", SUPPORT),
    ("head_mps2", "acceleration of the head [m/s²]", 98.1),
)
_BEARERS = {
    "on_ground": "ground",
    "on_left_arm": "left arm",
    "on_right_arm": "right arm",
    "on_bed": "bed",
}
_LOAD = (("height_m", "height above its place [m]"), ("off_m", "handles from the hands [m]"))
_HOLDERS = {
    "on_ground": "ground",
    "on_left_hand": "left hand",
    "on_right_hand": "right hand",
    "in_container": "container",
}


def person(log: Log, events: Sequence[float]) -> str:
    """What is done to a person who is lifted, beside its limits, and what bears him."""
    drawn = cells(len(_PERSON) + 1)
    for (_, plot), (name, title, limit) in zip(drawn, _PERSON, strict=False):
        values = log[f"casualty/{name}"]
        plot.plot(*decimate(log["time"], values), color=INK, linewidth=0.9)
        plot.axhline(limit, color=ACCENT, linewidth=1.0, linestyle=(0, (5, 2)))
        plot.set_title(title)
    _borne(drawn[-1][1], log, "casualty", _BEARERS, "share of his weight on")
    for _, plot in drawn:
        mark(plot, events)
        plot.set_xlabel("time [s]")
    return side_by_side(drawn) + _regions(log)


def region_forces(log: Log) -> dict[str, tuple[float, float]]:
    """The largest force of the robot on each region [N]: as a contact, and as it carries him."""
    lies = log["casualty/on_ground"] > CARRIES
    forces = {name: log[f"casualty/force/{name}"] for name in _after(log, "casualty/force/")}
    return {
        region: (float(np.max(force[lies], initial=0.0)), float(np.max(force[~lies], initial=0.0)))
        for region, force in forces.items()
    }


def _regions(log: Log) -> str:
    """The same as bars, each contact beside its limit."""
    forces = {name: two for name, two in region_forces(log).items() if max(two) >= 1.0}
    if not forces:
        return ""
    figure, plot = axes(0.8 + 0.3 * len(forces))
    at = np.arange(len(forces))
    contact, carries = np.array(list(forces.values())).T
    plot.barh(at - 0.2, contact, 0.36, color=INK, label="contact")
    plot.barh(at + 0.2, carries, 0.36, color=GREY, label="carries him")
    limits = np.array([contact_limit(name) for name in forces])
    plot.vlines(
        limits, at - 0.42, at + 0.02, color=ACCENT, linewidth=2.0, label="limit of a contact"
    )
    plot.set_yticks(at, [region_words(name) for name in forces])
    plot.invert_yaxis()
    plot.set_xlabel("largest force of the robot [N]")
    plot.legend()
    return svg(figure)


def load(log: Log, events: Sequence[float]) -> str:
    """How a thing is held that is carried, and what bears it."""
    drawn = cells(len(_LOAD) + 2)
    for (_, plot), (name, title) in zip(drawn, _LOAD, strict=False):
        plot.plot(*decimate(log["time"], log[f"load/{name}"]), color=INK, linewidth=0.9)
        plot.set_title(title)
    _, plot = drawn[-2]
    for side, colour in zip(("left", "right"), LINES, strict=False):
        force = log[f"load/{side}_grip_n"]
        plot.plot(*decimate(log["time"], force), color=colour, label=f"{side} hand")
    plot.set_title("the fingers press [N]")
    below(plot)
    _borne(drawn[-1][1], log, "load", _HOLDERS, "share of its weight on")
    for _, plot in drawn:
        mark(plot, events)
        plot.set_xlabel("time [s]")
    return side_by_side(drawn)


def _borne(plot: Axes, log: Log, prefix: str, bearers: Mapping[str, str], title: str) -> None:
    for (name, label), colour in zip(bearers.items(), LINES, strict=False):
        plot.plot(*decimate(log["time"], log[f"{prefix}/{name}"]), color=colour, label=label)
    plot.set_ylim(-0.1, 1.3)
    plot.set_title(title)
    below(plot)


def solver_work(log: Log, events: Sequence[float]) -> str:
    """Factorizations and working-set changes of each solve."""
    drawn = cells(2, 4.0)
    for (_, plot), name in zip(drawn, ("factorizations", "changes"), strict=True):
        plot.plot(*decimate(log["time"], log[name]), color=INK, linewidth=0.9)
        mark(plot, events)
        plot.set_title(f"{name} per solve")
        plot.set_xlabel("time [s]")
        plot.set_ylim(bottom=0)
    return side_by_side(drawn)


def tick_times(log: Log, events: Sequence[float]) -> str:
    """How long a control tick took: over time, and how often."""
    drawn = cells(2, 4.0)
    (_, series), (_, histogram) = drawn
    micros = log["tick_us"]
    # beyond that lie the few ticks in which the system did something else
    most = 3.0 * float(np.percentile(micros, 99))
    series.plot(*decimate(log["time"], micros), color=GREY, linewidth=0.6)
    series.set_xlabel("time [s]")
    series.set_ylabel("control tick [µs]")
    series.set_ylim(0, most)
    mark(series, events)
    histogram.hist(micros, bins=80, range=(0.0, most), color=GREY)
    for share, name, height in ((50, "median", 0.9), (99, "p99", 0.7)):
        value = float(np.percentile(micros, share))
        histogram.axvline(value, color=ACCENT, linewidth=1.0)
        text = f"  {name} {value:.0f} µs"
        histogram.annotate(text, (value, height), xycoords=("data", "axes fraction"), color=INK)
    text = f"largest {np.max(micros):.0f} µs"
    histogram.annotate(text, (1.0, 0.5), xycoords="axes fraction", ha="right", color=INK)
    histogram.set_xlabel("control tick [µs]")
    histogram.set_ylabel("ticks")
    return side_by_side(drawn)


def shifted(log: Log, origin: float) -> Log:
    """The log with its times counted from `origin` [s]."""
    return log | {"time": log["time"] - origin}


def settled(log: Log) -> Log:
    """The log from 0 s on, which is where the robot has taken its stand."""
    later = log["time"] >= 0.0
    return {name: values[later] for name, values in log.items()}


def coordinates(log: Log) -> list[str]:
    """The names of the coordinates in a log."""
    return _after(log, "q/")


def moving(log: Log) -> list[str]:
    """The coordinates that move, those of the right arm left out where they mirror the left."""
    moved = [name for name in coordinates(log) if np.ptp(log[f"q/{name}"]) > MOVES]
    return [
        name
        for name in moved
        if not (name.startswith("R") and "L" + name[1:] in moved and _mirrors(log, name))
    ]


def _units(names: Sequence[str], sliding: Sequence[str], turning: str, straight: str) -> str:
    """Of these coordinates, both where there are both."""
    kinds = {straight if name in sliding else turning for name in names}
    return ", ".join(sorted(kinds, reverse=True))


def _mirrors(log: Log, name: str) -> bool:
    right, left = log[f"q/{name}"], log[f"q/L{name[1:]}"]
    return bool(np.max(np.abs(np.abs(right) - np.abs(left))) < MOVES)


def _lines(time: Array, series: Log, events: Sequence[float], label: str) -> str:
    """Lines by name over the same time."""
    figure, plot = axes(3.4)
    looks = cycle(product(("-", "--"), LINES))
    for (name, values), (dash, colour) in zip(series.items(), looks, strict=False):
        plot.plot(*decimate(time, values), dash, color=colour, label=_title(name))
    mark(plot, events)
    plot.set_xlabel("time [s]")
    plot.set_ylabel(label)
    if series:
        plot.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18), ncols=3)
    return svg(figure)


def _draw_limits(plot: Axes, log: Log, name: str) -> None:
    """The limits in grey as far as they are near the motion, and a shade where one is active."""
    low, high = plot.get_ylim()
    room = 0.35 * (high - low)
    for side in ("lower", "upper"):
        limit = log[f"limit_{side}/{name}"]
        near = (limit > low - room) & (limit < high + room)
        if np.any(near):
            plot.plot(
                *decimate(log["time"], limit), color=ACCENT, linewidth=1.0, linestyle=(0, (5, 2))
            )
    for start, length in _spans(log["time"], log[f"active/{name}"] != 0):
        plot.axvspan(start, start + length, color=ACCENT, alpha=0.12, linewidth=0)


def _spans(time: Array, active: NDArray[np.bool_]) -> list[tuple[float, float]]:
    """(start, length) [s] of each stretch of time in which `active` (ticks,) holds."""
    edges = np.flatnonzero(np.diff(np.concatenate(([False], active, [False])).astype(int)))
    stops = np.append(time, time[-1])
    return [(time[a], stops[b] - time[a]) for a, b in zip(edges[::2], edges[1::2], strict=True)]


def _title(name: str) -> str:
    words = joint_words(name)
    return name if words == name else f"{words} ({name})"


def _after(log: Log, prefix: str) -> list[str]:
    return [channel.removeprefix(prefix) for channel in log if channel.startswith(prefix)]
