"""R01 to R26: properties of the solver; from R13 on, the active set, in active_set.py.

Tolerances are the rounding of the sums that are compared: 1e-12 to 1e-10 for about ten unknowns.
"""

from hurcules_studies.thesis.claim import (
    ALGORITHM_1,
    DEFAULT,
    DLS_HQP,
    HQP,
    Claim,
    exactly,
    least,
    most,
    near,
)
from hurcules_studies.thesis.claims.active_set import ACTIVE_SET

__all__ = ["SOLVER"]

SOLVER = (
    Claim(
        "R01",
        "2.2.8-2.2.12, 2.3.29-30",
        "The projector by recursion, P_k = P_(k-1) - Y_k Y_k', is I - J+ J: symmetric, "
        "idempotent; the "
        "pseudo-inverse meets all four Moore-Penrose conditions. Rows with rank deficiency within "
        "and between levels.",
        {
            "difference": most("largest difference of P_k from I - J+ J", 1e-12),
            "symmetry": most("largest |P - P'|", 1e-12),
            "idempotence": most("largest |P P - P|", 1e-12),
            "conditions": exactly("Moore-Penrose conditions that a level's inverse meets", 4),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R02",
        "2.2.15-2.2.23",
        "Non-singular tasks are all met, and J_(k-1) (J_k P_(k-1))+ = 0: a level leaves the "
        "levels above "
        "as they were.",
        {
            "error": most("largest task error", 1e-12),
            "moved": most("largest motion of a level above by a level below", 1e-12),
        },
        solvers=(DEFAULT, ALGORITHM_1),
        caveat="all tasks are compatible, so plain least squares passes too; that a lower task "
        "gives way is R18 and M10",
    ),
    Claim(
        "R03",
        "3.3.28, §3.6",
        "Without regularisation (rho_k = 0 at all levels) RHQP is HQP, primal and multipliers, to "
        "machine precision.",
        {
            "primal": most("largest difference of x", 1e-12),
            "multipliers": most("largest difference of multipliers, over their size", 1e-11),
        },
        solvers=(ALGORITHM_1, HQP),
    ),
    Claim(
        "R04",
        "3.3.38-39, Fig. 3.2",
        "Regularisation filters the inverse singular value, sigma / (sigma^2 + rho^2): highest, "
        "1 / (2 rho), at sigma = rho, and 0 at 0; without it 1 / sigma grows without bound.",
        {
            "difference": most("largest difference from the filter, over its value", 1e-10),
            "top": near("highest value over 1 / (2 rho)", 1.0, 1e-12),
            "at": near("sigma of the highest over rho", 1.0, 1e-9),
            "at_zero": most("value at sigma = 1e-6, rho = 0.1", 1.1e-4),
            "bare": near("value at sigma = 1e-6, rho = 0, over 1 / sigma", 1.0, 1e-9),
        },
        solvers=(DEFAULT, ALGORITHM_1, DLS_HQP),
    ),
    Claim(
        "R05",
        "3.3.35, 3.3.92-93",
        "With D_k = Y_k' regularisation leaves the lower levels everything: H_k Z_k = 0, h_k' "
        "Z_k = 0.",
        {
            "hessian": most("largest |H_k Z_k|", 1e-12),
            "gradient": most("largest |h_k' Z_k|", 1e-12),
            "left": most("largest error of a level below in the free directions", 1e-11),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R06",
        "3.3.34, 3.3.42",
        "P_k = Z_k Z_k' is the projector, and Z_k has n - sum(rank) columns.",
        {
            "difference": most("largest difference of Z Z' from I - J+ J", 1e-12),
            "columns": most("largest difference of the number of columns", 1e-12),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R07",
        "3.3.44-46, 3.3.76-80",
        "The task error splits into what nothing could avoid and what regularisation costs, "
        "e_k = v_k + u_k with T = rho^2 / (sigma^2 + rho^2); u = 0 iff rho = 0; v = 0 without a "
        "singularity.",
        {
            "sum": most("largest |e - v - u|", 1e-11),
            "v": most("largest difference of v from V V' (J x - y)", 1e-11),
            "u": most("largest difference of u from U T U' (J x - y)", 1e-11),
            "u_unregularized": most("largest u for rho = 0", 1e-13),
            "u_regularized": least("smallest |u| for rho > 0", 1e-6),
            "v_regular": most("largest v of a level without singularity", 1e-12),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "R08",
        "3.3.64-67, 3.3.81-83",
        "J_k = W_k S_k Y_k' and its stacked form are exact.",
        {
            "difference": most("largest difference of the rebuilt rows", 1e-12),
            "orthogonality": most("largest |W' W - I|", 1e-12),
            "sigma": most("largest difference of the solver's singular values from numpy's", 1e-11),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "R09",
        "3.3.84-87",
        "With rho > 0, x = J^(rho #) y, and this inverse meets none of the four Moore-Penrose "
        "conditions.",
        {
            "difference": most("largest |x - J# y|", 1e-10),
            "conditions": exactly("Moore-Penrose conditions met, most of 50 problems", 0),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R10",
        "3.3.88-91",
        "With rho = 0, J# J = Y Y', and three of the four conditions hold (J J# is not symmetric).",
        {
            "difference": most("largest |J# J - Y Y'|", 1e-10),
            "least": exactly("conditions met, least of 50 problems", 3),
            "most": exactly("conditions met, most of 50 problems", 3),
            "asymmetry": least("smallest |J J# - (J J#)'|", 1e-6),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R11",
        "3.4.100-113",
        "At the optimum the KKT conditions hold: mu_k = v_k + u_k, and the strict multipliers "
        "meet the "
        "stationarity with the term rho^2 Y Y' x.",
        {
            "stationarity": most("largest gradient, over the multipliers", 1e-10),
            "own": most("largest |mu_k - e_k|", 1e-11),
            "steps": most("largest difference of x from the recursion 3.3.37", 1e-11),
        },
        solvers=(ALGORITHM_1,),
    ),
    Claim(
        "R12",
        "3.4.114-116",
        "The recursion for the multipliers of all levels equals the closed form; their matrix is "
        "upper "
        "triangular.",
        {
            "difference": most("largest difference of recursion and closed form", 1e-9),
            "triangular": exactly("columns with multipliers of other levels than 0 to k", 0),
        },
        solvers=(ALGORITHM_1,),
        caveat="algebra of returned multipliers, better a unit test",
    ),
    *ACTIVE_SET,
)
