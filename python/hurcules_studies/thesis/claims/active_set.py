"""R13 to R26: active set, release and cycling, what regularisation costs, position limits."""

from hurcules_studies.thesis.claim import (
    ALGORITHM_1,
    DEFAULT,
    DLS_HQP,
    Claim,
    between,
    exactly,
    least,
    most,
    near,
)

__all__ = ["ACTIVE_SET"]

ACTIVE_SET = (
    Claim(
        "R13",
        "Alg. 1",
        "Box and equality tasks: the returned x is feasible at all levels, and no multiplier on "
        "the working set is negative, at the highest level that feels the row.",
        {
            "infeasible": most("worst violation of the box, default", 1e-12),
            "negative": exactly("problems with a negative multiplier of 100, default", 0),
            "optimality": most("worst optimality residual, default", 1e-9),
            "thesis_infeasible": most("worst violation of the box, Algorithm 1", 1e-14),
            "thesis_negative": exactly(
                "problems with a negative multiplier of 100, Algorithm 1",
                0,
                ours=(90, 100),
                why="a row that only a lower level needs is held as an equality at the levels "
                "above, where their regularisation makes its multiplier negative; the set S keeps "
                "it from being dropped, for without S it is dropped, violated and added for ever. "
                "4 of the 100 answers are the optimum (an Algorithm 1 written apart from this one "
                "gives the same 100). Another reading of the text, S of the previous levels and "
                "the lowest multiplier among the droppable, finds 67, and 14 end at the cap; at "
                "rho = 0 that reading finds 117 of 120. So the working set of all levels and the "
                "regularisation contradict each other; S hides the cycle",
            ),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R14",
        "3.4.117",
        "A bound that is violated and has y < 0. As printed, alpha = |y / (J x)| exceeds 1 and "
        "the row never "
        "blocks; with every violated row blocking, x is feasible after one step.",
        {
            "alpha": near("alpha of the violated row, as printed", 2.0, 1e-12),
            "x": near("x with the repair (wanted x <= -1)", -1.0, 1e-14),
            "changes": exactly("changes of the working set", 1),
        },
        solvers=(ALGORITHM_1,),
    ),
    Claim(
        "R15",
        "§3.4.3, Fig. 3.5",
        "A plane with two limits A and B: the classic active set goes A on, B on, A off; the "
        "modified one "
        "adds B at once, two solves, no step length.",
        {
            "classic_changes": exactly("changes of the classic active set", 3),
            "modified_changes": exactly("changes of the modified one", 1),
            "solves": exactly("solves of the modified one", 2),
            "difference": most("largest distance of both from the optimum (1, 0)", 1e-13),
        },
        solvers=(ALGORITHM_1,),
    ),
    Claim(
        "R16",
        "§3.4.2",
        "Warm start: an unchanged active set takes exactly one iteration.",
        {
            "default": exactly("problems of 100 with one iteration, default", 100),
            "thesis": exactly(
                "problems of 100 with one iteration, Algorithm 1",
                100,
                ours=(97, 97),
                why="Algorithm 1 forgets its set S between solves, and where S had kept a row "
                "with a negative multiplier that row is dropped first: it alters its set on "
                "identical problems",
            ),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R17",
        "§3.4.2",
        "An infeasible start, x or working set, gives the same optimum as a feasible one.",
        {
            "default": exactly("warm answers equal to cold ones, of 100, default", 100),
            "plane": near("x2 in the plane of Fig. 3.5, default (optimum 0)", 0.0, 1e-12),
            "thesis": exactly(
                "warm answers equal to cold ones, of 100, Algorithm 1",
                100,
                ours=(0, 0),
                why="S keeps rows from being dropped that only a lower level needs (R13), and "
                "which ones depends on the way; with S of the previous levels and the lowest "
                "multiplier among the droppable, it is 82 of 100",
            ),
            "thesis_plane": near(
                "x2 in the plane of Fig. 3.5, Algorithm 1 (optimum 0)",
                0.0,
                1e-12,
                ours=(0.5 - 1e-9, 0.5 + 1e-9),
                why="from W = {A} it adds B and cannot drop A, which is in S",
            ),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R18",
        "§3.4.2",
        "A constraint that is strongly active at a level is not dropped by a lower one, though its "
        "multiplier there is negative.",
        {
            "multiplier": near("multiplier of the level that pushes", 1.0, 1e-9),
            "below": near("multiplier of the level below", -0.0099, 1e-4),
            "kept": exactly("whether the row is kept, Algorithm 1", 1),
            "difference": most("largest difference of the default's x", 1e-12),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "R19",
        "3.5.123-126",
        "COD with a damped inverse: the primal of DLS-HQP equals that of RHQP when the working "
        "set is "
        "equal.",
        {
            "difference": most("largest difference of x, equality tasks", 1e-12),
            "with_limits": most("largest difference of x, with limits", 1e-11),
            "same_sets": exactly("equal working sets, of 100", 100),
        },
        solvers=(ALGORITHM_1, DLS_HQP),
    ),
    Claim(
        "R20",
        "§3.5, §4.3.4",
        "n = 2, q1' <= 0 in W, then the task [1 1] x = -1 with rho = 0.1: RHQP drops the row, "
        "x = (-0.4975, -0.4975) in two iterations (reference); without u_k it stays, x = (0, "
        "-0.9901).",
        {
            "x1": near("x1, RHQP", -0.4975, 5e-5),
            "x2": near("x2, RHQP", -0.4975, 5e-5),
            "default_x1": near("x1, default", -0.4975, 5e-5),
            "iterations": exactly("iterations, RHQP", 2),
            "dls_x1": near("x1, DLS-HQP", 0.0, 5e-5),
            "dls_x2": near("x2, DLS-HQP", -0.9901, 5e-5),
            "dls_optimality": least("optimality residual, DLS-HQP", 0.1),
        },
        solvers=(DEFAULT, ALGORITHM_1, DLS_HQP),
    ),
    Claim(
        "R21",
        "§3.5, Fig. 4.16",
        "A box and two levels that pull apart: without u the active set cycles to the cap; RHQP "
        "ends in three "
        "iterations with x = (-0.495, -0.2827, -0.4762, -0.495) (reference).",
        {
            "difference": most("largest difference of RHQP's x from the reference", 1e-4),
            "iterations": exactly("iterations, RHQP", 3),
            "dls_12": exactly("iterations of DLS-HQP with a cap of 12", 12, thesis="12"),
            "dls_1000": exactly("iterations of DLS-HQP with a cap of 1000", 1000),
            "default_optimality": most("optimality residual, default", 1e-9),
        },
        solvers=(DEFAULT, ALGORITHM_1, DLS_HQP),
    ),
    Claim(
        "R22",
        "3.3.80, §4.3.3",
        "Motion of a lower level caused by a higher task without conflict: none at rho = 0, and "
        "it grows "
        "with rho.",
        {
            "unregularized": most("error of the lower level, rho = 0", 1e-15),
            "growing": exactly("steps of rho at which it does not grow", 0),
            "at_01": near("error at rho = 0.1 over 0.6 / 1.01 * 0.01 / 0.65", 1.0, 1e-9),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "R23",
        "§3.3.3, §4.3.3",
        "rho adapted to the smallest singular value: no error away from the singularity, bounded "
        "x near it.",
        {
            "away": most("largest error for sigma >= 0.1", 1e-14),
            "largest": most("largest |x|", 12.0),
            "at_zero": most("|x| at sigma = 1e-12", 1e-9),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "R24",
        "3.3.39 for an active bound",
        "An active regularised bound is approached at sigma^2 / (sigma^2 + rho^2) = 0.990 of "
        "itself at "
        "rho = 0.1 and never exceeded.",
        {
            "thesis": near("share of the bound, Algorithm 1", 0.990, 1e-3),
            "dls": near("share of the bound, DLS-HQP", 0.990, 1e-3),
            "default": exactly("share of the bound, default (bounds are not regularised)", 1.0),
        },
        solvers=(DEFAULT, ALGORITHM_1, DLS_HQP),
    ),
    Claim(
        "R25",
        "4.3.9-10",
        "Position limits as bounds on velocity: no step ends beyond the limit.",
        {
            "excess": most("worst excess over a limit, T = 1 and 0.5", 1e-14, "rad"),
            "tested": least("share of the steps at a limit", 0.5),
            "controller_excess": most("worst excess, velocity controller", 0.0, "rad"),
            "controller_change": most("change of velocity over what it allows", 1.0 + 1e-9),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "R26",
        "5.6.50-53",
        "Position limits as bounds on acceleration: q + q' dt + q'' dt^2 / 2 stays inside the "
        "limits at each "
        "step.",
        {
            "excess": most("worst excess over a limit", 1e-14, "rad"),
            "tested": most("distance from the limit at the end", 1e-6, "rad"),
            "peak": between("peak acceleration asked for, as printed", 2e4, 6e4, "rad/s²"),
        },
        solvers=(DEFAULT,),
        caveat="the bounds are built by the measurement as printed; AccelerationController is not "
        "asked",
    ),
)
