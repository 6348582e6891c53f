"""Legged robots that stand by torques, and are pushed: a table of those of example-robot-data.

Run:  python benchmarks/standing.py [--only go2] [--pushes]

Each URDF is loaded by `hurcules.load_urdf(floating=True)` and stands in the posture that its SRDF
calls standing or half sitting (`OWN` where it has none), 0.1 rad inside its limits. Bodies whose
lowest point is within 10 mm of the floor are its feet. The stack is `contacts < height < centre of
mass + root's orientation < hand < posture`; the hand is the body that most joints move.

After 3 s it is led by 0.1 m in a second. Then the root is pushed for 0.1 s along +x, -x, +y, -y:
told is the largest impulse of 0.1, 0.2, ... 0.5 m/s by mass after which it stands again.
Told too: how far the feet slid in the reach, error of the hand, torque as a share of the limits,
processor time of a tick (simulation and controller). Packages: see arms.py.
"""

from __future__ import annotations

import argparse
import time
import warnings
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from arms import places
from numpy.typing import NDArray

import hurcules

NEAR = 0.01  # [m] of a foot from the floor
INSIDE = 0.1  # [rad] or [m] of its limits a joint begins: some postures lie outside
REACH = 0.1  # [m] in a second
SPEEDS = (0.1, 0.2, 0.3, 0.4, 0.5)  # [m/s] of the whole robot after a push
DIRECTIONS = {"+x": (1, 0, 0), "-x": (-1, 0, 0), "+y": (0, 1, 0), "-y": (0, -1, 0)}
STATES = ("standing", "half_sitting", "half_sitting_open_hands")
BENT = {"hip_pitch": -0.35, "knee": 0.7, "ankle_pitch": -0.35, "elbow": 0.6}  # [rad]
OWN = {
    "g1_29dof_rev_1_0": {f"{s}_{j}_joint": a for s in ("left", "right") for j, a in BENT.items()}
}
GAINS = hurcules.AccelerationControllerOptions(stiffness=25, damping=10, max_acceleration=200)

Vector = NDArray[np.float64]


def posture_of(model: mujoco.MjModel, path: Path) -> Vector | None:
    """The standing posture of a robot's SRDF, on the floor; None without one."""
    states: dict[str, dict[str, float]] = {}
    for file in sorted(path.parent.parent.glob("srdf/*.srdf")):
        for state in ET.parse(file).getroot().iter("group_state"):
            values = {j.get("name", ""): j.get("value", "0").split() for j in state.iter("joint")}
            named = states.setdefault(state.get("name", ""), {})
            named.update({name: float(v[0]) for name, v in values.items() if len(v) == 1})
    found = OWN.get(path.stem) or next((states[name] for name in STATES if name in states), None)
    if not found:
        return None
    qpos = model.qpos0.copy()
    for name, value in found.items():
        joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        if joint >= 0:
            qpos[model.jnt_qposadr[joint]] = value
    for joint in np.flatnonzero(model.jnt_limited):
        lower, upper = model.jnt_range[joint] + [INSIDE, -INSIDE]
        if lower < upper:
            place = model.jnt_qposadr[joint]
            qpos[place] = np.clip(qpos[place], lower, upper)
    return hurcules.on_floor(model, qpos)


def feet_of(robot: hurcules.Robot, model: mujoco.MjModel) -> list[str]:
    """Bodies that touch the floor."""
    feet = []
    for body in range(2, model.nbody):
        name = model.body(body).name
        try:
            points = hurcules.sole_points(robot, name)
        except hurcules.Error:
            continue
        own = model.body_weldid[body] == body
        low = min((robot.position(name) + robot.orientation(name) @ p)[2] for p in points)
        if own and low < NEAR:
            feet.append(name)
    return feet


def hand_of(robot: hurcules.Robot, model: mujoco.MjModel, feet: list[str]) -> str | None:
    """The body that most joints move, three or more, none of a leg; the furthest from the feet."""
    middle = np.mean([robot.position(foot) for foot in feet], axis=0)
    best, name = (2, 0.0), None
    for body in range(2, model.nbody):
        frame = model.body(body).name
        moved = np.flatnonzero(np.abs(robot.position_jacobian(frame)[:, 6:]).max(axis=0) > 1e-9)
        away = float(np.linalg.norm(robot.position(frame) - middle))
        leg = any(np.abs(robot.position_jacobian(f)[:, 6 + moved]).max(initial=0) for f in feet)
        if not leg and (moved.size, away) > best and moved.size > 2:
            best, name = (moved.size, away), frame
    return name


@dataclass
class Tasks:
    """contacts < height < centre of mass + root's orientation < hand < posture."""

    robot: hurcules.Robot
    feet: list[hurcules.ContactTask]
    levels: list[Any]
    hand: hurcules.PositionTask | None
    frame: str | None

    @property
    def names(self) -> list[str]:
        """Bodies that are its feet."""
        return [foot.name for foot in self.feet]


