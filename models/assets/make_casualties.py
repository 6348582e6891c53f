"""Writes the limp persons, models/objects/casualty_*kg.xml, from anthropometry.py.

    python models/assets/make_casualties.py [FOLDER]

Lengths follow the stature, thickness follows mass and stature; the shapes of the reference person
(75 kg, 1.75 m) are numbers of this file and casualty_limbs.py.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

from anthropometry import Person
from casualty_limbs import add_arm, add_leg
from casualty_parts import Figure, add_header, add_sensors, capsule, hinge, inertial, region

__all__ = ["PERSONS", "text"]

PERSONS = [Person(50, 1.60), Person(75, 1.75), Person(90, 1.80), Person(120, 1.85)]

HEADER = """<!-- Limp adult, {mass:g} kg and {stature:.2f} m, clothed, with {joints} joints, free.
     Written by assets/make_casualties.py; the sources of its numbers stand in anthropometry.py.
     Segment frames in standing posture: x to the front, y left, z up; the pelvis frame lies between
     the hip joints. At zero the body is straight and its back touches the plane x = {back:.4f}: on
     flat ground this posture is at rest. A region of the body that is not a whole segment is a body
     without joints (skull, face, neck, chest, upper_back, belly, lower_back); sensors force_REGION
     add up the normal forces of all contacts [N]. -->
"""


def text(person):
    """The MJCF of a person.

    Args:
        person: mass [kg] and stature [m].
    """
    root = ElementTree.Element("mujoco", model=f"casualty_{person.mass:g}kg")
    add_header(root)
    figure = Figure(person)
    add_trunk(ElementTree.SubElement(root, "worldbody"), figure)
    add_sensors(root, figure)
    ElementTree.indent(root)
    header = HEADER.format(
        mass=person.mass, stature=person.stature, joints=figure.joints, back=-figure.half_depth
    )
    return header + ElementTree.tostring(root, encoding="unicode") + "\n"


def add_trunk(world, figure):
    """Pelvis, then legs, then what stands on it."""
    s, g = figure.scale, figure.girth
    pelvis = ElementTree.SubElement(world, "body", name="pelvis")
    ElementTree.SubElement(pelvis, "freejoint", name="root")
    inertial(pelvis, figure, "pelvis", up=True)
    # on the ground beside the right hip: where lower arms go under a person on the back
    figure.site(pelvis, "near_side", (0.03 - figure.half_depth, -0.25 * s, 0.05 * s))
    half, radius = 0.065 * s, 0.105 * g
    capsule(pelvis, "hips", radius, (figure.flush(radius), half, 0.04 * s), "trousers", mirror=True)
    belt = figure.flush(radius) + 0.001
    capsule(pelvis, None, 0.104 * g, (belt, half, 0.115 * s), "boot", mirror=True, cloth=True)
    figure.watch(pelvis, "pelvis")
    for side in (1, -1):
        add_leg(pelvis, figure, side)
    add_abdomen(pelvis, figure)


def add_abdomen(pelvis, figure):
    """Middle trunk: belly in front, lower back behind, hollow by 2 cm above the pelvis."""
    s, g = figure.scale, figure.girth
    abdomen = figure.body(pelvis, "abdomen", (0, 0, figure.person.length("pelvis")))
    hinge(figure, abdomen, "lumbar_flexion", "limp_large", (0, 1, 0), (-0.35, 1.0))
    hinge(figure, abdomen, "lumbar_bending", "limp_large", (1, 0, 0), (-0.5, 0.5))
    inertial(abdomen, figure, "abdomen", up=True)
    radius, half = 0.078 * g, 0.085 * s
    front = -figure.flush(radius)
    belly, back = region(figure, abdomen, "belly"), region(figure, abdomen, "lower_back")
    for level, hollow in ((0.05, 0.02), (0.165, 0.0)):
        z = level * s
        capsule(belly, f"belly_{level:g}", radius, (front - hollow, half, z), "jacket", mirror=True)
        behind = (figure.flush(radius) + hollow, half, z)
        capsule(back, f"lower_back_{level:g}", radius, behind, "jacket", mirror=True)
    band = (0.004, 0.06 * s, 0.115 * s)
    capsule(abdomen, None, 0.104 * g, band, "band", mirror=True, cloth=True)
    add_thorax(abdomen, figure)


def add_thorax(abdomen, figure):
    """Upper trunk: chest in front, back and shoulders behind."""
    s, g = figure.scale, figure.girth
    thorax = figure.body(abdomen, "thorax", (0, 0, figure.person.length("abdomen")))
    hinge(figure, thorax, "thorax_flexion", "limp_large", (0, 1, 0), (-0.3, 0.6))
    inertial(thorax, figure, "thorax", up=True)
    figure.site(thorax, "chest", (figure.half_depth, 0, 0.04 * s))
    chest, back = region(figure, thorax, "chest"), region(figure, thorax, "upper_back")
    radius, half, z = 0.082 * g, 0.10 * s, 0.045 * s
    front, behind = -figure.flush(radius), figure.flush(radius)
    capsule(chest, "ribs_front", radius, (front, half, z), "jacket", mirror=True)
    capsule(back, "ribs_back", radius, (behind, half, z), "jacket", mirror=True)
    blade, top = figure.flush(0.075 * g) + 0.005, (0.13 * s, 0.115 * s)
    capsule(back, "shoulders", 0.075 * g, (blade, *top), "jacket", mirror=True)
    add_head(thorax, figure)
    for side in (1, -1):
        add_arm(thorax, figure, side)


def add_head(thorax, figure):
    """Head and neck with three joints; the helmet's back lies in the plane of the back."""
    s, person = figure.scale, figure.person
    x = -0.02 * figure.girth
    head = figure.body(thorax, "head", (x, 0, person.length("thorax")))
    hinge(figure, head, "neck_flexion", "limp_neck", (0, 1, 0), (-0.7, 0.7))
    hinge(figure, head, "neck_bending", "limp_neck", (1, 0, 0), (-0.6, 0.6))
    hinge(figure, head, "neck_turn", "limp_neck", (0, 0, 1), (-1.2, 1.2))
    centre = figure.flush(0.11 * s) - x  # of the helmet
    z = person.head_height - person.centre("head")
    inertial(head, figure, "head", at=(centre, 0, z))
    figure.site(head, "head_centre", (centre, 0, z))
    neck = region(figure, head, "neck")
    throat = f"0 0 {0.01 * s:.4g} {centre / 2:.4g} 0 {0.09 * s:.4g}"
    ElementTree.SubElement(
        neck, "geom", {"name": "neck", "class": "flesh", "type": "capsule",
                       "size": f"{0.05 * s:.4g}", "fromto": throat, "material": "skin"}
    )  # fmt: skip
    shapes = {
        "face": ((0.092, 0.074, 0.118), (centre + 0.015 * s, 0, 0.158 * s), "skin"),
        "skull": ((0.110, 0.095, 0.100), (centre, 0, 0.200 * s), "helmet"),
    }
    for name, (size, at, material) in shapes.items():
        part = region(figure, head, name)
        figure.ellipsoid(part, name, [k * s for k in size], at, material)


def main(folder):
    """Writes every person."""
    for person in PERSONS:
        file = folder / f"casualty_{person.mass:g}kg.xml"
        file.write_text(text(person), encoding="utf-8")
        print(f"{file.name}  {person.stature:.2f} m")


if __name__ == "__main__":
    objects = Path(__file__).resolve().parents[1] / "objects"
    main(Path(sys.argv[1]) if len(sys.argv) > 1 else objects)
