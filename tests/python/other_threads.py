"""Do other Python threads run while a call is under way?"""

from __future__ import annotations

import sys
import threading
import time
from collections.abc import Callable

TICKS = 4
PATIENCE = 20.0  # [s] for a busy machine


def assert_they_run_during(call: Callable[[], object]) -> None:
    """A held interpreter lock lets no tick of another thread through, however often it is called.

    No thread is made to give the lock up here, so that between the calls nobody gets it either.
    """
    ticks: list[float] = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(1e-4):
            ticks.append(time.perf_counter())

    interval = sys.getswitchinterval()
    sys.setswitchinterval(10 * PATIENCE)
    watcher = threading.Thread(target=tick)
    try:
        watcher.start()
        ticks.clear()
        end = time.perf_counter() + PATIENCE
        while len(ticks) < TICKS and time.perf_counter() < end:
            call()
        seen = len(ticks)
    finally:
        sys.setswitchinterval(interval)
        done.set()
        watcher.join()
    assert seen >= TICKS, f"{seen} ticks of another thread"
