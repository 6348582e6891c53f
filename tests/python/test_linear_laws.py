"""Linear laws of experts: benchmarks/linear_laws.py in small.

Strategy: the expert of Reach is linear but for its ends, which least squares alone takes for
errors; that of Drive bends. Not tested: the figures of the page, and that the search gains.
"""

import argparse
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
from linear_laws import policies, run

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
