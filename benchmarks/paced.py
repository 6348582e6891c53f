"""A mission paced by the clock: how many ticks end late, beside a loop that does nothing.

Both loops run at the same time, each in its own process. A tick begins when the clock says so and
is late when it has not ended where the next one begins; who is late goes on at once, and catches
up. The loop that does nothing is late where the machine was busy with others: ticks that are late
beyond those are our own. When the mission ends it starts anew, and its clock with it.

    python benchmarks/paced.py [--mission casualty] [--seconds 600]
"""

from __future__ import annotations

import argparse
import os
import time
from collections.abc import Callable
from multiprocessing import get_context
from multiprocessing.synchronize import Barrier

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

import hurcules

SPIN = 1e-4  # [s] before its beginning a tick waits by looking at the clock: sleep wakes up late


class Pace:
    """When ticks should begin and end, and when they did."""

    def __init__(self, period: float) -> None:
        self._period = period
        self.late: list[float] = []  # [s] by which a tick ended after the next should have begun
        self.took: list[float] = []  # [s]
        self.restart()

    def restart(self) -> None:
        """The next tick begins now."""
        self._next = time.perf_counter()

    def tick(self, act: Callable[[], object]) -> None:
        """Waits for its beginning, and acts."""
        while (left := self._next - time.perf_counter()) > 0.0:
            if left > SPIN:
                time.sleep(left - SPIN)
        began = time.perf_counter()
        act()
        ended = time.perf_counter()
        self._next += self._period
        self.late.append(ended - self._next)
        self.took.append(ended - began)


def idle(period: float, seconds: float, ready: Barrier) -> Pace:
    """Does nothing, tick by tick."""
    pace = Pace(period)
    ready.wait()
    pace.restart()
    for _ in range(round(seconds / period)):
        pace.tick(lambda: None)
    return pace


def paced(mission: str, seconds: float, ready: Barrier) -> Pace:
    """A mission, tick by tick, again and again."""
    simulation = hurcules.Simulation(mission, record=False)
    pace, seed = Pace(simulation.dt), 0
    ready.wait()
    pace.restart()
    for _ in range(round(seconds / simulation.dt)):
        pace.tick(lambda: simulation.step(1))
        if simulation.finished:
            seed += 1
            simulation.reset(seed)
            pace.restart()
    return pace


def row(name: str, pace: Pace) -> list[str]:
    """What a table says of a loop."""
    late: NDArray[np.float64] = np.array(pace.late)
    took = 1e6 * np.percentile(pace.took, (50, 99.9))
    count = int((late > 0.0).sum())
    return [
        name, str(late.size), f"{count} ({count / late.size:.3%})",
        f"{1e3 * max(late.max(), 0.0):.1f}", f"{took[0]:.0f}, {took[1]:.0f}",
    ]  # fmt: skip


def _idle_beside(period: float, seconds: float, ready: Barrier, sender: object) -> None:
    sender.send(idle(period, seconds, ready))  # type: ignore[attr-defined]


def main() -> None:
    """Both at once."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--mission", default="casualty")
    parser.add_argument("--seconds", type=float, default=600.0, help="by the clock")
    asked = parser.parse_args()
    context = get_context("spawn")
    ready, (receiver, sender) = context.Barrier(2), context.Pipe(duplex=False)
    beside = context.Process(target=_idle_beside, args=(1e-3, asked.seconds, ready, sender))
    beside.start()
    busy = os.getloadavg()[0]
    own = paced(asked.mission, asked.seconds, ready)
    nothing = receiver.recv()
    beside.join()
    table = Table("", "ticks", "late", "at most by [ms]", "a tick, median and 99.9 % [µs]")
    table.add_row(*row(asked.mission, own))
    table.add_row(*row("nothing", nothing))
    Console().print(table)
    print(f"{os.cpu_count()} cores; load before {busy:.1f}, after {os.getloadavg()[0]:.1f}")


if __name__ == "__main__":
    main()
