"""Hurcules drives with its tracks while both hands keep their place in the world.

Run:  python python/examples/10_drive_and_reach.py
"""

import numpy as np

import hurcules


def main() -> None:
    """Drives back and says how far the hands moved."""
    model = hurcules.models.load(mission="stretch")
    robot = hurcules.Robot(model)
    robot.set_keyframe("stretch")
    robot.stand_on("lower_leg_L")
    hands = [hurcules.PositionTask(f"{side} hand", robot, f"{side}_tcp") for side in "LR"]
    posture = hurcules.PostureTask("posture", robot)
    controller = hurcules.WholeBodyController(
        robot,
        [hands, posture],
        {"drive": hurcules.Drive(speed=0.5, yaw_rate=0.5)},
        base="sensed",  # targets stay where they are in the world while the robot moves
        drive=hurcules.DriveOptions(),
    )
    simulation = hurcules.Simulation(model=model, controller=controller)
    simulation.step(1000)  # it takes its stand
    base = simulation.data.body("upper_legs").xpos.copy()
    start = [simulation.data.site(f"{side}_tcp").xpos.copy() for side in "LR"]
    worst = 0.0
    for _ in range(40):
        simulation.step(100, {"drive": [-0.05, 0.0]})  # back at 0.05 m/s
        now = [simulation.data.site(f"{side}_tcp").xpos for side in "LR"]
        worst = max(worst, *(float(np.linalg.norm(a - b)) for a, b in zip(now, start, strict=True)))
    driven = simulation.data.body("upper_legs").xpos - base

    print("tracks at -0.05 m/s for 4 s, both hands held where they are in the world")
    print(f"driven:        {driven[0]:+.3f} m")
    print(f"hands moved:   {1e3 * worst:.1f} mm at most")
    print(f"over a limit:  {simulation.limit_violation()['position_rad']:.1e} rad")
    print(f"controller:    {controller}")


if __name__ == "__main__":
    main()
