"""K01 to K04, K06: the laws of second order, beside the differential equations of section 5.4.

On the ideal robot (force_ideal.py), from where the law takes over, at rest.
"""

from __future__ import annotations

from functools import cache

import numpy as np

import hurcules
from hurcules import ForceGains, ForceLoop
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.force_ideal import DT, START, G, Run, forces, press
from hurcules_studies.thesis.measures.force_loops import (
    BAND,
    DESIRED,
    loop_matrix,
    loop_response,
    settling,
)
from hurcules_studies.thesis.measures.registry import measures

# C as the thesis prints it; M, L, K are not printed: here w_n = 20 rad/s, damped by 1
SECOND = {"compliance": 0.05, "mass": 1.0, "damping": 40.0, "stiffness": 7.3}
WRONG = 0.03  # [m] the ground lies higher than the reference by this


def second(loop: ForceLoop, integral: float = 0.0, **gains: float) -> ForceGains:
    """Gains of a law of second order."""
    return ForceGains(loop=loop, integral=integral, **(SECOND | gains))


def deviation(run: Run, gains: ForceGains, stiffness: float = G, above: float = 0.0) -> float:
    """Largest distance from the solution of the differential equation, over the first error."""
    exact = loop_response(gains, stiffness, above, START, run.time)
    return float(np.abs(run.force - exact).max() / abs(DESIRED - START))


@measures("K01")
def inner_position_loop() -> Finding:
    """The response; eigenvalues of the loop for a thousand random positive gains."""
    gains = second(ForceLoop.Position)
    run = press(gains, 3.0)
    rng = np.random.default_rng(1)
    stable = 0
    for _ in range(1000):
        M, L, K, C, stiffness = np.exp(rng.uniform(np.log(1e-3), np.log(1e3), 5))
        one = second(ForceLoop.Position, mass=M, damping=L, stiffness=K, compliance=C)
        poles = np.linalg.eigvals(loop_matrix(one, stiffness))
        stable += bool(poles.real.max() < 0.0)
    exact = loop_response(gains, G, 0.0, START, run.time)
    return Finding(
        {"response": deviation(run, gains), "stable": stable},
        plots=[forces("Inner position loop", {"measured": run}, {"equation 5.4.31": exact})],
    )


@measures("K02")
def position_loop_stays_off() -> Finding:
    """Three heights of the ground, two compliances."""
    worst, runs, offs = 0.0, {}, []
    for C in (0.005, 0.05):
        gains = second(ForceLoop.Position, compliance=C)
        for above in (0.0, 0.01, WRONG):
            run = press(gains, 20.0, above=above)
            # r counts from the reference, which lies `above` under the ground
            wanted = (C * G * DESIRED - G * above) / (1.0 + C * G)
            worst = max(worst, abs(float(run.force[-1]) - wanted))
            offs.append(abs(float(run.force[-1]) - DESIRED))
            runs[f"C = {C:g}, ground {1e3 * above:.0f} mm higher"] = run
    return Finding(
        {"formula": worst, "off": min(offs)},
        [Note("at C = 0.05, ground 30 mm higher: force", float(run.force[-1]), "N")],
        [forces("Inner position loop", runs)],
    )


@measures("K03")
def integral_removes_the_error() -> Finding:
    """N at a quarter of Routh's bound, 3 % below it and 3 % above it."""
    M, L, C = (SECOND[name] for name in ("mass", "damping", "compliance"))
    bound = L * (1.0 + C * G) / (M * G)
    quarter = press(second(ForceLoop.PositionIntegral, bound / 4), 6.0, above=WRONG)
    growth = {}
    for share in (0.97, 1.03):
        # beyond the bound the task refuses the gain where it knows the ground: it is not told
        gains = second(ForceLoop.PositionIntegral, share * bound)
        time = np.asarray(DT * np.arange(40000))
        swing = np.abs(loop_response(gains, G, WRONG, START, time) - DESIRED)
        growth[share] = float(swing[-5000:].max() / swing[5000:10000].max())
    refused = 0.0
    try:
        press(second(ForceLoop.PositionIntegral, 1.03 * bound), 0.01)
    except hurcules.Error:
        refused = 1.0
    P = press(second(ForceLoop.Position), 6.0, above=WRONG)
    swings = [settling(run.time, run.force, float(run.force[-1])) for run in (quarter, P)]
    return Finding(
        {
            "error": abs(float(quarter.force[-1]) - DESIRED),
            "slower": swings[0] / swings[1],
            "below": growth[0.97],
            "above": growth[1.03],
            "refused": refused,
        },
        [Note("bound of Routh", bound, "m/s/N")],
        [forces("With and without an integral", {"P": P, "PI, N at a quarter": quarter})],
    )


