"""docs/hurcules.png and docs/stretch.png: the stretch of the thesis, four moments and its end.

`python benchmarks/figures/stretch.py`; needs an OpenGL without a window.
"""

from pathlib import Path

import mujoco
import numpy as np
from PIL import Image

import hurcules
from hurcules.rendering import open_renderer

DOCS = Path(__file__).parents[2] / "docs"
TIMES = (2.0, 16.0, 30.0, 43.0)  # [s]: settled, on the way, hands straight out
STRIP, LARGE = (400, 240), (1200, 560)  # [pixels]
GAP = 6  # [pixels] between the four


def camera() -> mujoco.MjvCamera:
    """From the robot's right, low."""
    view = mujoco.MjvCamera()
    view.lookat[:], view.distance = (1.15, 0.0, 0.45), 3.5
    view.azimuth, view.elevation = 112, -13
    return view


def picture(simulation: hurcules.Simulation, size: tuple[int, int]) -> np.ndarray:
    """The scene as it stands."""
    with open_renderer(simulation.model, *size) as renderer:
        renderer.update_scene(simulation.data, camera())
        return renderer.render()


def main() -> None:
    """Runs the stretch once and draws both."""
    simulation = hurcules.Simulation("stretch", 0, record=False)
    gap = np.full((STRIP[1], GAP, 3), 255, dtype=np.uint8)
    tiles: list[np.ndarray] = []
    for time in TIMES:
        simulation.step(round((time - simulation.data.time) / simulation.model.opt.timestep))
        tiles += [picture(simulation, STRIP), gap]
    Image.fromarray(np.concatenate(tiles[:-1], axis=1)).save(DOCS / "stretch.png", optimize=True)
    Image.fromarray(picture(simulation, LARGE)).save(DOCS / "hurcules.png", optimize=True)


if __name__ == "__main__":
    main()
