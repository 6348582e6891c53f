"""Environments by name."""

from __future__ import annotations

import inspect
from collections.abc import Mapping, Sequence
from importlib import import_module
from typing import Any

import gymnasium
import numpy as np
from gymnasium.envs.registration import EnvSpec

import hurcules
from hurcules_envs.checks import require_flag
from hurcules_envs.environment import Environment
from hurcules_envs.episodes import Episodes
from hurcules_envs.randomisation import NAMES, split

__all__ = [
    "fidelities_of",
    "full_id",
    "make_environment",
    "make_episodes",
    "native_options",
    "register",
    "spec_of",
    "steps_of_episode",
    "takes",
    "usual_rate",
    "warn_of_rate",
]


class UnknownOption(hurcules.Error, TypeError):
    """A keyword that an environment has not: a TypeError too, as Python and TorchRL expect."""

    def __init__(self, text: str) -> None:
        """Without what `gymnasium.make` adds to a TypeError: all arguments as Python has them."""
        super().__init__(text.partition(" was raised from the environment creator")[0])


def register(
    name: str, environment: str | type[Environment], max_episode_steps: int, **options: Any
) -> None:
    """Makes an environment known to `gymnasium.make` and `gymnasium.make_vec`.

    Args:
        name: id, "Namespace/Name-v0".
        environment: a class of `Environment`, of a module or a notebook, or "module:Class" of one.
        max_episode_steps: time limit [steps].
        options: of the environment, by keyword; who makes it may give others.

    Raises:
        hurcules.Error: `environment` is neither, or a class within a function, which nothing finds
            by its name.
    """
    if isinstance(environment, type) and issubclass(environment, Environment):
        environment = f"{environment.__module__}:{environment.__qualname__}"
    _parts_of(environment)
    gymnasium.register(
        id=name,
        entry_point="hurcules_envs.single:SingleEnv",
        vector_entry_point="hurcules_envs.vector:NativeVectorEnv",
        max_episode_steps=max_episode_steps,
        kwargs={"environment": environment, **options},
    )


def make_environment(
    path: str, options: Mapping[str, Any], beside: Sequence[str] = ("flat",)
) -> Environment:
    """Builds an environment.

    Args:
        path: "module:Class".
        options: of the class, by keyword.
        beside: options that its caller takes.

    Raises:
        hurcules.Error: no such class, no such option (`UnknownOption`; the text lists those that
            exist), something else than True and False where one of these is wanted, or a keyword
            of the class that would never come to it.
    """
    kind = _class_of(path)
    known = _keywords(kind)
    for taken in known.keys() & {*beside, *NAMES}:
        raise hurcules.Error(
            f"{kind.__name__}: the keyword '{taken}' is taken, by what every environment has: "
            "call it otherwise"
        )
    for option, value in options.items():
        if option not in known:
            raise UnknownOption(
                f"option '{option}' does not exist (unexpected keyword argument '{option}'); "
                f"there are: {', '.join([*known, *beside, *NAMES])}"
            )
        if isinstance(known[option].default, bool):
            require_flag(option, value)
    return kind(**options)


def _keywords(kind: type) -> dict[str, inspect.Parameter]:
    """Of a class; what its `__init__` takes as **options are those of the class that it is of."""
    known: dict[str, inspect.Parameter] = {}
    for one in kind.__mro__:
        if "__init__" in vars(one):
            _, *own = inspect.signature(vars(one)["__init__"]).parameters.values()
            passed = (inspect.Parameter.VAR_KEYWORD, inspect.Parameter.VAR_POSITIONAL)
            known |= {p.name: p for p in own if p.kind not in passed and p.name not in known}
            if all(p.kind is not inspect.Parameter.VAR_KEYWORD for p in own):
                break
    return known


def make_episodes(name: str, n: int, seed: int, threads: int = 0, **options: Any) -> Episodes:
    """Begins episodes of an environment side by side, each to be run once.

    Args:
        name: id of the environment.
        n: how many.
        seed: of the first; the others follow.
        threads: 0 for one a processor.
        options: of the environment, and ranges of what differs between episodes.

    Raises:
        hurcules.Error: an environment without native vector, or an unknown option.
    """
    given = native_options(name, options)
    flat = given.pop("flat", False)
    ranges, given = split(given)
    environment = make_environment(given.pop("environment"), given)
    episodes = Episodes(environment, n, threads, flat=flat, ranges=ranges)
    episodes.generators = [np.random.default_rng(seed + i) for i in range(n)]
    episodes.reset()
    return episodes


def native_options(name: str, options: Mapping[str, Any]) -> dict[str, Any]:
    """What a native vector of an environment is built from: "environment", and all options.

    Args:
        name: its id.
        options: in place of those of its registration.

    Raises:
        hurcules.Error: it has no native vector.
    """
    given = {**spec_of(name).kwargs, **options}
    if "environment" not in given:
        raise hurcules.Error(
            f"{name} has no native vector: wanted an environment that was registered by "
            "hurcules_envs.register, Stretch-v1 say"
        )
    return given


