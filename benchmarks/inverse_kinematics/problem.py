"""The problem that every peer gets: a G1 humanoid on a base that slides and turns, two hands.

The robot is the URDF that the package example-robot-data carries (Unitree G1, 29 joints), read from
where it is installed: legs fixed, no meshes, and below the pelvis a slide along x and a turn about
z. That leaves n = 19: base 2, waist 3, arms 14. Needs numpy alone.
"""

from __future__ import annotations

import importlib.util
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass
from pathlib import Path

import numpy as np

DT = 5e-3  # [s]
HANDS = ("right_rubber_hand", "left_rubber_hand")  # the more important one first
BASE = {"base_slide": (-2.0, 2.0, 1.0), "base_turn": (-3.0, 3.0, 2.0)}  # lower, upper, speed
ARM = {"shoulder_pitch": 0.2, "shoulder_roll": 0.25, "elbow": 0.9}  # [rad], roll outward
SCENARIOS = {
    "moving": "both hands follow poses that they can reach",
    "left_far": "the right hand can reach its place, the left one's lies 1 m beyond its arm",
    "both_far": "both lie 1 m and more beyond the arms",
}

Pose = tuple[np.ndarray, np.ndarray]  # R (3, 3), p (3,) [m] in the world


@dataclass(frozen=True)
class Joint:
    """One of the 19."""

    name: str
    lower: float  # [rad] or [m]
    upper: float
    speed: float  # [rad/s] or [m/s]
    start: float


def robot_description() -> tuple[str, list[Joint]]:
    """Returns the URDF as text, and its joints in the order of the text.

    Raises:
        FileNotFoundError: example-robot-data is not installed.
    """
    root = ElementTree.parse(_installed_urdf()).getroot()
    for link in root.findall("link"):
        for part in (*link.findall("visual"), *link.findall("collision")):
            link.remove(part)
    for joint in root.findall("joint"):
        name = joint.get("name", "")
        if any(part in name for part in ("hip", "knee", "ankle")):
            joint.set("type", "fixed")
    for child in list(root):
        if child.tag in ("mujoco", "material"):
            root.remove(child)
    _put_on_base(root)
    return ElementTree.tostring(root, encoding="unicode"), [
        _joint(joint) for joint in root.findall("joint") if joint.get("type") != "fixed"
    ]


def targets(scenario: str, start: dict[str, Pose], seconds: float) -> dict[str, Pose]:
    """Where the hands shall be at a time [s], from where they start."""
    wanted = {}
    for hand, (rotation, place) in start.items():
        side = 1.0 if hand == HANDS[0] else -1.0
        if scenario == "moving":
            phase = 2.0 * seconds
            step = [0.05 * np.sin(phase), 0.04 * np.sin(phase + side), 0.04 * (1 - np.cos(phase))]
            turn = _turn([0.2 * np.sin(phase), 0.0, 0.2 * np.sin(phase) * side])
        else:
            far = scenario == "both_far" or hand == HANDS[1]
            # the base slides 2 m: beyond what base and arm reach together
            step = [3.6, -0.3 * side, 0.3] if far else [0.1, 0.05 * side, 0.1]
            turn = np.eye(3)
        wanted[hand] = (turn @ rotation, place + np.array(step))
    return wanted


def _installed_urdf() -> Path:
    spec = importlib.util.find_spec("cmeel")
    places = list(spec.submodule_search_locations or []) if spec else []
    data = "share/example-robot-data/robots/g1_description/urdf/g1_29dof_rev_1_0.urdf"
    for place in places:
        path = Path(place).parent / "cmeel.prefix" / data
        if path.is_file():
            return path
    raise FileNotFoundError(f"wanted {data} of the package example-robot-data, it is not installed")


def _put_on_base(root: ElementTree.Element) -> None:
    """World, slide, turn, pelvis instead of a floating pelvis."""
    for joint in root.findall("joint"):
        child = joint.find("child")
        if joint.get("type") == "floating" or (child is not None and child.get("link") == "pelvis"):
            root.remove(joint)
    links = ["world", "base_carriage", "pelvis"]
    for link in root.findall("link"):
        if link.get("name") == "world":
            root.remove(link)
    root.append(ElementTree.Element("link", name="world"))
    carriage = ElementTree.SubElement(root, "link", name="base_carriage")
    inertial = ElementTree.SubElement(carriage, "inertial")
    ElementTree.SubElement(inertial, "mass", value="1")
    moments = {"ixx": "0.01", "iyy": "0.01", "izz": "0.01", "ixy": "0", "ixz": "0", "iyz": "0"}
    ElementTree.SubElement(inertial, "inertia", moments)
    kinds = (("base_slide", "prismatic", "1 0 0"), ("base_turn", "revolute", "0 0 1"))
    for i, (name, kind, axis) in enumerate(kinds):
        lower, upper, speed = BASE[name]
        joint = ElementTree.Element("joint", name=name, type=kind)
        root.insert(i, joint)  # first in the order of joints, as in the tree
        ElementTree.SubElement(joint, "origin", xyz="0 0 0", rpy="0 0 0")
        ElementTree.SubElement(joint, "parent", link=links[i])
        ElementTree.SubElement(joint, "child", link=links[i + 1])
        ElementTree.SubElement(joint, "axis", xyz=axis)
        numbers = {"lower": lower, "upper": upper, "velocity": speed, "effort": 1000.0}
        ElementTree.SubElement(joint, "limit", {k: str(v) for k, v in numbers.items()})


def _joint(joint: ElementTree.Element) -> Joint:
    name, limit = joint.get("name", ""), joint.find("limit")
    assert limit is not None, name
    numbers = [float(limit.get(key, "nan")) for key in ("lower", "upper", "velocity")]
    start = next((angle for part, angle in ARM.items() if part in name), 0.0)
    if name.startswith("right") and "roll" in name:
        start = -start
    return Joint(name, *numbers, start)


def _turn(vector: list[float]) -> np.ndarray:
    """Rotation (3, 3) by a rotation vector [rad]."""
    angle = float(np.linalg.norm(vector))
    if angle == 0.0:
        return np.eye(3)
    x, y, z = np.asarray(vector) / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
