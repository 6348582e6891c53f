"""Runs a simulation and keeps what the film, the log and the report are made from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from hurcules.simulation import Simulation
from hurcules.video import Frame

__all__ = ["CHANNELS", "STAGES", "Recording", "Snapshot", "record"]

Array = NDArray[np.float64]

# What the channels of log.npz are: (ticks,) each, one value a control tick. Errors that do not say
# "measured" are those of the commanded motion.
CHANNELS = (
    ("time, phase", "[s] since the start; number of the phase"),
    ("q/C, qd/C", "[rad], [rad/s] measured motion of coordinate C"),
    ("q_des/C, qd_des/C", "[rad], [rad/s] its commanded motion"),
    ("limit_lower/C, limit_upper/C", "[rad] its position limits in force"),
    ("limit_speed/C", "[rad/s] its speed limit in force, inf for none"),
    ("active/C", "-1, 0, 1: held back by its lower limit, by none, by its upper limit"),
    ("torque/J, joint_error/J", "[N m] of the motor of joint J, [rad] reference minus measured"),
    ("tracking_error", "[rad] largest `joint_error/J` of the joints that coordinates move"),
    ("error/L, measured_error/L", "[m] or [rad] norm of the task errors of level L"),
    ("active_rows/L", "rows that hold level L back"),
    ("command/K", "[m/s], [rad/s], [m], [N] what command K did; NaN: no target or force set"),
    ("base/x, base_rotation/x", "[m] position, [rad] rotation vector of the support, in the world"),
    ("base_velocity/x", "[m/s] of the support as the sensors say, along the world's axes"),
    ("power, charge", "[W] taken from the battery; what is left in it, 0 to 1"),
    ("link_age", "[s] since the last `simulation.heartbeat()`; 0 before the first"),
    ("yielding", "1 while the reference yields to more than the motors can hold, else 0"),
    ("factorizations, changes, iterations", "of the solve: of levels; of the working set"),
    ("mission/Q", "quantity Q that the conditions of the mission's phases read, unit in its name"),
    ("monitor/M", "what monitor M saw, its unit in its name: self_collision_distance_m, ..."),
    ("optimality, status", "the solver's own worst residual; number of rhqp.Status, 0: no stack"),
)
# and where force tasks press
FORCE_CHANNELS = (
    ("force/T, contact/T", "[N] read by force task T; its ContactState, 2 stopped, 3 sensor lost"),
)
# and where a person is lifted
PERSON_CHANNELS = (
    ("casualty/Q", "quantity Q of the person, unit in its name; shares are of his weight"),
    ("casualty/force/R", "[N] of the robot on region R of the body"),
)
# and where a thing is carried
LOAD_CHANNELS = (
    ("load/Q", "quantity Q of what is carried, unit in its name; shares are of its weight"),
    ("container/Q", "where the cameras see what it is put into"),
)
# What timing.npz holds, (ticks,) each [s]. It is a file of its own: log.npz is the same for a seed.
STAGES = "time, sense, kinematics, hierarchy, solve, servo, physics, record"


# a level gives way that is off its target by more than this, and comes no nearer by that in a while
GIVES_WAY, NEARER = 0.01, 0.002  # [m] or [rad]
WHILE = 0.2  # [s]


@dataclass(frozen=True)
class Snapshot:
    """The robot at an event."""

    time: float  # [s]
    text: str
    picture: NDArray[np.uint8]  # (height, width, 3)


@dataclass
class Recording:
    """A run, or as much of it as was done."""

    log: dict[str, Array] = field(default_factory=dict)  # by channel, (ticks,); see CHANNELS
    timings: dict[str, Array] = field(default_factory=dict)  # [s] by stage, (ticks,); see STAGES
    frames: list[Frame] = field(default_factory=list)
    wall_seconds: float = 0.0  # spent in the simulation alone
    interrupted: bool = False  # stopped before its end
    settles: bool = False  # in its first phase
    sliding: tuple[str, ...] = ()  # the coordinates that are counted in metres

    @property
    def control_tick_us(self) -> Array:
        """Time of each control tick, sensing to servo without physics [µs], (ticks,).

        (0,) of a simulation that is not timed.
        """
        if not self.timings:
            return np.empty(0)
        stages = ("sense", "kinematics", "hierarchy", "solve", "servo")
        return np.asarray(1e6 * sum(self.timings[stage] for stage in stages))

    @property
    def origin(self) -> float:
        """Where film and report count from [s]: the end of a first phase called "settle"."""
        if not self.log or not self.settles:
            return 0.0
        later = np.flatnonzero(self.log["phase"] > 0)
        return float(self.log["time"][later[0]]) if len(later) else 0.0

    @property
    def simulated_seconds(self) -> float:
        """Time of the last recorded tick [s]."""
        return self.frames[-1].time if self.frames else 0.0


def record(
    simulation: Simulation,
    ticks: int | None,
    ticks_per_frame: int,
    progress: Callable[[float], None],
    stopped: Callable[[], bool],
) -> Recording:
    """Steps to the end of the mission, or until it is stopped: what was recorded is kept.

    Args:
        simulation: made with record=True, and timed=True for the time of its stages.
        ticks: stop after this many at the latest; None lets the mission end.
        ticks_per_frame: between two frames of the film.
        progress: called at each frame with the speed, simulated over real time.
        stopped: whether to end early, asked before each frame.
    """
    recording = Recording(
        settles=list(simulation.phases[:1]) == ["settle"], sliding=_sliding(simulation)
    )
    moments = [_moment(simulation)]
    done = 0
    while not simulation.finished and (ticks is None or done < ticks):
        if stopped():
            recording.interrupted = True
            break
        wanted = ticks_per_frame if ticks is None else min(ticks_per_frame, ticks - done)
        started = perf_counter()
        done += simulation.step(wanted)
        recording.wall_seconds += perf_counter() - started
        moments.append(_moment(simulation))
        progress(simulation.time / recording.wall_seconds)
    recording.log, timings = simulation.log(), simulation.timings()
    recording.log.pop("tick_us", None)
    recording.timings = timings if len(timings.get("time", ())) else {}
    notes = dict(zip(simulation.phases, simulation.phase_notes, strict=False))
    recording.frames = [
        Frame(
            time,
            qpos,
            phase,
            active_limits(recording.log, time),
            notes.get(phase, ""),
            yielding_levels(recording.log, time),
        )
        for time, qpos, phase in moments
    ]
    return recording


def _sliding(simulation: Simulation) -> tuple[str, ...]:
    return tuple(one.name for one in simulation.controller.plan.coordinates if one.unit == "m")


def active_limits(log: dict[str, Array], time: float) -> tuple[str, ...]:
    """The position limits that hold a coordinate back at this time, e.g. ("HIP upper",)."""
    if not len(log["time"]):
        return ()
    tick = _tick(log, time)
    sides = {-1: "lower", 1: "upper"}
    return tuple(
        f"{channel.removeprefix('active/')} {sides[int(values[tick])]}"
        for channel, values in log.items()
        if channel.startswith("active/") and values[tick] != 0
    )


def yielding_levels(log: dict[str, Array], time: float) -> tuple[str, ...]:
    """The levels whose commanded motion is held off their targets at this time, highest first."""
    if not len(log["time"]):
        return ()
    later = _tick(log, time + WHILE)
    now = min(_tick(log, time), _tick(log, log["time"][later] - WHILE))
    return tuple(
        channel.removeprefix("error/")
        for channel, values in log.items()
        if channel.startswith("error/")
        and values[now] > GIVES_WAY
        and values[now] - values[later] < NEARER
    )


def _tick(log: dict[str, Array], time: float) -> int:
    return min(int(np.searchsorted(log["time"], time)), len(log["time"]) - 1)


def _moment(simulation: Simulation) -> tuple[float, Array, str]:
    return simulation.time, simulation.data.qpos.copy(), simulation.phase
