"""Shapes of URDF files: where their meshes are, and those that MuJoCo does not read."""

from __future__ import annotations

import copy
import functools
import os
import warnings
import xml.etree.ElementTree as ET
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules._core import Error

__all__ = ["Triangles", "fit_shapes", "place_meshes"]

_READ = (".stl", ".obj", ".msh")  # by MuJoCo
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
) -> dict[str, Triangles]:
    """Meshes by their places; takes out shapes that are not wanted or cannot be had.

    Returns:
        By the name of a file that stands in for it, each mesh that MuJoCo does not read.
    """
    if isinstance(packages, (str, Path)):
        raise Error(f"packages wants a list of folders, {str(packages)!r} came")
    folders = [*map(Path, packages), *path.resolve().parents, *_packages_of_ros()]
    lost: list[str] = []
    touching = 0  # of them
    converted = {}
    pieces_of = functools.cache(_pieces)
    for link in root.iter("link"):
        for shape in [*link.findall("visual"), *link.findall("collision")]:
            seen = shape.tag == "visual"
            if not shapes or (seen and not visuals):
                link.remove(shape)
                continue
            mesh = shape.find("geometry/mesh")
            name = "" if mesh is None else mesh.get("filename", "")
            file = None if mesh is None else _find_mesh(name, path, folders)
            if mesh is None or (file is not None and _is_readable(file)):
                if mesh is not None:
                    mesh.set("filename", str(file))
                if seen:
                    _paint(shape, None)
                continue
            link.remove(shape)
            pieces = () if file is None else pieces_of(file, by_colour=seen)
            if not pieces:
                lost.append(name)
                touching += not seen
            for i, piece in enumerate(pieces):
                stand_in = f"{file}.{'seen' if seen else 'touched'}.{i}.stl"
                converted[stand_in] = piece
                one = copy.deepcopy(shape)
                next(one.iter("mesh")).set("filename", stand_in)
                if seen:
                    _paint(one, piece.rgba)
                link.append(one)
    if lost:
        _tell(path, lost, touching)
    return converted


def place_meshes(spec: mujoco.MjSpec, converted: dict[str, Triangles]) -> None:
    """Gives meshes that were converted their triangles, and geoms their groups."""
    for mesh in spec.meshes:
        mesh.inertia = mujoco.mjtMeshInertia.mjMESH_INERTIA_SHELL  # thin ones have no volume
        if mesh.file in converted:
            triangles = converted[mesh.file]
            mesh.file = ""
            mesh.uservert = triangles.corners.ravel()
            mesh.userface = triangles.faces.ravel()
    for body in spec.bodies:
        if any(geom.group == _SEEN for geom in body.geoms):
            for geom in body.geoms:
                geom.group = geom.group or _TOUCHED


def _tell(path: Path, lost: list[str], touching: int) -> None:
    elsewhere = any(name.startswith("package://") and _is_read(name) for name in lost)
    unread = any(not _is_read(name) for name in lost) and not _has_trimesh()
    warnings.warn(
        f"{path.name}: {len(lost)} shapes are left out ({touching or 'none'} of them for "
        f"contacts), whose meshes are not there or of a kind that is not read: {lost[0]}"
        + ", ..." * (len(lost) > 1)
        + "; packages=[...] names folders that hold packages" * elsewhere
        + "; COLLADA and others are read with trimesh: pip install 'hurcules[urdf]'" * unread,
        stacklevel=5,
    )


def _paint(shape: ET.Element, own: Sequence[float] | None) -> None:
    """A mesh's own colour, that of the file, or grey: MuJoCo would take that of the last shape."""
    told = shape.find("material")
    if told is not None and own is not None:
        shape.remove(told)
    if told is None or own is not None:
        text = " ".join(f"{part:.4g}" for part in own or _PLAIN)
        material = ET.SubElement(shape, "material", {"name": f"colour {text}"})
        ET.SubElement(material, "color", {"rgba": text})


def _has_trimesh() -> bool:
    try:
        import collada  # noqa: F401
        import trimesh  # noqa: F401
    except ImportError:
        return False
    return True


def _pieces(file: Path, *, by_colour: bool) -> tuple[Triangles, ...]:
    """What trimesh reads of a file, together or colour by colour; nothing where it does not."""
    if not _has_trimesh():
        return ()
    import trimesh

    try:
        scene = trimesh.load_scene(file)
        if scene.units:
            scene = scene.convert_units("meters")
        parts = [part for part in scene.dump() if isinstance(part, trimesh.Trimesh)]
    except Exception:  # of many readers, each with errors of its own
        return ()
    groups: dict[tuple[float, ...] | None, list[Any]] = {}
    for part in parts:
        groups.setdefault(_colour(part.visual) if by_colour else None, []).append(part)
    merged: list[tuple[Any, tuple[float, ...] | None]] = [
        (trimesh.util.concatenate(same), rgba) for rgba, same in groups.items()
    ]
    return tuple(
        Triangles(np.array(one.vertices, float), np.array(one.faces, np.int32), rgba)
        for one, rgba in merged
        if len(one.vertices) > 3
    )


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


def _is_read(name: str) -> bool:
    return name.lower().endswith(_READ)


def _is_readable(file: Path) -> bool:
    """Whether MuJoCo reads it: of STL, it takes binary files alone."""
    if file.suffix.lower() != ".stl":
        return _is_read(file.name)
    with file.open("rb") as stream:
        head = stream.read(84)
    return len(head) == 84 and file.stat().st_size == 84 + 50 * int.from_bytes(head[80:], "little")


def _find_mesh(name: str, path: Path, packages: list[Path]) -> Path | None:
    name = name.removeprefix("file://")
    package = name.startswith("package://")
    relative = Path(name.removeprefix("package://").lstrip("/") if package else name)
    folders = packages if package else [path.resolve().parent]
    for folder in folders:
        file = folder / relative
        if file.is_file():
            return file
        # beside the file of its own package: package://NAME/meshes -> .../NAME/meshes
        if package and folder.name == relative.parts[0]:
            file = folder.joinpath(*relative.parts[1:])
            if file.is_file():
                return file
    return None
