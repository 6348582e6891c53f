"""What sweeps share: a file with one line of JSON a run, and runs that it does not hold yet.

So a sweep that was cut off goes on where it was.
"""

from __future__ import annotations

import json
import multiprocessing
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, TypeVar

__all__ = ["Run", "append", "held", "side_by_side"]

Run = dict[str, Any]
Task = TypeVar("Task")


def held(path: Path) -> list[Run]:
    """The runs that the file holds, none where there is no file."""
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def append(path: Path, runs: Iterable[Run], words: Callable[[Run], tuple[Any, ...]]) -> None:
    """Writes each run as soon as it is made, and prints some words on it."""
    with path.open("a") as file:
        for run in runs:
            file.write(json.dumps(run) + "\n")
            file.flush()
            print(*words(run), flush=True)


def side_by_side(make: Callable[[Task], Run], tasks: Iterable[Task], workers: int) -> Iterator[Run]:
    """Makes runs in processes of their own, and gives them in the order in which they end."""
    with multiprocessing.get_context("spawn").Pool(workers) as pool:
        yield from pool.imap_unordered(make, tasks)
