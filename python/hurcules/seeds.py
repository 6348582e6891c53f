"""`hurcules run --seeds`: a mission with many seeds, without film: a line of JSON each."""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Sequence
from contextlib import closing
from dataclasses import replace
from pathlib import Path
from statistics import median
from typing import Any

from rich.console import Console

from hurcules import extras, own_simulation
from hurcules._core import Error
from hurcules.figures import describe, readable, wanted
from hurcules.interrupts import Interrupts
from hurcules.output import Output, differing, plain, void, write_whole, writing
from hurcules.run import (
    DONE,
    FAILED,
    INTERRUPTED,
    RunOptions,
    made_of,
    make,
    progress_bar,
    require_end,
    ticks_in,
)
from hurcules.shares import wilson
from hurcules.summary import bounds, figures
from hurcules.table_missions import table_mission
from hurcules.workers import DIED, in_words, side_by_side

__all__ = ["Row", "run_seeds", "sum_up"]

Row = dict[str, Any]

RUNS = "runs.jsonl"
FILES = ("runs.txt", "runs.png")
CHUNK = 1000  # ticks between two looks at whether it has ended
_FAILED = ("failed", "in phase", "runs", "seeds")
_FIGURE = ("figure", "least", "median", "largest", "wanted")
NUMBER = re.compile(r"((?<!\w)-?\d+(?:\.\d+)?(?:e[+-]?\d+)?)")


def run_seeds(options: RunOptions, seeds: int, workers: int, console: Console) -> int:
    """Runs a mission with each of some seeds and sums up.

    A line of `runs.jsonl` is written as a run ends; seeds that it holds are not run again. Ctrl-C
    keeps those that have ended.

    Args:
        options: of all runs; `seed` is the first one.
        seeds: how many.
        workers: processes.
        console: progress and results go here.

    Returns:
        The exit code: DONE, FAILED where a run failed, or INTERRUPTED.

    Raises:
        Error: wrong usage, or a `runs.jsonl` of other runs.
        WriteError: a file could not be written.
    """
    for name, least, count in (("seeds", 1, seeds), ("workers", 1, workers)):
        if count < least:
            raise Error(f"--{name}: wanted a whole number from {least} up, got {count}")
    if options.seed < 0:
        raise Error(f"--seed: wanted 0 or more, got {options.seed}")
    asked = range(options.seed, options.seed + seeds)
    _try_out(replace(options, seed=asked[-1]))
    told = _told(options)
    with Interrupts() as interrupts:
        output = Output(options.folder, FILES)
        path = options.folder / RUNS
        rows = {row["seed"]: row for row in _held(path, told) if row["seed"] in asked}
        if rows:
            console.print(f"{len(rows)} of {seeds} runs are in {path} already", highlight=False)
        _run(options, [n for n in asked if n not in rows], workers, rows, path, console, interrupts)
        done = [rows[seed] for seed in asked if seed in rows]
        if not done:
            console.print("interrupted before a run had ended", style="bold")
            return INTERRUPTED
        text = sum_up(Path(options.mission).stem, done)
        if len(done) < seeds:
            text += f"\ninterrupted: {len(done)} of {seeds} runs; the same command goes on\n"
        output.write("runs.txt", lambda path: void(path.write_text(text, encoding="utf-8")))
        _draw(done, output, console)
    console.print(f"\n{text}", highlight=False, markup=False, soft_wrap=True)
    for file in (path, *output.saved):
        console.print(f"  {file}", highlight=False, soft_wrap=True)
    if len(done) < seeds:
        return INTERRUPTED
    return FAILED if any(row["success"] is False for row in done) else DONE


def _try_out(options: RunOptions) -> None:
    """Raises Error for what no seed could run; the code of others runs in the workers alone."""
    if own_simulation.is_own(options.mission):
        own_simulation.bound(options.mission, options.seed, options.parameters)
    else:
        ticks_in(options.seconds, make(options).dt)


def _told(options: RunOptions) -> Row:
    """What each row says of what it was made of: rows of one file say the same."""
    name = Path(options.mission).stem
    return plain({"mission": name, **made_of(options, table_mission(options.mission))})


def _held(path: Path, told: Row) -> list[Row]:
    """The rows of a file; a last line that was cut off is removed from it."""
    try:
        text = path.read_text(encoding="utf-8") if path.exists() else ""
        whole = text[: text.rfind("\n") + 1]
        rows: list[Row] = [dict(json.loads(line)) for line in whole.splitlines()]
        others = [one for row in rows for one in differing(row, told)]
    except (OSError, ValueError, TypeError) as error:
        raise Error(f"--out: cannot read {path}: {type(error).__name__}: {error}") from None
    if others:
        raise Error(f"--out: {path} is of other runs: {others[0]}; give another folder")
    if whole != text:
        write_whole(path, whole.encode())
    return rows


