"""Meshes of pelvis, waist, torso, backpack, neck and camera head.

Metres, in the frame of the link that shows the mesh.
"""

import numpy as np

from solids import arc, box, lathe, mirror, panel, plate, shell


def pelvis():
    """Drum on the hip axis, neck up to the slewing ring of the waist."""
    part = lathe([(0.092, -0.124), (0.104, -0.112), (0.104, 0.112), (0.092, 0.124)], 32)
    part += shell([(0.02, 0.20, 0.23, 0), (0.09, 0.20, 0.23, 0), (0.105, 0.18, 0.20, 0)], 0.03)
    return part + lathe(
        [(0.096, 0.088), (0.106, 0.094), (0.106, 0.112), (0.098, 0.118)], 32, axis="z"
    )


def pelvis_armour():
    """Bent plates before and behind the drum."""
    front = arc(0.106, 0.120, np.radians(-35), np.radians(62), -0.115, 0.115)
    back = arc(0.106, 0.120, np.radians(118), np.radians(215), -0.115, 0.115)
    return front + back


def bellows():
    """Cover from slewing ring to torso: folds, then a flange."""
    part = lathe([(0.100, 0.0), (0.110, 0.006), (0.110, 0.022), (0.100, 0.028)], 32, axis="z")
    rows = []
    for k in range(7):
        z = 0.028 + 0.022 * k
        grow = 0.010 * k
        rows += [
            (z, 0.170 + grow, 0.200 + 1.6 * grow, 0),
            (z + 0.011, 0.198 + grow, 0.228 + 1.6 * grow, 0),
        ]
    part += shell(rows, 0.05)
    return part + shell(
        [
            (0.165, 0.25, 0.33, 0),
            (0.19, 0.275, 0.36, 0),
            (0.245, 0.275, 0.37, 0),
            (0.262, 0.25, 0.34, 0),
        ],
        0.045,
    )


def torso():
    """Bevelled hull, broad at the shoulders (origin 0.26 m above the waist joint)."""
    return shell(
        [
            (-0.005, 0.23, 0.32, 0),
            (0.04, 0.255, 0.37, 0),
            (0.16, 0.262, 0.42, 0.002),
            (0.30, 0.27, 0.445, 0.006),
            (0.43, 0.255, 0.445, 0.004),
            (0.485, 0.215, 0.39, -0.004),
            (0.525, 0.15, 0.26, -0.012),
        ],
        0.055,
    )


def chest():
    """Breast plates, belly plate, shoulder straps."""
    part = mirror(
        panel(
            [
                (0.016, 0.215),
                (0.150, 0.195),
                (0.196, 0.26),
                (0.196, 0.385),
                (0.160, 0.435),
                (0.016, 0.435),
            ],
            0.10,
            0.160,
            0.014,
        )
    )
    part += panel(
        [
            (-0.12, 0.03),
            (0.12, 0.03),
            (0.145, 0.06),
            (0.145, 0.165),
            (0.105, 0.19),
            (-0.105, 0.19),
            (-0.145, 0.165),
            (-0.145, 0.06),
        ],
        0.10,
        0.146,
        0.012,
    )
    return part


def chest_trim():
    """Dark parts of the front: belly louvres, lidar recess, collar."""
    part = []
    for z in (0.062, 0.084, 0.106, 0.128, 0.150):
        part += box((0.012, 0.19, 0.010), (0.146, 0, z), 0.003)
    part += lathe([(0.118, 0.505), (0.100, 0.535), (0.072, 0.545)], 28, (0.01, 0, 0), "z")
    part += mirror(lathe([(0.094, 0.205), (0.094, 0.232), (0.086, 0.238)], 28, (0, 0, 0.47)))
    return part


