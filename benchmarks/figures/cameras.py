"""docs/cameras.png: what the robot's cameras see before, at and after the lift (Figure 4.29).

`python benchmarks/figures/cameras.py`; needs an OpenGL without a window.
"""

from pathlib import Path

import mujoco
import numpy as np
from PIL import Image, ImageDraw

import hurcules
from hurcules import cameras

POSTURES = ("ready", "acquisition", "carry")  # lifting ready, acquisition, lifting
WIDTH, HEIGHT = 320, 180  # [pixels] of each picture
GAP = 6
DOCS = Path(__file__).parents[2] / "docs"
# the pitch of the neck [rad] that looks at the person
GAZE = {"ready": 0.75, "acquisition": -0.65, "carry": 0.6}
# where the person lies: x and z [m] of the pelvis
PERSON = {"ready": (1.62, 0.11), "acquisition": (1.62, 0.11), "carry": (0.80, 1.27)}


def main() -> None:
    """Draws the sheet."""
    model = hurcules.models.load(mission="stretch")
    data = mujoco.MjData(model)
    columns = len(cameras.ROBOT_CAMERAS)
    sheet = Image.new(
        "RGB", (columns * (WIDTH + GAP) - GAP, len(POSTURES) * (HEIGHT + GAP) - GAP), "white"
    )
    for row, posture in enumerate(POSTURES):
        mujoco.mj_resetDataKeyframe(model, data, model.keyframe(posture).id)
        data.joint("NKP").qpos[0] = GAZE[posture]
        x = _casualty(model)
        data.qpos[x], data.qpos[x + 2] = PERSON[posture]
        mujoco.mj_forward(model, data)
        for column, name in enumerate(cameras.ROBOT_CAMERAS):
            pixels = cameras.picture(model, data, name, size=(2 * WIDTH, 2 * HEIGHT))
            place = (column * (WIDTH + GAP), row * (HEIGHT + GAP))
            sheet.paste(Image.fromarray(np.asarray(pixels)).resize((WIDTH, HEIGHT)), place)
            ImageDraw.Draw(sheet).text((place[0] + 6, place[1] + 4), f"{posture}: {name}", "white")
    sheet.quantize(128).save(DOCS / "cameras.png", optimize=True)


def _casualty(model: mujoco.MjModel) -> int:
    """Address of the person's x in qpos."""
    body = model.body("casualty_pelvis")
    return int(model.jnt_qposadr[body.jntadr[0]])


if __name__ == "__main__":
    main()
