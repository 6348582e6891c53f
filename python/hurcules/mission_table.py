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

Rows of another table are taken by `[[phase]]` with `include = "lift.toml"` and `rows = ["settle",
"raise"]`: from the first to the second of these. The same trouble in many phases is said once:

    [[monitor]]
    when = "monitor/static_margin_m <= 0.02 for 0.2 s"
    do = ["hold 2 s", "abort"]
    phases = ["turn left", "home"]

A rate may hold a quantity: `{ rate = [0.0005], hold = "load/left_grip_n", at = 230.0, span = 50.0
}`; a lead of many phases is a `[[lead]]` with `channel` and `phases`.

The tracks go to a place by `park = { body = "ordnance_case", ahead = -2.0 }`: the robot's centre of
mass 2 m behind that body, with its heading; without a body counted from where the run began.

A posture is `posture = "CHANNEL"` with `keys = [{ share = 1.0, HIP = 0.3, SP = 1.2 }]`. Quantities
are columns of the log (`simulation.channels`). A `[[figure]]` is a quantity over some phases, with
the bounds that make a run a success.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from hurcules._core import (
    Error,
    Lead,
    Measure,
    MissionSetup,
    MissionTable,
    Park,
    Phase,
    PostureKey,
    Trouble,
    condition,
    reaction,
)
from hurcules.mission_drawing import drawing

__all__ = ["Mission"]

Row = TypeVar("Row")


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

    @classmethod
    def load(cls, path: str | Path) -> Mission:
        """Reads a TOML file.

        Raises:
            Error: no such file, no TOML, an unknown key, a condition or reaction that cannot be
                read; the text says where. What depends on a controller (stacks, channels,
                coordinates, quantities) is checked when a simulation is made.
        """
        try:
            return cls.read(_toml(path), Path(path).parent)
        except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
            raise Error(f"mission file {path}: {error}") from error

    @classmethod
    def read(cls, data: Mapping[str, Any], folder: str | Path = ".") -> Mission:
        """The same from what a TOML file holds.

        Args:
            data: of the file.
            folder: where the files lie whose rows it includes.
        """
        _known(data, ("mission", "phase", "monitor", "lead", "figure"), "mission")
        head = dict(data.get("mission", {}))
        safety, scene = head.pop("safety", ""), head.pop("scene", "")
        if not isinstance(scene, str):
            raise Error(f"scene of [mission]: wanted the name of a mission, got {scene!r}")
        rows = _included(data.get("phase", []), Path(folder))
        _watch(rows, data.get("monitor", []))
        _lead(rows, data.get("lead", []))
        phases = [_phase(row) for row in rows]
        measures = [_of(Measure, row, "figure") for row in data.get("figure", [])]
        table = MissionTable(phases=phases, safety=safety, measures=measures)
        return cls(_of(MissionSetup, head, "[mission]"), table, scene)

    def table(self) -> str:
        """The phases as text, note, conditions and reactions below each."""
        return self.rows.text()

    def drawing(self) -> str:
        """The table as SVG: phases, what ends them, what they watch and where that leads."""
        return drawing(self.rows, self.setup.name)

    def save(self, path: str | Path) -> None:
        """Writes the TOML file that `load` reads.

        Raises:
            Error: the file cannot be written.
        """
        try:
            Path(path).write_text(self.toml(), encoding="utf-8")
        except OSError as error:
            raise Error(f"mission file {path}: {error}") from error

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


_SETUP = (
    "name", "support", "max_seconds", "min_height", "max_tilt", "casualty", "stand_off", "load",
    "container", "container_stand",
)  # fmt: skip
_MEASURE = ("name", "quantity", "take", "phases", "least", "most")
_PARK = ("body", "ahead", "left", "heading", "speed", "yaw_rate")
_PHASE = ("name", "note", "stack", "seconds", "support", "brakes", "posture", "within", "last")


def _toml(path: str | Path) -> dict[str, Any]:
    return tomllib.loads(Path(path).read_text(encoding="utf-8"))


