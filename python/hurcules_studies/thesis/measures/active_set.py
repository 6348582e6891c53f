"""R13 to R21: the modified active set; Algorithm 1 (`rhqp_thesis`), and the default beside it."""

from __future__ import annotations

import numpy as np

from hurcules import rhqp
from hurcules_studies.thesis.claim import Finding, Note, Plot, line
from hurcules_studies.thesis.measures.problems import (
    INF,
    Array,
    conflict,
    equalities,
    largest,
    levels_with,
    point,
    solver,
)
from hurcules_studies.thesis.measures.registry import measures


def limit_q1(rho: float) -> rhqp.Level:
    """q1' <= 0 of n = 2."""
    return rhqp.Level(np.array([[1.0, 0.0]]), np.array([-INF]), np.array([0.0]), rho=rho)


def first_multipliers(solution: rhqp.Solution) -> list[float]:
    """Of each held row the multiplier at the highest level that feels it, > 0: it pushes back.

    A row that a level pushes against may have any sign at the levels below (R18): the signs of an
    optimum are lexicographic.
    """
    found = []
    for row in solution.working_set:
        side = 1 if row.side == rhqp.Side.Upper else -1
        column = [side * levels[row.level][row.row] for levels in solution.multipliers[row.level :]]
        scale = max(map(abs, column))
        found.append(next((mu for mu in column if abs(mu) > 1e-6 * scale), 0.0))
    return [float(mu) for mu in found]


@measures("R13")
def feasible() -> Finding:
    """100 conflicts of a box with four levels."""
    outside, residuals, negative = [0.0], [0.0], 0
    thesis_outside, thesis_negative, optimal = [0.0], 0, 0
    for seed in range(100):
        levels = conflict(seed)
        default = solver(12).solve(levels)
        outside.append(largest(default.violations[:1]))
        residuals.append(default.optimality)
        negative += any(row.multiplier < 0 for row in default.working_set)
        thesis = solver(12, "rhqp_thesis").solve(levels)
        thesis_outside.append(largest(thesis.violations[:1]))
        thesis_negative += min(first_multipliers(thesis), default=0.0) < 0.0
        optimal += bool(np.abs(thesis.x - default.x).max() < 1e-6)
    return Finding(
        {
            "infeasible": max(outside),
            "negative": negative,
            "optimality": max(residuals),
            "thesis_infeasible": max(thesis_outside),
            "thesis_negative": thesis_negative,
        },
        [Note("answers of Algorithm 1 that are the optimum, of 100", optimal)],
    )


@measures("R14")
def violated() -> Finding:
    """Limit x <= -1 with a task that asks for x = -0.5."""
    limit = rhqp.Level(np.array([[1.0]]), np.array([-INF]), np.array([-1.0]))
    task = point([[1.0]], [-0.5], 0.0)
    unlimited = float(solver(1, "rhqp_thesis").solve([task]).x[0])
    repaired = solver(1, "rhqp_thesis").solve([limit, task])
    return Finding(
        {
            "alpha": abs(-1.0 / unlimited),
            "x": float(repaired.x[0]),
            "changes": repaired.changes,
        }
    )


def classic_active_set(
    goal: Array, C: Array, d: Array, x: Array
) -> tuple[list[Array], list[tuple[str, int]]]:
    """Min |x - goal|^2, C x <= d, by steps with a length from a feasible x: way and changes."""
    held: list[int] = []
    changes: list[tuple[str, int]] = []
    way = [x]
    while True:
        P = np.eye(2)
        if held:
            P = P - np.linalg.pinv(C[held]) @ C[held]
        step = P @ (goal - x)
        rate = C @ step
        room = np.where(rate > 1e-12, (d - C @ x) / np.where(rate > 1e-12, rate, 1.0), INF)
        if held:
            room[held] = INF
        if room.min() < 1.0:
            x = x + room.min() * step
            way.append(x)
            held.append(int(np.argmin(room)))
            changes.append(("on", held[-1]))
            continue
        x = x + step
        way.append(x)
        multipliers = np.linalg.pinv(C[held].T) @ (goal - x) if held else np.zeros(0)
        if not held or multipliers.min() >= -1e-12:
            return way, changes
        changes.append(("off", held.pop(int(np.argmin(multipliers)))))


