"""Writes the visual meshes of Hurcules, meshes/*.obj, from a few numbers each.

    python models/assets/make_meshes.py [FOLDER]

Metres, in the frame of the link that shows the mesh (x forward, y left, z up). The meshes are looks
only: contacts use the primitive geoms of the modules. numpy is the only need.
"""

import sys
from pathlib import Path

import arms
import lower_body
import running_gear
import upper_body
from solids import write


def build():
    """All meshes: name -> part."""
    parts = running_gear.build()
    for part in (*lower_body.PARTS, *upper_body.PARTS, *arms.PARTS):
        parts[part.__name__] = part()
    return parts


def main(folder):
    folder.mkdir(exist_ok=True)
    for name, part in build().items():
        points, triangles = write(folder / f"{name}.obj", part)
        print(f"{name:16} {points:6} vertices {triangles:6} triangles")


if __name__ == "__main__":
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).resolve().parent / "meshes")
