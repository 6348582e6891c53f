"""`hurcules run`: a mission, and what is left of it: log, figures, film, report."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from hurcules import extras, own_simulation
from hurcules._core import Error
from hurcules._version import __version__
from hurcules.drawing import overview
from hurcules.figures import describe, readable, tells, wanted
from hurcules.interrupts import Interrupts
from hurcules.legend import event_words, reason_words
from hurcules.output import Output
from hurcules.recording import Recording, Snapshot, record
from hurcules.rendering import RendererError, following_camera
from hurcules.sensors import realistic
from hurcules.simulation import Simulation
from hurcules.summary import summarize
from hurcules.table_missions import TableMission, table_mission
from hurcules.video import Inset, Painter, film

__all__ = [
    "DONE",
    "FAILED",
    "INTERRUPTED",
    "Pace",
    "RunOptions",
    "made_of",
    "make",
    "open_output",
    "progress_bar",
    "require_end",
    "run",
    "ticks_in",
]

DONE, FAILED, INTERRUPTED = 0, 1, 130  # exit codes
FILES = ("log.npz", "timing.npz", "summary.json", "video.mp4", "report.html")


@dataclass(frozen=True)
class Pace:
    """Of a film: pictures a second of it, seconds of the mission in a second of it."""

    fps: int = 20
    speed: int = 2

    @property
    def seconds(self) -> float:
        """[s] of the mission between two pictures."""
        return self.speed / self.fps


@dataclass(frozen=True)
class RunOptions:
    """What `hurcules run` was asked for."""

    mission: str = "stretch"  # or the path of a table, or of a file with a `simulation`
    seed: int = 0
    out: Path | None = None  # folder for the results; None: out/MISSION, where the last run lies
    seconds: float | None = None  # [s] stop after this time; None lets the mission end
    method: str = "lexicographic"
    video: bool = True
    sensors: bool = False  # with the noise of `hurcules.sensors.realistic`
    parameters: Mapping[str, Any] = field(default_factory=dict)  # of the mission
    variation: float = 1.0  # of a mission by name: how much differs between seeds

    @property
    def folder(self) -> Path:
        """For the results."""
        return self.out or Path("out", Path(self.mission).stem)


def run(options: RunOptions, console: Console) -> int:
    """Runs a mission and writes its results.

    Ctrl-C ends the simulation or the film; what was recorded is saved all the same, and said. A
    second one ends the saving too.

    Args:
        options: what to run and where to write.
        console: progress and results go here.

    Returns:
        The exit code: DONE, FAILED or INTERRUPTED.

    Raises:
        Error: wrong usage (unknown mission or method, bad number, a folder that cannot be written,
            a folder that was asked for holds another run, a simulation of one's own that has no
            end or no log).
        WriteError: a file could not be written; those before it were.
    """
    mission = table_mission(options.mission)
    simulation = _made(options)
    ticks = ticks_in(options.seconds, simulation.dt)
    told = _told(options, mission, simulation)
    with Interrupts() as interrupts:
        output = open_output(options.folder, FILES, told, options.out is not None, console)
        if lost := extras.without():
            console.print(
                f"no film and no report: {lost}", style="yellow", highlight=False, markup=False
            )
        recording = _simulate(simulation, ticks, _pace(mission), console, interrupts)
        if not recording.simulated_seconds:
            console.print("interrupted before anything was recorded", style="bold")
            return INTERRUPTED
        file = {"file": options.mission} if Path(options.mission).suffix else {}
        summary = summarize(simulation, recording, told | file)
        try:
            _save(options, simulation, mission, recording, summary, output, console, interrupts)
        except KeyboardInterrupt:  # the second one
            said = f"interrupted while saving; {output.told()}"
            console.print(said, style="bold", highlight=False, soft_wrap=True)
            return INTERRUPTED
        if interrupts.noted:
            when = "at" if recording.interrupted else "after the simulation had ended at"
            said = f"interrupted {when} {simulation.time:.3f} s; {output.told()}"
            console.print(said, style="bold", highlight=False, soft_wrap=True)
            return INTERRUPTED
        failed = simulation.finished and not simulation.success
        _report(summary, "failed: " * failed, output, console)
    return FAILED if failed else DONE


def open_output(
    folder: Path, names: Sequence[str], made_of: Mapping[str, Any], named: bool, console: Console
) -> Output:
    """The folder of a run, as `Output` makes it; says whose place the run takes."""
    output = Output(folder, names, made_of, named)
    if output.replaces:
        console.print(output.replaces, highlight=False, markup=False, soft_wrap=True)
    return output


def _made(options: RunOptions) -> Simulation:
    simulation = make(options, timed=True)
    if not simulation.records:
        raise Error(f"{options.mission}: a run wants its log, this simulation has record=False")
    require_end(options, simulation)
    return simulation


def make(options: RunOptions, timed: bool = False) -> Simulation:
    """The simulation that is asked for; one of one's own says itself whether it is timed."""
    if own_simulation.is_own(options.mission):
        return own_simulation.make(options.mission, options.seed, options.parameters)
    return Simulation(
        options.mission,
        options.seed,
        method=options.method,
        timed=timed,
        sensors=realistic() if options.sensors else None,
        variation=options.variation,
        parameters=options.parameters,
    )


