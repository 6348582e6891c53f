"""Missions as data: a TOML file of phases, conditions and reactions, and back.

    [mission]
    name = "wave"
    scene = "lift"              # of which mission model and controller are; by default of this name
    safety = "lower"            # the phase that the reaction "lower" goes to

    [[phase]]
    name = "reach"
    stack = "arms"
    note = "hands forward"      # for the printed table and the film
    seconds = 2.0               # that ways (`by`) and postures take, the least duration
    lead.hand = { by = [0.1, 0.0, 0.0] }             # or { rate = [...], way = 0.2 }
    # or { by = [0.0, 0.0, 0.1], to = ["load/left_hand_ahead_m", "", ""] }: and by what is seen then
    done = ["mission/force/hand <= -2.5 for 0.3 s"]  # all of them
    within = 10.0
    late = ["hold 2 s", "back to reach, 2 times", "abort"]
    trouble = [{ when = "monitor/static_margin_m <= 0.03", do = ["lower"] }]
    next = "rest"               # goes on there when it is done, not to the row below

Rows of another table are taken by `[[phase]]` with `include = "lift.toml"` and `rows = ["settle",
"raise"]`: from the first to the second of these, with what watches them there. The same trouble in
many phases is said once:

    [[monitor]]
    when = "monitor/static_margin_m <= 0.02 for 0.2 s"
    do = ["hold 2 s", "abort"]
    phases = ["turn left", "home"]

A rate may hold a quantity: `{ rate = [0.0005], hold = "load/left_grip_n", at = 230.0, span = 50.0
}`, with `brake = true` borne by the brakes of its joints; a lead of many phases is a `[[lead]]`
with `channel` and `phases`.

The tracks go to a place by `park = { body = "ordnance_case", ahead = -2.0 }`: the robot's centre of
mass 2 m behind that body, with its heading; without a body counted from where the run began.

A posture is `posture = "CHANNEL"` with `keys = [{ share = 1.0, HIP = 0.3, SP = 1.2 }]`. Quantities
are columns of the log (`simulation.channels`). A `[[figure]]` is a quantity over some phases, with
the bounds that make a run a success; `include = "casualty.toml"` with `names` takes those of
another table.
"""

from __future__ import annotations

import json
import math
import tomllib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco

from hurcules._core import (
    Condition,
    Error,
    Lead,
    Measure,
    MissionSetup,
    MissionTable,
    Park,
    Phase,
    PostureKey,
    Reaction,
    Trouble,
    check_rows,
    table_lines,
)
from hurcules.mission_drawing import drawing
from hurcules.output import compiled, whole, write_whole, writing
from hurcules.toml_rows import Kind, take, typed
from hurcules.validation import require_known, told_at

__all__ = ["Mission"]

Row = dict[str, Any]


