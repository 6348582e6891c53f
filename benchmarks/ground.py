"""The robot on its tracks beside theory: creep on shut brakes, turns, where it tips over.

    python benchmarks/ground.py [--robot rescue] [--minutes 10]

Creep: how far the robot moves on shut brakes in that time, on the flat and on slopes.

Turns: its tracks stand on the corners of boxes. A continuous patch has the same outline, load and
centre of pressure a track, a pressure that is linear along it, and Coulomb's friction against the
slip of each of its points,

    F(x, y) = -mu p(x) s / |s|,    s = (vx - w y - u, vy + w x),

u the speed of its belt. With the belts' speeds as measured, the motion (vx, vy, w) that such
patches would settle at has no sum of forces and no moment. Given are the yaw rates of both and the
torque a side.

Tips: gravity turns by half a degree a second, friction 2, until the robot has turned by 3 degrees
on its tracks. Rigid: the angle at which the centre of mass is above the edge of the tracks.
"""

from __future__ import annotations

import argparse
import math
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import driving, scenes

Array = NDArray[np.float64]
BELT = 0.14  # [m] from the axles to the ground
SETTLE = 5.0  # [s]
SMALL = 1e-4  # [m/s] below which friction counts as proportional to slip


class Robot:
    """On some ground, every brake shut but those of the tracks when it drives."""

    def __init__(self, robot: str, pose: str, kind: str = "flat", **values: Any) -> None:
        model = scenes.load(kind, robot, **values)
        self.simulation = driving.simulation(model, model.key(pose).qpos)
        self.model, self.data = self.simulation.model, self.simulation.data
        self.drive = self.simulation.controller.drive
        self.run(SETTLE)

    def run(self, seconds: float) -> None:
        """Goes on for a time [s]."""
        self.simulation.step(round(seconds / self.simulation.dt))

    def loads(self) -> dict[str, list[tuple[float, float, float]]]:
        """Contacts of each track: forward and left of the root [m], normal force [N]."""
        root = self.data.body("upper_legs").xpos
        heading = math.atan2(*self.data.body("upper_legs").xmat.reshape(3, 3)[:2, 1] * (-1, 1))
        c, s = math.cos(heading), math.sin(heading)
        found: dict[str, list[tuple[float, float, float]]] = {}
        force = np.zeros(6)
        for i in range(self.data.ncon):
            contact = self.data.contact[i]
            if contact.efc_address < 0:
                continue
            names = [self.model.geom(geom).name for geom in contact.geom]
            track = next((name for name in names if "_run" in name or "_nose" in name), None)
            if track is None:
                continue
            mujoco.mj_contactForce(self.model, self.data, i, force)
            x, y = contact.pos[:2] - root[:2]
            side, leg = track.split("_")[:2]
            found.setdefault(f"{side}_{leg}", []).append((c * x + s * y, c * y - s * x, force[0]))
        return found


@dataclass
class Patch:
    """A track on the ground: points (n, 2) [m] and what each bears (n,) [N]; its side."""

    points: Array
    weight: Array
    left: bool


def patches(loads: dict[str, list[tuple[float, float, float]]]) -> list[Patch]:
    """Continuous patches of the same outline, load and centre of pressure."""
    made = []
    for name, contacts in loads.items():
        x, y, force = np.array(contacts).T
        if force.sum() < 1.0:
            continue
        centre = float(x @ force / force.sum())
        start, end = float(x.min()), float(x.max())
        grid = np.linspace(start, end, 401)
        middle, half = (start + end) / 2, (end - start) / 2
        slope = 3.0 * (centre - middle) / half**2  # of a pressure that is 1 in the middle
        pressure = np.maximum(0.0, 1.0 + slope * (grid - middle))
        across = np.linspace(float(y.min()), float(y.max()), 21)
        points = np.array([(a, b) for a in grid for b in across])
        weight = np.repeat(pressure / pressure.sum() / len(across) * force.sum(), len(across))
        made.append(Patch(points, weight, name.startswith("L")))
    return made


def forces(patch: Patch, motion: Array, belt: float, friction: float) -> Array:
    """On the robot: forward, left [N], moment about the root [N m]; motion (vx, vy, w)."""
    vx, vy, w = motion
    x, y = patch.points.T
    slip = np.array((vx - w * y - belt, vy + w * x))
    pull = -friction * patch.weight * slip / np.maximum(np.linalg.norm(slip, axis=0), SMALL)
    return np.array((pull[0].sum(), pull[1].sum(), (x * pull[1] - y * pull[0]).sum()))


def settled(tracks: list[Patch], belts: tuple[float, float], friction: float) -> Array:
    """The steady motion (vx, vy, w) on these patches; belts (right, left) [m/s]."""

    def total(motion: Array) -> Array:
        return np.sum([forces(p, motion, belts[p.left], friction) for p in tracks], axis=0)

    right, left = belts
    motion = np.array(((left + right) / 2, 0.0, (right - left) / 1.0))
    scale = np.array((1.0, 1.0, 0.3))
    for _ in range(200):
        value = total(motion)
        if np.abs(value * scale).max() < 1e-3:
            break
        jacobian = np.column_stack(
            [(total(motion + d) - total(motion - d)) / 2e-6 for d in np.eye(3) * 1e-6]
        )
        step = np.linalg.solve(jacobian, -value)
        share = 1.0
        while share > 1e-4 and np.linalg.norm(
            total(motion + share * step) * scale
        ) > np.linalg.norm(value * scale):
            share /= 2
        motion = motion + share * step
    return motion


