"""PPO in one file: two hands learn to reach without physics, and are judged in it.

All that proximal policy optimisation is (Schulman et al., 2017) stands below, in the manner of
CleanRL: read it, change it. Episodes run side by side as a native vector; the network becomes an
ONNX file for `hurcules evaluate` and `hurcules run --policy`. Takes about two minutes of a core.

Run:  python python/examples/22_ppo_in_one_file.py [--steps 80000] [--seed 0]
"""

import argparse
import json
import sys
from pathlib import Path

import gymnasium
import numpy as np

from hurcules_envs.evaluation import evaluate
from hurcules_envs.onnx_file import Graph, Node, write

try:
    import torch
    from torch import nn
except ImportError:
    print("this example needs PyTorch:", "    pip install torch", "", sep="\n")
    print("then run it again", "    python " + sys.argv[0], sep="\n")
    sys.exit(0)
from hurcules_envs.torch_layers import add_layers, add_limits

NAME, OPTIONS = "Hurcules/Reach-v0", {"flat": True}
EPISODES, HORIZON, EPOCHS, BATCH = 16, 32, 10, 128  # side by side, steps an update, ...
RATE, GAMMA, LAMBDA, CLIP = 2e-3, 0.9, 0.9, 0.2  # an action is rewarded at once: a low gamma


def network(inputs, outputs, gain):
    """Two hidden layers; the last one begins small."""
    last = nn.Linear(64, outputs)
    layers = [nn.Linear(inputs, 64), nn.Tanh(), nn.Linear(64, 64), nn.Tanh(), last]
    for layer, scale in zip(layers[::2], (2**0.5, 2**0.5, gain), strict=True):
        nn.init.orthogonal_(layer.weight, scale)
        nn.init.zeros_(layer.bias)
    return nn.Sequential(*layers)


def main() -> None:
    """Learns, writes, judges."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--steps", type=int, default=80_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--judge", type=int, default=100, help="episodes in each fidelity")
    parser.add_argument("--out", type=Path, default=Path("out/ppo"))
    given = parser.parse_args()
    torch.manual_seed(given.seed)
    torch.set_num_threads(1)  # a small network: more threads only wait for each other
    options = OPTIONS | {"fidelity": "kinematic", "autoreset_mode": "SameStep"}
    vector = gymnasium.make_vec(NAME, EPISODES, **options)
    seen, _ = vector.reset(seed=given.seed)
    size, k = seen.shape[1], vector.single_action_space.shape[0]
    actor, critic, spread = network(size, k, 0.01), network(size, 1, 1.0), torch.zeros(k)
    weights = [*actor.parameters(), *critic.parameters(), spread.requires_grad_()]
    adam = torch.optim.Adam(weights, RATE, eps=1e-5)
    factors = np.zeros(size, np.float32)
    factors[-vector.environment.goal :] = 3.0  # what is seen: the way to the goals
    means, shape = [], (HORIZON, EPISODES)
    updates = max(given.steps // (HORIZON * EPISODES), 1)
    drawn = lambda x: torch.distributions.Normal(actor(x), spread.exp())  # noqa: E731
    for update in range(updates):
        x, a, p = torch.zeros(*shape, size), torch.zeros(*shape, k), torch.zeros(shape)
        value, reward, going = torch.zeros(HORIZON + 1, EPISODES), torch.zeros(shape), []
        with torch.no_grad():
            for t in range(HORIZON):
                x[t] = torch.as_tensor(seen * factors)
                a[t], value[t] = drawn(x[t]).sample(), critic(x[t])[:, 0]
                p[t] = drawn(x[t]).log_prob(a[t]).sum(-1)
                seen, gain, failed, cut, info = vector.step(a[t].clamp(-1.0, 1.0).numpy())
                reward[t], over = torch.as_tensor(gain), failed | cut
                for i in np.flatnonzero(cut & ~failed):  # would have gone on
                    last = torch.as_tensor(info["final_obs"][i] * factors)
                    reward[t, i] += GAMMA * critic(last)[0]
                going.append(torch.as_tensor(~over).float())
            value[-1] = critic(torch.as_tensor(seen * factors))[:, 0]
            ahead, sums = torch.zeros(EPISODES), torch.zeros(shape)  # generalised advantage
            for t in reversed(range(HORIZON)):
                delta = reward[t] + GAMMA * going[t] * value[t + 1] - value[t]
                sums[t] = ahead = delta + GAMMA * LAMBDA * going[t] * ahead
        means.append(reward.mean())
        wanted = sums + value[:-1]
        x, a, p, sums, wanted = (one.flatten(0, 1) for one in (x, a, p, sums, wanted))
        adam.param_groups[0]["lr"] = RATE * (1.0 - update / updates)
        for _ in range(EPOCHS):
            for rows in torch.randperm(len(x)).split(BATCH):
                ratio = (drawn(x[rows]).log_prob(a[rows]).sum(-1) - p[rows]).exp()
                better = (sums[rows] - sums[rows].mean()) / (sums[rows].std() + 1e-8)
                gained = torch.min(ratio * better, ratio.clamp(1.0 - CLIP, 1.0 + CLIP) * better)
                missed = (critic(x[rows])[:, 0] - wanted[rows]) ** 2
                adam.zero_grad()
                (0.5 * missed.mean() - gained.mean()).backward()
                nn.utils.clip_grad_norm_(weights, 0.5)
                adam.step()
        if (update + 1) % 20 == 0 or update + 1 == updates:
            steps, mean = (update + 1) * len(x), np.mean(means[-20:])
            print(f"{steps:6} steps: reward {mean:5.2f} a step", flush=True)

    nodes, stored = [Node("Mul", ("observation", "factors"), ("x",))], {"factors": factors}
    add_limits(add_layers(actor, "x", nodes, stored), nodes, stored)
    about = {"environment": NAME, "options": json.dumps(OPTIONS)}
    given.out.mkdir(parents=True, exist_ok=True)
    path = given.out / "policy.onnx"
    write(path, Graph(tuple(nodes), stored, {"observation": size}, {"action": k}, about))
    for fidelity in ("kinematic", "exact"):
        result = evaluate(path, NAME, given.judge, fidelity=fidelity, **OPTIONS)
        interval = f"{result.low:.0%} to {result.high:.0%}"
        print(f"{fidelity}: {result.success:.0%} succeed ({interval}), {given.judge} episodes")
    print(path)


if __name__ == "__main__":
    main()
