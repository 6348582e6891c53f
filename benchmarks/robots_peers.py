"""Any robot, beside its peers: the robots of robots.py led by Hurcules, mink, pink and placo.

Run:  python benchmarks/robots_peers.py [--peers mink pink] [--seeds 2] [--only panda] [--out FILE]

Same robots, first postures and targets as robots.py, 5 s of 5 ms, in one process and in turn. Each
library gets the hand, in 6-D from six coordinates on, and the posture a thousand times lighter
(a level below, for Hurcules), the limits of position and speed that Hurcules has, the latter
3 rad/s or m/s at most, and else its defaults. Only robots whose joints are all led: the peers would
move what is held or coupled. pink and placo read URDF files alone; joints without end turn by up to
100 rad there. A peer that does not load a robot, or puts its hand elsewhere at the first posture,
has no row for it. Accelerations are no limit of the peers, so that `change` is told apart from
`over a limit`.
"""

from __future__ import annotations

import argparse
import contextlib
import json
import tempfile
import time
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from arms import Arm, arms_and_files
from arrival import posture
from robots import MISS, MOVES, SECONDS, TURN, angle

import hurcules
from hurcules import JointLimits, OrientationTask, PositionTask, PostureTask, Stack, StackLevel

DT, LIGHT, NEAR = 5e-3, 1e-3, 1e-6  # [s], weight of the posture, [m]
TURNS, SPEED = 100.0, 3.0  # [rad]; [rad/s] or [m/s]


def limits_of(robot: hurcules.Robot) -> JointLimits:
    """The limits, with one of speed for joints that have none."""
    limits = JointLimits("limits", robot)
    for name, speed in zip(robot.coordinate_names, limits.max_velocity, strict=True):
        limits.set_max_velocity(name, min(speed, SPEED))
    return limits