@measures("K04")
def inner_velocity_loop() -> Finding:
    """Three dampings, compared with wn and zeta."""
    runs, worst, off, dashed = {}, 0.0, 0.0, {}
    for zeta in (0.3, 1.0, 2.0):
        damping = 2.0 * zeta * np.sqrt(SECOND["stiffness"] * SECOND["compliance"] * G)
        gains = second(ForceLoop.Velocity, damping=float(damping))
        run = press(gains, 8.0)
        worst = max(worst, deviation(run, gains))
        off = max(off, abs(float(run.force[-1]) - DESIRED))
        runs[f"zeta = {zeta:g}"] = run
        dashed[f"equation 5.4.38, {zeta:g}"] = loop_response(gains, G, 0.0, START, run.time)
    gains = second(ForceLoop.Velocity)
    ground = press(gains, 8.0, above=WRONG)
    return Finding(
        {"response": worst, "error": off, "wrong": abs(float(ground.force[-1]) - DESIRED)},
        plots=[forces("Inner velocity loop", runs, dashed)],
    )


@cache
def settle_times() -> dict[float, float]:
    """Of PI, by N [m/s/N], in [s]; the exact solution."""
    time = np.asarray(DT * np.arange(20000))
    M, L, C = (SECOND[name] for name in ("mass", "damping", "compliance"))
    bound = L * (1.0 + C * G) / (M * G)

    def of(gains: ForceGains) -> float:
        return settling(time, loop_response(gains, G, WRONG, START, time), DESIRED)

    by_N = {
        float(N): of(second(ForceLoop.PositionIntegral, float(N)))
        for N in bound * np.geomspace(0.01, 0.95, 60)
    }
    return by_N


def faster_share() -> float:
    """Of random gains with K C G / M >= (L / 2 M)^2: no integral beats the velocity loop's rate."""
    rng = np.random.default_rng(2)
    better = 0
    for _ in range(300):
        C, stiffness = rng.choice([0.05, 0.10]), float(1e3 * 100 ** rng.uniform())
        M, L = 1.0, float(np.exp(rng.uniform(0.0, np.log(100.0))))
        K = L**2 / (4 * C * stiffness) * float(np.exp(rng.uniform(0.0, np.log(100.0))))
        more = {"compliance": float(C), "mass": M, "damping": L, "stiffness": K}
        velocity = rate_of(second(ForceLoop.Velocity, **more), stiffness)
        bound = L * (1.0 + C * stiffness) / (M * stiffness)
        best = max(
            rate_of(second(ForceLoop.PositionIntegral, float(N), **more), stiffness)
            for N in bound * np.geomspace(1e-3, 0.99, 60)
        )
        better += velocity > best
    return better / 300


def rate_of(gains: ForceGains, stiffness: float) -> float:
    """[1/s] at which the slowest part of an error vanishes."""
    return -float(np.linalg.eigvals(loop_matrix(gains, stiffness)).real.max())


@measures("K06")
def settling_compared() -> Finding:
    """The ground 30 mm higher than expected; PI with the best of sixty integrals."""
    by_N = settle_times()
    best = min(by_N, key=lambda N: by_N[N])
    runs = {
        "velocity loop": press(second(ForceLoop.Velocity), 4.0, above=WRONG),
        "PI, best N": press(second(ForceLoop.PositionIntegral, best), 4.0, above=WRONG),
        "P": press(second(ForceLoop.Position), 4.0, above=WRONG),
    }
    measured = {k: settling(run.time, run.force, DESIRED) for k, run in runs.items()}
    sweep = Plot(
        "Settling of PI",
        "N [m/s/N]",
        f"within {100 * BAND:.0f} % after [s]",
        [
            line("PI", list(by_N), list(by_N.values())),
            line("velocity loop", list(by_N), [measured["velocity loop"]] * len(by_N), "dashed"),
        ],
        log="x",
    )
    return Finding(
        {
            "velocity": measured["velocity loop"],
            "faster": measured["velocity loop"] / measured["PI, best N"],
            "P": abs(float(runs["P"].force[-1]) - DESIRED),
            "share": faster_share(),
        },
        [
            Note("PI, best N, settles in", measured["PI, best N"], "s"),
            Note("best N", best, "m/s/N"),
        ],
        [forces("Settling", runs), sweep],
    )
