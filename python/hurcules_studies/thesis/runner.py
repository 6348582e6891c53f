"""Runs claims in several processes; each finished claim lies on the disk, so a run can go on later.

A bundle of claims is one task. A bundle whose process dies is taken up again alone, at the claim
after the one that it died with.
"""

from __future__ import annotations

import multiprocessing
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from pathlib import Path

from hurcules.workers import DIED, starting
from hurcules_studies.thesis.claim import Verdict
from hurcules_studies.thesis.measures import bundles
from hurcules_studies.thesis.result import load, without_finding
from hurcules_studies.thesis.worker import keep, prepare, work

__all__ = ["Runner", "kept"]

PERIOD = 0.2  # [s] between two looks at what is finished


@dataclass
class Runner:
    """Measures claims.

    Attributes:
        folder: holds ID.json of each finished claim.
        workers: processes.
        stopped: whether to end early; what is under way is dropped.
        progress: called with the ids that are still open.
    """

    folder: Path
    workers: int
    stopped: Callable[[], bool]
    progress: Callable[[list[str]], None]

    def run(self, names: list[str]) -> None:
        """Measures these claims, those that measure time one by one at the end."""
        beside, alone = bundles(names)
        self._run(beside, self.workers)
        for bundle in alone:
            self._run([bundle], 1)

    def _run(self, tasks: list[list[str]], workers: int) -> None:
        """Runs bundles; after a crash each bundle that is not through goes on by itself."""
        broken = self._attempt(tasks, min(workers, max(1, len(tasks))))
        for bundle in broken:
            while (rest := self._open(bundle)) and not self.stopped():
                if self._attempt([rest], 1):
                    culprit = self._open(rest)[0]
                    keep(without_finding(culprit, Verdict.ERROR, DIED), self.folder)

    def _attempt(self, tasks: list[list[str]], workers: int) -> list[list[str]]:
        """Runs bundles once; returns those whose processes died."""
        if not tasks or self.stopped():
            return []
        context = multiprocessing.get_context("spawn")
        with ProcessPoolExecutor(workers, context, initializer=prepare) as pool:
            with starting():
                futures = {pool.submit(work, bundle, self.folder): bundle for bundle in tasks}
            self._watch(futures, [name for bundle in tasks for name in bundle])
            if self.stopped():
                pool.shutdown(wait=False, cancel_futures=True)
                for process in multiprocessing.active_children():
                    process.terminate()
                return []
        return [bundle for future, bundle in futures.items() if _died(future)]

    def _watch(self, futures: dict[Future[None], list[str]], names: list[str]) -> None:
        open_tasks = set(futures)
        while open_tasks and not self.stopped():
            _, open_tasks = wait(open_tasks, timeout=PERIOD)
            self.progress(self._open(names))

    def _open(self, names: Sequence[str]) -> list[str]:
        """Those without a file: whatever an earlier run left was removed before."""
        return [name for name in names if not (self.folder / f"{name}.json").exists()]


def _died(future: Future[None]) -> bool:
    """Whether the process of a task is gone; any other failure, a full disk, is raised."""
    try:
        future.result()
    except BrokenProcessPool:
        return True
    return False


def kept(folder: Path, names: Sequence[str], fresh: bool) -> list[str]:
    """The claims that an earlier run finished with the same code; removes what is of no use."""
    done = []
    for name in names:
        path = folder / f"{name}.json"
        result = None if fresh else load(path)
        if result is not None and result.verdict != Verdict.ERROR:
            done.append(name)
        else:
            path.unlink(missing_ok=True)
    return done