@dataclass(frozen=True)
class Mission:
    """A mission as data: what it wants of its run, and its table.

    Attributes:
        setup: hurcules.MissionSetup.
        rows: hurcules.MissionTable.
        scene: of which mission the model and the controller are, for a run by the path of its file;
            "": of the one that has its name.
    """

    setup: MissionSetup
    rows: MissionTable
    scene: str = ""

    def __post_init__(self) -> None:
        """Checks the types."""
        for name, kind in (("setup", MissionSetup), ("rows", MissionTable)):
            if not isinstance(value := getattr(self, name), kind):
                came = type(value).__name__
                raise Error(f"Mission: {name} wants a {kind.__name__}, got a {came}")

    @classmethod
    def load(cls, path: str | Path) -> Mission:
        """Reads a TOML file.

        Raises:
            Error: no such file, no TOML, an unknown entry, a value of another type, a condition or
                reaction that cannot be read, phases, reactions, time-outs or ways that do not fit
                (`docs/loop.md`); the text says file and row. What depends on a controller (stacks,
                channels, coordinates, quantities) is checked when a simulation is made.
        """
        data = _toml(path)
        with told_at(str(path)):
            return cls.read(data, Path(path).parent, (Path(path).resolve(),))

    @classmethod
    def read(
        cls, data: Mapping[str, Any], folder: str | Path = ".", files: tuple[Path, ...] = ()
    ) -> Mission:
        """The same from what a TOML file holds.

        Args:
            data: of the file.
            folder: where the files lie whose rows it includes.
            files: it comes from, which it cannot include.
        """
        given = take(data, _FILE)
        head = take(given.get("mission", {}), _HEAD, "[mission]", ["name"])
        safety, scene = head.pop("safety", ""), head.pop("scene", "")
        rows = _included(given.get("phase", []), Path(folder), files)
        _watch(rows, given.get("monitor", []))
        _lead(rows, given.get("lead", []))
        phases = [_phase(row, where) for where, row in rows]
        figures = _figures(given.get("figure", []), Path(folder))
        measures = [_measure(row, k) for k, row in enumerate(figures, 1)]
        table = MissionTable(phases=phases, safety=safety, measures=measures)
        check_rows(table)
        _warn_of_unreached(table)
        return cls(MissionSetup(**head), table, scene)

    def table(self) -> str:
        """The phases as text, note, conditions and reactions below each."""
        return self.rows.text()

    def drawing(self) -> str:
        """The table as SVG: phases, what ends them, what they watch and where that leads."""
        return drawing(self.rows, self.setup.name)

    def save(self, path: str | Path) -> None:
        """Writes the TOML file that `load` reads.

        Raises:
            WriteError: the file cannot be written.
        """
        write_whole(Path(path), self.toml().encode())

    def save_table(self, path: str | Path, model: mujoco.MjModel, controller: str = "own") -> None:
        """Writes the table as C++ reads it, and the compiled model beside it.

        `hurcules::read_table` and `load_model_of` take them to a program of your own, which makes
        the controller: stacks and channels of the names that the table uses.

        Args:
            path: of the table; the model has its name with the ending `.mjb`.
            model: the scene.
            controller: what `hurcules-sim` makes it by; a name of your own is for your program.

        Raises:
            Error: a file of another ending.
            WriteError: a file cannot be written.
        """
        path = Path(path)
        require_known("kind of file", path.suffix, [".table"])
        beside, contents = path.with_suffix(".mjb"), compiled(model)
        text = table_lines(self.setup, self.rows, controller, beside.name, contents)
        with writing(path), whole(path) as part:  # there once its model is
            part.write_text(text, encoding="utf-8")
            write_whole(beside, contents)

    def toml(self) -> str:
        """The text of that file."""
        setup = {name: getattr(self.setup, name) for name in _SETUP}
        lines = ["[mission]", *_entries(setup, MissionSetup(name=""))]
        if self.scene:
            lines.append(f"scene = {_value(self.scene)}")
        if self.rows.safety:
            lines.append(f"safety = {_value(self.rows.safety)}")
        for phase in self.rows.phases:
            lines += ["", "[[phase]]", *_phase_lines(phase)]
        for measure in self.rows.measures:
            row = {name: getattr(measure, name) for name in _MEASURE}
            lines += ["", "[[figure]]", *_entries(row, Measure(name="", quantity=""))]
        return "\n".join(lines) + "\n"


_SETUP: Mapping[str, Kind] = {
    "name": str,
    "support": str,
    "max_seconds": float,
    "min_height": float,
    "max_tilt": float,
    "fall_frame": str,
    "casualty": str,
    "stand_off": float,
    "load": str,
    "container": str,
    "container_stand": float,
}
_HEAD = {**_SETUP, "safety": str, "scene": str}
_MEASURE: Mapping[str, Kind] = {
    "name": str,
    "quantity": str,
    "take": str,
    "phases": [str],
    "least": float,
    "most": float,
}
_PARK: Mapping[str, Kind] = {
    "body": str,
    "ahead": float,
    "left": float,
    "heading": float,
    "speed": float,
    "yaw_rate": float,
}
_LEAD: Mapping[str, Kind] = {
    "rate": [float],
    "way": float,
    "by": [float],
    "to": [str],
    "hold": str,
    "at": float,
    "span": float,
    "value": [float],
    "follow": bool,
    "brake": bool,
}
_TROUBLE: Mapping[str, Kind] = {"when": str, "do": [str]}
_PHASE: Mapping[str, Kind] = {
    "name": str,
    "note": str,
    "stack": str,
    "seconds": float,
    "support": str,
    "brakes": [str],
    "posture": str,
    "within": float,
    "next": str,
    "last": bool,
}
_ROW = {
    **_PHASE,
    "lead": dict,
    "keys": [dict],
    "park": dict,
    "done": [str],
    "late": [str],
    "trouble": [dict],
}
_FILE: Mapping[str, Kind] = {
    "mission": dict,
    "phase": [dict],
    "monitor": [dict],
    "lead": [dict],
    "figure": [dict],
}


