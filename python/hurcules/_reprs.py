"""How solutions, options and diagnostics look at a prompt and in a notebook; what classes take.

The classes are those of the compiled module; what they show is read from their properties.
"""

from __future__ import annotations

import re
from html import escape
from inspect import Parameter, Signature
from typing import Any

import numpy as np

from hurcules import _core

__all__ = ["install"]

# as tables in a notebook, beside everything that is called ...Options
SHOWN = (
    "ActiveRow",
    "ControlSolution",
    "LevelDiagnostics",
    "LevelReport",
    "SensorFault",
    "Solution",
)
MOST = 8  # values of an array that are shown
# of those that have too many properties, what tells one from another
BRIEF = {"Simulation": ("time", "phase", "reason")}


def install() -> None:
    """Gives the classes their `__repr__` and `_repr_html_`, where they have none of their own."""
    for name, kind in vars(_core).items():
        if not isinstance(kind, type):
            continue
        if kind.__repr__ is object.__repr__:  # type: ignore[comparison-overlap]
            kind.__repr__ = _text  # type: ignore[assignment]
        if "self: " in (vars(kind).get("__init__", _text).__doc__ or ""):
            kind.__signature__ = _Arguments(kind)  # type: ignore[attr-defined]
        if not (name in SHOWN or name.endswith("Options")):
            continue
        kind._repr_html_ = _html  # type: ignore[attr-defined]


# what `inspect.signature` says of a class: pybind11 says it in the text of `__init__`
class _Arguments:
    def __init__(self, kind: type) -> None:
        self.kind = kind

    def __get__(self, made: object, owner: type) -> Signature:
        first = next(one for one in owner.__mro__ if "__init__" in vars(one))
        if first is not self.kind:  # a class of one's own that is made in another way
            raise AttributeError("__signature__")
        return _signature(str(vars(first)["__init__"].__doc__))


class _Default:
    """A default value, of which the text is known."""

    def __init__(self, text: str) -> None:
        self.text = text

    def __repr__(self) -> str:
        return self.text


def _signature(text: str) -> Signature:
    line = next(line for line in text.splitlines() if "(self: " in line)
    parameters: list[Parameter] = []
    parts = _parts(line.partition("(")[2].rpartition(")")[0])[1:]
    star = parts.index("*") if "*" in parts else len(parts)
    for place, part in enumerate(parts):
        if place == star:
            continue
        kind = Parameter.KEYWORD_ONLY if place > star else Parameter.POSITIONAL_OR_KEYWORD
        name, _, rest = part.partition(": ")
        annotation, found, default = rest.partition(" = ")
        value = _Default(default) if found else Parameter.empty
        parameters.append(Parameter(name, kind, default=value, annotation=_Default(annotation)))
    return Signature(parameters)


def _parts(text: str) -> list[str]:
    """A text, split at the commas that are in no bracket."""
    parts, depth = [""], 0
    for piece in re.findall(r"'[^']*'|\"[^\"]*\"|.", text):
        depth += (piece in "([{<") - (piece in ")]}>")
        if piece == "," and not depth:
            parts.append("")
        else:
            parts[-1] += piece
    return [part.strip() for part in parts]


def _values(shown: Any) -> dict[str, str]:
    """The properties that can be said in a line, by name."""
    found = {}
    brief = BRIEF.get(type(shown).__name__)
    for name, member in vars(type(shown)).items():
        if brief is not None and name not in brief:
            continue
        old = (member.__doc__ or "").startswith("Deprecated")
        if not name.startswith("_") and isinstance(member, property) and not old:
            try:
                text = _line(getattr(shown, name))
            except _core.Error:  # the level reports of a method that has none
                continue
            if text:
                found[name] = text
    return found


def _line(value: Any) -> str:
    """A value in a line; "" for one that has none."""
    if isinstance(value, bool | str | int) or value is None:
        return repr(value)
    if isinstance(value, float):
        return f"{value:.6g}"
    if isinstance(value, _core.Task):
        return value.name
    if isinstance(value, np.ndarray):
        if value.ndim == 1 and value.size <= MOST:
            return np.array2string(value, precision=4, separator=", ", max_line_width=200)
        return f"array of {' x '.join(map(str, value.shape))}"
    if isinstance(value, list | tuple):
        if value and all(isinstance(item, _core.Shortfall) for item in value):
            return f"[{'; '.join(map(str, value))}]"
        simple = len(value) <= MOST and all(isinstance(item, str | int | float) for item in value)
        return repr(value) if simple else f"{len(value)} items"
    if hasattr(value, "name") and hasattr(type(value), "__members__"):
        return str(value.name)
    return ""


def _text(shown: Any) -> str:
    inside = ", ".join(f"{name}={text}" for name, text in _values(shown).items())
    return f"{type(shown).__name__}({inside})"


def _html(shown: Any) -> str:
    rows = "".join(
        f"<tr><th style='text-align:left'>{escape(name)}</th>"
        f"<td style='text-align:left'><code>{escape(text)}</code></td></tr>"
        for name, text in _values(shown).items()
    )
    return f"<table><caption>{escape(type(shown).__name__)}</caption>{rows}</table>"
