"""The recipe of Drive-v0-terrain, benchmarks/terrain_policy.py, in small.

Strategy: a network is fitted to a law that a hand can write, and read back; the expert says of a
mirror image what the mirror image of its action is. Not tested: what the policy reaches
(test_env_policy.py has what ships).
"""

import sys
from pathlib import Path

import numpy as np
import pytest

from hurcules_envs.drive import Drive
from hurcules_envs.imitation import demonstrate
from hurcules_envs.policy import Policy

pytest.importorskip("torch", reason="pip install 'hurcules[train]'")
sys.path.insert(0, str(Path(__file__).parents[2] / "benchmarks"))
import terrain_policy


def law(drive, seen):
    """What the expert does for whole observations."""
    return drive.law(drive.groups_of(seen.astype(float)))


@pytest.fixture(scope="module", params=["step_field", "ramps", "flat"])
def said(request):
    """The environment, what was seen in it, and what its expert did."""
    given = {"fidelity": "fast", "terrain": request.param, "blind": False}
    shown = demonstrate("Drive-v0", 1, 0, 0.0, **given)
    return Drive(**given), shown.observations["observation"], shown.actions


def test_a_round_has_grounds_that_the_next_one_has_not() -> None:
    one, two = (terrain_policy.grounds(["flat", "step_field"], i) for i in (0, 1))
    assert one[0] == two[0] == {"terrain": "flat", "blind": False}
    seeds = [[ground["terrain_seed"] for ground in some[1:]] for some in (one, two)]
    assert seeds == [list(range(100, 112)), list(range(112, 124))]


def test_the_expert_does_in_a_mirror_what_its_mirror_image_does(said) -> None:
    drive, seen, acted = said
    assert law(drive, seen) == pytest.approx(acted, abs=1e-4)
    other, turned = terrain_policy.mirrored(seen, acted, drive)
    assert law(drive, other) == pytest.approx(turned, abs=1e-4)
    assert np.abs(turned[:, 1]).max() > 0.01
    back, again = terrain_policy.mirrored(other, turned, drive)
    assert np.array_equal(back, seen)
    assert np.array_equal(again, acted)


def test_what_is_imagined_is_another_step_and_the_expert_says_what_it_does_there(said) -> None:
    drive, seen, acted = said
    other, wanted = terrain_policy.imagined(seen, drive, np.random.default_rng(0))
    assert wanted == pytest.approx(law(drive, other), abs=1e-4)
    assert np.ptp(other - seen, axis=0)[:4].min() > 0.05  # the goal
    assert np.abs(wanted - acted).max() > 0.05
    assert np.isfinite(other).all()


def test_what_is_learnt_is_written_and_cut_to_an_action(tmp_path: Path) -> None:
    seen = np.random.default_rng(0).normal(2.0, 3.0, (2000, 2)).astype(np.float32)
    wanted = np.clip((seen[:, :1] - 2.0) / 3.0, -1.0, 1.0).astype(np.float32)
    learnt = terrain_policy.fit(seen, wanted, 800)
    terrain_policy.save(tmp_path / "a.onnx", learnt, {"steps": 2000})
    policy = Policy(tmp_path / "a.onnx")
    acted = policy(seen)
    assert policy.metadata["steps"] == "2000"
    assert np.abs(acted).max() <= 1.0
    assert np.sqrt(np.mean((acted - wanted) ** 2)) < 0.1  # the law itself spreads by 0.7
