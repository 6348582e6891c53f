"""Which claims somebody means: M05, a beginning such as M or K1, a range such as R01-R10."""

from __future__ import annotations

import re
from collections.abc import Iterable

from hurcules._core import Error

__all__ = ["ranges", "select"]


def select(wanted: Iterable[str], known: Iterable[str]) -> list[str]:
    """Returns the ids that are meant, in the order of the list.

    Args:
        wanted: ids, beginnings of ids, ranges with "-" or ".."; several in one text with commas.
            None at all means everything.
        known: the ids that exist.

    Raises:
        Error: something that means no claim; the text says which ids exist.
    """
    ids = list(known)
    words = [word for text in wanted for word in re.split(r"[,\s]+", text.strip()) if word]
    if not words:
        return ids
    meant: set[str] = set()
    for word in words:
        found = _range(word.upper(), ids) or _beginning(word.upper(), ids)
        if not found:
            raise Error(f"no claim is meant by {word!r}; there are: {ranges(ids)}")
        meant.update(found)
    return [name for name in ids if name in meant]


def _range(word: str, ids: list[str]) -> list[str]:
    ends = re.fullmatch(r"([A-Z]\d\d)(?:-|\.\.)([A-Z]?\d\d)", word)
    if not ends:
        return []
    first, last = ends[1], ends[2] if ends[2][0].isalpha() else ends[1][0] + ends[2]
    if first not in ids or last not in ids or ids.index(first) > ids.index(last):
        return []
    return ids[ids.index(first) : ids.index(last) + 1]


def _beginning(word: str, ids: list[str]) -> list[str]:
    return [name for name in ids if name.startswith(word)]


def ranges(ids: Iterable[str]) -> str:
    """The ids by their letters: "R01-R26, E01-E05"."""
    ends: dict[str, list[str]] = {}
    for name in ids:
        ends.setdefault(name[0], []).append(name)
    return ", ".join(f"{names[0]}-{names[-1]}" for names in ends.values())
