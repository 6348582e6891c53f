"""Processes that work side by side, and what becomes of a job whose process dies."""

from __future__ import annotations

import multiprocessing
import os
import signal
import sys
import threading
import traceback
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from pathlib import Path
from typing import TypeVar

__all__ = ["DIED", "in_words", "side_by_side", "starting"]

Job = TypeVar("Job")
Made = TypeVar("Made")

DIED = "its process died: killed, out of memory, or a crash in compiled code"
PERIOD = 0.2  # [s] between two looks at whether to stop


def side_by_side(
    make: Callable[[Job], Made],
    jobs: Sequence[Job],
    workers: int,
    stopped: Callable[[], bool],
) -> Generator[tuple[Job, Made | None], None, None]:
    """Makes something of each job, in processes of their own.

    A process that dies takes only its job with it.

    Args:
        make: a function of a module; what it raises is raised here.
        jobs: that can be pickled.
        workers: processes.
        stopped: whether to end early; what is under way is dropped.

    Yields:
        Each job with what was made of it, as they end; None where its process died.
    """
    waiting = list(jobs)
    free = [_pool() for _ in range(min(workers, len(waiting)))]
    running: dict[Future[Made], tuple[ProcessPoolExecutor, Job]] = {}
    try:
        while (waiting or running) and not stopped():
            while free and waiting:
                pool, job = free.pop(), waiting.pop(0)
                with starting():
                    running[pool.submit(make, job)] = pool, job
            for future in wait(running, PERIOD, FIRST_COMPLETED).done:
                pool, job = running.pop(future)
                died = isinstance(future.exception(), BrokenProcessPool)
                if died and stopped():  # by the same signal
                    continue
                if died:
                    pool.shutdown()
                free.append(_pool() if died else pool)
                yield job, None if died else future.result()
    finally:
        for pool in [*free, *(pool for pool, _ in running.values())]:
            for process in list((getattr(pool, "_processes", None) or {}).values()):
                process.terminate()
            pool.shutdown(cancel_futures=True)


def _pool() -> ProcessPoolExecutor:
    """Of one process, so that its death tells which job it was."""
    context = multiprocessing.get_context("spawn")  # a fork would copy an OpenGL context
    return ProcessPoolExecutor(1, context, initializer=_prepare)


def _prepare() -> None:
    """In each worker: Ctrl-C is the parent's business, and without a parent there is none."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    if parent := multiprocessing.parent_process():
        parent.join()
        os._exit(1)


def in_words(error: BaseException) -> str:
    """An exception in a line, with the place where it was raised."""
    where = traceback.extract_tb(error.__traceback__)[-1]
    text = " ".join(f"{type(error).__name__}: {error}".split())
    return f"{text} ({Path(where.filename).name}:{where.lineno})"


@contextmanager
def starting() -> Iterator[None]:
    """Around what starts processes: of one thread each, deaf to Ctrl-C, without our script."""
    with _single_threaded(), _ctrl_c_waits(), _script_unseen():
        yield


@contextmanager
def _single_threaded() -> Iterator[None]:
    """Processes started here use one thread each for linear algebra."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    before = {name: os.environ.get(name) for name in names}
    os.environ.update(dict.fromkeys(names, "1"))
    try:
        yield
    finally:
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value


@contextmanager
def _script_unseen() -> Iterator[None]:
    """Processes started here do not run the caller's script again: it needs no main guard."""
    main = sys.modules["__main__"]
    names = ("__file__", "__spec__")
    before = {name: vars(main)[name] for name in names if name in vars(main)}
    vars(main).pop("__file__", None)
    main.__spec__ = None
    try:
        yield
    finally:
        vars(main).update(before)


@contextmanager
def _ctrl_c_waits() -> Iterator[None]:
    """Ctrl-C is heard afterwards; processes started here never hear it."""
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)
