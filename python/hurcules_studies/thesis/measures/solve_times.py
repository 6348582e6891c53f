"""M17 to M19: the time of a solve over the number of levels and the method; n = 19.

Solved are the ticks of a motion without singularity, warm: rows that turn slowly, under joint
limits. One solve from Python costs some microseconds more than one from C++ (docs/solver.md).
"""

from __future__ import annotations

from functools import cache
from itertools import pairwise
from time import perf_counter

import numpy as np

from hurcules import rhqp
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import Array, point, solver, unit_rows
from hurcules_studies.thesis.measures.registry import measures

N = 19
LEVELS = tuple(range(2, 9))  # joint limits counted
TICKS, ROUNDS = 250, 6
METHODS = {"RHQP": "rhqp_thesis", "HQP": "hqp", "DLS-HQP": "dls_hqp", "default": "lexicographic"}
# Table 4.2, means [ms], i7-6700 3.4 GHz
TABLE = {
    "RHQP": (0.1878, 0.0920, 0.0700, 0.0833, 0.0868, 0.0838, 0.0828),
    "HQP": (0.0492, 0.0673, 0.0672, 0.0628, 0.0700, 0.0949, 0.0888),
    "DLS-HQP": (0.0728, 0.0803, 0.0833, 0.0928, 0.1017, 0.1193, 0.1241),
}


def rows_of(levels: int) -> list[int]:
    """19 rows shared out as evenly as it goes; at eight levels as in the thesis."""
    if levels == 8:
        return [3, 3, 3, 3, 2, 3, 2]
    tasks, left, rows = levels - 1, N, []
    for k in range(tasks):
        rows.append(-(-left // (tasks - k)))
        left -= rows[-1]
    return rows


def motion(rows: list[int], n: int = N, limited: bool = True) -> list[list[rhqp.Level]]:
    """The ticks: rows that turn by 1e-3 rad or so a tick, targets that the limits allow."""
    rng = np.random.default_rng(0)
    sizes = np.cumsum([0, *rows])
    A, turn = unit_rows(sum(rows), n, rng), unit_rows(sum(rows), n, rng)
    ticks = []
    for i in range(TICKS):
        now = A + 1e-3 * i * turn
        x = 0.3 * np.sin(1e-2 * i + np.arange(n))
        levels = [point(now[a:b], now[a:b] @ x, 0.1) for a, b in pairwise(sizes)]
        box = [rhqp.Bounds(np.full(n, -5.0), np.full(n, 5.0))] if limited else []
        ticks.append([*box, *levels])
    return ticks


def timed(ticks: list[list[rhqp.Level]], methods: tuple[str, ...]) -> dict[str, Array]:
    """Seconds of each tick by method, the least of all rounds.

    The methods take turns, forth and back over the ticks: what disturbs the machine meets all of
    them, and the least of the rounds is without it.
    """
    n = ticks[0][-1].A.shape[1]
    solvers = {method: solver(n, method) for method in methods}
    found = {method: np.full(len(ticks), np.inf) for method in methods}
    for i in range(ROUNDS):
        order = list(range(len(ticks)))[:: 1 if i % 2 == 0 else -1]
        for method, one in solvers.items():
            seconds = found[method]
            for k in order:
                started = perf_counter()
                one.solve(ticks[k])
                seconds[k] = min(seconds[k], perf_counter() - started)
    return found


@cache
def table() -> dict[str, tuple[list[float], list[float]]]:
    """Mean and deviation [ms] over the levels, by method."""
    found: dict[str, tuple[list[float], list[float]]] = {name: ([], []) for name in METHODS}
    for levels in LEVELS:
        seconds = timed(motion(rows_of(levels)), tuple(METHODS.values()))
        for name, method in METHODS.items():
            ms = 1e3 * seconds[method]
            found[name][0].append(float(ms.mean()))
            found[name][1].append(float(ms.std()))
    return found


def picture() -> Plot:
    """Figure 4.22."""
    lines = [line(name, LEVELS, means) for name, (means, _) in table().items()]
    lines += [line(f"{name}, thesis", LEVELS, means, "faint") for name, means in TABLE.items()]
    return Plot("Mean time of a solve (Fig. 4.22)", "levels", "[ms]", lines)


@measures("M17")
def table_4_2() -> Finding:
    """Means over the thesis' means."""
    found = table()
    ratio = {name: float(np.max(np.array(found[name][0]) / TABLE[name])) for name in TABLE}
    default = np.array(found["default"][0])
    notes = [
        Note(f"{name}, mean at 2, 5, 8 levels: {means[0]:.4f}, {means[3]:.4f},", means[6], "ms")
        for name, (means, _) in found.items()
    ]
    return Finding(
        {
            "rhqp": ratio["RHQP"],
            "hqp": ratio["HQP"],
            "dls": ratio["DLS-HQP"],
            "default": float(default.max()),
        },
        [*notes, Note("solves", float(len(METHODS) * len(LEVELS) * ROUNDS * TICKS))],
        [picture()],
    )


@measures("M18")
def shape() -> Finding:
    """For more than three levels; the slope is the growth from four to eight levels."""
    found = {name: np.array(means) for name, (means, _) in table().items()}
    rhqp_, dls = found["RHQP"], found["DLS-HQP"]
    return Finding(
        {
            "flat": float(rhqp_[2:].max() / rhqp_[2:].min()),
            "below": float(rhqp_[2:].max()),
            "slowest": float(LEVELS[int(rhqp_.argmax())]),
            "dls_grows": float(dls[6] / dls[2]),
            "beats": float(np.max(rhqp_[2:] / dls[2:])),
        },
        [
            Note(f"RHQP over DLS-HQP, {levels} levels", float(a / b))
            for levels, a, b in zip(LEVELS, rhqp_, dls, strict=True)
        ],
        plots=[picture()],
    )


@measures("M19")
def decompositions() -> Finding:
    """One level of m rows and o unknowns, by RHQP (SVD) and HQP (COD)."""
    ratios, sizes = [], []
    for m in (1, 2, 3, 5, 8):
        for o in (8, 19, 30):
            ticks = motion([m], o, limited=False)
            seconds = timed(ticks, ("rhqp_thesis", "hqp"))
            ratios.append(float(seconds["rhqp_thesis"].mean() / seconds["hqp"].mean()))
            sizes.append(m)
    small = [ratio for ratio, m in zip(ratios, sizes, strict=True) if m <= 3]
    plot = Plot("SVD over COD", "rows m", "time ratio", [line("", sizes, ratios, "dots")])
    return Finding({"small": max(small), "largest": max(ratios)}, plots=[plot])
