"""The dependencies of the architecture, read from the include and import lines (arrows.py).

Strategy: one function per rule returns the offences it finds; the tests run it over the real files,
and once over made-up lines to see that it can fail. Not tested: links beyond cpp/CMakeLists.txt.
"""

import re
import subprocess
import sys
from collections.abc import Iterable
from pathlib import Path

import pytest

from arrows import (
    INCLUDE,
    ROOM_HEADER,
    circle,
    file_arrows,
    imports,
    module_arrows,
    module_files,
    upward,
)

# C++: room -> the rooms that it may include beside itself
ARROWS: dict[str, set[str]] = {
    "base": set(),
    "solver": {"base"},
    "robot": {"base"},
    "tasks": {"robot", "base"},
    "control": {"tasks", "solver", "robot", "base"},
    "sim": {"control", "robot", "base"},
    "mission": {"sim", "control", "robot", "base"},
}
# where mujoco.h may be included
PHYSICS = {"robot", "sim"}

# the parts of the Python packages from the ground up: each may import what stands on lower floors
FLOORS: tuple[set[str], ...] = (
    {"hurcules." + name for name in (
        "_core", "_exec", "_moved", "decimate", "extras", "figures", "legend",
        "opengl", "outlet", "plugins", "running_gear", "shares", "workers",
    )},
    {"hurcules." + name for name in (
        "interrupts", "jacobian_check", "mission_drawing", "output", "toml_rows", "validation",
    )},
    {"hurcules." + name for name in (
        "_pickles", "_reprs", "_subclasses", "_version", "casualties", "detour", "mission_options",
        "mission_table", "motors", "postures", "rendering", "rhqp", "sensors",
        "start_checks", "support", "urdf_shapes",
    )},
    {"hurcules." + name for name in (
        "cameras", "drawing", "mjcf", "urdf", "video",
    )},
    {"hurcules.scenes", "hurcules.transfer_bed"},
    {"hurcules.disposal", "hurcules.lift"},
    {"hurcules.models", "hurcules.table_missions"},
    {"hurcules.doctor", "hurcules.export", "hurcules.simulation"},
    {"hurcules.driving", "hurcules.own_simulation"},
    {"hurcules.view"},
    {"hurcules", "hurcules.recording"},
    {"hurcules.report", "hurcules.summary"},
    {"hurcules.run"},
    {"hurcules.seeds"},
    {"hurcules.cli"},
    {"hurcules_command", "hurcules_envs", "hurcules_studies"},
    {"hurcules.__main__"},
    {"hurcules_studies.field_tests"},
    {"hurcules_studies.thesis"},
)  # fmt: skip
# files that import by a name that is not written there, and what
DYNAMIC = {
    "hurcules._moved": "the new place of a module that has moved, until the next release",
    "hurcules.opengl": "a part of MuJoCo",
    "hurcules_envs.registry": "an environment by the name of its class, as a spec stores it",
    "hurcules_studies.thesis.measures": "the modules of its own folder",
}

LINKS = re.compile(r"^hurcules_room\((\w+) LINKS ([^)]*)\)", re.MULTILINE)
# [T 4.12], [T §3.2], [T alg. 2], [T A.2.9], [S 146]; not a unit such as [N m]
TAG = re.compile(r"\[([A-Z]) (?:§|alg\. ?|[A-Z]\.)?\d[^\]]*\]")


def offences(room: str, file: str, headers: Iterable[str]) -> list[str]:
    """What a file of a room includes although it may not; headers with their quotes or brackets."""
    found = []
    for header in headers:
        target = ROOM_HEADER.fullmatch(header)
        if target and target[1] not in ARROWS[room] | {room}:
            found.append(f"{file}: {room} -> {target[1]} is not allowed ({header})")
        elif header.startswith('"') and not target:
            found.append(f"{file}: {header} is not written from the root, or is in no room")
        elif header.startswith("<mujoco/") and not (room in PHYSICS and file.endswith(".cpp")):
            found.append(f"{file}: {header} belongs into the sources of {sorted(PHYSICS)} only")
    return found


def sources(root: Path) -> list[Path]:
    """Every C++ file of the rooms, those in their folders too."""
    return sorted((root / "cpp" / "hurcules").rglob("*.[ch]pp"))


def room_of(root: Path, file: Path) -> str:
    """The room that a file belongs to."""
    return file.relative_to(root / "cpp" / "hurcules").parts[0]


def test_every_room_exists_and_no_other(root: Path) -> None:
    assert {room_of(root, file) for file in sources(root)} == set(ARROWS)


@pytest.mark.parametrize("room", ARROWS)
def test_a_room_includes_only_what_its_arrows_allow(root: Path, room: str) -> None:
    found = []
    for file in sources(root):
        if room_of(root, file) == room:
            headers = INCLUDE.findall(file.read_text(encoding="utf-8"))
            found += offences(room, str(file.relative_to(root)), headers)
    assert found == []


def test_the_rooms_have_no_circle() -> None:
    assert circle(ARROWS) == []


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


def test_every_arrow_between_python_packages_leads_down(root: Path) -> None:
    arrows = module_arrows(root)
    assert upward(arrows, FLOORS) == []
    assert {name for floor in FLOORS for name in floor} == set(arrows) | {"hurcules._core"}


def test_no_python_modules_import_each_other_in_a_circle(root: Path) -> None:
    arrows = file_arrows(root)
    assert len(arrows) > 100
    assert circle(arrows) == []


def test_imports_by_a_computed_name_are_those_that_are_known(root: Path) -> None:
    files = module_files(root)
    found = {
        name
        for name, path in files.items()
        if any(module == "?" for _, module, _ in imports(path.read_text(encoding="utf-8")))
    }
    assert found == set(DYNAMIC)


def test_the_import_checker_finds_what_is_forbidden() -> None:
    source = (
        "import os\nif os:\n  from a.b import c\ndef f():\n  import a\n"
        "class C:\n  import a.d as e\n"
        "import_module('a.x')\nimportlib.import_module(name)\nfrom . import g\n"
    )
    assert imports(source) == [
        (1, "os", ""),
        (3, "a.b", "c"),
        (5, "a", ""),
        (7, "a.d", ""),
        (8, "a.x", ""),
        (9, "?", ""),
        (10, ".", "g"),
    ]
    assert circle({"a": {"b"}, "b": {"c"}, "c": {"b", "d"}}) == ["b", "c", "b"]
    assert circle({"a": {"b", "c"}, "b": {"c"}}) == []
    floors = ({"a"}, {"b", "c"})
    assert upward({"a": set(), "b": {"a"}, "c": {"a"}}, floors) == []
    assert upward({"a": {"b"}}, floors) == ["a -> b does not lead down"]
    assert upward({"b": {"c"}}, floors) == ["b -> c does not lead down"]
    assert upward({"d": set()}, floors) == ["d stands on no floor"]


def test_an_import_inside_a_function_closes_a_circle(tmp_path: Path) -> None:
    folder = tmp_path / "python" / "hurcules"
    folder.mkdir(parents=True)
    (folder / "models.py").write_text("def load():\n    from hurcules import scenes\n")
    (folder / "scenes.py").write_text("from hurcules.models import load\n")
    assert circle(file_arrows(tmp_path)) == [
        "hurcules.models",
        "hurcules.scenes",
        "hurcules.models",
    ]
    assert upward(module_arrows(tmp_path), ({"hurcules.models"}, {"hurcules.scenes"}))


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
