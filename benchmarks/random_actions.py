"""Environments under actions without sense: what passes a limit, touches itself, the ground, falls.

Five kinds of actions, in [-1, 1]. `uniform`, `bang-bang` (ends only) and `mixed` (30, 50 or 100 %
of an end) are drawn anew every half second. `sine` gives each number a frequency of 0.1 to 2 Hz
of its own. `adversary` climbs: each quarter of a second it turns one number round, and takes that
back where the nearest parts of the robot did not come nearer.

Four layers: what the environment commands (twists of hands, forces, the drive) above the safe
levels (distances from itself and the ground, balance) and above the limits alone, and velocities
of the joints above each.

Episodes of 20 s go on side by side until so many control ticks have been taken; one that is over
begins anew.

    python benchmarks/random_actions.py [--ticks 1000000] [--names Reach Press] [--seed 0]
"""

from __future__ import annotations

import argparse
import itertools
import json
import time
from typing import Any

import gymnasium
import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
import hurcules_envs  # noqa: F401  registers

Array = NDArray[np.float64]
EPISODES, SECONDS, HOLD, TURN = 16, 20.0, 0.5, 0.25  # [s]
LAYERS: dict[str, tuple[str, dict[str, Any]]] = {
    "twists, safe levels": ("", {"safe": True}),
    "twists, limits alone": ("", {"safe": False}),
    "joints, safe levels": ("Joint", {"safe": True}),
    "joints, limits alone": ("Joint", {"safe": False}),
}
KINDS = ("uniform", "bang-bang", "mixed", "sine", "adversary")


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
        ends = self._random.choice([-1.0, 1.0], shape)
        return ends * self._random.choice([0.3, 0.5, 1.0], shape) if self._kind == "mixed" else ends

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


def grounded(env: Any) -> NDArray[np.bool_]:
    """(n,) whether an arm presses on the ground, as MuJoCo finds the contacts."""
    episodes, found = env.unwrapped._episodes, np.zeros(EPISODES, bool)
    for i, state in enumerate(episodes.batch.physics):
        model = episodes.model(i)
        data = mujoco.MjData(model)
        mujoco.mj_setState(model, data, state, mujoco.mjtState.mjSTATE_INTEGRATION)
        mujoco.mj_kinematics(model, data)
        mujoco.mj_collision(model, data)
        arms = {model.body(name).id for name in ("L_uarm", "R_uarm")}
        plane = model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE
        for one, other in data.contact.geom[data.contact.dist < 0.0]:
            if plane[one] or plane[other]:
                body = int(model.geom_bodyid[other if plane[one] else one])
                while body and body not in arms:
                    body = int(model.body_parentid[body])
                found[i] |= body > 0
    return found


def run(
    name: str, layer: str, kind: str, ticks: int, options: dict[str, Any], seed: int = 0
) -> dict[str, Any]:
    """What happened, as figures."""
    suffix, own = LAYERS[layer]
    rate = {"Drive": 10.0}.get(name, 20.0)
    env = gymnasium.make_vec(
        f"Hurcules/{name}{suffix}-v0", num_envs=EPISODES, threads=1, autoreset_mode="Disabled",
        max_episode_steps=round(SECONDS * rate), **(options | own),
    )  # fmt: skip
    batch: Any = env.unwrapped.batch
    a_step = round(1.0 / rate / batch[0].dt)
    actions = Actions(kind, EPISODES, env.single_action_space.shape[0], rate, seed=seed + 1)
    _, info = env.reset(seed=seed)
    worst = dict.fromkeys(("limit_excess", "commanded_excess", "limit_excess_velocity"), 0.0)
    near, steps, touching, pressing, falls, episodes = np.inf, 0, 0, 0, 0, EPISODES
    cost, begun = 0.0, time.perf_counter()
    while steps * a_step < ticks:
        action = actions.next(info["self_distance"])
        _, _, terminated, truncated, info = env.step(action.astype(np.float32))
        touches = info["self_contacts"] > 0
        steps += EPISODES
        touching += int(touches.sum())
        pressing += int((grounded(env) & ~touches).sum())
        near = min(near, float(info["self_distance"].min()))
        cost += float(info["cost"].sum())
        for key in worst:
            worst[key] = max(worst[key], float(info[key].max()))
        falls += int((info["ending"] == int(hurcules.Ending.Fell)).sum())
        over = terminated | truncated
        if over.any():
            episodes += int(over.sum())
            env.reset(options={"reset_mask": over})
    env.close()
    return {
        "name": name, "layer": layer, "kind": kind, "ticks": steps * a_step, "episodes": episodes,
        "commanded_mrad": 1e3 * worst["commanded_excess"],
        "measured_mrad": 1e3 * worst["limit_excess"],
        "measured_mrad_per_s": 1e3 * worst["limit_excess_velocity"],
        "nearest_m": near, "self_contact": touching / steps, "arm_contact": pressing / steps,
        "falls": falls, "cost": cost / steps, "seconds": time.perf_counter() - begun,
    }  # fmt: skip


def main() -> None:
    """A line of JSON an environment, layer and kind."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--ticks", type=int, default=1_000_000, help="of each layer and kind")
    parser.add_argument("--fidelity", default="fast")
    parser.add_argument("--names", nargs="*", default=["Reach"])
    parser.add_argument("--robot", help="of Reach")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--kinds", nargs="*", default=KINDS)
    parser.add_argument("--layers", nargs="*", default=list(LAYERS))
    given = parser.parse_args()
    options = {"fidelity": given.fidelity} | ({"robot": given.robot} if given.robot else {})
    for name, layer, kind in itertools.product(given.names, given.layers, given.kinds):
        told = run(name, layer, kind, given.ticks, options, given.seed)
        print(json.dumps(told), flush=True)


if __name__ == "__main__":
    main()
