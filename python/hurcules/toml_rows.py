"""Values out of a TOML file: each with its type, and told with its place where it has another."""

from __future__ import annotations

import difflib
from collections.abc import Mapping, Sequence
from numbers import Real
from reprlib import Repr
from typing import Any

from hurcules._core import Error

__all__ = ["Kind", "take", "typed"]

Kind = Any  # str, float, bool, dict, or a list with one of them
_WORDS: Mapping[type, tuple[str, str]] = {
    str: ("a text", "texts"),
    float: ("a number", "numbers"),
    bool: ("true or false", "true or false"),
    dict: ("a table", "tables"),
}
_SHORT = Repr()
_SHORT.maxstring = _SHORT.maxother = 60


def typed(value: Any, kind: Kind, where: str) -> Any:
    """A value of the wanted type.

    Args:
        value: as it came.
        kind: str, float (a whole number too), bool, dict, or [kind] for a list of them.
        where: it stands, for the error.

    Raises:
        Error: of another type: "WHERE: wanted a list of texts, got 'abort'".
    """
    if isinstance(kind, list):
        if isinstance(value, Sequence) and not isinstance(value, str):
            return [typed(one, kind[0], where) for one in value]
        wanted = f"a list of {_WORDS[kind[0]][1]}"
    elif kind is float and isinstance(value, Real) and not isinstance(value, bool):
        return float(value)
    elif kind is dict and isinstance(value, Mapping):
        return dict(value)
    elif kind in (str, bool) and isinstance(value, kind):
        return value
    else:
        wanted = _WORDS[kind][0]
    raise Error(f"{where}: wanted {wanted}, got {_SHORT.repr(value)}")


def take(
    row: Any, kinds: Mapping[str, Kind], where: str = "", needs: Sequence[str] = ()
) -> dict[str, Any]:
    """The entries of a table, by name.

    Args:
        row: of the file.
        kinds: of each entry that there may be.
        where: the table stands; "": at the top of the file.
        needs: entries that must be there.

    Raises:
        Error: no table, an entry that does not exist or is of another type, or one that is missing.
    """
    given = typed(row, dict, where or "the file")
    before = f"{where}: " if where else ""
    for key in given:
        if key not in kinds:
            near = difflib.get_close_matches(key, kinds, 1)
            guess = f"is it '{near[0]}'? " if near else ""
            raise Error(f"{before}no entry '{key}'; {guess}there are: {', '.join(kinds)}")
    for key in needs:
        if key not in given:
            raise Error(f"{where} wants {key}")
    return {
        key: typed(value, kinds[key], f"{where}, {key}" if where else key)
        for key, value in given.items()
    }