def full_id(name: str) -> str:
    """The id of an environment: Reach-v0 is Hurcules/Reach-v0, where no other has that name.

    Args:
        name: as Gymnasium takes it; one of one's own with the module that registers it,
            "module:Own/Circle-v0".
    """
    name = name.removeprefix("hurcules_envs:")
    return name if "/" in name or name in gymnasium.registry else f"Hurcules/{name}"


def spec_of(name: str) -> EnvSpec:
    """How an environment is registered; the module that its id names is imported first.

    Args:
        name: its id, from `full_id`.

    Raises:
        hurcules.Error: no such module, or no such environment; the text lists those of this
            package, or those that the module's import registered.
    """
    module, _, plain = name.rpartition(":")
    if module:
        try:
            import_module(module)
        except ModuleNotFoundError as error:
            raise hurcules.Error(
                f"environment '{name}': {error}; wanted module:Namespace/Name-v0, a module in this "
                "folder or on Python's path whose import registers the environment"
            ) from error
    if plain not in gymnasium.registry:
        space = plain.split("/")[0] if module else "Hurcules"
        known = sorted(
            one.split("/")[1] for one in gymnasium.registry if one.startswith(f"{space}/")
        )
        own = not module and "/" in plain and not plain.startswith("Hurcules/")
        raise hurcules.Error(
            f"environment '{name}' does not exist; there are: {', '.join(known) or 'none'}"
            + f"; one of your own is MODULE:{plain}, with the module that registers it" * own
        )
    return gymnasium.spec(plain)


def fidelities_of(name: str) -> tuple[str, ...]:
    """The fidelities of an environment, the fastest last; none where it has no choice.

    Args:
        name: its id.
    """
    kind = _class_in(spec_of(name))
    return kind.fidelities if kind and "fidelity" in _keywords(kind) else ()


def takes(name: str, option: str) -> bool:
    """Whether the class of an environment has a keyword; no where there is no such environment.

    Args:
        name: its id.
        option: the keyword.
    """
    known = gymnasium.registry.get(name.rpartition(":")[2])
    kind = _class_in(known) if known else None
    return kind is not None and option in _keywords(kind)


def steps_of_episode(name: str, options: Mapping[str, Any]) -> int | None:
    """The registered limit of an episode [steps], longer or shorter as its `rate` differs.

    Args:
        name: its id.
        options: of the environment, by keyword.
    """
    known = spec_of(name)
    if known.max_episode_steps is None or "rate" not in options:
        return known.max_episode_steps
    return round(known.max_episode_steps * options["rate"] / usual_rate(known, options["rate"]))


def warn_of_rate(spec: EnvSpec | None, rate: float, limit: float) -> None:
    """Where episodes of another rate than the registered one have the registered limit in steps.

    Args:
        spec: of the environment; None: it was not made by its id.
        rate: that it has [Hz].
        limit: its own [steps].
    """
    known = gymnasium.registry.get(spec.id) if spec else None
    if known is None or limit != known.max_episode_steps:
        return
    usual = usual_rate(known, rate)
    if rate != usual:
        gymnasium.logger.warn(
            f"{known.id}: at rate={rate:g} an episode of {limit:g} steps lasts {limit / rate:g} s, "
            f"at the usual {usual:g} Hz {limit / usual:g} s: "
            f"max_episode_steps={round(limit * rate / usual)} keeps these"
        )


def usual_rate(known: EnvSpec, otherwise: float) -> float:
    """The rate that an environment has where none is asked for [Hz].

    Args:
        known: how it is registered.
        otherwise: where its class has no keyword `rate`.
    """
    of_class = _keywords(_class_of(known.kwargs["environment"])).get("rate")
    return float(known.kwargs.get("rate", of_class.default if of_class else otherwise))


def _class_in(spec: EnvSpec) -> type[Environment] | None:
    """The class behind an id; none of what is no `Environment`."""
    path = spec.kwargs.get("environment")
    return _class_of(path) if path else None


def _class_of(path: str) -> type[Environment]:
    module, name = _parts_of(path)
    kind = getattr(import_module(module), name, None)
    if not (inspect.isclass(kind) and issubclass(kind, Environment)):
        raise hurcules.Error(f"environment: wanted 'module:Class' of an Environment, got {path!r}")
    return kind


def _parts_of(path: str) -> list[str]:
    parts = path.split(":") if isinstance(path, str) else []
    if len(parts) != 2 or not all(parts) or "." in parts[1]:
        raise hurcules.Error(
            "environment: wanted a class of Environment at the top of a module, or 'module:Class' "
            f"of one, got {path!r}"
        )
    return parts
