"""An hour of simulated time with random commands: what goes wrong, and where the energy goes.

Two halves: the stretch, whose hands, pelvis and gaze an operator without sense moves (runs from
seed to seed), and a robot that is driven about on the flat. Commands are uniform within their
bounds and change every 0.1 to 2 s.

Each step, with f of the step and the mean of the velocities before and after it (exact for the
kinetic energy at constant inertia):
    stored energy (kinetic, gravity, springs) = drives + dampers + constraints + rest
Constraints are contacts, friction, brakes, stops and the tracks' traction; dampers and constraints
may only take. The rest is what the integrator makes or loses.

A hand that is sent into the ground or into the robot is held back: the reference yields
(control/torque_scaling.hpp). What passes a limit then is told by kind; a mechanical stop gives way
as any compliant stop does, and a joint that is pushed at the end of its range has nowhere to yield
to.

    python benchmarks/soak.py [--seconds 3600] [--seed 0]
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from dataclasses import dataclass, field

import mujoco
import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import track
from rich.table import Table

import hurcules
from hurcules import driving, scenes

DT = 1e-3
HOLD = (0.1, 2.0)  # [s] of a command
SPEED, YAW_RATE = 1.5, 0.6  # [m/s], [rad/s] of the drive at most


@dataclass
class Ledger:
    """Energies [J] of all steps so far, and what went wrong."""

    seconds: float = 0.0
    drives: float = 0.0
    dampers: float = 0.0
    constraints: float = 0.0
    stored: float = 0.0
    turned_over: float = 0.0  # |power| of the drives, integrated: the measure of the rest
    runs: int = 0
    warnings: dict[str, int] = field(default_factory=dict)
    not_finite: int = 0
    excess: dict[str, float] = field(default_factory=dict)  # by kind; nothing where not watched
    endings: dict[str, int] = field(default_factory=dict)  # of runs

    def note(self, kind: str, excess: float) -> None:
        """Keeps the worst excess of a kind."""
        self.excess[kind] = max(self.excess.get(kind, 0.0), float(excess))

    @property
    def rest(self) -> float:
        """What the terms do not explain."""
        return self.stored - self.drives - self.dampers - self.constraints


class Accountant:
    """Keeps a ledger of one physics, step by step."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, ledger: Ledger) -> None:
        model.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
        self.model, self.data, self.ledger = model, data, ledger
        self.begin()

    def begin(self) -> None:
        """A run begins: what is stored now is nobody's work."""
        mujoco.mj_forward(self.model, self.data)
        self._velocity = self.data.qvel.copy()
        self._stored = float(self.data.energy.sum())
        self.ledger.runs += 1

    def step(self, step: Callable[[], object]) -> None:
        """Takes one step and books it."""
        data, ledger = self.data, self.ledger
        step()
        mean = 0.5 * (self._velocity + data.qvel)
        drives = float(data.qfrc_actuator @ mean) * DT
        ledger.drives += drives
        ledger.turned_over += abs(drives)
        ledger.dampers += float(data.qfrc_damper @ mean) * DT
        ledger.constraints += float(data.qfrc_constraint @ mean) * DT
        self._velocity[:] = data.qvel
        ledger.seconds += DT
        ledger.not_finite += not np.isfinite(data.qvel).all()

    def end(self) -> None:
        """A run ends."""
        mujoco.mj_forward(self.model, self.data)
        self.ledger.stored += float(self.data.energy.sum()) - self._stored
        for kind in range(mujoco.mjtWarning.mjNWARNING):
            count = int(self.data.warning[kind].number)
            if count:
                name = mujoco.mjtWarning(kind).name
                self.ledger.warnings[name] = self.ledger.warnings.get(name, 0) + count


class Whim:
    """A command that is uniform in -1 .. 1 and changes now and then."""

    def __init__(self, rng: np.random.Generator, size: int) -> None:
        self._rng, self._left = rng, 0.0
        self.value = np.zeros(size)

    def tick(self) -> NDArray[np.float64]:
        """The command of this tick."""
        self._left -= DT
        if self._left <= 0.0:
            self._left = self._rng.uniform(*HOLD)
            self.value = self._rng.uniform(-1.0, 1.0, self.value.size)
        return self.value