def require_end(options: RunOptions, simulation: Simulation) -> None:
    """Raises Error for one that would run for ever."""
    if simulation.mission is None and options.seconds is None:
        raise Error(f"{options.mission}: its simulation has no mission that ends; --seconds wanted")


def _told(
    options: RunOptions, mission: TableMission | None, simulation: Simulation
) -> dict[str, Any]:
    name = simulation.mission or Path(options.mission).stem
    asked = {"seed": options.seed, "video": options.video}
    return {"mission": name, **asked, **made_of(options, mission)}


def made_of(options: RunOptions, mission: TableMission | None) -> dict[str, Any]:
    """What a run is made of; solver and sensors of a simulation of one's own are its own."""
    file = Path(options.mission)
    mine = file.suffix in (".py", ".toml")
    parameters = mission.complete(options.parameters) if mission else options.parameters
    told = {
        "version": __version__,
        "file_sha256": hashlib.sha256(file.read_bytes()).hexdigest() if mine else None,
        "seconds": options.seconds,
        "parameters": dict(parameters),
    }
    if own_simulation.is_own(options.mission):
        return told
    sensors = "realistic" if options.sensors else "exact"
    return {
        **told,
        "method": options.method,
        "sensors": sensors,
        "variation": options.variation,
    }


def ticks_in(seconds: float | None, dt: float) -> int | None:
    """Raises Error for a time that is no tick."""
    if seconds is None:
        return None
    if not (math.isfinite(seconds) and seconds >= dt):
        raise Error(f"--seconds: wanted a time of {dt} s or more, got {seconds}")
    return round(seconds / dt)


def _simulate(
    simulation: Simulation,
    ticks: int | None,
    pace: Pace,
    console: Console,
    interrupts: Interrupts,
) -> Recording:
    with progress_bar(console) as bar:
        total = ticks * simulation.dt if ticks else None
        name = simulation.mission or "a robot"
        task = bar.add_task(f"simulate {name}", total=total, note="")

        def show(speed: float) -> None:
            note = f"{simulation.time:5.1f} s   {speed:4.1f} x real time   {simulation.phase}"
            bar.update(task, completed=simulation.time, note=note)

        recording = record(
            simulation,
            ticks,
            round(pace.seconds / simulation.dt),
            show,
            stopped=lambda: interrupts.noted,
        )
        bar.update(task, total=simulation.time or 1.0)
    return recording


def _save(
    options: RunOptions,
    simulation: Simulation,
    mission: TableMission | None,
    recording: Recording,
    summary: dict[str, Any],
    output: Output,
    console: Console,
    interrupts: Interrupts,
) -> None:
    """Writes everything, what matters most first; only the film can be cut short.

    Film and report need the extra `hurcules[report]`.
    """
    output.write_json("summary.json", summary)  # it has room on a disk that is all but full
    output.write_arrays("log.npz", recording.log)
    if recording.timings:
        output.write_arrays("timing.npz", recording.timings)
    if extras.missing():
        return
    video: Path | str = "not asked for (--no-video)"
    snapshots: list[Snapshot] = []
    if interrupts.noted:
        video = "the run was interrupted"
    elif options.video:
        try:
            own = own_simulation.is_own(options.mission)
            with _open_painter(simulation, mission, own) as drawing:
                video = _film(drawing, _pace(mission), recording, output, console, interrupts)
                snapshots = _snapshots(drawing, recording, summary)
        except RendererError as missing:
            video = str(missing)
            console.print(f"no video: {missing}", style="yellow", highlight=False, markup=False)
    from hurcules import report  # with the packages of the extra hurcules[report]

    output.write(
        "report.html", lambda path: report.write(path, summary, recording, snapshots, video)
    )


