"""Commanded velocities do not jump, and a conflict of two hands rests (benchmarks/jumps.py).

Strategy: one arm on each path through singularities, limits and changes of rows, at 5 ms; with an
ample acceleration the change in a tick must shrink with the tick. One conflict of two hands of the
robot on tracks: the first arrives, all rests. Not tested: how near the second comes, for
which SciPy is needed (docs/control.md).
"""

import sys
from importlib import import_module
from pathlib import Path
from types import ModuleType

import pytest


@pytest.fixture
def jumps(root: Path, monkeypatch: pytest.MonkeyPatch) -> ModuleType:
    monkeypatch.setattr(sys, "path", [str(root / "benchmarks"), *sys.path])
    return import_module("jumps")


@pytest.mark.parametrize("name", ["elbow", "wrist", "base", "limit", "rows"])
@pytest.mark.parametrize("accelerations", [False, True])
def test_no_velocity_changes_faster_than_allowed(
    jumps: ModuleType, name: str, accelerations: bool
) -> None:
    path = jumps.Way(name, 0)
    assert jumps.Run(path, 0.005, False, accelerations).go()["change"] < 1.0 + 1e-9
    if name in ("elbow", "rows"):
        coarse, fine = (jumps.Run(path, dt, True, accelerations).go() for dt in (0.005, 0.0025))
        assert fine["jump"] < 0.7 * coarse["jump"]


def test_a_conflict_of_two_hands_rests(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(sys, "path", [str(root / "benchmarks"), *sys.path])
    conflicts = import_module("conflicts")
    conflict = conflicts.Conflict(next(conflicts.subjects("hurcules/manipulation")), 0)
    run = conflict.run("arrive", 0.005)
    assert run["near_mm"] < 1.0 and run["speed"] < conflicts.MOVES
