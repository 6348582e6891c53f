"""What differs between episodes beside the task: robot and world are not as believed.

| name                | unit  | nominal | what is drawn for an episode                             |
|---------------------|-------|---------|----------------------------------------------------------|
| `friction`          |       | 1       | factor on the sliding friction of all contacts           |
| `mass`              |       | 1       | factor on masses and inertias of the robot               |
| `motor_strength`    |       | 1       | share of the efforts commanded that its motors give      |
| `observation_noise` |       | 0       | half width of a uniform error of each number seen        |
| `action_delay`      | steps | 0       | an action takes effect so many steps of the policy later |
| `push`              | N     | 0       | on its heaviest moving part, 0.2 s every 2 s, level      |
| `payload`           | kg    | 0       | in its hands together, as much in each; Reach alone      |

The noise counts in 1 m, 1 rad, 1 m/s, 1 rad/s, 1000 N and 100 kg. The first three and the payload
are written into the model of an episode, of which its controller knows nothing.

Values are drawn uniformly from ranges by a generator of their own, so that an episode starts where
it would without them. Errors and pushes are functions of a number drawn once and of the count of
steps: nothing but numbers is remembered.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_envs.environment import Array, Environment

__all__ = [
    "NAMES", "PHYSICAL", "TOLD", "Randomisation", "Ranged", "known_ranges", "ranges_of", "split",
]  # fmt: skip

# by name: nominal value, least, most
_KNOWN: Mapping[str, tuple[float, float, float]] = {
    "friction": (1.0, 0.05, 20.0),
    "mass": (1.0, 0.1, 10.0),
    "motor_strength": (1.0, 0.05, 2.0),
    "observation_noise": (0.0, 0.0, 10.0),
    "action_delay": (0.0, 0.0, 5.0),
    "push": (0.0, 0.0, 1e4),
    "payload": (0.0, 0.0, 100.0),
}
NAMES = tuple(_KNOWN)
TOLD = tuple(f"drawn_{name}" for name in NAMES)  # in info
IN_MODEL = (*NAMES[:3], "payload")
PHYSICAL = (*IN_MODEL, "push")
DELAY = int(_KNOWN["action_delay"][2])  # steps at most
PUSH_EVERY, PUSH_FOR = 2.0, 0.2  # [s]
UNITS = {"N": 1000.0, "kg": 100.0}  # what a noise of 1 means; of others 1 of their unit
STREAM = 0x52414E44  # keeps its draws apart from those of the environment

Range = tuple[float, float]


def split(options: Mapping[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
    """What belongs here, and the other options."""
    own = {name: value for name, value in options.items() if name in _KNOWN}
    return own, {name: value for name, value in options.items() if name not in _KNOWN}


def known_ranges(options: Mapping[str, Any], *others: str) -> Mapping[str, Any]:
    """The options of a reset, all of them ranges.

    Raises:
        hurcules.Error: another one; the text lists those that exist, `others` too.
    """
    if not isinstance(options, Mapping):
        raise hurcules.Error(f"options: wanted a dictionary, got {options!r}")
    for option in options:
        hurcules.validation.require_known("reset option", str(option), [*others, *NAMES])
    return options


def ranges_of(given: Mapping[str, Any], *, physics: bool) -> dict[str, Range]:
    """Ranges by name, of values or pairs of them.

    Args:
        given: by name a number, or (least, most); None: nominal.
        physics: forces act; without them only what is seen and when is done can differ.

    Raises:
        hurcules.Error: no pair of numbers in order, one out of range, no whole steps, or a name
            that wants physics where there is none.
    """
    ranges = {}
    for name, value in given.items():
        nominal, least, most = _KNOWN[name]
        if value is None:
            ranges[name] = (nominal, nominal)
            continue
        try:
            pair = np.broadcast_to(np.asarray(value), 2)
        except ValueError:
            pair = np.full(2, None)
        low, high = pair.astype(float).tolist() if pair.dtype.kind in "fiu" else (np.nan, np.nan)
        if not least <= low <= high <= most:
            raise hurcules.Error(
                f"{name}: wanted a number or (least, most) from {least:g} to {most:g}, "
                f"got {value!r}"
            )
        if name == "action_delay" and (low % 1.0 or high % 1.0):
            raise hurcules.Error(f"{name}: wanted whole steps of the policy, got {value!r}")
        if name in PHYSICAL and not physics and (low, high) != (nominal, nominal):
            raise hurcules.Error(
                f"{name}: wants physics; fidelity 'kinematic' has none, there are: "
                + ", ".join(word for word in NAMES if word not in PHYSICAL)
            )
        ranges[name] = (low, high)
    return ranges


class Randomisation:
    """The values of n episodes of an environment.

    Attributes:
        ranges: by name, from which the next episodes draw.
        drawn: by name, (n,) what each has.
    """

    def __init__(self, environment: Environment, n: int, given: Mapping[str, Any]) -> None:
        """Nothing is drawn yet.

        Args:
            environment: of the episodes.
            n: how many.
            given: as for `ranges_of`.

        Raises:
            hurcules.Error: see there.
        """
        self._environment = environment
        self._simulation = environment.simulation
        model = self._simulation.model
        self.ranges: dict[str, Range] = {name: (row[0],) * 2 for name, row in _KNOWN.items()}
        self.drawn = {name: np.full(n, row[0]) for name, row in _KNOWN.items()}
        self.set_ranges(given)
        self._some: dict[str, bool] = {}  # by name whether any differs from 0; empty: not known
        self._seed, self._count, self._one = np.zeros(n), np.zeros(n), np.ones(n)
        self._past = np.zeros((n, 0, 0))
        self._robot = np.flatnonzero(np.isin(model.body_rootid, self._roots()))
        movable = self._robot[model.body_weldid[self._robot] > 0]  # no base that is fixed
        # of several as heavy the first
        self.pushed = int(movable[np.argmax(model.body_mass[movable])])
        groups = environment.observation
        scales = [np.full(group.size, UNITS.get(group.unit, 1.0)) for group in groups]
        self._scale = np.concatenate([*scales, np.ones(environment.goal)])
        self._scratch: mujoco.MjData | None = None
        self._varied = np.zeros(n, dtype=bool)
        self._fields = _numbers_of(model)

    def set_ranges(self, given: Mapping[str, Any]) -> None:
        """Other ranges from the next episode on; names that are not given keep theirs."""
        ranges = ranges_of(given, physics=self._simulation.physics)
        if ranges.get("payload", (0.0, 0.0)) != (0.0, 0.0) and not self._environment.bearers:
            raise hurcules.Error(
                f"payload: the hands of {type(self._environment).__name__} bear none; "
                "Reach and its twins take it"
            )
        self.ranges |= ranges

    def draw(self, i: int, seed: int) -> None:
        """Values of a new episode."""
        self._some = {}
        generator = np.random.default_rng((seed, STREAM))
        self._seed[i] = float(generator.integers(2**53))
        self._count[i] = 0.0
        for name, (low, high) in self.ranges.items():
            share = generator.random()  # always, so that one range changes no other value
            value = low + share * (high - low)
            if name == "action_delay":
                value = min(low + math.floor(share * (high - low + 1.0)), high)
            self.drawn[name][i] = value
        if self._past.size:
            self._past[i] = 0.0

    @property
    def wants_models(self) -> bool:
        """Some episode has a model that differs from the environment's, or the next one may."""
        return any(
            (self.drawn[name] != _KNOWN[name][0]).any()
            or self.ranges[name] != (_KNOWN[name][0],) * 2
            for name in IN_MODEL
        )

    def restore_model(self, i: int, model: mujoco.MjModel) -> None:
        """Writes back what the episode before changed, all that MuJoCo derived from it too."""
        if not self._varied[i]:
            return
        self._varied[i] = False
        own = self._simulation.model
        for name in (*self._fields, *_SAME):
            getattr(model, name)[:] = getattr(own, name)
        for name in _STATISTICS:
            setattr(model.stat, name, getattr(own.stat, name))

    def vary_model(self, i: int, model: mujoco.MjModel) -> None:
        """Writes the values of an episode into its model."""
        friction, mass, strength, payload = (self.drawn[name][i] for name in IN_MODEL)
        own = bool(self._environment.parameters)  # that `configure` wrote
        self._varied[i] = own or (friction, mass, strength, payload) != (1.0, 1.0, 1.0, 0.0)
        if friction != 1.0:
            model.geom_friction[:, 0] *= friction
            model.pair_friction[:, :2] *= friction
        if strength != 1.0:
            model.actuator_gainprm[:, 0] *= strength
            model.actuator_biasprm[:, :3] *= strength
            model.actuator_forcerange[:] *= strength
        if mass != 1.0:
            model.body_mass[self._robot] *= mass
            model.body_inertia[self._robot] *= mass
        bearers = self._environment.bearers
        if payload != 0.0:
            for bearer in bearers:
                _load(model, bearer, payload / len(bearers))
        if mass != 1.0 or payload != 0.0:
            if self._scratch is None:
                self._scratch = mujoco.MjData(model)
            mujoco.mj_setConst(model, self._scratch)

    def delayed(self, action: Array, mask: NDArray[np.bool_] | None) -> Array:
        """The actions that take effect now; those given join the queues of their episodes.

        Args:
            action: (n, k).
            mask: (n,) which episodes go on; None: all.
        """
        self._count += self._one if mask is None else mask
        if not self._any("action_delay"):
            return action
        delay = self.drawn["action_delay"]
        past = self._queues(action.shape[1])
        row = np.concatenate([action[:, None], past], axis=1)
        if mask is None:
            past[:] = row[:, :-1]
        else:
            past[mask] = row[mask, :-1]
        return np.ascontiguousarray(row[np.arange(len(action)), delay.astype(int)])

    def pushes(self, period: float) -> Array | None:
        """(n, 3) [N] on body `pushed` in the next step of `period` [s]; None: nobody is pushed."""
        if not self._any("push"):
            return None
        force = self.drawn["push"]
        result = np.zeros((len(force), 3))
        for i in np.flatnonzero(force):
            seed = int(self._seed[i])
            since = self._count[i] * period + PUSH_EVERY * _uniform(seed, 0)
            number, since = divmod(since, PUSH_EVERY)
            if since < PUSH_FOR:
                angle = 2.0 * math.pi * _uniform(seed, 1 + int(number))
                result[i] = force[i] * math.cos(angle), force[i] * math.sin(angle), 0.0
        return result

    def errors(self) -> Array | None:
        """(n, m) of what is seen now, then of the goal that is achieved; None: there are none."""
        if not self._any("observation_noise"):
            return None
        noise = self.drawn["observation_noise"]
        keys = np.arange(1, len(self._scale) + 1, dtype=np.uint64)
        seeds = _mixed(self._seed.astype(np.uint64) ^ _mixed(self._count.astype(np.uint64)))
        share = (_mixed(seeds[:, None] + _STEP * keys) >> np.uint64(11)) * 2.0**-53
        return np.asarray(noise[:, None] * self._scale * (2.0 * share - 1.0))

    def state(self, actions: int) -> Array:
        """(n, s) all of it, with queues of so many numbers."""
        past = self._queues(actions)
        columns = [self._seed, self._count, *self.drawn.values()]
        return np.concatenate([np.stack(columns, axis=1), past.reshape(len(past), -1)], axis=1)

    def restore(self, state: Array, mask: NDArray[np.bool_], actions: int) -> None:
        """Takes back what `state` gave."""
        self._some = {}
        columns = [self._seed, self._count, *self.drawn.values()]
        for place, column in enumerate(columns):
            column[mask] = state[mask, place]
        past = self._queues(actions)
        past[mask] = state[mask, len(columns) :].reshape(-1, *past.shape[1:])

    def _any(self, name: str) -> bool:
        """Whether some episode has another value than 0."""
        if name not in self._some:
            self._some[name] = bool(self.drawn[name].any())
        return self._some[name]

    def _queues(self, actions: int) -> Array:
        """(n, DELAY, k) the last actions, the newest first."""
        if not self._past.size:
            self._past = np.zeros((len(self._seed), DELAY, actions))
        return self._past

    def _roots(self) -> list[int]:
        """The root bodies of the robot: those of its coordinates' joints, two of two arms."""
        model = self._simulation.model
        coordinates = self._simulation.controller.plan.coordinates
        dofs = [driven.dof for coordinate in coordinates for driven in coordinate.joints]
        return np.unique(model.body_rootid[model.dof_bodyid[dofs]]).tolist()


