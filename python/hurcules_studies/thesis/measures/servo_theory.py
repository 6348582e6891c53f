"""P02, P03: the matrices of the appendix (A.2.4 to A.2.11) for random robots of three joints."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import hurcules
from hurcules_studies.thesis.claim import Finding
from hurcules_studies.thesis.measures.problems import Array
from hurcules_studies.thesis.measures.registry import measures

N = 3
ROBOTS = 200


@dataclass(frozen=True)
class Appendix:
    """Inertia, gains and the matrices made of them; dM/dt = 0, so that C is skew."""

    M: Array
    C: Array
    K: Array
    K_P: Array
    K_I: Array

    @classmethod
    def random(cls, seed: int) -> Appendix:
        """A robot of three joints with gains inside the conditions (A.2.9)."""
        rng = np.random.default_rng(seed)
        half, anything = rng.uniform(-1, 1, (2, N, N))
        K_P = rng.uniform(1, 5, N)
        K_I = rng.uniform(0.05, 0.49, N) * K_P**2
        M = half @ half.T + np.eye(N)
        return cls(M, anything - anything.T, *map(np.diag, (rng.uniform(0.5, 5, N), K_P, K_I)))

    @property
    def A(self) -> Array:
        """Of the state equation (A.2.4), (9, 9)."""
        inverse, zero, one = np.linalg.inv(self.M), np.zeros((N, N)), np.eye(N)
        last = [-inverse @ self.C @ self.K_I, -inverse @ self.C @ self.K_P - self.K_I]
        return np.block(
            [[zero, one, zero], [zero, zero, one], [*last, -inverse @ self.C - self.K_P]]
        )

    @property
    def B(self) -> Array:
        """Of the state equation, (9, 3)."""
        return np.vstack([np.zeros((2 * N, N)), np.linalg.inv(self.M)])

    @property
    def P(self) -> Array:
        """The Lyapunov matrix (A.2.8), (9, 9)."""
        M, K, K_P, K_I = self.M, self.K, self.K_P, self.K_I
        return np.block(
            [
                [K_I @ M @ K_I + K_I @ K_P @ K, K_I @ M @ K_P + K_I @ K, K_I @ M],
                [K_P @ M @ K_I + K_I @ K, K_P @ M @ K_P + K_P @ K, K_P @ M],
                [M @ K_I, M @ K_P, M],
            ]
        )

    def Q(self, gamma: float = np.inf) -> Array:
        """The state weight by the Riccati equation (A.2.10), with R = (K + I / gamma^2)^-1."""
        A, B, P = self.A, self.B, self.P
        R_inverse = self.K + np.eye(N) / gamma**2
        return -(A.T @ P + P @ A - P @ B @ R_inverse @ B.T @ P + P @ B @ B.T @ P / gamma**2)


def pid(K: float, K_P: float, K_I: float, gamma: float = 1.0) -> hurcules.JointPid:
    """A servo of one joint; refuses gains outside the conditions."""
    options = hurcules.JointPidOptions(K=[K], K_P=[K_P], K_I=[K_I], gamma=gamma, max_torque=[1e9])
    return hurcules.JointPid(options)


@measures("P02")
def conditions() -> Finding:
    """P of random robots, and the gains that the servo refuses."""
    least = []
    for seed in range(ROBOTS):
        eigenvalues = np.linalg.eigvalsh(Appendix.random(seed).P)
        least.append(float(eigenvalues[0] / eigenvalues[-1]))
    refused = 0
    for gains in ((-1, 2, 1, 1), (1, -2, 1, 1), (1, 2, -1, 1), (1, 2, 2.0001, 1), (1, 2, 1, 0)):
        try:
            pid(*gains)
        except hurcules.Error:
            refused += 1
    taken = pid(1.0, 2.0, 1.9999).options.K_I.size == 1
    return Finding({"least": min(least), "refused": refused, "beyond": float(taken)})


@measures("P03")
def state_weight() -> Finding:
    """Q by the Riccati equation against the diagonal of (A.2.11)."""
    off = []
    for seed in range(ROBOTS):
        one = Appendix.random(seed)
        zero = np.zeros((N, N))
        middle = (one.K_P @ one.K_P - 2 * one.K_I) @ one.K
        wanted = np.block(
            [
                [one.K_I @ one.K_I @ one.K, zero, zero],
                [zero, middle, zero],
                [zero, zero, one.K],
            ]
        )
        off.append(np.abs(one.Q() - wanted).max() / np.abs(wanted).max())
    return Finding({"difference": float(max(off))})
