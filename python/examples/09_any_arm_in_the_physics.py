"""A Panda of another package in the physics: its hand led by commands, limits kept, gravity held.

Any MJCF robot does; this one stands in the kitchen of `gymnasium_robotics`.

Run:  python python/examples/09_any_arm_in_the_physics.py
"""

from importlib.util import find_spec
from pathlib import Path

import numpy as np

import hurcules

KITCHEN = "envs/assets/kitchen_franka/kitchen_assets/kitchen_env_model.xml"
START = {"joint1": 0.0, "joint2": -0.5, "joint3": 0.0, "joint4": -2.2, "joint5": 0.0, "joint6": 0.3}


def main() -> None:
    """Leads the hand for a second and says where it went."""
    package = find_spec("gymnasium_robotics")
    if package is None or package.origin is None:
        print("gymnasium_robotics is not installed: pip install gymnasium-robotics")
        return
    path = Path(package.origin).parent / KITCHEN

    # the controller: limits first, then the hand, then the posture
    robot = hurcules.Robot(path, joints=[f"robot:panda0_joint{i}" for i in range(1, 8)])
    robot.set_configuration([*START.values(), 0.0])
    hand = hurcules.PositionTask("hand", robot, "end_effector")
    tilt = hurcules.OrientationTask("tilt", robot, "end_effector")
    posture = hurcules.PostureTask("posture", robot)
    channels = {"hand": hurcules.Twist(hand, 0.3)}
    controller = hurcules.WholeBodyController(robot, [hand, tilt, posture], channels)

    # the loop
    simulation = hurcules.Simulation(model=path, controller=controller)
    second = round(1.0 / simulation.dt)
    start = simulation.data.site("end_effector").xpos.copy()
    simulation.step(second, {"hand": [0.05, 0.1, 0.05]})  # [m/s], for a second
    simulation.step(second)  # every target holds
    moved = simulation.data.site("end_effector").xpos - start

    print("the hand was to move by", np.array([0.05, 0.1, 0.05]), "m")
    print("the hand moved by      ", np.round(moved, 4), "m")
    worst = simulation.limit_violation()
    print("worst excess over a joint limit, measured:", f"{worst['position_rad']:.1e} rad")
    print("what each level falls short of:")
    for note in controller.diagnostics():
        print(" ", note)


if __name__ == "__main__":
    main()
