"""Robots that reach: a model, its hands, and postures in which it touches nothing and stands.

Hurcules in both forms, or any MJCF robot with one or two frames named. Observations and actions of
the environments that take `robot=` are in task space only, so that they are the same for all.
"""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property, lru_cache
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules.output import compiled
from hurcules_envs.rotations import rotation_vector
from hurcules_envs.safety import STANDS, Safety, on_tracks

__all__ = ["MAX_ACCELERATION", "Postures", "RobotSetup", "load_robot", "sample_postures"]

Array = NDArray[np.float64]

POOL = 256  # postures that starts and goals are drawn from
POOL_SEED = 20261123
# [rad] how far postures are from the first one at most
NEAR = {"KN": 0.2, "HIP": 0.3, "WST": 0.5, "NKY": 0.0, "NKP": 0.0}
ARM = 1.0
# of a closed chain: steps from its first posture to one that is drawn, how far [m] its loops may
# open on the way, how far [rad or m] a joint may go in one: farther it jumps to another assembly
LEADS, OPEN, JUMP = 20, 1e-6, 0.3
# [rad/s^2] of all coordinates: these springs hardly swing, and weak motors do not saturate
MAX_ACCELERATION = 5.0


@dataclass(frozen=True, eq=False)
class RobotSetup:
    """A robot as it is simulated.

    Attributes:
        name: "rescue", "manipulation" or a path.
        model: robot and ground.
        hands: names of the frames that reach.
        joints: names of the coordinates.
        keyframe: where it stands at first, "" for the model's initial posture within its limits.
        support: body that it stands on, "" for a fixed base.
        ranges: by coordinate, narrower than the model's.
        drives: its tracks drive it.
    """

    name: str
    model: mujoco.MjModel
    hands: tuple[str, ...]
    joints: tuple[str, ...]
    keyframe: str
    support: str = ""
    ranges: dict[str, tuple[float, float]] = field(default_factory=dict)
    drives: bool = False

    def robot(self) -> hurcules.Robot:
        """A Robot at its keyframe, standing on its support; without one, within its limits."""
        robot = hurcules.Robot(self.model, list(self.joints))
        if self.keyframe:
            robot.set_keyframe(self.keyframe)
        else:
            lower = [one.lower for one in robot.coordinates]
            upper = [one.upper for one in robot.coordinates]
            robot.set_configuration(np.clip(robot.configuration, lower, upper))
        if self.support:
            robot.stand_on(self.support)
        return robot

    @cached_property
    def safety(self) -> Safety:
        """What comes after the limits: within its support, away from itself and the ground."""
        return Safety(self.name, self.model, self.robot(), self.support)

    def limits(self, robot: hurcules.Robot) -> hurcules.JointLimits:
        """The first level: the limits of the coordinates, within `ranges`."""
        limits = hurcules.JointLimits("limits", robot)
        for name, (lower, upper) in self.ranges.items():
            limits.set_range(name, lower, upper)
        return limits


@dataclass(frozen=True)
class Postures:
    """Postures without contact, standing safely.

    Attributes:
        qpos: (p, nq).
        hands: (p, h, 3) [m] where the hands are, in the world.
        turns: (p, h, 3) their rotation vectors.
    """

    qpos: Array
    hands: Array
    turns: Array


def load_robot(
    robot: str | Path, frames: Sequence[str] | None = None, joints: Sequence[str] | None = None
) -> RobotSetup:
    """Loads a robot by name or path.

    Args:
        robot: "rescue", "manipulation", or the path of a model (MJCF, a URDF, or MuJoCo's
            binary .mjb).
        frames: of a path: the frames of its hands, one or two.
        joints: of a path: its coordinates; None: see hurcules.Robot.

    Raises:
        hurcules.Error: an unknown name, no frames, or a frame that does not exist.
    """
    if not isinstance(robot, str | Path):
        known = ", ".join(hurcules.models.names())
        raise hurcules.Error(f"robot: wanted {known} or the path of a model, got {robot!r}")
    robot = str(robot)
    if robot in hurcules.models.names():
        if frames or joints:
            raise hurcules.Error(f"robot '{robot}' has hands and joints of its own")
        return _hurcules(robot)
    if not Path(robot).is_file():
        known = ", ".join(hurcules.models.names())
        raise hurcules.Error(
            f"robot: wanted {known} or the path of a model, got {robot!r}: no such file"
        )
    if not frames or not 1 <= len(frames) <= 2 or len(set(frames)) < len(frames):
        raise hurcules.Error(
            f"robot: {robot} wants frames=(...), --frame in a shell, the names of its one or two "
            f"hands, got {frames!r}"
        )
    readers = {".mjb": mujoco.MjModel.from_binary_path, ".urdf": hurcules.load_urdf}
    try:
        model = readers.get(Path(robot).suffix, mujoco.MjModel.from_xml_path)(robot)
    except ValueError as error:
        raise hurcules.Error(f"{robot}: {error}") from error
    own = None if joints is None else tuple(joints)
    return _from_file(robot, compiled(model), tuple(frames), own)


@lru_cache(maxsize=8)  # by what the file holds now, not by its path alone
def _from_file(
    robot: str, content: bytes, frames: tuple[str, ...], joints: tuple[str, ...] | None
) -> RobotSetup:
    model = mujoco.MjModel.from_binary_path("robot.mjb", {"robot.mjb": content})
    own = hurcules.Robot(model, None if joints is None else list(joints))
    for frame in frames:
        own.position(frame)
    return RobotSetup(robot, model, frames, tuple(own.coordinate_names), "")


