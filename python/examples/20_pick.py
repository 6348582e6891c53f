"""A gantry picks a cube: a mission of one's own, that knows whether it has it.

Run:  python python/examples/20_pick.py
or, for a film and a report of it:  hurcules run python/examples/20_pick.py --x -0.3
"""

import mujoco

import hurcules

ROBOT = """<mujoco><option timestep="0.002" cone="elliptic" impratio="10"/>
  <default><joint type="slide" armature="0.1" range="-0.5 0.5"/><motor ctrlrange="-300 300"/>
    <default class="finger"><geom type="box" size="0.03 0.01 0.06" mass="0.2" friction="1.5"/>
      <joint range="-0.04 0.04" damping="20"/></default></default>
  <visual><headlight ambient="0.5 0.5 0.5"/></visual><worldbody><geom type="plane" size="1 1 1"/>
    <body pos="0 0 0.6"><joint name="x" axis="1 0 0"/><geom size="0.05" mass="1"/>
      <body><joint name="z"/><geom name="palm" size="0.05" mass="1"/><site name="grip"/>
        <body pos="0 0.05 -0.1" childclass="finger"><geom/><joint name="left" axis="0 -1 0"/></body>
        <body pos="0 -0.05 -0.1" childclass="finger"><geom/><joint name="right" axis="0 1 0"/>
        </body>
      </body></body>
    <body name="cube" pos="0.2 0 0.02"><freejoint name="cube"/><geom type="box"
      size="0.02 0.02 0.02" mass="0.5" rgba="0.9 0.4 0.2 1"/></body></worldbody>
  <actuator><motor joint="x"/><motor joint="z"/><motor joint="left"/><motor joint="right"/>
  </actuator></mujoco>"""
close = {"left": {"rate": [0.03]}, "right": {"rate": [0.03]}}
LATE = {"within": 3.0, "late": ["abort"]}
OVER = {"to": ["position/cube/x", ""]}  # where the cube is as the phase begins
ARRIVED = {"stack": "hand", "done": ["measured_error/hand <= 0.002"], **LATE}
PHASES = [
    {"name": "above", "lead": {"hand": {"value": [0.0, 0.5], **OVER}}, **ARRIVED},
    {"name": "down", "lead": {"hand": {"value": [0.0, 0.17], **OVER}}, **ARRIVED},
    {**ARRIVED, "name": "close", "lead": close, "done": ["contact_force/cube >= 40 for 0.2 s"]},
    {"name": "raise", "lead": {"hand": {"value": [0.0, 0.45], **OVER}}, **ARRIVED},
]
HEIGHT = {"name": "cube_height_m", "quantity": "position/cube/z", "least": 0.25}


def simulation(seed: int = 0, x: float = 0.2) -> hurcules.Simulation:
    """With the cube at this place [m]."""
    model = mujoco.MjModel.from_xml_string(ROBOT)
    model.qpos0[model.joint("cube").qposadr[0]] = x
    robot = hurcules.Robot(model, joints=["x", "z"])
    hand = hurcules.PositionTask("hand", robot, "grip", axes=[[1, 0, 0], [0, 0, 1]])
    channels = {name: hurcules.JointRate(name, 0.1) for name in ("left", "right")}
    channels["hand"] = hurcules.Target(hand)
    controller = hurcules.WholeBodyController(robot, channels=channels, stacks={"hand": [hand]})
    table = {"mission": {"name": "pick"}, "phase": PHASES, "figure": [HEIGHT]}
    mission = hurcules.Mission.read(table)
    return hurcules.Simulation(mission, seed, model=model, controller=controller, timed=True)


if __name__ == "__main__":
    run = simulation()
    while not run.finished:
        run.step(100)
    for time, event in run.events():
        print(f"{time:6.3f} s  {event}")
    print(f"{run.reason}; the cube is {run.figures()['cube_height_m']:.3f} m up")
