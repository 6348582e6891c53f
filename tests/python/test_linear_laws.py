"""Linear laws of experts: benchmarks/linear_laws.py in small.

Strategy: the expert of Reach is linear but for its ends, which least squares alone takes for
errors; that of Drive bends. Not tested: the figures of the page, and that the search gains.
"""

import argparse
import sys
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import linear_laws
from linear_laws import asked, policies, run

SEEDS = list(range(20_000, 20_008))


@pytest.mark.parametrize(("name", "least", "most"), [("Reach-v0", 7, 8), ("Drive-v0", 0, 2)])
def test_a_linear_law_does_where_the_expert_is_linear(name: str, least: int, most: int) -> None:
    given = argparse.Namespace(demonstrations=30, noise=0.3, generations=1, drawn=4)
    options = {"fidelity": "kinematic"}
    judged = policies(f"Hurcules/{name}", given, **options)
    successes = {title: run(f"Hurcules/{name}", act, SEEDS, **options)[0].sum()
                 for title, act in judged.items()}  # fmt: skip
    assert successes["expert"] == 8
    assert least <= successes["linear, least squares"] <= most
    assert list(successes) == ["linear, least squares", "linear, search", "expert"]


@pytest.mark.parametrize(
    ("words", "wanted"),
    [
        ("Reach-v0 --drawn 3", "--drawn: wanted a whole number from 4 on, got '3'"),
        ("Reach-v0 --generations=-1", "--generations: wanted a whole number from 0 on, got '-1'"),
        ("Reach-v0 --judged 0", "--judged: wanted a whole number from 1 on, got '0'"),
        ("Reach-v0 --demonstrations 0", "--demonstrations: wanted a whole number from 1 on"),
        ("Reach-v0 --fidelity slow", "fidelity 'slow' does not exist"),
        ("Nope-v0", "'Hurcules/Nope-v0' does not exist"),
        ("Stretch-v0", "Stretch-v0 has no native vector"),
        ("ReachJoint-v0", "has no expert for its action"),
    ],
)
def test_bad_arguments_are_told_at_the_start(
    words: str, wanted: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(SystemExit):
        asked(words.split())
    assert wanted in capsys.readouterr().err


def test_an_expert_that_always_does_the_same_is_no_share(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    shown = SimpleNamespace(observations=np.eye(4), actions=np.ones((4, 2), np.float32))
    monkeypatch.setattr(linear_laws, "demonstrate", lambda *_, **__: shown)
    linear_laws.fitted("Rescue-v0", 1, 0.3)
    assert "explains none (they never change) of 4 expert actions" in capsys.readouterr().out
