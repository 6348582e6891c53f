"""Checks of what an environment's author writes; each error says what was wanted and what came.

Names and shapes are checked until the first step is done, NaN in each step.
"""

from __future__ import annotations

import reprlib
import warnings
from collections.abc import Collection, Mapping
from numbers import Integral, Real
from typing import Any

import mujoco
import numpy as np
from gymnasium.error import ClosedEnvironmentError
from numpy.typing import NDArray

import hurcules
from hurcules.validation import require_known
from hurcules_envs.environment import Array, Environment, Group, Numbers, Start

__all__ = [
    "CheckedEnvironment",
    "read_once",
    "require_attributes",
    "require_finite",
    "require_flag",
    "require_names",
    "require_no_nan",
    "require_numbers",
    "require_open",
    "require_unchanged",
    "require_whole",
    "warn_of_still_things",
]

WHOLE = 1e-5  # share that a rate may be off: so close is one that is written with six digits


class CheckedEnvironment:
    """An environment that checks names and shapes of all that it returns."""

    def __init__(self, environment: Environment, n: int) -> None:
        self._environment = environment
        self._name = type(environment).__name__
        self._n = n

    def start(self, generator: np.random.Generator) -> Start:
        """As the environment's."""
        start = self._environment.start(generator)
        where = f"{self._name}.start"
        if not isinstance(start, Start):
            raise hurcules.Error(f"{where}: wanted a Start, got {_came(start)}")
        if start.qpos is not None:
            wanted = (self._environment.simulation.model.nq,)
            require_numbers(f"{where}: qpos", np.asarray(start.qpos), wanted)
            require_finite(f"{where}: qpos", np.asarray(start.qpos, float))
        memory = self._environment.memory
        require_names(where, "entry of the memory", start.memory, memory, complete=False)
        for name, value in start.memory.items():
            one, entry = np.asarray(value), f"{where}: memory '{name}'"
            # a number is right for all of an entry
            require_numbers(entry, one, one.shape and (memory[name],))
            require_finite(entry, one)
        for name, value in start.info.items():
            require_numbers(f"{where}: info '{name}'", np.asarray(value), ())
        return start

    def remember(self, numbers: Numbers) -> None:
        """As the environment's."""
        self._of("remember", numbers)
        memory, where = self._environment.memory, f"{self._name}.remember"
        require_names(where, "entry of the memory", numbers.memory, memory)
        for name, values in numbers.memory.items():
            require_numbers(f"{where}: memory '{name}'", values, (self._n, memory[name]))

    def observe(self, numbers: Numbers) -> Mapping[str, Array]:
        """As the environment's."""
        groups = {group.name: group for group in self._environment.observation}
        seen, where = self._of("observe", numbers), f"{self._name}.observe"
        own = getattr(type(self._environment), "observation", ())  # an instance may hide some
        known = dict.fromkeys([*groups, *(group.name for group in own)])
        require_names(where, "group of the observation", seen, known, complete=False)
        for name, group in groups.items():
            values = seen[name] if name in seen else self._read(name, numbers, seen)
            require_numbers(f"{where}: '{name}'", values, (self._n, group.size))
        return seen

    def _read(self, name: str, numbers: Numbers, seen: Mapping[str, Array]) -> Array:
        """The quantity or entry of the memory that a group is, which `observe` left out."""
        try:
            return numbers[name]
        except hurcules.Error:
            there = [*seen, *self._environment.quantities, *self._environment.memory]
            raise hurcules.Error(
                f"{self._name}.observe: group '{name}' is missing; there are: "
                f"{', '.join(there) or 'none'}"
            ) from None

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """As the environment's."""
        goals, where = self._of("goals", numbers), f"{self._name}.goals"
        if not (isinstance(goals, tuple) and len(goals) == 2):
            raise hurcules.Error(f"{where}: wanted (achieved, desired), got {_came(goals)}")
        for name, values in zip(("achieved", "desired"), goals, strict=True):
            require_numbers(f"{where}: {name}", values, (self._n, self._environment.goal))
        return goals

    def reward(self, numbers: Numbers) -> Mapping[str, Array]:
        """As the environment's."""
        terms, where = self._of("reward", numbers), f"{self._name}.reward"
        require_names(where, "term", terms, self._environment.terms)
        for name, values in terms.items():
            require_numbers(f"{where}: term '{name}'", values, (self._n,))
        return terms

    def tell(self, numbers: Numbers) -> Mapping[str, Array]:
        """As the environment's."""
        told, where = self._of("tell", numbers), f"{self._name}.tell"
        require_names(where, "name", told, told)
        for name, values in told.items():
            require_numbers(f"{where}: '{name}'", np.asarray(values), (self._n,))
        return told

    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """As the environment's."""
        return self._claim("succeeded", numbers)

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """As the environment's."""
        return self._claim("failed", numbers)

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """As the environment's."""
        return self._claim("ended", numbers)

    def costs(self, numbers: Numbers) -> NDArray[np.bool_]:
        """As the environment's."""
        return self._claim("costs", numbers)

    def _claim(self, method: str, numbers: Numbers) -> NDArray[np.bool_]:
        claim: NDArray[np.bool_] = self._of(method, numbers)
        require_numbers(f"{self._name}.{method}", claim, (self._n,), "bool", "b")
        return claim

    def _of(self, method: str, numbers: Numbers) -> Any:
        """What a method says of the numbers, which may be read alone."""
        try:
            return getattr(self._environment, method)(numbers)
        except ValueError as error:
            if "read-only" not in str(error):
                raise
            raise hurcules.Error(
                f"{self._name}.{method} writes to what it is given ({error}): wanted a copy, "
                "numbers[NAME].copy(), or in `remember` numbers.memory[NAME]"
            ) from error


