"""Building blocks for simple meshes: bevelled plates, hulls, solids of revolution, and a writer.

A part is a list of polygons, a polygon an (n, 3) array of points, counterclockwise from outside.
Metres; x forward, y left, z up.
"""

from pathlib import Path

import numpy as np

CREASE = np.cos(np.radians(35.0))  # sharper edges stay sharp in the shading


def loft(rings):
    """Closed skin through rings of equally many points, counterclockwise seen from the last."""
    rings = [np.asarray(r, float) for r in rings]
    part = []
    for low, high in zip(rings, rings[1:]):
        for i in range(len(low)):
            j = (i + 1) % len(low)
            part.append(np.array([low[i], low[j], high[j], high[i]]))
    return part + fan(rings[0][::-1]) + fan(rings[-1])


def fan(ring):
    """Cap of a star-shaped ring."""
    centre = ring.mean(axis=0)
    return [np.array([centre, a, b]) for a, b in zip(ring, np.roll(ring, -1, axis=0))]


def octagon(z, depth, width, cut, x=0.0):
    """Ring in the plane z: rectangle depth (x) by width (y), corners cut, centred at x."""
    a, b = depth / 2, width / 2
    c = min(cut, 0.49 * depth, 0.49 * width)
    points = [
        (a, -b + c),
        (a, b - c),
        (a - c, b),
        (c - a, b),
        (-a, b - c),
        (-a, c - b),
        (c - a, -b),
        (a - c, -b),
    ]
    return np.array([(x + p, q, z) for p, q in points])


def inset(profile, amount):
    """Convex profile (counterclockwise, (n, 2)) with every edge moved inwards."""
    p = np.asarray(profile, float)
    edge = np.roll(p, -1, axis=0) - p
    normal = np.c_[-edge[:, 1], edge[:, 0]] / np.linalg.norm(edge, axis=1, keepdims=True)
    level = np.sum(normal * p, axis=1) + amount
    out = [
        np.linalg.solve([normal[i - 1], normal[i]], [level[i - 1], level[i]]) for i in range(len(p))
    ]
    return np.array(out)


def plate(profile, y0, y1, bevel=0.004):
    """Convex profile in (x, z) extruded from y0 to y1 with bevelled edges."""
    p = np.asarray(profile, float)
    area = np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))
    p = p if area > 0 else p[::-1]
    small = inset(p, bevel)
    # counterclockwise in (x, z) is seen from -y, so the stack runs from +y to -y
    stack = [(small, y1), (p, y1 - bevel), (p, y0 + bevel), (small, y0)]
    return loft([np.c_[q[:, 0], np.full(len(q), y), q[:, 1]] for q, y in stack])


def panel(profile, x0, x1, bevel=0.006):
    """Convex profile in (y, z) extruded from x0 to x1; only the face at x1 is bevelled."""
    p = np.asarray(profile, float)
    area = np.sum(p[:, 0] * np.roll(p[:, 1], -1) - p[:, 1] * np.roll(p[:, 0], -1))
    p = p if area > 0 else p[::-1]
    stack = [(p, x0), (p, x1 - bevel * np.sign(x1 - x0)), (inset(p, bevel), x1)]
    part = loft([np.c_[np.full(len(q), x), q] for q, x in stack])
    return part if x1 > x0 else [polygon[::-1] for polygon in part]


def arc(r0, r1, start, end, y0, y1, n=10):
    """Bent plate about the y axis between two radii; angles from +x towards +z."""
    rings = []
    for a in np.linspace(start, end, n):
        c, s = np.cos(a), np.sin(a)
        rings.append(
            [(r0 * c, y0, r0 * s), (r1 * c, y0, r1 * s), (r1 * c, y1, r1 * s), (r0 * c, y1, r0 * s)]
        )
    return loft(rings)


def lathe(profile, n=32, centre=(0, 0, 0), axis="y"):
    """Solid of revolution; profile = (radius, position along the axis), position rising."""
    angle = np.arange(n) * 2 * np.pi / n
    rings = []
    for r, h in profile:
        u, v, w = r * np.cos(angle), r * np.sin(angle), np.full(n, h)
        rings.append({"z": np.c_[u, v, w], "y": np.c_[v, w, u], "x": np.c_[w, u, v]}[axis])
    return move(loft(rings), centre)


def box(size, centre=(0, 0, 0), bevel=0.004):
    """Bevelled box."""
    x, y, z = size
    b = bevel
    rings = [
        octagon(-z / 2, x - 2 * b, y - 2 * b, b),
        octagon(b - z / 2, x, y, b),
        octagon(z / 2 - b, x, y, b),
        octagon(z / 2, x - 2 * b, y - 2 * b, b),
    ]
    return move(loft(rings), centre)


def move(part, by):
    return [polygon + np.asarray(by, float) for polygon in part]


def turn(part, axis, angle):
    """Rotation about a coordinate axis (0, 1, 2)."""
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    r = np.eye(3)
    r[i, i] = r[j, j] = np.cos(angle)
    r[j, i], r[i, j] = np.sin(angle), -np.sin(angle)
    return [polygon @ r.T for polygon in part]


def mirror(part):
    """The part and its mirror image in y."""
    return part + [polygon[::-1] * [1, -1, 1] for polygon in part]


def shell(rows, cut=0.03):
    """Bevelled hull through rows (z, depth in x, width in y, x of the centre)."""
    return loft([octagon(z, d, w, cut, x) for z, d, w, x in rows])


def normals(polygons):
    """Unit normal of every polygon and, per corner, the smoothed one within the crease angle."""
    flat = [np.cross(p, np.roll(p, -1, axis=0)).sum(axis=0) for p in polygons]  # Newell
    flat = [n / max(np.linalg.norm(n), 1e-12) for n in flat]
    at = {}
    for i, p in enumerate(polygons):
        for v in p:
            at.setdefault(tuple(np.round(v, 5)), []).append(i)
    for i, p in enumerate(polygons):
        corner = []
        for v in p:
            near = [flat[j] for j in at[tuple(np.round(v, 5))] if flat[j] @ flat[i] > CREASE]
            n = np.sum(near, axis=0) if near else flat[i]
            corner.append(n / max(np.linalg.norm(n), 1e-12))
        yield corner


def write(file, part):
    """Wavefront file with one vertex per distinct (point, normal); returns the two counts."""
    triangles, index, points, directions = [], {}, [], []
    for polygon, corner in zip(part, normals(part)):
        keys = []
        for v, n in zip(polygon, corner):
            key = (tuple(np.round(v, 4) + 0.0), tuple(np.round(n, 2) + 0.0))
            if key not in index:
                index[key] = len(index) + 1
                points.append(key[0])
                directions.append(key[1])
            keys.append(index[key])
        triangles += [(keys[0], keys[i], keys[i + 1]) for i in range(1, len(keys) - 1)]
    triangles = [t for t in triangles if len({points[i - 1] for i in t}) == 3]
    lines = ["v %g %g %g" % p for p in points] + ["vn %g %g %g" % n for n in directions]
    lines += ["f " + " ".join(f"{i}//{i}" for i in t) for t in triangles]
    Path(file).write_text("\n".join(lines) + "\n")
    return len(points), len(triangles)
