"""report.html: a run on one page with film, figures, pictures and plots; needs no other file."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from importlib.resources import files
from pathlib import Path
from typing import Any

from hurcules import extras
from hurcules.casualties import contact_limit
from hurcules.figures import describe, readable, tells, wanted
from hurcules.legend import event_words, joint_words, level_words, reason_words, region_words
from hurcules.recording import (
    CHANNELS,
    FORCE_CHANNELS,
    LOAD_CHANNELS,
    PERSON_CHANNELS,
    STAGES,
    Recording,
    Snapshot,
)

with extras.importing(extras.remedy()):
    import jinja2

    from hurcules.report import plots
    from hurcules.report.style import applied, data_address, jpeg

__all__ = ["write"]

SNAPSHOT_WIDTH = 480  # [pixels]
# how it is drawn, of what, its title and what it shows
Drawing = tuple[Callable[[plots.Log, Sequence[float]], str], plots.Log, str, str]


def write(
    path: Path,
    summary: dict[str, Any],
    recording: Recording,
    snapshots: Sequence[Snapshot] = (),
    video: Path | str = "not asked for",
) -> None:
    """Writes the page.

    Args:
        path: the file.
        summary: as `hurcules.summary.summarize` returns it.
        recording: the log and the timings of the run.
        snapshots: pictures in the order of time.
        video: the film, or why there is none.

    Raises:
        OSError: the file cannot be written.
    """
    source = files(__package__).joinpath("template.html").read_text("utf-8")
    environment = jinja2.Environment(autoescape=True, undefined=jinja2.StrictUndefined)
    template = environment.from_string(source)
    film = data_address(video.read_bytes(), "video/mp4") if isinstance(video, Path) else ""
    origin = recording.origin
    page = template.render(
        summary=summary,
        reason=reason_words(summary["reason"]),
        origin=origin,
        names=_names(recording.log),
        events=[(e["time_s"] - origin, event_words(e["text"])) for e in summary["events"]],
        cards=_cards(summary),
        rows=[row for row in _rows(summary) if row["thesis"]],
        more=[row for row in _rows(summary) if not row["thesis"]],
        video=film,
        without_video=video,
        snapshots=[
            {"time": s.time - origin, "text": s.text, "address": jpeg(s.picture, SNAPSHOT_WIDTH)}
            for s in snapshots
        ],
        plots=_plots(recording, summary),
        channels=[
            *CHANNELS,
            *(FORCE_CHANNELS if any(name.startswith("force/") for name in recording.log) else ()),
            *(PERSON_CHANNELS if "casualty/contact_share" in recording.log else ()),
            *(LOAD_CHANNELS if "load/off_m" in recording.log else ()),
        ],
        stages=STAGES,
    )
    path.write_text(page, encoding="utf-8")


def _names(log: dict[str, Any]) -> list[tuple[str, str]]:
    """The short names of the log in words: joints and coordinates, then levels."""
    coordinates = [name.removeprefix("q/") for name in log if name.startswith("q/")]
    levels = [name.removeprefix("error/") for name in log if name.startswith("error/")]
    words = [(name, joint_words(name)) for name in coordinates]
    words += [(name, level_words(name)) for name in levels]
    return [(name, text) for name, text in words if text != name]


def _cards(summary: dict[str, Any]) -> list[tuple[str, str]]:
    """The few numbers that somebody in a hurry reads."""
    worst = summary["limit_violation"]
    return [
        (readable("_s", summary["simulated_seconds"]), "simulated"),
        (f"{summary['real_time_factor'] or 0:.1f} x", "real time, one core"),
        (readable("_us", summary["control_tick_us"]["median"]), "control tick, median"),
        (readable("_us", summary["control_tick_us"]["p99"]), "control tick, p99"),
        (readable("_rad", worst["position_rad"]), "over a joint limit, physics"),
        (readable("_rad", worst["commanded"]["position_rad"]), "over a joint limit, commanded"),
    ]


def _rows(summary: dict[str, Any]) -> list[dict[str, str]]:
    thesis = summary["thesis"]
    return [
        {
            "label": describe(name).label,
            "measured": readable(name, value),
            "thesis": readable(name, thesis[name]) if name in thesis else "",
            "where": describe(name).where,
            "wanted": wanted(name, summary["wanted"].get(name), value),
        }
        for name, value in summary["figures"].items()
        if tells(name, summary)
    ]


def _plots(recording: Recording, summary: dict[str, Any]) -> list[dict[str, str]]:
    if len(recording.log["time"]) < 2:
        return []
    origin = recording.origin
    log = plots.shifted(recording.log, origin)
    times = {round(event["time_s"] - origin, 1) for event in summary["events"] if event["time_s"]}
    events = sorted(times)
    later = plots.settled(log)
    moves = [
        (plots.joint_positions, log, "Joint positions", _POSITIONS),
        (plots.joint_velocities, later, "Reference velocities", _VELOCITIES),
        (plots.control_errors, later, "Control errors", _ERRORS),
    ]
    drawn: list[Drawing] = [
        *(
            (partial(draw, sliding=recording.sliding), part, title, text)
            for draw, part, title, text in moves
            if plots.moving(part)
        ),
        (plots.task_errors, later, "Task errors", _TASKS),
        (plots.active_limits, log, "Active limits", _LIMITS),
        (plots.monitors, log, "Monitors", _MONITORS),
        (plots.solver_work, log, "Work of the solver", _SOLVER),
    ]
    if recording.timings:
        timed = log | {"tick_us": recording.control_tick_us}
        drawn.append((plots.tick_times, timed, "Time of a control tick", _TIMES))
    if plots.of_model(log):
        drawn.insert(0, (plots.quantities, log, "What the mission reads", _QUANTITIES))
    if "casualty/contact_share" in log:
        text = f"{_PERSON} {_regions(log)}"
        drawn.insert(0, (plots.person, log, "The person", text))
    if "load/off_m" in log:
        drawn.insert(0, (plots.load, log, "The load", _LOAD))
    with applied():
        made = [
            {"title": title, "text": text, "svg": draw(part, events)}
            for draw, part, title, text in drawn
        ]
    return [plot for plot in made if "<svg" in plot["svg"]]


def _regions(log: dict[str, Any]) -> str:
    """The largest force of the robot on each region of the body, contacts beside their limits."""
    told = []
    for region, (contact, carries) in plots.region_forces(log).items():
        limit = contact_limit(region)
        words = [f"contact {contact:.0f} N of {limit:.0f} N"] if contact >= 1.0 else []
        words += [f"carries {carries:.0f} N"] if carries >= 1.0 else []
        if words:
            told.append((contact / limit, f"{region_words(region)} {', '.join(words)}"))
    said = "; ".join(text for _, text in sorted(told, reverse=True))
    return f"Largest force of the robot on each region: {said or 'none'}."


_POSITIONS = (
    "The coordinates that move (after Figures 4.25 and 4.26). Dashed orange: position limits; "
    "shaded: held by a limit; dashed upright lines: events. The right arm is left out where it "
    "mirrors the left."
)
_VELOCITIES = (
    "The velocity that the solver commands for each coordinate, from 0 s on (Figure 4.26 a)."
)
_ERRORS = (
    "Reference minus measured position (Figure 4.26 b); it jumps where a limit becomes active or "
    "is released. "
    "The thesis reports 0.4 degrees, 7 mrad, at most."
)
_TASKS = "The error of each level of the commanded motion, in decreasing priority."
_LIMITS = "Which position limit holds which coordinate, and when."
_MONITORS = (
    "Safety monitors beside the controller (§4.2.1): distance of the robot to itself (0.25 m "
    "stands for more), distance of the centre of mass and of the centre of pressure from the edge "
    "of the support, angle and work to tipping over, hottest motor winding. Dashed: alarm."
)
_PERSON = (
    "What the robot does to the person. While more than 15 % of his weight is on the ground its "
    "forces are contacts, the worst over the limit of its region (dashed: 1; ISO/TS 15066); later "
    "they carry him: there is no limit of force for that, limits are of pressure, and no pressure "
    f"is computed here. Above {plots.SUPPORT:.0f} N (dashed) the missions stop or lay him down. "
    "Acceleration includes gravity (dashed: 10 g)."
)
_LOAD = (
    "What is carried: how high, how far its handles are from the hands (a step is a slip), how "
    "hard the fingers press, and what bears it."
)
_QUANTITIES = "What conditions, ways and figures of the table ask of the model [m, rad, N]."
_SOLVER = "Factorizations and working-set changes of each solve; a level takes one at least."
_TIMES = "From sensing to servo, without physics, on the machine named above."
