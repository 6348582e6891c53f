"""A mission in its scene: the C++ loop, stepped from Python.

`simulation = hurcules.Simulation("stretch", seed=0)`, then `simulation.step(100)` for 0.1 s, as
long as it is not `simulation.finished`.
"""

from __future__ import annotations

import math

import mujoco
import numpy as np

from hurcules import _core, models
from hurcules._core import Error, MonitorOptions, SensorOptions
from hurcules.validation import require_known

__all__ = ["Simulation"]


class Simulation(_core.Simulation):
    """Robot, scene, controller and mission, closed at 1 kHz.

    Same mission, seed and commands: same bits, here, in `hurcules run` and in `hurcules-sim`.

    Attributes:
        mission: name of the mission.
        model: mujoco.MjModel of the scene.
        data: mujoco.MjData, the physics. Read it freely; who writes to it changes the run.
    """

    def __init__(
        self,
        mission: str = "stretch",
        seed: int = 0,
        *,
        variation: float = 1.0,
        method: str = "lexicographic",
        record: bool = True,
        timed: bool = False,
        sensors: SensorOptions | None = None,
        monitors: MonitorOptions | None = None,
    ) -> None:
        """Loads the mission's scene and stands at its start.

        Args:
            mission: one of `hurcules.missions()`.
            seed: a whole number from 0 to 2**64 - 1; draws what differs between runs.
            variation: how much differs between seeds: 1 as the mission says, 0 nothing.
            method: how the hierarchy is solved, see `rhqp.SolverOptions`.
            record: keeps every signal of every tick for `log`.
            timed: keeps the time of each stage of each tick for `timings`.
            sensors: what the control loop sees of the physics; None: all of it, exactly. See
                `hurcules.sensors.realistic`.
            monitors: thresholds of the alarms; None: those of `MonitorOptions`.

        Raises:
            Error: no such mission, method or sensor (the text names those that exist), or a bad
                number.
        """
        require_known("mission", mission, _core.missions())
        options = _core.SimulationOptions(
            seed=_seed(seed),
            variation=_variation(variation),
            method=method,
            record=record,
            timed=timed,
            sensors=sensors or SensorOptions(),
            monitors=monitors or MonitorOptions(),
        )
        self.mission = mission
        self.model = models.load(mission=mission)
        self.data = mujoco.MjData(self.model)
        super().__init__(self.model, self.data, mission, options)

    def reset(self, seed: int) -> None:
        """Back to the start of the mission.

        Args:
            seed: a whole number from 0 to 2**64 - 1; draws what differs between runs.

        Raises:
            Error: another seed.
        """
        super().reset(_seed(seed))


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
