"""Both hands of the rescue robot press on the ground with 5 N and slide, in the physics.

Run:  python python/examples/08_force_control.py
"""

import mujoco

import hurcules
from hurcules import ForceGains, ForceTask, PositionTask, Stack, postures

data = mujoco.MjData(model := hurcules.models.load("rescue"))
robot = hurcules.Robot(model)  # what the servos follow
robot.set_keyframe("stretch")
robot.stand_on("lower_leg_L")
q = robot.configuration
posture = {"KN": 1.995, "HIP": 0.27, "LSP": 1.28, "RSP": 1.28, "LEB": 1.095, "REB": 1.095}
for name, angle in posture.items():
    q[robot.coordinate(name)] = angle
robot.set_configuration(q)
data.qpos[:] = robot.qpos  # tips 5 cm above the ground
slide = [PositionTask(f"{s}hpos", robot, f"{s}_tcp", axes=[[1, 0, 0], [0, 1, 0]]) for s in "LR"]
gains = ForceGains(compliance=0.05)  # [m/s/N]; the springs are 1.1 kN/m at the tips
press = [ForceTask(f"{s}force", robot, f"{s}_tcp", gains=gains, environment=1100) for s in "LR"]
springs = [hurcules.SpringForce(robot, f"{s}EBS", f"{s}_tcp") for s in "LR"]
controller = hurcules.VelocityController(robot)
limits, rest = hurcules.JointLimits("joint", robot), hurcules.PostureTask("rest", robot)
controller.set_stack(Stack([limits, [*slide, *press], rest]))
player = postures.Player(model, data)
player.wait(1.4)
for tick in range(6000):
    for spring, down, ahead in zip(springs, press, slide, strict=True):
        spring.update(data.qpos, data.qvel)
        down.sense(robot, -spring.force / spring.direction[2])
        down.advance([-0.02], 0.001)  # until it touches
        ahead.advance([0.05 if tick > 3000 else 0.0, 0.0], 0.001)
    controller.step(robot)
    player.track(robot.qpos)
    x, state = data.site("L_tcp").xpos[0], press[0].contact.name
    if tick % 500 == 0:
        print(f"{tick / 1000:3.1f} s  {state:8} {press[0].force:6.2f} N  tip at {x:.3f} m")
