"""`hurcules reproduce`: the claims of the thesis measured; report.html, claims.json, claims.md."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from time import perf_counter

from rich.console import Console
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from hurcules._core import Error
from hurcules.interrupts import Interrupts
from hurcules.output import Output, WriteError
from hurcules_studies.thesis import table
from hurcules_studies.thesis.claim import Verdict
from hurcules_studies.thesis.claims import CLAIMS
from hurcules_studies.thesis.measures import measured
from hurcules_studies.thesis.result import Result, load, row, without_finding
from hurcules_studies.thesis.runner import Runner, kept
from hurcules_studies.thesis.select import select

__all__ = ["OUT", "Reproduction", "report", "reproduce"]

OUT = Path("out", "reproduce")
FILES = ("claims.json", "claims.md", "report.html")


class Reproduction(dict[str, Result]):
    """The results by id.

    Attributes:
        interrupted: whether Ctrl-C ended it early.
        output: where the files lie.
        seconds: [s] that it took.
        again: claims that were taken over from an earlier run with the same code.
        waiting: claims that nothing measures yet, and that nobody asked for by name.
    """

    interrupted: bool
    output: Output
    seconds: float
    again: int
    waiting: frozenset[str]

    @property
    def done(self) -> bool:
        """Whether each claim but those waiting was measured, and holds or is explained."""
        return all(result.done for name, result in self.items() if name not in self.waiting)


def reproduce(
    ids: Iterable[str] = (),
    out: Path | str = OUT,
    *,
    workers: int | None = None,
    fresh: bool = False,
    console: Console | None = None,
) -> Reproduction:
    """Measures claims of the thesis and writes report.html, claims.json and claims.md.

    Workers are processes of their own: a program that calls this does so under
    `if __name__ == "__main__":`. Ctrl-C keeps what is finished; the next call goes on from there.

    Args:
        ids: ids, their beginnings, ranges; none means all 112.
        out: folder for the results; finished claims are kept in its claims/.
        workers: processes; by default one for each processor core.
        fresh: measures again what an earlier run with the same code had finished.
        console: progress goes here; by default nowhere.

    Returns:
        The results by id, in the order of the list.

    Raises:
        Error: an id that means nothing, fewer than one worker, a folder that cannot be written.
        WriteError: a file could not be written.
    """
    from hurcules_studies.thesis import page  # with matplotlib, which no worker needs

    ids = list(ids)
    names = select(ids, CLAIMS)
    count = len(os.sched_getaffinity(0)) if workers is None else workers
    if count < 1:
        raise Error(f"--workers: wanted a whole number of 1 or more, got {workers}")
    started = perf_counter()
    output = Output(Path(out), FILES)
    folder = output.folder / "claims"
    wanted = [name for name in names if name in measured()]
    with Interrupts() as interrupts:
        try:
            folder.mkdir(exist_ok=True)
            again = kept(folder, wanted, fresh)
            _measure(folder, wanted, again, count, console, interrupts)
        except OSError as error:
            raise WriteError(f"cannot write {folder}: {error.strerror or error}") from error
        results = Reproduction((name, _result(name, folder)) for name in names)
        results.output, results.again = output, len(again)
        results.waiting = frozenset() if ids else frozenset(names) - frozenset(wanted)
        results.interrupted = interrupts.noted
        rows = [row(CLAIMS[name], result) for name, result in results.items()]
        output.write_json("claims.json", {"claims": rows})
        output.write("claims.md", lambda path: table.write(path, results))
        output.write("report.html", lambda path: page.write(path, results))
    results.seconds = perf_counter() - started
    return results


def _measure(
    folder: Path,
    wanted: list[str],
    again: list[str],
    workers: int,
    console: Console | None,
    interrupts: Interrupts,
) -> None:
    with _progress(console or Console(quiet=True)) as bar:
        task = bar.add_task("claims", total=len(wanted), completed=len(again), note="")

        def show(left: list[str]) -> None:
            note = " ".join(left[:6]) + (" ..." if len(left) > 6 else "")
            finished = sum((folder / f"{name}.json").exists() for name in wanted)
            bar.update(task, completed=finished, note=note)

        runner = Runner(folder, workers, lambda: interrupts.noted, show)
        runner.run([name for name in wanted if name not in again])
        show([])


def _result(name: str, folder: Path) -> Result:
    if name not in measured():
        return without_finding(name, Verdict.PENDING, CLAIMS[name].pending)
    result = load(folder / f"{name}.json")
    return result or without_finding(name, Verdict.PENDING, "interrupted before it was measured")


def report(results: Reproduction, console: Console) -> None:
    """The verdicts by letter, what somebody should look at, and where everything lies."""
    verdicts = Table(box=None, padding=(0, 3, 0, 0), header_style="dim")
    verdicts.add_column("")
    for heading in (*Verdict, "seconds"):
        verdicts.add_column(str(heading), justify="right")
    for letter in dict.fromkeys(name[0] for name in results):
        mine = [result for name, result in results.items() if name[0] == letter]
        counts = Counter(result.verdict for result in mine)
        numbers = [str(counts[verdict] or "") for verdict in Verdict]
        verdicts.add_row(letter, *numbers, f"{sum(result.seconds for result in mine):.1f}")
    console.print(verdicts)
    for result in results.values():
        if result.verdict not in (Verdict.HOLDS, Verdict.PENDING):
            style = "" if result.explained else "bold red"
            text = f"{result.id} {result.verdict}: {result.reason}"
            console.print(text, style=style, highlight=False, markup=False, soft_wrap=True)
    taken = f", {results.again} from an earlier run" if results.again else ""
    said = f"{len(results)} claims in {results.seconds:.0f} s{taken}"
    console.print(("interrupted: " if results.interrupted else "") + said, style="bold")
    for path in results.output.saved:
        console.print(f"  {path}", highlight=False, soft_wrap=True)


@contextmanager
def _progress(console: Console) -> Iterator[Progress]:
    columns = (
        TextColumn("{task.description}"),
        BarColumn(bar_width=28),
        MofNCompleteColumn(),
        TextColumn("{task.fields[note]}"),
        TimeElapsedColumn(),
    )
    with Progress(*columns, console=console) as bar:
        yield bar
