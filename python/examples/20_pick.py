"""A gantry picks a cube: a mission of one's own, that knows whether it has it.

Run:  python python/examples/20_pick.py
or, with film and report:  hurcules run python/examples/20_pick.py
"""

import mujoco

import hurcules

ROBOT = """<mujoco><option timestep="0.002" cone="elliptic" impratio="10"/>
  <default><joint type="slide" armature="0.1" range="-0.5 0.5"/><motor ctrlrange="-300 300"/>
    <default class="finger"><geom type="box" size="0.03 0.01 0.06" mass="0.2" friction="1.5"/>
      <joint range="-0.04 0.04" damping="20"/></default></default>
  <worldbody><geom type="plane" size="1 1 1"/>
    <body pos="0 0 0.6"><joint name="x" axis="1 0 0"/><geom size="0.05" mass="1"/>
      <body><joint name="z"/><geom name="palm" size="0.05" mass="1"/><site name="grip"/>
        <body pos="0 0.05 -0.1" childclass="finger"><geom/><joint name="left" axis="0 -1 0"/></body>
        <body pos="0 -0.05 -0.1" childclass="finger"><geom/><joint name="right" axis="0 1 0"/>
        </body>
      </body></body>
    <body name="cube" pos="0.2 0 0.02"><freejoint/><geom type="box" size="0.02 0.02 0.02"
      mass="0.5" rgba="0.9 0.4 0.2 1"/></body></worldbody>
  <actuator><motor joint="x"/><motor joint="z"/><motor joint="left"/><motor joint="right"/>
  </actuator></mujoco>"""
close = {"left": {"rate": [0.03]}, "right": {"rate": [0.03]}}
LATE = {"within": 3.0, "late": ["abort"]}
PHASES = [
    {"name": "above", "seconds": 2.0, "lead": {"hand": {"by": [0.2, 0.0]}}},
    {"name": "down", "seconds": 2.0, "lead": {"hand": {"by": [0.0, -0.45]}}},
    {"name": "close", "lead": close, "done": ["contact_force/cube >= 40 for 0.2 s"], **LATE},
    {"name": "raise", "seconds": 2.0, "lead": {"hand": {"by": [0.0, 0.3]}},
     "done": ["position/cube/z >= 0.25"], **LATE},
]  # fmt: skip
HEIGHT = {"name": "cube_height_m", "quantity": "position/cube/z", "least": 0.25}


def job(seed):
    """Mission, model and controller: what `hurcules run 20_pick.py` runs."""
    model = mujoco.MjModel.from_xml_string(ROBOT)
    robot = hurcules.Robot(model, joints=["x", "z"])
    hand = hurcules.PositionTask("hand", robot, "grip", axes=[[1, 0, 0], [0, 0, 1]])
    fingers = {name: hurcules.JointRate(name, 0.1) for name in ("left", "right")}
    channels = {"hand": hurcules.Twist(hand, 0.5), **fingers}
    controller = hurcules.WholeBodyController(robot, channels=channels, stacks={"hand": [hand]})
    phases = [{"stack": "hand", **phase} for phase in PHASES]
    table = {"mission": {"name": "pick"}, "phase": phases, "figure": [HEIGHT]}
    return hurcules.Mission.read(table), model, controller


if __name__ == "__main__":
    mission, model, controller = job(0)
    simulation = hurcules.Simulation(mission, model=model, controller=controller)
    while not simulation.finished:
        simulation.step(100)
    for time, event in simulation.events():
        print(f"{time:6.3f} s  {event}")
    print(f"{simulation.reason}; the cube is {simulation.figures()['cube_height_m']:.3f} m up")
