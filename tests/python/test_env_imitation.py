"""Demonstrations of the scripted experts, and policies that begin as their clones.

Strategy: few episodes of Valve-v0 in `fast`; returns are summed anew by hand, a network is asked
what it was taught. Not tested: how well what is learnt does (docs/environments.md has the figures).
"""

from pathlib import Path

import numpy as np
import pytest

import hurcules
from hurcules.cli import main
from hurcules_envs.imitation import demonstrate
from hurcules_envs.policy import Policy

VALVE = "Hurcules/Valve-v0"
FAST = {"fidelity": "fast"}


@pytest.fixture(scope="module")
def shown():
    return demonstrate(VALVE, 4, seed=3, **FAST)


def test_each_step_has_an_observation_an_action_and_a_return(shown) -> None:
    steps = int(shown.going.sum())
    assert (shown.observations.shape, shown.actions.shape) == ((steps, 15), (steps, 4))
    assert shown.successes.all()
    lengths = shown.going.sum(axis=0)
    assert (shown.rewards[~shown.going] == 0.0).all()
    assert (shown.rewards[lengths - 1, range(4)] > 10.0).all()  # success, and then no more
    first = shown.returns(0.9)[:4]  # all begin in the first step
    discounts = 0.9 ** np.arange(len(shown.rewards))
    assert np.allclose(first, discounts @ shown.rewards, atol=1e-5)


def test_the_same_seed_shows_the_same(shown) -> None:
    again = demonstrate(VALVE, 4, seed=3, **FAST)
    assert np.array_equal(again.observations, shown.observations)
    assert np.array_equal(again.actions, shown.actions)


def test_where_a_policy_acts_the_expert_says_what_it_would_have_done(shown) -> None:
    asked = []

    def stands_still(seen):
        asked.append(len(seen["observation"]))
        return np.zeros((4, 4))

    other = demonstrate(VALVE, 4, seed=3, act=stands_still, **FAST)
    assert asked == [4] * len(other.going)
    assert not other.successes.any()  # the expert's succeed in all
    assert np.abs(other.actions).max(axis=1).min() > 0.0  # not those that were taken
    assert np.array_equal(other.actions[:4], shown.actions[:4])  # the starts are the same


def test_the_goals_of_goal_environments_are_kept() -> None:
    seen = demonstrate("Hurcules/Reach-v0", 2, fidelity="kinematic").observations
    assert set(seen) == {"observation", "achieved_goal", "desired_goal"}
    assert seen["desired_goal"].shape == (200, 6)


def test_demonstrations_last_as_long_at_any_rate() -> None:
    shown = demonstrate("Reach-v0", 1, fidelity="kinematic", rate=10)
    assert len(shown.going) == 50  # 5 s, as 100 steps at the usual 20 Hz


def test_an_action_without_expert_is_refused() -> None:
    with pytest.raises(hurcules.Error, match="ValveJoint-v0 has no expert for its action"):
        demonstrate("Hurcules/ValveJoint-v0", 1, **FAST)


def test_what_is_seen_is_standardised() -> None:
    sb3 = pytest.importorskip("hurcules_envs.sb3", reason="pip install 'hurcules[train]'")
    import torch
    from gymnasium.spaces import Box

    seen = np.random.default_rng(0).normal([0.01, 500.0, 3.0], [0.02, 90.0, 0.0], (500, 3))
    features = sb3.Standardised(Box(-1e3, 1e3, (3,)))
    features.update(seen[:100])
    features.update(seen[100:])
    out = features(torch.as_tensor(seen, dtype=torch.float32)).numpy()
    assert np.allclose(out.mean(axis=0), 0.0, atol=1e-3)
    assert np.allclose(out[:, :2].std(axis=0), [1.0, 1.0], atol=0.06)  # 1 mm is added
    assert np.abs(out[:, 2]).max() < 1e-2  # what does not change


def test_a_policy_begins_as_a_clone_and_goes_on(tmp_path: Path, monkeypatch) -> None:
    training = pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    from stable_baselines3 import PPO

    options = training.TrainOptions(
        VALVE, steps=0, episodes=2, options=FAST, out=tmp_path, demonstrations=6
    )
    training.train(options)
    shown = demonstrate(VALVE, 6, **FAST)
    policy = Policy(tmp_path)
    assert policy.metadata["demonstrations"] == "6"
    assert np.sqrt(np.mean((policy(shown.observations) - shown.actions) ** 2)) < 0.2
    model = PPO.load(tmp_path / "policy.zip", device="cpu")
    value = model.policy.predict_values(model.policy.obs_to_tensor(shown.observations)[0])
    returns = shown.returns(model.gamma)
    assert np.corrcoef(value.detach().numpy()[:, 0], returns)[0, 1] > 0.9
    assert np.allclose(
        policy(shown.observations),
        model.predict(shown.observations, deterministic=True)[0],
        atol=1e-5,
    )

    monkeypatch.delattr(training, "demonstrate")  # is not asked twice
    training.train(training.TrainOptions(**{**vars(options), "steps": 256}))
    after = PPO.load(tmp_path / "policy.zip", device="cpu")
    assert after.num_timesteps == 256
    before, now = (one.policy.features_extractor for one in (model, after))
    assert np.array_equal(now.mean, before.mean)  # what was cloned goes on seeing the same
    change = Policy(tmp_path)(shown.observations) - shown.actions
    assert np.sqrt(np.mean(change**2)) < 0.3  # nor is it unlearnt

    training.train(training.TrainOptions(**{**vars(options), "steps": 257}))
    last = PPO.load(tmp_path / "policy.zip", device="cpu")
    assert last.num_timesteps == 512  # the batch passes the end: no step backwards
    pairs = zip(after.policy.parameters(), last.policy.parameters(), strict=True)
    assert all(bool((one == other).all()) for one, other in pairs)


def test_demonstrations_go_with_ppo_alone(tmp_path: Path, capsys) -> None:
    pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    words = ["train", "Valve-v0", "--demonstrations", "1", "--out", str(tmp_path)]
    assert main([*words, "--algo", "sac"]) == 2
    assert "demonstrations are for ppo" in capsys.readouterr().err
    assert main([*words, "--ray", "local"]) == 2
    assert "--demonstrations: not with --ray" in capsys.readouterr().err


def test_a_training_that_was_refused_leaves_its_folder_to_the_next(tmp_path: Path, capsys) -> None:
    pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    words = ["train", "Valve-v0", "--steps", "128", "--envs", "2", "--judge", "1"]
    words += ["--no-video", "--out", str(tmp_path)]
    assert main([*words, "--algo", "her"]) == 2
    assert "her: Hurcules/Valve-v0 is no goal environment" in capsys.readouterr().err
    assert main(words) == 0
    assert main(["train", "Stretch-v0", "--steps", "128"]) == 2
    assert "Hurcules/Stretch-v0 has no native vector" in capsys.readouterr().err


def test_without_a_shaped_reward_only_success_counts(tmp_path: Path) -> None:
    pytest.importorskip("hurcules_envs.training", reason="pip install 'hurcules[train]'")
    words = ["train", "Reach-v0", "--sparse", "--steps", "128", "--envs", "1", "--judge", "1"]
    words += ["--no-video"]
    assert main([*words, "--algo", "her", "--out", str(tmp_path)]) == 0
    assert Policy(tmp_path).options == {"fidelity": "kinematic", "sparse": True}
