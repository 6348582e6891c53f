"""Standing by torques beside TSID: the same robots, physics, contacts, gains and pushes.

Both compute the torques of a robot that nothing holds, in a loop of Python around MuJoCo (2 ms). A
hand is led by 0.1 m in a second; two seconds later it is told how far off it is. Then the root is
pushed as in standing.py. Times are of the controller alone, in turn in one process.

TSID solves one quadratic program: contacts, friction, limits of torques, positions and velocities
are its constraints; centre of mass, orientation of the root and hand have the weight 1, the posture
1e-4, forces 1e-5, as in its own exercises. Hurcules has each on a level of its own (standing.py).

Needs, beside the packages of arms.py, those of `NEEDS`; the module lies in tsid.tsid_pywrap.
Run:  python benchmarks/standing_peer.py [--only g1] [--pushes]
"""

from __future__ import annotations

import argparse
import copy
import time
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pinocchio as pin  # first: it loads what tsid wants
from arms import places
from numpy.typing import NDArray
from tsid import tsid_pywrap as tsid

import hurcules
from standing import DIRECTIONS, GAINS, REACH, SPEEDS, posture_of, stands, tasks_of

NEEDS = "tsid==1.7.1 pin==3.4.0 cmeel-urdfdom==4.0.1 cmeel-tinyxml2==10.0.0"
Vector = NDArray[np.float64]
FRICTION, LEAST, MOST = 0.6, 0.1, 2000.0  # of a contact, and its forces [N]
FALLEN = 0.1  # [m] that the root went up or down
WEIGHTS = {"task": 1.0, "posture": 1e-4, "forces": 1e-5}
SOLES = ("g1_29dof_rev_1_0", "talos_reduced_box")  # feet with four points


class Ours:
    """The hierarchy: torques of the sensed robot."""

    name = "hurcules"

    def __init__(self, model: mujoco.MjModel, qpos: Vector, _: Path) -> None:
        self.wanted = tasks_of(model, qpos)
        options = copy.copy(GAINS)
        options.dt = model.opt.timestep
        self.controller = hurcules.AccelerationController(self.wanted.robot, options)
        self.controller.set_stack(hurcules.Stack(self.wanted.levels))

    def lead(self, velocity: Vector) -> None:
        """The hand's target goes on for a period; velocity (3,) [m/s]."""
        self.wanted.hand.advance(velocity, self.controller.options.dt)

    def torque(self, qpos: Vector, qvel: Vector) -> Vector:
        """(m,) [N m] of the joints."""
        robot = self.wanted.robot
        robot.set_qpos(qpos)
        robot.set_velocity(qvel)
        self.controller.compute(robot)
        return np.asarray(self.controller.torque(robot)[6:])


