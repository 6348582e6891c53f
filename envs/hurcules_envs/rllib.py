"""Training on a cluster: Ray RLlib with a native vector of environments in each runner."""

from __future__ import annotations

import json
import math
import shutil
import socket
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import gymnasium

import hurcules
from hurcules import extras
from hurcules.interrupts import Interrupts, unheard_by_children
from hurcules_envs.onnx_file import Graph, Node, texts_of, write
from hurcules_envs.run_folder import open_run, write_settings

with extras.importing("pip install 'ray[rllib]' torch"):
    import ray
    import torch
    from ray.rllib.algorithms.algorithm import Algorithm
    from ray.rllib.algorithms.ppo import PPOConfig
    from ray.rllib.env.single_agent_env_runner import SingleAgentEnvRunner
    from torch import nn

    from hurcules_envs.torch_layers import add_layers, add_limits

__all__ = ["Runner", "ppo_config", "train"]

CHECKPOINT_EVERY = 20_000  # steps
PATIENCE = 5.0  # [s], with an address that does not answer


class Runner(SingleAgentEnvRunner):
    """A runner whose episodes no other one has.

    A vector of n episodes takes n seeds, RLlib's runners are one seed apart: of two runners with 16
    episodes each, 15 would be the same. Here runner k begins at seed + k n. One that is started
    again after it died draws its seeds anew: it would repeat its first episodes.
    """

    def __init__(self, *, config: Any, **kwargs: Any) -> None:
        super().__init__(config=config, **kwargs)
        self._seed: int | None
        if self._seed is None or not self.worker_index:
            return
        self._seed += self.worker_index * (config.num_envs_per_env_runner - 1)
        if ray.get_runtime_context().was_current_actor_reconstructed:
            self._seed = None


