"""Parses `hurcules run METHOD --angle 30`: words of the command line as a method's numbers.

Angles are degrees there and radians everywhere else.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from hurcules import scenes
from hurcules._core import Error
from hurcules_studies.field_tests.methods import Method, Way, method

__all__ = ["parse", "shown"]


def parse(name: str, words: Sequence[str]) -> tuple[Method, tuple[float, ...] | None]:
    """Reads options like `--angle 25,30 --friction 0.5`.

    Args:
        name: of the method.
        words: what follows it on the command line.

    Returns:
        The method with what was fixed, and the settings of its parameter; None for all of its own.

    Raises:
        Error: no such method or parameter, or no number; the text says what there is.
    """
    chosen = method(name)
    settings: tuple[float, ...] | None = None
    fixed: dict[str, Any] = {}
    for key, text in _pairs(name, words):
        if key == chosen.parameter:
            settings = tuple(_value(chosen, key, part) for part in text.split(","))
        else:
            fixed[key] = _value(chosen, key, text)
    chosen = replace(chosen, fixed=chosen.fixed | fixed)
    for setting in settings or (None,):
        scenes.scene(chosen.scene, **chosen.values(setting) if setting else chosen.fixed)
    return chosen, settings


def shown(chosen: Method, setting: float | None) -> str:
    """A setting for people: "30 deg", "0.4 m"."""
    if setting is None:
        return "as it is"
    if chosen.is_angle:
        return f"{math.degrees(setting):.4g} deg"
    if chosen.way is Way.Laps:
        return f"{setting:.4g} m/s"
    return f"{setting:.4g} {'kg' if chosen.parameter == 'mass' else 'm'}"


def _pairs(name: str, words: Sequence[str]) -> list[tuple[str, str]]:
    pairs = []
    rest = list(words)
    while rest:
        word = rest.pop(0)
        key, equals, text = word.removeprefix("--").partition("=")
        if not word.startswith("--") or not key:
            raise Error(f"{name}: wanted --PARAMETER VALUE, got {word!r}")
        if not equals:
            if not rest:
                raise Error(f"{name}: --{key} wants a value")
            text = rest.pop(0)
        pairs.append((key.replace("-", "_"), text))
    return pairs


def _value(chosen: Method, key: str, text: str) -> Any:
    known = {parameter.name: parameter for parameter in scenes.parameters(chosen.scene)}
    of_driver = key == chosen.parameter
    if key not in known and not of_driver:
        raise Error(f"no option --{key}; the scene '{chosen.scene}' has: {', '.join(known)}")
    default = known[key].default if key in known else 0.0
    if isinstance(default, str):
        return text
    if isinstance(default, bool):
        if text.lower() not in ("true", "false"):
            raise Error(f"--{key}: wanted true or false, got {text!r}")
        return text.lower() == "true"
    try:
        value = float(text)
    except ValueError:
        raise Error(f"--{key}: wanted a number, got {text!r}") from None
    if not math.isfinite(value) or (of_driver and value <= 0.0):
        raise Error(f"--{key}: wanted a positive number, got {text!r}")
    if isinstance(default, int):
        return int(value) if value == int(value) else value  # a fraction is for the scene to refuse
    degrees = key in known and known[key].wanted.endswith("rad")
    return math.radians(value) if degrees else value