def stretch(seconds: float, seed: int) -> Ledger:
    """The controller in command of the whole body, an operator without sense in command of it."""
    rng, ledger = np.random.default_rng(seed), Ledger()
    simulation = hurcules.Simulation("stretch", seed, record=False)
    whim = Whim(rng, len(simulation.command_names))
    accountant = Accountant(simulation.model, simulation.data, ledger)
    stops = Stops(simulation.model)
    for _ in track(range(round(seconds / DT)), "stretch"):
        command = whim.tick() * simulation.command_scale
        accountant.step(lambda command=command: simulation.step(1, command))
        ledger.note("mechanical stop, rad", stops.excess(simulation.data))
        if simulation.finished:
            _note_excess(ledger, simulation)
            ending = simulation.reason.split(" at ")[0]
            ledger.endings[ending] = ledger.endings.get(ending, 0) + 1
            accountant.end()
            seed += 1
            simulation.reset(seed)
            accountant.begin()
    _note_excess(ledger, simulation)
    accountant.end()
    return ledger


class Stops:
    """The mechanical stops of the robot's motors' joints."""

    def __init__(self, model: mujoco.MjModel) -> None:
        joints = [j for j in np.unique(model.actuator_trnid[:, 0]) if model.jnt_limited[j]]
        self._address = model.jnt_qposadr[joints]
        self._lower, self._upper = model.jnt_range[joints].T

    def excess(self, data: mujoco.MjData) -> float:
        """How far the worst joint has pressed its stop in [rad or m]."""
        q = data.qpos[self._address]
        return float(np.maximum(self._lower - q, q - self._upper).max())


def _note_excess(ledger: Ledger, simulation: hurcules.Simulation) -> None:
    measured = simulation.limit_violation()
    commanded = measured["commanded"]
    for kind, excess in (
        ("commanded range, rad", commanded["position_rad"]),
        ("commanded speed, rad/s", commanded["velocity"]),
        ("range in the physics, rad", measured["position_rad"]),
        ("speed in the physics, rad/s", measured["velocity"]),
        ("torque asked for, N m", commanded["torque"]),
        ("torque given, N m", measured["torque"]),
    ):
        ledger.note(kind, excess)


def drive(seconds: float, seed: int) -> Ledger:
    """The rescue robot driven about on the flat, joints on their brakes."""
    ledger = Ledger()
    simulation = driving.simulation(
        scenes.load("flat", "rescue"), steps=1, channels={"drive": hurcules.Drive(SPEED, YAW_RATE)}
    )
    whim = Whim(np.random.default_rng(seed), 2)
    accountant = Accountant(simulation.model, simulation.data, ledger)
    for _ in track(range(round(seconds / DT)), "drive"):
        command = whim.tick() * simulation.command_scale
        accountant.step(lambda command=command: simulation.step(1, command))
    accountant.end()
    return ledger


def excess_text(kind: str) -> Callable[[Ledger], str]:
    """What a ledger says of a kind of excess."""
    return lambda one: f"{one.excess[kind]:.2g}" if kind in one.excess else "not watched"


def show(ledgers: dict[str, Ledger]) -> None:
    """Prints the ledgers side by side."""
    table = Table("", *ledgers)
    kinds = sorted({kind for one in ledgers.values() for kind in one.excess})
    rows: dict[str, Callable[[Ledger], str]] = {
        "simulated in s": lambda one: f"{one.seconds:.0f}",
        "runs": lambda one: str(one.runs),
        "steps that were not finite": lambda one: str(one.not_finite),
        "warnings of MuJoCo": lambda one: str(one.warnings or "none"),
        "endings": lambda one: ", ".join(f"{n} x {name}" for name, n in one.endings.items()) or "-",
        **{f"excess over {kind}": excess_text(kind) for kind in kinds},
        "drives gave in kJ": lambda one: f"{one.drives / 1e3:.2f}",
        "dampers took in kJ": lambda one: f"{-one.dampers / 1e3:.2f}",
        "constraints took in kJ": lambda one: f"{-one.constraints / 1e3:.2f}",
        "stored in kJ": lambda one: f"{one.stored / 1e3:.2f}",
        "rest / work of the drives": lambda one: f"{one.rest / one.turned_over:.2%}",
    }
    for name, text in rows.items():
        table.add_row(name, *(text(ledger) for ledger in ledgers.values()))
    Console().print(table)


def main() -> None:
    """Both halves."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--seconds", type=float, default=3600.0, help="simulated, in all")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    half = arguments.seconds / 2
    show({"stretch": stretch(half, arguments.seed), "drive": drive(half, arguments.seed)})


if __name__ == "__main__":
    main()