def _run(
    options: RunOptions,
    seeds: Sequence[int],
    workers: int,
    rows: dict[int, Row],
    path: Path,
    console: Console,
    interrupts: Interrupts,
) -> None:
    """Adds the rows of these seeds to the others, in memory and in the file."""
    told = _told(options)
    jobs = [replace(options, seed=seed) for seed in seeds]
    total = len(rows) + len(jobs)
    with progress_bar(console) as bar:
        task = bar.add_task(f"run {Path(options.mission).stem}", total=total, note="")

        def show() -> None:
            failed = sum(row["success"] is False for row in rows.values())
            note = f"{len(rows)} of {total}" + f", {failed} failed" * bool(failed)
            bar.update(task, completed=len(rows), note=note)

        show()
        with closing(side_by_side(_row, jobs, workers, lambda: interrupts.noted)) as ended:
            for job, made in ended:
                if _told(options) != told:
                    raise Error(f"{options.mission}: it has changed while it was run")
                row = {"seed": job.seed, **(made or _broken(DIED)), **told}
                with writing(path), path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(row, ensure_ascii=False, allow_nan=False) + "\n")
                rows[job.seed] = row
                show()


def _row(options: RunOptions) -> Row:
    """One run, in a worker: how it ended, and its figures.

    Raises:
        Error: what every seed would raise.
    """
    try:
        simulation = make(options)
    except (Exception, SystemExit) as error:
        return _broken(in_words(error.__cause__ or error))  # of a file of one's own, its own
    ticks = ticks_in(options.seconds, simulation.dt)
    require_end(options, simulation)
    try:
        while not simulation.finished and simulation.step(ticks or CHUNK) and ticks is None:
            pass
        return plain(
            {
                "success": _success(options, simulation),
                "reason": simulation.reason or f"stopped at {simulation.time:.3f} s, as asked",
                "phase": simulation.phase,
                "simulated_seconds": simulation.time,
                "figures": figures(simulation, simulation.log() if simulation.records else {}),
                "wanted": bounds(simulation),
            }
        )
    except Exception as error:
        return _broken(in_words(error), simulation.phase, simulation.time)


def _success(options: RunOptions, simulation: Any) -> bool | None:
    """None of a mission that was stopped; without a mission the time that was asked for is all."""
    if simulation.finished:
        return bool(simulation.success)
    return True if simulation.mission is None else None


def _broken(reason: str, phase: str = "", seconds: float | None = None) -> Row:
    return {
        "success": False,
        "reason": reason,
        "phase": phase,
        "simulated_seconds": seconds,
        "figures": {},
        "wanted": {},
    }


def sum_up(name: str, rows: Sequence[Row]) -> str:
    """The rows as a plain text: successes, failures by reason and phase, figures.

    Args:
        name: of what was run.
        rows: one or more.
    """
    ended = [row for row in rows if row["success"] is not None]
    lines = []
    if ended:
        good = sum(row["success"] for row in ended)
        low, high = (f"{100 * end:.0f}" for end in wilson(good, len(ended)))
        lines.append(
            f"{name}: {good} of {len(ended)} succeeded ({low} to {high} %, Wilson's 95 % interval)"
        )
    if len(ended) < len(rows):
        lines.append(f"{name}: {len(rows) - len(ended)} stopped before their end, as asked")
    for heading, some in ((_FAILED, _failures(rows)), (_FIGURE, _figures(rows))):
        if some:
            lines += ["", *_aligned([heading, *some])]
    return "\n".join(lines) + "\n"


def _failures(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    """By reason, whatever its numbers are, and phase; the most frequent first."""
    classes: dict[tuple[str, str], list[Row]] = defaultdict(list)
    for row in rows:
        if row["success"] is False:
            classes[NUMBER.sub("#", row["reason"]), row["phase"]].append(row)
    return [
        (
            _common([row["reason"] for row in some]),
            phase or "-",
            str(len(some)),
            ", ".join(str(row["seed"]) for row in some),
        )
        for (_, phase), some in sorted(classes.items(), key=lambda one: -len(one[1]))
    ]


def _common(reasons: Sequence[str]) -> str:
    """Reasons that differ in their numbers, as one."""
    parts = zip(*(NUMBER.split(reason) for reason in reasons), strict=True)
    return "".join(one[0] if len(set(one)) == 1 else "..." for one in parts)


def _figures(rows: Sequence[Row]) -> list[tuple[str, ...]]:
    found: list[tuple[str, ...]] = []
    for name in dict.fromkeys(name for row in rows for name in row["figures"]):
        limits = next((row["wanted"][name] for row in rows if name in row["wanted"]), None)
        given = [row for row in rows if row["figures"].get(name) is not None]
        if not given:
            continue
        values = [row["figures"][name] for row in given]
        missed = sum(
            wanted(name, row["wanted"].get(name), row["figures"][name]).endswith("missed")
            for row in given
        )
        asked = wanted(name, limits, None) + f", missed by {missed}" * bool(missed)
        least, middle, largest = (
            readable(name, value) for value in (min(values), median(values), max(values))
        )
        found.append((describe(name).label, least, middle, largest, asked))
    return found


def _aligned(table: Sequence[tuple[str, ...]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*table, strict=True)]
    return [
        "   ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in table
    ]


def _draw(rows: Sequence[Row], output: Output, console: Console) -> None:
    if lost := extras.without():
        console.print(f"no picture: {lost}", style="yellow", highlight=False, markup=False)
        return
    from hurcules.report import seeds  # with the packages of the extra hurcules[report]

    output.write("runs.png", lambda path: seeds.write(path, rows))
