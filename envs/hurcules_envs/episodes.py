"""Episodes of one environment, side by side on a batch of simulations."""

from __future__ import annotations

import copy
import reprlib
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import Any

import mujoco
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

import hurcules
from hurcules import _core
from hurcules_envs.checks import (
    CheckedEnvironment,
    read_once,
    require_attributes,
    require_finite,
    require_flag,
    require_names,
    require_no_nan,
    require_numbers,
    require_unchanged,
    warn_of_still_things,
)
from hurcules_envs.copies import GENERATOR, generator_numbers, generator_state, model_number
from hurcules_envs.environment import Array, Environment, Numbers, Places, Start
from hurcules_envs.randomisation import TOLD, Randomisation

__all__ = ["Episodes", "Step", "numbers_of", "seeds_of", "state_of"]

# what `judge` reads, and its names in info; the first is the cost, read is the ending
_READ, _JUDGED = zip(*_core.judged(), strict=True)
_CLAIMS = ("failed", "ended", "costs")  # methods of an environment
_FLAGS = ("is_success", "failed", "ending")  # in info too


@dataclass
class Step:
    """What a step gave, arrays over the episodes.

    Attributes:
        observation: by its parts.
        reward: (n,).
        terminated: (n,).
        success: (n,).
        failed: (n,).
        ending: (n,).
        told: (k, n) what else stands in `info`.
        names: of the rows of `told`.
        more: what the environment tells beside.
        kept: `info` with all names, and what stays as it is until a reset.
    """

    observation: dict[str, NDArray[np.float32]]
    reward: Array
    terminated: NDArray[np.bool_]
    success: NDArray[np.bool_]
    failed: NDArray[np.bool_]
    ending: NDArray[np.int64]
    told: Array
    names: tuple[str, ...]
    more: dict[str, NDArray[Any]]
    kept: _Kept

    @property
    def info(self) -> dict[str, NDArray[Any]]:
        """All of `info`, (n,) each."""
        info = self.kept.info.copy()
        info.update(zip(self.names, self.told, strict=True))
        info["is_success"], info["failed"], info["ending"] = self.success, self.failed, self.ending
        info.update(self.more)
        return info

    @property
    def info_of_one(self) -> dict[str, Any]:
        """The same of the first episode, numbers of numpy: TorchRL asks for their dtype.

        Flags are arrays: of a bool of numpy Gymnasium's vectors make objects.
        """
        info = self.kept.info_of_one.copy()
        info.update(zip(self.names, self.told[:, 0], strict=True))
        info["is_success"] = _first(self.success)
        info["failed"], info["ending"] = self.failed[0, ...], self.ending[0]
        for name, values in self.more.items():
            info[name] = _first(values)
        return info


class _Kept:
    """`info` as it is between two resets.

    Attributes:
        info: by all of its names an array (n,), None of what each step tells.
        info_of_one: the same of the first episode, numbers.
    """

    def __init__(self, names: Iterable[str], given: Mapping[str, Array]) -> None:
        """Copies what is given, which is not to be written to then."""
        self.info: dict[str, Any] = dict.fromkeys(names)
        for name, values in given.items():
            kept = self.info[name] = values.copy()
            kept.flags.writeable = False
        self.info_of_one = {n: None if kept is None else kept[0] for n, kept in self.info.items()}


