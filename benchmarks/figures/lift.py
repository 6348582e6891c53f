"""docs/lift.jpg, casualty.jpg, crossing.jpg, disposal.jpg: phases of these missions, each one run.

`python benchmarks/figures/lift.py [lift|casualty|crossing|disposal]`, all without a name; needs
an OpenGL without a window. `python benchmarks/figures/lift.py film` draws docs/rescue.jpg, four
pictures of the film that `hurcules run casualty` has written to out/casualty.
"""

from __future__ import annotations

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import imageio.v2 as imageio
import mujoco
import numpy as np
from PIL import Image, ImageDraw

import hurcules
from hurcules.rendering import following_camera, open_renderer

DOCS = Path(__file__).parents[2] / "docs"
SIZE = (480, 300)  # [pixels] of each picture
COLUMNS = 3
SEED, VARIATION = 1000, 1 / 3
FILM = ("under", "carry", "fold the right leg", "home")  # the ends of these phases
FILM_SIZE = (640, 360)  # [pixels] of each picture


@dataclass(frozen=True)
class Sheet:
    """What is shown of a mission: the end of each of these phases, or what is half way of it.

    What is fetched lies turned by `yaw` [rad]; the camera goes with the body `follows`, if any.
    """

    phases: tuple[str, ...]
    yaw: float = 0.0
    follows: str = ""


SHEETS = {
    "lift": Sheet(
        ("turn right", "approach", "square left", "press", "stop", "lift", "hold", "set down",
         "rest"),
        yaw=0.30,
    ),
    "casualty": Sheet(
        ("stand", "under", "lift", "raise", "sit down", "fold the right leg", "fold the left leg",
         "slide the bed out", "lay down", "arms out", "arms free", "hand over"),
        follows="casualty_pelvis",
    ),
    "crossing": Sheet(
        ("half way: cross", "carry", "arms free", "rims up", "half way: home", "hand over"),
        follows="upper_legs",
    ),
    "disposal": Sheet(
        ("approach", "turn the waist", "swing both lower legs", "stand up", "over the bars",
         "down to the bars", "squeeze", "lift", "sit down", "fold the right leg",
         "fold the left leg", "lean for the way", "over the container", "put in", "rest"),
        yaw=0.15,
        follows="upper_legs",
    ),
}  # fmt: skip


def camera(model: mujoco.MjModel, follows: str) -> mujoco.MjvCamera:
    """From the front, on the side of the legs."""
    if follows:
        return following_camera(model, follows)
    view = mujoco.MjvCamera()
    view.lookat[:], view.distance = (2.4, -0.2, 0.55), 4.2
    view.azimuth, view.elevation = 128, -16
    return view


def moments(mission: str) -> tuple[mujoco.MjModel, dict[str, np.ndarray]]:
    """The model, and qpos at the end of each phase and half way of it."""
    simulation = hurcules.Simulation(
        mission,
        SEED,
        variation=VARIATION,
        record=False,
        parameters={"yaw": SHEETS[mission].yaw},
    )
    passed: dict[str, list[np.ndarray]] = {}
    while not simulation.finished:
        simulation.step(20)
        passed.setdefault(simulation.phase, []).append(simulation.data.qpos.copy())
    halves = {f"half way: {phase}": places[len(places) // 2] for phase, places in passed.items()}
    return simulation.model, halves | {phase: places[-1] for phase, places in passed.items()}


def sheet(model: mujoco.MjModel, ends: dict[str, np.ndarray], what: Sheet) -> Image.Image:
    """The pictures, row by row."""
    view = camera(model, what.follows)
    data = mujoco.MjData(model)
    rows = -(-len(what.phases) // COLUMNS)
    image = Image.new("RGB", (SIZE[0] * COLUMNS, SIZE[1] * rows))
    with open_renderer(model, *SIZE) as renderer:
        for i, phase in enumerate(what.phases):
            data.qpos[:] = ends[phase]
            mujoco.mj_forward(model, data)
            renderer.update_scene(data, view)
            tile = Image.fromarray(renderer.render())
            ImageDraw.Draw(tile).text((10, SIZE[1] - 20), phase, (20, 20, 20))
            image.paste(tile, (i % COLUMNS * SIZE[0], i // COLUMNS * SIZE[1]))
    return image


def film_sheet(folder: Path) -> Image.Image:
    """Pictures of the film in the folder of a run."""
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    begins = [
        (event["time_s"], event["text"].removeprefix("phase "))
        for event in summary["events"]
        if event["text"].startswith("phase ")
    ]
    times = [time for time, _ in begins[1:]] + [summary["simulated_seconds"]]
    ends = dict(zip([name for _, name in begins], times, strict=True))
    image = Image.new("RGB", (2 * FILM_SIZE[0], 2 * FILM_SIZE[1]))
    with imageio.get_reader(folder / "video.mp4") as reader:
        pictures = [picture for picture in reader]
    every = summary["simulated_seconds"] / (len(pictures) - 1)
    for i, phase in enumerate(FILM):
        picture = Image.fromarray(pictures[int(ends[phase] / every)])
        tile = picture.resize(FILM_SIZE, Image.Resampling.LANCZOS)
        image.paste(tile, (i % 2 * FILM_SIZE[0], i // 2 * FILM_SIZE[1]))
    return image


def main() -> None:
    """Runs the missions and draws."""
    if sys.argv[1:] == ["film"]:
        picture = film_sheet(Path("out", "casualty"))
        picture.save(DOCS / "rescue.jpg", quality=86, optimize=True)
        return
    for mission in sys.argv[1:] or SHEETS:
        picture = sheet(*moments(mission), SHEETS[mission])
        picture.save(DOCS / f"{mission}.jpg", quality=84, optimize=True)


if __name__ == "__main__":
    main()
