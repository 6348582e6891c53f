"""A mission's table as a drawing in SVG, the same text for the same table.

From left to right there are boxes, lanes, bars and texts. A box is a phase: its stack and time,
what it is for, what it waits for. A lane is a way to another phase, from every trouble that takes
it, and from a phase that goes on there when it is done. A bar joins phases that watch the same
condition, and its text says that condition and the reactions to it, one after the other.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from xml.sax.saxutils import escape

from hurcules._core import Condition, MissionTable, Phase, Reaction

__all__ = ["drawing"]

# [px]
LINE, PAD, GAP = 13, 5, 10  # of text; inside a box; between two
BOX, LEFT = 380, 16  # width, and where it begins
PITCH = 12  # between lanes, and between bars
LETTER, LETTERS = 5.9, 58  # mean width; as many in a line of a box
HEAD = 3 * LINE + GAP  # above the first box
JUMP, WAIT, END = "#1f6fb2", "#c77700", "#b3261e"
LANES = ("#00838f", "#2e7d32", "#7b3fa0", "#37474f", "#6d4c41", "#ad1457")
KEY = ((JUMP, "goes to another phase"), (WAIT, "stands still, asks"), (END, "the run ends"))
STYLE = (
    "text { font: 11px Helvetica, Arial, sans-serif; fill: #222 } "
    ".name { font-weight: bold } .soft { fill: #666 }"
)


@dataclass(frozen=True)
class Watch:
    """What phases from `first` to `last` look at, and what they do about it."""

    when: str
    reactions: Sequence[Reaction]
    first: int
    last: int

    @property
    def text(self) -> str:
        """The condition and the reactions."""
        return f"{self.when}: {', '.join(_reaction(one) for one in self.reactions)}"

    @property
    def colour(self) -> str:
        """Blue where it may go to another phase, orange where it waits, red where it only ends."""
        kinds = [one.kind for one in self.reactions]
        if "lower" in kinds or "back" in kinds:
            return JUMP
        return WAIT if {"hold", "ask"} & set(kinds) else END


def drawing(table: MissionTable, title: str) -> str:
    """The table as SVG.

    Args:
        table: of a mission.
        title: what stands above it.
    """
    return "\n".join([*_Sheet(table, title).lines(), ""])


class _Sheet:
    """Where everything stands."""

    def __init__(self, table: MissionTable, title: str) -> None:
        self.phases, self.title = table.phases, title
        self.place = {phase.name: k for k, phase in enumerate(self.phases)}
        self.safety = table.safety
        self.watches = list(_watches(self.phases))
        self.ahead = {k: self.place[one.next] for k, one in enumerate(self.phases) if one.next}
        jumps = {to for one in self.watches for to in self._targets(one)}
        self.targets = sorted(jumps | set(self.ahead.values()))
        self.top, self.bottom = self._rows()
        self.bars = _columns(self.watches)
        self.lane_x = LEFT + BOX + 22
        self.bar_x = self.lane_x + PITCH * len(self.targets) + 4
        self.text_x = self.bar_x + PITCH * (max(self.bars, default=0) + 1) + 2
        longest = max((len(one.text) for one in self.watches), default=0)
        self.width = self.text_x + LETTER * max(longest, 20) + LEFT

    def lines(self) -> Iterator[str]:
        """The whole drawing."""
        width, height = round(self.width), self.bottom[-1] + 2 * LINE
        size = f'width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
        yield f'<svg xmlns="http://www.w3.org/2000/svg" {size}>'
        yield f"<style>{STYLE}</style>"
        yield f'<rect width="{width}" height="{height}" fill="white"/>'
        yield from self._head()
        for k in range(len(self.phases)):
            yield from self._box(k)
        for column, watch in zip(self.bars, self.watches, strict=True):
            x = self.bar_x + PITCH * column
            span = self.bottom[watch.last] - PAD
            yield _line([(x, self.top[watch.first] + PAD), (x, span)], watch.colour, 3)
        for k, target in enumerate(self.targets):
            yield from self._lane(k, target)
        for column, watch, y in zip(self.bars, self.watches, self._heights(), strict=True):
            x = self.bar_x + PITCH * column
            yield _line([(x, y), (self.text_x - 3, y)], watch.colour, 1)
            yield _text(self.text_x, y + 4, watch.text)
        yield "</svg>"

    def _head(self) -> Iterator[str]:
        y = LINE + PAD
        yield _text(LEFT, y, self.title, "name")
        yield _text(LEFT, y + LINE, "phase, and what it waits for", "soft")
        yield _text(
            self.text_x, y + LINE, "what the phases beside a bar watch: what is done", "soft"
        )
        x = self.text_x
        for colour, words in KEY:
            yield _line([(x, y - 4), (x + 14, y - 4)], colour, 3)
            yield _text(x + 18, y, words, "soft")
            x += 30 + round(LETTER * len(words))

    def _rows(self) -> tuple[list[int], list[int]]:
        """Upper and lower edge of each box."""
        top, bottom, y = [], [], HEAD
        for k, phase in enumerate(self.phases):
            labels = sum(one.first == k for one in self.watches) + (k in self.targets)
            top.append(y)
            y += 2 * PAD + LINE * max(1 + len(_note(phase)) + len(phase.done), labels)
            bottom.append(y)
            y += GAP + (2 * LINE if phase.last or phase.next else 0)
        return top, bottom

    def _heights(self) -> list[int]:
        """Of each text, beside the first phase that watches it; below what comes in there."""
        taken = [self.top[k] + PAD + LINE * (k in self.targets) for k in range(len(self.phases))]
        heights = []
        for watch in self.watches:
            heights.append(taken[watch.first] + LINE // 2)
            taken[watch.first] += LINE
        return heights

    def _targets(self, watch: Watch) -> set[int]:
        """The phases to which its reactions lead."""
        names = {one.phase if one.kind == "back" else self.safety
                 for one in watch.reactions if one.kind in ("back", "lower")}  # fmt: skip
        return {self.place[name] for name in names if name in self.place}

    def _box(self, k: int) -> Iterator[str]:
        phase, x, y = self.phases[k], LEFT + BOX // 2, self.bottom[k]
        fill = "#eaf2fb" if k in self.targets else "#f4f4f4"
        box = f'x="{LEFT}" y="{self.top[k]}" width="{BOX}" height="{y - self.top[k]}" rx="4"'
        yield f'<rect {box} fill="{fill}" stroke="#999"/>'
        head = self.top[k] + PAD + LINE - 3
        yield _text(LEFT + 8, head, f"{k + 1}  {phase.name}", "name")
        yield _text(LEFT + BOX - 8, head, _manner(phase), "soft", "end")
        note = _note(phase)
        for row, text in enumerate(note, 1):
            yield _text(LEFT + 22, head + LINE * row, text, "soft")
        for row, one in enumerate(phase.done, 1 + len(note)):
            yield _text(LEFT + 22, head + LINE * row, _condition(one))
        if phase.next:
            yield _text(x + 10, y + GAP + LINE, f"on to {phase.next}", "soft")
        elif phase.last or k + 1 == len(self.phases):
            yield _line([(x, y), (x, y + GAP - 4)], "#555", 1.5)
            yield f'<circle cx="{x}" cy="{y + GAP}" r="4" fill="#555"/>'
            yield _text(x + 10, y + GAP + 4, "the end", "soft")
        else:
            yield _line([(x, y), (x, self.top[k + 1] - 4)], "#555", 1.5)
            yield _tip(x, self.top[k + 1], "down", "#555")

    def _lane(self, k: int, target: int) -> Iterator[str]:
        x, colour = self.lane_x + PITCH * k, LANES[k % len(LANES)]
        to, right = self.top[target] + PAD + LINE // 2, LEFT + BOX
        heights = [to]
        for row, ahead in self.ahead.items():
            if ahead == target:
                middle, y = LEFT + BOX // 2, self.bottom[row] + GAP
                heights.append(y)
                yield _line([(middle, self.bottom[row]), (middle, y)], colour, 1.5)
                yield _line([(middle, y), (x, y)], colour, 1.5)
                yield f'<circle cx="{x}" cy="{y}" r="2.5" fill="{colour}"/>'
        for column, watch, y in zip(self.bars, self.watches, self._heights(), strict=True):
            if target in self._targets(watch):
                heights.append(y)
                yield _line([(x, y), (self.bar_x + PITCH * column, y)], colour, 1)
                yield f'<circle cx="{x}" cy="{y}" r="2.5" fill="{colour}"/>'
        yield _line([(x, min(heights)), (x, max(heights))], colour, 1.5)
        yield _line([(x, to), (right + 4, to)], colour, 1.5)
        yield _tip(right, to, "left", colour)


def _watches(phases: Sequence[Phase]) -> Iterator[Watch]:
    """What is watched, once for phases that follow each other; in the order of the first."""
    rows = [list(_rows_of(phase)) for phase in phases]
    for k, row in enumerate(rows):
        for when, reactions in row:
            if k > 0 and (when, reactions) in rows[k - 1]:
                continue
            last = k
            while last + 1 < len(rows) and (when, reactions) in rows[last + 1]:
                last += 1
            yield Watch(when, reactions, k, last)


def _rows_of(phase: Phase) -> Iterator[tuple[str, list[Reaction]]]:
    if math.isfinite(phase.within):
        yield f"longer than {phase.within:g} s", phase.late
    for trouble in phase.troubles:
        yield _condition(trouble.when), trouble.reactions


def _columns(watches: Sequence[Watch]) -> list[int]:
    """A column for each bar, so that none lies on another: the first that is free again."""
    ends: list[int] = []
    found = []
    for watch in watches:
        free = [k for k, end in enumerate(ends) if end < watch.first]
        column = free[0] if free else len(ends)
        if not free:
            ends.append(0)
        ends[column] = watch.last
        found.append(column)
    return found


def _manner(phase: Phase) -> str:
    """The stack, how long it takes, and how far a rate leads."""
    ways = [f"{one.channel} {one.way:g}" for one in phase.leads if math.isfinite(one.way)]
    if phase.park:
        ways.append(f"parks by {phase.park.body or 'its start'}")
    time = [f"{phase.seconds:g} s"] if phase.seconds > 0.0 else []
    return ", ".join([phase.stack, *ways, *time])


def _note(phase: Phase) -> list[str]:
    return textwrap.wrap(phase.note, LETTERS)


def _condition(one: Condition) -> str:
    text = f"{one.quantity} {'≥' if one.above else '≤'} {one.value:g}"
    return text + (f" for {one.seconds:g} s" if one.seconds else "")


def _reaction(one: Reaction) -> str:
    words = {"back": f"back to {one.phase}", "abort": "end"}.get(one.kind, one.kind)
    words += f" {one.seconds:g} s" if one.kind in ("hold", "ask") else ""
    return words + (f" ({one.times} times)" if one.times > 1 else "")


def _text(x: float, y: float, text: str, kind: str = "", anchor: str = "start") -> str:
    extra = (f' class="{kind}"' if kind else "") + f' text-anchor="{anchor}"' * (anchor != "start")
    return f'<text x="{x:g}" y="{y:g}"{extra}>{escape(text)}</text>'


def _line(points: Sequence[tuple[float, float]], colour: str, width: float) -> str:
    path = " ".join(f"{x:g},{y:g}" for x, y in points)
    return f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="{width:g}"/>'


def _tip(x: float, y: float, way: str, colour: str) -> str:
    """The head of an arrow that ends there."""
    sides = [(x - 4, y - 7), (x + 4, y - 7)] if way == "down" else [(x + 7, y - 4), (x + 7, y + 4)]
    path = " ".join(f"{a:g},{b:g}" for a, b in [(x, y), *sides])
    return f'<polygon points="{path}" fill="{colour}"/>'
