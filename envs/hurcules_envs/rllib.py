"""Training on a cluster: Ray RLlib with a native vector of environments in each runner."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import gymnasium
import ray
from ray.rllib.algorithms.ppo import PPOConfig

from hurcules.interrupts import Interrupts

__all__ = ["ppo_config", "train"]


def ppo_config(environment: str, runners: int = 2, episodes: int = 16, **options: Any) -> PPOConfig:
    """RLlib's PPO (new API stack) on an environment of this package.

    Each runner steps its episodes in one call; a runner that dies is started again.

    Args:
        environment: id, "Hurcules/Reach-v0".
        runners: processes that run episodes, anywhere in the cluster.
        episodes: side by side in each.
        options: of the environment; goals are made part of one array.
    """
    return (
        PPOConfig()
        .environment(f"hurcules_envs:{environment}", env_config={"flat": True, **options})
        .env_runners(
            num_env_runners=runners,
            num_envs_per_env_runner=episodes,
            gym_env_vectorize_mode=gymnasium.VectorizeMode.VECTOR_ENTRY_POINT,
            rollout_fragment_length=64,
        )
        .fault_tolerance(restart_failed_env_runners=True)
        .training(
            train_batch_size=64 * runners * episodes,
            minibatch_size=256,
            num_epochs=10,
            lr=1e-3,
            gamma=0.95,
        )
    )


def train(
    environment: str,
    address: str,
    steps: int,
    out: Path,
    options: Mapping[str, Any],
    *,
    runners: int = 2,
    episodes: int = 16,
    seed: int = 0,
    progress: Callable[[int, float], None] | None = None,
) -> Path:
    """Trains on a cluster and writes a checkpoint of RLlib, at the end and after Ctrl-C or SIGTERM.

    Args:
        environment: id.
        address: of the cluster, "auto", or "local" for one on this machine.
        steps: of all episodes together.
        out: folder.
        options: of the environment.
        runners: processes that run episodes.
        episodes: side by side in each.
        seed: of networks and episodes.
        progress: is told the steps done and the mean return.

    Returns:
        The folder of the checkpoint.

    Raises:
        KeyboardInterrupt: after Ctrl-C or SIGTERM; the checkpoint is written.
    """
    ray.init(address=None if address == "local" else address, ignore_reinit_error=True)
    config = ppo_config(environment, runners, episodes, threads=1, **options).debugging(seed=seed)
    algorithm = config.build_algo()
    try:
        done = 0
        with Interrupts() as interrupts:
            while done < steps and not interrupts.noted:
                result = algorithm.train()
                done = int(result["num_env_steps_sampled_lifetime"])
                if progress is not None:
                    mean = result["env_runners"].get("episode_return_mean")
                    progress(done, float("nan") if mean is None else float(mean))
            written = Path(algorithm.save_to_path(str((out / "rllib").resolve())))
        if interrupts.noted:
            raise KeyboardInterrupt
        return written
    finally:
        algorithm.stop()
        ray.shutdown()
