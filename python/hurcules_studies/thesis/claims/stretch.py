"""S01 to S06: the stretch, closed loop in the physics.

13 coordinates, rho = 0.1, joint < hpos (6) < hpitch (2) < pel (1) < gaze (2). Times count from the
start of the stretch. The thesis prints no geometry and no speed of the operator; ours are assumed
(models/README.md), the speed so that the hip's time fits, the length of the way so that the pelvis
gives way by 0.40 m.
"""

from hurcules_studies.thesis.claim import ALGORITHM_1, DEFAULT, Claim, exactly, least, most, near

__all__ = ["STRETCH"]

_START = "start posture, ranges and hand speed"

STRETCH = (
    Claim(
        "S01",
        "§4.4, Fig. 4.24",
        "A single command forward for both lower arms; all other references stay.",
        {
            "commands": exactly("commands that are not zero", 2),
            "other": most("largest other command", 0.0),
            "way": near("way of both hands' references", 0.875, 1e-3, "m"),
        },
        solvers=(DEFAULT,),
        caveat="restates the mission's command",
    ),
    Claim(
        "S02",
        "Figs. 4.25-26",
        "About 15 s: the hip meets its limit and stops, the knee starts, the error of the pelvis "
        "task starts "
        "to grow.",
        {
            "hip": near("hip at its limit, default", 15.0, 2.0, "s", thesis="15 s", fitted=_START),
            "rhqp_hip": near("the same, RHQP", 15.0, 2.0, "s", thesis="15 s", fitted=_START),
            "hip_speed": most("largest hip speed while held", 1e-3, "rad/s"),
            "knee_before": most("knee speed over that 1 s later, before", 0.1),
            "pelvis_at": most("pelvis error when the hip stops", 0.005, "m"),
            "pelvis_later": least("pelvis error 5 s later", 0.02, "m"),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "S03",
        "Figs. 4.25-26",
        "About 25 s: the shoulder pitch meets its limit, the hip's constraint is released and "
        "the hip moves "
        "again.",
        {
            "shoulder": near(
                "shoulder at its limit, default", 25.0, 2.0, "s", thesis="25 s", fitted=_START
            ),
            "released": near("hip released, default", 25.0, 2.0, "s", thesis="25 s", fitted=_START),
            "apart": most("between the two, default", 0.5, "s"),
            "rhqp_shoulder": near(
                "shoulder at its limit, RHQP", 25.0, 2.0, "s", thesis="25 s", fitted=_START
            ),
            "rhqp_released": near(
                "hip released, RHQP", 25.0, 2.0, "s", thesis="25 s", fitted=_START
            ),
            "rhqp_apart": most(
                "between the two, RHQP",
                0.5,
                "s",
                ours=(1.0, 2.0),
                why="the set S of Algorithm 1 keeps the hip's limit longer than it holds anything "
                "back (R13)",
            ),
            "hip_speed": least("hip speed 1 s later", 0.01, "rad/s"),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
    Claim(
        "S04",
        "§4.4",
        "The gaze stays on the casualty throughout by tilting the neck.",
        {
            "gaze": most("largest gaze error, measured", 5e-3, "rad"),
            "commanded": most("largest gaze error, commanded", 1e-3, "rad"),
            "neck": least("neck tilt moves by", 0.05, "rad"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "S05",
        "§4.4",
        "At the end the pelvis task has an error of 0.40 m; hand position and pitch errors are "
        "small.",
        {
            "pelvis": near(
                "pelvis error at the end",
                0.40,
                0.02,
                "m",
                thesis="0.40 m",
                fitted=f"{_START}, and where it ends",
            ),
            "hand": most("largest hand error, commanded", 1e-3, "m"),
            "hand_measured": most("hand error at the end, measured", 5e-3, "m"),
            "pitch": most("largest pitch error, commanded", 1e-3, "rad"),
            "excess": most("worst excess of the commanded motion over a limit", 0.0, "rad"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "S06",
        "Fig. 4.26 b",
        "The joint control errors spike exactly at the switching times. Changes of any joint's "
        "error within 0.2 s: of the mission, and of Algorithm 1 with limits as printed.",
        {
            "release": least(
                "change when the hip is released, over the usual (90 %), default", 5.0
            ),
            "largest": least("that over the largest elsewhere, default", 1.0),
            "stop": least(
                "change when the hip stops, over the usual (90 %), default",
                2.0,
                ours=(0.5, 2.0),
                why="the default brakes a joint before its limit, so that the hip stops softly",
            ),
            "rhqp_release": least("when the hip is released, RHQP", 5.0),
            "rhqp_largest": least("that over the largest elsewhere, RHQP", 1.0),
            "rhqp_stop": least(
                "when the hip stops, RHQP",
                2.0,
                ours=(1.0, 2.0),
                why="the hip is slow when it stops, its commanded speed jumps by 15 mrad/s (by "
                "0.84 rad/s when it is released); other moments change the errors as much",
            ),
        },
        solvers=(DEFAULT, ALGORITHM_1),
    ),
)
