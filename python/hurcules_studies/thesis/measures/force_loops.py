"""The force loops of section 5.4 as linear differential equations on a spring, solved exactly.

s counts from the reference; the ground's rest lies `above` it:  f = G (s - above)
state x = (s, ds/dt, int (f_d - f) dt),  dx/dt = A x + b
"""

from __future__ import annotations

import numpy as np

from hurcules import ForceGains, ForceLoop
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["BAND", "DESIRED", "loop_matrix", "loop_response", "settling"]

DESIRED = -5.0  # [N]
BAND = 0.02  # of the desired force: settled


def loop_matrix(gains: ForceGains, stiffness: float) -> Array:
    """A of the closed loop, only as many states as the law has."""
    g, G = gains, stiffness
    if g.loop == ForceLoop.FirstOrder:
        return np.array([[-g.compliance * G]])
    spring = g.stiffness * g.compliance * G
    if g.loop != ForceLoop.Velocity:
        spring += g.stiffness
    A = np.array([[0.0, 1.0], [-spring / g.mass, -g.damping / g.mass]])
    if g.loop != ForceLoop.PositionIntegral:
        return A
    integral = np.array([[0.0], [g.stiffness * g.integral / g.mass]])
    return np.block([[A, integral], [np.array([[-G, 0.0, 0.0]])]])


def loop_response(
    gains: ForceGains, stiffness: float, above: float, start: float, time: Array
) -> Array:
    """Force over time, (ticks,) [N].

    Args:
        gains: of the law.
        stiffness: G [N/m].
        above: [m] of the ground's rest over the reference.
        start: [N] from which it begins, at rest.
        time: (ticks,) [s], evenly spaced from 0.
    """
    A = loop_matrix(gains, stiffness)
    push = gains.compliance * (DESIRED + stiffness * above)  # C (f_d + G r)
    b = np.zeros(len(A))
    if gains.loop == ForceLoop.FirstOrder:
        b[0] = push
    else:
        b[1] = gains.stiffness * push / gains.mass
    if gains.loop == ForceLoop.PositionIntegral:
        b[2] = DESIRED + stiffness * above
    x = np.zeros(len(A))
    x[0] = above + start / stiffness
    values, vectors = np.linalg.eig(A.astype(complex))
    rest = np.linalg.solve(A, -b)
    parts = np.linalg.solve(vectors, (x - rest).astype(complex))
    s = (np.exp(np.outer(time, values)) * parts) @ vectors[0]
    return np.asarray(stiffness * (s.real + rest[0] - above))


def settling(time: Array, force: Array, end: float, band: float = BAND) -> float:
    """When the force is within the band of its end for good [s]; inf for never."""
    off = np.flatnonzero(np.abs(force - end) > band * abs(end))
    if not off.size:
        return 0.0
    return float(time[off[-1] + 1]) if off[-1] + 1 < len(time) else float("inf")
