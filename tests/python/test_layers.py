"""The arrows of the house (house-style, section 1), read from the include and import lines.

Strategy: one function per rule returns the offences it finds; the tests run it over the real files,
and once over made-up lines to see that it can fail. Not tested: links beyond cpp/CMakeLists.txt.
"""

import ast
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from pathlib import Path

import pytest

# room -> the rooms that it may include beside itself
ARROWS: dict[str, set[str]] = {
    "base": set(),
    "solver": {"base"},
    "robot": {"base"},
    "tasks": {"robot", "base"},
    "control": {"tasks", "solver", "robot", "base"},
    "mission": {"control", "base"},
    "sim": {"mission", "control", "robot", "base"},
}
# where mujoco.h may be included
PHYSICS = {"robot", "sim"}

INCLUDE = re.compile(r'^\s*#\s*include\s*([<"][^>"]+[>"])', re.MULTILINE)
# a room may have folders; its arrows are those of the whole room
ROOM_HEADER = re.compile(r'"hurcules/(\w+)/(?:\w+/)*\w+\.hpp"')
LINKS = re.compile(r"^hurcules_room\((\w+) LINKS ([^)]*)\)", re.MULTILINE)
# [T 4.12], [T §3.2], [T alg. 2], [T A.2.9], [S 146]; not a unit such as [N m]
TAG = re.compile(r"\[([A-Z]) (?:§|alg\. ?|[A-Z]\.)?\d[^\]]*\]")


def offences(room: str, file: str, headers: Iterable[str]) -> list[str]:
    """What a file of a room includes although it may not; headers with their quotes or brackets."""
    found = []
    for header in headers:
        target = ROOM_HEADER.fullmatch(header)
        if target and target[1] not in ARROWS[room] | {room}:
            found.append(f"{file}: {room} -> {target[1]} is no arrow of the house ({header})")
        elif header.startswith('"') and not target:
            found.append(f"{file}: {header} is not written from the root, or is in no room")
        elif header.startswith("<mujoco/") and not (room in PHYSICS and file.endswith(".cpp")):
            found.append(f"{file}: {header} belongs into the sources of {sorted(PHYSICS)} only")
    return found


def upward_imports(source: str, forbidden: str) -> list[int]:
    """Lines that import the package `forbidden` when the module itself is imported."""
    return [node.lineno for node in _at_import(ast.parse(source)) if _names(node, forbidden)]


def _at_import(node: ast.AST) -> Iterator[ast.AST]:
    """All nodes but those inside functions, which run later."""
    for child in ast.iter_child_nodes(node):
        if not isinstance(child, ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda):
            yield child
            yield from _at_import(child)


def _names(node: ast.AST, package: str) -> bool:
    if isinstance(node, ast.Import):
        return any(alias.name.split(".")[0] == package for alias in node.names)
    return isinstance(node, ast.ImportFrom) and (node.module or "").split(".")[0] == package


def sources(root: Path) -> list[Path]:
    """Every C++ file of the rooms, those in their folders too."""
    return sorted((root / "cpp" / "hurcules").rglob("*.[ch]pp"))


def room_of(root: Path, file: Path) -> str:
    """The room that a file belongs to."""
    return file.relative_to(root / "cpp" / "hurcules").parts[0]


def test_every_room_of_the_picture_exists_and_no_other(root: Path) -> None:
    assert {room_of(root, file) for file in sources(root)} == set(ARROWS)


@pytest.mark.parametrize("room", ARROWS)
def test_a_room_includes_only_what_its_arrows_allow(root: Path, room: str) -> None:
    found = []
    for file in sources(root):
        if room_of(root, file) == room:
            headers = INCLUDE.findall(file.read_text(encoding="utf-8"))
            found += offences(room, str(file.relative_to(root)), headers)
    assert found == []


def test_the_arrows_have_no_circle() -> None:
    left = dict(ARROWS)
    while left:
        ground = [room for room, targets in left.items() if not targets & set(left)]
        assert ground, f"circle among {sorted(left)}"
        for room in ground:
            del left[room]


def test_cmake_links_no_more_than_the_arrows_allow(root: Path) -> None:
    text = (root / "cpp" / "CMakeLists.txt").read_text(encoding="utf-8")
    links = {
        room: set(re.findall(r"hurcules_(\w+)", targets)) for room, targets in LINKS.findall(text)
    }
    assert set(links) == set(ARROWS)
    assert {room: targets - ARROWS[room] for room, targets in links.items()} == {
        r: set() for r in ARROWS
    }


def test_the_checker_finds_what_is_forbidden() -> None:
    assert offences("solver", "a.cpp", ['"hurcules/robot/robot.hpp"'])
    assert offences("tasks", "a.cpp", ['"hurcules/solver/solver.hpp"'])
    assert offences("base", "a.hpp", ['"error.hpp"'])
    assert offences("robot", "a.cpp", ['"hurcules/solver/problem/row_table.hpp"'])
    assert not offences("solver", "a.cpp", ['"hurcules/solver/problem/row_table.hpp"'])
    assert offences("sim", "a.cpp", ['"python/bindings/module.hpp"'])
    assert offences("sim", "a.hpp", ["<mujoco/mujoco.h>"])
    assert offences("control", "a.cpp", ["<mujoco/mujoco.h>"])
    assert not offences(
        "sim", "a.cpp", ["<mujoco/mujoco.h>", "<vector>", '"hurcules/base/types.hpp"']
    )
    assert INCLUDE.findall('#include "x.hpp"\n  # include <y>\n// #include <z>\n') == [
        '"x.hpp"',
        "<y>",
    ]


def test_hurcules_does_not_import_hurcules_envs(root: Path) -> None:
    files = sorted((root / "python" / "hurcules").rglob("*.py"))
    found = {
        str(file): upward_imports(file.read_text(encoding="utf-8"), "hurcules_envs")
        for file in files
    }
    assert {file: lines for file, lines in found.items() if lines} == {}


def test_the_import_checker_finds_what_is_forbidden() -> None:
    source = (
        "import os\nif os:\n  from a.b import c\ndef f():\n  import a\nclass C:\n  import a.d\n"
    )
    assert upward_imports(source, "a") == [3, 7]


def test_every_equation_tag_has_its_letter_in_the_notation(root: Path) -> None:
    notation = (root / "cpp" / "NOTATION.md").read_text(encoding="utf-8")
    files = sorted((root / "cpp").rglob("*.[ch]pp"))
    letters = {letter for file in files for letter in TAG.findall(file.read_text(encoding="utf-8"))}
    assert "T" in letters, "the pattern of tags finds nothing any more"
    # explained at the start of a line: of a table, a list or a paragraph
    assert [
        x for x in sorted(letters) if not re.search(rf"^\W*{x}\b", notation, re.MULTILINE)
    ] == []


def test_tags_are_told_from_units() -> None:
    text = "[T 4.12] [T §3.2] [T alg. 2] [T A.2.9] [S 143-146] [N m] [N] [X] [T]"
    assert TAG.findall(text) == ["T", "T", "T", "T", "S"]


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_one_libmujoco_is_mapped_into_the_process() -> None:
    code = "import hurcules, mujoco; print(open('/proc/self/maps').read())"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert len(set(re.findall(r"\S*/libmujoco\.so\S*", run.stdout))) == 1
