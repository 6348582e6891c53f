"""Draws docs/gallery/*.jpg, both robots from four sides, and models/assets/*.png.

The gallery: each keyframe, bed, tracks, contacts. The other four stand in models/README.md.

Run:  python benchmarks/figures/gallery.py [NAME ...]    a minute; needs an OpenGL without a window
"""

import sys
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image, ImageDraw

import hurcules
from hurcules import models, transfer_bed
from hurcules.rendering import open_renderer

DOCS = Path(__file__).parents[2] / "docs"

PAGE = DOCS / "gallery.md"
FOLDER = PAGE.with_suffix("")
SIZE = (400, 400)
SIDES = {"front": 180, "left": -90, "rear": 0, "right": 90}  # azimuth of the view [degrees]
HEIGHT = {"drive": 0.80, "ready": 0.92, "carry": 0.92}  # [m] that the cameras look at
CONTACTS = 3  # geom group
ASSETS = Path(__file__).parents[2] / "models" / "assets"
ONE = (800, 500)  # [pixels] of a picture of models/README.md

HEAD = """# The robots in pictures

From four sides in each keyframe; drawn by `python benchmarks/figures/gallery.py`. What the parts
are, and which numbers are assumptions: [models/README.md](../models/README.md).
"""


def tile(renderer, data, camera, text="", option=None):
    """One picture with a word in its corner."""
    renderer.update_scene(data, camera, option)
    image = Image.fromarray(renderer.render())
    ImageDraw.Draw(image).text((10, 8), text, fill=(30, 30, 30))
    return np.asarray(image)


def look(at, distance, azimuth, elevation=-10.0):
    """A camera."""
    camera = mujoco.MjvCamera()
    camera.lookat[:], camera.distance = at, distance
    camera.azimuth, camera.elevation = azimuth, elevation
    return camera


def posed(robot, key, bed=None):
    """A robot in a keyframe; `bed`: lift and slide [m]."""
    model = models.load(robot)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    if bed:
        data.joint("bed_lift").qpos[0] = bed[0]
        for joint in (f"{side}_bed_{i}" for side in "LR" for i in (1, 2)):
            data.joint(joint).qpos[0] = bed[1]
    mujoco.mj_forward(model, data)
    return model, data


def middle(model, data):
    """Centre of the box around the robot's contact geoms [m]."""
    mine = [g for g in range(model.ngeom) if model.geom_bodyid[g] and model.geom_contype[g]]
    places = data.geom_xpos[mine]
    return (places.min(axis=0) + places.max(axis=0)) / 2


def four_sides(robot, key):
    """The robot from four sides, and its contact geoms."""
    model, data = posed(robot, key)
    at = middle(model, data)
    at[2] = HEIGHT.get(key, 0.70)
    with open_renderer(model, *SIZE) as renderer:
        return np.concatenate(
            [tile(renderer, data, look(at, 3.1, turn, -8), side) for side, turn in SIDES.items()],
            axis=1,
        )


def contacts():
    """Contact geoms of both robots, ready."""
    option = mujoco.MjvOption()
    option.geomgroup[:] = 0
    option.geomgroup[[0, CONTACTS]] = 1
    tiles = []
    for robot in ("rescue", "manipulation"):
        model, data = posed(robot, "ready")
        with open_renderer(model, 2 * SIZE[0], SIZE[1]) as renderer:
            camera = look((0.3, 0, 0.9), 3.5, 130)
            tiles.append(tile(renderer, data, camera, robot, option))
    return np.concatenate(tiles, axis=1)


def bed():
    """The bed stowed, raised and out."""
    tiles = []
    for text, state in (
        ("stowed", (0.0, 0.0)),
        ("raised", (transfer_bed.LIFT, 0.0)),
        ("out", (transfer_bed.LIFT, transfer_bed.SLIDE)),
    ):
        model, data = posed("rescue", "drive", state)
        with open_renderer(model, 533, SIZE[1]) as renderer:
            tiles.append(tile(renderer, data, look((-0.25, 0, 0.75), 2.9, 140, -18), text))
    return np.concatenate(tiles, axis=1)


def tracks():
    """The same tracks before and after 14 mm."""
    model, data = posed("rescue", "drive")
    tiles = []
    with open_renderer(model, 2 * SIZE[0], SIZE[1]) as renderer:
        for angle in (0.0, 0.1):
            for joint in range(model.njnt):
                if model.joint(joint).name.endswith("_belt"):
                    data.qpos[model.jnt_qposadr[joint]] = angle
            mujoco.mj_forward(model, data)
            text = f"belts at {angle} rad"
            tiles.append(tile(renderer, data, look((-0.4, 0, 0.16), 1.7, 115, -12), text))
    return np.concatenate(tiles, axis=1)


def single(model, data, at, distance):
    """One picture, from ahead and the robot's left."""
    with open_renderer(model, *ONE) as renderer:
        renderer.update_scene(data, look(at, distance, 222, -12))
        return renderer.render()


def casualty_ahead():
    """The start of the mission stretch."""
    simulation = hurcules.Simulation("stretch", 0, record=False)
    simulation.step(1)  # lights are where they are after a step
    return single(simulation.model, simulation.data, (0.95, 0.25, 0.4), 4.3)


def models_page():
    """Name -> the function that draws a picture of models/README.md."""
    return {
        "rescue_drive": lambda: single(*posed("rescue", "drive"), (0.0, 0, 0.85), 2.7),
        "rescue_ready": lambda: single(*posed("rescue", "ready"), (0.1, 0, 0.88), 3.3),
        "manipulation_acquisition": lambda: single(
            *posed("manipulation", "acquisition"), (0.3, 0, 0.6), 3.0
        ),
        "stretch": casualty_ahead,
    }


def keyframes(robot):
    """Names of the keyframes, each posture once."""
    model = models.load(robot)
    return [model.key(i).name for i in range(model.nkey) if model.key(i).name != "home"]


def pictures():
    """Name -> title, and the function that draws it."""
    found = {}
    for robot in ("rescue", "manipulation"):
        for key in keyframes(robot):
            found[f"{robot}_{key}"] = (
                f"{robot}: {key}", lambda robot=robot, key=key: four_sides(robot, key)
            )  # fmt: skip
    found["bed"] = ("The transfer bed", bed)
    found["tracks"] = ("The tracks move", tracks)
    found["contacts"] = ("What touches: contact geoms", contacts)
    return found


def main(names):
    """Draws the pictures of these names, all without one, and writes the page."""
    FOLDER.mkdir(exist_ok=True)
    found = pictures()
    for name, draw in models_page().items():
        if not names or name in names:
            Image.fromarray(draw()).save(ASSETS / f"{name}.png", optimize=True)
            print(ASSETS / f"{name}.png")
    for name in names or found:
        if name not in found:
            continue
        image = Image.fromarray(found[name][1]())
        image.save(FOLDER / f"{name}.jpg", quality=80, optimize=True)
        print(FOLDER / f"{name}.jpg", f"{(FOLDER / f'{name}.jpg').stat().st_size / 1e3:.0f} kB")
    page = HEAD
    for name, (title, _) in found.items():
        page += f"\n## {title}\n\n![{title}](gallery/{name}.jpg)\n"
    PAGE.write_text(page, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
