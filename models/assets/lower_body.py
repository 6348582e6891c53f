"""Meshes of the upper legs: frame, hip motors, decks, battery, transfer bed.

Metres, in the frame of the link that shows the mesh.
"""

import numpy as np

from solids import box, lathe, mirror, plate


def chassis():
    """Upper legs: tail beam, knee gearbox and axle, decks, hip yokes."""
    part = box((0.16, 0.205, 0.24), (-0.53, 0, 0.03), 0.02)
    part += lathe([(0.075, -0.105), (0.092, -0.09), (0.092, 0.09), (0.075, 0.105)], 28)
    part += lathe([(0.05, -0.24), (0.05, 0.24)], 20)
    part += box((0.30, 0.06, 0.20), (-0.30, 0, 0.03))
    part += box((0.24, 0.48, 0.018), (-0.51, 0, 0.151), 0.005)
    yoke = [
        (-0.63, 0.155),
        (-0.36, 0.155),
        (-0.40, 0.25),
        (-0.445, 0.35),
        (-0.555, 0.35),
        (-0.60, 0.25),
    ]
    return part + mirror(plate(yoke, 0.128, 0.168, 0.010))


def hip_motors():
    """Motor cans outside the yokes, on the hip axis."""
    can = [
        (0.088, 0.166),
        (0.088, 0.176),
        (0.080, 0.180),
        (0.080, 0.214),
        (0.070, 0.226),
        (0.030, 0.228),
        (0.026, 0.236),
    ]
    part = mirror(lathe(can, 28, (-0.50, 0, 0.278)))
    for k in range(8):
        a = k * np.pi / 4
        fin = box(
            (0.016, 0.030, 0.016),
            (-0.50 + 0.078 * np.cos(a), 0.196, 0.278 + 0.078 * np.sin(a)),
            0.003,
        )
        part += mirror(fin)
    return part


def decks():
    """Ribbed covers above the upper tracks, with a sloping front."""
    part = []
    for y0, y1 in ((-0.243, -0.108), (0.108, 0.243)):
        part += plate(
            [(-0.355, 0.144), (0.02, 0.144), (0.02, 0.158), (-0.355, 0.158)], y0, y1, 0.003
        )
        part += plate(
            [(0.018, 0.144), (0.088, 0.104), (0.094, 0.114), (0.022, 0.158)], y0, y1, 0.003
        )
        for x in (-0.30, -0.24, -0.18, -0.12, -0.06, 0):
            part += box((0.012, y1 - y0 - 0.02, 0.006), (x, (y0 + y1) / 2, 0.159), 0.002)
    return part


def battery():
    """Battery box with ribs; the handles are a mesh of their own."""
    part = box((0.34, 0.20, 0.235), (-0.005, 0, 0.005), 0.014)
    for x in (-0.12, -0.06, 0, 0.06, 0.12):
        part += box((0.02, 0.206, 0.18), (x, 0, 0), 0.004)
    return part


def bed():
    """Stowed transfer bed: frame, cross rails, slides."""
    part = []
    for x in (-0.165, 0.165):
        part += box((0.030, 0.46, 0.05), (x, 0, -0.005), 0.008)
    for y in (-0.215, 0.215):
        part += box((0.36, 0.030, 0.06), (0, y, -0.005), 0.010)
    for y in (-0.12, -0.04, 0.04, 0.12):
        part += box((0.32, 0.022, 0.03), (0, y, -0.02), 0.004)
    for x in (-0.10, 0.10):
        part += box((0.05, 0.40, 0.02), (x, 0, -0.032), 0.004)
    return part


def bed_pad():
    """Padded lying surface in three cushions."""
    part = []
    for y in (-0.132, 0, 0.132):
        part += box((0.30, 0.126, 0.03), (0, y, 0.025), 0.012)
    return part


PARTS = (chassis, hip_motors, decks, battery, bed, bed_pad)
