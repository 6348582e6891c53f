"""How levels and options are copied and pickled: by what they were made of."""

from __future__ import annotations

import copyreg
from collections.abc import Callable
from typing import Any

from hurcules import _core

__all__ = ["install"]

_MADE_BY_LINES = (_core.Robot, _core.Solver, _core.Stack, _core.Channel)


def install() -> None:
    """Tells `copy` and `pickle` of the classes of the compiled module that hold numbers alone."""
    copyreg.pickle(_core.Level, _level)
    copyreg.pickle(_core.LevelStack, _stack)
    copyreg.pickle(_core.LevelChange, _change)
    for name, kind in vars(_core).items():
        if not isinstance(kind, type):
            continue
        if "__deepcopy__" in vars(kind) or name.endswith("Options"):  # bound by their fields
            copyreg.pickle(kind, _options)
        elif kind in _MADE_BY_LINES or hasattr(kind, "restore"):
            copyreg.pickle(kind, _refused)
    copyreg.pickle(_core.Solution, _answer)


def _refused(thing: Any) -> str:
    goes_on = ", and restore(state()) of this one" if hasattr(thing, "restore") else ""
    raise _core.Error(
        f"a {type(thing).__name__} is neither copied nor pickled: make another one by the lines "
        f"that made it{goes_on}"
    )


def _answer(_solution: _core.Solution) -> str:
    raise _core.Error(
        "a Solution is neither copied nor pickled: take what you need of it, solution.x say, and "
        "let a process return that"
    )


def _level(level: _core.Level) -> tuple[Callable[..., _core.Level], tuple[Any, ...]]:
    if level.A.size == 0 and level.rows > 0:
        return _core.Bounds, (level.lower, level.upper)
    return _core.Level, (level.A, level.lower, level.upper, level.rho)


def _stack(stack: _core.LevelStack) -> tuple[Callable[..., _core.LevelStack], tuple[Any, ...]]:
    if stack.A.size == 0 and stack.lower.size > 0:
        return _core.BoundsStack, (stack.lower, stack.upper)
    return _core.LevelStack, (stack.A, stack.lower, stack.upper, stack.rho)


def _change(change: _core.LevelChange) -> tuple[type[_core.LevelChange], tuple[Any, ...]]:
    return _core.LevelChange, (change.A, change.lower, change.upper, change.rho)


def _options(options: Any) -> tuple[Callable[..., Any], tuple[Any, ...]]:
    kind = type(options)
    fields = [name for name, member in vars(kind).items() if isinstance(member, property)]
    return _made, (kind, {name: getattr(options, name) for name in fields})


def _made(kind: type, fields: dict[str, Any]) -> Any:
    return kind(**fields)
