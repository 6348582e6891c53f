"""The MJCF files that come with Hurcules: where they lie, and how they become one model."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import mujoco

from hurcules import _core
from hurcules._core import Error
from hurcules.validation import require_known

__all__ = ["compile", "existing", "folder", "parse", "robot", "robots", "stems", "without_visuals"]


def folder() -> Path:
    """Returns the folder models/: beside the compiled module in a wheel, else the checkout's."""
    installed = Path(_core.__file__).with_name("models")
    return installed if installed.is_dir() else Path(__file__).resolve().parents[2] / "models"


def robots() -> list[str]:
    """Returns the names of the robots."""
    return stems("robots")


def robot(name: str) -> Path:
    """Returns the MJCF file of a robot.

    Raises:
        Error: no robot has this name; the text lists those that exist.
    """
    return existing("robots", name, "robot", robots())


def stems(kind: str) -> list[str]:
    """Returns the names of the files of a kind, a folder of models/."""
    return sorted(file.stem for file in (folder() / kind).glob("*.xml"))


def existing(kind: str, name: str, noun: str, known: list[str]) -> Path:
    """Returns the file of a name that is known.

    Raises:
        Error: the name is not known; the text says what it should be the name of.
    """
    require_known(noun, name, known)
    return folder() / kind / f"{name}.xml"


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


def compile(source: Path | mujoco.MjSpec) -> mujoco.MjModel:
    """Compiles a file or what was parsed.

    Raises:
        Error: MuJoCo's text about broken MJCF.
    """
    try:
        if isinstance(source, Path):
            return mujoco.MjModel.from_xml_path(str(source))
        return source.compile()
    except ValueError as error:
        raise _rejected(error) from error


def without_visuals(spec: mujoco.MjSpec) -> mujoco.MjSpec:
    """Takes away the shapes without mass that nothing can touch, their meshes, and all textures."""
    for geom in list(spec.geoms):
        if geom.contype == 0 and geom.conaffinity == 0 and geom.mass == 0.0:
            spec.delete(geom)
    used = {geom.meshname for geom in spec.geoms}
    for mesh in list(spec.meshes):
        if mesh.name not in used:
            spec.delete(mesh)
    for material in spec.materials:
        material.textures = [""] * len(material.textures)
    for texture in list(spec.textures):
        spec.delete(texture)
    return spec


def _rejected(error: ValueError) -> Error:
    text = " ".join(str(error).split())
    return Error(f"MuJoCo rejects the model: {text}")
