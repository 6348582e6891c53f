"""R03, R04, R11, R22 to R24: what regularisation does to primal, multipliers, tasks and bounds."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from hurcules import rhqp
from hurcules_studies.thesis.claim import Finding, Plot, line
from hurcules_studies.thesis.measures.problems import Array, conflict, largest, point, solver
from hurcules_studies.thesis.measures.registry import measures

RHO = 0.1


@measures("R03")
def unregularized() -> Finding:
    """100 conflicts, rho = 0, by both methods."""
    primal, dual = [], []
    for seed in range(100):
        levels = conflict(seed, rho=0.0)
        ours, hqp = solver(12, "rhqp_thesis").solve(levels), solver(12, "hqp").solve(levels)
        primal.append(ours.x - hqp.x)
        for ours_k, hqp_k in zip(ours.multipliers, hqp.multipliers, strict=True):
            off = largest([a - b for a, b in zip(ours_k, hqp_k, strict=True)])
            dual.append(off / max(1.0, largest(ours_k)))
    return Finding({"primal": largest(primal), "multipliers": max(dual)})


@measures("R04")
def filtered() -> Finding:
    """One row of length sigma that is asked for 1, by every method with regularisation."""
    sigmas = np.logspace(-6, 1, 141)  # holds 0.1
    wanted = sigmas / (sigmas**2 + RHO**2)
    off, top, at, zero, lines = [], [], [], [], []
    for method in ("lexicographic", "rhqp_thesis", "dls_hqp", "cascade"):
        x = np.array([solver(1, method).solve([point([[s]], [1.0], RHO)]).x[0] for s in sigmas])
        off.append(x / wanted - 1.0)
        top.append(x.max() * 2 * RHO)
        at.append(sigmas[np.argmax(x)] / RHO)
        zero.append(x[0])
        if method == "lexicographic":
            lines.append(line("rho = 0.1", sigmas, x))
    bare = np.array([solver(1).solve([point([[s]], [1.0], 0.0)]).x[0] for s in sigmas])
    lines.append(line("rho = 0", sigmas, bare, "dashed"))
    plot = Plot("Inverse singular value (after Fig. 3.2)", "sigma", "x", lines, log="xy")
    return Finding(
        {
            "difference": largest(off),
            "top": max(top, key=lambda value: abs(value - 1.0)),
            "at": max(at, key=lambda value: abs(value - 1.0)),
            "at_zero": max(zero),
            "bare": bare[0] * sigmas[0],
        },
        plots=[plot],
    )


def steps(levels: Sequence[rhqp.Level], solution: rhqp.Solution) -> list[Array]:
    """x_1, x_2, ... of Algorithm 1 for its last working set, by the recursion 3.3.37 in numpy."""
    n = solution.x.size
    held = {(row.level, row.row): row.side for row in solution.working_set}
    x, Z, result = np.zeros(n), np.eye(n), []
    for k, level in enumerate(levels):
        A = level.A if level.A.size else np.eye(n)
        equal = level.lower == level.upper
        rows = [i for i in range(level.rows) if equal[i] or (k, i) in held]
        side = [held.get((k, i), rhqp.Side.Upper) for i in rows]
        target = np.array(
            [
                level.upper[i] if s == rhqp.Side.Upper else level.lower[i]
                for i, s in zip(rows, side, strict=True)
            ]
        )
        J = A[rows]
        U, sigma, Yt = np.linalg.svd(J @ Z)
        rank = int(np.sum(sigma > 1e-10))
        through = sigma[:rank] / (sigma[:rank] ** 2 + level.rho**2)
        x = x + Z @ (Yt[:rank].T @ (through * (U[:, :rank].T @ (target - J @ x))))
        Z = Z @ Yt[rank:].T
        result.append(x)
    return result


@measures("R11")
def optimality() -> Finding:
    """3.4.103, J' mu + rho^2 Y Y' x = 0 at each level, and mu_k = e_k (3.4.108)."""
    gradients, own, off = [], [], []
    for seed in range(50):
        levels = conflict(seed)
        solution = solver(12, "rhqp_thesis").solve(levels)
        x = steps(levels, solution)
        rows = [level.A if level.A.size else np.eye(12) for level in levels]
        off.append(x[-1] - solution.x)
        for k, level in enumerate(levels):
            mu = solution.multipliers[k]
            step = x[k] - (x[k - 1] if k else 0.0)  # = Y_k Y_k' x_k
            gradient = level.rho**2 * step + sum(rows[j].T @ mu[j] for j in range(k + 1))
            gradients.append(gradient / max(1.0, largest(mu)))
            equal = level.lower == level.upper
            own.append((mu[k] - (rows[k] @ x[k] - level.upper))[equal])
    values = {"stationarity": largest(gradients), "own": largest(own), "steps": largest(off)}
    return Finding(values)


@measures("R22")
def leaked() -> Finding:
    """Level 0 stops at 1 / (1 + rho^2), level 1 answers by 0.8^2 / (0.8^2 + rho^2)."""
    rhos = (0.0, 0.01, 0.03, 0.1, 0.3)
    moved = []
    for rho in rhos:
        levels = [point([[1.0, 0.0]], [1.0], rho), point([[0.6, 0.8]], [0.0], rho)]
        moved.append(abs(float(solver(2).solve(levels).violations[1][0])))
    plot = Plot(
        "Motion of the lower level", "rho", "error", [line("", rhos[1:], moved[1:])], log="xy"
    )
    return Finding(
        {
            "unregularized": moved[0],
            "growing": sum(a >= b for a, b in itertools.pairwise(moved)),
            "at_01": moved[3] / (0.6 / 1.01 * 0.01 / 0.65),
        },
        plots=[plot],
    )


@measures("R23")
def adaptive() -> Finding:
    """rho^2 = 0.1^2 (1 - (sigma / 0.1)^2) below 0.1, else 0: the solver's own "adaptive" option."""
    options = rhqp.SolverOptions(regularization="adaptive", singular_threshold=0.1)
    sigmas = np.logspace(0, -12, 121)
    away, x = [0.0], []
    for sigma in sigmas:
        solution = rhqp.Solver(2, options).solve([point([[0.0, sigma]], [1.0], RHO)])
        if sigma >= 0.1:
            away.append(abs(float(solution.violations[0][0])))
        x.append(abs(float(solution.x[1])))
    plot = Plot("Adapted to sigma", "sigma", "|x|", [line("", sigmas, x)], log="xy")
    values = {"away": max(away), "largest": max(x), "at_zero": x[-1]}
    return Finding(values, plots=[plot])


@measures("R24")
def bounded() -> Finding:
    """One unknown that is asked for 5, with |x| <= 1."""
    goal = point([[1.0]], [5.0], RHO)
    limit = rhqp.Level(np.array([[1.0]]), np.array([-1.0]), np.array([1.0]), rho=RHO)
    exact = rhqp.Bounds(-np.ones(1), np.ones(1))
    return Finding(
        {
            "thesis": float(solver(1, "rhqp_thesis").solve([limit, goal]).x[0]),
            "dls": float(solver(1, "dls_hqp").solve([limit, goal]).x[0]),
            "default": float(solver(1).solve([exact, goal]).x[0]),
        }
    )
