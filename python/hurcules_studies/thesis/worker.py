"""What a worker process does: measures claims one after the other and keeps each at once."""

from __future__ import annotations

import os
import signal
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

from hurcules.workers import in_words
from hurcules_studies.thesis.claim import Verdict
from hurcules_studies.thesis.claims import CLAIMS
from hurcules_studies.thesis.measures import measure
from hurcules_studies.thesis.result import Result, dump, from_finding, without_finding

__all__ = ["examine", "keep", "prepare", "work"]


def prepare() -> None:
    """In each worker: Ctrl-C is the parent's business."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def work(names: Sequence[str], folder: Path) -> None:
    """Measures claims; what they share, such as a run, is made once.

    Args:
        names: ids.
        folder: each result is kept there as ID.json, whole or not at all.
    """
    for name in names:
        keep(examine(name), folder)


def examine(name: str) -> Result:
    """Measures a claim; one that fails with an exception becomes an error, with its last line."""
    started = perf_counter()
    try:
        return from_finding(CLAIMS[name], measure(name), perf_counter() - started)
    except Exception as error:
        return without_finding(name, Verdict.ERROR, in_words(error))


def keep(result: Result, folder: Path) -> None:
    """Writes ID.json."""
    part = folder / f".{result.id}-{os.getpid()}"
    part.write_text(dump(result), encoding="utf-8")
    part.replace(folder / f"{result.id}.json")