class _Range:
    """A range as an attribute; what is set holds from the next episode on."""

    def __set_name__(self, owner: type, name: str) -> None:
        self._name = name

    def __get__(self, env: Any, owner: type) -> Any:
        if env is None:  # asked of the class
            return self
        return env._episodes.randomisation.ranges[self._name]

    def __set__(self, env: Any, value: Any) -> None:
        env._episodes.randomisation.set_ranges({self._name: value})


class Ranged:
    """An environment whose ranges are attributes: `env.unwrapped.friction = 0.6, 1.2`."""

    friction = _Range()
    mass = _Range()
    motor_strength = _Range()
    observation_noise = _Range()
    action_delay = _Range()
    push = _Range()
    payload = _Range()

    _made = False  # of a class of one's own never: it may say of itself what it likes

    def __setattr__(self, name: str, value: Any) -> None:
        """Sets an attribute.

        Raises:
            hurcules.Error: one that nobody would read, `frictoin` say.
        """
        known = name.startswith("_") or name in self.__dict__ or hasattr(type(self), name)
        if self._made and not known:
            raise hurcules.Error(
                f"attribute '{name}' does not exist; to be set there are: {', '.join(NAMES)}; all "
                "else is said by keyword where the environment is made"
            )
        super().__setattr__(name, value)


