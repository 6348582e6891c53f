"""Force control by torques in the physics: gymnasium's pusher presses on springs, still and moving.

Run:  python benchmarks/force_torques.py

The arm of seven joints has motors without servos: they give what `AccelerationController.torque`
says at 1 kHz, MuJoCo goes on in steps of 0.25 ms. The wall is a spring of G on one side of a plane,
its force the reading. The arm comes down at 20 mm/s. The stack is `limits < force < place in the
plane < posture`, the law the first-order one with C G = 30 1/s, 100 1/s on the moving wall.

Told: the force of the last half second and its deviation, the largest force beside that of a plain
admittance (`blend` = 0: v = C (f_des - f) from the first contact on), how often contact was lost;
then the deviation on a wall that moves by 5 mm at 0.5 Hz. By the law alone it is
2 pi 0.5 Hz 5 mm / C.
"""

from __future__ import annotations

import importlib.util
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules

DT = 1e-3  # [s] of control
STEPS = 4  # of the physics in it
SPEED = 0.02  # [m/s] of the approach
GAP = 0.01  # [m] before it
TIP = "tips_arm"
POSTURE = (0.2, 0.3, 0.0, -0.8, 0.0, -0.5, 0.0)  # [rad]
STIFFNESSES = (1e3, 1e4, 1e5)  # [N/m]
FORCES = (5.0, 50.0)  # [N]

Vector = NDArray[np.float64]


@dataclass(frozen=True)
class Wall:
    """A spring that rises and falls."""

    stiffness: float  # [N/m]
    stroke: float = 0.0  # [m] amplitude
    frequency: float = 0.5  # [Hz]

    def height(self, time: float) -> float:
        """Above its place at the start [m]."""
        return self.stroke * float(np.sin(2 * np.pi * self.frequency * time))


@dataclass(frozen=True)
class Result:
    """What an arm that pressed has read, all in [N], pressing positive."""

    force: Vector

    @property
    def settled(self) -> float:
        """Mean of the last half second."""
        return float(self.force[-500:].mean())

    @property
    def peak(self) -> float:
        """Largest force."""
        return float(self.force.max())

    @property
    def losses(self) -> int:
        """How often contact was lost."""
        return int(np.count_nonzero(np.diff((self.force > 0).astype(int)) < 0))

    def deviation(self, wanted: float, seconds: float) -> float:
        """Root mean square of the last seconds about a force."""
        return float(np.sqrt(np.mean((self.force[-round(seconds / DT) :] - wanted) ** 2)))


def arm() -> mujoco.MjModel:
    """The pusher without contacts and without its motors: torques are applied."""
    spec = importlib.util.find_spec("gymnasium")
    assert spec is not None and spec.origin is not None
    path = Path(spec.origin).parent / "envs/mujoco/assets/pusher_v5.xml"
    made = mujoco.MjSpec.from_file(str(path))
    made.option.timestep = DT / STEPS
    for geom in made.geoms:
        geom.contype = geom.conaffinity = 0
    for actuator in list(made.actuators):
        made.delete(actuator)
    return made.compile()


class Press:
    """The arm, its wall and its controller."""

    def __init__(
        self, wall: Wall, force: float, rate: float, blend: float = 0.1, bias: float = 0.0
    ) -> None:
        """Wants a force [N] by a law of C = rate / G, and reads it with a bias [N]."""
        self.wall = wall
        self.bias = bias
        self.model = arm()
        self.data = mujoco.MjData(self.model)
        joints = [self.model.joint(i).name for i in range(7)]
        self.robot = robot = hurcules.Robot(self.model, joints=joints)
        robot.set_configuration(np.array(POSTURE))
        self.data.qpos[:] = robot.qpos
        self.level = robot.position(TIP)[2] - GAP
        self.jacobian = np.zeros((3, self.model.nv))
        self.task = hurcules.ForceTask(
            "press",
            robot,
            TIP,
            axis=[0, 0, 1],
            force_des=-force,
            blend=blend,
            environment=wall.stiffness,
            gains=hurcules.ForceGains(compliance=rate / wall.stiffness, dt=DT),
            contact=hurcules.ContactOptions(f_max=1e3),
        )
        place = hurcules.PositionTask("place", robot, TIP, axes=np.eye(3)[:2])
        posture = hurcules.PostureTask("posture", robot)
        limits = hurcules.JointLimits("limits", robot)
        self.controller = hurcules.AccelerationController(
            robot, hurcules.AccelerationControllerOptions(dt=DT)
        )
        self.controller.set_stack(hurcules.Stack([limits, self.task, place, posture]))

    def run(self, seconds: float) -> Result:
        """Comes down, presses."""
        return Result(np.array([self._tick() for _ in range(round(seconds / DT))]))

    def _tick(self) -> float:
        pressed = self._push()
        self.robot.set_qpos(self.data.qpos)
        self.robot.set_velocity(self.data.qvel[:7])
        self.task.sense(self.robot, -pressed - self.bias)
        if self.task.contact == hurcules.ContactState.Free:
            self.task.advance([-SPEED], DT)
        self.controller.compute(self.robot)
        torque = self.controller.torque(self.robot)
        for _ in range(STEPS):
            self._push()
            self.data.qfrc_applied[:7] += torque
            mujoco.mj_step(self.model, self.data)
        return pressed

    def _push(self) -> float:
        """The wall pushes back; how hard [N]."""
        data, tip = self.data, self.model.body(TIP).id
        mujoco.mj_kinematics(self.model, data)
        mujoco.mj_comPos(self.model, data)
        depth = self.level + self.wall.height(data.time) - data.xpos[tip, 2]
        mujoco.mj_jacBody(self.model, data, self.jacobian, None, tip)
        force = float(max(0.0, self.wall.stiffness * depth))
        data.qfrc_applied[:] = force * self.jacobian[2]
        return force


def main() -> None:
    """Prints both tables."""
    print("| wall [N/m] | wanted [N] | settled [N] | deviation [N] | peak [N] | of plain | lost |")
    for stiffness in STIFFNESSES:
        for force in FORCES:
            ours = Press(Wall(stiffness), force, 30.0).run(3.0)
            plain = Press(Wall(stiffness), force, 30.0, blend=0.0).run(3.0)
            print(
                f"| {stiffness:.0e} | {force:.0f} | {ours.settled:.3f} | "
                f"{ours.deviation(force, 0.5):.4f} | {ours.peak:.1f} | "
                f"{ours.peak / plain.peak:.2f} | {ours.losses} |"
            )
    for rate in (50.0, 100.0, 200.0):
        moving = Press(Wall(1e4, stroke=0.005), 20.0, rate).run(6.0)
        print(f"moving wall, C G = {rate:.0f} 1/s: {moving.deviation(20.0, 4.0):.2f} N rms")


if __name__ == "__main__":
    main()
