"""The command `hurcules bench`: speed on this machine, as ratios of what is measured in turn."""

from __future__ import annotations

import json
import os
import subprocess
import tempfile
import time
from collections.abc import Callable, Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from statistics import median
from typing import Annotated, TextIO

import gymnasium
import numpy as np
import typer
from rich.console import Console
from rich.progress import Progress
from rich.table import Table

import hurcules
from hurcules import rhqp
from hurcules._exec import program
from hurcules.output import writing

__all__ = ["Figure", "bench", "figures"]

LEVELS = (3, 3, 3, 3, 3, 2, 2)  # rows of each, 19 unknowns
EPISODES = 16
REACH = "hurcules_envs:Hurcules/Reach-v0"


@dataclass(frozen=True)
class Figure:
    """One ratio.

    Attributes:
        what: is measured.
        than: what it is measured by.
        value: median over the rounds.
        least, largest: of the rounds.
    """

    what: str
    than: str
    value: float
    least: float
    largest: float


def bench(
    seconds: Annotated[
        float, typer.Option(help="Of each measurement in each round [s].", min=0.01)
    ] = 0.5,
    rounds: Annotated[int, typer.Option(help="In each, all take their turn.", min=1)] = 5,
    out: Annotated[
        Path | None, typer.Option("--json", metavar="<path>", help="File to write too.")
    ] = None,
) -> None:
    """Measure the speed of loop, solver and environments on this machine, as ratios.

    Machines are noisy: a ratio of two things measured in turn says more than a time. The repository
    has more in its folder `benchmarks`.

    For example `hurcules bench`, or `hurcules bench --seconds 2 --json bench.json`
    """
    file = None if out is None else _opened(out)  # before what takes long
    measured = []
    with Progress(transient=True) as bar:
        task = bar.add_task("measuring", total=5)
        for figure in figures(seconds, rounds):
            measured.append(figure)
            bar.update(task, completed=len(measured))
    table = Table(box=None, pad_edge=False)
    table.add_column("measured", overflow="fold")
    table.add_column("than", overflow="fold")
    table.add_column("ratio", justify="right")
    table.add_column("least to largest", justify="right")
    for one in measured:
        table.add_row(
            one.what, one.than, f"{one.value:.3g}", f"{one.least:.3g} to {one.largest:.3g}"
        )
    Console().print(table)
    if file is not None:
        with file:
            json.dump([asdict(one) for one in measured], file, indent=1)


def figures(seconds: float, rounds: int) -> Iterator[Figure]:
    """Measures one after the other.

    Args:
        seconds: of each measurement in each round [s].
        rounds: in which what is compared takes its turn.
    """
    yield from _loop(seconds, rounds)
    solve, factor = _solve(), _factor()
    yield _ratio(
        f"time of a warm solve, {sum(LEVELS)} unknowns, {len(LEVELS)} strict levels",
        "numpy.linalg.qr of the same rows",
        factor, solve, seconds, rounds,
    )  # fmt: skip
    threads = min(2, os.cpu_count() or 1)
    yield _ratio(
        f"{EPISODES} simulations of the stretch on {threads} threads, steps a second",
        "one thread",
        _batch(threads), _batch(1), seconds, rounds,
    )  # fmt: skip
    native = gymnasium.make_vec(REACH, EPISODES, fidelity="kinematic", threads=1)
    sync = gymnasium.make_vec(REACH, EPISODES, "sync", fidelity="kinematic")
    yield _ratio(
        f"{EPISODES} episodes of Reach-v0 on one thread, kinematic, steps a second",
        "Gymnasium's SyncVectorEnv",
        _episodes(native), _episodes(sync), seconds, rounds,
    )  # fmt: skip


def _opened(path: Path) -> TextIO:
    with writing(path):
        return path.open("w", encoding="utf-8")


def _loop(seconds: float, rounds: int) -> Iterator[Figure]:
    """Of hurcules-sim: the control tick by its period, simulated time by that of the wall."""
    ticks, factors = [], []
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "report.json")
        command = [
            str(program()),
            "stretch",
            "--seconds",
            str(2.0 + 4.0 * seconds),
            "--json",
            str(file),
        ]
        for _ in range(rounds):
            subprocess.run(command, check=True, capture_output=True)
            report = json.loads(file.read_text())
            ticks.append(1e-3 * report["control_tick_us"]["median"])
            factors.append(report["real_time_factor"])
    yield _figure("control tick of the stretch, without physics", "its period, 1 ms", ticks)
    yield _figure("the whole loop of the stretch, simulated time", "time of the wall", factors)


def _ratio(
    what: str,
    than: str,
    one: Callable[[], object],
    other: Callable[[], object],
    seconds: float,
    rounds: int,
) -> Figure:
    """How many calls of one go by in the time of a call of the other."""
    pairs = [(_rate(one, seconds), _rate(other, seconds)) for _ in range(rounds)]
    return _figure(what, than, [first / second for first, second in pairs])


def _figure(what: str, than: str, values: list[float]) -> Figure:
    return Figure(what, than, median(values), min(values), max(values))


def _rate(call: Callable[[], object], seconds: float) -> float:
    """Calls a second, by the clock on the wall."""
    call()
    count, start = 0, time.perf_counter()
    while (spent := time.perf_counter() - start) < seconds:
        call()
        count += 1
    return max(count, 1) / spent


def _rows() -> list[np.ndarray]:
    generator = np.random.default_rng(0)
    return [generator.normal(size=(m, sum(LEVELS))) for m in LEVELS]


def _solve() -> Callable[[], object]:
    """Rows that ask for more than the box has, rho = 0.1."""
    wanted = np.random.default_rng(1).uniform(-1.55, 1.55, sum(LEVELS))
    box = rhqp.Bounds(np.full(len(wanted), -1.0), np.ones(len(wanted)))
    levels = [box, *(rhqp.Level(A, A @ wanted, A @ wanted, rho=0.1) for A in _rows())]
    solver = rhqp.Solver(len(wanted))
    return lambda: solver.solve(levels)


def _factor() -> Callable[[], object]:
    stacked = np.vstack(_rows())
    return lambda: np.linalg.qr(stacked, mode="complete")


def _batch(threads: int) -> Callable[[], object]:
    simulation = hurcules.Simulation("stretch", record=False)
    batch = hurcules.SimulationBatch(simulation, n=EPISODES, threads=threads)
    return lambda: batch.step(4)


def _episodes(vector: gymnasium.vector.VectorEnv) -> Callable[[], object]:
    vector.reset(seed=0)
    generator = np.random.default_rng(0)
    shape = vector.action_space.shape or ()
    actions = generator.uniform(-1.0, 1.0, (64, *shape)).astype(np.float32)
    turn = iter(range(10**9))
    return lambda: vector.step(actions[next(turn) % 64])
