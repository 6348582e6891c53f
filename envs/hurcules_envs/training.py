"""Training a policy: Stable-Baselines3 on native vectors of environments."""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from io import BytesIO
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

import hurcules
from hurcules import extras
from hurcules.interrupts import Interrupts
from hurcules.output import write_whole
from hurcules.validation import require_known
from hurcules_envs.cloning import clone
from hurcules_envs.exporting import export_policy
from hurcules_envs.imitation import demonstrate
from hurcules_envs.run_folder import ALGORITHMS, open_run, write_settings
from hurcules_envs.sb3 import PARTS, SCALE, GoalFeatures, Standardised, make_sb3

with extras.importing(extras.remedy("train")):
    import torch
    from stable_baselines3 import PPO, SAC, HerReplayBuffer
    from stable_baselines3.common.base_class import BaseAlgorithm
    from stable_baselines3.common.callbacks import BaseCallback
    from stable_baselines3.common.noise import OrnsteinUhlenbeckActionNoise, VectorizedActionNoise

__all__ = ["Standardise", "TrainOptions", "imitate", "make_model", "standardises", "train"]

PPO_SETTINGS = {
    "n_steps": 32,
    "batch_size": 128,
    "n_epochs": 10,
    "gamma": 0.9,
    "gae_lambda": 0.9,
    "learning_rate": 2e-3,
    "log_std_init": 0.0,  # of the actions
}
# things are touched: an action is rewarded a second later
CONTACT = {
    "gamma": 0.98,
    "gae_lambda": 0.95,
    "n_steps": 64,
    "learning_rate": 1e-3,
    "log_std_init": -0.5,
}
# by the beginning of an id: what differs
RECIPES: Mapping[str, Mapping[str, Any]] = {
    "Hurcules/Reach": {},
    "Hurcules/Drive": {
        "gamma": 0.98,
        "gae_lambda": 0.95,
        "n_steps": 256,
        "batch_size": 512,
        "learning_rate": 1e-3,
    },
    **{f"Hurcules/{name}": CONTACT for name in ("Press", "Valve", "Door", "Carry", "Lift")},
}
# after cloning: small steps, actions drawn near the expert's
AFTER_CLONING = {
    "n_steps": 128,
    "batch_size": 256,
    "n_epochs": 5,
    "learning_rate": 3e-4,
    "target_kl": 0.02,
    "log_std_init": -1.6,  # where the expert was pushed by PUSH
}
PUSH = 0.3  # of the expert's actions: standard deviation
PUSHES = {"Hurcules/Press": 0.1}  # where 1 is 60 N, and 10 % of 8 N matter
# of the observation and the way to the goal, what a network sees; by default both
SEEN: Mapping[str, Sequence[str]] = {
    "Hurcules/Reach-": ("way",),  # where the hands are stands in the achieved goal already
    "Hurcules/Drive-": ("observation",),  # in which the goal is, seen from the robot
}
# the same with hindsight: groups of the observation, and the way. What a hand does next depends on
# how it moves; where that is not seen, the best of many values is one that no action has
SEEN_IN_HINDSIGHT: Mapping[str, Sequence[str]] = {"Hurcules/Reach-": ("velocity", "lead", "way")}
OFF_POLICY = {"learning_rate": 1e-3, "batch_size": 256, "gamma": 0.95, "learning_starts": 2000}
UPDATES = 0.25  # of SAC, a step of an episode
HINDSIGHT = {"tau": 0.02, "ent_coef": 0.02}
HINDSIGHT_UPDATES = 0.5
WANDERS, DRAWN = 2.0, 0.5  # [s], standard deviation of what is added to actions


@dataclass(frozen=True)
class TrainOptions:
    """What is trained, and for how long.

    Attributes:
        environment: id, "Hurcules/Reach-v0", or of one's own, "module:Own/Circle-v0".
        algorithm: "ppo", "sac" or "her" (SAC with hindsight, goal environments only).
        steps: of all episodes together.
        episodes: side by side.
        seed: of networks, actions and episodes.
        options: of the environment.
        out: folder of the results.
        checkpoint_every: so many steps.
        demonstrations: episodes of the scripted expert that actor and critic learn before PPO goes
            on; 0: none.
    """

    environment: str
    algorithm: str = "ppo"
    steps: int = 100_000
    episodes: int = 16
    seed: int = 0
    options: Mapping[str, Any] = field(default_factory=dict)
    out: Path = Path("out/train")
    checkpoint_every: int = 20_000
    demonstrations: int = 0


