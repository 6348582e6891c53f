"""The closed loop: physics and controller, for any robot, with a mission or without one.

`hurcules.Simulation(model=model, controller=controller)`, then
`simulation.step(1000, {"hand": [0.1, 0.0, 0.0]})`; or `hurcules.Simulation(mission="stretch")`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from pathlib import Path
from typing import Any, TypeVar
from zipfile import BadZipFile

import mujoco
import numpy as np
from numpy.typing import ArrayLike, NDArray

from hurcules import _core, drawing, models
from hurcules._core import (
    Error,
    FallOptions,
    MonitorOptions,
    SensorOptions,
    WholeBodyController,
)
from hurcules.mission_table import Mission
from hurcules.start_checks import warn_of_forces, warn_of_physics
from hurcules.table_missions import TABLE_MISSIONS, table_mission
from hurcules.urdf import load_urdf
from hurcules.validation import require_known, told_at

__all__ = ["Simulation", "SimulationBatch", "missions"]

Array = NDArray[np.float64]
Command = Mapping[str, ArrayLike] | ArrayLike
Options = TypeVar("Options")


def missions() -> list[str]:
    """Returns the names of the missions."""
    return [*_core.missions(), *TABLE_MISSIONS]


class Simulation(_core.Simulation):
    """Plant and controller, closed at the controller's rate.

    Same start, seed and commands: same bits, here, in `hurcules run` and in `hurcules-sim`.

    Attributes:
        mission: name of the mission, None without one.
        table: hurcules.Mission of its phases, None where it has none.
        model: mujoco.MjModel of the scene.
        data: mujoco.MjData, the physics. Read it freely; who writes to it changes the run.
    """

    def __init__(
        self,
        mission: str | Path | Mission | None = None,
        seed: int = 0,
        *,
        model: mujoco.MjModel | str | Path | None = None,
        controller: WholeBodyController | None = None,
        variation: float = 1.0,
        method: str = "lexicographic",
        record: bool = True,
        timed: bool = False,
        sensors: SensorOptions | None = None,
        monitors: MonitorOptions | None = None,
        max_seconds: float = math.inf,
        physics: bool = True,
        fall: FallOptions | None = None,
        parameters: Mapping[str, Any] | None = None,
        adds_command: bool = False,
        loaded_springs: bool = False,
    ) -> None:
        """A mission in its scene, or a controller of your own in any model.

        Args:
            mission: one of `hurcules.missions()`, or the path of a TOML file whose table of phases
                runs in the scene of one; with neither a mission nor a model: "stretch". A
                `hurcules.Mission`, a table too, runs in your model with your controller.
            seed: a whole number from 0 to 2**64 - 1; draws what differs between runs.
            model: of a simulation without a mission, or the path of one. It starts where the
                controller's robot stands.
            controller: of a simulation without a mission, for this model.
            variation: of a mission, how much differs between seeds: at 1 the start of coordinates
                by 2 mrad (or mm), the place of a person by 30 mm and 50 mrad; at 0 nothing.
            method: of a mission by its name, how the hierarchy is solved, see `rhqp.SolverOptions`.
            record: keeps every signal of every tick for `log`.
            timed: keeps the time of each stage of each tick for `timings`.
            sensors: what the control loop sees of the physics; None: all of it, exactly. See
                `hurcules.sensors.realistic`.
            monitors: thresholds of the alarms; None: those of `MonitorOptions`.
            max_seconds: the run ends when it takes longer [s].
            physics: False: the robot is where it is commanded to be, at once and whatever it
                touches; nothing else moves and no force acts.
            fall: when a robot without a mission counts as fallen; None: never.
            parameters: of the mission: for "lift" and "casualty" those of `hurcules.lift.Person`,
                for "crossing" those of `hurcules.lift.Away`, for "disposal" those of
                `hurcules.disposal.Job`.
            adds_command: of a mission: a command is added to what the mission commands, and does
                not take its place.
            loaded_springs: sprung hinges without a motor start where they bear what hangs on them;
                False: where the start says, and what hangs on them sinks first. The plan is the
                same.

        Raises:
            Error: no such mission, method or sensor (the text names those that exist), a bad
                number, or a controller that does not fit the model.
        """
        if isinstance(mission, Path):
            mission = str(mission)
        is_model = isinstance(mission, str) and Path(mission).suffix in (".xml", ".mjb", ".urdf")
        if is_model or not isinstance(mission, str | Mission | None):
            raise Error(
                "mission: wanted its name, a path or a hurcules.Mission; a model of your own goes "
                f"by keyword, Simulation(model=..., controller=...); got {mission!r}"
            )
        options = _core.SimulationOptions(
            seed=_seed(seed),
            variation=_variation(variation),
            method=method,
            record=record,
            timed=timed,
            sensors=_options("sensors", sensors, SensorOptions),
            monitors=_options("monitors", monitors, MonitorOptions),
            max_seconds=_max_seconds(max_seconds),
            physics=physics,
            fall=_options("fall", fall, FallOptions),
            adds_command=adds_command,
            loaded_springs=loaded_springs,
        )
        self._seed = options.seed
        if isinstance(mission, str) and (model is not None or controller is not None):
            raise Error(
                f"mission {mission!r} has a model and a controller of its own: wanted neither "
                "beside its name"
            )
        if (model is None) != (controller is None):
            raise Error("a simulation without a mission wants both a model and a controller")
        if not isinstance(parameters, Mapping | None):
            raise Error(f"parameters: wanted a mapping, as {{'mass': 90}}, got {parameters!r}")
        if controller is not None and method != "lexicographic":
            raise Error(f"method: your controller has its own, got {method!r}")
        rows = table_mission(mission) if isinstance(mission, str) else None
        if parameters and rows is None:
            raise Error(f"mission {mission!r} takes no parameters: {', '.join(parameters)}")
        table = mission if isinstance(mission, Mission) else None
        if table is not None and controller is None:
            raise Error(
                f"mission: the table '{table.setup.name}' wants a model and a controller beside "
                "it; one that ships, or a file, has them by its name, Simulation('lift')"
            )
        if rows is not None:
            table, model = rows.table(), rows.spec(parameters or {}).compile()
            controller = _core.table_controller(rows.controller, model, method)
        self.table = table
        self._may_be_blind = False
        self.mission: str | None  # last: nothing asks a simulation that is not made
        if controller is not None:
            if not isinstance(controller, WholeBodyController):
                raise Error(f"controller: wanted a WholeBodyController, got {controller!r}")
            self.model = _model(model)
            self.data = mujoco.MjData(self.model)
            if sensors is not None:
                _require_there(sensors, controller, self.model)
            if table is None:
                super().__init__(self.model, self.data, controller, options)
            else:
                phases, setup = table.rows, table.setup
                with told_at(str(mission)) if isinstance(mission, str) else nullcontext():
                    super().__init__(self.model, self.data, controller, phases, setup, options)
            self.mission = table.setup.name if table else None
            if physics:
                warn_of_physics(self.model, controller)
            self._may_be_blind = physics and table is None
            return
        name = str(mission or "stretch")
        require_known("mission", name, missions())
        self.model = models.load(mission=name)
        self.data = mujoco.MjData(self.model)
        super().__init__(self.model, self.data, name, options)
        self.mission = name

    def reset(self, seed: int | None = None, start: ArrayLike | None = None) -> None:
        """Back to the start.

        Args:
            seed: a whole number from 0 to 2**64 - 1; draws what differs between runs. None: that
                which it was made with.
            start: (nq,) where that is this time, whatever a mission would draw.

        Raises:
            Error: another seed, or a start of another shape or not finite.
        """
        super().reset(self._seed if seed is None else _seed(seed), start)

    def step(self, n: int = 1, command: Command | None = None) -> int:
        """Takes control ticks. Releases the interpreter lock.

        Args:
            n: how many.
            command: SI values by the name of their channel (the others hold), or (k,) in the order
                of `command_names`; each is held to `command_scale`. None: the mission's operator;
                without a mission every target holds.

        Returns:
            The ticks done: fewer when the run ends.

        Raises:
            Error: an unknown channel, a wrong shape, or numbers that are not finite.
        """
        if not isinstance(n, int | np.integer):
            raise Error(f"step wants a whole number of ticks, got {n!r}")
        if self._may_be_blind:  # now: `sense` may come after the simulation is made
            self._may_be_blind = False
            warn_of_forces(self.controller)
        return super().step(n, command)

    def replay(self, log: Mapping[str, Array] | str | Path) -> int:
        """Takes the ticks of a log with the commands that they had: same start, same bits.

        What was done beside commands (`controller.use`, pushes, targets of tasks) is not in it.

        Args:
            log: of a simulation with these channels: `log()`, or `log.npz` of a run or its path.

        Returns:
            The ticks done: fewer when the run ends.

        Raises:
            Error: a file that is no log, or a channel that is not in it.
        """
        if isinstance(log, str | Path):
            log = _read_log(log)
        names = [f"command/{name}" for name in self.command_names]
        if missing := [name for name in names if name not in log]:
            raise Error(f"the log has no '{missing[0]}': it is of other channels")
        for name in names:
            if np.shape(log[name]) != np.shape(log["time"]):
                raise Error(
                    f"the log has {np.shape(log[name])} of '{name}', {np.shape(log['time'])} of "
                    "'time': its columns want one length"
                )
        rows = np.reshape([log[name] for name in names], (len(names), len(log["time"]))).T
        channels = dict(self.controller.channels)
        ends = np.cumsum(list(channels.values()))[:-1]
        done = 0
        for row in rows:
            parts = zip(channels, np.split(row, ends), strict=False)
            done += self.step(1, {name: part for name, part in parts if not np.isnan(part).any()})
        return done

    def picture(
        self,
        width: int = 640,
        height: int = 480,
        camera: str | int | mujoco.MjvCamera | None = None,
    ) -> NDArray[np.uint8]:
        """What it looks like now: targets, the ways to them, joints at their limits.

        Args:
            width: [pixels].
            height: [pixels].
            camera: of the model, by name or number, or one of MuJoCo's; None looks at all of it,
                and goes after a robot that leaves it.

        Returns:
            (height, width, 3) red, green, blue.

        Raises:
            RendererError: there is no OpenGL that works.
            Error: the model has no such camera, or a size that no picture has.
        """
        return drawing.picture(self, width, height, camera)

    def _repr_html_(self) -> str:
        return drawing.html(self)

    def __reduce__(self) -> str:
        """Refuses copy and pickle, which would make half an object."""
        raise Error(
            "a simulation is neither copied nor pickled: SimulationBatch(simulation, n) has copies "
            "of it, simulation.state() and restore() carry its state"
        )

    def __repr__(self) -> str:
        """What runs, and how far it is."""
        if not hasattr(self, "mission"):  # of a traceback: `__init__` has raised
            return "Simulation(not made)"
        what = f"mission {self.mission!r}" if self.mission else repr(self.controller)
        return f"Simulation({what}, time={self.time:.3f} s{', ' * self.finished}{self.reason})"


class SimulationBatch(_core.SimulationBatch):
    """Many copies of a simulation on threads, stepped in one call.

    The bits of each are those that it has alone, whatever the number of threads. `batch[i]` is one
    of them.
    """

    def __init__(
        self,
        simulation: Simulation,
        n: int,
        threads: int = 0,
        models: Sequence[mujoco.MjModel] = (),
    ) -> None:
        """Copies a simulation in its present state; copies record nothing.

        Args:
            simulation: to copy.
            n: how many.
            threads: 0 for one a processor.
            models: one each, of the same names and shapes (masses or friction may differ), or none
                to share the simulation's. The controllers go on reckoning with the simulation's.

        Raises:
            Error: n < 1, or models that do not fit.
        """
        if n < 1:
            raise Error(f"a batch wants n >= 1, {n} came")
        super().__init__(simulation, n, threads, list(models))
        self._controller = simulation.controller

    def __repr__(self) -> str:
        """How many, of what."""
        if not hasattr(self, "_controller"):
            return "SimulationBatch(not made)"
        return f"SimulationBatch({len(self)} of {self._controller!r})"

    def step(
        self, ticks: int, commands: Command | None = None, mask: ArrayLike | None = None
    ) -> None:
        """Takes control ticks in all. Releases the interpreter lock.

        Args:
            ticks: how many; one that is finished stands still.
            commands: SI values (n, size) by the name of their channel, or (n, k) in the order of
                `command_names`; None as in `Simulation.step`.
            mask: (n,) bool, which are stepped; None: all.

        Raises:
            Error: an unknown channel, a wrong shape, or numbers that are not finite.
        """
        super().step(ticks, commands, _mask(mask))

    def step_and_read(
        self,
        ticks: int,
        quantities: _core.Quantities,
        commands: Command | None = None,
        mask: ArrayLike | None = None,
    ) -> Array:
        """Takes control ticks in all, and reads them: faster than `step`, then `read`.

        Args:
            ticks: as for `step`.
            quantities: what is read of all, stepped or not.
            commands: as for `step`.
            mask: as for `step`.

        Returns:
            (n, m) as `read`.

        Raises:
            Error: as `step`.
        """
        return super().step_and_read(ticks, quantities, commands, _mask(mask))


def _read_log(path: str | Path) -> dict[str, Array]:
    try:
        with np.load(path) as file:
            return dict(file)
    except (OSError, ValueError, AttributeError, BadZipFile, EOFError) as error:
        raise Error(f"replay: cannot read {path} as a log: {error}") from None


def _mask(mask: ArrayLike | None) -> Any:
    return None if mask is None else np.asarray(mask, bool).tolist()


def _numbers(what: str, values: ArrayLike) -> Array:
    try:
        return np.asarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise Error(f"{what}: wanted numbers, got {values!r}") from None


def _model(model: mujoco.MjModel | str | Path | None) -> mujoco.MjModel:
    if isinstance(model, mujoco.MjModel):
        return model
    if not isinstance(model, str | Path):
        remedy = ""
        if isinstance(model, mujoco.MjSpec):
            remedy = "; its compile() gives one"
        elif isinstance(getattr(model, "ptr", None), mujoco.MjModel):
            remedy = "; its ptr is one"  # of dm_control
        elif isinstance(getattr(getattr(model, "model", None), "ptr", None), mujoco.MjModel):
            remedy = "; its model.ptr is one"
        raise Error(f"model: wanted a mujoco.MjModel or the path of one, got {model!r}{remedy}")
    if Path(model).suffix == ".urdf":
        return load_urdf(model)
    try:
        return mujoco.MjModel.from_xml_path(str(model))
    except ValueError as error:
        raise Error(f"cannot read {model}: {' '.join(str(error).split())}") from None


def _options(name: str, value: Options | None, kind: type[Options]) -> Options:
    if value is not None and not isinstance(value, kind):
        raise Error(f"{name}: wanted {kind.__name__}, got {value!r}")
    return value or kind()


def _require_there(
    sensors: SensorOptions, controller: WholeBodyController, model: mujoco.MjModel
) -> None:
    """Sensors of Hurcules are not asked of a robot that has none such."""
    known, there = _core.realistic_sensors(), _core.realistic_sensors(controller.plan)
    lacks = [name for name in known.models if name in sensors.models and name not in there.models]
    site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, sensors.range.site)
    if sensors.range.rays and site < 0:
        lacks.append(f"range (a site '{sensors.range.site}')")
    if lacks:
        raise Error(
            f"sensors: the model lacks {', '.join(lacks)}; hurcules.sensors.realistic(robot) "
            "leaves out what a robot has not"
        )


def _max_seconds(value: object) -> float:
    number = isinstance(value, int | float | np.integer | np.floating)
    if not number or not (seconds := float(value)) > 0:  # type: ignore[arg-type]
        raise Error(f"max_seconds: wanted a time above 0 [s], got {value!r}")
    return seconds


def _seed(value: object) -> int:
    whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
    if not whole or not 0 <= (seed := int(value)) < 2**64:  # type: ignore[call-overload]
        raise Error(f"seed: wanted a whole number from 0 to 2**64 - 1, got {value!r}")
    return seed


def _variation(value: object) -> float:
    number = isinstance(value, int | float | np.integer | np.floating)
    if not number or isinstance(value, bool) or not 0 <= (variation := float(value)) < math.inf:  # type: ignore[arg-type]
        raise Error(f"variation: wanted a number >= 0, got {value!r}")
    return variation
