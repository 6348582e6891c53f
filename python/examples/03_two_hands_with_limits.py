"""Two hands of Hurcules (19 coordinates, 4 levels) reach for points; one of them lies out of reach.

Run:  python python/examples/03_two_hands_with_limits.py
"""

import numpy as np

import hurcules
from hurcules import Stack

model = hurcules.models.load("manipulation")

# the reach, in twelve lines: limits first, then the left hand, then the right, then the posture
robot = hurcules.Robot(model)
robot.set_keyframe("ready")
robot.stand_on("lower_leg_L")
limits = hurcules.JointLimits("joint", robot)
left = hurcules.PositionTask("lhpos", robot, "L_tcp")
right = hurcules.PositionTask("rhpos", robot, "R_tcp")
left.set_target(left.value + np.array([1.5, 0.2, -0.3]))  # out of reach
right.set_target(right.value + np.array([0.1, 0.0, 0.2]))
controller = hurcules.VelocityController(robot)
controller.set_stack(Stack([limits, left, right, hurcules.PostureTask("posture", robot)]))
for _ in range(8000):  # 8 s at 1 kHz
    controller.step(robot)

print(controller.stack)
for hand in (left, right):
    hand.update(robot)
    print(f"{hand.name}: {1000 * np.linalg.norm(hand.error):6.1f} mm from its target")
for name, side in zip(robot.coordinate_names, controller.active_limits, strict=True):
    if side:
        print(f"{name} is held at its {'upper' if side > 0 else 'lower'} limit")

lower, upper = limits.lower, limits.upper
outside = np.maximum(lower - robot.configuration, robot.configuration - upper).max()
print(f"worst excess over a joint limit: {max(0.0, outside):.1e} rad")