def _toml(path: str | Path) -> dict[str, Any]:
    try:
        return tomllib.loads(Path(path).read_text(encoding="utf-8-sig"))
    except OSError as error:
        known = "; one that comes along: hurcules.lift.mission(), or hurcules mission lift"
        raise Error(f"mission file {path}: {error.strerror}{known}") from error
    except (UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise Error(f"mission file {path}: {error}") from error


def _included(
    rows: Sequence[Row], folder: Path, files: tuple[Path, ...], prefix: str = ""
) -> list[tuple[str, Row]]:
    """The rows of the table, those of other files in their place; before each where it stands."""
    found: list[tuple[str, Row]] = []
    for k, row in enumerate(rows, 1):
        if "include" in row:
            found += _of_file(row, f"{prefix}phase {k}", folder, files)
            continue
        if not row.get("name"):
            raise Error(f"{prefix}phase {k} wants a name")
        name = typed(row["name"], str, f"{prefix}phase {k}, name")
        if name in _names(found):
            raise Error(f"{prefix}two phases are called '{name}'")
        found.append((f"{prefix}phase '{name}'", dict(row)))
    return found


def _of_file(row: Row, where: str, folder: Path, files: tuple[Path, ...]) -> list[tuple[str, Row]]:
    given = take(row, {"include": str, "rows": [str]}, where, ["include", "rows"])
    file, ends = folder / given["include"], given["rows"]
    where = f"{where}, include of '{given['include']}'"
    if file.resolve() in files:
        raise Error(f"{where}: the file includes itself")
    with told_at(where):
        data = take(_toml(file), _FILE)
    files = (*files, file.resolve())
    there = _included(data.get("phase", []), file.parent, files, f"{given['include']}, ")
    with told_at(where):
        _watch(there, data.get("monitor", []))
        _lead(there, data.get("lead", []))
    names = _names(there)
    if len(ends) != 2 or not set(ends) <= set(names):
        known = ", ".join(names)
        raise Error(
            f"{where}: rows wants the names of two of its phases, got {ends!r}; there are: {known}"
        )
    first, last = (names.index(name) for name in ends)
    if first > last:
        raise Error(f"{where}: '{ends[0]}' comes after '{ends[1]}'")
    return there[first : last + 1]


def _names(rows: Sequence[tuple[str, Row]]) -> list[str]:
    return [row["name"] for _, row in rows]


def _watch(rows: Sequence[tuple[str, Row]], monitors: Sequence[Row]) -> None:
    """Each monitor becomes a trouble of each of its phases."""
    for k, monitor in enumerate(monitors, 1):
        where = f"monitor {monitor.get('when', k)!r}"
        trouble = take(monitor, {**_TROUBLE, "phases": [str]}, where, ["when", "do", "phases"])
        for place, row in _named(rows, trouble.pop("phases"), where):
            own = typed(row.get("trouble", []), [dict], f"{place}, trouble")
            row["trouble"] = [*own, trouble]


def _lead(rows: Sequence[tuple[str, Row]], leads: Sequence[Row]) -> None:
    """Each lead of many phases becomes one of each of them."""
    for k, lead in enumerate(leads, 1):
        where = f"lead of {lead.get('channel', k)!r}"
        kinds = {**_LEAD, "channel": str, "phases": [str]}
        one = take(lead, kinds, where, ["channel", "phases"])
        channel = one.pop("channel")
        for place, row in _named(rows, one.pop("phases"), where):
            own = typed(row.get("lead", {}), dict, f"{place}, lead")
            if channel in own:
                raise Error(f"{where}: {place} leads it already")
            row["lead"] = {**own, channel: one}


def _named(
    rows: Sequence[tuple[str, Row]], names: Sequence[str], where: str
) -> Iterator[tuple[str, Row]]:
    """The rows of these names, one at least."""
    known = _names(rows)
    if not names:
        raise Error(f"{where}: phases names none; there are: {', '.join(known)}")
    for name in names:
        if name not in known:
            raise Error(f"{where}: no phase {name!r}; there are: {', '.join(known)}")
        yield rows[known.index(name)]


def _phase(row: Row, where: str) -> Phase:
    given = take(row, _ROW, where, ["stack"])
    leads = [
        Lead(channel=name, **take(lead, _LEAD, f"{where}, lead.{name}"))
        for name, lead in given.pop("lead", {}).items()
    ]
    keys = []
    for key in given.pop("keys", []):
        angles = [(name, typed(one, float, f"{where}, keys, {name}")) for name, one in key.items()]
        share = dict(angles).get("share", 1.0)
        keys.append(PostureKey(share=share, angles=[one for one in angles if one[0] != "share"]))
    troubles = []
    for trouble in given.pop("trouble", []):
        place = f"{where}, trouble"
        one = take(trouble, _TROUBLE, place, ["when", "do"])
        with told_at(place):
            reactions = [Reaction.read(text) for text in one["do"]]
            troubles.append(Trouble(when=Condition.read(one["when"]), reactions=reactions))
    park = Park(**take(given.pop("park"), _PARK, f"{where}, park")) if "park" in given else None
    with told_at(f"{where}, done"):
        done = [Condition.read(text) for text in given.pop("done", [])]
    with told_at(f"{where}, late"):
        late = [Reaction.read(text) for text in given.pop("late", [])]
    return Phase(
        **given, leads=leads, keys=keys, park=park, done=done, late=late, troubles=troubles
    )


def _figures(rows: Sequence[Row], folder: Path) -> list[Row]:
    """The figures of the table, those of other files in their place."""
    found: list[Row] = []
    for k, row in enumerate(rows, 1):
        if "include" not in row:
            found.append(row)
            continue
        where = f"figure {k}"
        given = take(row, {"include": str, "names": [str]}, where, ["include", "names"])
        where = f"{where}, include of '{given['include']}'"
        with told_at(where):
            there = take(_toml(folder / given["include"]), _FILE).get("figure", [])
        named = {one["name"]: one for one in there if "name" in one}
        for name in given["names"]:
            require_known(f"{where}: figure", name, named)
            found.append(named[name])
    return found


def _measure(row: Row, number: int) -> Measure:
    where = f"figure {row.get('name', number)!r}"
    given = take(row, _MEASURE, where, ["name", "quantity"])
    with told_at(where):
        return Measure(**given)


def _warn_of_unreached(table: MissionTable) -> None:
    """Rows behind the last one that no reaction leads to; `Simulation.go` may, by hand."""
    phases = table.phases
    names = [phase.name for phase in phases]
    reached: set[str] = set()
    ahead = [0, *(k for k, name in enumerate(names) if name == table.safety)]
    while ahead:
        k = ahead.pop()
        if k == len(phases) or names[k] in reached:
            continue
        phase = phases[k]
        reached.add(names[k])
        if not phase.last:
            ahead.append(names.index(phase.next) if phase.next else k + 1)
        reactions = [*phase.late, *(one for each in phase.troubles for one in each.reactions)]
        ahead += [names.index(one.phase) for one in reactions if one.phase]
    if left := [name for name in names if name not in reached]:
        warnings.warn(
            f"phase {left[0]!r} is never reached: no phase before it goes on, and no reaction goes "
            f"there{f'; nor are {len(left) - 1} others' * (len(left) > 1)}",
            stacklevel=3,
        )


def _phase_lines(phase: Phase) -> list[str]:
    row = {name: getattr(phase, name) for name in _PHASE}
    lines = _entries(row, Phase(name="", stack=""))
    for lead in phase.leads:
        parts = [f"rate = {_value(lead.rate.tolist())}"] if lead.rate.size else []
        parts += [f"way = {_value(lead.way)}"] if math.isfinite(lead.way) else []
        parts += [f"by = {_value(lead.by.tolist())}"] if lead.by.size else []
        if lead.hold:
            parts.append(f"hold = {_value(lead.hold)}, at = {lead.at!r}, span = {lead.span!r}")
        parts += ["brake = true"] if lead.brake else []
        parts += [f"value = {_value(lead.value.tolist())}"] if lead.value.size else []
        parts += [f"to = {_value(list(lead.to))}"] if lead.to else []
        parts += ["follow = true"] if lead.follow else []
        lines.append(f"lead.{lead.channel} = {{ {', '.join(parts)} }}")
    if phase.keys:
        lines.append("keys = [")
        for key in phase.keys:
            angles = ", ".join(f"{name} = {_value(angle)}" for name, angle in key.angles)
            lines.append(f"  {{ share = {_value(key.share)}, {angles} }},")
        lines.append("]")
    if phase.park is not None:
        where = {name: getattr(phase.park, name) for name in _PARK}
        lines.append(f"park = {{ {', '.join(_entries(where, Park()))} }}")
    if phase.done:
        lines.append(f"done = {_value([one.words() for one in phase.done])}")
    if phase.late:
        lines.append(f"late = {_value([one.words() for one in phase.late])}")
    if phase.troubles:
        lines.append("trouble = [")
        for trouble in phase.troubles:
            when = _value(trouble.when.words())
            do = _value([one.words() for one in trouble.reactions])
            lines.append(f"  {{ when = {when}, do = {do} }},")
        lines.append("]")
    return lines


def _entries(values: Mapping[str, Any], defaults: object) -> list[str]:
    """Lines of what differs from the defaults."""
    return [
        f"{name} = {_value(value)}"
        for name, value in values.items()
        if value != getattr(defaults, name)
    ]


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")  # as TOML has it
    if isinstance(value, list):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    return repr(value)
