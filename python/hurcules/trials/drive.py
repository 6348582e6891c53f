"""The plainest driver: keeps to a line and to a speed, with all joints on their brakes.

It stands in for an operator until the robot has a drive controller; whatever is called once in ten
milliseconds with model and data and writes the drives' torques can take its place.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

__all__ = ["StraightDriver", "hold_joints", "yaw_of"]

# friction that holds: hurcules-facts.md A9
BRAKE_SOLREF, BRAKE_SOLIMP = (0.004, 1.0), (0.9999, 0.9999, 0.001, 0.5, 2.0)
BRAKE_FACTOR = 1.2  # of the peak torque


@dataclass
class StraightDriver:
    """Drives along y = 0, forward or backward."""

    gain: float = 800.0  # [N m s/rad] belt speed to torque
    radius: float = 0.14  # [m] of the belts
    gauge: float = 0.67  # [m] between the driven belts
    line_gain: float = 0.5  # [rad/m] heading against the offset from the line
    yaw_gain: float = 1.5  # [1/s]

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData, speed: float) -> None:
        """Writes the torques of the drives.

        Args:
            model: with a robot.
            data: its state; `ctrl` is written.
            speed: [m/s] along x, < 0 backward.
        """
        y, yaw = float(data.body("upper_legs").xpos[1]), yaw_of(data)
        wanted = float(np.clip(-self.line_gain * y * math.copysign(1.0, speed), -0.3, 0.3))
        turn = self.yaw_gain * (wanted - yaw) * self.gauge / 2
        for side, sign in (("L", -1.0), ("R", 1.0)):
            rate = (speed + sign * turn) / self.radius
            torque = self.gain * (rate - data.joint(f"{side}_lower_belt").qvel[0])
            peak = model.actuator(f"{side}_drive").ctrlrange[1]
            data.actuator(f"{side}_drive").ctrl[0] = np.clip(torque, -peak, peak)


def yaw_of(data: mujoco.MjData) -> float:
    """Returns where the robot looks [rad], 0 along x."""
    axes = data.body("upper_legs").xmat
    return math.atan2(axes[3], axes[0])


def hold_joints(model: mujoco.MjModel) -> None:
    """Puts the robot's joints, not its belts, on their brakes: friction beyond the peak torque."""
    root = model.body("upper_legs").id
    for motor in range(model.nu):
        joint = int(model.actuator_trnid[motor, 0])
        mine = model.body_rootid[model.jnt_bodyid[joint]] == root
        if mine and not model.joint(joint).name.endswith("_belt"):
            dof = model.jnt_dofadr[joint]
            model.dof_frictionloss[dof] = BRAKE_FACTOR * model.actuator_forcerange[motor, 1]
            model.dof_solref[dof], model.dof_solimp[dof] = BRAKE_SOLREF, BRAKE_SOLIMP
