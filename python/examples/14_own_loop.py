"""A loop of your own: what is sensed goes in, controls come out, `mj_step` stands for the robot.

With a robot on the bench, encoders stand in its place: `tick` wants no simulation.

Run:  python python/examples/14_own_loop.py
"""

import mujoco
import numpy as np

import hurcules

ARM = """<mujoco><option timestep="0.001"/>
  <default><joint axis="0 1 0" armature="0.05" range="-150 150"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0.4 0 0" mass="2"/></default>
  <worldbody><body pos="0 0 1"><joint name="shoulder"/><geom/>
    <body pos="0.4 0 0"><joint name="elbow"/><geom/>
      <body pos="0.4 0 0"><joint name="wrist"/><geom/><site name="tip" pos="0.4 0 0"/></body>
    </body></body></worldbody>
  <actuator><motor joint="shoulder" forcerange="-200 200"/>
    <motor joint="elbow" forcerange="-100 100"/><motor joint="wrist" forcerange="-50 50"/>
  </actuator></mujoco>"""


def main() -> None:
    """Leads the tip for a second and says where it went."""
    model = mujoco.MjModel.from_xml_string(ARM)
    robot = hurcules.Robot(model)
    robot.set_configuration([0.4, 0.8, -0.6])
    tip = hurcules.PositionTask("tip", robot, "tip", axes=[[1, 0, 0], [0, 0, 1]])
    levels = [tip, hurcules.PostureTask("posture", robot)]
    controller = hurcules.WholeBodyController(robot, levels, {"tip": hurcules.Twist(tip, 0.3)})

    data = mujoco.MjData(model)
    data.qpos[:] = robot.qpos
    mujoco.mj_forward(model, data)
    start = data.site("tip").xpos.copy()
    for tick in range(1500):
        command = {"tip": [-0.1, 0.1]} if tick < 1000 else None  # [m/s], then it holds
        data.ctrl[:] = controller.tick(data.qpos, data.qvel, command)
        mujoco.mj_step(model, data)
    moved = data.site("tip").xpos - start

    print("the tip was to move by", np.array([-0.1, 0.0, 0.1]), "m")
    print("the tip moved by      ", np.round(moved, 4), "m")
    print("where the drives hold the joints:", np.round(controller.q_des, 3), "rad")
    for note in controller.diagnostics():
        print(" ", note)


if __name__ == "__main__":
    main()
