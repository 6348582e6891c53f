"""K01 to K20: motion and force, levels joint < {hpos, force} < hpitch < pel < gaze, rho = 0.1.

Not measured yet: write the expected numbers here and a function a claim in measures/.
"""

from hurcules.reproduce.claim import Claim

__all__ = ["FORCE"]

FORCE = (
    Claim(
        "K01",
        "5.4.28-31",
        "Inner position loop with f = G (s - r): M s'' + L s' + K (I + C G) s = K C (f_d + G r); "
        "stable.",
    ),
    Claim(
        "K02",
        "5.4.32-33, Fig. 5.8 a",
        "P alone: f_ss = (C G f_d - G r) / (1 + C G), not f_d.",
    ),
    Claim(
        "K03",
        "5.4.34, Fig. 5.8 b",
        "With an integral N: no error, slower; stable iff N < L (1 + C G) / (M G) (Routh).",
    ),
    Claim(
        "K04",
        "5.4.35-40, Fig. 5.8 c",
        "Inner velocity loop: f goes to f_d = -5 N without steady error; wn = sqrt(K C G / M), "
        "zeta = L / (2 sqrt(M K C G)).",
    ),
    Claim(
        "K05",
        "Figs. 5.8 d, 5.7 b",
        "Without force control and with a wrong height of the ground: excessive contact force.",
    ),
    Claim(
        "K06",
        "Fig. 5.8",
        "Settling: the velocity loop is faster than PI; P never arrives.",
    ),
    Claim("K07", "Fig. 5.9", "References change with force control, and do not without."),
    Claim(
        "K08",
        "§5.6.3, Fig. 5.11",
        "Both hands reach out: accelerations and speeds fall gradually from 12 s (singularity).",
    ),
    Claim(
        "K09",
        "Figs. 5.10, 5.12",
        "Hip limit on at 8 s, off at 11 s; RSP and LSP on at 11 s; limits respected.",
    ),
    Claim("K10", "Fig. 5.12 a", "Iterations: 2 at 8 s, 3 at 11 s."),
    Claim(
        "K11",
        "Figs. 5.11, 5.13",
        "C_k = 0.05 and 0.10: force around -5 N; visible error at 0.05, less at 0.10; higher "
        "speeds at 0.10.",
    ),
    Claim("K12", "5.7.64", "f_min = 2.5 N: the force task enters only when |f| > 2.5 N."),
    Claim("K13", "5.7.64", "f_max: emergency stop above it (its value is not given)."),
    Claim(
        "K14",
        "§5.6.3, §5.7.2",
        "Lower bandwidth of the joint PID: unstable when the outer loop is not slower than the "
        "joint loop; "
        "too small a C on stiff ground is worse.",
    ),
    Claim(
        "K15",
        "5.7.54-59",
        "Velocity form: s' + C G s = C G r + C f_d, time constant 1 / (C G), no steady error; "
        "discrete bound "
        "C G dt < 1 or so.",
    ),
    Claim("K16", "Fig. 5.16", "C swept: a larger C is faster."),
    Claim(
        "K17",
        "Fig. 5.17",
        "C = 0.05: all joint speeds jump near 21 s, when |f| reaches f_min.",
    ),
    Claim(
        "K18",
        "Figs. 5.8, 5.16",
        "With and without the elbow's spring: a peak at impact without, a smooth transition with.",
    ),
    Claim(
        "K19",
        "Fig. 5.6",
        "Twelve phases: drive, open arms, waist, fold, legs, ready, lowering, acquisition, "
        "confirm (motion "
        "only), embrace, lift, lift.",
    ),
    Claim(
        "K20",
        "§5.7.2",
        "No or too little contact with the ground: the casualty is pushed away instead of "
        "scooped; with force "
        "control the arms penetrate, also on stiff ground.",
    ),
)
