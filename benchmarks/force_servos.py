"""Force control by servos in the physics: robosuite's Panda presses on springs, still and moving.

Run:  python benchmarks/force_servos.py

The arm is led by `WholeBodyController` and the servos that it chooses, at 1 kHz, the physics too.
The wall is a spring of G on one side of a plane, its force read by a sensor at the hand. The hand
comes down at 20 mm/s, its place in the plane and its orientation held. The law is the first-order
one. Told, as in force_torques.py: the force of the last half of four seconds, the largest beside
that of a plain admittance; then the deviation on a wall of 1e4 N/m that moves by 5 mm at 0.5 Hz
under 20 N, for several C G. By the law alone it is 2 pi 0.5 Hz 5 mm / C / sqrt(2).
"""

from __future__ import annotations

import importlib.util
from pathlib import Path

import mujoco
import numpy as np
from force_torques import DT, GAP, SPEED, Result, Wall

import hurcules

HAND = "right_hand"
POSTURE = (0.0, 0.4, 0.0, -2.0, 0.0, 2.4, 0.8)  # [rad]
STIFFNESSES, FORCES, RATE = (1e3, 1e4, 1e5), (5.0, 50.0), 10.0  # [N/m], [N], C G [1/s]
RATES = (5.0, 10.0, 20.0, 40.0, 80.0)


def arm() -> mujoco.MjModel:
    """The Panda without contacts, a force sensor at its hand."""
    spec = importlib.util.find_spec("robosuite")
    assert spec is not None and spec.origin is not None, "robosuite is not installed"
    path = Path(spec.origin).parent / "models/assets/robots/panda/robot.xml"
    made = mujoco.MjSpec.from_file(str(path))
    made.option.timestep = DT
    for geom in made.geoms:
        geom.contype = geom.conaffinity = 0
    made.body(HAND).add_site(name="ft")
    kinds = mujoco.mjtSensor.mjSENS_FORCE, mujoco.mjtObj.mjOBJ_SITE
    made.add_sensor(name="ft", type=kinds[0], objtype=kinds[1], objname="ft")
    return made.compile()


def press(wall: Wall, force: float, rate: float, seconds: float, blend: float = 0.1) -> Result:
    """Comes down and presses by a law of C = rate / G."""
    model = arm()
    robot = hurcules.Robot(model)
    robot.set_configuration(np.array(POSTURE))
    task = hurcules.ForceTask(
        "press",
        robot,
        HAND,
        axis=[0, 0, 1],
        force_des=-force,
        blend=blend,
        environment=wall.stiffness,
        gains=hurcules.ForceGains(compliance=rate / wall.stiffness, dt=DT),
        contact=hurcules.ContactOptions(f_max=2e3),
    )
    place = hurcules.PositionTask("place", robot, HAND, axes=np.eye(3)[:2])
    turn, rest = hurcules.OrientationTask("turn", robot, HAND), hurcules.PostureTask("rest", robot)
    channels = {"press": hurcules.Twist(task, 0.1)}
    controller = hurcules.WholeBodyController(robot, [task, place, turn, rest], channels)
    controller.sense(task, "ft")
    task.tare()
    simulation = hurcules.Simulation(model=model, controller=controller, record=False)
    simulation.step(500)
    data, hand = simulation.data, model.body(HAND).id
    level, begin, read = data.xpos[hand, 2] - GAP, data.time, []
    for _ in range(round(seconds / DT)):
        depth = level + wall.height(data.time - begin) - data.xpos[hand, 2]
        read.append(max(0.0, wall.stiffness * depth))
        data.xfrc_applied[hand, 2] = read[-1]
        simulation.step(1, {"press": [-SPEED]})
    return Result(np.array(read))


def main() -> None:
    """Prints both tables."""
    print("| wall [N/m] | wanted [N] | settled [N] | deviation [N] | peak [N] | of plain |")
    for stiffness in STIFFNESSES:
        for force in FORCES:
            wall = Wall(stiffness)
            ours, plain = (press(wall, force, RATE, 4.0, blend) for blend in (0.1, 0.0))
            print(
                f"| {stiffness:.0e} | {force:.0f} | {ours.settled:.3f} | "
                f"{ours.deviation(force, 0.5):.4f} | {ours.peak:.1f} | "
                f"{ours.peak / plain.peak:.2f} |",
                flush=True,
            )
    print("| C G [1/s] | rms on the moving wall [N] | by the law alone [N] | peak, still [N] |")
    for rate in RATES:
        moving = press(Wall(1e4, stroke=0.005), 20.0, rate, 6.0)
        alone = np.pi * 0.005 * 1e4 / rate / np.sqrt(2.0)
        still = press(Wall(1e4), 20.0, rate, 4.0)
        print(
            f"| {rate:.0f} | {moving.deviation(20.0, 4.0):.2f} | {alone:.2f} | {still.peak:.1f} |",
            flush=True,
        )


if __name__ == "__main__":
    main()
