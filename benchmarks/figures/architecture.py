"""Writes docs/architecture.md: the modules, what uses what, and how large they are.

Read from the include and import lines (tests/python/arrows.py); an arrow that follows from others
is left out of the pictures.

Run:  python benchmarks/figures/architecture.py            writes the page
      python benchmarks/figures/architecture.py --check    exit status 1 when it is out of date
"""

from __future__ import annotations

import argparse
import difflib
import re
import sys
from collections.abc import Iterable, Mapping
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "python"))

from arrows import module_arrows, module_files, part, room_arrows, room_files  # noqa: E402

PAGE = ROOT / "docs" / "architecture.md"
NUMBER = re.compile(r"\d+(?:\.\d+)?")
HEAD = """# Architecture

Drawn from the include and import lines by `python benchmarks/figures/architecture.py`. An arrow
leads to what is used; one that follows from others is left out. Sizes are thousands of lines (k),
without tests. `tests/python/test_layers.py` says which arrows may exist.

"""
# the modules of a Python package as one box each; those not named stand for themselves
BOXES = {
    "foundations": (
        "_core", "_exec", "_moved", "_version", "decimate", "figures", "interrupts", "opengl",
        "outlet", "output", "plugins", "running_gear", "shares", "validation", "workers",
    ),
    "models": ("mjcf", "models", "scenes", "casualties", "transfer_bed"),
    "simulation": ("driving", "own_simulation", "postures", "sensors", "simulation"),
    "pictures": ("cameras", "rendering", "video"),
    "results": ("recording", "report", "summary"),
    "command line": ("cli", "doctor", "run", "seeds"),
}  # fmt: skip
ABOUT = {
    "base": "types, errors, state",
    "solver": "prioritised least squares under linear constraints",
    "robot": "any MJCF robot: coordinates, frames, Jacobians, dynamics",
    "tasks": "what is measured and wanted",
    "control": "stacks of tasks, control laws, joint servo, drive",
    "mission": "phases of a mission",
    "sim": "physics, sensors, monitors, the closed loop",
}


def reduced(arrows: Mapping[str, Iterable[str]]) -> dict[str, list[str]]:
    """The arrows without those that a longer way makes needless."""

    def reach(name: str) -> set[str]:
        found, rest = set(), [name]
        while rest:
            new = set(arrows.get(rest.pop(), ())) - found
            found |= new
            rest += new
        return found

    return {
        name: sorted(t for t in targets if not any(t in reach(o) for o in targets if o != t))
        for name, targets in arrows.items()
    }


def boxed(arrows: Mapping[str, Iterable[str]]) -> dict[str, set[str]]:
    """The arrows between boxes."""
    found: dict[str, set[str]] = {}
    for name, targets in arrows.items():
        found.setdefault(box(name), set()).update({box(target) for target in targets})
    return {name: targets - {name} for name, targets in found.items()}


def box(name: str) -> str:
    """The box that a part of the Python packages is drawn in."""
    package, _, module = name.partition(".")
    inner = next((title for title, names in BOXES.items() if module in names), module)
    return f"{package}.{inner}" if inner else package


def thousands(files: Iterable[Path]) -> str:
    """Their lines: "1.2 k"."""
    lines = sum(len(path.read_text(encoding="utf-8").splitlines()) for path in files)
    return f"{lines / 1000:.1f} k"


def diagram(arrows: Mapping[str, Iterable[str]], sizes: Mapping[str, str]) -> str:
    """A mermaid picture."""
    key = {name: re.sub(r"\W", "_", name) for name in sizes}
    lines = [f'  {key[name]}["{name}<br>{size}"]' for name, size in sizes.items()]
    for name, targets in sorted(reduced(arrows).items()):
        lines += [f"  {key[name]} --> {key[target]}" for target in targets]
    return "```mermaid\nflowchart TD\n" + "\n".join(lines) + "\n```\n"


def page() -> str:
    """The whole page."""
    rooms = room_files(ROOT)
    text = HEAD + "## C++ library\n\n"
    text += diagram(room_arrows(ROOT), {room: thousands(rooms[room]) for room in rooms})
    text += "\n| module | files | lines | holds |\n|---|---|---|---|\n"
    for room, files in rooms.items():
        about = ABOUT.get(room, "")
        text += f"| `cpp/hurcules/{room}` | {len(files)} | {thousands(files)} | {about} |\n"
    text += "\n## Python packages\n\n"
    inside: dict[str, list[Path]] = {}
    for name, path in module_files(ROOT).items():
        inside.setdefault(box(part(name)), []).append(path)
    text += diagram(boxed(module_arrows(ROOT)), {name: thousands(inside[name]) for name in inside})
    text += "\n| box | modules |\n|---|---|\n"
    parts = sorted({part(name) for name in module_files(ROOT)} | {"hurcules._core"})
    for title in sorted(inside):
        mine = [f"`{name}`" for name in parts if box(name) == title]
        text += f"| {title} | {', '.join(mine)} |\n"
    return text


def outdated(old: str, new: str) -> list[str]:
    """The lines that differ; a tenth, 0.3 k and two files are no difference."""
    olds, news = old.splitlines(), new.splitlines()
    shapes = [[NUMBER.sub("#", line) for line in lines] for lines in (olds, news)]
    if shapes[0] != shapes[1]:
        return list(difflib.unified_diff(*shapes, lineterm="", n=0))[2:]
    return [
        f"{one}: {a} is now {b}"
        for one, other in zip(olds, news, strict=True)
        for a, b in zip(NUMBER.findall(one), NUMBER.findall(other), strict=True)
        if abs(float(a) - float(b)) > max(0.3 if "." in a else 2, 0.1 * float(b))
    ]


def main() -> None:
    """Writes or checks the page."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    parser.add_argument("--check", action="store_true")
    if not parser.parse_args().check:
        PAGE.write_text(page(), encoding="utf-8")
    elif found := outdated(PAGE.read_text(encoding="utf-8"), page()):
        raise SystemExit("\n".join([f"{PAGE}: not up to date; remedy: make architecture", *found]))


if __name__ == "__main__":
    main()
