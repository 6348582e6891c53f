"""A quadruped that nothing holds stands by torques, reaches with its arm, and is pushed.

Contacts are tasks of the stack: their forces stay inside friction cones, torques inside the limits
of the motors, and both come before the centre of mass, the hand and the posture. A humanoid from a
URDF does the same, on `hurcules.load_urdf(path, floating=True)`.

Run:  python python/examples/13_stand_by_torques.py
"""

import numpy as np

import hurcules

MODEL = hurcules.models.folder() / "examples" / "quadruped.xml"
LEGS = ("FL", "FR", "HL", "HR")


def main() -> None:
    """Stands, reaches, is pushed."""
    # the controller: contacts and torque limits first, then balance, then the hand
    robot = hurcules.Robot(MODEL, floating=True)
    robot.set_keyframe("stand")
    feet = [hurcules.ContactTask(leg, robot, f"{leg}_shank", friction=0.6) for leg in LEGS]
    com = hurcules.CenterOfMassTask("centre of mass", robot)
    trunk = hurcules.OrientationTask("trunk", robot, "trunk")
    hand = hurcules.PositionTask("hand", robot, "hand")
    posture = hurcules.PostureTask("posture", robot)
    levels = [feet, [com, trunk], hand, posture]
    channels = {"hand": hurcules.Twist(hand, 0.3)}
    controller = hurcules.WholeBodyController(robot, levels, channels, control="torque")

    # the loop
    simulation = hurcules.Simulation(model=MODEL, controller=controller)
    data, second = simulation.data, round(1.0 / simulation.dt)
    simulation.step(second)
    start = data.site("hand").xpos.copy()
    simulation.step(second, {"hand": [0.05, 0.1, -0.05]})  # [m/s], for a second
    simulation.step(second)
    print("the hand was to move by [0.05 0.1 -0.05] m")
    print("the hand moved by      ", np.round(data.site("hand").xpos - start, 4), "m")
    carried = sum(controller.contact_force(leg)[2] for leg in LEGS)
    weight = 9.81 * simulation.model.body_subtreemass[1]
    print(f"the feet carry {carried:.1f} N of {weight:.1f} N")

    stood = data.body("trunk").xpos.copy()
    data.xfrc_applied[1, 1] = 60.0  # [N] sideways at the trunk, for 0.1 s
    simulation.step(second // 10)
    data.xfrc_applied[1, 1] = 0.0
    print(f"pushed: {np.abs(data.qvel[:2]).max():.2f} m/s")
    simulation.step(4 * second)
    away = 1e3 * np.linalg.norm(data.body("trunk").xpos - stood)
    print(f"four seconds later: {away:.1f} mm away, {np.abs(data.qvel).max():.4f} rad/s")


if __name__ == "__main__":
    main()
