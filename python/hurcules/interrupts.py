"""Ctrl-C and its like that are noted instead of raised, so that they never cut a file short.

They are answered at once; a second one ends the program where it is. SIGTERM is what queues of
clusters send before they kill, SIGHUP what a terminal sends that closes.
"""

from __future__ import annotations

import os
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Any

from hurcules.outlet import to_nowhere

__all__ = ["Interrupts", "as_ctrl_c", "unheard_by_children"]

ENDS = (signal.SIGTERM, signal.SIGHUP)


@contextmanager
def as_ctrl_c() -> Iterator[None]:
    """While this is entered SIGTERM and SIGHUP raise KeyboardInterrupt.

    Outside the main thread, and where one is handled or ignored already, it stays as it is.
    """
    main = threading.current_thread() is threading.main_thread()
    taken = [one for one in ENDS if main and signal.getsignal(one) is signal.SIG_DFL]
    for number in taken:
        signal.signal(number, _interrupt)
    try:
        yield
    finally:
        for number in taken:
            signal.signal(number, signal.SIG_DFL)


@contextmanager
def unheard_by_children() -> Iterator[None]:
    """Processes that are started while this is entered never hear SIGTERM and SIGHUP.

    For helpers that saving needs: a queue sends SIGTERM to all processes of a job at once. Who
    started them ends them by SIGKILL.
    """
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ENDS)
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


class Interrupts:
    """While this is entered, all of them only set `noted`; who can stop early looks there.

    Outside the main thread, and where a signal is ignored already, everything stays as it is.

    Attributes:
        noted: whether one came.
    """

    def __init__(self) -> None:
        self.noted = False
        self._before: dict[signal.Signals, Any] = {}  # the handlers to put back

    def __enter__(self) -> Interrupts:
        if threading.current_thread() is threading.main_thread():
            for number in (signal.SIGINT, *ENDS):
                before = signal.getsignal(number)
                if before not in (None, signal.SIG_IGN):
                    self._before[number] = before
                    signal.signal(number, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        for number, before in self._before.items():
            signal.signal(number, before)
        self._before.clear()

    def _note(self, number: int, _frame: FrameType | None) -> None:
        _leave_lost_terminal(number)
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        os.write(2, b"\ninterrupted: saving what is done\n")  # print may be busy where this came


def _interrupt(number: int, frame: FrameType | None) -> None:
    _leave_lost_terminal(number)
    signal.default_int_handler(number, frame)


def _leave_lost_terminal(number: int) -> None:
    """After a SIGHUP: what is printed goes nowhere, where it went to a terminal that is gone."""
    if number != signal.SIGHUP:
        return
    for stream in (1, 2):
        try:
            os.write(stream, b"")
        except OSError:
            to_nowhere(stream)
