"""Ctrl-C that is noted instead of raised, so that it never cuts a file short.

It is answered at once; a second one ends the program where it is.
"""

from __future__ import annotations

import os
import signal
import threading
from types import FrameType
from typing import Any

__all__ = ["Interrupts"]


class Interrupts:
    """While this is entered, Ctrl-C only sets `noted`; who can stop early looks there.

    Outside the main thread, and where Ctrl-C is ignored already, everything stays as it is.

    Attributes:
        noted: whether Ctrl-C came.
    """

    def __init__(self) -> None:
        self.noted = False
        self._before: Any = None  # the handler to put back

    def __enter__(self) -> Interrupts:
        if threading.current_thread() is threading.main_thread():
            before = signal.getsignal(signal.SIGINT)
            if before not in (None, signal.SIG_IGN):
                self._before = before
                signal.signal(signal.SIGINT, self._note)
        return self

    def __exit__(self, *_: object) -> None:
        if self._before is not None:
            signal.signal(signal.SIGINT, self._before)
            self._before = None

    def _note(self, _number: int, _frame: FrameType | None) -> None:
        if self.noted:
            raise KeyboardInterrupt
        self.noted = True
        os.write(2, b"\ninterrupted: saving what is done\n")  # print may be busy where this came
