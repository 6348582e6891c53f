"""The answer to a name that does not exist."""

from __future__ import annotations

from collections.abc import Iterable

from hurcules._core import Error

__all__ = ["require_known"]


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
        raise Error(f"{noun} '{name}' does not exist; there are: {', '.join(known)}")
