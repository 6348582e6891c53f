"""Meshes of the arms; symmetric in y, so that left and right share them; the flanges are mirrored.

Metres, in the frame of the link that shows the mesh.
"""

import numpy as np
from solids import box, lathe, loft, mirror, panel, plate, shell


def shoulder_can():
    """Pitch drive between torso and shoulder."""
    return lathe(
        [(0.080, -0.022), (0.086, -0.014), (0.086, 0.004), (0.074, 0.010), (0.074, 0.05)], 28
    )


def pauldron():
    """Shoulder armour around the roll drive."""
    return shell(
        [
            (-0.132, 0.118, 0.118, 0),
            (-0.105, 0.148, 0.146, 0),
            (0.02, 0.165, 0.156, 0),
            (0.062, 0.150, 0.144, 0),
            (0.088, 0.10, 0.10, 0),
        ],
        0.038,
    )


def upper_arm():
    """Bevelled sleeve and the two elbow cheeks."""
    part = shell(
        [
            (-0.225, 0.092, 0.094, 0),
            (-0.195, 0.122, 0.122, 0),
            (-0.06, 0.136, 0.134, 0),
            (-0.012, 0.128, 0.126, 0),
            (0.006, 0.105, 0.105, 0),
        ],
        0.034,
    )
    cheek = [
        (-0.046, -0.30),
        (-0.02, -0.328),
        (0.02, -0.328),
        (0.046, -0.30),
        (0.055, -0.20),
        (-0.055, -0.20),
    ]
    return part + mirror(plate(cheek, 0.046, 0.066, 0.005))


def elbow():
    """Elbow drive on the joint axis, between the cheeks."""
    part = lathe([(0.044, -0.045), (0.050, -0.040), (0.050, 0.040), (0.044, 0.045)], 24)
    return part + lathe([(0.022, -0.074), (0.026, -0.070), (0.026, 0.070), (0.022, 0.074)], 16)


def scoop_root():
    """Root of the rescue lower arm with the two spring housings of the compliant elbow."""
    part = shell(
        [
            (-0.20, 0.036, 0.112, -0.004),
            (-0.16, 0.055, 0.116, 0),
            (-0.07, 0.080, 0.090, 0),
            (-0.015, 0.080, 0.086, 0),
            (0.02, 0.06, 0.08, 0),
        ],
        0.018,
    )
    return part + mirror(
        lathe(
            [(0.012, -0.165), (0.016, -0.16), (0.016, -0.075), (0.012, -0.07)],
            14,
            (0.036, 0.03, 0),
            "z",
        )
    )


# Blade and tip of the scoop are one wedge, flat below: (z, half width, upper face) [m]. What the
# contact hulls in common/looks.xml say, too.
SCOOP_BOTTOM = -0.018
SCOOP = ((-0.16, 0.060, 0.018), (-0.58, 0.060, -0.0085), (-0.70, 0.040, -0.016))
LINER = 0.0015  # [m] plastic on the upper face, half as thick at the edge


def scoop_ring(z, half, top):
    """Cross-section of the scoop: edges cut above, where a person slides."""
    cut = min(0.005, 0.4 * (top - SCOOP_BOTTOM))
    return [
        (SCOOP_BOTTOM, -half, z),
        (SCOOP_BOTTOM, half, z),
        (top - cut, half, z),
        (top, half - cut, z),
        (top, cut - half, z),
        (top - cut, -half, z),
    ][::-1]


def scoop_part(begin, end):
    """The wedge between two of its rings, below the liner."""
    depth = {-0.70: 0.5 * LINER}
    rows = [(z, half, top - depth.get(z, LINER)) for z, half, top in SCOOP]
    return loft([scoop_ring(*row) for row in rows[begin : end + 1][::-1]])


def scoop_blade():
    """Carrying blade, to 0.58 m from the elbow."""
    return scoop_part(0, 1)


def scoop_tip():
    """Tip of the blade, 2 mm thin at its edge, 0.70 m from the elbow."""
    return scoop_part(1, 2)


