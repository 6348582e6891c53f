"""A hand is wanted where the shoulder cannot turn to: the arm goes round by another posture.

Run:  python python/examples/23_another_posture.py
"""

import mujoco
import numpy as np

import hurcules

ARM = """<mujoco><compiler angle="radian"/><worldbody>
  <body><joint name="shoulder" axis="0 0 1" range="-2.6 2.6"/>
    <geom type="capsule" size="0.03" fromto="0 0 0 0.5 0 0"/>
    <body pos="0.5 0 0"><joint name="elbow" axis="0 0 1" range="-2.5 2.5"/>
      <geom type="capsule" size="0.03" fromto="0 0 0 0.5 0 0"/><site name="hand" pos="0.5 0 0"/>
  </body></body></worldbody></mujoco>"""

robot = hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))
robot.set_configuration([2.5, 0.1])
hand = hurcules.PositionTask("hand", robot, "hand")
hand.set_target([-0.75, -0.55, 0.0])  # half a radian on, beyond the end of the shoulder's range

limits = hurcules.JointLimits("limits", robot)
detour = hurcules.Detour(robot, [limits], [hand])  # holds on the way too; shall be met
controller = hurcules.VelocityController(robot, hurcules.VelocityControllerOptions(dt=0.005))
controller.set_stack(detour.stacks["direct"])

for tick in range(2401):
    decision = detour.look(controller) if tick else "sets out"
    if decision or tick % 400 == 0:
        q = robot.configuration.round(2)
        miss = 1e3 * np.linalg.norm(robot.position("hand") - hand.target)
        print(f"{tick * 0.005:5.2f} s   q = {q}   to go {miss:6.1f} mm   {decision}")
    controller.step(robot)
