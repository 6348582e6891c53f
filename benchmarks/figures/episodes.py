"""Draws docs/episodes.jpg: Stretch-v1, Rescue-v0 and Dispose-v0 under their experts.

Run:  python benchmarks/figures/episodes.py
"""

from __future__ import annotations

from pathlib import Path

import gymnasium
import imageio.v3 as imageio
import numpy as np
from numpy.typing import NDArray

import hurcules_envs  # noqa: F401  registers

DOCS = Path(__file__).resolve().parents[2] / "docs"
# by id: steps after which a picture is taken
SHOWN = {
    "Hurcules/Stretch-v1": (0, 110),
    "Hurcules/Rescue-v0": (90, 400, 560, 830),
    "Hurcules/Dispose-v0": (60, 1950, 3900, 4500),
}
SEED = 3


def pictures(name: str, steps: tuple[int, ...]) -> list[NDArray[np.uint8]]:
    """(368, 640, 3) each."""
    env = gymnasium.make(name, fidelity="fast", render_mode="rgb_array").unwrapped
    env.reset(seed=SEED)
    found = []
    for step in range(steps[-1] + 1):
        if step in steps:
            found.append(env.render())
        *_, over, _, _ = env.step(env.environment.expert(env.numbers)[0].astype(np.float32))
        if over:
            break
    if len(found) < len(steps):
        found.append(env.render())
    env.close()
    return found


def main() -> None:
    """Five rows of two."""
    all_of_them = [one for name, steps in SHOWN.items() for one in pictures(name, steps)]
    rows = [np.concatenate(all_of_them[i : i + 2], axis=1) for i in range(0, len(all_of_them), 2)]
    sheet = np.concatenate(rows, axis=0)
    half = sheet.reshape(len(sheet) // 2, 2, -1, 2, 3).mean(axis=(1, 3))  # smooth
    imageio.imwrite(DOCS / "episodes.jpg", half.round().astype(np.uint8), quality=85)


if __name__ == "__main__":
    main()
