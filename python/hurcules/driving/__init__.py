"""Driving a robot in plain physics: its chassis, and brakes as friction.

`Chassis(model, drive_options(model))` reads the sensors, runs the drive controller and writes
torques and brakes; `hold_joints(model)` keeps the posture meanwhile.
"""

from hurcules.driving.brakes import BeltBrakes, hold_joints, release_joint
from hurcules.driving.chassis import Chassis, drive_options, yaw_of

__all__ = [
    "BeltBrakes",
    "Chassis",
    "drive_options",
    "hold_joints",
    "release_joint",
    "yaw_of",
]
