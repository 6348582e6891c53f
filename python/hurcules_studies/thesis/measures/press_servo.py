"""The servos of the missions for a robot whose references come from Python."""

from __future__ import annotations

import mujoco
import numpy as np

import hurcules
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["Servo"]


class Servo:
    """One robust PID at every motor, gains of the table of the missions.

    Attributes:
        largest: [rad] error of the joint of a coordinate that is furthest off.
    """

    def __init__(self, model: mujoco.MjModel, plan: hurcules.Robot, bandwidth: float = 1.0) -> None:
        """Holds what is.

        Args:
            model: of the robot; the motors that no coordinate drives keep their places.
            plan: at the start.
            bandwidth: of all servos, over that of the table.
        """
        table = hurcules.servo_table("rescue")
        joints = [model.joint(int(joint)) for joint in model.actuator_trnid[: model.nu, 0]]
        inertia, omega = np.array([table[joint.name] for joint in joints]).T
        omega = bandwidth * omega
        gain = 3.0 * omega * inertia  # K + 1 / gamma^2 of the triple pole (joint_pid.hpp)
        gamma = 1.0 / np.sqrt(min(1.0, 0.5 * float(gain.min())))
        self._pid = hurcules.JointPid(
            hurcules.JointPidOptions(
                K=gain - 1.0 / gamma**2,
                K_P=omega,
                K_I=omega**2 / 3.0,
                gamma=gamma,
                max_torque=model.actuator_forcerange[: model.nu, 1],
            )
        )
        self._qpos = np.array([int(joint.qposadr[0]) for joint in joints])
        self._dof = np.array([int(joint.dofadr[0]) for joint in joints])
        self._gear = model.actuator_gear[: model.nu, 0].copy()
        self._coordinate = np.full(model.nu, -1)
        self._factor = np.zeros(model.nu)
        for i, coordinate in enumerate(plan.coordinates):
            for joint in coordinate.joints:
                if joint.actuator >= 0:
                    self._coordinate[joint.actuator] = i
                    self._factor[joint.actuator] = joint.factor
        self._led = self._coordinate >= 0
        self._hold = plan.qpos[self._qpos]
        self.largest = 0.0

    def act(self, plan: hurcules.Robot, speed: Array, data: mujoco.MjData) -> None:
        """Writes the torques towards the reference: its configuration, and its speed (n,)."""
        led, factor = self._led, self._factor
        place = np.where(led, factor * plan.configuration[self._coordinate], self._hold)
        error = place - data.qpos[self._qpos]
        rate = factor * speed[self._coordinate] - data.qvel[self._dof]
        data.ctrl[:] = self._pid.compute(error, rate) / self._gear
        self.largest = float(np.abs(error[led]).max())
