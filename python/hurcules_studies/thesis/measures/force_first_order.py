"""K12, K13, K15, K16: the velocity form of section 5.7 and the forces that bound it.

On the ideal robot (force_ideal.py).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

import hurcules
from hurcules import ContactState, ForceGains
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import DT, START, G, forces, press
from hurcules_studies.thesis.measures.force_loops import DESIRED, loop_response, settling
from hurcules_studies.thesis.measures.registry import measures

F_MIN, F_MAX = 2.5, 150.0  # [N]; the thesis prints the first
COMPLIANCES = (0.005, 0.01, 0.02, 0.05, 0.10)  # [m/s/N]


@measures("K12")
def enters_at_least_force() -> Finding:
    """A reading made up: it rises by 1 mN a tick, with a sign, and the law's answer."""
    gains = ForceGains(compliance=0.05)
    rest = -START / G  # the reference is where the slide is
    rising = press(gains, 5.0, above=rest, read=lambda i, _: -1e-3 * i)
    pulling = press(gains, 5.0, above=rest, read=lambda i, _: 1e-3 * i)
    first = [int((run.contact == 1).argmax()) for run in (rising, pulling)]
    before = float(np.abs(rising.speed[: first[0]]).max())
    small = press(gains, 5.0, read=lambda i, _: -2.499 * np.sin(0.01 * i))
    shown = Plot(
        "Reading that rises by 1 N/s",
        "time [s]",
        "",
        [
            line("reading [N]", rising.time, -1e-3 * np.arange(rising.time.size)),
            line("speed [m/s]", rising.time, rising.speed),
        ],
        marks=(DT * first[0],),
        levels=(-F_MIN,),
    )
    return Finding(
        {
            "enters": 1e-3 * first[0],
            "pulling": 1e-3 * first[1],
            "before": before,
            "small": float((small.contact != 0).sum()),
        },
        plots=[shown],
    )


@measures("K13")
def stops_at_largest_force() -> Finding:
    """The ground strikes: 1 N a tick; then it is gone."""
    gains = ForceGains(compliance=1e-4)

    def strike(tick: int, _: float) -> float:
        return -min(tick, 200) if tick < 500 else 0.0

    struck = press(gains, 1.0, above=-START / G, f_max=F_MAX, read=strike)
    stopped = struck.contact == int(ContactState.Stopped)
    at = int(stopped.argmax())
    shown = Plot(
        "Commanded speed",
        "time [s]",
        "[m/s]",
        [line("", struck.time, struck.speed)],
        marks=(DT * at,),
    )
    return Finding(
        {
            "at": float(at),
            "speed": float(np.abs(struck.speed[at:]).max()),
            "stays": float(stopped[at:].mean()),
        },
        plots=[shown],
    )


@measures("K15")
def velocity_form() -> Finding:
    """Against the exponential; on both sides of the discrete bound, the reading one step old."""
    gains = ForceGains(compliance=0.01)
    run = press(gains, 2.0)
    exact = loop_response(gains, G, 0.0, START, run.time)
    gone = (run.force - DESIRED) / (START - DESIRED)
    after = float(run.time[(gone < np.exp(-1.0)).argmax()])
    swings = {}
    for share in (0.9, 1.1):
        late = [START]

        def one_late(_: int, force: float, late: list[float] = late) -> float:
            late.append(force)
            return late[-2]

        # a ground that is told is checked: this one is told softer than it is
        stiff = share / (0.01 * DT)
        press_late = press(gains, 0.6, stiff, read=one_late, told=0.5 * stiff)
        swing = np.abs(press_late.force - DESIRED)
        swings[share] = float(swing[-100:].max() / swing[:100].max())
    largest = hurcules.largest_stiffness(ForceGains(compliance=0.01))
    return Finding(
        {
            "response": float(np.abs(run.force - exact).max() / abs(DESIRED - START)),
            "constant": after * 0.01 * G,
            "error": abs(float(run.force[-1]) - DESIRED),
            "below": swings[0.9],
            "above": swings[1.1],
            "bound": largest * 0.01 * DT,
        },
        [Note("time constant", after, "s")],
        [forces("C = 0.01", {"measured": run}, {"equation 5.7.57": exact})],
    )


@measures("K16")
def larger_is_faster() -> Finding:
    """Settling over C; C G t is the same for all."""
    runs = {f"C = {C:g}": press(ForceGains(compliance=C), 2.0) for C in COMPLIANCES}
    times = [settling(run.time, run.force, DESIRED) for run in runs.values()]
    scaled = [C * G * time for C, time in zip(COMPLIANCES, times, strict=True)]
    return Finding(
        {
            "not_faster": sum(a <= b for a, b in pairwise(times)),
            "law": max(scaled) / min(scaled),
            "error": max(abs(float(run.force[-1]) - DESIRED) for run in runs.values()),
        },
        [Note(f"C = {C:g} settles in", t, "s") for C, t in zip(COMPLIANCES, times, strict=True)],
        [forces("Velocity form", runs)],
    )
