"""Training on a cluster of Ray: who runs which episodes, what is written, how it goes on.

Strategy: a cluster of this machine's own; first observations tell episodes apart; the ONNX file is
held against RLlib's own network.
"""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import hurcules
from hurcules_envs.policy import Policy

rllib = pytest.importorskip("hurcules_envs.rllib", reason="pip install 'ray[rllib]' torch")
ray = pytest.importorskip("ray")
torch = pytest.importorskip("torch")

REACH = "Hurcules/Reach-v0"
OPTIONS = {"fidelity": "kinematic"}


@pytest.fixture(scope="module")
def cluster() -> Iterator[None]:
    """A cluster of this machine."""
    ray.init(num_cpus=3, include_dashboard=False, log_to_driver=False, ignore_reinit_error=True)
    yield
    ray.shutdown()


def test_no_two_runners_have_the_same_episodes(cluster: None) -> None:
    def first_observations(runner: Any) -> list[bytes]:  # nested: sent as it is, not by name
        episodes = runner.sample(num_episodes=12, random_actions=True)
        return [np.asarray(one.get_observations(0)).tobytes() for one in episodes]

    config = rllib.ppo_config(REACH, 2, 4, threads=1, **OPTIONS).debugging(seed=0)
    algorithm = config.build_algo()
    group = algorithm.env_runner_group
    seen = group.foreach_env_runner(first_observations, local_env_runner=False)
    algorithm.stop()
    assert [len(one) for one in seen] == [12, 12]
    assert not set(seen[0]) & set(seen[1])


def test_an_environment_of_ones_own(cluster: None) -> None:
    assert rllib.ppo_config("module:Own/Circle-v0").env == "module:Own/Circle-v0"
    config = rllib.ppo_config(f"hurcules_envs:{REACH}", 1, 1, threads=1, **OPTIONS)
    algorithm = config.build_algo()  # a batch of 64, less than a usual minibatch
    assert algorithm.train()["num_env_steps_sampled_lifetime"] == 64
    algorithm.stop()


def test_a_run_goes_on_and_its_policy_acts_without_rllib(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    networks: list[Any] = []
    seeds: list[list[int]] = []
    export = rllib._export

    def exported(algorithm: Any, *args: Any) -> None:
        networks.append(algorithm.get_module())
        group = algorithm.env_runner_group
        seeds.append(group.foreach_env_runner(lambda r: r._seed, local_env_runner=False))
        export(algorithm, *args)

    monkeypatch.setattr(rllib, "_export", exported)
    told: list[int] = []

    def train(steps: int) -> None:
        rllib.train(
            REACH, "local", steps, tmp_path, OPTIONS,
            runners=1, episodes=4, progress=lambda done, mean: told.append(done),
        )  # fmt: skip

    train(500)
    assert told == [256, 512]
    policy = Policy(str(tmp_path))
    assert policy.environment == REACH
    assert policy.options == {"flat": True, **OPTIONS}
    seen = np.random.default_rng(0).normal(size=(7, 24)).astype(np.float32)
    with torch.no_grad():
        raw = networks[0].forward_inference({"obs": torch.from_numpy(seen)})
    means = raw["action_dist_inputs"].numpy()[:, :6]
    np.testing.assert_allclose(policy(seen), np.clip(means, -1, 1), atol=1e-5)

    train(600)
    assert told == [256, 512, 768]  # from there, not from the start
    assert seeds[1][0] - seeds[0][0] == 512  # with other episodes
    assert json.loads((tmp_path / "settings.json").read_text())["library"] == "rllib"
    with pytest.raises(hurcules.Error, match=r"holds another run: seed \(there 0, now 1\)"):
        rllib.train(REACH, "local", 600, tmp_path, OPTIONS, runners=1, episodes=4, seed=1)


@pytest.mark.parametrize(
    ("address", "message"),
    [
        ("nonsense", "wanted host:port, auto or local, got 'nonsense'"),
        ("127.0.0.1:1", "nothing answers at 127.0.0.1:1"),
    ],
)
def test_a_wrong_address_is_told_at_once(tmp_path: Path, address: str, message: str) -> None:
    with pytest.raises(hurcules.Error, match=message):
        rllib.train(REACH, address, 10, tmp_path, OPTIONS)


def test_a_wrong_option_is_told_before_there_is_a_cluster(tmp_path: Path) -> None:
    with pytest.raises(hurcules.Error, match="fidelity 'fst' does not exist"):
        rllib.train(REACH, "127.0.0.1:1", 10, tmp_path, {"fidelity": "fst"})


def test_a_full_disk_leaves_the_checkpoint_before(tmp_path: Path) -> None:
    class Algorithm:
        full = False

        def save_to_path(self, path: str) -> None:
            Path(path).mkdir()
            (Path(path) / "state").write_text("half" if self.full else "whole")
            if self.full:
                raise OSError(28, "No space left on device")

    algorithm, checkpoint = Algorithm(), tmp_path / "rllib"
    rllib._save(algorithm, checkpoint)
    rllib._save(algorithm, checkpoint)
    algorithm.full = True
    with pytest.raises(hurcules.Error, match=r"rllib: cannot be written: .*No space left"):
        rllib._save(algorithm, checkpoint)
    assert [one.name for one in tmp_path.iterdir()] == ["rllib"]
    assert (checkpoint / "state").read_text() == "whole"