def warn_of_still_things(environment: Environment) -> None:
    """Without physics nothing is gripped, pushed or dropped: a policy would learn that in vain."""
    simulation = environment.simulation
    if simulation.physics:
        return
    model, plan = simulation.model, simulation.controller.plan
    own = {int(driven.dof) for one in plan.coordinates for driven in one.joints}
    roots = {int(model.body_rootid[model.dof_bodyid[dof]]) for dof in own}
    free = [
        model.body(int(model.jnt_bodyid[joint])).name or "a body without a name"
        for joint in np.flatnonzero(model.jnt_type == mujoco.mjtJoint.mjJNT_FREE)
        if int(model.body_rootid[model.jnt_bodyid[joint]]) not in roots
    ]
    if free:
        warnings.warn(
            f"{type(environment).__name__}: without physics nothing moves {', '.join(free)}; where "
            'it is to be touched, fidelities = ("exact", "fast") says that there is no "kinematic"',
            stacklevel=2,
        )


def read_once(environment: Environment) -> dict[str, Any]:
    """The attributes that episodes are made of, by name, as they are now."""
    scales = {name: np.asarray(one).tolist() for name, one in environment.actions.items()}
    names = ("rate", "observation", "quantities", "terms", "parameters")
    return {"actions": scales} | {name: getattr(environment, name) for name in names}


def require_unchanged(environment: Environment, made_of: Mapping[str, Any]) -> None:
    """What is read once is as it was then: a change would be no change, in silence.

    Args:
        environment: which episodes were made of.
        made_of: `read_once`, from when they were.

    Raises:
        hurcules.Error: an attribute differs.
    """
    for name, now in read_once(environment).items():
        if now != made_of[name]:
            was, wanted = reprlib.repr(made_of[name]), reprlib.repr(now)
            raise hurcules.Error(
                f"{type(environment).__name__}.{name} is read once, when the environment is made: "
                f"it was {was} then, and a change to {wanted} does nothing; set it in __init__, "
                "from a keyword say, and make another environment"
            )


