"""Fidelities lead the hands along the same path, nearly: benchmarks/deviation.py in small.

Strategy: few random commands in `exact` and `fast`. Not tested: the figures of the page.
"""

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
from deviation import paths


@pytest.mark.parametrize("kind", ["uniform", "sine"])
def test_fast_leads_the_hands_as_exact_does(kind: str) -> None:
    exact, fast = (paths(kind, fidelity, 2, 1.0) for fidelity in ("exact", "fast"))
    assert exact.shape == (2, 20, 2, 2, 3)
    moved = np.linalg.norm(exact[0, -1] - exact[0, 0], axis=-1)
    apart = np.linalg.norm(fast - exact, axis=-1)
    assert moved.max() > 0.05
    assert apart[0].max() < 0.01 and apart[1].max() < 0.003  # hands, references
