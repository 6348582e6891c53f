"""K01 to K20: motion and force, levels joint < {hpos, force} < hpitch < pel < gaze, rho = 0.1.

f is what the robot exerts on the ground along z: -5 N presses down. K01 to K04, K06, K12, K13, K15
and K16 on a robot that follows exactly, on a spring of 1.1 kN/m (what the elbow's spring is at the
tip of the scoop); the others in the physics: the robot of 13 coordinates on its tracks, its servos,
ground, the force from the deflection of the elbow springs. C is the thesis'; it prints no M, L, K,
no posture, no speed of the operator and no stiffness: ours are assumed.
"""

from hurcules_studies.thesis.claim import ALGORITHM_1, DEFAULT, Claim, exactly, least, most, near

__all__ = ["FORCE"]

_REACH = "start posture, ranges and hand speed"

FORCE = (
    Claim(
        "K01",
        "5.4.28-31",
        "Inner position loop with f = G (s - r): M s'' + L s' + K (I + C G) s = K C (f_d + G r); "
        "stable.",
        {
            "response": most("deviation from that equation's solution, over the error", 0.01),
            "stable": exactly("stable ones of 1000 random positive gains", 1000),
        },
        solvers=(DEFAULT,),
        caveat="'stable' is algebra of random gains, no part of the product",
    ),
    Claim(
        "K02",
        "5.4.32-33, Fig. 5.8 a",
        "P alone: f_ss = (C G f_d - G r) / (1 + C G), not f_d.",
        {
            "formula": most("deviation from the formula, ground 0 to 30 mm off", 0.01, "N"),
            "off": least("distance from -5 N, the least of six", 0.05, "N"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K03",
        "5.4.34, Fig. 5.8 b",
        "With an integral N: no error, slower; stable iff N < L (1 + C G) / (M G) (Routh).",
        {
            "error": most("distance from -5 N", 0.01, "N"),
            "slower": least("settling over that of P", 1.0),
            "below": most("swing over the earlier swing, N 3 % below the bound", 1.0),
            "above": least("the same, N 3 % above the bound", 1.0),
            "refused": exactly("the force task refuses the N above", 1),
        },
        solvers=(DEFAULT,),
        caveat="the bound of Routh is algebra; the product only refuses the N above it",
    ),
    Claim(
        "K04",
        "5.4.35-40, Fig. 5.8 c",
        "Inner velocity loop: f goes to f_d = -5 N without steady error; wn = sqrt(K C G / M), "
        "zeta = L / (2 sqrt(M K C G)).",
        {
            "response": most(
                "deviation from that oscillator, zeta 0.3, 1, 2, over the error", 0.02
            ),
            "error": most("distance from -5 N in the end", 0.01, "N"),
            "wrong": most("the same with the ground 30 mm off", 0.01, "N"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K05",
        "Figs. 5.8 d, 5.7 b",
        "Without force control and with a wrong height of the ground (30 mm): excessive contact "
        "force; with it -5 N.",
        {
            "none": least("force on the springs without force control", 25.0, "N"),
            "rigid": least("the same with rigid elbows, as in the thesis", 150.0, "N"),
            "velocity": most("velocity loop: distance from -5 N, last second", 0.1, "N"),
        },
        solvers=(DEFAULT,),
        caveat="the product has elbow springs, the thesis' simulation had none",
    ),
    Claim(
        "K06",
        "Fig. 5.8",
        "Settling (2 %) with the same C = 0.05, M, L, K and the ground 30 mm off: the velocity "
        "loop is faster than PI with the best N of sixty; P never arrives. As rates, for any gains "
        "whose velocity loop is not overdamped: its two poles sum to -L/M, those of PI are three.",
        {
            "velocity": most("velocity loop", 1.0, "s"),
            "faster": most("that over PI with its best N", 1.0),
            "P": least("P ends off by", 0.05, "N"),
            "share": exactly(
                "share of 300 such gains, C 0.05 and 0.10, G 1 to 100 kN/m, where no N has the "
                "faster rate",
                1.0,
            ),
        },
        solvers=(DEFAULT,),
        caveat="'share' is algebra, no part of the product",
    ),
    Claim(
        "K07",
        "Fig. 5.9",
        "References change with force control, and do not without.",
        {
            "with": least("commanded joints leave the motion without ground by", 0.01, "rad"),
            "without": exactly("the same without force control", 0.0, "rad"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K08",
        "§5.6.3, Fig. 5.11",
        "Both hands reach out: accelerations and speeds fall gradually from 12 s (singularity).",
        {
            "straight": near("elbows straight at", 12.0, 1.0, "s", thesis="12 s", fitted=_REACH),
            "arms": most("speed of the arms at 12.5 s over 10.5 s", 0.5),
            "bounded": most("largest acceleration after 11.5 s over before", 1.0),
            "whole": most(
                "largest speed of all joints at 13.5 s over 12 s",
                1.0,
                ours=(1.0, 2.0),
                why="hip and knees still carry the straight arms at the operator's speed: with our "
                "lengths and ranges (the thesis prints none) their reach ends 0.4 m later. Of 300 "
                "start postures, pelvis by pitch of the lower arms, those that meet the limits at "
                "8 and 11 s and straighten the elbows by 13 s end their reach at 14 s or later, "
                "and their fastest joint gains 1.2 times or more. At that end the arms come to "
                "rest with `rest` and a maximum lead (docs/control.md)",
            ),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K09",
        "Figs. 5.10, 5.12",
        "Hip limit on at 8 s, off at 11 s; RSP and LSP on at 11 s; limits respected.",
        {
            "hip_on": near("hip at its limit", 8.0, 0.5, "s", thesis="8 s", fitted=_REACH),
            "hip_off": near("hip released", 11.0, 0.5, "s", thesis="11 s", fitted=_REACH),
            "left": near("LSP at its limit", 11.0, 0.5, "s", thesis="11 s", fitted=_REACH),
            "right": near("RSP at its limit", 11.0, 0.5, "s", thesis="11 s", fitted=_REACH),
            "excess": exactly("worst excess of the command over a limit", 0.0, "rad"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K10",
        "Fig. 5.12 a",
        "Iterations of the thesis' algorithm: 2 at 8 s, 3 at 11 s.",
        {
            "hip": near("hip at its limit", 8.0, 0.5, "s", thesis="8 s", fitted=_REACH),
            "hip_steps": exactly("iterations there", 2, thesis="2"),
            "shoulder": near(
                "shoulders at their limits", 11.0, 0.5, "s", thesis="11 s", fitted=_REACH
            ),
            "shoulder_steps": exactly("iterations there", 3, thesis="3"),
            "elsewhere": exactly("iterations of 99 % of all ticks", 1),
        },
        solvers=(ALGORITHM_1, DEFAULT),
    ),
    Claim(
        "K11",
        "Figs. 5.11, 5.13",
        "C_k = 0.05 and 0.10: force around -5 N; visible error at 0.05, less at 0.10; higher "
        "speeds at 0.10 (of the hands up and down: those ahead are the operator's).",
        {
            "force": near("mean force, C = 0.05", -5.0, 0.25, "N", thesis="-5 N"),
            "force_10": near("mean force, C = 0.10", -5.0, 0.25, "N", thesis="-5 N"),
            "visible": least("rms error, C = 0.05", 0.1, "N"),
            "less": most("that of C = 0.10 over it", 1.0),
            "speeds": least("rms vertical speed, C = 0.10 over 0.05", 1.0),
            "contact": least("share of the slide with contact within 10 ms", 0.99),
        },
        solvers=(DEFAULT,),
        caveat="judged by the reading of the elbow springs; the force on the ground is in the "
        "notes of report.html",
    ),
    Claim(
        "K12",
        "5.7.64",
        "f_min = 2.5 N: the force task enters only when |f| > 2.5 N.",
        {
            "enters": near("enters at", 2.5, 0.002, "N", thesis="2.5 N"),
            "pulling": near("and when pulled, at", 2.5, 0.002, "N"),
            "before": exactly("largest speed before", 0.0, "m/s"),
            "small": exactly("ticks of force control under readings up to 2.499 N", 0),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K13",
        "5.7.64",
        "f_max: emergency stop above it (its value is not given; 150 N here).",
        {
            "at": near("stops at", 151.0, 0.5, "N"),
            "speed": exactly("commanded speed from then on", 0.0, "m/s"),
            "stays": exactly("share of the time stopped, the ground gone", 1.0),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K14",
        "§5.6.3, §5.7.2",
        "Unstable when the outer loop is not slower than the joint loop, as with a lower bandwidth "
        "of the joint PID; too small a C on stiff ground is worse. Rigid elbows on 5 kN/m.",
        {
            "slower": most("swing of the force, C G = 5 1/s, servos of 20 to 50 rad/s", 1.0, "N"),
            "faster": least("the same, C G = 150 1/s", 2.0, "N"),
            "lower_bandwidth": least(
                "the same with 0.4 times the bandwidth, over it",
                1.0,
                ours=(0.01, 1.0),
                why="the servo is told the speed of its reference (5.5.49) and the reading is not "
                "late: then servo, mass, ground and force loop have no unstable pole in any of "
                "27,000 combinations, the swing is contact that is lost and met again, and a "
                "softer servo gives way to it. Neither is sure on a machine: with the reading 2 ms "
                "late 5,953 of the 27,000 are unstable, with the damping on the measured speed "
                "10,502, and of the others 856 become so at 0.4 times the bandwidth, as the "
                "thesis says",
            ),
            "too_small": least("settling with springs, C = 0.002 over C = 0.02", 2.0),
        },
        solvers=(DEFAULT,),
        caveat="judged at C G = 150 1/s alone: at 5, 20 and 50 1/s the lower bandwidth swings "
        "more, 1.25, 1.53 and 0.44 N in place of 0.004, 0.02 and 0.31 N, as the thesis says (notes "
        "of report.html)",
    ),
    Claim(
        "K15",
        "5.7.54-59",
        "Velocity form: s' + C G s = C G r + C f_d, time constant 1 / (C G), no steady error; "
        "discrete bound "
        "C G dt < 1 or so.",
        {
            "response": most("deviation from that equation's solution, over the error", 0.01),
            "constant": near("measured time constant times C G", 1.0, 0.02),
            "error": most("distance from -5 N", 1e-3, "N"),
            "bound": near("C G dt of the stiffest ground that the task allows", 1.0, 1e-3),
            "below": most("swing over the first swing, C G dt = 0.9, reading one step old", 0.01),
            "above": least("the same, C G dt = 1.1", 1.0),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K16",
        "Fig. 5.16",
        "C swept, 0.005 to 0.10: a larger C is faster.",
        {
            "not_faster": exactly("larger C that are not faster", 0),
            "law": most("C times settling, largest over least", 1.1),
            "error": most("distance from -5 N, any C", 1e-3, "N"),
        },
        solvers=(DEFAULT,),
        caveat="on a slide that follows exactly, where this is so by definition of the law",
    ),
    Claim(
        "K17",
        "Fig. 5.17",
        "C = 0.05: all joint speeds jump near 21 s, when |f| reaches f_min. (Ours do not, with a "
        "blend.)",
        {
            "when": near("|f| reaches f_min", 21.0, 0.5, "s", thesis="21 s", fitted="speed down"),
            "all": least("least jump of a joint's speed within 20 ms, over the speed before", 3.0),
            "blend": most("largest jump with a blend of 0.1 s, over that without", 0.1),
            "force": most("distance from -5 N after 2 s", 0.1, "N"),
        },
        solvers=(DEFAULT,),
    ),
    Claim(
        "K18",
        "Figs. 5.8, 5.16",
        "With and without the elbow's spring: a peak at impact without, a smooth transition with "
        "(0.05 m/s, stiff ground).",
        {
            "spring": most("largest force on the ground, with springs", 50.0, "N"),
            "ratio": least("that without, over it", 2.0),
            "smooth": most("distance from -5 N in the last second, with springs", 0.25, "N"),
            "rigid_swing": least("swing of the force without, last second", 2.0, "N"),
        },
        solvers=(DEFAULT,),
        caveat="wants a swing with rigid elbows, which Fig. 5.8 c does not show",
    ),
    Claim(
        "K19",
        "Fig. 5.6",
        "Twelve phases: drive, open arms, waist, fold, legs, ready, lowering, acquisition, "
        "confirm (motion "
        "only), embrace, lift, lift. (Nobody lies there; lifting a person is F02.)",
        {
            "phases": exactly("phases, in this order", 12),
            "drove": near("way driven", 1.0, 0.05, "m"),
            "collisions": exactly("pairs of the robot's geoms that met", 0),
            "margin": least("centre of mass inside the support", 0.0, "m"),
            "lowering": most("lowering: distance from -5 N in the end", 0.25, "N"),
            "acquisition": least("acquisition: share with contact within 10 ms", 0.99),
            "confirm": exactly("confirm: force on the ground in the end", 0.0, "N"),
            "motion_only": exactly("share of its last 0.5 s under force control", 0.0),
            "height": least("tips above the ground in the end", 0.9, "m"),
        },
        solvers=(DEFAULT,),
        caveat="counts the phases of its own script; nobody lies there",
    ),
    Claim(
        "K20",
        "§5.7.2",
        "No or too little contact with the ground: the casualty is pushed away instead of "
        "scooped; with force "
        "control the arms penetrate, also on stiff ground. A limp person of 75 kg; as the share of "
        "the tips' way by which the chest moves ahead, from the first touch on.",
        {
            "above": least(
                "edges of the tips 27 mm above the ground (45 mm at the middle of the blade)",
                0.8,
            ),
            "pressing": most("tips pressing with 5 N", 0.25),
            "deeper": least("what is left for going under, with over without", 1.5),
        },
        solvers=(DEFAULT,),
    ),
)