class Tsid:
    """The weighted program of TSID; its joints are those of the model, in their order by name."""

    name = "tsid"

    def __init__(self, model: mujoco.MjModel, qpos: Vector, path: Path) -> None:
        self.wanted = tasks_of(model, qpos)
        folders = pin.StdVec_StdString()
        folders.append(str(path.parents[3]))
        self.robot = tsid.RobotWrapper(str(path), folders, pin.JointModelFreeFlyer(), False)
        pinocchio, names = self.robot.model(), [model.joint(j).name for j in range(1, model.njnt)]
        self.order = np.array([pinocchio.joints[pinocchio.getJointId(n)].idx_v - 6 for n in names])
        self.dt = float(model.opt.timestep)
        self.problem = tsid.InverseDynamicsFormulationAccForce("tsid", self.robot, False)
        q, v = self.state(qpos, np.zeros(model.nv))
        self.problem.computeProblemData(0.0, q, v)
        self.tasks: list[Any] = []
        for foot in self.wanted.feet:
            self.add_contact(foot)
        self.add_motions(q)
        self.add_limits(model)
        self.solver = tsid.SolverHQuadProgFast("solver")
        self.solver.resize(self.problem.nVar, self.problem.nEq, self.problem.nIn)

    def state(self, qpos: Vector, qvel: Vector) -> tuple[Vector, Vector]:
        """Of MuJoCo in Pinocchio's order: (nq), (nv); the root's velocity in its own axes."""
        q, v = np.empty(len(qpos)), np.empty(len(qvel))
        q[:3], q[3:6], q[6] = qpos[:3], qpos[4:7], qpos[3]
        turn = pin.Quaternion(q[6], q[3], q[4], q[5]).toRotationMatrix()
        v[:3], v[3:6] = turn.T @ qvel[:3], qvel[3:6]
        q[7:][self.order], v[6:][self.order] = qpos[7:], qvel[6:]
        return q, v

    def frame(self, name: str) -> pin.SE3:
        """Where a frame is, as the problem was last computed."""
        return self.robot.framePosition(self.problem.data(), self.robot.model().getFrameId(name))

    def add_contact(self, foot: hurcules.ContactTask) -> None:
        """A foot with the points that ours has."""
        up, points = np.array([0.0, 0.0, 1.0]), np.asarray(foot.points)
        if len(points) < 3:
            raise hurcules.Error(f"{foot.name} is a point")
        place, gain = self.frame(foot.name), np.ones(6)
        normal = place.rotation.T @ up
        contact = tsid.Contact6d(
            foot.name, self.robot, foot.name, points.T.copy(), normal, FRICTION, LEAST, MOST
        )
        contact.setKp(0.0 * gain)
        contact.setKd(GAINS.damping * gain)
        contact.setReference(place)
        self.problem.addRigidContact(contact, WEIGHTS["forces"])
        self.tasks.append(contact)

    def add_motion(self, task: Any, size: int, weight: float, value: Vector, rates: int) -> Any:
        """A task with our gains that holds `value`; its sample."""
        task.setKp(GAINS.stiffness * np.ones(size))
        task.setKd(GAINS.damping * np.ones(size))
        sample = tsid.TrajectorySample(len(value), rates)
        sample.value(value)
        sample.derivative(np.zeros(rates))
        sample.second_derivative(np.zeros(rates))
        task.setReference(sample)
        self.problem.addMotionTask(task, weight, 1, 0.0)
        self.tasks.append(task)
        return sample

    def add_motions(self, q: Vector) -> None:
        """Centre of mass, root, hand, posture."""
        robot = self.robot
        com = np.array(robot.com(self.problem.data()))
        soles = [
            self.frame(foot.name).act(np.asarray(foot.points).mean(axis=0))
            for foot in self.wanted.feet
        ]
        com[:2] = np.mean(soles, axis=0)[:2]
        self.add_motion(tsid.TaskComEquality("com", robot), 3, WEIGHTS["task"], com, 3)
        root = robot.model().frames[2].name
        turned = tsid.TaskSE3Equality("root", robot, root)
        turned.setMask(np.array([0.0, 0, 0, 1, 1, 1]))
        value = tsid.SE3ToVector(self.frame(root))
        self.add_motion(turned, 6, WEIGHTS["task"], value, 6)
        self.hand = tsid.TaskSE3Equality("hand", robot, self.wanted.frame)
        self.hand.setMask(np.array([1.0, 1, 1, 0, 0, 0]))
        self.hand.useLocalFrame(False)
        self.aim = tsid.SE3ToVector(self.frame(self.wanted.frame))
        self.sample = self.add_motion(self.hand, 6, WEIGHTS["task"], self.aim, 6)
        posture = tsid.TaskJointPosture("posture", robot)
        joints = robot.na
        self.add_motion(posture, joints, WEIGHTS["posture"], q[7:], joints)

    def add_limits(self, model: mujoco.MjModel) -> None:
        """Torques, positions and velocities."""
        coordinates = self.wanted.robot.coordinates[6:]

        def sorted_by(values: Any) -> Vector:
            answer = np.empty(len(self.order))
            answer[self.order] = np.clip(np.array(values, dtype=float), -1e3, 1e3)
            return answer

        torque = sorted_by(model.actuator_forcerange[:, 1])
        bounds = tsid.TaskActuationBounds("torque", self.robot)
        bounds.setBounds(-torque, torque)
        self.problem.addActuationTask(bounds, 1.0, 0, 0.0)
        limits = tsid.TaskJointPosVelAccBounds("limits", self.robot, self.dt, False)
        limits.setPositionBounds(
            sorted_by([c.lower for c in coordinates]), sorted_by([c.upper for c in coordinates])
        )
        limits.setVelocityBounds(sorted_by([c.max_velocity for c in coordinates]))
        limits.setAccelerationBounds(GAINS.max_acceleration * np.ones(len(self.order)))
        self.problem.addMotionTask(limits, 1.0, 0, 0.0)
        self.tasks += [bounds, limits]

    def lead(self, velocity: Vector) -> None:
        """The hand's target goes on for a period; velocity (3,) [m/s]."""
        self.aim[:3] += self.dt * velocity
        self.sample.value(self.aim)
        self.sample.derivative(np.concatenate([velocity, np.zeros(3)]))
        self.hand.setReference(self.sample)

    def torque(self, qpos: Vector, qvel: Vector) -> Vector:
        """(m,) [N m] of the joints."""
        problem = self.problem.computeProblemData(0.0, *self.state(qpos, qvel))
        solution = self.solver.solve(problem)
        if solution.status != 0:
            raise hurcules.Error(f"no solution, status {solution.status}")
        return np.asarray(self.problem.getActuatorForces(solution))[self.order]