class Episodes:
    """N episodes of one environment.

    Attributes:
        batch: their simulations.
        period: of a step [s].
        generators: one each, for what differs between episodes.
        action_names: what each number of the action commands.
        action_scale: (k,) what 1 means [SI].
        action_units: their units, "m/s" say; "" for a mere number.
        observation_names: what each number of the observation is, see `SingleEnv`.
        memory: by name what each remembers, (n, size).
        randomisation: what differs between them beside the task.
        single_action_space: Box(-1, 1, (k,), float32).
        single_observation_space: a Box, or a Dict of a goal environment.
    """

    def __init__(
        self,
        environment: Environment,
        n: int,
        threads: int,
        *,
        flat: bool = False,
        ranges: Mapping[str, Any] = MappingProxyType({}),
    ) -> None:
        """Copies the environment's simulation n times.

        Args:
            environment: what runs.
            n: how many episodes.
            threads: 0 for one a processor.
            flat: of a goal environment: one array of the observation and the way from what is
                achieved to what is desired, in place of a dictionary.
            ranges: from which the values of `randomisation` are drawn.

        Raises:
            hurcules.Error: ranges that are none.
        """
        self.environment = environment
        self.n = n
        self._name = type(environment).__name__
        require_attributes(environment, _READ)
        warn_of_still_things(environment)
        self._checked = CheckedEnvironment(environment, n)
        self._asked: Any = self._checked  # until the first step is done
        require_flag("flat", flat)
        self._flat = flat and environment.goal > 0
        simulation = environment.simulation
        self.randomisation = Randomisation(environment, n, ranges)
        self._threads = threads
        self._models: list[mujoco.MjModel] = []
        self._pushed = False  # forces act since the last step
        own = bool(environment.parameters) or self.randomisation.wants_models
        self._copy_simulation(own_models=own)
        self.generators = [np.random.default_rng() for _ in range(n)]
        names = [*environment.quantities, *_READ]
        kind = type(environment)
        self._claimed = {
            name: getattr(kind, name) is not getattr(Environment, name) for name in _CLAIMS
        }
        self._tells = kind.tell is not Environment.tell
        self._nobody = np.zeros(n, dtype=bool)
        self._quantities = hurcules.Quantities(simulation, names)
        stops = np.cumsum(self._quantities.sizes)
        self._places = Places(
            {
                name: slice(int(stop) - size, int(stop))
                for name, size, stop in zip(names, self._quantities.sizes, stops, strict=True)
            }
        )
        self._values: Array | None = None  # what is read now; None: nobody has
        self._commands = _Commands(environment, n)
        self.action_names, self.action_scale = self._commands.names, self._commands.scale
        self.action_units = self._commands.units
        self.memory = {name: np.zeros((n, size)) for name, size in environment.memory.items()}
        self._info: dict[str, Array] = {}
        self._terms = dict.fromkeys(environment.terms)
        self._names = (*(f"reward_{name}" for name in environment.terms), *_JUDGED)  # in info
        self._told: set[str] | None = None  # names of `tell`
        self._kept: _Kept | None = None  # None: other things were drawn since
        self._worst = np.zeros(n)
        self._action = np.zeros((n, len(self.action_scale)))
        self._ticks = round(1.0 / environment.rate / simulation.dt)
        self.period = self._ticks * simulation.dt
        self._made_of = read_once(environment)
        self._make_spaces()

    def reset(self, mask: NDArray[np.bool_] | None = None) -> None:
        """New episodes, drawn by their generators.

        Args:
            mask: (n,) which; None: all.

        Raises:
            hurcules.Error: an attribute was changed that is read once, when the episodes are made.
        """
        require_unchanged(self.environment, self._made_of)
        chosen = np.ones(self.n, dtype=bool) if mask is None else mask
        starts = np.tile(self._initial, (self.n, 1))
        seeds = [0] * self.n
        for i in np.flatnonzero(chosen):
            generator = self.generators[i]
            seeds[i] = int(generator.integers(2**31))
            self.randomisation.draw(int(i), seeds[i])
            start = self._checked.start(generator)
            if start.qpos is not None:
                starts[i] = start.qpos
            self._remember_start(int(i), start)
        self._give_models()
        for i in np.flatnonzero(chosen):
            self._configure(int(i))
        self.batch.reset(seeds, chosen.tolist(), starts)
        self._kept = None
        before, self._values = self._values, None
        if before is not None:
            self._values = np.where(chosen[:, None], self._read(), before)
        self._action[chosen] = 0.0
        self._worst[chosen] = 0.0

    def step(self, action: Array, mask: NDArray[np.bool_] | None = None) -> None:
        """Holds the commands for one period.

        Args:
            action: (n, k) checked, in [-1, 1].
            mask: (n,) which episodes go on; None: all.
        """
        self._action = action if mask is None else np.where(mask[:, None], action, 0.0)
        forces = self.randomisation.pushes(self.period)
        taken = self.randomisation.delayed(self._action, mask)
        commands = self._commands.of(taken, lambda: self._numbers(self._read()), self._go)
        if forces is not None or self._pushed:
            self._pushed = forces is not None
            still = np.zeros((self.n, 3))
            self.batch.push(self.randomisation.pushed, still if forces is None else forces)
        self._values = self.batch.step_and_read(self._ticks, self._quantities, commands, mask)

    def look(self, *, remember: NDArray[np.bool_] | None) -> Step:
        """Reads the simulations and judges.

        Args:
            remember: (n,) whose memory goes on; None: nobody's (after a reset).
        """
        values = self._read()
        numbers = self.numbers = self._numbers(values)
        environment = self._asked
        if remember is not None:
            self._remember(numbers, remember)
        terms = environment.reward(numbers)
        if terms.keys() != self._terms.keys():
            require_names(f"{self._name}.reward", "term", terms, self._terms)
        success = environment.succeeded(numbers)
        fails, ends, costs = [
            getattr(environment, name)(numbers) if claimed else self._nobody
            for name, claimed in self._claimed.items()
        ]
        reward, failed, terminated, ending, told, finite = _core.judge(
            values, [terms[name] for name in self._terms], fails, ends, costs, self._worst
        )
        if not finite:
            for name, term in terms.items():
                require_finite(f"{self._name}.reward: term '{name}'", term)
        more = self._tell(numbers) if self._tells or self._told is None else {}
        observation = self._observe(numbers)
        if remember is not None:
            self._asked = self.environment
        return Step(
            observation, reward, terminated, success, failed, ending, told, self._names, more,
            self._kept or self._keep(more),
        )  # fmt: skip

    def _keep(self, more: Mapping[str, Any]) -> _Kept:
        """What stays in info until the next reset."""
        drawn = dict(zip(TOLD, self.randomisation.drawn.values(), strict=True))
        terms = self._names[: len(self._terms)]
        names = [*terms, *_FLAGS, *_JUDGED, *drawn, *self._info, *more]
        self._kept = _Kept(names, drawn | self._info)
        return self._kept

    @cached_property
    def _model_number(self) -> float:
        return model_number(self.environment.simulation.model)

    def state(self) -> Array:
        """(n, s) everything that decides how the episodes go on."""
        made = np.tile([self.environment.rate, self._model_number], (self.n, 1))
        parts = [made, self.batch.state(), self._action, self._worst[:, None]]
        parts += [np.stack([generator_numbers(one) for one in self.generators])]
        parts += [self.randomisation.state(self._action.shape[1])]
        parts += [self.memory[name] for name in self.memory]
        parts += [entry[:, None] for entry in self._info.values()]
        parts += [self._read()]  # forces of contacts are not in the state of a simulation
        return np.concatenate(parts, axis=1)

    def restore(self, state: object, mask: NDArray[np.bool_] | None = None) -> None:
        """Goes back to a state from `state`: the same actions then give the same bits.

        Raises:
            hurcules.Error: it is no state, has NaN, or belongs to another environment or version.
        """
        drawn = self.randomisation.state(self._action.shape[1]).shape[1]
        rest = self._action.shape[1] + 1 + GENERATOR + drawn + len(self._info)
        rest += sum(entry.shape[1] for entry in self.memory.values())
        seen = self._read().copy()
        rest += seen.shape[1]
        own = self.batch.state().shape[1]
        values = state_of(state, (self.n, 2 + own + rest))
        # of what was read one may be NaN: the margin of a robot that cannot tip
        require_no_nan("state", values[:, : -seen.shape[1]])
        chosen = np.ones(self.n, dtype=bool) if mask is None else mask
        (rates, models), values = values[chosen, :2].T, values[:, 2:]
        place = own + self._action.shape[1] + 1
        generators = {
            int(i): generator_state(values[i, place : place + GENERATOR])
            for i in np.flatnonzero(chosen)
        }
        if (other := rates != self.environment.rate).any():
            raise hurcules.Error(
                f"state: wanted one of rate={self.environment.rate:g} Hz, "
                f"got one of {rates[other][0]:g} Hz"
            )
        if (models != self._model_number).any():
            raise hurcules.Error(
                "state: wanted one of this model, got one of another robot, ground or fidelity"
            )
        self.batch.restore(values[:, :own], chosen.tolist())
        for episode, numbers in generators.items():
            self.generators[episode].bit_generator.state = numbers
        seen[chosen] = values[chosen, -seen.shape[1] :]
        self._values = seen
        place = own
        entries = [self._action, self._worst[:, None]]
        for entry in entries:
            entry[chosen] = values[chosen, place : place + entry.shape[1]]
            place += entry.shape[1]
        place += GENERATOR
        self.randomisation.restore(values[:, place : place + drawn], chosen, self._action.shape[1])
        place += drawn
        for entry in self.memory.values():
            entry[chosen] = values[chosen, place : place + entry.shape[1]]
            place += entry.shape[1]
        for entry in self._info.values():
            entry[chosen] = values[chosen, place]
            place += 1
        self._kept = None
        self._give_models()
        if self._models:  # the first time it was checked, now it meets the model that it had
            for i in np.flatnonzero(chosen):
                self._configure(int(i))
            self.batch.restore(values[:, :own], chosen.tolist())

    def checked(self, action: object, shape: tuple[int, ...]) -> Array:
        """The action as float64.

        Raises:
            hurcules.Error: no array of numbers, another shape, NaN or infinity.
        """
        given = _array_of("action", action)
        if given.shape != shape:
            raise hurcules.Error(f"action: wanted shape {shape}, got {given.shape}")
        values, finite = _core.clipped(given)
        if not finite:
            bad = tuple(int(i) for i in np.argwhere(~np.isfinite(given))[0])
            raise hurcules.Error(f"action: wanted finite numbers, got {given[bad]} at index {bad}")
        return values

    def _copy_simulation(self, *, own_models: bool) -> None:
        """A batch of copies of the environment's simulation."""
        simulation = self.environment.simulation
        count = self.n if own_models else 0
        self._models = [copy.copy(simulation.model) for _ in range(count)]
        self.batch = hurcules.SimulationBatch(simulation, self.n, self._threads, self._models)
        self._pushed = False

    def _give_models(self) -> None:
        """A model of its own for each episode, from when one is to differ."""
        if self._models or not self.randomisation.wants_models:
            return
        state = self.batch.state()
        self._copy_simulation(own_models=True)
        self.batch.restore(state)

    def _remember_start(self, i: int, start: Start) -> None:
        for name, entry in self.memory.items():
            entry[i] = start.memory.get(name, 0.0)
        if self._info:
            require_names(f"{self._name}.start", "name in info", start.info, self._info)
        for name, value in start.info.items():
            self._info.setdefault(name, np.zeros(self.n))[i] = value

    def model(self, i: int) -> mujoco.MjModel:
        """Of episode i, with what was drawn for it; one for all where nothing is drawn."""
        return self._models[i] if self._models else self.environment.simulation.model

    def _configure(self, i: int) -> None:
        if not self._models:
            return
        self.randomisation.restore_model(i, self._models[i])
        if self.environment.parameters:
            values = {name: self.memory[name][i] for name in self.environment.parameters}
            self.environment.configure(self._models[i], values)
        self.randomisation.vary_model(i, self._models[i])

    def _read(self) -> Array:
        if self._values is None:
            self._values = self.batch.read(self._quantities)
        return self._values

    def _numbers(self, values: Array) -> Numbers:
        return Numbers(values, self._places, self.memory, self._action, self.period)

    def _remember(self, numbers: Numbers, mask: NDArray[np.bool_]) -> None:
        """A step in the memory of those of a mask."""
        if np.count_nonzero(mask) == self.n:
            self._asked.remember(numbers)
            return
        kept = {name: values[~mask] for name, values in self.memory.items()}
        self._asked.remember(numbers)
        for name, values in kept.items():
            self.memory[name][~mask] = values
        numbers.forget()

    def _go(self, phases: Mapping[int, str]) -> None:
        for i, phase in phases.items():
            self.batch[i].go(phase)

    def _make_spaces(self) -> None:
        environment = self.environment
        self._initial = np.array(environment.simulation.data.qpos)
        high = np.concatenate([np.full(g.size, g.bound) for g in environment.observation])
        self._high = high.astype(np.float32)
        self._low = -self._high
        self._bound, self._seen_names = self._high, ["observation"]
        self._groups = [group.name for group in environment.observation]
        parts = [(group.name, group.size) for group in environment.observation]
        if self._flat:
            parts.append(("to_goal", environment.goal))
        self.observation_names = [
            f"{name}_{i}" if size > 1 else name for name, size in parts for i in range(size)
        ]
        box = spaces.Box(self._low, self._high, dtype=np.float32)
        self.single_action_space = spaces.Box(-1.0, 1.0, self.action_scale.shape, np.float32)
        self.single_observation_space: spaces.Space[Any] = box
        if self._flat:
            high, self._bound = (
                np.concatenate([self._high, np.full(environment.goal, most, np.float32)])
                for most in (100.0, np.inf)  # goals are not cut
            )
            self.single_observation_space = spaces.Box(-high, high, dtype=np.float32)
        elif environment.goal:
            self._seen_names += ["achieved_goal", "desired_goal"]
            goal = spaces.Box(-100.0, 100.0, (environment.goal,), np.float32)
            self.single_observation_space = spaces.Dict(
                {"observation": box, "achieved_goal": goal, "desired_goal": goal}
            )

    def compute_reward(self, achieved: Array, desired: Array, info: Any) -> Array | float:
        """Of a goal environment: the reward of other goals, any leading axes.

        Args:
            achieved: (..., goal).
            desired: (..., goal), of the same shape.
            info: of a step, of several in a vector, or a sequence of those of single ones.

        Raises:
            hurcules.Error: goals of another shape, or of two.
        """
        one, other, goal = np.shape(achieved), np.shape(desired), self.environment.goal
        if one != other or one[-1:] != (goal,):
            raise hurcules.Error(
                f"compute_reward: wanted achieved and desired of one shape (..., {goal}), "
                f"got {one} and {other}"
            )
        infos = 0 if info is None or isinstance(info, Mapping) else len(info)
        if infos > 1 and infos not in one[-2:-1]:
            raise hurcules.Error(
                f"compute_reward: wanted an info for each goal, got {infos} for {one[:-1]}"
            )
        return self.environment.compute_reward(achieved, desired, info)

    def observe(self, *, noise: bool) -> dict[str, NDArray[np.float32]]:
        """What is seen now, with its errors or without."""
        self.numbers = self._numbers(self._read())
        return self._observe(self.numbers, noise=noise)

    def _observe(self, numbers: Numbers, *, noise: bool = True) -> dict[str, NDArray[np.float32]]:
        groups = self._asked.observe(numbers)
        parts = [groups[name] if name in groups else numbers[name] for name in self._groups]
        errors = self.randomisation.errors() if noise else None
        size = len(self._high)
        goals: tuple[Array, ...] = ()
        given = goals
        if self.environment.goal:
            goals = given = self._asked.goals(numbers)
            if errors is not None:
                goals = given[0] + errors[:, size:], given[1]
                errors = errors[:, :size]
            if self._flat:
                parts.append(goals[1] - goals[0])
                goals = ()
        seen, finite = _core.seen(parts, self._bound, errors, goals)
        if not finite:
            for name, part in zip(self._groups, parts, strict=False):
                require_finite(f"{self._name}.observe: '{name}'", part)
            for name, part in zip(("achieved", "desired"), given, strict=False):
                require_finite(f"{self._name}.goals: {name}", part)
        return dict(zip(self._seen_names, seen, strict=True))

    def _tell(self, numbers: Numbers) -> dict[str, NDArray[Any]]:
        """What the environment tells beside what is in info; its names stay the same."""
        more = {name: np.array(row) for name, row in self._asked.tell(numbers).items()}
        if self._told is None:
            self._told = set(more)
            there = [*self._names, *_FLAGS, *TOLD]
            for method, given in (("start", self._info), ("tell", more)):
                if taken := [name for name in given if name in there]:
                    raise hurcules.Error(f"{self._name}.{method}: '{taken[0]}' is in info already")
                there += given
        elif more.keys() != self._told:
            require_names(f"{self._name}.tell", "name", more, self._told)
        return more


