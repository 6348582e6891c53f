"""Fetches many cases: places, headings, masses, frictions; one line of JSON a run.

    python benchmarks/disposal_sweep.py OUT.jsonl [--seeds 12] [--workers 1] [--show]

Each run is the mission `disposal` in the physics. A seed draws where the case lies (0.10 m either
way, 0.3 rad either way), what it weighs (10 to 30 kg) and how its bars rub (0.4 to 0.9), the errors
of the cameras, and what differs between runs of every mission. Runs that OUT.jsonl already holds
are left out. `--show` prints the runs of a file.

Two fingers of a hand hold half the weight by friction: m g / 2 <= mu N, N the sum of their normal
forces. `share` is m g / (2 mu N) for the N that the table asks for: above 1 they do
not.
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np
from sweeps import append, held, side_by_side

import hurcules

FIRST_SEED = 2000
SQUEEZE = 365.0  # [N] at least, of models/missions/disposal.toml


def drawn(seed: int) -> dict[str, Any]:
    """The parameters of a seed."""
    rng = np.random.default_rng(seed)
    x, y = rng.uniform(-0.10, 0.10, 2)
    return {
        "offset": (round(float(x), 3), round(float(y), 3)),
        "yaw": round(float(rng.uniform(-0.3, 0.3)), 3),
        "mass": round(float(rng.uniform(10.0, 30.0)), 1),
        "friction": round(float(rng.uniform(0.4, 0.9)), 2),
    }


def fetch(seed: int) -> dict[str, Any]:
    """One run: how it ended, and its figures."""
    job = drawn(seed)
    simulation = hurcules.Simulation("disposal", seed, record=False, parameters=job)
    while not simulation.finished:
        simulation.step(1000)
    return {
        **job,
        "seed": seed,
        "share": job["mass"] * 9.81 / (2.0 * job["friction"] * SQUEEZE),
        "success": simulation.success,
        "reason": simulation.reason,
        "phase": simulation.phase,
        "seconds": simulation.time,
        "figures": {name: float(value) for name, value in simulation.figures().items()},
    }


def show(path: Path) -> None:
    """Prints a line a run."""
    runs = held(path)
    for run in sorted(runs, key=lambda one: one["share"]):
        x, y = run["offset"]
        figures = run["figures"]
        print(
            f"{run['seed']} {run['mass']:5.1f} kg mu {run['friction']:.2f} "
            f"share {run['share']:.2f} "
            f"{x:+.2f} {y:+.2f} {run['yaw']:+.2f}  in {figures['in_ahead_m']:+.3f} "
            f"{figures['in_aside_m']:+.3f}  slipped {figures['slipped_m']:.3f}  margin "
            f"{figures['carried_margin_m']:.3f}  {run['success']}  {run['phase']}: {run['reason']}"
        )
    print(f"{sum(run['success'] for run in runs)} of {len(runs)}")


def main() -> None:
    """Runs what is missing."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--seeds", type=int, default=12)
    parser.add_argument("--workers", type=int, default=1)
    parser.add_argument("--show", action="store_true")
    arguments = parser.parse_args()
    if arguments.show:
        return show(arguments.out)
    done = {run["seed"] for run in held(arguments.out)}
    seeds = sorted(set(range(FIRST_SEED, FIRST_SEED + arguments.seeds)) - done)
    append(
        arguments.out,
        side_by_side(fetch, seeds, arguments.workers),
        lambda run: (run["seed"], run["success"], run["phase"], run["reason"]),
    )


if __name__ == "__main__":
    main()