def _load(model: mujoco.MjModel, frame: str, mass: float) -> None:
    """A point of this mass [kg] at a frame, a site or a body, as a part of its body."""
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, frame)
    body = int(model.site_bodyid[site]) if site >= 0 else int(model.body(frame).id)
    place = model.site_pos[site] if site >= 0 else np.zeros(3)
    axes = np.zeros(9)
    mujoco.mju_quat2Mat(axes, model.body_iquat[body])
    R = axes.reshape(3, 3).copy()
    before, way = float(model.body_mass[body]), place - model.body_ipos[body]
    reduced = mass * before / (mass + before)
    inertia = R @ np.diag(model.body_inertia[body]) @ R.T
    inertia += reduced * (way @ way * np.eye(3) - np.outer(way, way))
    model.body_ipos[body] += mass / (mass + before) * way
    mujoco.mju_eig3(model.body_inertia[body], axes, model.body_iquat[body], inertia.ravel())
    model.body_mass[body] = mass + before
    # its centre of mass is no longer where one of its frames was
    model.body_sameframe[body] = 0
    model.geom_sameframe[model.geom_bodyid == body] = 0
    model.site_sameframe[model.site_bodyid == body] = 0


_SAME = ("body_sameframe", "geom_sameframe", "site_sameframe")
_STATISTICS = ("meaninertia", "meanmass", "meansize", "extent")
# large, and no matter of physics or never written
_SHAPES = ("mesh_", "hfield_", "tex_", "skin_", "flex", "mat_", "key_")


def _numbers_of(model: mujoco.MjModel) -> list[str]:
    """The arrays of numbers of a model, but for shapes and looks."""
    names = [name for name in dir(model) if not name.startswith(("_", *_SHAPES))]
    found = []
    for name in names:
        value = getattr(model, name)
        if isinstance(value, np.ndarray) and value.dtype == np.float64 and value.size:
            found.append(name)
    return found


_STEP = np.uint64(0x9E3779B97F4A7C15)


def _mixed(values: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """The finaliser of SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), number by number."""
    with np.errstate(over="ignore"):
        z = values + _STEP
        z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
        z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return z ^ (z >> np.uint64(31))


def _uniform(seed: int, number: int) -> float:
    """In [0, 1), by two whole numbers."""
    mixed = _mixed(_mixed(np.array([seed], np.uint64)) + np.uint64(number))
    return float((mixed[0] >> np.uint64(11)) * 2.0**-53)
