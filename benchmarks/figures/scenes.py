"""Draws docs/scenes/*.png and writes the list of all kinds of scenes into docs/scenes.md.

Run:  python benchmarks/figures/scenes.py [KIND ...]    30 s; needs an OpenGL without a window
"""

import sys
from pathlib import Path

import mujoco
import numpy as np
from PIL import Image

import hurcules
from hurcules import models, scenes
from hurcules.rendering import open_renderer

DOCS = Path(__file__).parents[2] / "docs"

PAGE = DOCS / "scenes.md"
FOLDER = PAGE.with_suffix("")
MARK = "<!-- from here on written by benchmarks/figures/scenes.py -->\n"
SIZE = (800, 480)

# kind: parameters, where the camera looks [m], distance [m], azimuth, elevation [degrees]
VIEWS = {
    "flat": ({"friction": 0.6}, (0.4, 0, 0.7), 4.6, 130, -14),
    "slope": ({}, (0.0, 0, 0.8), 5.2, 100, -8),
    "slope30_down": ({}, (0.0, 0, 0.8), 5.2, 100, -8),
    "slope30_across": ({}, (0.0, 0, 0.8), 5.2, 145, -10),
    "incline": ({}, (3.6, 0, 0.8), 11.0, 112, -14),
    "gap": ({"width": 0.4}, (1.8, 0, 0.2), 6.5, 118, -16),
    "trench": ({"width": 0.4, "angle": 0.4}, (1.6, 0, 0.3), 6.0, 120, -22),
    "hurdle": ({"height": 0.2}, (1.0, 0, 0.5), 4.6, 112, -16),
    "steps": ({"count": 2, "height": 0.15, "run": 0.8}, (2.2, 0, 0.6), 7.5, 115, -14),
    "stairs": ({}, (2.6, 0, 0.8), 7.5, 120, -14),
    "ramps": ({}, (4.2, 0, 0.3), 10.5, 112, -20),
    "crossing_ramps": ({}, (4.2, 0, 0.3), 10.5, 112, -20),
    "step_field": ({}, (3.6, 0, 0.2), 8.6, 110, -24),
    "rough_road": ({"roughness": "F"}, (3.0, 0, 0.3), 9.0, 125, -20),
    "gravel": ({}, (2.0, 0, 0.4), 6.5, 125, -20),
    "sand": ({}, (2.0, 0, 0.4), 6.5, 125, -20),
    "pylons": ({"spacing": 8.0}, (3.0, 1.0, 0.5), 11.0, 140, -18),
    "sled": ({}, (1.6, 0, 0.5), 5.2, 112, -18),
    "casualty": ({}, (1.5, 0, 0.5), 5.4, 130, -18),
    "ordnance": ({}, (1.0, 0, 0.5), 4.4, 30, -26),
    "disposal": ({}, (3.0, 0.4, 0.4), 8.5, 135, -18),
    "lift": ({}, (1.0, 0, 0.5), 4.6, 60, -20),
    "force_pad": ({}, (1.0, 0, 0.5), 4.6, 60, -24),
    "debris": ({}, (2.2, 0, 0.3), 6.2, 112, -20),
    "door": ({}, (1.4, 0, 0.9), 6.4, 135, -12),
    "valve": ({}, (0.9, 0, 0.9), 4.6, 50, -12),
}
STANDING = {
    "casualty",
    "ordnance",
    "lift",
    "force_pad",
    "debris",
    "valve",
    "sled",
}  # the robot stands up
MANIPULATION = {"ordnance", "debris", "door", "valve"}
SETTLE = {"debris": 2.0}  # [s] until things lie
LINE_UP = ((0, 0, 0.1), 4.6, 160, -38)  # camera of the four casualties


def picture(model, data, view):
    """One picture (height, width, 3)."""
    camera = mujoco.MjvCamera()
    camera.lookat[:], camera.distance, camera.azimuth, camera.elevation = view
    with open_renderer(model, *SIZE) as renderer:
        renderer.update_scene(data, camera)
        return renderer.render()


def draw_scene(kind):
    """A robot at the start of a scene."""
    values, *view = VIEWS[kind]
    robot = "manipulation" if kind in MANIPULATION else "rescue"
    model = scenes.load(kind, robot, seed=1, **values)
    data = mujoco.MjData(model)
    key = model.key("ready" if kind in STANDING else "drive")
    mujoco.mj_resetDataKeyframe(model, data, key.id)
    here = np.array(data.qpos)
    hurcules.step(model, data, 1 + round(SETTLE.get(kind, 0.0) / model.opt.timestep))
    robots = models.load(robot).nq
    data.qpos[:robots] = here[:robots]  # only the things were to move
    mujoco.mj_forward(model, data)
    return picture(model, data, view)


def draw_casualties():
    """All persons in a row, heads to the left."""
    spec = scenes.make("flat")
    for x, mass in zip((-1.05, -0.35, 0.35, 1.05), (50, 75, 90, 120), strict=True):
        file = models.folder() / f"objects/casualty_{mass}kg.xml"
        frame = spec.worldbody.add_frame(pos=[x, 0, 0.14], quat=[0.5, -0.5, -0.5, -0.5])
        spec.attach(mujoco.MjSpec.from_file(str(file)), prefix=f"p{mass}_", frame=frame)
    model = spec.compile()
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, 1000)
    return picture(model, data, LINE_UP)


def gallery():
    """The list of all kinds: picture, parameters."""
    text = []
    for kind in scenes.names():
        about = type(scenes.scene(kind))
        presets = [name for name, (of, _) in scenes.PRESETS.items() if of == kind and name in VIEWS]
        text += [f"### {kind}", "", about.__doc__.strip(), ""]
        text += [" ".join(f"![{name}](scenes/{name}.png)" for name in [kind, *presets]), ""]
        text += [f"Follows: {about.source}.", ""] if about.source else []
        text += ["| parameter | default | wanted | meaning |", "|---|---|---|---|"]
        for p in scenes.parameters(kind):
            default = f"{p.default:.4g}" if type(p.default) is float else str(p.default)
            text.append(f"| `{p.name}` | {default} | {p.wanted} | {p.meaning} |")
        text.append("")
    return "\n".join(line.strip() for line in "\n".join(text).splitlines()) + "\n"


def main(kinds):
    """Draws the kinds that are named, all without names."""
    FOLDER.mkdir(exist_ok=True)
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(page[: page.index(MARK)] + MARK + "\n" + gallery(), encoding="utf-8")
    for kind in kinds or [*VIEWS, "casualties"]:
        pixels = draw_casualties() if kind == "casualties" else draw_scene(kind)
        image = Image.fromarray(pixels).quantize(256, dither=Image.Dither.FLOYDSTEINBERG)
        image.save(FOLDER / f"{kind}.png", optimize=True)
        print(kind)


if __name__ == "__main__":
    main(sys.argv[1:])
