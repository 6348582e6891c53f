"""Runs a test method: repetitions at a setting, then the next harder one, until one is not passed.

A fault ends a repetition and is logged; the next one begins at the start again. Repetitions know
nothing of each other, so that any number of processes gives the same result.
"""

from __future__ import annotations

import multiprocessing
import signal
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from functools import partial

import numpy as np

from hurcules._core import Error
from hurcules_studies.field_tests.attempt import (
    USUAL,
    Driver,
    Repetition,
    Stopped,
    Variation,
    repeat,
)
from hurcules_studies.field_tests.methods import METHODS, Method, method
from hurcules_studies.field_tests.reliability import confidence, lower_bound

__all__ = ["Result", "SettingResult", "attempt_seed", "run"]

# told of each repetition that has ended: setting, repetitions so far, failures so far
Progress = Callable[[float | None, int, int], None]
Job = tuple[object, ...]  # the arguments of repeat
TOP_SPEED = 20 / 3.6  # [m/s] of the drives
HOPELESS = 3  # failures at the start of a setting, after which it is not repeated any more


@dataclass(frozen=True)
class SettingResult:
    """All attempts at one setting."""

    setting: float | None
    repetitions: int
    failures: int
    passed: bool  # all repetitions that were asked for, without a failure
    confidence_80: float
    confidence_90: float
    lower_bound_95: float
    metres_per_minute: float  # mean over the successful ones, there and back; 0 without one
    drive_energy_per_metre: float  # [J/m] of the drives, mean over all
    faults: list[Repetition]


@dataclass(frozen=True)
class Result:
    """What a method found."""

    method: str
    title: str
    robot: str
    parameter: str
    largest: float | None  # hardest setting that was passed; None for none, or without settings
    passed: bool  # at least one setting
    interrupted: bool  # the last setting lacks repetitions
    simulated_seconds: float
    settings: list[SettingResult]

    def as_dict(self) -> dict[str, object]:
        """For JSON."""
        return asdict(self)


def run(
    name: str | Method,
    robot: str = "rescue",
    *,
    repetitions: int = 10,
    seed: int = 0,
    settings: tuple[float, ...] | None = None,
    speed: float | None = None,
    driver: Driver | None = None,
    variation: Variation = USUAL,
    workers: int = 1,
    progress: Progress = lambda setting, done, failures: None,
    stopped: Callable[[], bool] = lambda: False,
) -> Result:
    """Runs a method until a setting is not passed.

    A setting that fails three times from the start is not repeated any more.

    Args:
        name: one of `METHODS`, or a method of one's own.
        robot: one of `hurcules.models.names()`.
        repetitions: at each setting; one failure fails the setting.
        seed: draws friction, payload, start and terrain.
        settings: instead of the method's own.
        speed: [m/s] there, and back, instead of the method's own.
        driver: commands the drives; by default a `LineDriver`, new each time. With
            several workers it must be one that can be pickled.
        variation: what differs between repetitions.
        workers: processes; the result does not depend on it.
        progress: called after each repetition.
        stopped: whether to end early, asked now and then; what was done is kept.

    Raises:
        Error: no such method or robot, or a bad number.
    """
    chosen = method(name) if isinstance(name, str) else name
    check(chosen, repetitions, workers, speed)
    results: list[SettingResult] = []
    seconds = 0.0
    with _pool(workers) as pool:
        for setting in (settings or chosen.settings) if chosen.parameter else (None,):
            jobs: list[Job] = [
                (chosen, setting, robot, attempt_seed(seed, i), speed, driver, variation)
                for i in range(repetitions)
            ]
            tries = _all(jobs, pool, partial(progress, setting), stopped)
            if tries:
                results.append(_sum_up(setting, tries, repetitions))
                seconds += sum(one.seconds for one in tries)
            if not results or not results[-1].passed:
                break
    passed = [one for one in results if one.passed]
    largest = passed[-1].setting if passed else None
    cut = not _ended(tries, repetitions)
    return Result(
        _name(chosen),
        chosen.title,
        robot,
        chosen.parameter,
        largest,
        bool(passed),
        cut,
        seconds,
        results,
    )