def train(options: TrainOptions, progress: Callable[[int, float], None] | None = None) -> Path:
    """Trains a policy; goes on where an earlier run in the same folder was stopped.

    Writes checkpoint.zip and policy.onnx (see `hurcules_envs.policy`) every `checkpoint_every`
    steps; at the end, and after Ctrl-C or SIGTERM, policy.zip too (as Stable-Baselines3 reads it);
    settings.json, and the logs of TensorBoard where that is installed.

    Args:
        options: what, and for how long.
        progress: is told the steps done, at first 0, and the share of successes among the last
            episodes.

    Returns:
        The folder.

    Raises:
        hurcules.Error: an unknown environment, algorithm or option, cameras, a folder with another
            run or a broken checkpoint.
        hurcules.output.WriteError: a file cannot be written; the earlier one stays.
        KeyboardInterrupt: after Ctrl-C or SIGTERM; all is written, and the next call goes on.
    """
    require_known("algorithm", options.algorithm, ALGORITHMS)
    if options.options.get("cameras"):
        raise hurcules.Error(
            "cameras: train learns from numbers; from pictures a policy of Stable-Baselines3 does, "
            "in make_sb3(..., cameras=...)"
        )
    torch.set_num_threads(1)  # small networks: more threads only wait for each other
    environment = make_sb3(options.environment, options.episodes, **options.options)
    out, checkpoint = options.out, options.out / "checkpoint.zip"
    settings = json.loads(json.dumps(asdict(options) | {"out": str(out)}))
    open_run(out, settings)
    model = make_model(options, environment)
    write_settings(out, settings)
    about = {
        "environment": options.environment,
        "options": dict(options.options),
        "algorithm": options.algorithm,
        "seed": options.seed,
        "demonstrations": options.demonstrations,
        "action_names": environment.environment.action_names,
        "action_scale": environment.environment.action_scale.tolist(),
        "rate": environment.environment.environment.rate,
    }

    def save() -> None:
        _save(model, checkpoint)
        export_policy(model, out / "policy.onnx", about | {"steps": model.num_timesteps})

    if checkpoint.exists():
        try:
            model = type(model).load(checkpoint, environment, device="cpu")
        except ValueError as error:
            raise hurcules.Error(
                f"{checkpoint} is broken: give another folder ({error})"
            ) from error
        environment.seed(options.seed + model.num_timesteps)  # else the first episodes come again
    if progress is not None:
        progress(0, 0.0)
    if options.demonstrations and not checkpoint.exists():
        imitate(model, options)
        save()
    done = options.steps <= model.num_timesteps or _learn(model, options, save, progress)
    save()
    _save(model, out / "policy.zip")
    environment.close()
    if not done:
        raise KeyboardInterrupt
    return out


def make_model(options: TrainOptions, environment: Any) -> BaseAlgorithm:
    """An untrained model of Stable-Baselines3, with this package's network and settings.

    Args:
        options: algorithm, id of the environment, seed; logs go to a folder in `out`.
        environment: from `make_sb3`.

    Raises:
        hurcules.Error: "her" for what is no goal environment.
    """
    goal = isinstance(environment.observation_space, gymnasium.spaces.Dict)
    if options.demonstrations and options.algorithm != "ppo":
        raise hurcules.Error(f"demonstrations are for ppo, got {options.algorithm}")
    if options.algorithm == "her" and not goal:
        raise hurcules.Error(f"her: {options.environment} is no goal environment")
    kind = "MultiInputPolicy" if goal else "MlpPolicy"
    network: dict[str, Any] = {"net_arch": [64, 64]}
    if goal:
        network["features_extractor_class"] = GoalFeatures
        network["features_extractor_kwargs"] = _seen(options, environment)
    shared = {"seed": options.seed, "device": "cpu", "tensorboard_log": _tensorboard(options.out)}
    if options.algorithm == "ppo":
        recipe = next((r for n, r in RECIPES.items() if options.environment.startswith(n)), {})
        settings = {**PPO_SETTINGS, **recipe}
        if options.demonstrations:
            settings |= AFTER_CLONING
            settings["log_std_init"] += math.log(_push(options) / PUSH)
        network["log_std_init"] = settings.pop("log_std_init")
        if not goal:
            network["features_extractor_class"] = Standardised
        rate = settings["learning_rate"]
        settings["learning_rate"] = lambda left: rate * max(left, 0.0)  # a batch may pass the end
        return PPO(kind, environment, policy_kwargs=network, **settings, **shared)
    settings = dict(OFF_POLICY)
    updates, width = UPDATES, 256
    if options.algorithm == "her":
        settings |= HINDSIGHT
        updates, width = HINDSIGHT_UPDATES, 128
        settings["replay_buffer_class"] = HerReplayBuffer
        settings["replay_buffer_kwargs"] = {"n_sampled_goal": 4}
        settings["action_noise"] = _wandering(options, environment)
    network["net_arch"] = [width, width]
    settings["gradient_steps"] = math.ceil(updates * options.episodes)
    return SAC(kind, environment, policy_kwargs=network, train_freq=1, **settings, **shared)


