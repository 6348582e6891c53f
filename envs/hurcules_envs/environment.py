"""What an author writes: one environment, for any number of episodes side by side.

A subclass of `Environment` builds a simulation, names the numbers that it reads from it after each
step, and turns them into observation, reward and success with functions over arrays (n, ...).
`SingleEnv` and `VectorEnv` make Gymnasium's interfaces of it.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from numbers import Integral, Real
from types import MappingProxyType
from typing import Any, ClassVar, TypeVar

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import _core
from hurcules.drawing import overview
from hurcules.rendering import pose
from hurcules.validation import require_known

__all__ = ["Array", "Environment", "Group", "Numbers", "Places", "Start", "tick_of", "told"]

Array = NDArray[np.float64]
Kept = TypeVar("Kept")

FIDELITIES = {"exact": 1e-3, "fast": 4e-3, "kinematic": 50e-3}  # [s] longest control tick


@dataclass(frozen=True)
class Group:
    """A part of the observation.

    Attributes:
        name: of the part.
        size: how many numbers.
        unit: their unit.
        bound: largest magnitude; what is beyond is cut off.
        text: what it is, for the page of the environment.
    """

    name: str
    size: int
    unit: str
    bound: float
    text: str = ""

    def __post_init__(self) -> None:
        """Refuses what is no size or no bound."""
        if not (isinstance(self.size, Integral) and self.size > 0 and self.bound > 0):
            raise hurcules.Error(f"Group: wanted a size >= 1 and a bound > 0, got {self}")


@dataclass
class Start:
    """How one episode starts.

    Attributes:
        qpos: (nq,) of the model; None: where the simulation was built.
        memory: by name what the episode remembers, see `Environment.memory`: a number for all of an
            entry, or (size,). What is left out begins at 0.
        info: by name a number for `info`, the same names in each episode.
    """

    qpos: Array | None = None
    memory: Mapping[str, Any] = field(default_factory=dict)
    info: Mapping[str, float] = field(default_factory=dict)


class Places(dict[str, slice]):
    """Where quantities stand in a row of what is read, by name."""

    def __init__(self, places: Mapping[str, slice]) -> None:
        super().__init__(places)
        self._runs: dict[tuple[str, ...], slice | None] = {}
        self.views: dict[str, Array] = {}  # of entries of the memory, not to be written to

    def run(self, names: tuple[str, ...]) -> slice | None:
        """Of several that stand side by side in this order; None: they do not."""
        try:
            return self._runs[names]
        except KeyError:
            places = [self[name] for name in names if name in self]
            known = 0 < len(places) == len(names)
            joined = known and all(one.stop == two.start for one, two in pairwise(places))
            self._runs[names] = slice(places[0].start, places[-1].stop) if joined else None
            return self._runs[names]


class Numbers:
    """What is known after a step, by name, one row an episode.

    `numbers["value/left"]` is (n, 3): a quantity of `Environment.quantities`, or an entry of the
    memory. `numbers.action` is (n, k) in [-1, 1], `numbers.finished` (n,) bool: the simulation is
    over, by a fall say.
    """

    def __init__(
        self,
        values: Array,
        places: Places,
        memory: dict[str, Array],
        action: Array,
        dt: float,
    ) -> None:
        values.flags.writeable = False
        self._values = values
        self._places = places  # of the quantities, by name, along the second axis
        self.memory = memory
        self.action = action
        self.dt = dt
        self._rows: dict[tuple[str, ...], Array] = {}
        self._computed: dict[str, Any] = {}

    def ended_as(self, ending: hurcules.Ending) -> NDArray[np.bool_]:
        """(n,) whose simulation is over in this way."""
        return self["ending"][:, 0] == int(ending)

    @property
    def effort(self) -> Array:
        """(n,) sum of the squares of the action."""
        return _core.squares(self.action)

    @property
    def finished(self) -> NDArray[np.bool_]:
        """(n,) whose simulation is over."""
        return self["ending"][:, 0] > 0.0

    def __getitem__(self, name: str) -> Array:
        """The quantity or entry of the memory of this name, not to be written to."""
        if name in self._places:
            return self._values[:, self._places[name]]
        if name not in self.memory:
            known = [*self._places, *self.memory]
            require_known("numbers: quantity or entry of the memory", name, known)
        entry, view = self.memory[name], self._places.views.get(name)
        if view is None or view.base is not entry:
            view = self._places.views[name] = entry.view()
            view.flags.writeable = False
        return view

    def __contains__(self, name: object) -> bool:
        """Whether there is a quantity or entry of the memory of this name."""
        return name in self._places or name in self.memory

    def row(self, *names: str) -> Array:
        """Several of them side by side, (n, ...); not to be written to."""
        run = self._places.run(names)
        if run is not None:
            return self._values[:, run]
        row = self._rows.get(names)
        if row is None:
            row = np.concatenate([self[name] for name in names], axis=1)
            if all(name in self._places for name in names):  # these stay as they are
                self._rows[names] = row
        return row

    def once(self, name: str, compute: Callable[[], Kept]) -> Kept:
        """What is computed after a step: by the first call, kept for those that follow.

        Args:
            name: under which it is kept.
            compute: gives what is kept, and not to be written to. If it takes entries of the
                memory, `remember` asks for it when it has updated these.
        """
        if name not in self._computed:
            self._computed[name] = compute()
        kept: Kept = self._computed[name]
        return kept

    def hold(self, now: NDArray[np.bool_], least: float) -> None:
        """Counts in the memory for how long something holds without a break; for `remember`.

        Its entries are `held`, the time so far [s]; `done`, 1 from when that was `least`; and,
        where there is one, `fresh`, 1 in the step in which it was.

        Args:
            now: (n,) whether it does.
            least: [s] for which it is to hold.

        Raises:
            Error: the memory has no `held` or no `done`.
        """
        for name in ("held", "done"):
            if name not in self.memory:
                raise hurcules.Error(
                    f"numbers.hold counts in the memory: it wants an entry '{name}' of one number, "
                    f"there are {', '.join(self.memory) or 'none'}"
                )
        fresh = _core.hold(now, self.dt, least, self.memory["held"], self.memory["done"])
        if "fresh" in self.memory:
            self.memory["fresh"][:, 0] = fresh

    def forget(self) -> None:
        """Has all be computed anew: episodes that stood still got their memory back."""
        self._computed.clear()


class Environment(ABC):
    """One environment.

    Attributes:
        simulation: the loop, at its start; episodes run on copies of it.
        actions: by channel what 1 in the action means [SI], one number or one a component; the
            channels of the controller that a policy commands, in this order.
        observation: its groups, one after the other.
        quantities: what is read after each step, names for hurcules.Quantities.
        memory: by name how many numbers an episode remembers.
        parameters: entries of the memory that the model follows: masses, friction, stiffness. With
            any, each episode has a model of its own, see `configure`.
        units: by action that of its numbers, one for all or one a component; "" or none: a number.
        bearers: frames of the hands that `payload` is put into; none: it is refused.
        components: by action that is no channel the names of its numbers, see `command`.
        terms: of the reward, in the order in which they are added.
        goal: how many numbers a goal has; 0: no goal environment.
        rate: steps of the policy a second [Hz]; each is a whole number of the simulation's ticks.
        task_description: what is wanted, in a sentence.
        fidelities: those that it has, the fastest last.
    """

    terms: ClassVar[tuple[str, ...]]
    task_description: ClassVar[str]
    fidelities: ClassVar[tuple[str, ...]] = tuple(FIDELITIES)

    simulation: hurcules.Simulation
    actions: Mapping[str, float | Array]
    observation: tuple[Group, ...]
    quantities: tuple[str, ...] = ()
    memory: Mapping[str, int] = MappingProxyType({})
    parameters: tuple[str, ...] = ()
    units: Mapping[str, str | Sequence[str]] = MappingProxyType({})
    components: Mapping[str, tuple[str, ...]] = MappingProxyType({})
    bearers: tuple[str, ...] = ()
    goal: int = 0
    rate: float = 20.0
    _drawn: tuple[mujoco.MjModel, mujoco.MjData] | None = None

    @abstractmethod
    def start(self, generator: np.random.Generator) -> Start:
        """Draws how an episode starts."""

    @abstractmethod
    def observe(self, numbers: Numbers) -> Mapping[str, Array]:
        """Observation by the name of its group, (n, size) each.

        A group that is not there is the quantity or the entry of the memory of its name; an Error
        says where there is none.
        """

    def groups_of(self, seen: NDArray[Any]) -> dict[str, NDArray[Any]]:
        """The groups of whole observations (n, o) by name, (n, size) each; views."""
        stops = np.cumsum([group.size for group in self.observation])
        names = [group.name for group in self.observation]
        return dict(zip(names, np.split(seen, stops[:-1], axis=1), strict=True))

    @abstractmethod
    def reward(self, numbers: Numbers) -> Mapping[str, Array]:
        """The terms of the reward, (n,) each; their sum is the reward."""

    @abstractmethod
    def succeeded(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Which episodes have what was wanted, (n,)."""

    def failed(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Which episodes are over without success, (n,); a robot that falls always is."""
        return np.zeros(len(numbers.action), dtype=bool)

    def ended(self, numbers: Numbers) -> NDArray[np.bool_]:
        """Which episodes success ends, (n,); by default none: they go on to their time limit."""
        return np.zeros(len(numbers.action), dtype=bool)

    def costs(self, numbers: Numbers) -> NDArray[np.bool_]:
        """(n,) where `cost` is 1 beside where the robot touches itself or passes a limit."""
        return np.zeros(len(numbers.action), dtype=bool)

    def tell(self, numbers: Numbers) -> Mapping[str, Array]:
        """More for `info`: by name (n,), the same names always."""
        return {}

    def remember(self, numbers: Numbers) -> None:  # noqa: B027  most remember nothing
        """Updates `numbers.memory` in place after a step, before all else is asked."""

    def configure(self, model: mujoco.MjModel, values: Mapping[str, Array]) -> None:
        """Writes the parameters of an episode into its own model, before it starts.

        MuJoCo wants `mj_setConst` after a change of masses or sizes.

        Args:
            model: that of the episode.
            values: by name each of `parameters`, (size,).

        Raises:
            NotImplementedError: there are parameters, and nothing that writes them.
        """
        raise NotImplementedError(f"{type(self).__name__} has parameters, but no configure()")

    def command(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[str, Array]:
        """What the channels are commanded by an action; by default its own parts.

        Args:
            action: by name, (n, size) [SI].
            numbers: as they were before this step.

        Returns:
            By channel, (n, size) [SI]; a channel that is not named gets zero.
        """
        return action

    def phases(self, action: Mapping[str, Array], numbers: Numbers) -> Mapping[int, str]:
        """Of a mission: by episode the phase that it begins now; by default it goes on.

        Args:
            action: as for `command`, which is asked next.
            numbers: as they were before this step.
        """
        return {}

    def compute_reward(self, achieved: Array, desired: Array, info: Any) -> Array | float:
        """Of a goal environment: the reward of other goals, any leading axes."""
        raise hurcules.Error("compute_reward: this is no goal environment")

    def goals(self, numbers: Numbers) -> tuple[Array, Array]:
        """Of a goal environment: what is achieved and what is desired, (n, goal) each."""
        raise hurcules.Error("goals: this is no goal environment")

    def camera(self) -> mujoco.MjvCamera | str:
        """From where pictures are taken: the model's camera "film", or one that looks at all."""
        model = self.simulation.model
        named = any(model.camera(i).name == "film" for i in range(model.ncam))
        return "film" if named else overview(self.simulation)

    def pictured(self, episodes: Any, i: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """The model that is drawn, and data that stands as episode i does."""
        model, data = self.drawn()
        pose(model, data, episodes.batch.qpos[i])
        return model, data

    def drawn(self) -> tuple[mujoco.MjModel, mujoco.MjData]:
        """The model that is drawn, made once, and data of it."""
        if self._drawn is None:
            model = self.visual_model()
            self._drawn = model, mujoco.MjData(model)
        return self._drawn

    def visual_model(self) -> mujoco.MjModel:
        """The simulation's model with all that is only seen."""
        return self.simulation.model

    def draw(self, episodes: Any, i: int, scene: mujoco.MjvScene) -> None:  # noqa: B027  no marks
        """Adds marks (goals, say) to the picture of episode i."""


def tick_of(fidelity: str, rate: float, known: tuple[str, ...] = tuple(FIDELITIES)) -> float:
    """Control tick [s]: the longest of this fidelity that divides the period of the policy.

    Args:
        fidelity: "exact" (1 ms), "fast" (about 4 ms) or "kinematic" (no physics, about 50 ms).
        rate: steps of the policy a second [Hz], 10 to 100.
        known: fidelities that the environment has.

    Raises:
        hurcules.Error: an unknown fidelity, or a rate out of range.
    """
    require_known("fidelity", fidelity, list(known))
    if not (isinstance(rate, Real) and 10.0 <= rate <= 100.0):
        raise hurcules.Error(f"rate: wanted 10 to 100 Hz, got {rate!r}")
    return 1.0 / rate / np.ceil(1.0 / rate / FIDELITIES[fidelity] - 1e-9)


def told(info: Any, name: str, default: float = 0.0) -> Array | float:
    """A number of `info`.

    Args:
        info: of a step, of several in a vector, or a sequence of those of single ones; None: empty.
        name: of the number.
        default: where it is not there.
    """
    if isinstance(info, Mapping):
        number: Array | float = info.get(name, default)
        return number
    infos = () if info is None else info
    return np.array([one.get(name, default) for one in infos] or default)
