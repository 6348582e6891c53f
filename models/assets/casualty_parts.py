"""Parts that every piece of a casualty is made of: frames, joints, geoms, regions, sensors.

A region is a body whose contacts are added up by one sensor. Metres, kilograms, radians.
"""

import xml.etree.ElementTree as ElementTree

__all__ = [
    "Figure",
    "add_header",
    "add_sensors",
    "capsule",
    "hinge",
    "inertial",
    "numbers",
    "region",
]

DEFAULTS = """
<default>
  <geom mass="0"/>
  <default class="flesh">
    <!-- Cloth on ground and on metal: its friction wins over the partner's (priority). -->
    <geom contype="8" conaffinity="7" friction="0.45 0.01 0.001" condim="4" priority="1"
          solref="0.02 1" solimp="0.9 0.95 0.004"/>
  </default>
  <default class="cloth">
    <geom contype="0" conaffinity="0" group="2"/>
  </default>
  <!-- Without muscles: damping [N m s/rad] and friction [N m] are assumptions. -->
  <default class="limp_large">
    <joint damping="2" frictionloss="1.5" armature="0.01"/>
  </default>
  <default class="limp_small">
    <joint damping="0.3" frictionloss="0.8" armature="0.005"/>
  </default>
  <default class="limp_neck">
    <joint damping="0.5" frictionloss="0.5" armature="0.005"/>
  </default>
</default>"""

LOOKS = """
<asset>
  <material name="jacket" rgba="0.16 0.24 0.40 1" specular="0.05" shininess="0.1"/>
  <material name="trousers" rgba="0.25 0.25 0.27 1" specular="0.05" shininess="0.1"/>
  <material name="band" rgba="0.85 0.90 0.45 1" specular="0.6" shininess="0.6"/>
  <material name="boot" rgba="0.10 0.08 0.07 1" specular="0.2" shininess="0.3"/>
  <material name="glove" rgba="0.30 0.22 0.15 1" specular="0.05" shininess="0.1"/>
  <material name="skin" rgba="0.80 0.60 0.48 1" specular="0.1" shininess="0.2"/>
  <material name="helmet" rgba="0.88 0.88 0.85 1" specular="0.5" shininess="0.6"/>
</asset>"""

NECK = ("neck_flexion", "neck_bending", "neck_turn")
REACH = 0.6  # [m] a sphere of this radius holds all of any region


class Figure:
    """A person's sizes, and what its pieces have told while they were made."""

    def __init__(self, person):
        self.person, self.scale, self.girth = person, person.scale, person.girth
        self.half_depth = 0.11 * self.girth  # [m] of the trunk
        self.joints = 0
        self.regions = []

    def flush(self, radius):
        """Where a round part of this radius has its axis when it lies in the plane of the back."""
        return radius - self.half_depth

    def body(self, parent, name, pos, euler=None):
        """A child body at `pos` [m]."""
        attributes = {"name": name, "pos": numbers(pos)}
        if euler:
            attributes["euler"] = numbers(euler)
        return ElementTree.SubElement(parent, "body", attributes)

    def site(self, parent, name, pos):
        """A named point that others aim at or measure."""
        ElementTree.SubElement(
            parent, "site", name=name, pos=numbers(pos), size="0.015", group="4", rgba="1 0.4 0 1"
        )

    def watch(self, body, name):
        """Lets a sensor add up the contacts of this body."""
        self.regions.append(name)
        ElementTree.SubElement(
            body, "site", name=f"region_{name}", size=str(REACH), group="5", rgba="1 0 0 0"
        )

    def ellipsoid(self, parent, name, size, pos, material):
        """A contact geom."""
        ElementTree.SubElement(
            parent, "geom", {"name": name, "class": "flesh", "type": "ellipsoid",
                             "size": numbers(size), "pos": numbers(pos), "material": material}
        )  # fmt: skip


def numbers(values):
    """As MJCF writes them: a tenth of a millimetre."""
    return " ".join(f"{round(value, 4) + 0.0:.6g}" for value in values)


def region(figure, segment, name):
    """A part of a segment that is measured on its own: a body without joints."""
    body = ElementTree.SubElement(segment, "body", name=name)
    figure.watch(body, name)
    return body


def hinge(figure, body, name, kind, axis, span):
    """A limp joint of a class, with its range [rad]."""
    figure.joints += 1
    ElementTree.SubElement(
        body, "joint", {"name": name, "class": kind, "axis": numbers(axis), "range": numbers(span)}
    )


def inertial(body, figure, segment, up=False, at=None):
    """Mass, centre and inertia of a segment that hangs down (or, trunk, stands up) along z."""
    person = figure.person
    length = person.length(segment) if up else 0.0
    pos = at or (0, 0, length - person.centre(segment))
    tensor = " ".join(f"{value:.5g}" for value in person.inertia(segment))
    mass = f"{person.segment_mass(segment):.6g}"
    ElementTree.SubElement(body, "inertial", pos=numbers(pos), mass=mass, diaginertia=tensor)


def capsule(body, name, radius, end, material, other=None, mirror=False, cloth=False):
    """A capsule from `end` to `other`, or to the mirror image of `end` in y."""
    other = (end[0], -end[1], end[2]) if mirror else other
    attributes = {"class": "cloth" if cloth else "flesh", "type": "capsule"}
    if name:
        attributes = {"name": name, **attributes}
    attributes |= {"size": numbers([radius]), "fromto": numbers([*end, *other])}
    ElementTree.SubElement(body, "geom", attributes | {"material": material})


def add_header(root):
    """Options, default classes and looks."""
    ElementTree.SubElement(root, "include", file="../common/options.xml")
    parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
    root.append(ElementTree.fromstring(DEFAULTS, parser))
    root.append(ElementTree.fromstring(LOOKS))


def add_sensors(root, figure):
    """Head acceleration and rate, neck angles, contact forces by region."""
    sensors = ElementTree.SubElement(root, "sensor")
    for kind, name in (("accelerometer", "head_acceleration"), ("gyro", "head_rate")):
        ElementTree.SubElement(sensors, kind, name=name, site="head_centre")
    for joint in NECK:
        ElementTree.SubElement(sensors, "jointpos", name=joint, joint=joint)
    for name in figure.regions:
        ElementTree.SubElement(sensors, "touch", name=f"force_{name}", site=f"region_{name}")
