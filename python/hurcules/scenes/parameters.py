"""What a scene can be asked for: fields with a unit, a range and a meaning, checked when set."""

from __future__ import annotations

import math
from dataclasses import MISSING, Field, dataclass, field, fields
from typing import Any

import numpy as np

from hurcules._core import Error

__all__ = ["Parameter", "choice", "count", "flag", "number", "parameters_of", "require_fields"]


@dataclass(frozen=True)
class Parameter:
    """One thing that a scene can be asked for."""

    name: str
    default: float | int | str | bool
    meaning: str
    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    choices: tuple[Any, ...] = ()  # the only values, where there are such

    @property
    def wanted(self) -> str:
        """The values that are taken, in words."""
        if self.choices:
            return "one of " + ", ".join(str(value) for value in self.choices)
        kind = "a whole number" if isinstance(self.default, int) else "a number"
        return f"{kind} from {self.low:.4g} to {self.high:.4g}" + (
            f" {self.unit}" if self.unit else ""
        )


def number(default: float, low: float, high: float, unit: str, meaning: str) -> Any:
    """A field for a number from `low` to `high`, both included."""
    about = {"low": low, "high": high, "unit": unit, "meaning": meaning}
    return field(default=float(default), metadata=about)


def count(default: int, low: int, high: int, meaning: str) -> Any:
    """A field for a whole number from `low` to `high`, both included."""
    return field(default=default, metadata={"low": low, "high": high, "meaning": meaning})


def choice(default: Any, choices: tuple[Any, ...], meaning: str) -> Any:
    """A field for one of some values."""
    return field(default=default, metadata={"choices": choices, "meaning": meaning})


def flag(default: bool, meaning: str) -> Any:
    """A field for True or False."""
    return choice(default, (False, True), meaning)


def parameters_of(scene: type) -> list[Parameter]:
    """All parameters of a class of scenes, in order."""
    return [_parameter(item) for item in fields(scene)]


def require_fields(kind: str, scene: Any) -> None:
    """Checks every field of a scene.

    Raises:
        Error: a value of the wrong type or out of its range; the text says what was wanted.
    """
    for parameter in parameters_of(type(scene)):
        value = getattr(scene, parameter.name)
        if not _fits(parameter, value):
            raise Error(f"{kind}: {parameter.name} wants {parameter.wanted}, got {value!r}")


def _parameter(item: Field[Any]) -> Parameter:
    assert item.default is not MISSING
    return Parameter(item.name, item.default, **item.metadata)


def _fits(parameter: Parameter, value: Any) -> bool:
    if parameter.choices:
        return type(value) is type(parameter.default) and value in parameter.choices
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    real = whole or isinstance(value, float | np.floating)
    fits = whole if isinstance(parameter.default, int) else real
    return fits and bool(parameter.low <= value <= parameter.high)
