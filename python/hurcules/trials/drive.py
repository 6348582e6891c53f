"""The driver of the test methods: the robot's drive controller, fed with what its sensors tell.

It stands in for an operator: keeps to a line and to a speed, or parks, with all joints on their
brakes. `Chassis` is what anyone needs who drives a robot in plain physics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules._core import DriveController, DriveOptions, ParkingOptions
from hurcules.trials.brakes import BeltBrakes

__all__ = ["Chassis", "LineDriver", "Motion", "drive_options", "yaw_of"]

# [m] of the drive pose: forward of the knee axis, where turns in place were measured to be about
TURN_CENTRE = -0.40


@dataclass(frozen=True)
class Motion:
    """What the drive controller measures."""

    left: float  # [rad/s] of the driven belts
    right: float
    yaw_rate: float  # [rad/s] about the vertical
    speed: float  # [m/s] over ground along the heading
    pose: tuple[float, float, float]  # x, y [m] of the knee axis, heading [rad]


def drive_options(model: mujoco.MjModel, steps: int = 1) -> DriveOptions:
    """The options of a robot's drive controller.

    Args:
        model: with a robot.
        steps: of the physics in one control period.
    """
    root = model.body("upper_legs").id
    mass = float(model.body_subtreemass[root])
    peak = float(model.actuator_forcerange[model.actuator("L_drive").id, 1])
    return DriveOptions(
        dt=steps * float(model.opt.timestep),
        mass=mass,
        max_torque=peak,
        parking=ParkingOptions(turn_centre=TURN_CENTRE),
    )


class Chassis:
    """A robot's drives: measures, lets the drive controller decide, and writes what it wants."""

    def __init__(self, model: mujoco.MjModel, options: DriveOptions) -> None:
        self.controller = DriveController(options)
        self._brakes = BeltBrakes(model)
        self._body = model.body("upper_legs").id
        dofs = [model.jnt_dofadr[model.joint(f"{side}_lower_belt").id] for side in "LR"]
        self._left, self._right = (int(dof) for dof in dofs)
        self._motors = [model.actuator(f"{side}_drive").id for side in "LR"]

    def sense(self, data: mujoco.MjData) -> Motion:
        """What belts, gyro and localisation tell, without noise."""
        axes = data.xmat[self._body]
        # the track axle is level however the legs are folded: forward is at right angles to it
        forward = np.array([axes[4], -axes[1]]) / math.hypot(axes[1], axes[4])
        x, y, _ = data.xpos[self._body]
        # of the free joint: velocity in the world, rates in the body
        rate = float(axes[6:9] @ data.qvel[3:6])
        return Motion(
            float(data.qvel[self._left]),
            float(data.qvel[self._right]),
            rate,
            float(forward @ data.qvel[0:2]),
            (float(x), float(y), math.atan2(forward[1], forward[0])),
        )

    def act(self, data: mujoco.MjData, motion: Motion) -> None:
        """One period of the controller; writes torques and brakes."""
        torques = self.controller.compute(
            motion.left, motion.right, motion.yaw_rate, motion.speed, motion.pose
        )
        data.ctrl[self._motors] = torques
        self._brakes.set(self.controller.braked)


class LineDriver:
    """Drives along y = 0, forward or backward, and stands on its brakes at speed 0.

    Attributes:
        chassis: the drives.
    """

    def __init__(
        self, model: mujoco.MjModel, steps: int, line_gain: float = 0.5, yaw_gain: float = 1.5
    ) -> None:
        """Takes over a robot.

        Args:
            model: with a robot.
            steps: of the physics between two calls.
            line_gain: [rad/m] heading against the offset from the line.
            yaw_gain: [1/s].
        """
        self.chassis = Chassis(model, drive_options(model, steps))
        self.line_gain, self.yaw_gain = line_gain, yaw_gain

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData, speed: float) -> None:
        """Writes torques and brakes of the drives.

        Args:
            model: with the robot.
            data: its state; `ctrl` is written.
            speed: [m/s] along x, < 0 backward.
        """
        motion = self.chassis.sense(data)
        _, y, yaw = motion.pose
        turn = 0.0
        if speed != 0.0:
            wanted = -self.line_gain * y * math.copysign(1.0, speed)
            turn = self.yaw_gain * (min(max(wanted, -0.3), 0.3) - yaw)
        self.chassis.controller.drive(speed, turn)
        self.chassis.act(data, motion)


def yaw_of(data: mujoco.MjData) -> float:
    """Returns where the robot looks [rad], 0 along x."""
    axes = data.body("upper_legs").xmat
    return math.atan2(-axes[1], axes[4])
