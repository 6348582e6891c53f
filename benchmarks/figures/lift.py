"""docs/lift.jpg: the phases of the mission `lift`, a person of 75 kg who lies turned by 0.3 rad.

`python benchmarks/figures/lift.py`; needs an OpenGL without a window.
"""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np
from PIL import Image, ImageDraw

import hurcules
from hurcules.rendering import open_renderer

PICTURE = Path(__file__).parents[2] / "docs" / "lift.jpg"
SIZE = (480, 300)  # [pixels] of each picture
COLUMNS = 3
YAW, SEED, VARIATION = 0.30, 1000, 1 / 3  # a run of the success map
# the end of each of these
PHASES = (
    "turn right", "approach", "square left", "press", "stop", "lift", "hold", "set down", "rest",
)  # fmt: skip


def camera() -> mujoco.MjvCamera:
    """From the front, on the side of the legs."""
    view = mujoco.MjvCamera()
    view.lookat[:], view.distance = (2.4, -0.2, 0.55), 4.2
    view.azimuth, view.elevation = 128, -16
    return view


def moments() -> tuple[mujoco.MjModel, dict[str, np.ndarray]]:
    """The model, and qpos at the end of each phase."""
    simulation = hurcules.Simulation(
        "lift", SEED, variation=VARIATION, record=False, parameters={"yaw": YAW}
    )
    ends: dict[str, np.ndarray] = {}
    while not simulation.finished:
        simulation.step(20)
        ends[simulation.phase] = simulation.data.qpos.copy()
    return simulation.model, ends


def sheet(model: mujoco.MjModel, ends: dict[str, np.ndarray]) -> Image.Image:
    """The pictures, row by row."""
    data = mujoco.MjData(model)
    rows = -(-len(PHASES) // COLUMNS)
    image = Image.new("RGB", (SIZE[0] * COLUMNS, SIZE[1] * rows))
    with open_renderer(model, *SIZE) as renderer:
        for i, phase in enumerate(PHASES):
            data.qpos[:] = ends[phase]
            mujoco.mj_forward(model, data)
            renderer.update_scene(data, camera())
            tile = Image.fromarray(renderer.render())
            ImageDraw.Draw(tile).text((10, SIZE[1] - 20), phase, (20, 20, 20))
            image.paste(tile, (i % COLUMNS * SIZE[0], i // COLUMNS * SIZE[1]))
    return image


def main() -> None:
    """Runs the mission and draws."""
    sheet(*moments()).save(PICTURE, quality=84, optimize=True)


if __name__ == "__main__":
    main()
