"""The command `hurcules reproduce`."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from hurcules.cli import results_in
from hurcules.run import FAILED, INTERRUPTED

__all__ = ["reproduce"]


def reproduce(
    ids: Annotated[
        list[str] | None,
        typer.Argument(help="M05, a beginning such as M or K1, a range such as R01-R10."),
    ] = None,
    out: Annotated[Path | None, results_in("out/reproduce")] = None,
    workers: Annotated[
        int | None, typer.Option(help="Processes.", show_default="one for each core")
    ] = None,
    fresh: Annotated[
        bool, typer.Option("--fresh", help="Measure again what an earlier run finished.")
    ] = False,
) -> None:
    """Measure the claims of the thesis; write `report.html`, `claims.json` and `claims.md`.

    Goes on where an earlier run with the same code was stopped. Exit status: 0 each claim was
    measured, and holds or is explained; 1 one failed, or misses its number without a known reason,
    or was asked for by name although nothing measures it yet; 2 wrong usage; 130 Ctrl-C.

    For example `hurcules reproduce`, or with more words:

    - `hurcules reproduce R E M04-M10 --out /tmp/claims --workers 4`
    """
    from hurcules_studies.thesis import run  # with all claims, which no other command needs

    console = Console()
    results = run.reproduce(
        ids or (), out or run.OUT, workers=workers, fresh=fresh, console=console
    )
    run.report(results, console)
    if results.interrupted:
        raise typer.Exit(INTERRUPTED)
    raise typer.Exit(0 if results.done else FAILED)
