"""summary.json: what a run came to, in figures, each beside the thesis' own where it gives one."""

from __future__ import annotations

import hashlib
import platform
from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from hurcules.output import compiled, plain
from hurcules.recording import Recording
from hurcules.simulation import Simulation

__all__ = ["bounds", "figures", "processor", "summarize"]

BATTERY = ("power_W", "energy_J", "battery_share")


def summarize(
    simulation: Simulation, recording: Recording, told: Mapping[str, Any]
) -> dict[str, Any]:
    """Sums up a run.

    Args:
        simulation: after the run.
        recording: what it left.
        told: what it was made of: mission, parameters, seed, version.

    Returns:
        Plain data for JSON: numbers are finite or None.
    """
    wall, table = recording.wall_seconds, simulation.table
    return plain(
        {
            **told,
            "finished": simulation.finished,
            "success": simulation.success,
            "reason": _reason(simulation, recording),
            "simulated_seconds": simulation.time,
            "real_time_factor": simulation.time / wall if wall else None,
            "control_tick_us": _statistics(recording.control_tick_us),
            "limit_violation": simulation.limit_violation(),
            "limits": _limits(simulation),
            "figures": figures(simulation, recording.log),
            "wanted": bounds(simulation),
            "thesis": simulation.thesis_figures(),
            "events": [
                {"time_s": round(time, 6), "text": text} for time, text in simulation.events()
            ],
            "machine": {
                "processor": processor(),
                "system": platform.platform(),
                "python": platform.python_version(),
                "mujoco": mujoco.__version__,
                "numpy": np.__version__,
            },
            "table_sha256": table and hashlib.sha256(table.toml().encode()).hexdigest(),
            "model_sha256": hashlib.sha256(compiled(simulation.model)).hexdigest(),
        }
    )


def figures(simulation: Simulation, log: Mapping[str, NDArray[np.float64]]) -> dict[str, float]:
    """What a run ends with.

    Those of the battery are left out where the model has no body of this name: its standby and its
    capacity are those of Hurcules. Those of the log are left out of an empty one.
    """
    found = simulation.figures() | _of_log(log, simulation.dt)
    model = simulation.model
    names = [model.body(body).name.rpartition("/")[2] for body in range(model.nbody)]
    return found if "battery" in names else {k: v for k, v in found.items() if k not in BATTERY}


def bounds(simulation: Simulation) -> dict[str, dict[str, float]]:
    """What figures must be for a success."""
    return {
        name: {"least": least, "most": most}
        for name, (least, most) in simulation.wanted_figures().items()
    }


def _limits(simulation: Simulation) -> dict[str, dict[str, float]]:
    """Of the robot, by coordinate, in SI; a JointLimits of a stack may be narrower."""
    return {
        one.name: {
            "lower": one.lower,
            "upper": one.upper,
            "velocity": one.max_velocity,
            "effort": one.max_effort,
        }
        for one in simulation.controller.plan.coordinates
    }


def _of_log(log: Mapping[str, NDArray[np.float64]], dt: float) -> dict[str, float]:
    """What the battery gave, standby included, which share of it that is, and when it yielded."""
    if not len(log.get("power", ())):
        return {}
    return {
        "energy_J": float(np.sum(log["power"])) * dt,
        "battery_share": float(log["charge"][0] - log["charge"][-1]),
        "yielded_s": float(np.sum(log["yielding"])) * dt,
    }


def _reason(simulation: Simulation, recording: Recording) -> str:
    if recording.interrupted:
        return f"interrupted at {simulation.time:.3f} s"
    return simulation.reason or f"stopped at {simulation.time:.3f} s, as asked"


def _statistics(values: NDArray[np.float64]) -> dict[str, float | None]:
    if not len(values):
        return {"median": None, "p99": None, "max": None}
    median, p99 = np.percentile(values, (50, 99))
    return {"median": float(median), "p99": float(p99), "max": float(np.max(values))}


def processor() -> str:
    """The name of the processor, where the system tells it."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            lines = [line for line in file if line.startswith("model name")]
    except OSError:
        lines = []
    return lines[0].split(":", 1)[1].strip() if lines else platform.processor()
