"""A torch follows a seam, its turn about its own axis free, and waits where a joint is too slow.

Run:  python python/examples/21_follow_a_path.py
"""

import mujoco
import numpy as np

import hurcules

ARM = """<mujoco><option timestep="0.002"/><compiler angle="radian"/>
  <default><joint axis="0 1 0" armature="0.1" range="-3 3"/>
    <geom type="capsule" size="0.04" fromto="0 0 0 0 0 0.1" mass="2" contype="0"/></default>
  <worldbody><body pos="0 0 0.3"><joint name="turn" axis="0 0 1"/><geom/>
    <body><joint name="shoulder"/><geom fromto="0 0 0 0 0 0.5"/>
    <body pos="0 0 0.5"><joint name="elbow"/><geom fromto="0 0 0 0 0 0.4"/>
    <body pos="0 0 0.4"><joint name="roll" axis="0 0 1"/><geom/><body><joint name="bend"/><geom/>
    <body pos="0 0 0.1"><joint name="spin" axis="0 0 1"/><geom/><site name="tip" pos="0 0 0.15"/>
    </body></body></body></body></body></body></worldbody></mujoco>"""
LENGTH, SPEED, AWAY = 0.5, 0.2, 0.002  # [m], [m/s]; [m] off the seam the torch goes no further
model = hurcules.with_motors(mujoco.MjSpec.from_string(ARM))


def seam(s):
    """Where the seam is after s [m], and how the torch is turned there: it leans to the side."""
    lean = 0.4 * np.sin(6.0 * s)
    leans = [[1, 0, 0], [0, np.cos(lean), -np.sin(lean)], [0, np.sin(lean), np.cos(lean)]]
    return start + np.array([0.03 * np.sin(9.0 * s) - 0.1 * s, s, 0.0]), leans @ upright


def follow(rates, waits):
    """How far the torch is off the seam and off its axis at most, and how long it takes."""
    s, ds, off, tip = 0.0, 1e-6, [], simulation.data.site("tip")
    while s < LENGTH:
        lag = waits * np.linalg.norm(place.error) / AWAY
        speed = SPEED * min(1.0, 2.0 * simulation.time) * max(0.0, 1.0 - lag)
        (here, turn), (ahead, next_turn) = seam(s), seam(s + ds)
        rate = np.cross(turn[:, 2], next_turn[:, 2]) / ds * speed  # of the axis [rad/s]
        place.set_target(here, (ahead - here) / ds * speed if rates else None)
        axis.set_target(turn.T, -turn.T @ rate if rates else None)  # as the torch sees the world
        simulation.step(1)
        s += speed * simulation.dt
        off.append([tip.xpos - here, np.cross(tip.xmat[2::3], turn[:, 2])])
    away, tilt = 1e3 * np.linalg.norm(off, axis=2).max(axis=0)
    case = f"rates {rates}, waits {waits}, turn {limit} rad/s"
    print(f"{case}: {away:6.2f} mm, {tilt:6.2f} mrad off at most, {simulation.time:.2f} s")


for limit, *case in [(2.0, 0, 0), (2.0, 1, 0), (0.3, 1, 0), (0.3, 1, 1)]:
    (robot := hurcules.Robot(model)).set_configuration([-0.5, 0.3, 1.6, 0.0, 1.24, 0.0])
    start, upright = robot.position("tip"), robot.orientation("tip")
    place = hurcules.PositionTask("place", robot, "tip")
    axis = hurcules.OrientationTask("axis", robot, "world", reference="tip")
    axis.set_interval([0.0, 0.0, -np.inf], [0.0, 0.0, np.inf])  # free about the torch's own z
    (limits := hurcules.JointLimits("limits", robot)).set_max_velocity("turn", limit)
    stack = [limits, [place, axis], hurcules.DampingTask("rest", robot)]
    controller = hurcules.WholeBodyController(robot, stack)
    simulation = hurcules.Simulation(model=model, controller=controller)
    follow(*case)
