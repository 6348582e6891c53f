"""What an action layer is worth: an environment learnt by the same algorithm under four layers.

The layers are those of layers.py: twists and deltas of the hands and velocities of the joints, each
through the hierarchy with its limits, and a plain damped-least-squares layer. All have the same
task, budget, network, limits and slew. While a policy learns, the deterministic one is judged in
the fidelity that it learns in, and the actions that are drawn in training in `fast`, which has
contacts to measure. The last policy is judged in both fidelities, as it is in `exact`; twists of
Reach on the other form of the robot too.

Run:  python benchmarks/evidence.py OUT [--environment Reach] [--seeds 5]
Writes OUT/evidence.json after each run and goes on where it was stopped; `figures/evidence.py`
draws it. Minutes of a core a run. Needs hurcules[train].
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from layers import LAYERS, PRESS_JOINT, PRESS_JOINT_PUSH
from numpy.typing import NDArray
from stable_baselines3.common.base_class import BaseAlgorithm
from stable_baselines3.common.callbacks import BaseCallback

from hurcules_envs.episodes import Episodes
from hurcules_envs.evaluation import SEED, evaluate
from hurcules_envs.press import Press
from hurcules_envs.sb3 import make_sb3
from hurcules_envs.training import Standardise, TrainOptions, imitate, make_model, standardises

SEED_JUDGED, SEED_WATCHED = 50_000, 70_000  # of their episodes; the last ones have evaluate's own


@dataclass(frozen=True)
class Study:
    """How an environment is learnt and judged.

    Attributes:
        fidelity: that it is learnt in.
        steps: budget, of 16 episodes together.
        judged: steps between judgements.
        watched: steps between looks at the actions drawn in training.
        episodes: how many of each.
        demonstrations: episodes of the expert whose clone a policy begins as; 0: from nothing.
    """

    fidelity: str
    steps: int
    judged: int
    watched: int
    episodes: dict[str, int]
    demonstrations: int = 0


STUDIES = {
    "Reach": Study(
        "kinematic", 80_000, 10_000, 20_000,
        {"judged": 50, "watched": 8, "kinematic": 100, "exact": 50, "manipulation": 50},
    ),
    "Press": Study(
        "fast", 8_192, 4_000, 4_000, {"judged": 16, "watched": 8, "fast": 24, "exact": 16}, 20,
    ),
}  # fmt: skip


@dataclass(frozen=True)
class Run:
    """One policy that is learnt."""

    environment: str
    layer: str
    seed: int

    @property
    def text(self) -> str:
        """A name for files."""
        return f"{self.environment}-{self.layer.replace(' ', '-')}-{self.seed}"


def judged(
    model: BaseAlgorithm, name: str, episodes: int, seed: int = SEED, drawn: bool = False,
    **options: Any,
) -> dict[str, Any]:  # fmt: skip
    """Figures of `evaluate`, and the largest force on the plate of Press [N], at ends of steps.

    Args:
        model: what acts.
        name: id of the environment.
        episodes: how many.
        seed: of the first.
        drawn: actions are drawn, as in training.
        options: of the environment.
    """
    most = 0.0

    def watch(batch: Episodes, running: NDArray[np.bool_]) -> None:
        nonlocal most
        if isinstance(batch.environment, Press):
            most = max(most, float(batch.environment.load(batch.numbers)[running].max()))

    def act(seen: Any) -> Any:
        return model.predict(seen, deterministic=not drawn)[0]

    return asdict(evaluate(act, name, episodes, seed, 1, watch, **options)) | {"force": most}


class Judge(BaseCallback):
    """Judges while a policy learns."""

    def __init__(self, study: Study, name: str, options: dict[str, Any]) -> None:
        super().__init__()
        self._study, self._name, self._options = study, name, options
        self.curve: list[tuple[int, float]] = []
        self.training: list[dict[str, Any]] = []

    def _on_step(self) -> bool:
        return True

    def _on_rollout_start(self) -> None:
        done, study = self.num_timesteps, self._study
        if done // study.judged >= len(self.curve):
            self.judge()
        if done // study.watched >= len(self.training):
            seed = SEED_WATCHED + 100 * len(self.training)
            look = judged(
                self.model, self._name, study.episodes["watched"], seed, True,
                fidelity="fast", **self._options,
            )  # fmt: skip
            self.training.append({"steps": done} | look)

    def judge(self) -> None:
        """The deterministic policy as it is now."""
        result = judged(
            self.model, self._name, self._study.episodes["judged"], SEED_JUDGED,
            fidelity=self._study.fidelity, **self._options,
        )  # fmt: skip
        self.curve.append((self.num_timesteps, result["success"]))


def perform(run: Run, out: Path) -> dict[str, Any]:
    """Learns and judges one policy."""
    study = STUDIES[run.environment]
    name, options = LAYERS[run.environment][run.layer]
    environment = make_sb3(name, 16, 1, fidelity=study.fidelity, **options)
    wanted = TrainOptions(
        name, "ppo", study.steps, seed=run.seed, out=out / run.text,
        options={**options, "fidelity": study.fidelity}, demonstrations=study.demonstrations,
    )  # fmt: skip
    model = make_model(wanted, environment)
    if study.demonstrations:
        imitate(model, wanted, PRESS_JOINT_PUSH if name == PRESS_JOINT else None)
    judge = Judge(study, name, dict(options))
    adapts = standardises(model, wanted)
    model.learn(study.steps, callback=[judge, Standardise()] if adapts else [judge])
    judge.judge()
    model.save(out / run.text / "policy.zip")
    row = asdict(run) | {"steps": study.steps, "curve": judge.curve, "training": judge.training}
    for fidelity in (study.fidelity, "exact"):
        n = study.episodes[fidelity]
        row[fidelity] = judged(model, name, n, fidelity=fidelity, **options)
    n = study.episodes.get("manipulation", 0)
    if n and run.layer in ("twist", "least squares"):
        row["manipulation"] = judged(
            model, name, n, fidelity="fast", robot="manipulation", **options
        )
    environment.close()
    return row


def main() -> None:
    """Does what is left."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--environment", default="Reach", choices=[*STUDIES])
    parser.add_argument("--seeds", type=int, default=5)
    given = parser.parse_args()
    torch.set_num_threads(1)
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / "evidence.json"
    rows = json.loads(path.read_text()) if path.exists() else []
    done = {(row["environment"], row["layer"], row["seed"]) for row in rows}
    wanted = [
        Run(given.environment, layer, seed)
        for seed in range(given.seeds)
        for layer in LAYERS[given.environment]
    ]
    for run in wanted:
        if (run.environment, run.layer, run.seed) in done:
            continue
        rows.append(perform(run, given.out))
        beside = path.with_suffix(".new")
        beside.write_text(json.dumps(rows, indent=1) + "\n")
        beside.replace(path)
        names = (STUDIES[run.environment].fidelity, "exact")
        print(run.text, *(f"{one} {rows[-1][one]['success']:.0%}" for one in names), flush=True)


if __name__ == "__main__":
    main()
