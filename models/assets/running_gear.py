"""Meshes of the tracks: belt with pads, sprocket, road wheel, suspension beam.

Frame of a track: heel axle at the origin along y, toe axle at x = -run; metres.
"""

import numpy as np
from solids import box, lathe, loft, mirror, plate, turn

RADIUS = 0.14  # of all tracks, pads included
LOWER = dict(run=0.85, width=0.15)  # axle distance and belt width of a lower-leg track
UPPER = dict(run=0.55, width=0.13)  # the same of an upper-leg track


def oval(s, run, radius):
    """Point and outward normal at arc length s of the track's mid line; heel axle at x = 0."""
    bend = np.pi * radius
    s = s % (2 * run + 2 * bend)
    if s < run:
        return np.array([-s, -radius]), np.array([0.0, -1.0])
    if s < run + bend:
        a = -np.pi / 2 - (s - run) / radius
        return np.array([-run, 0]) + radius * np.array([np.cos(a), np.sin(a)]), np.array(
            [np.cos(a), np.sin(a)]
        )
    if s < 2 * run + bend:
        return np.array([-run + s - run - bend, radius]), np.array([0.0, 1.0])
    a = np.pi / 2 - (s - 2 * run - bend) / radius
    return radius * np.array([np.cos(a), np.sin(a)]), np.array([np.cos(a), np.sin(a)])


BAND = RADIUS - 0.014  # the pads stand on it and end at RADIUS
PITCH = 0.058  # at least, from pad to pad


def band(run, width):
    """Rubber band without pads."""
    band, thick = BAND, 0.012
    part = []
    marks = np.r_[
        0,
        run + np.linspace(0, 1, 15) * np.pi * band,
        2 * run + np.pi * band + np.linspace(0, 1, 15)[:-1] * np.pi * band,
    ]
    sections = []
    for s in marks:
        p, n = oval(s, run, band)
        q = p - thick * n
        y = width / 2
        sections.append(
            np.array([(p[0], -y, p[1]), (p[0], y, p[1]), (q[0], y, q[1]), (q[0], -y, q[1])])
        )
    for a, b in zip(sections, sections[1:] + sections[:1]):
        for i in range(4):
            j = (i + 1) % 4
            part.append(np.array([a[i], b[i], b[j], a[j]]))
    return part


def belt(run, width):
    """Band with two staggered rows of pads; what draws moving pads replaces it by band and pads."""
    part = band(run, width)
    length = 2 * run + 2 * np.pi * BAND
    count = int(length / PITCH)
    for k in range(count):
        for row in (0, 1):
            p, n = oval((k + 0.5 * row) * length / count, run, BAND)
            y0, y1 = (-width / 2, 0.004) if row else (-0.004, width / 2)
            part += pad(p, n, y0, y1)
    return part


def pad(p, n, y0, y1, foot=0.019, top=0.012, height=0.014):
    """One pad: a low frustum on the band at p with outward normal n."""
    t = np.array([-n[1], n[0]])
    corner = lambda half, up, y: (p[0] + half * t[0] + up * n[0], y, p[1] + half * t[1] + up * n[1])
    low = [(-foot, y0), (-foot, y1), (foot, y1), (foot, y0)]
    high = [(-top, y0 + 0.004), (-top, y1 - 0.004), (top, y1 - 0.004), (top, y0 + 0.004)]
    low, high = ([corner(a, up, y) for a, y in ring] for ring, up in ((low, 0), (high, height)))
    return loft([low, high])[:-8] + [np.array(high)]


def single_pad(width):
    """One pad of a row, on the band below it (z = 0), in the middle of its row (y = 0)."""
    half = width / 4 + 0.002
    return pad(np.zeros(2), np.array([0.0, 1.0]), -half, half)


def sprocket(width, teeth=13, radius=0.116):
    """Two toothed rings on a drum, with a dished and bolted face on both sides."""
    a = np.arange(4 * teeth) * np.pi / (2 * teeth)
    r = np.where(np.arange(4 * teeth) % 4 < 2, radius, radius - 0.014)
    part = []
    for side in (-1, 1):
        y = side * (width / 2 - 0.024)
        part += loft(
            [
                np.c_[r * k * np.sin(a), np.full(len(a), y + h), r * k * np.cos(a)]
                for k, h in ((1, -0.007), (1, 0.007))
            ]
        )
    face = [(0.022, 0.006), (0.028, -0.006), (0.060, -0.016), (0.078, -0.008), (0.092, -0.008)]
    out = [(r, width / 2 - 0.010 + h) for r, h in face]
    part += lathe([(r, -y) for r, y in out] + [(r, y) for r, y in out[::-1]], 20)
    for k in range(6):
        bolt = lathe([(0.007, 0), (0.006, 0.007)], 6, (0.050, width / 2 - 0.025, 0))
        part += turn(mirror(bolt), 1, k * np.pi / 3)
    return part


def wheel(width, radius=0.052):
    """Twin road wheel with guide groove, dished rim and hub cap."""
    w, r = width / 2, radius
    half = [
        (0.020, w - 0.001),
        (0.024, w - 0.018),
        (r - 0.014, w - 0.018),
        (r - 0.010, w - 0.004),
        (r, w - 0.006),
        (r, 0.012),
        (r - 0.016, 0.008),
    ]
    return lathe([(a, -b) for a, b in half] + [(a, b) for a, b in half[::-1]], 14)


def leg_beam(run, width):
    """Suspension beams: bevelled side plates between the two wheel rows, joined by a core."""
    e = 0.046
    profile = [
        (0.0, -e),
        (e, -0.02),
        (e, 0.02),
        (0.0, e),
        (-run, e),
        (-run - e, 0.02),
        (-run - e, -0.02),
        (-run, -e),
    ]
    side = plate(profile, width / 2 - 0.014, width / 2, 0.006)
    return mirror(side) + box((run, width - 0.04, 0.04), (-run / 2, 0, 0))


def build():
    """Mesh name -> part, for lower and upper legs."""
    parts = {}
    for name, size in (("lower", LOWER), ("upper", UPPER)):
        parts[f"belt_{name}"] = belt(**size)
        parts[f"band_{name}"] = band(**size)
        parts[f"pad_{name}"] = single_pad(size["width"])
        parts[f"sprocket_{name}"] = sprocket(size["width"])
        parts[f"wheel_{name}"] = wheel(size["width"])
        parts[f"beam_{name}"] = leg_beam(**size)
    return parts
