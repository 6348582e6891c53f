"""Imitation in one file: a network learns to turn a valve from its scripted expert.

The expert acts in the physics while noise pushes its actions about (Laskey et al., DART, 2017): so
the network sees how mistakes are mended. What is learnt is what the expert wanted to do. A network
of two layers learns it by Adam, written in numpy, and becomes an ONNX file for `hurcules evaluate`
and `hurcules run --policy`. Takes about three minutes on two cores.

Run:  python python/examples/12_behaviour_cloning.py [Door-v0 or own:Own/Name-v0] [--episodes 100]
"""

import argparse
from pathlib import Path

import numpy as np

from hurcules_envs.evaluation import evaluate
from hurcules_envs.imitation import demonstrate
from hurcules_envs.onnx_file import Graph, Node, write
from hurcules_envs.policy import Policy
from hurcules_envs.registry import fidelities_of, full_id

WIDTH, BATCH, RATE = 128, 256, 2e-3  # of the hidden layers, samples a step, learning rate


def clone(x, y, epochs, generator):
    """Weights and biases of a network with two hidden layers, by Adam on the squared error."""
    sizes = [x.shape[1], WIDTH, WIDTH, y.shape[1]]
    layers = []
    for rows, columns in zip(sizes[1:], sizes[:-1], strict=True):
        layers += [generator.normal(0.0, columns**-0.5, (rows, columns)), np.zeros(rows)]
    moments = [(np.zeros_like(one), np.zeros_like(one)) for one in layers]
    total, step = epochs * (len(x) // BATCH + 1), 0
    for _ in range(epochs):
        for batch in np.array_split(generator.permutation(len(x)), len(x) // BATCH + 1):
            outputs = [x[batch]]
            for i in range(3):  # forward
                value = outputs[-1] @ layers[2 * i].T + layers[2 * i + 1]
                outputs.append(np.tanh(value))
            error = (outputs[-1] - y[batch]) * (1.0 - outputs[-1] ** 2) / len(batch)
            gradients = []
            for i in (2, 1, 0):  # and back
                gradients = [error.T @ outputs[i], error.sum(axis=0), *gradients]
                error = (error @ layers[2 * i]) * (1.0 - outputs[i] ** 2)
            step += 1
            rate = RATE * (1.0 - step / total)
            for one, gradient, (mean, square) in zip(layers, gradients, moments, strict=True):
                mean += 0.1 * (gradient - mean)
                square += 0.001 * (gradient**2 - square)
                size = np.sqrt(square / (1.0 - 0.999**step)) + 1e-8
                one -= rate * mean / (1.0 - 0.9**step) / size
    return layers


def main() -> None:
    """Demonstrates, clones, writes, judges."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("environment", nargs="?", default="Valve-v0")
    parser.add_argument("--episodes", type=int, default=100)
    parser.add_argument("--epochs", type=int, default=200)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--fidelity", default="fast")
    parser.add_argument("--noise", type=float, default=0.3, help="standard deviation of the pushes")
    parser.add_argument("--judge", type=int, default=50, help="episodes in each fidelity")
    parser.add_argument("--out", type=Path, default=Path("out/clone"))
    given = parser.parse_args()
    name = full_id(given.environment)
    known = fidelities_of(name)  # none, where an environment of one's own has no such keyword
    options = {"fidelity": given.fidelity} if known else {}
    shown = demonstrate(name, given.episodes, given.seed, given.noise, **options)
    seen, wanted = shown.observations, shown.actions
    print(f"{given.episodes} demonstrations, {shown.successes.sum()} succeeded, {len(seen)} steps")
    mean, scale = seen.mean(axis=0), seen.std(axis=0) + 1e-3
    generator = np.random.default_rng(given.seed)
    layers = clone((seen - mean) / scale, wanted, given.epochs, generator)

    nodes = [Node("Sub", ("observation", "mean"), ("x",)), Node("Div", ("x", "scale"), ("y0",))]
    weights = {"mean": mean, "scale": scale}
    for i in range(3):
        weights |= {f"w{i}": layers[2 * i], f"b{i}": layers[2 * i + 1]}
        nodes.append(Node("Gemm", (f"y{i}", f"w{i}", f"b{i}"), (f"z{i}",), {"transB": 1}))
        nodes.append(Node("Tanh", (f"z{i}",), (f"y{i + 1}" if i < 2 else "action",)))
    sizes = {"observation": seen.shape[1]}, {"action": wanted.shape[1]}
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / f"{name.split('/')[-1]}.onnx"
    write(path, Graph(tuple(nodes), weights, *sizes, {"environment": name}))
    policy = Policy(path)
    print(f"error of the clone: {np.sqrt(np.mean((policy(seen) - wanted) ** 2)):.3f} (rms)")
    for options in [{"fidelity": one} for one in ("fast", "exact") if one in known] or [{}]:
        result = evaluate(policy, name, given.judge, **options)
        interval = f"{result.low:.0%} to {result.high:.0%}"
        where = options.get("fidelity", name)
        print(f"{where}: {result.success:.0%} succeed ({interval}), {given.judge} episodes")
    print(path)


if __name__ == "__main__":
    main()
