"""Any robot in the physics, all by default: a table of the robots that installed packages ship.

Run:  python benchmarks/robots_physics.py [--only panda]

MJCF files as they are, if they have actuators; URDF files by `hurcules.load_urdf`. The stack is
`limits < hand < posture`: a second at rest, a second of 0.05 m/s along each axis, a second at rest.
Told at the end: how far the hand is from where the plan has it, how fast the fastest joint is, how
far any joint was over its limit, how many contacts there are. Packages: see arms.py.
"""

from __future__ import annotations

import argparse
import warnings
from pathlib import Path

import mujoco
import numpy as np
from arms import hand_of, name_of, places, ranges

import hurcules

NEAR = 5e-3  # [m]


def load(path: Path) -> mujoco.MjModel:
    """The model of a file."""
    if path.suffix == ".urdf":
        return hurcules.load_urdf(path)
    return mujoco.MjModel.from_xml_path(str(path))


def row(path: Path) -> tuple[float, str]:
    """How far off the hand was in the end [m], and all in words."""
    model = load(path)
    robot = hurcules.Robot(model)
    if robot.size < 2 or not model.nu:
        return np.nan, "nothing to move"
    robot.set_configuration(np.clip(robot.configuration, *ranges(robot)))
    name = hand_of(robot, model)
    if not name:
        return np.nan, "no frame that two coordinates move"
    hand, posture = hurcules.PositionTask("hand", robot, name), hurcules.PostureTask("p", robot)
    channels = {"hand": hurcules.Twist(hand, 0.3)}
    controller = hurcules.WholeBodyController(robot, [hand, posture], channels)
    simulation = hurcules.Simulation(model=model, controller=controller)
    second = round(1.0 / simulation.dt)
    for command in (None, {"hand": [-0.05, 0.05, -0.05]}, None):
        simulation.step(second, command)
    if simulation.finished:
        return np.nan, simulation.reason
    data = simulation.data
    error = float(np.linalg.norm(data.body(name).xpos - controller.plan.position(name)))
    return error, (
        f"{robot.size} joints, {1e3 * error:.2f} mm, {np.abs(data.qvel).max():.3f} rad/s, "
        f"{1e3 * simulation.limit_violation()['position_rad']:.1f} mrad over, "
        f"{data.ncon} contacts" + ", its root falls" * robot.floats
    )


def main() -> None:
    """Prints the table and what it comes to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--only", default="", help="part of a name")
    options = parser.parse_args()
    warnings.simplefilter("ignore")
    errors = []
    for package, path in places():
        name = name_of(package, path)
        if options.only not in name:
            continue
        try:
            error, text = row(path)
        except (ValueError, hurcules.Error) as problem:
            error, text = np.nan, str(problem).splitlines()[0][-90:]
        errors.append(error)
        print(f"{name:56s} {text}", flush=True)
    ran = [error for error in errors if np.isfinite(error)]
    near = sum(error < NEAR for error in ran)
    print(f"{len(errors)} files, {len(ran)} ran, {near} within {1e3 * NEAR:g} mm of the plan")


if __name__ == "__main__":
    main()
