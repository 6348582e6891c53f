"""Reach under actions without sense: what passes a limit, touches itself, the ground, or falls.

Four kinds of actions, in [-1, 1]: `uniform` and `bang-bang` (ends only) are drawn anew every half
second, `sine` gives each number a frequency of 0.1 to 2 Hz of its own, `adversary` climbs: each
quarter of a second it turns one number round, and takes that back where the nearest parts of the
robot did not come nearer. Three layers: twists of the hands above the safe levels (distances from
itself and the ground, balance), twists above the limits alone, and velocities of the joints above
the safe levels.

Episodes of 20 s go on side by side until so many control ticks have been taken; one that falls
begins anew.

    python benchmarks/random_actions.py [--ticks 1000000] [--robot rescue] [--seed 0]
"""

from __future__ import annotations

import argparse
import json
import time
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

import hurcules_envs  # noqa: F401  registers

Array = NDArray[np.float64]
EPISODES, SECONDS, HOLD, TURN = 16, 20.0, 0.5, 0.25  # [s]
LAYERS: dict[str, tuple[str, dict[str, Any]]] = {
    "twists, safe levels": ("Hurcules/Reach-v0", {}),
    "twists, limits alone": ("Hurcules/Reach-v0", {"safe": False}),
    "joints, safe levels": ("Hurcules/ReachJoint-v0", {}),
    "joints, limits alone": ("Hurcules/ReachJoint-v0", {"safe": False}),
}
KINDS = ("uniform", "bang-bang", "sine", "adversary")


class Actions:
    """Actions of a kind for n episodes of k numbers, a step after the other."""

    def __init__(self, kind: str, n: int, k: int, rate: float, seed: int) -> None:
        self._kind, self._rate, self._random = kind, rate, np.random.default_rng(seed)
        self._now = self._drawn((n, k))
        self._frequency = self._random.uniform(0.1, 2.0, (n, k))
        self._phase = self._random.uniform(-np.pi, np.pi, (n, k))
        self._turned = np.full(n, -1)
        self._nearest = np.full(n, np.inf)
        self._step = 0

    def _drawn(self, shape: tuple[int, ...]) -> Array:
        if self._kind == "uniform":
            return self._random.uniform(-1.0, 1.0, shape)
        return self._random.choice([-1.0, 1.0], shape)

    def next(self, nearest: Array) -> Array:
        """The actions of the next step; `nearest` (n,) [m] parts of each robot now."""
        step, self._step = self._step, self._step + 1
        if self._kind == "sine":
            return np.sin(2 * np.pi * self._frequency * step / self._rate + self._phase)
        if self._kind == "adversary":
            if step % round(TURN * self._rate) == 0:
                self._climb(nearest)
        elif step % round(HOLD * self._rate) == 0:
            self._now = self._drawn(self._now.shape)
        return self._now

    def _climb(self, nearest: Array) -> None:
        worse = (nearest >= self._nearest) & (self._turned >= 0)
        rows = np.flatnonzero(worse)
        self._now[rows, self._turned[rows]] *= -1.0
        self._nearest = nearest.copy()
        self._turned = self._random.integers(self._now.shape[1], size=len(nearest))
        self._now[np.arange(len(nearest)), self._turned] *= -1.0


def run(
    layer: str, kind: str, ticks: int, options: dict[str, Any], seed: int = 0
) -> dict[str, Any]:
    """What happened, as figures."""
    name, own = LAYERS[layer]
    env = gymnasium.make_vec(
        name, num_envs=EPISODES, threads=1, max_episode_steps=round(20.0 * SECONDS),
        autoreset_mode="Disabled", **(options | own),
    )  # fmt: skip

    batch: Any = env.unwrapped.batch
    a_step = round(0.05 / batch[0].dt)
    from hurcules import Quantities

    arms = Quantities(batch[0], ["contact_force/L_uarm", "contact_force/R_uarm"])
    actions = Actions(kind, EPISODES, env.single_action_space.shape[0], 20.0, seed=seed + 1)
    _, info = env.reset(seed=seed)
    worst = dict.fromkeys(("limit_excess", "commanded_excess", "limit_excess_velocity"), 0.0)
    near, steps, touching, pressing, falls, episodes = np.inf, 0, 0, 0, 0, EPISODES
    begun = time.perf_counter()
    while steps * a_step < ticks:
        action = actions.next(info["self_distance"])
        _, _, terminated, truncated, info = env.step(action.astype(np.float32))
        touches = info["self_contacts"] > 0
        steps += EPISODES
        touching += int(touches.sum())
        pressing += int(((batch.read(arms) > 1.0).any(axis=1) & ~touches).sum())
        near = min(near, float(info["self_distance"].min()))
        for key in worst:
            worst[key] = max(worst[key], float(info[key].max()))
        falls += int(terminated.sum())
        over = terminated | truncated
        if over.any():
            episodes += int(over.sum())
            env.reset(options={"reset_mask": over})
    env.close()
    return {
        "layer": layer, "kind": kind, "ticks": steps * a_step, "episodes": episodes,
        "commanded_mrad": 1e3 * worst["commanded_excess"],
        "measured_mrad": 1e3 * worst["limit_excess"],
        "measured_mrad_per_s": 1e3 * worst["limit_excess_velocity"],
        "nearest_m": near, "self_contact": touching / steps, "arm_contact": pressing / steps,
        "falls": falls, "seconds": time.perf_counter() - begun,
    }  # fmt: skip


def main() -> None:
    """A line of JSON a layer and kind."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--ticks", type=int, default=1_000_000, help="of each layer and kind")
    parser.add_argument("--fidelity", default="fast")
    parser.add_argument("--robot", default="rescue")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="*", default=KINDS)
    parser.add_argument("--layers", nargs="*", default=list(LAYERS))
    given = parser.parse_args()
    options = {"fidelity": given.fidelity, "robot": given.robot}
    for layer in given.layers:
        for kind in given.kinds:
            print(json.dumps(run(layer, kind, given.ticks, options, given.seed)), flush=True)


if __name__ == "__main__":
    main()