@measures("R15")
def without_steps() -> Finding:
    """A: 0.6 x + 0.8 y <= 1, B: x <= 1, goal (3, 0), start (0, 1): own numbers."""
    C, d, goal = np.array([[0.6, 0.8], [1.0, 0.0]]), np.ones(2), np.array([3.0, 0.0])
    way, changes = classic_active_set(goal, C, d, np.array([0.0, 1.0]))
    limits = rhqp.Level(C, np.full(2, -INF), d)
    modified = solver(2, "rhqp_thesis").solve([limits, rhqp.Level(np.eye(2), goal, goal)])
    off = [way[-1] - [1.0, 0.0], modified.x - [1.0, 0.0]]
    wanted = changes == [("on", 0), ("on", 1), ("off", 0)]
    plot = Plot(
        "The plane (after Fig. 3.5)",
        "x",
        "y",
        [
            line("classic", [p[0] for p in way], [p[1] for p in way]),
            line("modified: goal, optimum", [3.0, modified.x[0]], [0.0, modified.x[1]], "dots"),
            line("A", [-0.2, 1.8], [(1 + 0.12) / 0.8, (1 - 1.08) / 0.8], "dashed"),
            line("B", [1.0, 1.0], [-0.2, 1.4], "dashed"),
        ],
    )
    return Finding(
        {
            "classic_changes": len(changes) if wanted else -1,
            "modified_changes": modified.changes,
            "solves": modified.factorizations / 2,  # of two levels each
            "difference": largest(off),
        },
        plots=[plot],
    )


@measures("R16")
def warm() -> Finding:
    """Each of 100 conflicts solved twice; how often the second solve is a single iteration."""
    once = {"lexicographic": 0, "rhqp_thesis": 0}
    for method in once:
        for seed in range(100):
            levels = conflict(seed)
            one = solver(12, method)
            one.solve(levels)
            again = one.solve(levels)
            # the default counts a factorisation for each level that it proves
            single = method == "lexicographic" or again.factorizations == len(levels)
            once[method] += again.changes == 0 and single
    return Finding({"default": once["lexicographic"], "thesis": once["rhqp_thesis"]})


@measures("R17")
def any_start() -> Finding:
    """From the set of another goal: the plane of Figure 3.5, then 100 conflicts."""
    limits = rhqp.Level(np.array([[0.6, 0.8], [1.0, 0.0]]), np.full(2, -INF), np.ones(2))
    first, second = (point(np.eye(2), goal, 0.0) for goal in ([0.0, 9.0], [3.0, 0.0]))
    plane, same = {}, {"lexicographic": 0, "rhqp_thesis": 0}
    for method in same:
        one = solver(2, method)
        one.solve([limits, first])
        plane[method] = float(one.solve([limits, second]).x[1])
    for seed in range(100):
        levels = conflict(seed)
        rng = np.random.default_rng(1000 + seed)
        others = levels_with(levels[1:], [rng.uniform(-2, 2, level.rows) for level in levels[1:]])
        for method in same:
            cold = solver(12, method).solve(levels).x
            one = solver(12, method)
            one.solve([levels[0], *others])
            same[method] += bool(np.abs(one.solve(levels).x - cold).max() < 1e-9)
    return Finding(
        {
            "default": same["lexicographic"],
            "plane": plane["lexicographic"],
            "thesis": same["rhqp_thesis"],
            "thesis_plane": plane["rhqp_thesis"],
        }
    )