def scoop_liner():
    """Sliding plastic on the carrying face, to the edge."""
    rows = [(z, half - 0.010, top) for z, half, top in SCOOP[::-1]]
    return loft(
        [
            [(top, half, z), (top - LINER, half, z), (top - LINER, -half, z), (top, -half, z)]
            for z, half, top in rows
        ]
    )


# Flange on the inner edge of the left blade (the right one is its mirror image): the same wedge,
# (y, z) of its corners [m], from inside out.
FLANGE = ((-0.060, -0.34), (-0.180, -0.40), (-0.180, -0.58), (-0.160, -0.70), (-0.040, -0.70))


def scoop_top(z):
    """Upper face of the wedge over the length of the flange [m]."""
    root, tip = 0.006643, -0.016
    return tip + (z + 0.70) / 0.36 * (root - tip)


def scoop_flange():
    """Carries what lies between the arms: 0.12 m wide, to the tip; its root is cut diagonally."""
    below = np.array([(SCOOP_BOTTOM, y, z) for y, z in FLANGE])
    above = np.array([(scoop_top(z) - 0.5 * LINER, y, z) for y, z in FLANGE])
    return loft([above, below])


def scoop_flange_liner():
    """Sliding plastic on the flange."""
    rows = [(scoop_top(z), y, z) for y, z in FLANGE]
    return loft([[(x, y, z) for x, y, z in rows], [(x - 0.5 * LINER, y, z) for x, y, z in rows]])


def forearm():
    """Sleeve of the manipulation forearm."""
    return shell(
        [
            (-0.178, 0.084, 0.084, 0),
            (-0.15, 0.106, 0.106, 0),
            (-0.06, 0.116, 0.114, 0),
            (-0.02, 0.09, 0.088, 0),
            (0.02, 0.06, 0.08, 0),
        ],
        0.028,
    )


def wrist_roll():
    """Roll drive with two rings."""
    return lathe(
        [
            (0.040, -0.105),
            (0.047, -0.10),
            (0.047, -0.075),
            (0.042, -0.07),
            (0.042, -0.035),
            (0.049, -0.03),
            (0.049, -0.006),
            (0.042, 0.0),
        ],
        24,
        axis="z",
    ) + mirror(plate([(-0.03, -0.15), (0.03, -0.15), (0.034, -0.09), (-0.034, -0.09)], 0.036, 0.05))


def wrist_pitch():
    """Pitch drive and the flange of the hand."""
    return lathe([(0.030, -0.036), (0.034, -0.032), (0.034, 0.032), (0.030, 0.036)], 20) + lathe(
        [(0.040, -0.062), (0.044, -0.056), (0.044, -0.04), (0.030, -0.02)], 24, axis="z"
    )


def palm():
    """Gripper body with the cross guide of the fingers."""
    part = shell(
        [
            (-0.078, 0.085, 0.118, 0),
            (-0.062, 0.10, 0.13, 0),
            (-0.03, 0.10, 0.12, 0),
            (-0.004, 0.085, 0.085, 0),
        ],
        0.022,
    )
    return part + box((0.05, 0.20, 0.02), (0, 0, -0.078), 0.004)


def finger():
    """Left finger (closing towards -y): carriage and blade."""
    part = box((0.044, 0.03, 0.034), (0, 0.012, -0.008), 0.005)
    return part + panel(
        [
            (-0.012, -0.012),
            (0.028, -0.012),
            (0.020, -0.07),
            (0.006, -0.112),
            (-0.002, -0.112),
            (-0.002, -0.03),
        ],
        -0.018,
        0.018,
        0.003,
    )


PARTS = (
    shoulder_can,
    pauldron,
    upper_arm,
    elbow,
    scoop_root,
    scoop_blade,
    scoop_tip,
    scoop_liner,
    scoop_flange,
    scoop_flange_liner,
    forearm,
    wrist_roll,
    wrist_pitch,
    palm,
    finger,
)
