"""`hurcules run METHOD`: runs a test method and writes its results."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from time import perf_counter
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from hurcules import Error, extras, scenes
from hurcules._version import __version__
from hurcules.interrupts import Interrupts
from hurcules.models import names as robot_names
from hurcules.output import Output
from hurcules.plugins import MethodOptions
from hurcules.rendering import RendererError
from hurcules.run import DONE, FAILED, INTERRUPTED, Pace, open_output, progress_bar
from hurcules.validation import require_known
from hurcules.video import Frame, Painter, film
from hurcules_studies.field_tests import METHODS, Method, Result, Variation, page, repeat, runner
from hurcules_studies.field_tests.attempt import Stopped
from hurcules_studies.field_tests.parse import parse, shown
from hurcules_studies.field_tests.runner import attempt_seed

__all__ = ["FIELD_TESTS", "run_method", "summarize"]

FILES = ("summary.json", "video.mp4", "report.html")
PACE = Pace()
WITH_HANDS = "manipulation"  # the robot of `Method.grasps`


class FieldTests:
    """The test methods, for `hurcules run` and `hurcules list`."""

    kind = "test methods"

    def titles(self) -> dict[str, str]:
        """The names, each with a title."""
        return {name: one.title for name, one in METHODS.items()}

    def run(self, options: MethodOptions, console: Console) -> int:
        """Runs one and writes its results; the same as `run_method`."""
        return run_method(options, console)


FIELD_TESTS = FieldTests()


def run_method(options: MethodOptions, console: Console) -> int:
    """Runs a method and writes its results; Ctrl-C keeps what was done.

    Args:
        options: what to run and where to write.
        console: progress and results go here.

    Returns:
        The exit code: DONE when passed, FAILED, or INTERRUPTED.

    Raises:
        Error: wrong usage.
        WriteError: a file could not be written; those before it were.
    """
    chosen, settings = parse(options.method, options.words)
    require_known("robot", options.robot, robot_names())
    runner.check(chosen, options.repetitions, options.workers, options.speed)
    if chosen.grasps and options.robot != WITH_HANDS:  # before the last results are removed
        raise Error(f"{options.method}: --robot: wanted '{WITH_HANDS}', which has hands")
    folder, told = options.out or Path("out", options.method), _told(chosen, options)
    with Interrupts() as interrupts:
        output = open_output(folder, FILES, told, options.out is not None, console)
        started = perf_counter()
        result = _run(options, chosen, settings, console, interrupts)
        wall = perf_counter() - started
        if not result.settings:
            console.print("interrupted before a repetition had ended", style="bold")
            return INTERRUPTED
        success = all(one.passed for one in result.settings) if settings else result.passed
        success = success and not (settings and result.interrupted)
        summary = summarize(result, chosen, told, success, wall)
        output.write_json("summary.json", summary)
        if lost := extras.without():
            console.print(
                f"no film and no report: {lost}", style="yellow", highlight=False, markup=False
            )
        else:
            picture, video = _show(options, chosen, result, output, console, interrupts)
            output.write("report.html", lambda path: page.write(path, summary, picture, video))
        _report(summary, output, console)
        if interrupts.noted:
            return INTERRUPTED
    return DONE if success else FAILED


def _told(chosen: Method, options: MethodOptions) -> dict[str, Any]:
    """What the run is made of."""
    return {
        "mission": options.method,
        "seed": options.seed,
        "video": options.video,
        "version": __version__,
        "robot": options.robot,
        "repetitions": options.repetitions,
        "pace": options.speed,
        "parameters": chosen.fixed,
        "asked": " ".join(options.words),
    }


def summarize(
    result: Result, chosen: Method, told: dict[str, Any], success: bool, wall: float
) -> dict[str, Any]:
    """Sums up a result for JSON."""
    plain: dict[str, Any] = result.as_dict()
    for one in plain["settings"]:
        one["shown"] = shown(chosen, one["setting"])
    largest = shown(chosen, result.largest) if result.passed else "none"
    reason = f"largest setting passed: {largest}"
    return {
        **told,
        "success": success,
        "reason": f"interrupted; {reason}" if result.interrupted else reason,
        "simulated_seconds": result.simulated_seconds,
        "real_time_factor": result.simulated_seconds / wall if wall else None,
        # joints are moved one by one: no hierarchy is solved, no limit is commanded
        "control_tick_us": {"median": None, "p99": None, "max": None},
        "limit_violation": None,
        "title": result.title,
        "parameter": result.parameter,
        "largest": result.largest,
        "settings": plain["settings"],
    }


def _run(
    options: MethodOptions,
    chosen: Method,
    settings: tuple[float, ...] | None,
    console: Console,
    interrupts: Interrupts,
) -> Result:
    with progress_bar(console) as bar:
        task = bar.add_task(options.method, total=options.repetitions, note="")

        def show(setting: float | None, done: int, failures: int) -> None:
            note = f"{shown(chosen, setting)}: {done} of {options.repetitions}"
            note += f", {failures} failed" if failures else ""
            bar.update(task, completed=done, note=note)

        return runner.run(
            chosen,
            options.robot,
            repetitions=options.repetitions,
            seed=options.seed,
            settings=settings,
            speed=options.speed,
            workers=options.workers,
            progress=show,
            stopped=lambda: interrupts.noted,
        )


def _show(
    options: MethodOptions,
    chosen: Method,
    result: Result,
    output: Output,
    console: Console,
    interrupts: Interrupts,
) -> tuple[NDArray[np.uint8] | None, Path | str]:
    """A picture of the scene, and the film of the last setting's first fault or repetition."""
    last = result.settings[-1]
    seed = last.faults[0].seed if last.faults else attempt_seed(options.seed, 0)
    values = chosen.values(last.setting)
    model = scenes.load(chosen.scene, options.robot, seed=seed, **values)
    video: Path | str = "not asked for (--no-video)"
    try:
        with Painter(model, "overview") as painter:
            start = mujoco.MjData(model)
            mujoco.mj_resetDataKeyframe(model, start, model.key("drive").id)
            picture = painter.view(start.qpos, _view(chosen, values))
            if interrupts.noted:
                video = "the run was interrupted"
            elif options.video:
                frames = _frames(options, chosen, last.setting, seed, lambda: interrupts.noted)
                video = output.write(
                    "video.mp4",
                    lambda path: _film(painter, path, frames, lambda: interrupts.noted),
                )
    except RendererError as missing:
        console.print(f"no pictures: {missing}", style="yellow", highlight=False, markup=False)
        return None, str(missing)
    return picture, video