class Loop:
    """A law around MuJoCo."""

    def __init__(self, model: mujoco.MjModel, qpos: Vector, law: Ours | Tsid) -> None:
        self.model, self.law, self.data = model, law, mujoco.MjData(model)
        self.data.qpos[:] = qpos
        mujoco.mj_forward(model, self.data)
        self.height = float(qpos[2])
        self.times: list[float] = []

    def go(self, seconds: float, velocity: Vector | None = None) -> None:
        """Runs, the hand's target at a velocity (3,) [m/s]."""
        velocity = np.zeros(3) if velocity is None else velocity
        for _ in range(round(seconds / self.model.opt.timestep)):
            self.law.lead(velocity)
            begun = time.perf_counter()
            torque = self.law.torque(self.data.qpos, self.data.qvel)
            self.times.append(time.perf_counter() - begun)
            self.data.ctrl[:] = torque
            mujoco.mj_step(self.model, self.data)
            if abs(self.data.qpos[2] - self.height) > FALLEN:
                raise hurcules.Error(f"falls after {self.data.time:.2f} s")


LAWS = (Ours, Tsid)


def loop_of(law: type[Ours] | type[Tsid], model: mujoco.MjModel, qpos: Vector, path: Path) -> Loop:
    """A robot by a law, in a posture."""
    return Loop(model, qpos, law(model, qpos, path))


def pushed(loop: Loop, impulse: Vector) -> bool:
    """Whether the robot stands again, 4 s after a push [N s]."""
    try:
        loop.go(1.0)
        before = loop.data.qpos[:3].copy()
        loop.data.xfrc_applied[1, :3] = impulse / 0.1
        loop.go(0.1)
        loop.data.xfrc_applied[1, :3] = 0.0
        loop.go(4.0)
    except hurcules.Error:
        return False
    return stands(loop.data, before)


def row(loop: Loop) -> str:
    """What a robot does by a law, in words, without pushes."""
    tasks, data = loop.law.wanted, loop.data
    loop.go(2.0)
    feet = np.array([data.body(foot).xpos for foot in tasks.names])
    aim = data.body(tasks.frame).xpos + np.array([REACH, 0, 0])
    loop.go(1.0, np.array([REACH, 0, 0]))
    loop.go(2.0)
    slid = np.linalg.norm(np.array([data.body(f).xpos for f in tasks.names]) - feet, axis=1).max()
    error = np.linalg.norm(data.body(tasks.frame).xpos - aim)
    median, worst = 1e6 * np.quantile(loop.times, [0.5, 0.99])
    return (
        f"hand {1e3 * error:.2f} mm, feet slid {1e3 * slid:.2f} mm, "
        f"{np.abs(data.qvel).max():.4f} rad/s, tick {median:.0f} us, p99 {worst:.0f} us"
    )


def kept_pushes(make: Callable[[], Loop], mass: float) -> str:
    """The largest push of each direction after which the robot stands again, in words."""
    text = ""
    for name, direction in DIRECTIONS.items():
        kept = 0.0
        for speed in SPEEDS:
            if not pushed(make(), mass * speed * np.array(direction, dtype=float)):
                break
            kept = speed
        text += f", {name} {kept:.1f} m/s"
    return text


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--only", default="", help="files whose path contains this")
    parser.add_argument("--pushes", action="store_true", help="push them too")
    given = parser.parse_args()
    warnings.simplefilter("ignore")
    for package, path in places():
        if package != "example_robot_data" or given.only not in str(path):
            continue
        if path.stem not in SOLES:
            continue
        model = hurcules.load_urdf(path, floating=True)
        qpos = posture_of(model, path)
        if qpos is None:
            continue
        mass = float(model.body_subtreemass[1])
        for law in LAWS:
            make = partial(loop_of, law, model, qpos, path)
            try:
                text = row(make()) + (kept_pushes(make, mass) if given.pushes else "")
            except hurcules.Error as error:
                text = str(error)
            print(f"{path.stem}, {law.name}: {text}", flush=True)


if __name__ == "__main__":
    main()