def _seen(options: TrainOptions, environment: Any) -> dict[str, Any]:
    """What a network sees of a goal environment, for `GoalFeatures`."""
    known = SEEN_IN_HINDSIGHT if options.algorithm == "her" else {}
    parts = next((p for n, p in known.items() if options.environment.startswith(n)), None)
    if parts is None or options.options.get("action") == "joint":
        return {
            "parts": next((p for n, p in SEEN.items() if options.environment.startswith(n)), PARTS)
        }
    groups = environment.environment.environment.observation
    factors = [SCALE * (group.name in parts) for group in groups for _ in range(group.size)]
    return {"parts": PARTS, "factors": factors}


def _wandering(options: TrainOptions, environment: Any) -> VectorizedActionNoise:
    """Noise that lasts for WANDERS [s]: hands come far, and what is far is replayed as a goal."""
    size = environment.action_space.shape
    theta, dt = 1.0 / WANDERS, 1.0 / environment.environment.environment.rate
    sigma = DRAWN * math.sqrt(2.0 * theta) * np.ones(size)
    noise = OrnsteinUhlenbeckActionNoise(np.zeros(size), sigma, theta, dt)
    return VectorizedActionNoise(noise, options.episodes)


def standardises(model: BaseAlgorithm, options: TrainOptions) -> bool:
    """Whether it wants `Standardise` while it learns; a clone goes on seeing the same."""
    extractor = getattr(model.policy, "features_extractor", None)
    return not options.demonstrations and isinstance(extractor, Standardised)


def _push(options: TrainOptions) -> float:
    return next((p for n, p in PUSHES.items() if options.environment.startswith(n)), PUSH)


def imitate(model: BaseAlgorithm, options: TrainOptions, push: float | None = None) -> None:
    """Makes an untrained model the clone of the expert in `options.demonstrations` episodes.

    Args:
        model: untrained.
        options: of its training.
        push: standard deviation of what is added to the expert's actions; None: the environment's.
    """
    n, push = options.demonstrations, _push(options) if push is None else push
    shown = demonstrate(options.environment, n, options.seed, push, **options.options)
    clone(model, shown, options.seed)


def _learn(
    model: BaseAlgorithm,
    options: TrainOptions,
    save: Callable[[], None],
    progress: Callable[[int, float], None] | None,
) -> bool:
    """Up to the wanted number of steps; false: to Ctrl-C or SIGTERM."""
    with Interrupts() as interrupts:
        watch = _Watch(save, options.checkpoint_every, progress, interrupts)
        callbacks = [watch, Standardise()] if standardises(model, options) else [watch]
        left = options.steps - model.num_timesteps
        model.learn(left, callback=callbacks, reset_num_timesteps=False)
    return not interrupts.noted


def _tensorboard(out: Path) -> str | None:
    try:
        import torch.utils.tensorboard  # noqa: F401
    except ImportError:
        return None
    return str(out / "tensorboard")


def _save(model: BaseAlgorithm, path: Path) -> None:
    """Whole or not at all."""
    contents = BytesIO()
    model.save(contents)
    write_whole(path, contents.getvalue())


class Standardise(BaseCallback):
    """Tells the network between two batches what observations are like; no batch is torn."""

    _seen: Any = None

    def _on_step(self) -> bool:
        return True

    def _on_rollout_start(self) -> None:
        if self._seen is not None:
            self.model.policy.features_extractor.update(self._seen)

    def _on_rollout_end(self) -> None:
        observations = self.model.rollout_buffer.observations
        self._seen = observations.reshape(-1, observations.shape[-1]).copy()


class _Watch(BaseCallback):
    """Saves checkpoints, tells how far it is, and stops after Ctrl-C or SIGTERM."""

    def __init__(
        self,
        save: Callable[[], None],
        every: int,
        progress: Callable[[int, float], None] | None,
        interrupts: Interrupts,
    ) -> None:
        super().__init__()
        self._interrupts = interrupts
        self._save, self._every, self._progress = save, every, progress
        self._saved = 0
        self._ends: list[bool] = []

    def _on_training_start(self) -> None:
        self._saved = self.num_timesteps

    def _on_step(self) -> bool:
        for done, info in zip(self.locals["dones"], self.locals["infos"], strict=True):
            if done:
                self._ends = [*self._ends[-99:], bool(info["is_success"])]
        if self.num_timesteps - self._saved >= self._every:
            self._save()
            self._saved = self.num_timesteps
        if self._progress is not None:
            share = sum(self._ends) / len(self._ends) if self._ends else 0.0
            self._progress(self.num_timesteps, share)
        return not self._interrupts.noted
