"""Draws docs/field_tests/stairs.png and docs/field_tests/hurdle.png: the robot as it climbs.

Run:  python benchmarks/figures/climbing.py    some minutes; needs an OpenGL without a window
"""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from PIL import Image

from hurcules.rendering import open_renderer
from hurcules.running_gear import RunningGear
from hurcules_studies import field_tests

DOCS = Path(__file__).parents[2] / "docs"

FOLDER = DOCS / "field_tests"
SIZE = (400, 260)
COLUMNS = 4
SAME = field_tests.Variation(friction=(1.0, 1.0), payload=0.0, offset=0.0, yaw=0.0)
# method: setting, moments [s]
FILMS = {
    "e2804": ("stairs", math.radians(35), (4.7, 6.5, 8.5, 11.0, 13.2, 14.4, 19.0, 22.0)),
    "e2802": ("hurdle", 0.35, (4.5, 6.5, 8.0, 9.2, 9.7, 11.0, 13.0, 19.0)),
}


def main() -> None:
    """Runs each method once and draws its moments."""
    for name, (picture, setting, moments) in FILMS.items():
        states: list[tuple[float, Any]] = []
        models: list[mujoco.MjModel] = []

        def watch(model: mujoco.MjModel, qpos: Any, time: float) -> None:
            models[:] = [model]  # noqa: B023  # called within this turn
            if not states or time - states[-1][0] > 0.05:  # noqa: B023
                states.append((time, qpos.copy()))  # noqa: B023

        field_tests.repeat(
            field_tests.method(name), setting, "rescue", seed=0, variation=SAME, watch=watch
        )
        draw(models[0], states, moments).save(FOLDER / f"{picture}.png", optimize=True)


def draw(
    model: mujoco.MjModel, states: list[tuple[float, Any]], moments: tuple[float, ...]
) -> Image.Image:
    """The states nearest to the moments, side by side."""
    width, height = SIZE
    rows = -(-len(moments) // COLUMNS)
    sheet = Image.new("RGB", (COLUMNS * width, rows * height))
    data, gear = mujoco.MjData(model), RunningGear(model)
    camera = mujoco.MjvCamera()
    camera.distance, camera.azimuth, camera.elevation = 3.6, 90, -6
    with open_renderer(model, width, height) as renderer:
        for i, moment in enumerate(moments):
            data.qpos[:] = min(states, key=lambda state: abs(state[0] - moment))[1]
            mujoco.mj_forward(model, data)
            middle = data.subtree_com[model.body("upper_legs").id]
            camera.lookat[:] = middle[0], 0.0, middle[2] + 0.1
            renderer.update_scene(data, camera)
            gear.show(data, renderer.scene)
            place = (i % COLUMNS * width, i // COLUMNS * height)
            sheet.paste(Image.fromarray(np.asarray(renderer.render())), place)
    return sheet.quantize(128)


if __name__ == "__main__":
    main()