@measures("R18")
def strongly_active() -> Finding:
    """Level 1 pushes on x <= 0, level 2 would pull it off."""
    levels = [limit_q1(0.0), point([[1.0, 0.0]], [1.0], 0.1), point([[1.0, 1.0]], [-1.0], 0.1)]
    thesis = solver(2, "rhqp_thesis").solve(levels)
    return Finding(
        {
            "multiplier": float(thesis.multipliers[1][0][0]),
            "below": float(thesis.multipliers[2][0][0]),
            "kept": float([(row.level, row.row) for row in thesis.working_set] == [(0, 0)]),
            "difference": largest([solver(2).solve(levels).x - [0.0, -1 / 1.01]]),
        }
    )


@measures("R19")
def damped_inverse() -> Finding:
    """100 problems near a singularity, and 100 with limits."""
    without, with_limits, same = [], [], 0
    for seed in range(100):
        levels = equalities(seed)
        ours, dls = (solver(9, method).solve(levels) for method in ("rhqp_thesis", "dls_hqp"))
        without.append(dls.x - ours.x)
        levels = conflict(seed)
        ours, dls = (solver(12, method).solve(levels) for method in ("rhqp_thesis", "dls_hqp"))
        sets = [{(r.level, r.row, r.side) for r in s.working_set} for s in (ours, dls)]
        same += sets[0] == sets[1]
        with_limits.append(dls.x - ours.x)
    return Finding(
        {
            "difference": largest(without),
            "with_limits": largest(with_limits),
            "same_sets": same,
        }
    )


@measures("R20")
def released() -> Finding:
    """The row is held by a first solve towards it; the worst over a limit with rho 0 and 0.1."""
    towards, away = point([[1.0, 1.0]], [1.0], 0.1), point([[1.0, 1.0]], [-1.0], 0.1)
    ended: dict[str, list[rhqp.Solution]] = {}
    for method in ("lexicographic", "rhqp_thesis", "dls_hqp"):
        for rho in (0.0, 0.1):
            one = solver(2, method)
            if len(one.solve([limit_q1(rho), towards]).working_set) != 1:
                raise RuntimeError(f"{method} does not hold the row at first")
            ended.setdefault(method, []).append(one.solve([limit_q1(rho), away]))

    def worst(method: str, i: int, wanted: float) -> float:
        return max((float(s.x[i]) for s in ended[method]), key=lambda value: abs(value - wanted))

    return Finding(
        {
            "x1": worst("rhqp_thesis", 0, -0.4975),
            "x2": worst("rhqp_thesis", 1, -0.4975),
            "default_x1": worst("lexicographic", 0, -0.4975),
            "iterations": max(s.changes + 1 for s in ended["rhqp_thesis"]),
            "dls_x1": worst("dls_hqp", 0, 0.0),
            "dls_x2": worst("dls_hqp", 1, -0.9901),
            "dls_optimality": min(s.optimality for s in ended["dls_hqp"]),
        }
    )


@measures("R21")
def cycling() -> Finding:
    """|x_i| <= 0.5 at rho 0.1, then two levels of two rows, n = 4."""
    box = rhqp.Level(np.eye(4), np.full(4, -0.5), np.full(4, 0.5), rho=0.1)
    levels = [
        box,
        point(np.array([[1, 0, 1, 2], [1, -0.1, 1.2, 2]]), [-2.0, -2.0], 0.1),
        point(np.array([[-2, 2, -1, -2], [-2, 2, 1, 2]]), [-2.0, 2.0], 0.1),
    ]
    thesis = solver(4, "rhqp_thesis").solve(levels)
    caps = {}
    for cap in (12, 1000):
        dls = solver(4, "dls_hqp", max_iterations=cap).solve(levels)
        caps[cap] = dls.changes + 1 if dls.status == rhqp.Status.IterationLimit else 0
    return Finding(
        {
            "difference": largest([thesis.x - [-0.495, -0.2827, -0.4762, -0.495]]),
            "iterations": thesis.changes + 1,
            "dls_12": caps[12],
            "dls_1000": caps[1000],
            "default_optimality": solver(4).solve(levels).optimality,
        }
    )
