"""What a task-space action is worth: Reach learnt without physics, judged in it, on other robots.

Trains PPO on Reach-v0 (twists of the hands) and on its twin ReachJoint-v0 (velocities of the
joints, the same limits and safe levels) in `kinematic`, several seeds each, and judges the policies
as they are in `exact`; those of Reach-v0 on other robots too. While it trains, each checkpoint is
judged in `kinematic`: steps to a share of successes are those of the deterministic policy.

Run:  python benchmarks/transfer.py OUT [--seeds 5] [--steps 80000]
          [--robot NAME=MODEL:LEFT_FRAME,RIGHT_FRAME ...]
Writes OUT/transfer.json and prints the table of docs/environments.md. Needs hurcules[train].
"""

from __future__ import annotations

import argparse
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

from stable_baselines3 import PPO

from hurcules_envs.evaluation import evaluate
from hurcules_envs.policy import Policy
from hurcules_envs.training import TrainOptions, train

IDS = ("Hurcules/Reach-v0", "Hurcules/ReachJoint-v0")
EVERY = 10_000  # steps between checkpoints


def acting(model: Any) -> Any:
    """Actions of the deterministic policy."""
    return lambda seen: model.predict(seen, deterministic=True)[0]


def learn(name: str, seed: int, steps: int, out: Path) -> list[tuple[int, float]]:
    """Trains one policy; gives (steps, success in `kinematic`) of its checkpoints."""
    options = {"fidelity": "kinematic"}
    curve: list[tuple[int, float]] = []
    checkpoint = out / "checkpoint.zip"
    judged = 0

    def progress(done: int, _: float) -> None:
        nonlocal judged
        if done // EVERY > judged and checkpoint.exists():
            judged = done // EVERY
            model = PPO.load(checkpoint, device="cpu")
            result = evaluate(acting(model), name, 50, seed=50_000, **options)
            curve.append((model.num_timesteps, result.success))

    wanted = TrainOptions(
        environment=name, steps=steps, seed=seed, options=options, out=out, checkpoint_every=EVERY
    )
    train(wanted, progress)
    return curve


def others(words: list[str]) -> dict[str, dict[str, Any]]:
    """Options of the environment by robot, Hurcules' other form first."""
    found: dict[str, dict[str, Any]] = {"manipulation": {"robot": "manipulation"}}
    for word in words:
        name, _, rest = word.partition("=")
        path, _, frames = rest.rpartition(":")
        found[name] = {"robot": path, "frames": tuple(frames.split(","))}
    return found


def main() -> None:
    """Trains, judges, prints."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=int, default=5)
    parser.add_argument("--steps", type=int, default=80_000)
    parser.add_argument("--robot", action="append", default=[], metavar="NAME=MODEL:LEFT,RIGHT")
    given = parser.parse_args()
    rows = []
    for seed in range(given.seeds):
        for name in IDS:
            folder = given.out / f"{name.split('/')[1]}-{seed}"
            row: dict[str, Any] = {"environment": name, "seed": seed}
            row["curve"] = learn(name, seed, given.steps, folder)
            act = Policy(folder)
            for fidelity in ("kinematic", "exact"):
                row[fidelity] = asdict(evaluate(act, name, 100, fidelity=fidelity))
            if name == IDS[0]:
                for robot, options in others(given.robot).items():
                    row[robot] = asdict(evaluate(act, name, 50, fidelity="exact", **options))
            rows.append(row)
            (given.out / "transfer.json").write_text(json.dumps(rows, indent=1) + "\n")
            show(row)


def show(row: dict[str, Any]) -> None:
    """One line: steps to 80 and 95 %, and how the policy did where it was judged."""
    first = [
        next((n for n, share in row["curve"] if share >= least), None) for least in (0.8, 0.95)
    ]
    judged = {name: value for name, value in row.items() if isinstance(value, dict)}
    print(
        f"{row['environment']} seed {row['seed']}: 80 % at {first[0]}, 95 % at {first[1]} steps; "
        + ", ".join(
            f"{name} {value['success']:.0%}"
            f" (falls {value['falls']:.0%}, over a limit {1e3 * value['limit_excess']:.1f} mrad,"
            f" self-contact {value['self_contacts']:.1%})"
            for name, value in judged.items()
        ),
        flush=True,
    )


if __name__ == "__main__":
    main()