def ppo_config(environment: str, runners: int = 2, episodes: int = 16, **options: Any) -> PPOConfig:
    """RLlib's PPO (new API stack) on an environment of this package, or one of one's own.

    Each runner steps its episodes in one call; a runner that dies is started again.

    Args:
        environment: id, "Hurcules/Reach-v0", or with the module that registers it,
            "module:Own/Circle-v0", which each runner imports.
        runners: processes that run episodes, anywhere in the cluster.
        episodes: side by side in each.
        options: of the environment; goals are made part of one array.
    """
    batch = 64 * runners * episodes
    return (
        PPOConfig()
        .environment(_with_module(environment), env_config={"flat": True, **options})
        .env_runners(
            env_runner_cls=Runner,
            num_env_runners=runners,
            num_envs_per_env_runner=episodes,
            gym_env_vectorize_mode=gymnasium.VectorizeMode.VECTOR_ENTRY_POINT,
            rollout_fragment_length=64,
        )
        .fault_tolerance(restart_failed_env_runners=True)
        .training(
            train_batch_size=batch,
            minibatch_size=min(256, batch),
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
    """Trains on a cluster; goes on where an earlier run in the same folder was stopped.

    Writes a checkpoint of RLlib, `rllib`, every CHECKPOINT_EVERY steps; at the end, and after
    Ctrl-C or SIGTERM, policy.onnx (see `hurcules_envs.policy`) too; settings.json.

    Args:
        environment: id.
        address: of the cluster, "host:port", "auto", or "local" for one on this machine.
        steps: of all episodes together.
        out: folder, on the machine that this is called on.
        options: of the environment.
        runners: processes that run episodes.
        episodes: side by side in each.
        seed: of networks and episodes.
        progress: is told the steps done and the mean return of the episodes that ended last, NaN
            before the first.

    Returns:
        The folder.

    Raises:
        hurcules.Error: an unknown environment or option, no cluster at the address, a folder with
            another run, or a checkpoint that cannot be written; the last one stays.
        KeyboardInterrupt: after Ctrl-C or SIGTERM; all is written, and the next call goes on.
    """
    given = {"flat": True, **options}
    vector: Any = gymnasium.make_vec(_with_module(environment), num_envs=1, threads=1, **given)
    about = {
        "environment": environment,
        "options": given if vector.environment.goal else dict(options),
        "algorithm": "ppo",
        "seed": seed,
        "action_names": vector.action_names,
        "action_scale": vector.action_scale.tolist(),
        "rate": vector.environment.rate,
    }
    vector.close()
    settings = {
        "environment": environment, "library": "rllib", "algorithm": "ppo", "steps": steps,
        "runners": runners, "episodes": episodes, "seed": seed, "options": dict(options),
        "out": str(out),
    }  # fmt: skip
    settings = json.loads(json.dumps(settings))
    open_run(out, settings)
    _connect(address)
    algorithm = None
    try:
        config = ppo_config(environment, runners, episodes, threads=1, **options)
        algorithm = config.debugging(seed=seed).build_algo()
        write_settings(out, settings)
        done = _restore(algorithm, out / "rllib")
        saved, mean = done, math.nan
        with Interrupts() as interrupts:
            while done < steps and not interrupts.noted:
                result = algorithm.train()
                done = int(result["num_env_steps_sampled_lifetime"])
                latest = result["env_runners"].get("episode_return_mean")
                if latest is not None and not math.isnan(latest):
                    mean = float(latest)
                if progress is not None:
                    progress(done, mean)
                if done - saved >= CHECKPOINT_EVERY:
                    _save(algorithm, out / "rllib")
                    saved = done
            if done > saved:
                _save(algorithm, out / "rllib")
            _export(algorithm, out / "policy.onnx", about | {"steps": done})
        if done < steps:
            raise KeyboardInterrupt
        return out
    finally:
        if algorithm is not None:
            algorithm.stop()
        ray.shutdown()


def _with_module(environment: str) -> str:
    return environment if ":" in environment else f"hurcules_envs:{environment}"


def _connect(address: str) -> None:
    host, _, port = address.removeprefix("ray://").rpartition(":")
    if address not in ("auto", "local"):
        if not host or not port.isdigit():
            raise hurcules.Error(f"--ray: wanted host:port, auto or local, got {address!r}")
        try:
            socket.create_connection((host, int(port)), PATIENCE).close()
        except (OSError, OverflowError) as error:  # Ray itself tries for minutes
            raise hurcules.Error(f"--ray: nothing answers at {address}: {error}") from error
    try:
        with unheard_by_children():  # of the cluster on this machine
            ray.init(address=None if address == "local" else address, ignore_reinit_error=True)
    except (ConnectionError, ValueError, RuntimeError) as error:
        raise hurcules.Error(f"--ray {address}: {error}") from error


def _restore(algorithm: Algorithm, checkpoint: Path) -> int:
    """Goes on from the checkpoint, if there is one, with other episodes; gives the steps done."""
    before = checkpoint.with_name("rllib.old")
    if before.exists() and not checkpoint.exists():  # the end came between two names
        before.rename(checkpoint)
    if not checkpoint.exists():
        return 0
    algorithm.restore_from_path(str(checkpoint.resolve()))
    done = int(algorithm.metrics.peek(("env_runners", "num_env_steps_sampled_lifetime")))

    def go_on(runner: Any) -> None:
        if runner._seed is not None:
            runner._seed += done

    algorithm.env_runner_group.foreach_env_runner(go_on)
    return done


def _save(algorithm: Algorithm, checkpoint: Path) -> None:
    """Whole or not at all."""
    beside, before = checkpoint.with_name("rllib.new"), checkpoint.with_name("rllib.old")
    shutil.rmtree(beside, ignore_errors=True)
    try:
        algorithm.save_to_path(str(beside.resolve()))
        shutil.rmtree(before, ignore_errors=True)
        if checkpoint.exists():
            checkpoint.rename(before)
        beside.rename(checkpoint)
    except OSError as error:
        shutil.rmtree(beside, ignore_errors=True)
        raise hurcules.Error(f"{checkpoint}: cannot be written: {error}") from error
    shutil.rmtree(before, ignore_errors=True)


def _export(algorithm: Algorithm, path: Path, about: Mapping[str, Any]) -> None:
    """The means of the actions, cut to [-1, 1]."""
    module: Any = algorithm.get_module()
    layers: list[Any] = [*module.encoder.actor_encoder.net.mlp, *module.pi.net.mlp]
    *hidden, last = layers
    size = module.action_space.shape[0]
    means = nn.Linear(last.in_features, size)  # behind them stand the spreads
    with torch.no_grad():
        means.weight.copy_(last.weight[:size])
        means.bias.copy_(last.bias[:size])
    nodes: list[Node] = []
    weights: dict[str, Any] = {}
    add_limits(add_layers([*hidden, means], "observation", nodes, weights), nodes, weights)
    inputs = {"observation": module.observation_space.shape[0]}
    write(path, Graph(tuple(nodes), weights, inputs, {"action": size}, texts_of(about)))
