"""Shapes of URDF files: where their meshes are, and those that MuJoCo does not read."""

from __future__ import annotations

import copy
import functools
import itertools
import os
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error

__all__ = ["Triangles", "fit_shapes", "place_meshes"]

_READ = (".stl", ".obj", ".msh")  # by MuJoCo
_MOST_FACES = 200_000  # that it takes of STL
_ABSENT = "is not there"
_REMEDY = "COLLADA and others are read with trimesh: pip install 'hurcules[urdf]'"
_PLAIN = (0.7, 0.7, 0.7, 1.0)  # of what has no colour
_SEEN, _TOUCHED = 1, 3  # groups of geoms; viewers hide the latter at first


@dataclass(frozen=True)
class Triangles:
    """A mesh: corners (n, 3) [m], the three of each face (m, 3), and a colour, if it has one."""

    corners: NDArray[np.float64]
    faces: NDArray[np.int32]
    rgba: tuple[float, ...] | None


def fit_shapes(
    root: ET.Element, path: Path, shapes: bool, visuals: bool, packages: Sequence[str | Path]
) -> dict[str, Path | Triangles]:
    """Meshes by names of their own; takes out shapes that are not wanted or cannot be had.

    Returns:
        By the name that stands in the tree now, a file that MuJoCo reads, or what it does not.
    """
    if isinstance(packages, (str, Path)):
        raise Error(f"packages wants a list of folders, {str(packages)!r} came")
    folders = [*map(Path, packages), *path.resolve().parents, *_packages_of_ros()]
    lost: list[_Lost] = []
    meshes = _Meshes()
    _keep_materials(root)
    for link in root.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            mesh, seen = shape.find("geometry/mesh"), shape.tag == "visual"
            if not shapes or (seen and not visuals):
                link.remove(shape)
            elif mesh is not None:
                name = mesh.get("filename", "")
                try:
                    pieces = meshes.of(_find_mesh(name, path, folders), mesh.get("scale", ""), seen)
                    _replace(link, shape, pieces)
                except _NotReadError as error:
                    lost.append(_Lost(name, not seen, str(error)))
                    link.remove(shape)
            elif seen:
                _paint(shape, None)
    if lost:
        _tell(path, lost)
    return meshes.by_name


def place_meshes(spec: mujoco.MjSpec, meshes: dict[str, Path | Triangles]) -> None:
    """Gives meshes their files or triangles, and geoms their groups."""
    for mesh in spec.meshes:
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # thin ones have no volume
        what = meshes[mesh.file]
        if isinstance(what, Triangles):
            mesh.file = ""
            mesh.uservert = what.corners.ravel()
            mesh.userface = what.faces.ravel()
        else:
            mesh.file = str(what)
    for body in spec.bodies:
        if any(geom.group == _SEEN for geom in body.geoms):
            for geom in body.geoms:
                geom.group = geom.group or _TOUCHED


class _NotReadError(Exception):
    """Why a mesh cannot be had."""


@dataclass(frozen=True)
class _Lost:
    name: str
    touches: bool
    reason: str


class _Meshes:
    """Meshes by names of their own: MuJoCo takes two files of one name for one mesh.

    Attributes:
        by_name: a file, or its triangles where MuJoCo does not read it.
    """

    def __init__(self) -> None:
        self.by_name: dict[str, Path | Triangles] = {}
        self._pieces: dict[tuple[Path, str, bool], list[tuple[str, Triangles | None]]] = {}
        self._read = functools.cache(_read)  # a file is read once, however often it is used

    def of(self, file: Path, scale: str, seen: bool) -> list[tuple[str, Triangles | None]]:
        """Names of the pieces of a file, with what was read of each.

        Raises:
            _NotReadError: it cannot be had.
        """
        plain = _is_readable(file)
        key = (file, scale, seen and not plain)
        if key not in self._pieces:
            pieces = [None] if plain else _pieces(self._read(file), seen)
            self._pieces[key] = [(self._name(file, piece), piece) for piece in pieces]
        return self._pieces[key]

    def _name(self, file: Path, piece: Triangles | None) -> str:
        ending = file.suffix if piece is None else ".stl"
        names = (f"{file.stem}{f'_{i}' if i else ''}{ending}" for i in itertools.count())
        stems = {Path(name).stem for name in self.by_name}
        name = next(name for name in names if Path(name).stem not in stems)
        self.by_name[name] = file if piece is None else piece
        return name


def _replace(
    link: ET.Element, shape: ET.Element, pieces: list[tuple[str, Triangles | None]]
) -> None:
    """A shape for each piece of a mesh, where the mesh was."""
    place = list(link).index(shape)
    link.remove(shape)
    for i, (name, piece) in enumerate(pieces):
        one = copy.deepcopy(shape)
        next(one.iter("mesh")).set("filename", name)
        if i:
            one.attrib.pop("name", None)
        if shape.tag == "visual":
            _paint(one, None if piece is None else piece.rgba)
        link.insert(place + i, one)