def backpack():
    """Computer case: hull, cooling ribs, top step."""
    part = shell(
        [
            (-0.25, 0.07, 0.27, 0.01),
            (-0.22, 0.10, 0.32, 0),
            (0.17, 0.10, 0.32, 0),
            (0.215, 0.085, 0.30, 0.008),
            (0.25, 0.06, 0.25, 0.018),
        ],
        0.025,
    )
    for y in (-0.105, -0.075, -0.045, 0.045, 0.075, 0.105):
        part += box((0.018, 0.014, 0.26), (-0.052, y, -0.03), 0.004)
    return part + box((0.012, 0.09, 0.12), (-0.052, 0, 0.10), 0.004)


def neck():
    """Yaw column with a fork that bears the head's pitch axis, 0.08 m above the frame."""
    part = lathe([(0.062, -0.02), (0.062, 0.0), (0.046, 0.012), (0.046, 0.020)], 24, axis="z")
    part += box((0.056, 0.272, 0.022), (0, 0, 0.023), 0.005)
    cheek = [(-0.028, 0.014), (0.028, 0.014), (0.028, 0.080)]
    turned = np.radians(np.arange(20, 180, 20))
    cheek += [(0.028 * np.cos(a), 0.080 + 0.028 * np.sin(a)) for a in turned]
    part += mirror(plate([*cheek, (-0.028, 0.080)], 0.123, 0.136, 0.003))
    return part + mirror(lathe([(0.018, 0.134), (0.018, 0.139), (0.014, 0.141)], 20, (0, 0, 0.08)))


def head():
    """Camera head: hull with a visor recess, on the shaft of its pitch axis."""
    part = shell(
        [
            (0.012, 0.10, 0.16, 0),
            (0.035, 0.165, 0.235, 0.005),
            (0.075, 0.20, 0.275, 0.008),
            (0.150, 0.20, 0.28, 0.006),
            (0.185, 0.165, 0.245, -0.004),
            (0.203, 0.12, 0.19, -0.010),
        ],
        0.035,
    )
    return part + lathe([(0.020, -0.125), (0.020, 0.125)], 20)


def visor():
    """Dark glass before the lenses."""
    return panel(
        [
            (-0.108, 0.066),
            (0.108, 0.066),
            (0.124, 0.086),
            (0.124, 0.128),
            (0.108, 0.146),
            (-0.108, 0.146),
            (-0.124, 0.128),
            (-0.124, 0.086),
        ],
        0.090,
        0.113,
        0.006,
    )


def lens_rings():
    """Barrels of the stereo pair, the wide-angle camera and the infrared camera."""
    barrel = [(0.026, 0.10), (0.026, 0.119), (0.022, 0.122), (0.019, 0.122), (0.018, 0.1165)]
    part = mirror(lathe(barrel, 20, (0, 0.06, 0.10), "x"))
    part += lathe(
        [(0.021, 0.10), (0.021, 0.119), (0.018, 0.122), (0.015, 0.122), (0.014, 0.1165)],
        20,
        (0, 0, 0.10),
        "x",
    )
    return part + box((0.02, 0.036, 0.022), (0.105, 0, 0.155), 0.004)


def lenses():
    """Glass of the same cameras."""
    part = mirror(
        lathe([(0.019, 0.112), (0.014, 0.1175), (0.006, 0.1195)], 20, (0, 0.06, 0.10), "x")
    )
    part += lathe([(0.015, 0.112), (0.011, 0.117), (0.005, 0.1185)], 20, (0, 0, 0.10), "x")
    return part + lathe([(0.008, 0.10), (0.007, 0.1165)], 12, (0, 0, 0.155), "x")


def lidar():
    """Scanner on the head; its top is the top of the robot, 0.26 m above the pitch axis."""
    return lathe(
        [
            (0.050, 0.198),
            (0.050, 0.212),
            (0.044, 0.214),
            (0.044, 0.244),
            (0.050, 0.246),
            (0.050, 0.256),
            (0.040, 0.26),
        ],
        28,
        (-0.01, 0, 0),
        "z",
    )


PARTS = (
    pelvis,
    pelvis_armour,
    bellows,
    torso,
    chest,
    chest_trim,
    backpack,
    neck,
    head,
    visor,
    lens_rings,
    lenses,
    lidar,
)
