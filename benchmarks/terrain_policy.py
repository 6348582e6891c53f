"""A policy for terrain learns from Drive's expert, by DAgger.

Run:  python benchmarks/terrain_policy.py [OUT] [--rounds 12] [--grounds slope ramps stairs]

In each round the policy as it is drives some episodes, the expert says what it would have done in
each step, and a network learns all that was ever said (Ross, Gordon and Bagnell, 2011). In the
first round the expert drives. What is drawn by a seed is in each round of three other ones of 20
to 34. OUT has policy.onnx, and what was said, from which a run that was stopped goes on.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray
from torch import nn

from hurcules_envs.imitation import demonstrate
from hurcules_envs.onnx_file import Graph, Node, texts_of, write
from hurcules_envs.policy import Policy
from hurcules_envs.registry import make_episodes
from hurcules_envs.terrain import TERRAINS
from hurcules_envs.torch_layers import add_layers, add_limits, add_standard

NAME = "Hurcules/Drive-v0"
GROUNDS = ("slope", "ramps", "stairs")  # each as its scene says
SEEDS = range(20, 35)  # of the others
EPISODES = 8  # of each ground a round
WIDTH, BATCH, RATE = 128, 512, 2e-3  # of the hidden layers, samples a step, learning rate
STEPS = 4000  # of Adam a round

Array = NDArray[np.float32]


def grounds(names: list[str], number: int) -> list[dict[str, Any]]:
    """Options of the environment in a round of this number."""
    seeds = [SEEDS[(3 * number + i) % len(SEEDS)] for i in range(3)]
    return [
        {"terrain": name, "terrain_seed": seed}
        for name in names
        for seed in ([0] if name in GROUNDS else seeds)
    ]


def fit(seen: Array, wanted: Array) -> tuple[nn.Sequential, Array, Array]:
    """A network that does what the expert wanted, and mean and deviation of what it sees."""
    torch.manual_seed(0)
    mean, spread = seen.mean(axis=0), seen.std(axis=0) + np.float32(1e-3)
    layers = [nn.Linear(seen.shape[1], WIDTH), nn.Tanh(), nn.Linear(WIDTH, WIDTH), nn.Tanh()]
    network = nn.Sequential(*layers, nn.Linear(WIDTH, wanted.shape[1]))
    x, y = torch.as_tensor((seen - mean) / spread), torch.as_tensor(wanted)
    optimiser = torch.optim.Adam(network.parameters(), RATE)
    schedule = torch.optim.lr_scheduler.LinearLR(optimiser, 1.0, 0.0, STEPS)
    for _ in range(STEPS):
        rows = torch.randint(len(x), (BATCH,))
        loss = ((network(x[rows]) - y[rows]) ** 2).mean()
        optimiser.zero_grad()
        loss.backward()
        optimiser.step()
        schedule.step()
    return network, mean, spread


def save(path: Path, learnt: tuple[nn.Sequential, Array, Array], about: dict[str, Any]) -> None:
    """Writes the ONNX file, as `hurcules train` does; it cuts actions to [-1, 1]."""
    network, mean, spread = learnt
    nodes: list[Node] = []
    weights: dict[str, Any] = {}
    last = add_standard(mean, spread, nodes, weights)
    add_limits(add_layers(network, last, nodes, weights), nodes, weights)
    sizes = {"observation": len(mean)}, {"action": network[-1].out_features}
    write(path, Graph(tuple(nodes), weights, *sizes, texts_of(about)))


def main() -> None:
    """A line a ground, a policy a round."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", nargs="?", type=Path, default=Path("out/terrain"))
    parser.add_argument("--rounds", type=int, default=12)
    parser.add_argument("--grounds", nargs="+", choices=list(TERRAINS)[1:], default=list(GROUNDS))
    given = parser.parse_args()
    torch.set_num_threads(1)  # a small network: more threads only wait for each other
    batch = make_episodes(NAME, 1, 0, 1)
    about = {
        "environment": NAME,
        "options": {"terrain": given.grounds[-1]},
        "algorithm": "dagger",
        "seed": 0,
        "action_names": batch.action_names,
        "action_scale": batch.action_scale.tolist(),
        "rate": batch.environment.rate,
    }
    given.out.mkdir(parents=True, exist_ok=True)
    path, parts = given.out / "policy.onnx", []
    for number in range(given.rounds):
        act = Policy(path) if number else None
        for i, ground in enumerate(grounds(given.grounds, number)):
            file = given.out / f"{number}_{'_'.join(map(str, ground.values()))}.npz"
            if not file.exists():
                start = time.perf_counter()
                options = {"fidelity": "fast", **ground}
                shown = demonstrate(NAME, EPISODES, 100 * number + 10 * i, 0.0, act, **options)
                seen = shown.observations["observation"]
                np.savez_compressed(file, seen=seen, wanted=shown.actions)
                done, taken = int(shown.successes.sum()), time.perf_counter() - start
                print(f"{number} {ground}: {done} of {EPISODES}, {taken:.0f} s", flush=True)
            with np.load(file) as part:
                parts.append((part["seen"], part["wanted"]))
        steps = sum(len(wanted) for _, wanted in parts)
        if not path.exists() or int(Policy(path).metadata["steps"]) < steps:
            learnt = fit(*(np.concatenate(one) for one in zip(*parts, strict=True)))
            save(path, learnt, about | {"steps": steps})


if __name__ == "__main__":
    main()
