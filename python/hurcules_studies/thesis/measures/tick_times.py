"""H17: the control loop at 1 kHz."""

from __future__ import annotations

from time import perf_counter

import numpy as np

import hurcules
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures

SECONDS = 27.0  # [s] with both events of the stretch, at 16 and 26 s
STAGES = ("sense", "kinematics", "hierarchy", "solve", "servo")


def timings() -> tuple[dict[str, Array], float]:
    """Seconds of each stage of each tick; real time over simulated time."""
    simulation = hurcules.Simulation("stretch", seed=0, record=False, timed=True)
    started = perf_counter()
    simulation.step(round(SECONDS / simulation.dt))
    return simulation.timings(), (perf_counter() - started) / SECONDS


@measures("H17")
def loop() -> Finding:
    """The smallest of three runs, tick by tick."""
    runs = [timings() for _ in range(3)]
    stages = {name: 1e3 * np.min([run[name] for run, _ in runs], axis=0) for name in STAGES}
    tick = 1e3 * np.min([np.sum([run[name] for name in STAGES], axis=0) for run, _ in runs], axis=0)
    time = runs[0][0]["time"]
    lines = [line(name, time, values) for name, values in stages.items()]
    return Finding(
        {
            "solve": float(stages["solve"].max()),
            "tick": float(tick.max()),
        },
        [
            Note("control tick, median", float(np.median(tick)), "ms"),
            Note("control tick, 99.9 %", float(np.percentile(tick, 99.9)), "ms"),
            Note("simulated over real time, physics included", 1.0 / min(slow for _, slow in runs)),
        ],
        [Plot("Stages of the control tick", "time [s]", "[ms]", lines, log="y")],
    )
