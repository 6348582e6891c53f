"""The robots and scenes that come with Hurcules, as MuJoCo models.

A robot (models/robots/NAME.xml) stands in a scene: a file (models/scenes/NAME.xml), or one that
`hurcules.scenes` makes from parameters. Most scenes are mere surroundings and take any robot; the
scene of a mission names the robot that it is made for.
"""

import copy
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import mujoco

from hurcules import _core, lift, mjcf, transfer_bed
from hurcules import scenes as made
from hurcules._core import Error
from hurcules.mjcf import folder, parse

__all__ = ["folder", "load", "make", "names", "parse", "path", "scenes", "with_timestep"]


def names() -> list[str]:
    """Returns the names of the robots."""
    return mjcf.robots()


def scenes() -> list[str]:
    """Returns the names of the scenes: files first, then those that are made."""
    files = mjcf.stems("scenes")
    return files + [name for name in _made() if name not in files]


def path(name: str) -> Path:
    """Returns the MJCF file of a robot or of a scene that is one.

    Raises:
        Error: nothing has this name; the text lists the names that exist.
    """
    if name in names():
        return folder() / "robots" / f"{name}.xml"
    return mjcf.existing("scenes", name, "robot or scene", names() + mjcf.stems("scenes"))


def load(
    name: str | None = None,
    scene: str | None = None,
    mission: str | None = None,
    *,
    bed: bool = True,
    visuals: bool = True,
    seed: int = 0,
    **values: Any,
) -> mujoco.MjModel:
    """Compiles a robot in its surroundings.

    Args:
        name: one of `names()`; by default the robot that the scene is made for, else "rescue".
        scene: one of `scenes()`; by default that of the mission, without a mission "flat".
        mission: one of `hurcules.missions()`.
        bed: False takes the transfer bed off the rescue robot.
        visuals: False leaves out what is only seen; the physics is the same to the bit, the model
            a fraction of the size.
        seed: of a scene that is drawn.
        values: parameters of a scene that is made, as for `hurcules.scenes.load`.

    Raises:
        Error: an unknown name, no bed to take off, a scene made for another robot, parameters for
            one that has none, or MuJoCo's text about broken MJCF.
    """
    if _is_made(scene) and bed and visuals:
        return made.load(str(scene), name or "rescue", seed=seed, **values)
    spec = make(name, scene, mission, seed, **values)
    if not bed:
        transfer_bed.detach(spec)
    return mjcf.compile(spec if visuals else mjcf.without_visuals(spec))


def with_timestep(model: mujoco.MjModel, timestep: float) -> mujoco.MjModel:
    """A copy of a model with another step of the physics [s]."""
    changed = copy.copy(model)
    changed.opt.timestep = timestep
    return changed


def make(
    name: str | None = None,
    scene: str | None = None,
    mission: str | None = None,
    seed: int = 0,
    **values: Any,
) -> mujoco.MjSpec:
    """A robot in its surroundings, not compiled yet; arguments and errors as those of `load`."""
    if values and not _is_made(scene):
        kinds = ", ".join(_made())
        raise Error(f"{', '.join(values)}: wanted with a scene that has parameters, of {kinds}")
    if scene is None and mission == "lift" and name in (None, "rescue"):
        return lift.spec(lift.Person())
    if scene is None:
        scene = Path(_core.mission_scene(mission)).stem if mission else "flat"
    if _is_made(scene):
        return made.make(scene, robot=name or "rescue", seed=seed, **values)
    surroundings = mjcf.existing("scenes", scene, "scene", scenes())
    inhabitant = _robot_in(surroundings)
    name = name or inhabitant or "rescue"
    robot = mjcf.existing("robots", name, "robot", names())
    if inhabitant is None:
        return mjcf.parse([robot, surroundings], f"{name} in {scene}")
    if inhabitant != name:
        raise Error(f"scene '{scene}' is made for robot '{inhabitant}', not '{name}'")
    return mujoco.MjSpec.from_file(str(surroundings))


def _made() -> list[str]:
    """Scenes that need no file."""
    return [*made.names(), *made.PRESETS]


def _is_made(scene: str | None) -> bool:
    return scene in _made() and scene not in mjcf.stems("scenes")


def _robot_in(scene: Path) -> str | None:
    """The robot that a scene includes itself, None for mere surroundings."""
    try:
        includes = ElementTree.parse(scene).getroot().iter("include")
    except ElementTree.ParseError as error:
        raise Error(f"{scene}: {error}") from error
    files = [Path(include.get("file", "")) for include in includes]
    return next((file.stem for file in files if file.parent.name == "robots"), None)
