"""Base and arm reach together on two wheels that roll: a plan on slides, and what follows it.

Run:  python python/examples/17_wheels.py
"""

import mujoco
import numpy as np

import hurcules
from hurcules import CustomTask, PositionTask, PostureTask

MODEL = hurcules.models.folder() / "examples" / "wheels.xml"
SLIDES = """<joint name="x" type="slide" axis="1 0 0"/><joint name="y" type="slide" axis="0 1 0"/>
  <joint name="yaw" axis="0 0 1"/>"""
ARM, RADIUS, GAUGE = ["turn", "shoulder", "elbow"], 0.1, 0.6  # [m] of a wheel, between them


def side_speed(robot):
    """The row of a base that rolls: its speed to the side is 0."""
    yaw, row = robot.configuration[2], np.zeros((1, robot.size))
    row[0, :2] = -np.sin(yaw), np.cos(yaw)
    return [0.0], row


# the plan: the same robot on two slides and a hinge
text = MODEL.read_text().replace('<freejoint name="root"/>', SLIDES)
plan = hurcules.Robot(mujoco.MjModel.from_xml_string(text), joints=["x", "y", "yaw", *ARM])
plan.set_configuration([0.0, 0.0, 0.0, 0.0, -0.8, 1.6])
rolls, goal = CustomTask("rolls", plan, 1, side_speed), PositionTask("goal", plan, "hand")
target = plan.position("hand") + np.array([-0.5, 1.5, 0.0])  # to the left and behind [m]
goal.set_target(target)
planner = hurcules.VelocityController(plan, hurcules.VelocityControllerOptions(dt=0.002))
planner.set_stack(hurcules.Stack([rolls, goal, PostureTask("posture", plan, ARM)]))

# the arm leads the hand from where the base really is
data = mujoco.MjData(model := mujoco.MjModel.from_xml_path(str(MODEL)))
robot = hurcules.Robot(model, joints=ARM)
robot.set_configuration(plan.configuration[3:])
hand, rest = PositionTask("hand", robot, "hand"), PostureTask("rest", robot)
controller = hurcules.WholeBodyController(robot, [hand, rest], base="sensed", support="base")
data.qpos[:] = robot.qpos
mujoco.mj_forward(model, data)
for tick in range(6001):
    planner.step(plan)
    hand.set_target(plan.position("hand"), plan.position_jacobian("hand") @ planner.velocity)
    rest.set_target(plan.configuration[3:])
    data.ctrl[:] = controller.tick(data.qpos, data.qvel)
    # the wheels follow the base of the plan, and come back to its way
    ahead, side = data.body("base").xmat.reshape(3, 3)[:2, :2].T
    off, speed = plan.configuration[:2] - data.qpos[:2], planner.velocity[:2] @ ahead
    turn = np.arcsin(np.sin(plan.configuration[2] - np.arctan2(ahead[1], ahead[0])))
    rate = planner.velocity[2] + 4.0 * turn + 16.0 * speed * (off @ side)
    data.ctrl[:2] = (speed + 4.0 * (off @ ahead) + np.array([-0.5, 0.5]) * GAUGE * rate) / RADIUS
    mujoco.mj_step(model, data)
    if tick % 1000 == 0:
        away = 1e3 * np.linalg.norm(data.site("hand").xpos - target)
        print(f"{data.time:4.1f} s  hand {away:7.2f} mm to go, base at", data.qpos[:2].round(3))