def turn(name: str, pose: str, speed: float, yaw_rate: float) -> None:
    """Prints a turn beside that of continuous patches."""
    robot = Robot(name, pose)
    tracks = patches(robot.loads())
    robot.drive.drive(speed, yaw_rate)
    robot.run(4.0)
    rows = []
    for _ in range(500):
        robot.run(robot.simulation.dt)
        data = robot.data
        belts = [BELT * data.joint(f"{s}_lower_belt").qvel[0] for s in "RL"]
        torque = [data.actuator(f"{s}_drive").force[0] for s in "RL"]
        rate = data.body("upper_legs").xmat.reshape(3, 3)[2] @ data.qvel[3:6]
        rows.append((rate, *belts, *torque))
    rate, right, left, right_torque, left_torque = np.mean(rows, axis=0)
    model = robot.model
    friction = max(model.geom("floor").friction[0], model.geom("L_lower_run_1").friction[0])
    ideal = settled(tracks, (right, left), friction)
    wanted = [
        -BELT
        * sum(forces(p, ideal, (right, left)[p.left], friction)[0] for p in tracks if p.left == s)
        for s in (False, True)
    ]
    print(
        f"{pose}, {speed} m/s, {yaw_rate} rad/s: {rate:.3f} rad/s, patch {ideal[2]:.3f} "
        f"({rate / ideal[2]:.3f}); torque right, left {right_torque:.0f}, {left_torque:.0f} N m, "
        f"patch {-wanted[0]:.0f}, {-wanted[1]:.0f}",
        flush=True,
    )


def creep(name: str, minutes: int, degrees: float, direction: str) -> None:
    """Prints how far it moves on shut brakes."""
    slope = {"direction": direction, "angle": math.radians(degrees)} if degrees else {}
    robot = Robot(name, "drive", "slope" if degrees else "flat", **slope)
    start = robot.data.qpos[:3].copy()
    ways = []
    for _ in range(minutes):
        robot.run(60.0)
        ways.append(1e3 * float(np.linalg.norm(robot.data.qpos[:3] - start)))
    print(
        f"creep, {degrees:.0f} degrees {direction}: {ways[-1]:.2f} mm in {minutes} minutes, "
        f"{ways[0]:.2f} mm in the first",
        flush=True,
    )


def tip(name: str, pose: str, way: str) -> None:
    """Prints where it tips over as gravity turns."""
    robot = Robot(name, pose)
    model, data = robot.model, robot.data
    model.geom_friction[:, 0] = 2.0
    contacts = np.array([c for one in robot.loads().values() for c in one if c[2] > 1.0])
    root = data.body("upper_legs")
    centre = data.subtree_com[root.id]
    forward, left = centre[0] - root.xpos[0], centre[1] - root.xpos[1]
    edge = {
        "to the left": contacts[:, 1].max() - left,
        "forwards": contacts[:, 0].max() - forward,
        "backwards": forward - contacts[:, 0].min(),
    }[way]
    ahead = {"to the left": (0.0, 1.0), "forwards": (1.0, 0.0), "backwards": (-1.0, 0.0)}[way]
    before = root.xmat.reshape(3, 3).copy()
    degrees = 0.0
    while degrees < 80.0:
        degrees += 0.05
        side = 9.81 * math.sin(math.radians(degrees))
        model.opt.gravity[:] = (*(side * np.array(ahead)), -9.81 * math.cos(math.radians(degrees)))
        robot.run(0.1)
        turned = before.T @ root.xmat.reshape(3, 3)
        if math.degrees(math.acos(min(1.0, (np.trace(turned) - 1.0) / 2.0))) > 3.0:
            break
    print(
        f"{pose}, {way}: tips over at {degrees:.1f} degrees, rigid "
        f"{math.degrees(math.atan2(edge, centre[2])):.1f}",
        flush=True,
    )


def main() -> None:
    """Everything, one line each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--robot", choices=("rescue", "manipulation"), default="rescue")
    parser.add_argument("--minutes", type=int, default=10)
    arguments = parser.parse_args()
    print(hurcules.__version__, arguments.robot)
    for speed, yaw_rate, pose in ((0.0, 0.3, "drive"), (0.5, 0.25, "drive"), (0.0, 0.3, "ready")):
        turn(arguments.robot, pose, speed, yaw_rate)
    for pose in ("drive", "ready"):
        for way in ("to the left", "forwards", "backwards"):
            tip(arguments.robot, pose, way)
    for degrees, direction in ((0.0, "up"), (20.0, "across"), (20.0, "up"), (30.0, "up")):
        creep(arguments.robot, arguments.minutes, degrees, direction)


if __name__ == "__main__":
    main()
