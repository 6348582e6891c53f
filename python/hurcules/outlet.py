"""Standard output that never ends a run: gone, full, or without some letters."""

from __future__ import annotations

import errno
import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, TextIO, cast

__all__ = ["Outlet", "outlet", "to_nowhere"]


def to_nowhere(stream: int) -> None:
    """What goes to this file descriptor goes nowhere from here on."""
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, stream)
    os.close(nowhere)


class Outlet:
    """Passes on to a stream; from the first error on all goes to nowhere.

    Attributes:
        lost: what was said of the disk, "" for nothing; that nobody reads on is no loss.
    """

    def __init__(self, stream: TextIO) -> None:
        self.lost = ""
        self._stream = stream

    def write(self, text: str) -> int:
        """Writes; returns how many characters were taken."""
        try:
            return self._stream.write(text)
        except OSError as error:
            self._end(error)
            return len(text)

    def flush(self) -> None:
        """Passes on what is buffered."""
        try:
            self._stream.flush()
        except OSError as error:
            self._end(error)

    def _end(self, error: OSError) -> None:
        if error.errno != errno.EPIPE:
            self.lost = f"cannot write standard output: {error.strerror}"
        to_nowhere(self._stream.fileno())  # what is buffered goes there too

    def __getattr__(self, name: str) -> Any:
        return getattr(self._stream, name)


@contextmanager
def outlet() -> Iterator[Outlet]:
    """While this is entered sys.stdout is one; letters that its encoding lacks become `?`."""
    before = sys.stdout
    if before is None:  # it was closed before Python began
        yield Outlet(io.StringIO())
        return
    if isinstance(before, io.TextIOWrapper):
        before.reconfigure(errors="replace")
    passed = Outlet(before)
    sys.stdout = cast(TextIO, passed)
    try:
        yield passed
    finally:
        passed.flush()
        sys.stdout = before
