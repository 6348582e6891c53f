"""Any MJCF arm: three joints as text, the hand sent to a point, no joint limit passed.

Run:  python python/examples/02_any_mjcf_arm.py
"""

import mujoco
import numpy as np

import hurcules

ARM = """
<mujoco>
  <compiler angle="radian"/>  <!-- MJCF takes degrees otherwise -->
  <default>
    <joint type="hinge" axis="0 1 0" range="-1.8 1.8"/>
    <geom type="capsule" size="0.03"/>
  </default>
  <worldbody>
    <body>
      <joint name="turn" axis="0 0 1" range="-3 3"/>
      <geom fromto="0 0 0 0 0 0.4"/>
      <body pos="0 0 0.4">
        <joint name="shoulder"/>
        <geom fromto="0 0 0 0.4 0 0"/>
        <body pos="0.4 0 0">
          <joint name="elbow"/>
          <geom fromto="0 0 0 0.3 0 0"/>
          <site name="hand" pos="0.3 0 0"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""

robot = hurcules.Robot(mujoco.MjModel.from_xml_string(ARM))
robot.set_configuration([0.0, 0.3, 0.3])

limits = hurcules.JointLimits("limits", robot)
hand = hurcules.PositionTask("hand", robot, "hand")
hand.set_target([0.4, 0.3, 0.6])

controller = hurcules.VelocityController(robot)
controller.set_stack(hurcules.Stack([limits, hand]))

for tick in range(3001):
    if tick % 600 == 0:
        q = robot.configuration.round(3)
        distance = np.linalg.norm(robot.position("hand") - hand.target)
        print(f"{tick / 1000:3.1f} s   q = {q}   to go {1000 * distance:6.1f} mm")
    controller.step(robot)