def _pace(mission: TableMission | None) -> Pace:
    """Minutes of driving and turning are shown faster, with fewer pictures."""
    return Pace(fps=12, speed=6) if mission else Pace()


def _open_painter(simulation: Simulation, mission: TableMission | None, own: bool) -> Painter:
    """Two cameras that go with what is carried, else those of the painter.

    Of a simulation of one's own: the model's camera "film", or one that looks at all of it.
    """
    model = simulation.model
    if own:
        named = any(model.camera(i).name == "film" for i in range(model.ncam))
        return Painter(model, "film" if named else overview(simulation))
    if mission is None:
        return Painter(model)
    body, distance = mission.followed
    carried, title = mission.carried
    across = following_camera(model, carried, distance=2.3, azimuth=215.0, elevation=-20.0)
    return Painter(model, following_camera(model, body, distance), Inset(across, title))


def _film(
    painter: Painter,
    pace: Pace,
    recording: Recording,
    output: Output,
    console: Console,
    interrupts: Interrupts,
) -> Path:
    """Films until Ctrl-C at the longest; returns the file."""
    with progress_bar(console) as bar:
        task = bar.add_task("film", total=len(recording.frames), note="")

        def shoot(path: Path) -> None:
            film(
                painter,
                path,
                recording.frames,
                origin=recording.origin,
                fps=pace.fps,
                note=f"{pace.speed}x speed",
                progress=lambda n: bar.update(task, completed=n, note=f"{n} pictures"),
                stopped=lambda: interrupts.noted,
            )

        return output.write("video.mp4", shoot)


def _snapshots(painter: Painter, recording: Recording, summary: dict[str, Any]) -> list[Snapshot]:
    """The robot at the events, those that happen together in one picture."""
    moments: list[tuple[float, str]] = []
    for event in summary["events"]:
        time, text = event["time_s"], event_words(event["text"])
        if moments and time - moments[-1][0] < 0.25:
            moments[-1] = (moments[-1][0], f"{moments[-1][1]}; {text}")
        else:
            moments.append((time, text))
    moments.append((recording.simulated_seconds, reason_words(summary["reason"])))
    pictures = []
    for time, text in moments:
        nearest = min(recording.frames, key=lambda frame: abs(frame.time - time))
        picture = painter.picture(nearest.qpos)[130:670, 60:1260]  # less of sky and ground
        pictures.append(Snapshot(time, text, picture.copy()))
    return pictures


def _report(summary: dict[str, Any], verdict: str, output: Output, console: Console) -> None:
    """The end in plain figures, a verdict before it, and where everything lies."""
    table = Table(box=None, padding=(0, 3, 0, 0), header_style="dim")
    beside = next((one for one in ("wanted", "thesis") if summary[one]), "")
    for heading in ("", "measured", beside):
        table.add_column(heading, justify="right" if heading else "left")
    for name, value in summary["figures"].items():
        if not tells(name, summary):
            continue
        other = readable(name, summary["thesis"].get(name)) if beside else ""
        if summary["wanted"]:
            other = wanted(name, summary["wanted"].get(name), value)
        table.add_row(escape(describe(name).label), readable(name, value), other)
    worst, tick = summary["limit_violation"], summary["control_tick_us"]
    for what, excess in (("commanded", worst["commanded"]), ("physics", worst)):
        table.add_row(f"over a joint limit, {what}", readable("_rad", excess["position_rad"]))
    if tick["median"] is not None:
        text = f"{tick['median']:.0f} / {tick['p99']:.0f} µs"
        table.add_row("control tick, median / p99", text)
    table.add_row("speed", f"{summary['real_time_factor']:.1f} x real time")
    colour = "bold green" if summary["success"] else "bold"
    reason = verdict + escape(reason_words(summary["reason"]))
    console.print(f"\n{reason}, {summary['simulated_seconds']:.1f} s", style=colour)
    console.print(table)
    for path in output.saved:
        console.print(f"  {path}", highlight=False, soft_wrap=True)


@contextmanager
def progress_bar(console: Console) -> Iterator[Progress]:
    """A bar with a note (`note=`) and the time; each task says what it counts."""
    columns = (
        TextColumn("{task.description:18}", markup=False),
        BarColumn(bar_width=28),
        TextColumn("{task.fields[note]}", markup=False),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console) as bar:
        yield bar