class Robot:
    """What a peer is told.

    Args:
        arm: the model, of which all joints are led.
        path: its file.
    """

    def __init__(self, arm: Arm, path: Path) -> None:
        self.arm, self.path, self.robot = arm, path, arm.robot()
        ids = [c.joints[0].joint for c in self.robot.coordinates]
        self.names = [arm.model.joint(i).name for i in ids]
        self.order = np.array([arm.model.joint(name).qposadr[0] for name in self.names])
        self.limits = limits_of(self.robot)
        self.start, self.spatial = self.robot.configuration, self.robot.size >= 6

    def urdf(self) -> str:
        """Without shapes and without joints that turn for ever."""
        if self.path.suffix != ".urdf":
            raise ValueError("no URDF")
        root = ET.parse(self.path).getroot()
        for link in root.iter("link"):
            for shape in [*link.findall("visual"), *link.findall("collision")]:
                link.remove(shape)
        for joint in root.iter("joint"):
            if joint.get("type") == "continuous":
                joint.set("type", "revolute")
                limit = joint.find("limit")
                limit = ET.SubElement(joint, "limit") if limit is None else limit
                given = {"velocity": "100", "effort": "1", **limit.attrib}
                limit.attrib = {**given, "lower": f"{-TURNS}", "upper": f"{TURNS}"}
        return ET.tostring(root, encoding="unicode")

    def pose(self, q: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """R (3, 3), p (3,) [m] of the hand at a posture (n,)."""
        self.robot.set_configuration(q)
        place = self.robot.position(self.arm.hand).copy()
        return self.robot.orientation(self.arm.hand).copy(), place

    def ends(self) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper limits, finite."""
        return np.maximum(self.limits.lower, -TURNS), np.minimum(self.limits.upper, TURNS)


class Hurcules:
    """`limits < hand < posture`, all else by default."""

    def __init__(self, told: Robot) -> None:
        self.robot, hand = told.arm.robot(), told.arm.hand
        self.place = PositionTask("hand", self.robot, hand)
        self.turn = OrientationTask("turn", self.robot, hand)
        level = StackLevel("hand", [self.place, self.turn] if told.spatial else [self.place])
        options = hurcules.VelocityControllerOptions(dt=DT)
        self.controller = hurcules.VelocityController(self.robot, options)
        limits, rest = limits_of(self.robot), PostureTask("posture", self.robot)
        self.controller.set_stack(Stack([limits, level, rest]))

    @property
    def q(self) -> np.ndarray:
        """The coordinates, (n,)."""
        return self.robot.configuration

    def aim(self, rotation: np.ndarray, place: np.ndarray) -> None:
        """Where the hand shall be."""
        self.place.set_target(place)
        self.turn.set_target(rotation)

    def tick(self) -> None:
        """Moves the robot by one DT."""
        self.controller.step(self.robot)


class Mink:
    """One weighted quadratic program, daqp."""

    def __init__(self, told: Robot) -> None:
        import mink

        self.mink, model, self.order = mink, told.arm.model, told.order
        self.configuration = mink.Configuration(model)
        q = model.qpos0.copy()
        q[told.order] = told.start
        self.configuration.update(q)
        cost = 1.0 if told.spatial else 0.0
        self.hand = mink.FrameTask(told.arm.hand, "body", position_cost=1.0, orientation_cost=cost)
        rest = mink.PostureTask(model, cost=LIGHT)
        rest.set_target_from_configuration(self.configuration)
        self.tasks = [self.hand, rest]
        speeds = dict(zip(told.names, told.limits.max_velocity, strict=True))
        self.limits = [mink.ConfigurationLimit(model), mink.VelocityLimit(model, speeds)]

    @property
    def q(self) -> np.ndarray:
        """See Hurcules."""
        return self.configuration.q[self.order].copy()

    def aim(self, rotation: np.ndarray, place: np.ndarray) -> None:
        """See Hurcules."""
        turn = self.mink.SO3.from_matrix(rotation)
        self.hand.set_target(self.mink.SE3.from_rotation_and_translation(turn, place))

    def tick(self) -> None:
        """See Hurcules."""
        velocity = self.mink.solve_ik(
            self.configuration, self.tasks, DT, "daqp", damping=1e-9, limits=self.limits
        )
        self.configuration.integrate_inplace(velocity, DT)


class Pink:
    """One weighted quadratic program, daqp."""

    def __init__(self, told: Robot) -> None:
        import pink
        import pinocchio

        self.pink, self.pinocchio = pink, pinocchio
        model = pinocchio.buildModelFromXML(told.urdf())
        ids = [model.joints[model.getJointId(name)] for name in told.names]
        self.order, q = np.array([joint.idx_q for joint in ids]), pinocchio.neutral(model)
        v = np.array([joint.idx_v for joint in ids])
        q[self.order] = told.start
        for name, values in zip(("lower", "upper"), told.ends(), strict=True):
            bound = getattr(model, f"{name}PositionLimit").copy()
            bound[self.order] = values
            setattr(model, f"{name}PositionLimit", bound)
        speed = model.velocityLimit.copy()
        speed[v] = told.limits.max_velocity
        model.velocityLimit = speed
        self.configuration = pink.Configuration(model, model.createData(), q)
        cost = 1.0 if told.spatial else 0.0
        self.hand = pink.tasks.FrameTask(told.arm.hand, position_cost=1.0, orientation_cost=cost)
        rest = pink.tasks.PostureTask(cost=LIGHT)
        rest.set_target_from_configuration(self.configuration)
        self.tasks = [self.hand, rest]

    @property
    def q(self) -> np.ndarray:
        """See Hurcules."""
        return self.configuration.q[self.order].copy()

    def aim(self, rotation: np.ndarray, place: np.ndarray) -> None:
        """See Hurcules."""
        self.hand.set_target(self.pinocchio.SE3(rotation, place))

    def tick(self) -> None:
        """See Hurcules."""
        velocity = self.pink.solve_ik(self.configuration, self.tasks, DT, solver="daqp")
        self.configuration.integrate_inplace(velocity, DT)


class Placo:
    """One weighted quadratic program in C++."""

    def __init__(self, told: Robot) -> None:
        import placo

        with tempfile.TemporaryDirectory() as folder:
            Path(folder, "robot.urdf").write_text(told.urdf())
            self.robot = placo.RobotWrapper(folder, placo.Flags.ignore_collisions)
        self.names = told.names
        lower, upper = told.ends()
        values = zip(told.names, told.start, lower, upper, told.limits.max_velocity, strict=True)
        for name, q, least, most, speed in values:
            self.robot.set_joint(name, q)
            self.robot.set_joint_limits(name, least, most)
            self.robot.set_velocity_limit(name, speed)
        self.robot.update_kinematics()
        self.solver = placo.KinematicsSolver(self.robot)
        self.solver.mask_fbase(True)
        self.solver.dt = DT
        self.solver.enable_joint_limits(True)
        self.solver.enable_velocity_limits(True)
        pose = self.robot.get_T_world_frame(told.arm.hand)
        self.spatial, self.pose = told.spatial, np.eye(4)
        if told.spatial:
            self.hand = self.solver.add_frame_task(told.arm.hand, pose)
            self.hand.configure("hand", "soft", 1.0, 1.0)
        else:
            self.hand = self.solver.add_position_task(told.arm.hand, pose[:3, 3])
            self.hand.configure("hand", "soft", 1.0)
        rest = self.solver.add_joints_task()
        rest.set_joints(dict(zip(told.names, told.start, strict=True)))
        rest.configure("posture", "soft", LIGHT**2)  # its weights are not squared

    @property
    def q(self) -> np.ndarray:
        """See Hurcules."""
        return np.array([self.robot.get_joint(name) for name in self.names])

    def aim(self, rotation: np.ndarray, place: np.ndarray) -> None:
        """See Hurcules."""
        self.pose[:3, :3], self.pose[:3, 3] = rotation, place
        if self.spatial:
            self.hand.T_world_frame = self.pose
        else:
            self.hand.target_world = place

    def tick(self) -> None:
        """See Hurcules."""
        self.solver.solve(True)
        self.robot.update_kinematics()


PEERS = {"hurcules": Hurcules, "mink": Mink, "pink": Pink, "placo": Placo}


def reach(told: Robot, kind: type, seed: int, way: float) -> dict[str, float] | None:
    """What a peer does with a target; None where it puts the hand elsewhere."""
    goal = told.pose(posture(told.arm.robot(), seed, way))
    peer = kind(told)
    if np.abs(peer.q - told.start).max() > NEAR:
        return None
    peer.aim(*goal)
    ticks, allowed = round(SECONDS / DT), hurcules.VelocityControllerOptions().max_acceleration * DT
    way_of, fastest, failed = [peer.q], np.inf, 0
    for _ in range(ticks):
        begin = time.thread_time()
        try:
            peer.tick()
        except Exception:
            failed += 1
        fastest = min(fastest, time.thread_time() - begin)
        way_of.append(peer.q)
    q = np.array(way_of)
    speed = np.diff(q, axis=0, prepend=q[:1]) / DT
    over = np.maximum(q - told.limits.upper, told.limits.lower - q).max()
    rotation, place = told.pose(q[-1])
    return {
        "mm": 1e3 * float(np.linalg.norm(place - goal[1])),
        "deg": angle(rotation, goal[0]) if told.spatial else 0.0,
        "speed": float(np.abs(speed[-round(0.1 / DT) :]).max()),
        "excess": max(0.0, float(over), float((np.abs(speed) - told.limits.max_velocity).max())),
        "change": float(np.abs(np.diff(speed, axis=0)).max() / allowed),
        "tick": fastest,
        "failed": failed,
    }


def agrees(told: Robot, kind: type) -> bool:
    """Whether the peer, aimed at where the hand is, leaves it there."""
    peer = kind(told)
    peer.aim(*told.pose(told.start))
    peer.tick()
    return bool(np.abs(peer.q - told.start).max() < NEAR)


def subjects(wanted: str) -> Iterator[Robot]:
    """The robots whose joints are all led."""
    for arm, path in arms_and_files(wanted):
        with contextlib.suppress(Exception):
            if arm.robot().size == arm.model.nv:
                yield Robot(arm, path)


def line(name: str, rows: list[dict[str, float]]) -> str:
    """What all targets of a peer come to, in Markdown."""
    arrived = [row["mm"] < MISS and row["deg"] < TURN for row in rows]
    millimetres, changes = (np.array([row[key] for row in rows]) for key in ("mm", "change"))
    return (
        f"| {name} | {len(rows)} | {sum(arrived)} ({100 * np.mean(arrived):.0f} %) "
        f"| {np.median(millimetres):.3f}, {millimetres.max():.0f} "
        f"| {sum(row['speed'] < MOVES for row in rows)} "
        f"| {max(row['excess'] for row in rows):.1e} | {np.median(changes):.1f}, "
        f"{changes.max():.0f} | {1e6 * np.median([row['tick'] for row in rows]):.0f} "
        f"| {sum(row['failed'] for row in rows):.0f} |"
    )


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--peers", nargs="+", default=list(PEERS), choices=PEERS)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--way", type=float, default=0.3)
    parser.add_argument("--only", default="", help="part of a name")
    parser.add_argument("--out", type=Path, help="a JSON file")
    options = parser.parse_args()
    rows: list[dict[str, object]] = []
    for told in subjects(options.only):
        for peer in options.peers:
            try:
                if not agrees(told, PEERS[peer]):
                    raise ValueError("puts the hand elsewhere")
                for seed in range(options.seeds):
                    row = reach(told, PEERS[peer], seed, options.way)
                    rows.append({"robot": told.arm.name, "peer": peer, "seed": seed, **(row or {})})
            except Exception as error:  # whatever a library has against a robot
                rows.append({"robot": told.arm.name, "peer": peer, "refused": str(error)[:80]})
            print(
                *(f"{v:.3g}" if isinstance(v, float) else v for v in rows[-1].values()), flush=True
            )
        if options.out:
            options.out.write_text(json.dumps(rows, indent=1) + "\n")
    titles = ["", "targets", "arrive", "error, median, worst [mm]", "rest", "over a limit"]
    titles += ["change of velocity / allowed, median, worst", "tick [us]", "failed ticks"]
    led = {p: {r["robot"] for r in rows if r["peer"] == p and "mm" in r} for p in options.peers}
    groups = {
        "all that each loads": [r for r in rows if "mm" in r],
        "those that all load": [
            r for r in rows if "mm" in r and all(r["robot"] in names for names in led.values())
        ],
    }
    for title, group in groups.items():
        print(f"\n{title}\n| " + " | ".join(titles) + " |", "|---" * len(titles) + "|", sep="\n")
        for peer in options.peers:
            mine = [r for r in group if r["peer"] == peer]
            if mine:
                print(line(peer, mine))


if __name__ == "__main__":
    main()
