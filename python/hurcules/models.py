"""The robots and scenes that come with Hurcules, as MuJoCo models.

A robot (models/robots/NAME.xml) stands in a scene: a file (models/scenes/NAME.xml), or one that
`hurcules.scenes` makes from parameters. Most scenes are mere surroundings and take any robot; the
scene of a mission names the robot that it is made for.
"""

import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from pathlib import Path

import mujoco

from hurcules import _core
from hurcules._core import Error
from hurcules.validation import require_known

__all__ = ["folder", "load", "names", "parse", "path", "scenes"]


def folder() -> Path:
    """Returns the folder models/: beside the compiled module in a wheel, else the checkout's."""
    installed = Path(_core.__file__).with_name("models")
    return installed if installed.is_dir() else Path(__file__).resolve().parents[2] / "models"


def names() -> list[str]:
    """Returns the names of the robots."""
    return _stems("robots")


def scenes() -> list[str]:
    """Returns the names of the scenes: files first, then those that are made."""
    files = _stems("scenes")
    return files + [name for name in _made() if name not in files]


def path(name: str) -> Path:
    """Returns the MJCF file of a robot or of a scene that is one.

    Raises:
        Error: nothing has this name; the text lists the names that exist.
    """
    if name in names():
        return folder() / "robots" / f"{name}.xml"
    return _existing("scenes", name, "robot or scene", names() + _stems("scenes"))


def parse(files: Sequence[Path], model: str = "hurcules") -> mujoco.MjSpec:
    """Reads MJCF files into one model, names as they are there.

    Args:
        files: in this order, the robot's first.
        model: name of the model.

    Raises:
        Error: MuJoCo's text about broken MJCF.
    """
    includes = "".join(f'<include file="{file}"/>' for file in files)
    try:
        spec = mujoco.MjSpec.from_string(f'<mujoco model="{model}">{includes}</mujoco>')
    except ValueError as error:
        raise _rejected(error) from error
    spec.modelfiledir = str(folder() / "robots")
    return spec


def load(
    name: str | None = None,
    scene: str | None = None,
    mission: str | None = None,
    *,
    bed: bool = True,
) -> mujoco.MjModel:
    """Compiles a robot in its surroundings.

    Args:
        name: one of `names()`; by default the robot that the scene is made for, else "rescue".
        scene: one of `scenes()`; by default that of the mission, without a mission "flat". A scene
            that is made has its default parameters and seed 0 here; see `hurcules.scenes.load`.
        mission: one of `hurcules.missions()`.
        bed: False takes the transfer bed off the rescue robot.

    Raises:
        Error: an unknown name, no bed to take off, a scene made for another robot, or MuJoCo's text
            about broken MJCF.
    """
    if scene is None:
        scene = Path(_core.mission_scene(mission)).stem if mission else "flat"
    if scene in _made() and scene not in _stems("scenes"):
        from hurcules import scenes as made

        if bed:
            return made.load(scene, name or "rescue")
        return _compile(_without_bed(made.make(scene, robot=name or "rescue")))
    surroundings = _existing("scenes", scene, "scene", scenes())
    inhabitant = _robot_in(surroundings)
    name = name or inhabitant or "rescue"
    robot = _existing("robots", name, "robot", names())
    if inhabitant is None:
        spec = parse([robot, surroundings], f"{name} in {scene}")
        return _compile(spec if bed else _without_bed(spec))
    if inhabitant != name:
        raise Error(f"scene '{scene}' is made for robot '{inhabitant}', not '{name}'")
    if bed:
        return _compile(surroundings)
    return _compile(_without_bed(mujoco.MjSpec.from_file(str(surroundings))))


def _without_bed(spec: mujoco.MjSpec) -> mujoco.MjSpec:
    from hurcules import transfer_bed

    transfer_bed.detach(spec)
    return spec


def _made() -> list[str]:
    """Scenes that need no file; imported here, as they need this module."""
    from hurcules import scenes as made

    return [*made.names(), *made.PRESETS]


def _stems(kind: str) -> list[str]:
    return sorted(file.stem for file in (folder() / kind).glob("*.xml"))


def _existing(kind: str, name: str, noun: str, known: list[str]) -> Path:
    require_known(noun, name, known)
    return folder() / kind / f"{name}.xml"


def _robot_in(scene: Path) -> str | None:
    """The robot that a scene includes itself, None for mere surroundings."""
    try:
        includes = ElementTree.parse(scene).getroot().iter("include")
    except ElementTree.ParseError as error:
        raise Error(f"{scene}: {error}") from error
    files = [Path(include.get("file", "")) for include in includes]
    return next((file.stem for file in files if file.parent.name == "robots"), None)


def _compile(source: Path | mujoco.MjSpec) -> mujoco.MjModel:
    try:
        if isinstance(source, Path):
            return mujoco.MjModel.from_xml_path(str(source))
        return source.compile()
    except ValueError as error:
        raise _rejected(error) from error


def _rejected(error: ValueError) -> Error:
    text = " ".join(str(error).split())
    return Error(f"MuJoCo rejects the model: {text}")
