"""Robots that installed packages ship, whatever of them is there, as `hurcules.Robot` with a hand.

Looked for: robosuite, gymnasium, gymnasium_robotics, dm_control, metaworld, and the URDF files of
example-robot-data. Nothing is installed or fetched; what is missing or does not load is left out.
"""

from __future__ import annotations

import contextlib
import importlib.util
import sys
import warnings
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

import hurcules

PACKAGES = {
    "robosuite": "models/assets/robots/*/robot.xml",
    "gymnasium": "envs/mujoco/assets/*.xml",
    "gymnasium_robotics": "envs/assets/**/*.xml",
    "dm_control": "suite/*.xml",
    "metaworld": "assets/sawyer_xyz/sawyer_reach*.xml",
}
URDF = "cmeel.prefix/share/example-robot-data/robots/**/*.urdf"
FREE = 1.5  # [rad] or [m], how far a joint without range goes to either side


@dataclass(frozen=True)
class Arm:
    """A robot and the body that most of its coordinates move."""

    name: str
    model: mujoco.MjModel
    hand: str

    def robot(self) -> hurcules.Robot:
        """A new robot at rest in its first posture, brought inside its limits."""
        robot = hurcules.Robot(self.model)
        lower, upper = ranges(robot)
        robot.set_configuration(np.clip(robot.configuration, lower, upper))
        return robot


def ranges(robot: hurcules.Robot) -> tuple[np.ndarray, np.ndarray]:
    """Where the postures are taken from: the limits, `FREE` about 0 where there are none."""
    limits = [
        (c.lower, c.upper) if np.isfinite(c.upper - c.lower) else (-FREE, FREE)
        for c in robot.coordinates
    ]
    lower, upper = np.array(limits).T
    return lower, upper


def places() -> Iterator[tuple[str, Path]]:
    """(package, file) of all models that are there."""
    for package, pattern in PACKAGES.items():
        spec = importlib.util.find_spec(package)
        if spec and spec.submodule_search_locations:
            for folder in spec.submodule_search_locations:
                yield from ((package, path) for path in sorted(Path(folder).glob(pattern)))
    for folder in map(Path, dict.fromkeys(sys.path)):
        yield from (("example_robot_data", path) for path in sorted(folder.glob(URDF)))


def hand_of(robot: hurcules.Robot, model: mujoco.MjModel) -> str:
    """The body that most coordinates move, the last of them."""
    best, name = 0, ""
    for body in range(1, model.nbody):
        frame = model.body(body).name
        if not frame:
            continue
        moved = int(
            (
                np.abs(robot.rotation_jacobian(frame)).sum(0)
                + np.abs(robot.position_jacobian(frame)).sum(0)
                > 1e-9
            ).sum()
        )
        if moved >= best:
            best, name = moved, frame
    return name if best > 1 else ""


def name_of(package: str, path: Path) -> str:
    """A short name of a model file."""
    stem = path.parent.name if path.stem == "robot" else path.stem
    if path.parent.name in ("hand", "fetch"):
        stem = f"{path.parent.name}_{stem}"
    return f"{package}/{stem}"


def load(name: str, path: Path) -> Arm:
    """Reads a model; its hand is '' where no frame is moved by two coordinates."""
    if path.suffix == ".urdf":
        model = hurcules.load_urdf(path, shapes=False)
    else:
        model = mujoco.MjModel.from_xml_path(str(path))
    return Arm(name, model, hand_of(hurcules.Robot(model), model))


def arms(wanted: str = "") -> Iterator[Arm]:
    """All that load, of which `wanted` is a part of the name."""
    return (arm for arm, _ in arms_and_files(wanted))


def arms_and_files(wanted: str = "") -> Iterator[tuple[Arm, Path]]:
    """The same, each with the file that it comes from."""
    for package, path in places():
        name = name_of(package, path)
        if wanted not in name:
            continue
        with contextlib.suppress(Exception), warnings.catch_warnings():
            warnings.simplefilter("ignore")
            arm = load(name, path)
            if arm.hand:
                yield arm, path
