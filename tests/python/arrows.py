"""Reads which part of the code uses which: include lines of C++, import statements of Python.

A room is a folder of cpp/hurcules; a module is a module or package right below a Python package.
Imports count wherever they stand, also inside functions and under TYPE_CHECKING.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterable, Mapping
from pathlib import Path

# package -> its folder; those of the second line are told apart by their parts
PACKAGES = {
    "hurcules": "python/hurcules",
    "hurcules_studies": "python/hurcules_studies",
    "hurcules_envs": "envs/hurcules_envs",
}
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"][^>"]+[>"])', re.MULTILINE)
ROOM_HEADER = re.compile(r'"hurcules/(\w+)/\w+\.hpp"')


def imports(source: str) -> list[tuple[int, str, str]]:
    """Every import of a source: line, module, and the name that is imported from it or "".

    `import_module` and `__import__` count when they are given a text; what they are given else is
    reported as the module "?".
    """
    found = []
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.Import):
            found += [(node.lineno, alias.name, "") for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            module = "." * node.level + (node.module or "")
            found += [(node.lineno, module, alias.name) for alias in node.names]
        elif isinstance(node, ast.Call) and _called(node) in ("import_module", "__import__"):
            given = node.args[0] if node.args else None
            literal = isinstance(given, ast.Constant) and isinstance(given.value, str)
            found.append((node.lineno, str(given.value) if literal else "?", ""))
    return sorted(found)


def _called(node: ast.Call) -> str:
    return getattr(node.func, "attr", getattr(node.func, "id", ""))


def module_files(root: Path) -> dict[str, Path]:
    """The Python files of all packages by dotted name; a package is its __init__.py."""
    files = {}
    for package, folder in PACKAGES.items():
        for path in sorted((root / folder).rglob("*.py")):
            parts = path.relative_to(root / folder).with_suffix("").parts
            name = ".".join([package, *parts]).removesuffix(".__init__")
            files[name] = path
    return files


def file_arrows(root: Path) -> dict[str, set[str]]:
    """Which Python file imports which, by dotted names; compiled modules have no file."""
    files = module_files(root)
    arrows: dict[str, set[str]] = {}
    for name, path in files.items():
        targets = set()
        for _, module, imported in imports(path.read_text(encoding="utf-8")):
            inner = f"{module}.{imported}"
            target = inner if inner in files or inner == "hurcules._core" else module
            if target.split(".")[0] in PACKAGES:
                targets.add(target)
        arrows[name] = targets - {name}
    return arrows


def part(name: str) -> str:
    """The part of the architecture that a dotted name belongs to."""
    package, _, rest = name.partition(".")
    if package == "hurcules_envs":
        return package
    return f"{package}.{rest.split('.')[0]}" if rest else package


def module_arrows(root: Path) -> dict[str, set[str]]:
    """Which part of the Python packages imports which."""
    arrows: dict[str, set[str]] = {}
    for name, targets in file_arrows(root).items():
        mine = part(name)
        arrows.setdefault(mine, set()).update({part(target) for target in targets} - {mine})
    return arrows


def room_files(root: Path) -> dict[str, list[Path]]:
    """The C++ files of each room."""
    files: dict[str, list[Path]] = {}
    for path in sorted((root / "cpp" / "hurcules").glob("*/**/*.[ch]pp")):
        files.setdefault(path.relative_to(root / "cpp" / "hurcules").parts[0], []).append(path)
    return files


def room_arrows(root: Path) -> dict[str, set[str]]:
    """Which room includes which."""
    return {
        room: {
            target[1]
            for path in files
            for header in INCLUDE.findall(path.read_text(encoding="utf-8"))
            if (target := ROOM_HEADER.fullmatch(header))
        }
        - {room}
        for room, files in room_files(root).items()
    }


def circle(arrows: Mapping[str, Iterable[str]]) -> list[str]:
    """The names along a circle, its first one again at the end; [] without one."""
    finished: set[str] = set()

    def follow(way: list[str]) -> list[str]:
        for target in sorted(arrows.get(way[-1], ())):
            if target in way:
                return [*way[way.index(target) :], target]
            if target not in finished and (found := follow([*way, target])):
                return found
        finished.add(way[-1])
        return []

    for name in sorted(arrows):
        if name not in finished and (found := follow([name])):
            return found
    return []


def upward(arrows: Mapping[str, Iterable[str]], floors: Iterable[Iterable[str]]) -> list[str]:
    """The arrows that do not lead to a lower floor, and the names that stand on none."""
    height = {name: level for level, floor in enumerate(floors) for name in floor}
    found = [f"{name} stands on no floor" for name in sorted(arrows) if name not in height]
    for name, targets in sorted(arrows.items()):
        for target in sorted(targets):
            if height.get(target, -1) >= height.get(name, len(height)):
                found.append(f"{name} -> {target} does not lead down")
    return found
