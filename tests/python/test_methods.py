"""The methods by name: what Python and the command line offer, and the cascade as a second judge.

Strategy: the cascade shares nothing with the default (one dense dual program a level), so agreement
on every class of difficulty says as much as the oracle. Not tested here: what Algorithm 1 answers
(test_claims.py) and what every method keeps (C++, methods_test).
"""

from __future__ import annotations

import inspect
import json
from pathlib import Path

import numpy as np
import pytest

from hierarchies import CLASSES, to_levels
from hurcules import cli, rhqp
from test_solver_oracle import difference

NAMES = ["lexicographic", "rhqp_thesis", "hqp", "dls_hqp", "cascade"]


def test_the_names_are_those_of_the_interface() -> None:
    assert rhqp.method_names() == NAMES
    for name in NAMES:
        assert rhqp.SolverOptions(method=name).method == name
        assert f"'{name}'" in (inspect.getdoc(rhqp.method_names) or "")


@pytest.mark.parametrize("name", CLASSES)
def test_the_cascade_agrees_with_the_default(name: str) -> None:
    """10,500 problems of these classes, 0 different (measured once); 60 a class here."""
    for seed in range(60):
        n, levels = CLASSES[name](np.random.default_rng([seed, len(name)]))
        ours = rhqp.Solver(n).solve(to_levels(levels))
        cascade = rhqp.Solver(n, rhqp.SolverOptions(method="cascade")).solve(to_levels(levels))
        assert cascade.status == rhqp.Status.Solved, f"seed {seed}"
        assert cascade.optimality < 1e-9
        assert difference(cascade.x, ours.x) < 1e-6, f"seed {seed}"


def test_no_iterations_are_refused() -> None:
    with pytest.raises(ValueError, match="max_iterations must be positive, got 0"):
        rhqp.Solver(2, rhqp.SolverOptions(max_iterations=0))


@pytest.mark.parametrize("name", NAMES[1:])
def test_a_mission_runs_with_every_method(name: str, tmp_path: Path) -> None:
    out = str(tmp_path)
    words = ["run", "--method", name, "--seconds", "0.5", "--no-video", "--out", out]
    assert cli.main(words) == 0
    summary = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert summary["method"] == name
    assert summary["simulated_seconds"] == pytest.approx(0.5)