def require_attributes(environment: Environment, read: Collection[str]) -> None:
    """All attributes are there, and are what they should be.

    Args:
        environment: just built.
        read: names of all that is read after each step.

    Raises:
        hurcules.Error: an attribute is missing or of another kind; the text says which.
    """
    name = type(environment).__name__
    for wanted in ("simulation", "actions", "observation", "terms", "task_description"):
        if not hasattr(environment, wanted):
            raise hurcules.Error(f"{name}: `{wanted}` is not set, in the class or in __init__")
    for wanted in ("terms", "quantities", "parameters"):
        value = getattr(environment, wanted)
        if isinstance(value, str) or len(set(value)) < len(value):
            raise hurcules.Error(f"{name}.{wanted}: wanted names, each once, got {value!r}")
    for action, names in environment.components.items():
        if isinstance(names, str):
            raise hurcules.Error(f"{name}.components: wanted a tuple for '{action}', got {names!r}")
    groups: Any = environment.observation
    if not (isinstance(groups, tuple | list) and all(isinstance(one, Group) for one in groups)):
        raise hurcules.Error(f"{name}.observation: wanted a tuple of Group, got {_came(groups)}")
    group_names = [group.name for group in groups]
    if len(set(group_names)) < len(group_names):
        raise hurcules.Error(f"{name}.observation: wanted names, each once, got {group_names}")
    if not environment.actions:
        raise hurcules.Error(f"{name}.actions: wanted one at least, got none")
    most = 1.0 / environment.simulation.dt
    if not (isinstance(environment.rate, Real) and 0.0 < environment.rate <= most):
        raise hurcules.Error(f"{name}.rate: wanted up to {most:g} Hz, got {environment.rate!r}")
    ticks = most / environment.rate
    if abs(ticks - round(ticks)) > WHOLE * ticks:
        near = " and ".join(f"{most / whole:g}" for whole in (int(ticks) + 1, int(ticks)))
        raise hurcules.Error(
            f"{name}.rate: wanted a whole number of control ticks of {1e3 / most:g} ms a step, got "
            f"{environment.rate:g} Hz ({ticks:g} ticks); the nearest rates are {near} Hz"
        )
    for entry, size in environment.memory.items():
        if not (isinstance(size, Integral) and size > 0):
            raise hurcules.Error(f"{name}.memory: '{entry}' wants a whole number, got {size!r}")
    for entry in environment.parameters:
        require_known(f"{name}.parameters: entry of the memory", entry, environment.memory)
    for entry in environment.memory:
        if entry in read or entry in environment.quantities:
            raise hurcules.Error(f"{name}.memory: '{entry}' is a quantity: take another name")
    for method in ("goals", "compute_reward") if environment.goal else ():
        if getattr(type(environment), method) is getattr(Environment, method):
            raise hurcules.Error(f"{name} has a goal of {environment.goal}, but no {method}()")


def require_names(
    where: str, noun: str, given: object, known: Collection[str], *, complete: bool = True
) -> None:
    """A dictionary of names that are known, and all of them where it is to be complete.

    Raises:
        hurcules.Error: it is none, one is unknown, or one is missing.
    """
    if not isinstance(given, Mapping):
        raise hurcules.Error(f"{where}: wanted a dictionary, got {_came(given)}")
    for name in given:
        require_known(f"{where}: {noun}", name, known)
    for name in known if complete else ():
        if name not in given:
            raise hurcules.Error(f"{where}: {noun} '{name}' is missing")


def require_open(closed: bool, call: str) -> None:
    """An environment that is not closed.

    Raises:
        gymnasium.error.ClosedEnvironmentError: it is; the text says what was called.
    """
    if closed:
        raise ClosedEnvironmentError(f"{call}() of an environment that was closed")


def require_finite(where: str, values: Array) -> None:
    """Numbers without NaN and infinity.

    Raises:
        hurcules.Error: there is one; the text says which, and of which episode.
    """
    _require_none(~np.isfinite(values), f"{where}: wanted finite numbers", values)


def require_no_nan(where: str, values: Array) -> None:
    """Numbers without NaN; infinity is one: a distance of bodies that are far apart, say.

    Raises:
        hurcules.Error: there is one; the text says where.
    """
    _require_none(np.isnan(values), f"{where}: wanted numbers", values)


def _require_none(bad: NDArray[np.bool_], wanted: str, values: Array) -> None:
    """An Error with the first bad one of the values, and its place."""
    if bad.any():
        place = tuple(int(i) for i in np.argwhere(bad)[0])
        raise hurcules.Error(f"{wanted}, got {values[place]} at {place}")


def require_whole(name: str, value: object, least: int) -> None:
    """A whole number that is large enough.

    Raises:
        hurcules.Error: it is none, or smaller.
    """
    if not isinstance(value, Integral) or int(value) < least:
        raise hurcules.Error(f"{name}: wanted a whole number >= {least}, got {value!r}")


def require_flag(name: str, value: object) -> None:
    """True or False.

    Raises:
        hurcules.Error: it is something else, "false" say.
    """
    if not isinstance(value, bool | np.bool_):
        raise hurcules.Error(f"{name}: wanted True or False, got {value!r}")


def require_numbers(
    where: str, value: object, shape: tuple[int, ...], noun: str = "numbers", kinds: str = "fiub"
) -> None:
    """An array of this shape.

    Raises:
        hurcules.Error: it is none, or holds something else.
    """
    if not isinstance(value, np.ndarray) or value.shape != shape or value.dtype.kind not in kinds:
        raise hurcules.Error(f"{where}: wanted {noun} of shape {shape}, got {_came(value)}")


def _came(value: object) -> str:
    if isinstance(value, np.ndarray):
        return f"{value.dtype} of shape {value.shape}"
    return f"{type(value).__name__} {' '.join(reprlib.repr(value).split())}"