@lru_cache(maxsize=8)
def _hurcules(name: str) -> RobotSetup:
    model = hurcules.models.load(name, "flat", bed=name != "rescue", visuals=False)
    robot = hurcules.Robot(model)
    ranges = hurcules.mode_ranges("rescue_ready_without_bed")
    return RobotSetup(
        name,
        model,
        ("L_tcp", "R_tcp"),
        tuple(robot.coordinate_names),
        "ready",
        support="lower_leg_L",
        ranges=ranges if name == "rescue" else {},
        drives=True,
    )


@lru_cache(maxsize=8)
def sample_postures(setup: RobotSetup, least: float = 0.25) -> Postures:
    """Postures to start from and to reach, always the same for one robot.

    Args:
        setup: the robot, from `load_robot`.
        least: [m] of a hand over the ground, where there is one.

    Raises:
        hurcules.Error: not enough of them are found.
    """
    generator = np.random.default_rng(POOL_SEED)
    robot, data = setup.robot(), mujoco.MjData(setup.model)
    apart = setup.safety.apart()
    data.qpos[:] = robot.qpos
    ground = (setup.model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE).any()
    always = _touching(setup, data)  # parts that touch by construction
    start, first = robot.qpos, robot.configuration
    lower, upper = _ranges(setup, robot, first)
    qpos, hands, turns = [], [], []
    for _ in range(200 * POOL):
        drawn = _within_balls(robot, generator.uniform(lower, upper))
        if not robot.followers:
            robot.set_configuration(drawn)
        elif not _lead(setup, robot, data, start, drawn):
            continue
        places = [robot.position(frame) for frame in setup.hands]
        if ground and min(place[2] for place in places) < least:
            continue
        data.qpos[:] = robot.qpos
        if _touching(setup, data) - always or not _stands(setup, data, robot):
            continue
        apart.update(robot)
        if (apart.error < apart.lower).any():
            continue
        qpos.append(robot.qpos.copy())
        hands.append(places)
        turns.append([rotation_vector(robot.orientation(frame)) for frame in setup.hands])
        if len(qpos) == POOL:
            return Postures(np.array(qpos), np.array(hands), np.array(turns))
    raise hurcules.Error(
        f"robot {setup.name}: only {len(qpos)} of {POOL} postures without contact were found in "
        f"{200 * POOL} trials"
    )


def _within_balls(robot: hurcules.Robot, q: NDArray[np.float64]) -> NDArray[np.float64]:
    """The same with ball joints turned no further than their ranges, (n,)."""
    for i, coordinate in enumerate(robot.coordinates):
        if coordinate.joints[0].part == 3:
            angle = float(np.linalg.norm(q[i : i + 3]))
            q[i : i + 3] *= min(1.0, coordinate.upper / angle) if angle > 0.0 else 1.0
    return q


def _lead(
    setup: RobotSetup, robot: hurcules.Robot, data: mujoco.MjData, start: Array, q: Array
) -> bool:
    """From where it starts to a configuration, step by step; whether its loops stay closed."""
    robot.set_qpos(start)
    here = robot.configuration
    for share in np.linspace(0.0, 1.0, LEADS + 1)[1:]:
        before = robot.qpos
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", "the loops that")  # asked below
            robot.set_configuration(here + share * (q - here))
        data.qpos[:] = robot.qpos
        mujoco.mj_kinematics(setup.model, data)
        mujoco.mj_comPos(setup.model, data)
        mujoco.mj_makeConstraint(setup.model, data)
        gap = np.abs(data.efc_pos[: data.ne]).max(initial=0.0)
        if gap > OPEN or np.abs(data.qpos - before).max() > JUMP:
            return False
    return True


def _ranges(setup: RobotSetup, robot: hurcules.Robot, first: Array) -> tuple[Array, Array]:
    """Between which angles a posture is drawn: about the first one, legs and trunk nearest."""
    lower, upper = [], []
    for coordinate, value in zip(robot.coordinates, first, strict=True):
        low, high = setup.ranges.get(coordinate.name, (coordinate.lower, coordinate.upper))
        low, high = max(low, -np.pi, coordinate.lower), min(high, np.pi, coordinate.upper)
        margin = 0.05 * (high - low)
        low, high = low + margin, high - margin
        reach = NEAR.get(coordinate.name, ARM) if setup.drives else ARM
        value = min(max(value, low), high)
        low, high = max(low, value - reach), min(high, value + reach)
        lower.append(low)
        upper.append(max(low, high))
    return np.array(lower), np.array(upper)


def _touching(setup: RobotSetup, data: mujoco.MjData) -> set[tuple[int, int]]:
    """Pairs of bodies that touch at `data.qpos`, but for tracks and what is fixed to each other."""
    model = setup.model
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mujoco.mj_collision(model, data)
    hit = (data.contact.dist < 0.0) & ~_on_tracks(setup, data)
    welds = model.body_weldid[model.geom_bodyid[data.contact.geom[hit]]]
    return {(int(one), int(other)) for one, other in welds if one != other}


def _stands(setup: RobotSetup, data: mujoco.MjData, robot: hurcules.Robot) -> bool:
    """It stands within its tracks, if it has any; after `_touching`."""
    feet = data.contact.pos[_on_tracks(setup, data), :2]
    if not len(feet):
        return True
    low, high = feet.min(axis=0) + STANDS, feet.max(axis=0) - STANDS
    com = robot.com[:2]
    return bool((com > low).all() and (com < high).all())


def _on_tracks(setup: RobotSetup, data: mujoco.MjData) -> NDArray[np.bool_]:
    """(contacts) whether a track takes part."""
    return np.asarray(setup.drives & on_tracks(setup.model, data))