def _frames(
    options: MethodOptions,
    chosen: Method,
    setting: float | None,
    seed: int,
    stopped: Callable[[], bool],
) -> list[Frame]:
    """The same repetition once more, as pictures; until it is stopped."""
    frames: list[Frame] = []

    def watch(_: mujoco.MjModel, qpos: NDArray[np.float64], time: float) -> None:
        if time >= len(frames) * PACE.seconds:
            frames.append(Frame(time, qpos.copy(), f"{options.method}, seed {seed}", ()))

    how = options.robot, seed, options.speed, None, Variation(), watch, stopped
    with suppress(Stopped):
        repeat(chosen, setting, *how)
    return frames


def _film(painter: Painter, path: Path, frames: list[Frame], stopped: Any) -> None:
    """Films all frames, or until it is stopped."""
    note = f"{PACE.speed}x speed"
    film(
        painter,
        path,
        frames,
        origin=0.0,
        fps=PACE.fps,
        note=note,
        progress=lambda n: None,
        stopped=stopped,
    )


def _view(chosen: Method, values: dict[str, Any]) -> mujoco.MjvCamera:
    """A camera that sees robot and obstacle."""
    end = min(8.0, max(2.0, scenes.scene(chosen.scene, **values).end))
    camera = mujoco.MjvCamera()
    camera.lookat[:] = (end / 2, 0.0, 0.5)
    camera.distance, camera.azimuth, camera.elevation = 4.0 + end, 118.0, -16.0
    return camera


def _report(summary: dict[str, Any], output: Output, console: Console) -> None:
    """The end in plain figures, and where everything lies."""
    table = Table(box=None, padding=(0, 3, 0, 0), header_style="dim")
    for heading in page.HEADINGS:
        table.add_column(heading, justify="left" if heading == page.HEADINGS[-1] else "right")
    for row in page.rows(summary):
        table.add_row(*row)
    colour = "bold green" if summary["success"] else "bold"
    console.print(f"\n{summary['title']}: {summary['reason']}", style=colour)
    console.print(table)
    for path in output.saved:
        console.print(f"  {path}", highlight=False, soft_wrap=True)
