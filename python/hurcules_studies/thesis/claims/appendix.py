"""P01 to P09: the joint servo of the appendix, tau = (K + I / gamma^2)(e' + K_P e + K_I int e).

The sign is that of tau = -u; as printed, (A.2.12) mixes both. Gains are not published: ours put a
triple pole at a bandwidth (joint_pid.hpp).
"""

from hurcules_studies.thesis.claim import Claim, between, exactly, least, most, near

__all__ = ["APPENDIX"]

# §A.3: 0.4 degrees, 7.0 mrad
_BOUND = 6.98e-3

APPENDIX = (
    Claim(
        "P01",
        "A.2.12",
        "The robust PID tracks. An arm of two joints in a vertical plane with 30 kg at its end, "
        "lifted and lowered "
        "for 12 s.",
        {
            "law": most("largest difference of the torque from R^-1 B' P x, over its size", 1e-10),
            "error": most("largest joint error", _BOUND, "rad"),
            "rest": most("joint error at rest, after 5 s", 1e-5, "rad"),
        },
    ),
    Claim(
        "P02",
        "A.2.9",
        "K, K_P, K_I > 0, K_P^2 > 2 K_I and gamma > 0 make P positive definite.",
        {
            "least": least("least eigenvalue of P over its largest, 200 random robots", 1e-9),
            "refused": exactly("kinds of gains outside the conditions that are refused, of 5", 5),
            "beyond": exactly("whether K_P^2 just above 2 K_I is taken", 1),
        },
        caveat="the eigenvalues are algebra in numpy; the product takes part in what is refused",
    ),
    Claim(
        "P03",
        "A.2.11",
        "The Riccati equation gives Q = diag(K_I^2 K, (K_P^2 - 2 K_I) K, K).",
        {"difference": most("largest difference, over the size of Q", 1e-10)},
        caveat="algebra in numpy, no part of the product",
    ),
    Claim(
        "P04",
        "§A.2",
        "Twice the performance: a state weight four times larger halves the control errors.",
        {
            "ratio": near(
                "largest error with 4 K over that with K",
                0.5,
                0.1,
                thesis="1/2",
                figure=True,
                # an error that a load makes goes with 1 / K, one of acceleration faster
                ours=(0.15, 0.3),
                why="K multiplies the whole law (A.2.12), so an error that a load makes falls "
                "with 1 / K, to a quarter; a half is what the weight of (A.2.5) guarantees",
            ),
            "square_root": most("largest error with 4 K over that with K, at most a half", 0.5),
        },
    ),
    Claim(
        "P05",
        "Figs. A.1-A.2",
        "The seven-joint arm moves through tuning postures: bounded errors. The left arm of the "
        "manipulation robot, "
        "in the physics, standing on its tracks.",
        {
            "error": most("largest joint error of the arm", _BOUND, "rad"),
            "end": most("largest joint error at the end", 1e-3, "rad"),
            "saturated": exactly("ticks with a saturated motor", 0),
        },
        caveat="also holds with half the gains",
    ),
    Claim(
        "P06",
        "Figs. A.3-A.4",
        "The four-joint arms lift 120 kg: joint errors of at most 0.4 degrees.",
        {
            "arms": most("largest error of an arm joint", _BOUND, "rad", thesis="0.4 degrees"),
            "all": most("largest error of any joint that lifts", _BOUND, "rad"),
        },
    ),
    Claim(
        "P07",
        "§4.2.1, §A.3",
        "The same gains carry 0 to 120 kg without feed-forward. The rescue robot standing, its "
        "arms moving, the load "
        "shared by both lower arms.",
        {
            "load_0": most("largest joint error, 0 kg", _BOUND, "rad", thesis="0.4 degrees"),
            "load_60": most("largest joint error, 60 kg", _BOUND, "rad", thesis="0.4 degrees"),
            "load_120": most("largest joint error, 120 kg", _BOUND, "rad", thesis="0.4 degrees"),
            "saturated": exactly("ticks with a saturated motor", 0),
        },
    ),
    Claim(
        "P08",
        "§A.2",
        "Bounded disturbance, bounded error (input-to-state stability); for moving references "
        "the error does "
        "not vanish, and it tends to zero when the disturbance does.",
        {
            "growth": between("error under 100 N m over that under 50 N m", 1.8, 2.2),
            "late": most(
                "largest error of the last third over that of the second, disturbed", 1.05
            ),
            "moving": least("largest error while moving, undisturbed", 1e-5, "rad"),
            "after": most("error 5 s after disturbance and motion", 1e-5, "rad"),
        },
    ),
    Claim(
        "P09",
        "§A.2",
        "gamma changes the control weight alone, and a smaller one rejects disturbances better.",
        {
            "falling": exactly("steps to a smaller gamma at which the error does not fall", 0),
            "q_changed": most("largest change of Q with gamma", 1e-10),
            "ratio": most("largest error at gamma = 0.05 over that at 1", 0.9),
        },
    ),
)
