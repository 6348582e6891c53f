"""The drives of a robot in plain physics: sensed, controlled, braked."""

from __future__ import annotations

import math

import mujoco

from hurcules._core import (
    DriveController,
    DriveOptions,
    DriveState,
    ParkingOptions,
    Robot,
    TrackDrive,
)
from hurcules.driving.brakes import BeltBrakes

__all__ = ["Chassis", "drive_options", "yaw_of"]

# [m] of the drive pose: forward of the knee axis, where turns in place were measured to be about
TURN_CENTRE = -0.42


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
        self._drive = TrackDrive(Robot(model), options)
        self.controller: DriveController = self._drive.controller
        self._brakes = BeltBrakes(model)
        self._motors = [model.actuator(f"{side}_drive").id for side in "LR"]

    def sense(self, data: mujoco.MjData) -> DriveState:
        """What belts, gyro and localisation tell, without noise."""
        return self._drive.measure(data.qpos, data.qvel)

    def act(self, data: mujoco.MjData, motion: DriveState) -> None:
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
