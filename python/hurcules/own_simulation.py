"""A simulation of one's own for the command line: a Python file with a function `simulation`."""

from __future__ import annotations

import importlib.util
import inspect
import sys
import traceback
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache, partial
from pathlib import Path
from types import ModuleType
from typing import Any

from hurcules._core import Error
from hurcules.mission_options import read_options
from hurcules.simulation import Simulation

__all__ = ["bound", "is_own", "make", "parameters_of"]

FUNCTION = "simulation"


def is_own(name: str) -> bool:
    """Whether this is the path of such a file."""
    return name.endswith(".py")


def make(path: str, seed: int = 0, parameters: Mapping[str, Any] | None = None) -> Simulation:
    """What its function returns.

    Args:
        path: of the file, which is executed as an import executes it.
        seed: for the parameter `seed` of the function.
        parameters: for others, by name.

    Raises:
        Error: no file, no such function, a parameter that it has not, or another result.
    """
    function = bound(path, seed, parameters)
    with _its_own_errors(Path(path)):
        made = function()
    if not isinstance(made, Simulation):
        raise Error(f"{path}: {FUNCTION}() wants to return a hurcules.Simulation, got {made!r}")
    return made


def bound(path: str, seed: int, parameters: Mapping[str, Any] | None) -> Callable[[], Any]:
    """Its function with its arguments, not called yet; raises as `make`."""
    function = _function(path)
    given = dict(parameters or {})
    if "seed" in inspect.signature(function).parameters:
        given["seed"] = seed
    elif seed:
        raise Error(f"{path}: {FUNCTION}() has no parameter seed, got {seed}")
    try:
        inspect.signature(function).bind(**given)
    except TypeError as error:
        raise Error(f"{path}: {FUNCTION}(): {error}") from None
    return partial(function, **given)


def parameters_of(path: str, words: Sequence[str]) -> dict[str, Any]:
    """What the words of a command line say: an option for each parameter with a default.

    Of numbers, texts, true and false.

    Args:
        path: of the file.
        words: `--mass 3`, by the type of the default.

    Raises:
        Error: as `make`, another option, or a value that is none.
    """
    if not words:
        return {}
    parameters = inspect.signature(_function(path)).parameters.values()
    defaults = {
        one.name: one.default
        for one in parameters
        if isinstance(one.default, int | float | str | tuple) and one.name != "seed"
    }
    return read_options(words, defaults)


@cache
def _module(file: Path, changed: int) -> ModuleType:
    """The executed file, once for each time that it was changed [ns]."""
    spec = importlib.util.spec_from_file_location(f"hurcules_run_{file.stem}", file)
    assert spec and spec.loader  # it ends in .py
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module  # where dataclasses and pickle look
    if (folder := str(file.parent)) not in sys.path:
        sys.path.insert(0, folder)  # as for a script: it may import its neighbours
    try:
        with _its_own_errors(file):
            spec.loader.exec_module(module)
    except SystemExit as end:
        raise Error(f"{file}: it ends by itself (exit {end.code}) where it is imported") from end
    return module


@contextmanager
def _its_own_errors(file: Path) -> Iterator[None]:
    """Around what a file does: an Error says what went wrong, and in which of its lines."""
    try:
        yield
    except Error:
        raise
    except SyntaxError as error:
        raise Error(f"{file}, line {error.lineno}: {error.msg}") from error
    except Exception as error:
        frames = traceback.extract_tb(error.__traceback__)
        lines = [one.lineno for one in frames if Path(one.filename) == file.resolve()]
        line = f", line {lines[-1]}" if lines else ""
        raise Error(f"{file}{line}: {type(error).__name__}: {error}") from error


def _function(path: str) -> Callable[..., Any]:
    file = Path(path)
    if not file.is_file():
        raise Error(f"{path}: {'it is a folder' if file.is_dir() else 'no such file'}")
    function = getattr(_module(file.resolve(), file.stat().st_mtime_ns), FUNCTION, None)
    if not callable(function):
        raise Error(
            f"{path}: wanted a function {FUNCTION}(seed=0) that returns a hurcules.Simulation, "
            "there is none"
        )
    return function
