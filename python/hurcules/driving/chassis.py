"""The drives of a robot in plain physics: sensed, controlled, braked."""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules._core import DriveController, DriveOptions, ParkingOptions
from hurcules.driving.brakes import BeltBrakes

__all__ = ["Chassis", "Motion", "drive_options", "yaw_of"]

# [m] of the drive pose: forward of the knee axis, where turns in place were measured to be about
TURN_CENTRE = -0.42


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


def yaw_of(data: mujoco.MjData) -> float:
    """Returns where the robot looks [rad], 0 along x."""
    axes = data.body("upper_legs").xmat
    return math.atan2(-axes[1], axes[4])
