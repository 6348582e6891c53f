"""Writes the table of largest settings in docs/field_tests.md from the results in its folder.

Run:  python benchmarks/figures/field_tests.py [FOLDER ...]

Each folder holds a summary.json of `hurcules run METHOD`. Its settings go to
docs/field_tests/METHOD_ROBOT.json, beside others that were kept there, the newest of each.
Seed 0 gives the largest setting; all other seeds, which nothing was made with, are pooled.
Without a folder the page is written again from what is kept.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

from hurcules_studies.field_tests import METHODS, lower_bound
from hurcules_studies.field_tests.page import faults

DOCS = Path(__file__).parents[2] / "docs"

PAGE = DOCS / "field_tests.md"
FOLDER = PAGE.with_suffix("")
BEGIN, END = (
    "<!-- written by a program: benchmarks/figures -->\n",
    "<!-- end of the written part -->\n",
)
ENOUGH = 10  # repetitions from which on a setting counts as passed, and is set in bold
HEAD = (
    "| method | robot | largest setting passed | n | R >= 80 % with | R at 95 % | m/min | kJ/m "
    "| not passed | failed, unseen seeds | R at 95 % |\n"
    "|---|---|---|---|---|---|---|---|---|---|---|\n"
)


def keep(folder: Path) -> None:
    """Takes over the summary of a run."""
    new = json.loads((folder / "summary.json").read_text("utf-8"))
    path = FOLDER / f"{new['mission']}_{new['robot']}.json"
    old = json.loads(path.read_text("utf-8")) if path.exists() else {}
    of_seed = [one | {"seed": new["seed"]} for one in new["settings"]]
    which = "unseen" if new["seed"] else "settings"
    found = {(str(one["setting"]), one.get("seed", 0)): one for one in old.get(which, []) + of_seed}
    settings = sorted(found.values(), key=lambda one: one["setting"] or 0.0)
    kept = {name: new[name] for name in ("mission", "title", "robot", "version")}
    text = json.dumps(old | kept | {which: settings}, indent=1)
    path.write_text(text + "\n", encoding="utf-8")


def table() -> str:
    """The table of all that is kept."""
    kept = [json.loads(path.read_text("utf-8")) for path in sorted(FOLDER.glob("*.json"))]
    names = list(METHODS)
    kept.sort(key=lambda one: (one["robot"] != "rescue", names.index(one["mission"])))
    return HEAD + "".join(f"| {' | '.join(row(one))} |\n" for one in kept)


def row(result: dict[str, Any]) -> list[str]:
    """The line of a method and a robot."""
    passed, failed = best(result["settings"])
    about = [f"`{result['mission']}` {result['title']}", result["robot"]]
    fell = "-" if failed is None else f"{failed['shown']}: {failures(failed)}"
    if passed is None:
        return [*about, "**none**", "", "", "", "", "", fell, "", ""]
    enough = passed["repetitions"] >= ENOUGH
    return [
        *about,
        f"**{passed['shown']}**" if enough else passed["shown"],
        str(passed["repetitions"]),
        f"{100 * passed['confidence_80']:.0f} %",
        f"{100 * passed['lower_bound_95']:.0f} %",
        f"{passed['metres_per_minute']:.0f}",
        f"{passed['drive_energy_per_metre'] / 1000:.2f}",
        fell,
        *pooled(result.get("unseen", []), passed["setting"]),
    ]


def best(settings: list[dict[str, Any]]) -> tuple[dict[str, Any] | None, dict[str, Any] | None]:
    """The hardest setting below the first that was not passed, and that one."""
    passed = None
    for one in settings:
        if one["failures"]:
            return passed, one
        passed = one
    return passed, None


def pooled(unseen: list[dict[str, Any]], setting: float | None) -> list[str]:
    """Of a setting on the seeds that nothing was made with: "1 of 20 (1 stuck)", and R."""
    runs = [one for one in unseen if one["setting"] == setting]
    if not runs:
        return ["", ""]
    n, failed = (sum(one[name] for one in runs) for name in ("repetitions", "failures"))
    kinds = faults({"faults": [fault for one in runs for fault in one["faults"]]})
    return [
        f"{failed} of {n}" + (f" ({kinds})" if failed else ""),
        f"{100 * lower_bound(n, failed):.0f} %",
    ]


def failures(setting: dict[str, Any]) -> str:
    """How a setting was failed: "3 of 10, 2 stuck, 1 tip-over"."""
    return f"{setting['failures']} of {setting['repetitions']} ({faults(setting)})"


def written(page: str) -> str:
    """The page with the table in its place."""
    before, rest = page.split(BEGIN)
    return before + BEGIN + table() + END + rest.split(END)[1]


def main() -> None:
    """Keeps new results and writes the page."""
    FOLDER.mkdir(exist_ok=True)
    for folder in sys.argv[1:]:
        keep(Path(folder))
    PAGE.write_text(written(PAGE.read_text("utf-8")), encoding="utf-8")


if __name__ == "__main__":
    main()
