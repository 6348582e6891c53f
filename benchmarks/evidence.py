"""What an action layer is worth: Reach learnt by the same algorithm under four layers.

The layers are those of layers.py: twists and deltas of the hands and velocities of the joints, each
through the hierarchy with its limits and safe levels, and a plain damped-least-squares layer. All
have the same task, budget, network, limits and slew. Policies learn in `kinematic`; every 10,000
steps the deterministic policy is judged in `kinematic`, every 20,000 the actions drawn in training
are judged in `fast`, which has contacts to measure. The last policy is judged in `kinematic`, as it
is in `exact`; twists on the other form of the robot too.

Run:  python benchmarks/evidence.py OUT [--seeds 5]
Writes OUT/evidence.json after each run and goes on where it was stopped; `figures/evidence.py`
draws it. About three minutes of a core a run. Needs hurcules[train].
"""

from __future__ import annotations

import argparse
import json
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import torch
from layers import LAYERS
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback

from hurcules_envs.evaluation import evaluate
from hurcules_envs.sb3 import make_sb3
from hurcules_envs.training import TrainOptions, make_model

JUDGED, WATCHED = 10_000, 20_000  # [steps] between judgements, and between looks at training
SEED_JUDGED, SEED_WATCHED = 50_000, 70_000  # of their episodes; the last ones have evaluate's own
EPISODES = {"judged": 50, "watched": 8, "kinematic": 100, "exact": 50, "manipulation": 50}


@dataclass(frozen=True)
class Run:
    """One policy that is learnt."""

    algorithm: str  # "ppo" on the shaped reward, "her" (SAC with hindsight) on the sparse one
    layer: str
    seed: int

    @property
    def steps(self) -> int:
        """Budget, of 16 episodes together."""
        return 80_000

    @property
    def text(self) -> str:
        """A name for files."""
        return f"{self.algorithm}-{self.layer.replace(' ', '-')}-{self.seed}"


def runs(seeds: int) -> list[Run]:
    """All of them, all layers of a seed after each other."""
    found = [Run("ppo", layer, seed) for seed in range(seeds) for layer in LAYERS]
    return found + [Run("her", one, seed) for seed in range(seeds) for one in ("twist", "joint")]


def acting(model: BaseAlgorithm, deterministic: bool) -> Callable[[Any], Any]:
    """Actions of a model."""
    return lambda seen: model.predict(seen, deterministic=deterministic)[0]


class Judge(BaseCallback):
    """Judges while a policy learns."""

    def __init__(self, name: str, options: dict[str, Any]) -> None:
        super().__init__()
        self._name, self._options = name, options
        self.curve: list[tuple[int, float]] = []
        self.training: list[dict[str, Any]] = []

    def _on_step(self) -> bool:
        return True

    def _on_rollout_start(self) -> None:
        done = self.num_timesteps
        if done // JUDGED >= len(self.curve):
            self.judge()
        if done // WATCHED >= len(self.training):
            seed = SEED_WATCHED + 100 * len(self.training)
            watched = evaluate(
                acting(self.model, False), self._name, EPISODES["watched"], seed, 1,
                fidelity="fast", **self._options,
            )  # fmt: skip
            self.training.append({"steps": done} | asdict(watched))

    def judge(self) -> None:
        """The deterministic policy as it is now."""
        result = evaluate(
            acting(self.model, True), self._name, EPISODES["judged"], SEED_JUDGED, 1,
            fidelity="kinematic", **self._options,
        )  # fmt: skip
        self.curve.append((self.num_timesteps, result.success))


def perform(run: Run, out: Path) -> dict[str, Any]:
    """Learns and judges one policy."""
    name, options = LAYERS[run.layer]
    given = {**options, "sparse": run.algorithm == "her"}
    environment = make_sb3(name, 16, 1, fidelity="kinematic", **given)
    wanted = TrainOptions(name, run.algorithm, run.steps, seed=run.seed, out=out / run.text)
    model = make_model(wanted, environment)
    judge = Judge(name, given)
    model.learn(run.steps, callback=judge)
    judge.judge()
    model.save(out / run.text / "policy.zip")
    row = asdict(run) | {"steps": run.steps, "curve": judge.curve, "training": judge.training}
    act = acting(model, True)
    for fidelity in ("kinematic", "exact"):
        judged = evaluate(act, name, EPISODES[fidelity], threads=1, fidelity=fidelity, **given)
        row[fidelity] = asdict(judged)
    if run.algorithm == "ppo" and run.layer in ("twist", "least squares"):
        other = evaluate(
            act, name, EPISODES["manipulation"], threads=1, fidelity="fast",
            robot="manipulation", **given,
        )  # fmt: skip
        row["manipulation"] = asdict(other)
    environment.close()
    return row


def main() -> None:
    """Does what is left."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=int, default=5)
    given = parser.parse_args()
    torch.set_num_threads(1)
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / "evidence.json"
    rows = json.loads(path.read_text()) if path.exists() else []
    done = {(row["algorithm"], row["layer"], row["seed"]) for row in rows}
    for run in runs(given.seeds):
        if (run.algorithm, run.layer, run.seed) in done:
            continue
        rows.append(perform(run, given.out))
        beside = path.with_suffix(".new")
        beside.write_text(json.dumps(rows, indent=1) + "\n")
        beside.replace(path)
        row = rows[-1]
        print(
            run.text, *(f"{f} {row[f]['success']:.0%}" for f in ("kinematic", "exact")), flush=True
        )


if __name__ == "__main__":
    main()
