"""The page of what an action layer is worth says what was measured; the plain layer is one.

Strategy: the tables are made anew from docs/evidence.json. Not tested: that training leads there
again (benchmarks/evidence.py, hours of a core).
"""

import json
import sys
from pathlib import Path

import gymnasium
import numpy as np
import pytest

from hurcules_envs.evaluation import evaluate


@pytest.fixture(autouse=True)
def benchmarks(root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for folder in ("benchmarks", "benchmarks/figures"):
        monkeypatch.syspath_prepend(root / folder)
    sys.modules.pop("evidence", None)  # the name of two


def test_the_tables_of_the_page_are_those_of_the_runs(root: Path) -> None:
    pytest.importorskip("matplotlib", reason="pip install 'hurcules[report]'")
    import evidence

    rows = json.loads((root / "docs" / "evidence.json").read_text())
    page = (root / "docs" / "evidence.md").read_text()
    for environment in {row["environment"] for row in rows}:
        for line in evidence.table(rows, environment).splitlines():
            assert line in page


def test_a_run_that_never_learns_is_said_to_have_never() -> None:
    import evidence

    rows = [{"curve": [[0, 0.0], [10_000, share]], "layer": "twist"} for share in (0.9, 0.2, 0.1)]
    assert evidence.spread([evidence.first(row) for row in rows]) == "never (10000 to never)"


def test_the_plain_layer_moves_the_hands_as_commanded() -> None:
    from layers import LAYERS

    name, options = LAYERS["Reach"]["least squares"]
    env = gymnasium.make(name, fidelity="kinematic", **options).unwrapped
    env.reset(seed=0)
    action = np.array([0.2, 0.0, 0.1, 0.0, -0.2, 0.1], dtype=np.float32)
    places = [env.numbers.row("value/hand_0", "value/hand_1")[0].copy()]
    for _ in range(20):
        env.step(action)
        places.append(env.numbers.row("value/hand_0", "value/hand_1")[0].copy())
    moved = places[-1] - places[10]  # at full speed by then: joints speed up by 5 rad/s^2
    assert moved == pytest.approx(0.3 * action * 0.5, abs=2e-3)


@pytest.mark.parametrize("layer", ["twist", "delta", "joint", "least squares"])
def test_the_expert_presses_through_each_layer(layer: str) -> None:
    from layers import LAYERS

    name, options = LAYERS["Press"][layer]
    env = gymnasium.make(name, fidelity="fast", **options).unwrapped
    env.reset(seed=100)
    for _ in range(250):
        *_, terminated, _, info = env.step(env.environment.expert(env.numbers)[0])
        if terminated:
            break
    assert info["is_success"] and not info["failed"]
    assert info["self_contacts"] == 0 and info["limit_excess"] < 5e-3


def test_the_largest_force_is_watched_in_each_step() -> None:
    from layers import LAYERS

    name, options = LAYERS["Press"]["twist"]
    steps, loads = [], []

    def watch(batch, running) -> None:
        steps.append(int(running.sum()))
        loads.append(batch.environment.load(batch.numbers)[running])

    pressed = np.array([0.0, 0.0, 1.0, 0.5], dtype=np.float32)
    result = evaluate(
        lambda seen: np.tile(pressed, (2, 1)), name, 2, watch=watch, fidelity="fast", **options
    )
    assert sum(steps) == 2 * result.mean_length
    assert np.concatenate(loads).max() > 15.0  # 30 N are asked for
