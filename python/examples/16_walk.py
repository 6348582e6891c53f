"""A quadruped walks: one stack for each set of feet that stand.

A foot is a contact for as long as a stack with it rules. So a step is a change of stacks: the
centre of mass goes over the three feet that stay, then the fourth is lifted, led and set down.

Run:  python python/examples/16_walk.py
"""

import mujoco
import numpy as np

import hurcules

MODEL = hurcules.models.folder() / "examples" / "quadruped.xml"
LEGS = ("HL", "FL", "HR", "FR")  # in the order of their steps
STEP = ([0.0, 0.0, 0.06], [0.1, 0.0, 0.0], [0.0, 0.0, -0.06])  # [m] up, ahead, down
SPEED = 0.2  # [m/s]


def lead(simulation: hurcules.Simulation, channel: str, way: np.ndarray) -> None:
    """Moves a target by a way [m], and waits for 0.2 s."""
    ticks = max(1, round(np.abs(way).max() / SPEED / simulation.dt))
    simulation.step(ticks, {channel: way / (ticks * simulation.dt)})
    simulation.step(100)


spec = mujoco.MjSpec.from_file(str(MODEL))
for leg in LEGS:  # a frame at the tip of each shank
    spec.body(f"{leg}_shank").add_site(name=leg, pos=[0.0, 0.0, -0.2])
model = spec.compile()
robot = hurcules.Robot(model, floating=True)
robot.set_keyframe("stand")
feet = {leg: hurcules.ContactTask(leg, robot, f"{leg}_shank", friction=0.6) for leg in LEGS}
tips = {leg: hurcules.PositionTask(f"{leg} tip", robot, leg) for leg in LEGS}
com = hurcules.CenterOfMassTask("centre of mass", robot)
body = [com, hurcules.OrientationTask("trunk", robot, "trunk")]
posture = hurcules.PostureTask("posture", robot)
stacks = {"stand": ([list(feet.values()), body, posture], "torque")}
for leg in LEGS:
    others = [feet[other] for other in LEGS if other != leg]
    stacks[leg] = ([others, body, tips[leg], posture], "torque")
channels = {name: hurcules.Twist(tip, 0.5) for name, tip in {**tips, "com": com}.items()}
controller = hurcules.WholeBodyController(robot, channels=channels, stacks=stacks)
simulation = hurcules.Simulation(model=model, controller=controller)
places = {leg: simulation.data.site(leg).xpos for leg in LEGS}
start = {leg: place.copy() for leg, place in places.items()}
for leg in 2 * LEGS:
    middle = np.mean([places[other] for other in LEGS if other != leg], axis=0)
    lead(simulation, "com", (middle - com.target) * [1.0, 1.0, 0.0])
    controller.use(leg)
    for way in STEP:
        lead(simulation, leg, np.array(way))
    controller.use("stand")
    simulation.step(100)
    carried = controller.contact_force(leg)[2]
    print(f"{simulation.time:4.1f} s: {leg} has stepped and carries {carried:.0f} N")
print("each foot was to move by", np.array([0.2, 0.0]), "m")
for leg in LEGS:
    print(f"{leg} moved by", (places[leg] - start[leg])[:2].round(3), "m")
