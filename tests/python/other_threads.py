"""Do other Python threads run while a call is under way?"""

from __future__ import annotations

import threading
import time
from collections.abc import Callable


def assert_they_run_during(call: Callable[[], object]) -> None:
    """A held interpreter lock would let no tick of another thread through."""
    ticks, done = [], threading.Event()

    def tick() -> None:
        while not done.is_set():
            ticks.append(time.perf_counter())
            time.sleep(1e-4)

    watcher = threading.Thread(target=tick)
    watcher.start()
    start = time.perf_counter()
    call()
    end = time.perf_counter()
    done.set()
    watcher.join()
    assert sum(start < t < end for t in ticks) > 3, f"{end - start:.3f} s"
