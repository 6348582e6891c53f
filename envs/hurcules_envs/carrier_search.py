"""Any robot with two hands behind a table: where the table stands, and what the arms can bear.

Nothing of this is known of a robot from a file. Its postures are drawn, as in `robots`, to see
where both hands come to; there the sides of a box are tried: its start and the corners of where it
may be wanted. Of the places and postures that reach them all without touching anything but the box,
the one is taken in which the motors bear the most.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import mjcf
from hurcules.validation import require_known
from hurcules_envs.carriers import BOARD, HANDS, PALMS, Carrier, Place, add_things, with_palms
from hurcules_envs.contact import resize_box
from hurcules_envs.robots import MAX_ACCELERATION, RobotSetup, load_robot
from hurcules_envs.rotations import rotation_vector

__all__ = ["Wanted", "load_carrier"]

Array = NDArray[np.float64]

SEED, SAMPLES = 20261126, 20000  # of the postures that tell where the hands come to
GRID, ABOUT = 0.1, 0.2  # [m] between places that are tried, and about a hand where samples count
FACING = 0.6  # cosine of a palm's direction and that to the middle
PLACES, STARTS = 48, 8  # places that are tried, and postures in each
ENOUGH = 24  # postures that reach everything, among which the best is taken
ENDS, LEVER, FREE = 0.15, 0.3, 0.2  # [rad] of the limits, [m], and of the Jacobian's least value
USED = 0.4  # of what motors give beside the arms' weight: motion and knocks want the rest
LEAST = 0.003  # of the loads of the manipulation robot: below, nothing is carried
MISS, TURN = 5e-3, 0.03  # [m], [rad] of a hand at a corner


@dataclass(frozen=True, eq=False)
class Wanted:
    """What a carrier's hands have to do, the table's top being the origin.

    Attributes:
        apart: [m] of the palms from the middle at the start, and their height over the table.
        half: [m] half of a box across while it is carried.
        corners: (c, 4) of its middle: x, y, z [m] and turn about z [rad].
        squeeze: [N] of the manipulation robot.
        weight: [N] the same.
        box: (3) [m] half sizes of the box that touches nothing on its way.
    """

    apart: tuple[float, float]
    half: float
    corners: Array
    squeeze: float
    weight: float
    box: tuple[float, float, float]


def load_carrier(
    robot: str | Path,
    frames: Sequence[str] | None,
    joints: Sequence[str] | None,
    palm: str,
    pads: bool,
    place: Sequence[float] | None,
    wanted: Wanted,
) -> Carrier:
    """Loads a robot from a file and finds where it carries.

    Args:
        robot: path of an MJCF file.
        frames: its left and its right hand, sites or bodies.
        joints: its coordinates; None: see hurcules.Robot.
        palm: axis of the frames that looks out of the palms: "x", "-z", ...
        pads: flat pads are put before the frames.
        place: (3) [m] middle of the table's top; None: it is looked for.
        wanted: of the hands.

    Raises:
        hurcules.Error: no such file or frames, one hand, hands that do not come to both sides of a
            box, or motors that hold nothing.
    """
    require_known("palm", palm, list(PALMS))
    setup = load_robot(robot, frames, joints)
    if len(setup.hands) != 2:
        raise hurcules.Error(
            f"robot {setup.name}: a box is carried between two hands: wanted frames=(left, right), "
            f"got {frames!r}"
        )
    others = {".mjb": "MuJoCo's binary", ".urdf": "a URDF"}
    if found := others.get(Path(setup.name).suffix):
        raise hurcules.Error(
            f"robot {setup.name}: wanted an MJCF file, to which table and box can be added, got "
            f"{found}"
        )
    at: Place | None = None
    if place is not None:
        try:
            x, y, z = np.asarray(place, dtype=np.float64).tolist()
        except (TypeError, ValueError):
            x = y = z = np.nan
        if not np.isfinite([x, y, z]).all():
            raise hurcules.Error(f"place: wanted x, y, z [m] of the table's top, got {place!r}")
        at = (x, y, z)
    return _best(setup, palm, pads, at, wanted)


class _Samples:
    """Postures drawn at random, and where the palms are in them."""

    def __init__(self, setup: RobotSetup, model: mujoco.MjModel) -> None:
        self._robot = robot = hurcules.Robot(model, list(setup.joints))
        lower = np.array([max(one.lower, -np.pi) for one in robot.coordinates])
        upper = np.array([min(one.upper, np.pi) for one in robot.coordinates])
        self._q = np.random.default_rng(SEED).uniform(lower, upper, (SAMPLES, robot.size))
        data, sites = mujoco.MjData(model), [model.site(hand).id for hand in HANDS]
        self._hands, looks = np.empty((2, SAMPLES, 3)), np.empty((2, SAMPLES))
        for i, q in enumerate(self._q):
            robot.set_configuration(q)
            data.qpos[:] = robot.qpos
            mujoco.mj_kinematics(model, data)
            self._hands[:, i] = data.site_xpos[sites]
            looks[:, i] = data.site_xmat[sites, 3]
        # the left palm looks to the right
        self._facing = [np.flatnonzero(looks[0] < -FACING), np.flatnonzero(looks[1] > FACING)]
        self.low, self.high = self._hands.min(axis=(0, 1)), self._hands.max(axis=(0, 1))
        self.middle = np.median(self._hands, axis=(0, 1))
        jacobian = np.vstack([robot.position_jacobian(HANDS[1]), robot.rotation_jacobian(HANDS[1])])
        other = np.vstack([robot.position_jacobian(HANDS[0]), robot.rotation_jacobian(HANDS[0])])
        self._right = np.abs(jacobian).max(axis=0) > 1e-9
        self._right &= np.abs(other).max(axis=0) < 1e-9

    def near(self, hand: int, at: Array) -> NDArray[np.int64]:
        """Postures in which a palm is about there, and looks to the middle; the nearest first."""
        facing = self._facing[hand]
        ways = self._hands[hand][facing] - at
        squares = np.einsum("ij,ij->i", ways, ways)
        close = np.flatnonzero(squares < ABOUT**2)
        return np.asarray(facing[close[np.argsort(squares[close], kind="stable")]])

    def together(self, place: Array, wanted: Wanted) -> list[Array]:
        """Postures of both arms, each (n,), to start from."""
        apart, height = wanted.apart
        left, right = (
            self.near(hand, place + np.array([0.0, side * apart, height]))[:STARTS]
            for hand, side in ((0, 1.0), (1, -1.0))
        )
        return [
            np.where(self._right, self._q[two], self._q[one])
            for one, two in zip(left, right, strict=False)
        ]


def _places(setup: RobotSetup, samples: _Samples, wanted: Wanted) -> Array:
    """(p, 3) [m] of the table's top where both hands come to the sides of a box, best first.

    Raises:
        hurcules.Error: there is none.
    """
    ahead, y, _ = samples.middle.tolist()
    low, high = samples.low, samples.high
    floor = (setup.model.geom_type == mujoco.mjtGeom.mjGEOM_PLANE).any()
    ends = wanted.corners[:, :3].min(axis=0), wanted.corners[:, :3].max(axis=0)
    counts, places = [], []
    for x, z in itertools.product(
        np.arange(low[0], high[0], GRID), np.arange(low[2], high[2], GRID)
    ):
        if floor and z < 2 * BOARD:
            continue
        count = min(
            len(samples.near(hand, np.array([x + end[0], y + side * wanted.apart[0], z + end[2]])))
            for end in ends
            for hand, side in ((0, 1.0), (1, -1.0))
        )
        counts.append(count if x > ahead else count / 4)
        places.append((x, y, z))
    order = np.argsort(-np.array(counts), kind="stable")
    best = [places[i] for i in order[:PLACES] if counts[i] > 0]
    if not best:
        raise _cannot(setup, f"no place {2 * wanted.apart[0]:.2f} m wide has a hand on either side")
    return np.array(best)


def _cannot(setup: RobotSetup, why: str) -> hurcules.Error:
    left, right = setup.hands
    return hurcules.Error(
        f"robot {setup.name}: wanted hands that come to both sides of a box, '{left}' on the left "
        f"(y), '{right}' on the right, palms towards each other; {why}"
    )


@lru_cache(maxsize=8)  # setups are kept by what their files hold
def _best(setup: RobotSetup, palm: str, pads: bool, at: Place | None, wanted: Wanted) -> Carrier:
    """The place and posture in which the motors bear the most.

    Raises:
        hurcules.Error: none reaches all corners, or the motors hold nothing.
    """
    best: Carrier | None = None
    found, most, worth = 0, 0, 0.0  # postures; poses that were reached; what the best is worth
    spec = mjcf.without_visuals(with_palms(setup, palm, pads))
    bare = mjcf.compile(spec)
    add_things(spec, (0.0, 0.0, 0.0))
    model = mjcf.compile(spec)
    model.opt.timestep = 0.02
    resize_box(model, "box", wanted.box)
    samples = _Samples(setup, bare)
    for place in _places(setup, samples, wanted) if at is None else np.array([at]):
        x, y, z = (float(value) for value in place)
        model.body("table").pos[:] = place
        for start in samples.together(place, wanted):
            q = _posture(setup, bare, place, wanted, start)
            if q is None:
                continue
            reached, share, room = _tour(setup, model, q, place, wanted)
            most = max(most, reached)
            if reached <= len(wanted.corners):
                continue
            found += 1
            if best is None or room * min(share, 1.0) > worth:
                worth = room * min(share, 1.0)
                best = Carrier(setup, palm, pads, (x, y, z), share, q)
        if found >= ENOUGH:
            break
    if best is None:
        raise _cannot(
            setup,
            f"{most} of {len(wanted.corners) + 1} poses of the box were "
            "reached without touching anything else",
        )
    if best.share < LEAST:
        raise hurcules.Error(
            f"robot {setup.name}: wanted motors that hold a box of "
            f"{LEAST * wanted.weight / 9.81:.2f} kg, {best.share * wanted.weight / 9.81:.3f} kg "
            "is what these hold"
        )
    share = min(best.share, 1.0)
    return Carrier(setup, palm, pads, best.place, share, best.configuration)


def _posture(
    setup: RobotSetup, model: mujoco.MjModel, place: Array, wanted: Wanted, start: Array
) -> Array | None:
    """(n,) palms at the start, towards each other; None: not found from this posture."""
    robot = hurcules.Robot(model, list(setup.joints))
    robot.set_configuration(start)
    tasks: list[hurcules.Task] = []
    apart, height = wanted.apart
    for hand, side in zip(HANDS, (1.0, -1.0), strict=True):
        reach = hurcules.PositionTask(hand, robot, hand)
        reach.set_target(place + np.array([0.0, side * apart, height]))
        look = hurcules.GazeTask(f"{hand} turn", robot, hand)
        look.set_target(place + np.array([0.0, -side * 100.0, height]))
        tasks += [reach, look]
    posture = hurcules.inverse_kinematics(
        robot, [_limits(setup, robot), tasks], starts=1, tolerance=1e-3
    )
    return posture.configuration if posture.reached else None


def _tour(
    setup: RobotSetup, model: mujoco.MjModel, q: Array, place: Array, wanted: Wanted
) -> tuple[int, float, float]:
    """How many poses are reached in turn, the least share of the loads borne there, the `_room`."""
    plan = hurcules.Robot(model, list(setup.joints))
    plan.set_configuration(q)
    places = [hurcules.PositionTask(hand, plan, hand) for hand in HANDS]
    turns = [hurcules.OrientationTask(f"{hand} turn", plan, hand) for hand in HANDS]
    first = [plan.orientation(hand) for hand in HANDS]
    channels = {task.name: hurcules.Target(task) for task in [*places, *turns]}
    controller = hurcules.WholeBodyController(
        plan, [_limits(setup, plan), [*places, *turns], hurcules.PostureTask("posture", plan)],
        channels, dt=0.02, torque_scaling=False,
        velocity=hurcules.VelocityControllerOptions(max_acceleration=MAX_ACCELERATION),
    )  # fmt: skip
    simulation = hurcules.Simulation(
        model=model, controller=controller, record=False, physics=False
    )
    data, robot = mujoco.MjData(model), hurcules.Robot(model, list(setup.joints))
    table, box = model.geom("table").id, model.geom("box").id
    adr = model.joint("box").qposadr[0]
    always, efforts = _touching(setup), np.array([one.max_effort for one in robot.coordinates])
    share, room, apart = np.inf, 1.0, wanted.half
    start = np.array([[0.0, 0.0, wanted.apart[1], 0.0]])
    for i, (x, y, z, yaw) in enumerate(np.concatenate([start, wanted.corners])):
        c, s = np.cos(yaw), np.sin(yaw)
        R = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
        middle = place + np.array([x, y, z])
        goals: dict[str, Array] = {}
        for side, reach, turn, at in zip((1.0, -1.0), places, turns, first, strict=True):
            goals[reach.name] = middle + R @ np.array([0.0, side * apart, 0.0])
            goals[turn.name] = rotation_vector(R @ at)
        simulation.step(150, goals)
        data.qpos[:] = simulation.data.qpos
        robot.set_qpos(data.qpos)
        for reach, at in zip(places, first, strict=True):
            hand = reach.name
            missed = np.linalg.norm(robot.position(hand) - goals[hand])
            turned = rotation_vector(R @ at @ robot.orientation(hand).T)
            if missed > MISS or np.linalg.norm(turned) > TURN:
                return i, 0.0, 0.0
        data.qpos[adr : adr + 7] = [*middle, np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2)]
        mujoco.mj_forward(model, data)
        if _contacts(model, data, table, box) - always:
            return i, 0.0, 0.0
        share, room = min(share, _bears(robot, efforts, wanted)), min(room, _room(robot))
    return len(wanted.corners) + 1, float(share), room


def _contacts(
    model: mujoco.MjModel, data: mujoco.MjData, table: int = -1, box: int = -1
) -> set[tuple[int, int]]:
    """Pairs of bodies that touch, welded ones as one; table and box by -1 and -2 less their ids."""
    pairs = set()
    for contact in data.contact:
        geoms = {int(contact.geom1), int(contact.geom2)}
        if contact.dist >= 0.0 or geoms == {table, box}:
            continue
        one, other = (
            -1 - geom if geom in (table, box) else int(model.body_weldid[model.geom_bodyid[geom]])
            for geom in geoms
        )
        if one != other:
            pairs.add((min(one, other), max(one, other)))
    return pairs


def _touching(setup: RobotSetup) -> set[tuple[int, int]]:
    """What touches where the robot stands at first: parts that do by construction."""
    data = mujoco.MjData(setup.model)
    data.qpos[:] = setup.robot().qpos
    mujoco.mj_forward(setup.model, data)
    return _contacts(setup.model, data)


def _limits(setup: RobotSetup, robot: hurcules.Robot) -> hurcules.JointLimits:
    """Limits that leave some room to the robot's own."""
    limits = setup.limits(robot)
    for one in robot.coordinates:
        room = min(ENDS, 0.1 * (one.upper - one.lower))
        if np.isfinite(room):
            limits.set_range(one.name, one.lower + room, one.upper - room)
    return limits


def _bears(robot: hurcules.Robot, efforts: Array, wanted: Wanted) -> float:
    """The share of the loads that the motors bear beside the arms' weight, in this posture."""
    weight = robot.inverse_dynamics(np.zeros(robot.size))
    load = np.zeros(robot.size)
    across = robot.position(HANDS[0]) - robot.position(HANDS[1])
    across /= np.linalg.norm(across)
    for hand, out in zip(HANDS, (across, -across), strict=True):
        force = wanted.squeeze * out - np.array([0.0, 0.0, 0.5 * wanted.weight])
        load -= robot.position_jacobian(hand).T @ force  # what the motors hold against it
    room = np.where(load > 0.0, efforts - weight, efforts + weight)
    shares = USED * np.maximum(room, 0.0)[load != 0.0] / np.abs(load[load != 0.0])
    return float(shares.min(initial=np.inf))


def _room(robot: hurcules.Robot) -> float:
    """How freely both hands move in this posture, 0 to 1: far from singular ones."""
    least = min(
        np.linalg.svd(
            np.vstack([robot.position_jacobian(hand), LEVER * robot.rotation_jacobian(hand)]),
            compute_uv=False,
        )[5]
        for hand in HANDS
    )
    return float(min(1.0, least / LEVER / FREE))
