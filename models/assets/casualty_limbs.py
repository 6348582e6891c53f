"""Arms and legs of a casualty; side +1 left, -1 right. Metres and radians."""

import math
import xml.etree.ElementTree as ElementTree

from casualty_parts import capsule, hinge, inertial, numbers

__all__ = ["add_arm", "add_leg"]

FOOT_PITCH = 0.45  # [rad] a limp foot points forward and down


def add_leg(pelvis, figure, side):
    """Thigh, shank and foot."""
    s, g, letter = figure.scale, figure.girth, "L" if side > 0 else "R"
    length, radius = figure.person.length("thigh"), 0.07 * g
    x = figure.flush(radius)
    thigh = figure.body(pelvis, f"{letter}_thigh", (x, side * 0.09 * s, 0), (side * 0.07, 0, 0))
    hinge(figure, thigh, f"{letter}_hip_flexion", "limp_large", (0, -1, 0), (-0.3, 2.0))
    hinge(figure, thigh, f"{letter}_hip_abduction", "limp_large", (side, 0, 0), (-0.15, 0.7))
    hinge(figure, thigh, f"{letter}_hip_turn", "limp_large", (0, 0, side), (-0.6, 0.7))
    inertial(thigh, figure, "thigh")
    ends = (0, 0, -0.02 * s), (0, 0, -0.93 * length)
    capsule(thigh, f"{letter}_thigh", radius, ends[0], "trousers", ends[1])
    figure.watch(thigh, f"{letter}_thigh")
    add_shank(thigh, figure, letter, x, length)


def add_shank(thigh, figure, letter, x, thigh_length):
    """Lower leg, and the foot on it; `x` is where the thigh's axis lies in the pelvis frame."""
    s, g = figure.scale, figure.girth
    length, radius = figure.person.length("shank"), 0.052 * g
    axis = figure.flush(radius) - x  # of the calf, in the frame of the shank
    shank = figure.body(thigh, f"{letter}_shank", (0, 0, -thigh_length))
    hinge(figure, shank, f"{letter}_knee", "limp_large", (0, 1, 0), (-0.02, 2.3))
    inertial(shank, figure, "shank", at=(axis / 2, 0, -figure.person.centre("shank")))
    ends = (axis, 0, -0.03 * s), (axis, 0, -0.86 * length)
    capsule(shank, f"{letter}_shank", radius, ends[0], "trousers", ends[1])
    band = (axis, 0, -0.20 * s), (axis, 0, -0.22 * s)
    capsule(shank, None, 0.054 * g, band[0], "band", band[1], cloth=True)
    figure.watch(shank, f"{letter}_shank")
    add_foot(shank, figure, letter, x, length)


def add_foot(shank, figure, letter, x, shank_length):
    """A boot of two capsules, heel and sole, that both touch the plane of the back."""
    s = figure.scale
    heel = 0.045 * s, (-0.005 * s, 0, 0.06 * s), (-0.005 * s, 0, -0.035 * s)
    sole = 0.036 * s, (-0.010 * s, 0, -0.045 * s), (0.14 * s, 0, -0.048 * s)
    ankle = figure.flush(0) + max(depth(*heel), depth(*sole))
    place = (ankle - x, 0, 0.010 * s - shank_length)
    foot = figure.body(shank, f"{letter}_foot", place, (0, FOOT_PITCH, 0))
    hinge(figure, foot, f"{letter}_ankle", "limp_small", (0, -1, 0), (-0.6, 0.7))
    person, (across, up, along) = figure.person, figure.person.inertia("foot")
    centre = (person.centre("foot") - 0.065 * s, 0, -0.045 * s)  # the heel lies behind the ankle
    mass = f"{person.segment_mass('foot'):.6g}"
    tensor = f"{along:.5g} {across:.5g} {up:.5g}"
    ElementTree.SubElement(foot, "inertial", pos=numbers(centre), mass=mass, diaginertia=tensor)
    for name, (radius, end, other) in (("heel", heel), ("sole", sole)):
        capsule(foot, f"{letter}_{name}", radius, end, "boot", other)
    figure.watch(foot, f"{letter}_foot")


def depth(radius, *ends):
    """How far a capsule of the pitched foot reaches behind the ankle [m]."""
    sine, cosine = math.sin(FOOT_PITCH), math.cos(FOOT_PITCH)
    return radius - min(x * cosine + z * sine for x, _, z in ends)


def add_arm(thorax, figure, side):
    """Upper arm, forearm and hand."""
    s, g, letter = figure.scale, figure.girth, "L" if side > 0 else "R"
    length, radius = figure.person.length("upper_arm"), 0.045 * g
    x = figure.flush(radius)
    shoulder = (x, side * (0.155 * s + 0.045 * g), 0.127 * s)
    arm = figure.body(thorax, f"{letter}_upper_arm", shoulder, (side * 0.2, 0, 0))
    hinge(figure, arm, f"{letter}_shoulder_flexion", "limp_large", (0, -1, 0), (-0.6, 2.6))
    hinge(figure, arm, f"{letter}_shoulder_abduction", "limp_large", (side, 0, 0), (-0.2, 1.6))
    hinge(figure, arm, f"{letter}_shoulder_turn", "limp_large", (0, 0, side), (-0.8, 0.8))
    inertial(arm, figure, "upper_arm")
    capsule(arm, f"{letter}_upper_arm", radius, (0, 0, 0), "jacket", (0, 0, -length))
    band = (0, 0, -0.15 * s), (0, 0, -0.17 * s)
    capsule(arm, None, 0.047 * g, band[0], "band", band[1], cloth=True)
    figure.watch(arm, f"{letter}_upper_arm")
    add_forearm(arm, figure, letter, x, length)


def add_forearm(arm, figure, letter, x, upper_length):
    """Forearm and hand; `x` is where the upper arm's axis lies in the pelvis frame."""
    s, g = figure.scale, figure.girth
    length, radius = figure.person.length("forearm"), 0.038 * g
    forearm = figure.body(arm, f"{letter}_forearm", (0, 0, -upper_length))
    hinge(figure, forearm, f"{letter}_elbow", "limp_small", (0, -1, 0), (-0.02, 2.4))
    inertial(forearm, figure, "forearm")
    axis = figure.flush(radius) - x
    ends = (axis, 0, -0.02 * s), (axis, 0, -0.94 * length)
    capsule(forearm, f"{letter}_forearm", radius, ends[0], "jacket", ends[1])
    figure.watch(forearm, f"{letter}_forearm")

    hand = figure.body(forearm, f"{letter}_hand", (0, 0, -length))
    hinge(figure, hand, f"{letter}_wrist", "limp_small", (0, -1, 0), (-1.0, 1.0))
    thick, reach = 0.024 * s, figure.person.length("hand") / 2
    axis = figure.flush(thick) - x
    inertial(hand, figure, "hand", at=(axis, 0, -figure.person.centre("hand")))
    size = (thick, 0.045 * s, reach)
    figure.ellipsoid(hand, f"{letter}_hand", size, (axis, 0, -0.9 * reach), "glove")
    figure.watch(hand, f"{letter}_hand")