def _included(rows: Sequence[Mapping[str, Any]], folder: Path) -> list[dict[str, Any]]:
    """The rows of the table, those of other files in their place."""
    found: list[dict[str, Any]] = []
    for row in rows:
        if "include" not in row:
            found.append(dict(row))
            continue
        file = row["include"]
        where = f"include of {file!r}"
        _known(row, ("include", "rows"), where)
        there = _included(_toml(folder / file).get("phase", []), folder)
        names = [one.get("name") for one in there]
        ends = row.get("rows", [])
        if len(ends) != 2 or not set(ends) <= set(names):
            raise Error(f"{where}: rows wants the names of two of its phases, got {ends!r}")
        first, last = (names.index(name) for name in ends)
        if first > last:
            raise Error(f"{where}: '{ends[0]}' comes after '{ends[1]}'")
        found += there[first : last + 1]
    return found


def _watch(rows: Sequence[dict[str, Any]], monitors: Sequence[Mapping[str, Any]]) -> None:
    """Each monitor becomes a trouble of each of its phases."""
    for monitor in monitors:
        where = f"monitor {monitor.get('when', '?')!r}"
        _known(monitor, ("when", "do", "phases"), where)
        trouble = {key: value for key, value in monitor.items() if key != "phases"}
        for row in _named(rows, monitor.get("phases", []), where):
            row["trouble"] = [*row.get("trouble", []), trouble]


def _lead(rows: Sequence[dict[str, Any]], leads: Sequence[Mapping[str, Any]]) -> None:
    """Each lead of many phases becomes one of each of them."""
    for lead in leads:
        channel = lead.get("channel", "?")
        where = f"lead of {channel!r}"
        one = {key: value for key, value in lead.items() if key not in ("channel", "phases")}
        for row in _named(rows, lead.get("phases", []), where):
            if channel in row.get("lead", {}):
                raise Error(f"{where}: phase {row.get('name')!r} leads it already")
            row["lead"] = {**row.get("lead", {}), channel: one}


def _named(
    rows: Sequence[dict[str, Any]], names: Sequence[str], where: str
) -> Iterator[dict[str, Any]]:
    """The rows of these names."""
    known = [row.get("name") for row in rows]
    for name in names:
        if name not in known:
            raise Error(f"{where}: no phase {name!r}; there are: {', '.join(map(str, known))}")
        yield rows[known.index(name)]


def _phase(row: Mapping[str, Any]) -> Phase:
    where = f"phase {row.get('name', '?')!r}"
    _known(row, (*_PHASE, "lead", "keys", "park", "done", "late", "trouble"), where)
    leads = [
        _of(Lead, {"channel": name, **lead}, where) for name, lead in row.get("lead", {}).items()
    ]
    keys = []
    for key in row.get("keys", []):
        angles = [(name, float(angle)) for name, angle in key.items() if name != "share"]
        keys.append(PostureKey(share=float(key.get("share", 1.0)), angles=angles))
    troubles = []
    for one in row.get("trouble", []):
        _known(one, ("when", "do"), where)
        reactions = [reaction(text) for text in one.get("do", [])]
        troubles.append(Trouble(when=condition(one.get("when", "")), reactions=reactions))
    values = {name: row[name] for name in _PHASE if name in row}
    return _of(
        Phase,
        {
            **values,
            "leads": leads,
            "keys": keys,
            "park": _of(Park, row["park"], where) if "park" in row else None,
            "done": [condition(text) for text in row.get("done", [])],
            "late": [reaction(text) for text in row.get("late", [])],
            "troubles": troubles,
        },
        where,
    )


def _of(kind: type[Row], values: Mapping[str, Any], where: str) -> Row:
    try:
        return kind(**values)
    except Error as error:
        raise Error(f"{where}: {error}") from error


def _known(row: Mapping[str, Any], names: Sequence[str], where: str) -> None:
    for key in row:
        if key not in names:
            raise Error(f"{where}: no entry '{key}'; there are: {', '.join(names)}")


def _phase_lines(phase: Phase) -> list[str]:
    row = {name: getattr(phase, name) for name in _PHASE}
    lines = _entries(row, Phase(name="", stack=""))
    for lead in phase.leads:
        parts = [f"rate = {_value(lead.rate.tolist())}"] if lead.rate.size else []
        parts += [f"way = {_value(lead.way)}"] if math.isfinite(lead.way) else []
        parts += [f"by = {_value(lead.by.tolist())}"] if lead.by.size else []
        if lead.hold:
            parts.append(f"hold = {_value(lead.hold)}, at = {lead.at!r}, span = {lead.span!r}")
        parts += [f"to = {_value(list(lead.to))}"] if lead.to else []
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
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(_value(one) for one in value) + "]"
    return repr(value)