def _tell(path: Path, lost: list[_Lost]) -> None:
    elsewhere = any(one.name.startswith("package://") and one.reason == _ABSENT for one in lost)
    touching = sum(one.touches for one in lost) or "none"
    warnings.warn(
        f"{path.name}: {len(lost)} shapes are left out ({touching} of them for contacts): "
        f"{lost[0].name}: {lost[0].reason}"
        + ", ..." * (len(lost) > 1)
        + "; packages=[...] names folders that hold packages" * elsewhere,
        stacklevel=5,
    )


def _keep_materials(root: ET.Element) -> None:
    """Colours that shapes define for others stay where the shape goes or changes."""
    there = {material.get("name") for material in root.findall("material")}
    for material in root.findall("link/visual/material"):
        if material.find("color") is not None and material.get("name") not in there:
            there.add(material.get("name"))
            root.insert(0, copy.deepcopy(material))


def _paint(shape: ET.Element, own: Sequence[float] | None) -> None:
    """A mesh's own colour, that of the file, or grey: MuJoCo would take that of the last shape."""
    told = shape.find("material")
    if told is not None and own is not None:
        shape.remove(told)
    if told is None or own is not None:
        text = " ".join(f"{part:.4g}" for part in own or _PLAIN)
        material = ET.SubElement(shape, "material", {"name": f"colour {text}"})
        ET.SubElement(material, "color", {"rgba": text})


def _read(file: Path) -> list[tuple[Any, tuple[float, ...] | None]]:
    """What trimesh reads of a file, in metres, with the colour of each part.

    Raises:
        _NotReadError: it reads nothing, or is not there.
    """
    try:
        import trimesh

        scene = trimesh.load_scene(file)
        if scene.units:
            scene = scene.convert_units("meters")
        meshes = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh)]
        parts = [(mesh, _colour(mesh.visual)) for mesh in meshes]
    except ImportError as error:
        raise _NotReadError(f"{_REMEDY} ({error})") from error
    except Exception as error:  # of many readers, each with errors of its own
        raise _NotReadError(f"trimesh: {error}") from error
    if not parts:
        raise _NotReadError("trimesh finds no triangles in it")
    return parts


def _pieces(parts: list[tuple[Any, tuple[float, ...] | None]], seen: bool) -> list[Triangles]:
    """Together for contacts, colour by colour to look at.

    Raises:
        _NotReadError: for contacts, they lie in a plane.
    """
    import trimesh

    groups: dict[tuple[float, ...] | None, list[Any]] = {}
    for part, colour in parts:
        groups.setdefault(colour if seen else None, []).append(part)
    merged: list[tuple[Any, tuple[float, ...] | None]] = [
        (trimesh.util.concatenate(same), rgba) for rgba, same in groups.items()
    ]
    pieces = [
        Triangles(np.array(one.vertices, float), np.array(one.faces, np.int32), rgba)
        for one, rgba in merged
        if len(one.vertices) > 3
    ]
    if not pieces:
        raise _NotReadError("it is a single triangle")
    if not seen:
        corners = pieces[0].corners - pieces[0].corners.mean(axis=0)
        spans = np.linalg.svd(corners, compute_uv=False)
        if spans[2] < 1e-6 * spans[0]:
            raise _NotReadError("it is flat, and touches nothing")
    return pieces


def _colour(visual: Any) -> tuple[float, ...] | None:
    if not visual.defined:
        return None
    main = visual.material.main_color if visual.kind == "texture" else visual.main_color
    return tuple(float(part) / 255.0 for part in main)


def _packages_of_ros() -> Iterator[Path]:
    """Folders that hold packages, of ROS 1 and of ROS 2."""
    sources = os.environ.get("ROS_PACKAGE_PATH", "").split(os.pathsep)
    installed = os.environ.get("AMENT_PREFIX_PATH", "").split(os.pathsep)
    yield from (Path(folder) for folder in sources if folder)
    yield from (Path(folder) / "share" for folder in installed if folder)


def _is_readable(file: Path) -> bool:
    """Whether MuJoCo reads it: of STL, it takes binary files alone, and not too large ones."""
    if file.suffix.lower() != ".stl":
        return file.suffix.lower() in _READ
    with file.open("rb") as stream:
        head = stream.read(84)
    faces = int.from_bytes(head[80:], "little")
    return file.stat().st_size == 84 + 50 * faces and faces <= _MOST_FACES


def _find_mesh(name: str, path: Path, packages: list[Path]) -> Path:
    """Where a mesh is.

    Raises:
        _NotReadError: nowhere.
    """
    if name.startswith("file://"):
        name = unquote(name.removeprefix("file://"))
    package = name.startswith("package://")
    relative = Path(name.removeprefix("package://").lstrip("/") if package else name)
    folders = packages if package else [path.resolve().parent]
    for folder in folders:
        file = folder / relative
        if file.is_file():
            return file
        # beside the file of its own package: package://NAME/meshes -> .../NAME/meshes
        if package and relative.parts and folder.name == relative.parts[0]:
            file = folder.joinpath(*relative.parts[1:])
            if file.is_file():
                return file
    raise _NotReadError(_ABSENT)