class _Commands:
    """From actions in [-1, 1] to commands of the controller."""

    def __init__(self, environment: Environment, n: int) -> None:
        simulation = environment.simulation
        names, scale = simulation.command_names, np.array(simulation.command_scale)
        self._environment = environment
        self._channels: dict[str, slice] = {}
        place = 0
        for channel, size in simulation.controller.channels:
            self._channels[channel] = slice(place, place + size)
            place += size
        self._size = place
        self._parts: dict[str, slice] = {}
        self.names: list[str] = []
        self.units: list[str] = []
        scales = []
        where = f"{type(environment).__name__}.units"
        known = [*environment.actions, *self._channels]
        require_names(where, "action", environment.units, known, complete=False)
        for action, most in environment.actions.items():
            components, largest = environment.components.get(action), np.array(np.inf)
            if components is None:
                hurcules.validation.require_known("channel", action, list(self._channels))
                components = tuple(names[self._channels[action]])
                largest = scale[self._channels[action]]
            if np.shape(most) not in ((), (len(components),)):
                raise hurcules.Error(
                    f"{type(environment).__name__}.actions: '{action}' has {len(components)} "
                    f"numbers, got scales of shape {np.shape(most)}"
                )
            if (np.asarray(most) > largest + 1e-12).any():
                raise hurcules.Error(
                    f"action '{action}': its scale of {most} is larger than {largest}, that of "
                    "its channel"
                )
            self._parts[action] = slice(len(self.names), len(self.names) + len(components))
            unit = environment.units.get(action, "")
            units = [unit] * len(components) if isinstance(unit, str) else [*unit]
            if len(units) != len(components):
                raise hurcules.Error(
                    f"{where}: '{action}' has {len(components)} numbers, got {len(units)} units"
                )
            self.names += components
            self.units += units
            scales.append(np.broadcast_to(most, len(components)))
        self.scale = np.concatenate(scales).astype(np.float64)
        self._scales = np.tile(self.scale, (n, 1))  # of one shape with the actions: half the time
        self._turns = type(environment).command is not Environment.command
        # actions that are the commands, number by number
        self._same = not self._turns and list(self._parts.items()) == list(self._channels.items())

    def of(
        self,
        action: Array,
        numbers: Callable[[], Numbers],
        go: Callable[[Mapping[int, str]], None],
    ) -> Array:
        """(n, k) commands; the numbers are read only where an environment turns its action."""
        scaled = action * self._scales
        if self._same:
            return scaled
        parts = {name: scaled[:, part] for name, part in self._parts.items()}
        given: Mapping[str, Array] = parts
        if self._turns:
            read = numbers()
            go(self._environment.phases(parts, read))
            given = self._environment.command(parts, read)
        commands = np.zeros((len(action), self._size))
        try:
            for name, values in given.items():
                part = commands[:, self._channels[name]]
                if values.shape != part.shape:
                    raise ValueError(name)
                part[:] = values
        except (KeyError, TypeError, ValueError, AttributeError):
            self._refuse(given, len(action))
            raise
        return commands

    def _refuse(self, given: Any, n: int) -> None:
        """Says which command of the environment is none."""
        where = f"{type(self._environment).__name__}.command"
        require_names(where, "channel", given, self._channels, complete=False)
        for name, place in self._channels.items():
            if name in given:
                require_numbers(f"{where}: '{name}'", given[name], (n, place.stop - place.start))


