"""How far apart the hands' paths of the fidelities are under the same commands.

Reach, the same starts and the same actions in `exact`, `fast` and `kinematic`: `uniform` and
`bang-bang` (ends only) are drawn anew every half second, `sine` gives each number a frequency of
0.1 to 2 Hz of its own. Compared are the measured hands after each step of the policy (20 Hz), then
their references, which tell how much of it is the plan's, then the hands again without the shift in
time that explains most.

    python benchmarks/deviation.py [--episodes 8] [--seconds 3] [--robots rescue manipulation]
"""

from __future__ import annotations

import argparse
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray
from random_actions import KINDS, Actions

import hurcules_envs  # noqa: F401  registers

Array = NDArray[np.float64]
RATE = 20.0  # [Hz]


def paths(kind: str, fidelity: str, episodes: int, seconds: float, **options: Any) -> Array:
    """(2, t, n, h, 3) [m] hands and their references; NaN after a fall."""
    env = gymnasium.make_vec(
        "Hurcules/Reach-v0", num_envs=episodes, autoreset_mode="Disabled",
        max_episode_steps=10**6, fidelity=fidelity, **options,
    )  # fmt: skip
    seen, info = env.reset(seed=0)
    actions = Actions(kind, *env.action_space.shape, RATE, seed=1)
    found, fallen = [], np.zeros(episodes, dtype=bool)
    for _ in range(round(RATE * seconds)):
        action = actions.next(info["self_distance"]) * ~fallen[:, None]
        seen, _, failed, _, info = env.step(action.astype(np.float32))
        fallen |= failed
        if failed.any():
            env.reset(options={"reset_mask": failed})
        hands = seen["achieved_goal"].astype(float)
        both = np.stack([hands, hands + seen["observation"][:, -hands.shape[1] :]])
        found.append(np.where(fallen[:, None], np.nan, both))
    env.close()
    return np.stack(found, axis=1).reshape(2, len(found), episodes, -1, 3)


def main() -> None:
    """A row of a table for each robot, kind and fidelity."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--episodes", type=int, default=8)
    parser.add_argument("--seconds", type=float, default=3.0)
    parser.add_argument("--robots", nargs="*", default=["rescue", "manipulation"])
    given = parser.parse_args()
    print(
        "| robot, commands | beside `exact` | hands: median, 95 %, largest [mm] | references |",
        end="",
    )
    print(" earlier by [ms] | hands without that |")
    print("|---|---|---|---|---|---|")
    for robot in given.robots:
        for kind in KINDS[:3]:
            exact, *others = (
                paths(kind, fidelity, given.episodes, given.seconds, robot=robot)
                for fidelity in ("exact", "fast", "kinematic")
            )
            for fidelity, other in zip(("fast", "kinematic"), others, strict=True):
                apart = other - exact
                speed = np.gradient(exact[0], 1.0 / RATE, axis=0)
                square = (speed**2).sum(axis=-1)
                early = np.nanmedian(((apart[0] * speed).sum(axis=-1) / square)[square > 0.01])
                row = (f"{robot}, {kind}", f"`{fidelity}`", said(apart[0]), said(apart[1]))
                row += (f"{1e3 * early:.1f}", said(apart[0] - early * speed))
                print("| " + " | ".join(row) + " |", flush=True)


def said(apart: Array) -> str:
    """Median, 95 % and largest distance [mm]."""
    far = 1e3 * np.linalg.norm(apart, axis=-1)
    return ", ".join(f"{one:.1f}" for one in np.nanpercentile(far, (50, 95, 100)))


if __name__ == "__main__":
    main()
