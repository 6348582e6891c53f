"""An arm presses a tool on a slope, wipes over it and leaves, by what its force sensor reads.

Run:  python python/examples/18_press_and_wipe.py
"""

import mujoco
import numpy as np

import hurcules

SLOPE, WANTED = 0.3, 15.0  # [rad], [N]
ARM = f"""<mujoco><option timestep="0.001" cone="elliptic"/><compiler angle="radian"/>
  <default><joint axis="0 1 0" armature="0.05" range="-2.6 2.6"/>
    <geom contype="0" conaffinity="0" friction="0.2"/><default class="link">
      <geom type="capsule" size="0.04" fromto="0 0 0 0 0 0.35"/></default></default>
  <worldbody>
    <geom type="box" size="0.4 0.4 0.05" pos="0.6 0 0.1" euler="0 {SLOPE} 0" contype="1"/>
    <body pos="0 0 0.1"><joint name="turn" axis="0 0 1"/><geom class="link" mass="2"/>
      <body pos="0 0 0.35"><joint name="shoulder"/><geom class="link" mass="2"/>
        <body pos="0 0 0.35"><joint name="elbow"/><geom class="link" mass="2"/>
          <body pos="0 0 0.35"><joint name="wrist"/><geom size="0.04" mass="0.5"/>
            <body><site name="cell"/><site name="tip" pos="0 0 0.17"/><geom type="capsule"
              size="0.02" fromto="0 0 0 0 0 0.15" mass="0.4" conaffinity="1"/></body>
          </body></body></body></body>
  </worldbody>
  <sensor><force name="cell" site="cell"/></sensor></mujoco>"""


def go(what, seconds, **command):
    """Commands, and what the slope bears in the second half of that time by MuJoCo's contacts."""
    bears = np.zeros((round(seconds / simulation.dt), 6))
    for force in bears:
        simulation.step(1, command)
        if simulation.data.ncon:
            mujoco.mj_contactForce(model, simulation.data, 0, force)
    print(f"{what:7}{press.contact.name:8} {bears[len(bears) // 2 :, 0].mean():5.2f} N")


robot = hurcules.Robot(model := hurcules.with_motors(mujoco.MjSpec.from_string(ARM)))
robot.set_configuration([0.0, 0.9, 1.5, 0.7])
normal, along = [np.sin(SLOPE), 0.0, np.cos(SLOPE)], [np.cos(SLOPE), 0.0, -np.sin(SLOPE)]
press = hurcules.ForceTask("press", robot, "tip", axis=normal, force_des=-WANTED, max_rate=20.0)
place = hurcules.PositionTask("place", robot, "tip", axes=[along, [0.0, 1.0, 0.0]])
twists = {"press": hurcules.Twist(press, 0.3), "wipe": hurcules.Twist(place, 0.3)}
channels = {**twists, "force": hurcules.ForceReference(press, 100.0)}
controller = hurcules.WholeBodyController(robot, [[press, place]], channels)
controller.sense(press, "cell")  # what the robot exerts along the task's axis
simulation = hurcules.Simulation(model=model, controller=controller)
press.enable(False)  # motion alone: the arm rests
simulation.step(200)
press.tare()  # the weight of the tool, read in the next 0.1 s, is zero from then on
simulation.step(1)
press.enable(True)
down = [-0.03]  # [m/s] all along: in contact it moves nothing, one that was lost is found
go("comes", 5.0, press=down)
go("wipes", 3.0, press=down, wipe=[0.0, 0.08])
go("harder", 2.0, press=down, force=[-30.0])
press.enable(False)
go("leaves", 1.0, press=[0.05])