def numbers_of(what: str, values: object) -> Array:
    """Any array of numbers as float64.

    Raises:
        hurcules.Error: it is none; the text says what came.
    """
    return _array_of(what, values).astype(np.float64)


def _first(values: NDArray[Any]) -> Any:
    return values[0, ...].copy() if values.dtype.char == "?" else values[0]


def _array_of(what: str, values: object) -> NDArray[Any]:
    """The same, of its own kind of numbers."""
    try:
        array = np.asarray(values)
        if array.dtype.kind in "fiu":
            return array
    except (TypeError, ValueError):  # ragged lists and the like
        pass
    came = " ".join(reprlib.repr(values).split())
    raise hurcules.Error(f"{what}: wanted an array of numbers, got {came}")


def state_of(state: object, shape: tuple[int, ...]) -> Array:
    """A state as float64.

    Raises:
        hurcules.Error: no array of numbers, or one of another shape.
    """
    values = numbers_of("state", state)
    if values.shape != shape:
        raise hurcules.Error(
            f"state: wanted shape {shape}, got {values.shape}: it belongs to another environment, "
            "or to other options of this one"
        )
    return values


def seeds_of(seed: int | Sequence[int | None] | None, n: int) -> list[int | None]:
    """One seed an episode: seed + i, a list as it is, or None each.

    Raises:
        hurcules.Error: a list of another length, or no whole numbers >= 0.
    """
    if seed is None:
        return [None] * n
    if isinstance(seed, int | np.integer):
        seed = [int(seed) + i for i in range(n)]
    if isinstance(seed, str) or not hasattr(seed, "__len__") or len(seed) != n:
        raise hurcules.Error(f"seed: wanted a whole number, or {n} of them, got {seed!r}")
    for one in seed:
        if one is not None and not (isinstance(one, int | np.integer) and one >= 0):
            raise hurcules.Error(f"seed: wanted whole numbers >= 0, got {one!r}")
    return list(seed)
