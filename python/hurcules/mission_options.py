"""What a command line, or a mapping, says of a mission: options to the fields of a dataclass."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import fields
from typing import Any, TypeVar

from hurcules._core import Error

__all__ = ["away_words", "defaults_of", "in_words_of", "read_options", "record", "require_offset"]

Record = TypeVar("Record")

_WORDS = {
    int: "a whole number",
    float: "a number",
    bool: "true or false",
    tuple: "numbers between commas",
}


def read_options(words: Sequence[str], defaults: Mapping[str, Any]) -> dict[str, Any]:
    """Reads `--mass 90 --offset 0.05,-0.1 --yaw=0.2`.

    Args:
        words: of the command line.
        defaults: by name: an option for each, of the type of its default.

    Raises:
        Error: another option, or a value that is none.
    """
    found: dict[str, Any] = {}
    rest = list(words)
    while rest:
        option, _, value = rest.pop(0).partition("=")
        name = option.removeprefix("--")
        if name not in defaults or name == option:
            what = "no such option" if option.startswith("-") else "unexpected argument"
            known = ", ".join(f"--{one}" for one in defaults) or "none"
            raise Error(f"{what}: {option}; options are: {known}")
        value = value or (rest.pop(0) if rest else "")
        if not value:
            raise Error(f"{option} wants a value")
        default = defaults[name]
        try:
            kind = next(one for one in (*_READERS, float, str) if isinstance(default, one))
            found[name] = _READERS.get(kind, kind)(value)
        except ValueError:
            raise Error(f"{option}: wanted {_WORDS[kind]}, got {value!r}") from None
    return found


def defaults_of(kind: Callable[..., Any]) -> dict[str, Any]:
    """The defaults of a dataclass, by name."""
    return {field.name: field.default for field in fields(kind)}  # type: ignore[arg-type]


def _whole(text: str) -> int:
    """A whole number, written "75.0" too."""
    number = float(text)
    if not number.is_integer():
        raise ValueError
    return int(number)


def _truth(text: str) -> bool:
    if text not in ("true", "false"):
        raise ValueError
    return text == "true"


def _pair(text: str) -> tuple[float, ...]:
    """Numbers between commas."""
    return tuple(float(number) for number in text.split(","))


_READERS: dict[type, Callable[[str], Any]] = {bool: _truth, int: _whole, tuple: _pair}


def record(kind: Callable[..., Record], noun: str, parameters: Mapping[str, Any]) -> Record:
    """A dataclass from parameters by name; the others keep their defaults.

    Raises:
        Error: no such parameter; the text begins with the noun and lists those that exist.
    """
    known = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    for name in parameters:
        if name not in known:
            raise Error(f"{noun}: no parameter '{name}'; there are: {', '.join(known)}")
    return kind(**parameters)


@contextmanager
def in_words_of(words: Mapping[str, str]) -> Iterator[None]:
    """Errors name a scene's parameters as the mission calls them.

    Args:
        words: the mission's name by the scene's.

    Raises:
        Error: as it was raised inside, "casualty: yaw wants ..." for "casualty: heading wants ...".
    """
    try:
        yield
    except Error as error:
        noun, _, rest = str(error).partition(": ")
        name, _, wanted = rest.partition(" ")
        if name not in words:
            raise
        raise Error(f"{noun}: {words[name]} {wanted}") from None


def away_words(distance: float, way: str = "") -> dict[str, str]:
    """How the offset is told that puts a thing out of the range of its place, for `in_words_of`.

    Args:
        distance: [m] ahead of the robot, without the offset.
        way: that comes on top, in words.
    """
    return {
        "distance": f"the place ahead, {distance:.3g} m{way} and the offset,",
        "lateral": "the offset to the left",
    }


def require_offset(noun: str, offset: Sequence[float]) -> None:
    """Two numbers [m], ahead and to the left.

    Raises:
        Error: others; the text begins with the noun.
    """
    numbers = isinstance(offset, Sequence) and all(isinstance(one, int | float) for one in offset)
    if not numbers or len(offset) != 2 or not all(math.isfinite(number) for number in offset):
        wanted = "offset wants two numbers, ahead and to the left"
        raise Error(f"{noun}: {wanted}, got {offset!r}")