def check(chosen: Method, repetitions: int, workers: int, speed: float | None) -> None:
    """Raises Error for a number that `run` would refuse."""
    name = _name(chosen)
    for what, count in (("repetitions", repetitions), ("workers", workers)):
        if count < 1:
            raise Error(f"{name}: {what}: wanted a whole number from 1 up, got {count}")
    if speed is not None and not 0.0 < speed <= TOP_SPEED:
        wanted = f"wanted a speed above 0, {TOP_SPEED:.2f} m/s (20 km/h) at most"
        raise Error(f"{name}: pace: {wanted}, got {speed:g}")
    if speed is not None and chosen.parameter == "speed":
        raise Error(f"{name}: the speed is its setting; got another one of {speed:g} m/s")


def _name(chosen: Method) -> str:
    """The name of a method; its title for one that has none."""
    return next((key for key, one in METHODS.items() if one.title == chosen.title), chosen.title)


def attempt_seed(seed: int, index: int) -> int:
    """The seed of a repetition."""
    return 1000 * seed + index


def _end(pool: ProcessPoolExecutor) -> None:
    """Ends the processes in the middle of their repetitions."""
    for process in list((getattr(pool, "_processes", None) or {}).values()):
        process.terminate()


@contextmanager
def _pool(workers: int) -> Iterator[ProcessPoolExecutor | None]:
    if workers == 1:
        yield None
        return
    context = multiprocessing.get_context("spawn")  # a fork would copy an OpenGL context
    pool = ProcessPoolExecutor(workers, context, initializer=_ignore_interrupts)
    try:
        yield pool
    finally:
        pool.shutdown(cancel_futures=True)


def _ignore_interrupts() -> None:
    """Ctrl-C goes to all processes of a terminal; the first one decides."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _ended(tries: list[Repetition], wanted: int) -> bool:
    """Whether a setting needs no more repetitions."""
    hopeless = len(tries) == HOPELESS and all(one.fault for one in tries)
    return len(tries) == wanted or hopeless


def _hopeless(done: dict[int, Repetition]) -> bool:
    return all(index in done and done[index].fault for index in range(HOPELESS))


def _all(
    jobs: list[Job],
    pool: ProcessPoolExecutor | None,
    progress: Callable[[int, int], None],
    stopped: Callable[[], bool],
) -> list[Repetition]:
    """The repetitions in the order of their seeds, or those that ended before the stop."""
    done: dict[int, Repetition] = {}

    def note(index: int, repetition: Repetition) -> None:
        done[index] = repetition
        progress(len(done), sum(bool(one.fault) for one in done.values()))

    if pool is None:
        for index, job in enumerate(jobs):
            if stopped() or _hopeless(done):
                break
            try:
                # a tuple of its arguments
                note(index, repeat(*job, stopped=stopped))  # type: ignore[arg-type, misc]
            except Stopped:
                break
    else:
        waiting: dict[Future[Repetition], int] = {
            pool.submit(repeat, *job): index  # type: ignore[arg-type]
            for index, job in enumerate(jobs)
        }
        while waiting and not stopped() and not _hopeless(done):
            ended, _ = wait(waiting, timeout=0.2, return_when=FIRST_COMPLETED)
            for future in ended:
                note(waiting.pop(future), future.result())
        for future in waiting:
            future.cancel()
        if stopped():
            _end(pool)
    kept = range(HOPELESS) if _hopeless(done) else sorted(done)
    return [done[index] for index in kept]


def _sum_up(setting: float | None, tries: list[Repetition], wanted: int) -> SettingResult:
    faults = [one for one in tries if one.fault]
    n, f = len(tries), len(faults)
    rates = [60.0 * one.metres / one.seconds for one in tries if not one.fault]
    way = sum(one.metres for one in tries)
    energy = sum(one.drive_energy for one in tries) / way if way else 0.0
    bounds = confidence(n, f, 0.8), confidence(n, f, 0.9), lower_bound(n, f)
    rate = float(np.mean(rates)) if rates else 0.0
    return SettingResult(setting, n, f, f == 0 and n == wanted, *bounds, rate, energy, faults)
