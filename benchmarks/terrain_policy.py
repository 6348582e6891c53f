"""A policy for terrain learns from Drive's expert, by DAgger.

Run:  python benchmarks/terrain_policy.py [OUT] [--rounds 5] [--grounds slope ramps ...]

In each round the policy as it is drives some episodes, the expert says what it would have done in
each step, and a network learns all that was ever said (Ross, Gordon and Bagnell, 2011), what the
expert says of steps that were altered a little, and the mirror image of both. In the first round
the expert drives. Each round has other grounds, drawn by the seeds 100 to 399. OUT has policy.onnx,
and what was said, from which a run that was stopped goes on.
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

from hurcules_envs.climbing import ASIDE
from hurcules_envs.drive import CLIMBED, Drive
from hurcules_envs.imitation import demonstrate
from hurcules_envs.onnx_file import Graph, Node, texts_of, write
from hurcules_envs.policy import Policy
from hurcules_envs.registry import make_episodes
from hurcules_envs.terrain import AHEAD, BESIDE
from hurcules_envs.torch_layers import add_layers, add_limits, add_standard

NAME = "Hurcules/Drive-v0"
GROUNDS = {  # how many a round
    "flat": 1, "slope": 3, "ramps": 5, "stairs": 4, "step_field": 12, "rough_road": 1, "gravel": 1,
    "sand": 1,
}  # fmt: skip
SEEDS = range(100, 400)  # of them
EPISODES = 2  # of each ground
# by group of the observation what changes its sign in the mirror, the robot's plane of x and z:
# y and sine of the goal, velocity to the left, spin about x and z, the vertical to the left, aside
SIDEWAYS = {"goal": (1, 3), "velocity": (1,), "spin": (0, 2), "up": (1,), "aside": (0,)}
FIRST = 20_000  # seed of the first episode; those that judge begin at 10,000
WIDTH, BATCH, RATE = 128, 512, 2e-3  # of the hidden layers, samples a step, learning rate
STEPS, LAST = 4000, 12_000  # of Adam a round; of the last one

Array = NDArray[np.float32]
Said = tuple[str, Array, Array]  # terrain, observations, actions of the expert


def grounds(names: list[str], number: int) -> list[dict[str, Any]]:
    """Options of the environment in a round of this number."""
    return [
        {"terrain": name, "blind": False}
        | ({} if name == "flat" else {"terrain_seed": SEEDS[(number * n + i) % len(SEEDS)]})
        for name, n in GROUNDS.items()
        if name in names
        for i in range(n)
    ]


def mirrored(seen: Array, wanted: Array, environment: Drive) -> tuple[Array, Array]:
    """Observations and actions where left is right."""
    other, turned = seen.copy(), wanted.copy()
    parts = environment.groups_of(other)
    for name, places in SIDEWAYS.items():
        parts[name][:, places] *= -1.0
    lines = parts["ground"].reshape(-1, len(AHEAD), len(BESIDE))
    parts["ground"][:] = lines[:, :, ::-1].reshape(parts["ground"].shape)
    turned[:, 1] *= -1.0
    return other, turned


def imagined(
    seen: Array, environment: Drive, generator: np.random.Generator
) -> tuple[Array, Array]:
    """Observations that might have been, and what the expert does there.

    What its law does not use is of another step, so that nothing is learnt from it.
    """
    other = seen.copy()
    parts = environment.groups_of(other)

    def normal(deviation: float, *shape: int) -> Array:
        return generator.normal(0.0, deviation, (len(seen), *shape)).astype(np.float32)

    goal, turn = parts["goal"], normal(0.15)
    goal[:, :2] += normal(0.1, 2)
    turn += np.arctan2(goal[:, 3], goal[:, 2])
    goal[:, 2], goal[:, 3] = np.cos(turn), np.sin(turn)
    for name in ("velocity", "spin", "margin"):
        parts[name][:] = generator.permutation(parts[name])
    parts["up"][:, :2] += normal(0.08, 2)
    parts["up"] /= np.linalg.norm(parts["up"], axis=1, keepdims=True)
    parts["ground"] += normal(0.03, 1) + normal(0.05, 1) * np.repeat(AHEAD, len(BESIDE))
    if environment.terrain in CLIMBED:
        parts["legs"] += normal(0.15, 1)
        phase = generator.integers(0, 4, len(seen))
        parts["held"][:] = phase[:, None] > np.arange(3)
        parts["aside"][:] = generator.choice([-ASIDE, 0.0, ASIDE], (len(seen), 1))
    wanted = environment.law({name: part.astype(float) for name, part in parts.items()})
    return other, wanted.astype(np.float32)


def fit(seen: Array, wanted: Array, steps: int) -> tuple[nn.Sequential, Array, Array]:
    """A network that does what the expert wanted, and mean and deviation of what it sees."""
    torch.set_num_threads(1)  # a small network: more threads only wait for each other
    torch.manual_seed(0)
    mean, spread = seen.mean(axis=0), seen.std(axis=0) + np.float32(1e-3)
    layers = [nn.Linear(seen.shape[1], WIDTH), nn.Tanh(), nn.Linear(WIDTH, WIDTH), nn.Tanh()]
    network = nn.Sequential(*layers, nn.Linear(WIDTH, wanted.shape[1]))
    x, y = torch.as_tensor((seen - mean) / spread), torch.as_tensor(wanted)
    optimiser = torch.optim.Adam(network.parameters(), RATE)
    schedule = torch.optim.lr_scheduler.LinearLR(optimiser, 1.0, 0.0, steps)
    for _ in range(steps):
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
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--grounds", nargs="+", choices=list(GROUNDS), default=list(GROUNDS))
    given = parser.parse_args()
    batch = make_episodes(NAME, 1, 0, 1)
    about = {
        "environment": NAME,
        "options": {"terrain": "stairs", "blind": False},
        "algorithm": "dagger",
        "seed": 0,
        "action_names": batch.action_names,
        "action_scale": batch.action_scale.tolist(),
        "rate": batch.environment.rate,
    }
    given.out.mkdir(parents=True, exist_ok=True)
    path, said = given.out / "policy.onnx", []
    for number in range(given.rounds):
        said += hear(given.out, number, given.grounds, Policy(path) if number else None)
        steps = sum(len(wanted) for *_, wanted in said)
        last = number == given.rounds - 1
        if last or not path.exists() or int(Policy(path).metadata["steps"]) < steps:
            save(path, fit(*more(said), LAST if last else STEPS), about | {"steps": steps})


def hear(out: Path, number: int, names: list[str], act: Policy | None) -> list[Said]:
    """What the expert says in a round, a line a ground."""
    said = []
    for i, ground in enumerate(grounds(names, number)):
        name = ground["terrain"]
        file = out / f"{number}_{name}_{ground.get('terrain_seed', 0)}.npz"
        if not file.exists():
            start, seed = time.process_time(), FIRST + 1000 * number + 10 * i
            options = {"fidelity": "fast", **ground}
            shown = demonstrate(NAME, EPISODES, seed, 0.0, act, **options)
            seen = shown.observations["observation"]
            np.savez_compressed(file, seen=seen, wanted=shown.actions)
            done, taken = int(shown.successes.sum()), time.process_time() - start
            print(f"{file.stem}: {done} of {EPISODES}, {taken:.0f} s", flush=True)
        with np.load(file) as part:
            said.append((name, part["seen"], part["wanted"]))
    return said


def more(said: list[Said]) -> tuple[Array, Array]:
    """All that was said, as often again of steps that were altered, and the mirror image."""
    generator = np.random.default_rng(0)
    drives = {name: Drive("fast", name, blind=False) for name in {name for name, *_ in said}}
    parts = [(seen, wanted) for _, seen, wanted in said]
    parts += [imagined(seen, drives[name], generator) for name, seen, _ in said]
    any_of_them = drives[said[0][0]]  # all have the same groups
    parts += [mirrored(*part, any_of_them) for part in parts]
    seen, wanted = (np.concatenate(one) for one in zip(*parts, strict=True))
    return seen, wanted


if __name__ == "__main__":
    main()
