"""The recipe of Drive-v0-terrain, benchmarks/terrain_policy.py, in small.

Strategy: a network is fitted to a law that a hand can write, and read back. Not tested: what the
policy reaches (test_env_policy.py has what ships).
"""

import sys
from pathlib import Path

import numpy as np
import pytest

from hurcules_envs.policy import Policy

pytest.importorskip("torch", reason="pip install 'hurcules[train]'")
sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import terrain_policy


def test_a_round_has_three_fields_that_the_next_one_has_not() -> None:
    one, two = (terrain_policy.grounds(["stairs", "step_field"], i) for i in (0, 1))
    assert one[0] == {"terrain": "stairs", "terrain_seed": 0}
    assert [ground["terrain_seed"] for ground in one] == [0, 20, 21, 22]
    assert [ground["terrain_seed"] for ground in two] == [0, 23, 24, 25]


def test_what_is_learnt_is_written_and_cut_to_an_action(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(terrain_policy, "STEPS", 800)
    seen = np.random.default_rng(0).normal(2.0, 3.0, (2000, 2)).astype(np.float32)
    wanted = np.clip((seen[:, :1] - 2.0) / 3.0, -1.0, 1.0).astype(np.float32)
    terrain_policy.save(tmp_path / "a.onnx", terrain_policy.fit(seen, wanted), {"steps": 2000})
    policy = Policy(tmp_path / "a.onnx")
    acted = policy(seen)
    assert policy.metadata["steps"] == "2000"
    assert np.abs(acted).max() <= 1.0
    assert np.sqrt(np.mean((acted - wanted) ** 2)) < 0.1  # the law itself spreads by 0.7
