"""Errors with what was wanted and where: names that do not exist, and the place of others."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import contextmanager

from hurcules._core import Error

__all__ = ["require_known", "told_at"]


def require_known(noun: str, name: str, known: Iterable[str]) -> None:
    """Passes a name that exists.

    Args:
        noun: what it is the name of.
        name: as it came.
        known: those that exist.

    Raises:
        Error: it is not among them; the text lists them.
    """
    known = list(known)
    if name not in known:
        there = f"there are: {', '.join(known)}" if known else "there is none"
        raise Error(f"{noun} '{name}' does not exist; {there}")


@contextmanager
def told_at(where: str) -> Iterator[None]:
    """Errors begin with their place.

    Args:
        where: a file, a row of it.

    Raises:
        Error: as it was raised inside, "WHERE: " before it.
    """
    try:
        yield
    except Error as error:
        raise Error(f"{where}: {error}") from error
