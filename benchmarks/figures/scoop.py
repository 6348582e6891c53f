"""docs/scoop.jpg: the lower arms go under a person, pressing 5 N and 50 mm above the ground (K20).

`python benchmarks/figures/scoop.py`; needs an OpenGL without a window.
"""

from pathlib import Path

import mujoco
import numpy as np
from PIL import Image, ImageDraw

from hurcules.rendering import open_renderer
from hurcules_studies.thesis.measures.force_casualty import END, HIGH, START, approach

DOCS = Path(__file__).parents[2] / "docs"

SIZE = (480, 270)  # [pixels] of each picture
TIMES = (START, 7.6, END - 0.01)  # [s]
ROWS = {"pressing 5 N": None, "edges 50 mm above the ground": HIGH}
PICTURE = DOCS / "scoop.jpg"


def camera() -> mujoco.MjvCamera:
    """From the side of the legs, low."""
    view = mujoco.MjvCamera()
    view.lookat[:], view.distance = (2.02, 0.1, 0.13), 1.55
    view.azimuth, view.elevation = 68, -9
    return view


def row(text: str, height: float | None) -> np.ndarray:
    """Three moments of one approach, side by side."""
    tiles: list[np.ndarray] = []
    for robot in approach(height):
        if len(tiles) < len(TIMES) and robot.time >= TIMES[len(tiles)]:
            with open_renderer(robot.model, *SIZE) as renderer:
                renderer.update_scene(robot.data, camera())
                image = Image.fromarray(renderer.render())
            said = f"{text}, {robot.time:.1f} s"
            ImageDraw.Draw(image).text((8, SIZE[1] - 18), said, (30, 30, 30))
            tiles.append(np.asarray(image))
    return np.concatenate(tiles, axis=1)


def main() -> None:
    """Draws both rows."""
    sheet = np.concatenate([row(text, height) for text, height in ROWS.items()])
    Image.fromarray(sheet).save(PICTURE, quality=82, optimize=True)


if __name__ == "__main__":
    main()
