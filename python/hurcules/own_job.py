"""A mission with a robot of one's own, for the command line: a Python file with a function `job`.

def job(seed, mass=0.5):    # hurcules run pick.py --seed 3 --mass 0.8
    ...
    return mission, model, controller
"""

from __future__ import annotations

import importlib.util
import inspect
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import mujoco

from hurcules._core import Error, WholeBodyController
from hurcules.mission_options import read_words
from hurcules.mission_table import Mission
from hurcules.validation import require_known

__all__ = ["is_own_job", "make_job", "parameters_of_job"]

Job = tuple[Mission, mujoco.MjModel, WholeBodyController]


def is_own_job(name: str) -> bool:
    """Whether a mission's name is that of a Python file."""
    return name.endswith(".py")


def parameters_of_job(path: str, words: Sequence[str]) -> dict[str, Any]:
    """What the words of a command line say of the parameters of its `job`, beside the seed.

    Raises:
        Error: no such file or parameter, or a value of another type than its default.
    """
    return read_words(words, _defaults(_function(path))) if words else {}


def make_job(path: str, seed: int, parameters: Mapping[str, Any]) -> Job:
    """What its `job` makes.

    Args:
        path: of the file; modules that lie beside it can be imported.
        seed: for what differs between runs.
        parameters: by name.

    Raises:
        Error: no such file, function or parameter, or it makes something else.
    """
    job = _function(path)
    for name in parameters:
        require_known(f"{path}: parameter", name, _defaults(job))
    made = job(seed, **parameters)
    kinds = (Mission, mujoco.MjModel, WholeBodyController)
    parts = made if isinstance(made, tuple) else (made,)
    if len(parts) != len(kinds) or not all(map(isinstance, parts, kinds)):
        wanted = "a hurcules.Mission, a mujoco.MjModel and a hurcules.WholeBodyController"
        came = ", ".join(type(part).__name__ for part in parts)
        raise Error(f"{path}: job wants to return {wanted}, it returned {came}")
    return made


def _function(path: str) -> Callable[..., Any]:
    file = Path(path).resolve()
    if not file.is_file():
        raise Error(f"{path}: no such file")
    spec = importlib.util.spec_from_file_location(f"job_of_{file.stem}", file)
    assert spec and spec.loader
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    if str(file.parent) not in sys.path:
        sys.path.insert(0, str(file.parent))
    spec.loader.exec_module(module)
    job = getattr(module, "job", None)
    if not callable(job):
        raise Error(
            f"{path} wants a function job(seed) that returns its mission, model and controller"
        )
    return job


def _defaults(job: Callable[..., Any]) -> dict[str, Any]:
    """Its parameters beside the seed."""
    named = list(inspect.signature(job).parameters.values())[1:]
    return {one.name: one.default for one in named if one.default is not one.empty}
