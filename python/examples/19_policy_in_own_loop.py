"""A policy of the package leads two arms of your own in a loop of your own: 20 Hz around 1 kHz.

`mj_step` stands for the robot. One reading is wrong, the policy is silent for 1 s, an emergency
stop lets the arms sag.

Run:  python python/examples/19_policy_in_own_loop.py
"""

import mujoco
import numpy as np

import hurcules
from hurcules_envs.policy import Policy

SIDES, START = ("left", "right"), [0.0, 0.6, 0.0, 1.2, 0.0, 0.6] * 2
SCALE = 0.3  # [m/s] what 1 means in an action: see the table of the environment

spec = mujoco.MjSpec.from_string('<mujoco><option timestep="0.001"/></mujoco>')
for side, y in zip(SIDES, (0.35, -0.35), strict=True):
    body = spec.worldbody.add_body(pos=[0, y, 0.6])
    for i, axis in enumerate("zyzyzy"):
        body = body.add_body(pos=[0, 0, 0.2])
        turn = {"axis": np.eye(3)["xyz".index(axis)], "range": [-150, 150], "armature": 0.1}
        effort = {"actfrclimited": True, "actfrcrange": [20 * i - 150, 150 - 20 * i]}
        body.add_joint(name=f"{side}{i}", damping=[1, 0, 0], **turn, **effort)
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.03, 0.03, 0.1], pos=[0, 0, 0.1])
    body.add_site(name=side, pos=[0, 0, 0.2])
model = hurcules.with_motors(spec)
robot, seen = hurcules.Robot(model), hurcules.Robot(model)  # the second one: as it is read
robot.set_configuration(START)
hands = [hurcules.PositionTask(side, robot, side) for side in SIDES]
channels = {hand.name: hurcules.Twist(hand, SCALE) for hand in hands}
levels = [hands, hurcules.PostureTask("posture", robot)]
controller = hurcules.WholeBodyController(robot, levels, channels)
policy, generator, data = Policy("Reach-v0"), np.random.default_rng(0), mujoco.MjData(model)
data.qpos[:] = last = robot.qpos
goal = np.concatenate([robot.position(side) for side in SIDES]) + [0.1, 0.0, 0.1] * 2
command, acted, wrong, stopped = None, 0, 0, False
for tick in range(6000):  # [ms]
    mujoco.mj_step(model, data)
    if 2000 <= tick < 2300:  # emergency stop: the motors are off
        data.ctrl[:], stopped = 0.0, True
        continue
    qpos = data.qpos + generator.normal(1.0 if tick == 1000 else 0.0, 1e-5, model.nq)
    if stopped:
        controller.reset(qpos)  # else the arms are thrown back to where the plan was
        last, stopped = qpos, False
    wrong = wrong + 1 if np.abs(qpos - last).max() > 0.05 else 0  # nothing moves so far in a tick
    assert wrong < 20, "the encoders cannot be believed"  # brakes
    last = last if wrong else qpos
    seen.set_qpos(last)
    places = np.concatenate([seen.position(side) for side in SIDES])  # what it observes
    if tick % 50 == 0 and not 300 <= tick < 1300:  # the policy is silent then
        action = SCALE * policy.one({"achieved_goal": places, "desired_goal": goal})
        command, acted = {"left": action[:3], "right": action[3:]}, tick
    fresh = tick - acted < 200  # without an action every target holds
    data.ctrl[:] = controller.tick(last, data.qvel, command if fresh else None)
    if tick in (1299, 1999, 2300, 5999):
        print(f"{tick + 1} ms: {1000 * np.abs(places - goal).max():.1f} mm from the goal")