def tasks_of(model: mujoco.MjModel, qpos: Vector) -> Tasks:
    """The tasks of a robot in a posture, its centre of mass over the middle of its feet."""
    robot = hurcules.Robot(model, floating=True)
    robot.set_qpos(qpos)
    names = feet_of(robot, model)
    feet = [hurcules.ContactTask(foot, robot, foot) for foot in names]
    level, up = np.eye(3)[:2], np.eye(3)[2:]
    height = hurcules.CenterOfMassTask("height", robot, axes=up)
    com = hurcules.CenterOfMassTask("centre of mass", robot, axes=level)
    soles = [
        robot.position(foot)
        + robot.orientation(foot) @ hurcules.sole_points(robot, foot).mean(axis=0)
        for foot in names
    ]
    middle = np.mean(soles, axis=0)
    com.set_target(middle[:2])
    trunk = hurcules.OrientationTask("root", robot, model.body(1).name)
    posture = hurcules.PostureTask("posture", robot)
    levels: list[Any] = [feet, height, [com, trunk], posture]
    frame, hand = hand_of(robot, model, names), None
    if frame:
        hand = hurcules.PositionTask("hand", robot, frame)
        levels.insert(3, hand)
    return Tasks(robot, feet, levels, hand, frame)


@dataclass
class Standing:
    """A robot that stands, with its loop."""

    simulation: hurcules.Simulation
    feet: list[str]
    hand: str | None


def standing(model: mujoco.MjModel, qpos: Vector) -> Standing:
    """The loop of a robot in a posture."""
    tasks = tasks_of(model, qpos)
    channels = {"hand": hurcules.Twist(tasks.hand, 0.3)} if tasks.hand else {}
    controller = hurcules.WholeBodyController(
        tasks.robot, tasks.levels, channels, control="torque", torque=GAINS
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    return Standing(simulation, tasks.names, tasks.frame)


def stands(data: mujoco.MjData, before: Vector) -> bool:
    """Whether a robot is at rest within 0.1 m of where its root was, (3,)."""
    still = np.abs(data.qvel).max() < 0.05
    return bool(still and np.linalg.norm(data.qpos[:3] - before) < 0.1)


def pushed(loop: Standing, state: Vector, impulse: Vector) -> bool:
    """Whether the robot stands again, 4 s after a push [N s]."""
    simulation = loop.simulation
    simulation.restore(state)
    second = round(1.0 / simulation.dt)
    before = simulation.data.qpos[:3].copy()
    simulation.data.xfrc_applied[1, :3] = impulse / 0.1
    simulation.step(second // 10)
    simulation.data.xfrc_applied[1, :3] = 0.0
    simulation.step(4 * second)
    return stands(simulation.data, before)


def row(path: Path, pushes: bool) -> str:
    """What a robot does, in words."""
    model = hurcules.load_urdf(path, floating=True)
    qpos = posture_of(model, path)
    if qpos is None:
        return "its SRDF has no standing posture"
    robot = hurcules.Robot(model, floating=True)
    robot.set_qpos(qpos)
    if not feet_of(robot, model):
        return "no body on the floor"
    loop = standing(model, qpos)
    simulation, data = loop.simulation, loop.simulation.data
    controller = simulation.controller
    second = round(1.0 / simulation.dt)
    simulation.step(3 * second)
    if abs(data.qpos[2] - qpos[2]) > 0.05:
        return f"falls ({len(loop.feet)} feet)"
    start = np.array([data.body(foot).xpos for foot in loop.feet])
    aim = data.body(loop.hand).xpos + REACH * np.array([1, 0, 0]) if loop.hand else np.zeros(3)
    begun = time.process_time()
    if loop.hand:
        simulation.step(second, {"hand": [REACH, 0, 0]})
    simulation.step(2 * second)
    tick = (time.process_time() - begun) / (2 + bool(loop.hand)) / second
    slid = max(np.linalg.norm(np.array([data.body(f).xpos for f in loop.feet]) - start, axis=1))
    limited = model.actuator_forcelimited.astype(bool)
    force = np.abs(data.actuator_force[limited]) / model.actuator_forcerange[limited, 1]
    share = float(np.max(force, initial=0.0))
    error = float(np.linalg.norm(data.body(loop.hand).xpos - aim)) if loop.hand else np.nan
    text = (
        f"{controller.plan.size} coordinates, {len(loop.feet)} feet, "
        f"hand {loop.hand}: {1e3 * error:.1f} mm, feet slid {1e3 * slid:.2f} mm, "
        f"torque {100 * share:.0f} %, {np.abs(data.qvel).max():.4f} rad/s, "
        f"tick {1e6 * tick:.0f} us"
    )
    if not pushes:
        return text
    state, mass = simulation.state(), float(model.body_subtreemass[1])
    for name, direction in DIRECTIONS.items():
        kept = 0.0
        for speed in SPEEDS:
            if not pushed(loop, state, mass * speed * np.array(direction, dtype=float)):
                break
            kept = speed
        text += f", {name} {kept:.1f} m/s"
    return text


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="files whose path contains this")
    parser.add_argument("--pushes", action="store_true", help="push them too")
    arguments = parser.parse_args()
    warnings.simplefilter("ignore")
    for package, path in places():
        if package != "example_robot_data" or arguments.only not in str(path):
            continue
        try:
            text = row(path, arguments.pushes)
        except hurcules.Error as error:
            text = str(error)[:100]
        print(f"{path.stem}: {text}", flush=True)


if __name__ == "__main__":
    main()
