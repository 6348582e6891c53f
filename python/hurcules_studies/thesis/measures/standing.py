"""A robot standing on its tracks in the physics, its joints led by the servo along a reference.

The gains follow the rule of the missions (joint_pid.hpp, `triple_pole`): a joint's inertia is the
largest along the reference without load, its bandwidth at least the one below, and more where its
dry friction asks for it.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "Followed", "drives_of", "led"]

DT = 1e-3  # [s]
BANDWIDTH = {"SP": 30.0, "SR": 30.0, "SY": 40.0, "EB": 50.0, "NKY": 60.0, "NKP": 60.0}  # [rad/s]
LEAST_BANDWIDTH, MOST_BANDWIDTH = 20.0, 100.0  # [rad/s]
FRICTION_BEND = 2e-3  # [rad] by which a reversal of dry friction may bend a joint
BELT = (7.0, 20.0)  # [kg m^2], [rad/s]: half the robot hangs on each belt, the drives brake


@dataclass(frozen=True)
class Drive:
    """A motor that is servoed: its joint, its coordinate (-1: held where it is) and its gains."""

    name: str
    motor: int
    qpos: int
    dof: int
    coordinate: int
    factor: float
    inertia: float
    bandwidth: float
    peak: float


@dataclass(frozen=True)
class Followed:
    """What the physics made of a reference; (ticks,), (ticks, drives).

    Attributes:
        names: of the joints.
        time: [s].
        error: [rad], reference minus measured.
        saturated: (ticks,) whether a motor of a coordinate wanted more than its peak.
        slipped: [m] that the base moved in the end.
    """

    names: list[str]
    time: Array
    error: Array
    saturated: NDArray[np.bool_]
    slipped: float

    def of(self, *prefixes: str) -> Array:
        """The errors of the joints whose names begin so, (ticks, some)."""
        return self.error[:, [i for i, name in enumerate(self.names) if name.startswith(prefixes)]]


def drives_of(robot: hurcules.Robot, model: mujoco.MjModel, q: Array) -> list[Drive]:
    """The motors of a robot with gains for a reference.

    Args:
        robot: standing on its support.
        model: its model.
        q: (ticks, n) [rad] the reference.
    """
    inertia = np.zeros(robot.size)
    for sample in q[:: max(1, len(q) // 20)]:
        robot.set_configuration(sample)
        inertia = np.maximum(inertia, np.diag(robot.mass_matrix()))
    drives = []
    for i, coordinate in enumerate(robot.coordinates):
        for joint in coordinate.joints:
            J = float(inertia[i]) / len(coordinate.joints)
            friction = float(model.dof_frictionloss[joint.dof])
            least = BANDWIDTH.get(coordinate.name.lstrip("LR"), LEAST_BANDWIDTH)
            omega = np.clip(np.sqrt(0.54 * friction / (J * FRICTION_BEND)), least, MOST_BANDWIDTH)
            name = model.joint(joint.joint).name
            peak = float(model.actuator_forcerange[joint.actuator, 1])
            drives.append(
                Drive(
                    name,
                    joint.actuator,
                    joint.qpos,
                    joint.dof,
                    i,
                    joint.factor,
                    J,
                    float(omega),
                    peak,
                )
            )
    for side in "LR":
        motor, joint_id = model.actuator(f"{side}_drive").id, model.joint(f"{side}_lower_belt")
        place = int(joint_id.qposadr[0]), int(joint_id.dofadr[0])
        peak = float(model.actuator_forcerange[motor, 1])
        drives.append(Drive(joint_id.name, motor, *place, -1, 1.0, *BELT, peak))
    return drives


def servo(drives: list[Drive]) -> hurcules.JointPid:
    """K + 1 / gamma^2 = 3 omega J, K_P = omega, K_I = omega^2 / 3."""
    J = np.array([drive.inertia for drive in drives])
    omega = np.array([drive.bandwidth for drive in drives])
    # gamma as large as the softest joint needs: K stays positive
    gamma = 1.0 / np.sqrt(min(1.0, 0.5 * float((3 * omega * J).min())))
    options = hurcules.JointPidOptions(
        K=3.0 * omega * J - 1.0 / gamma**2,
        K_P=omega,
        K_I=omega**2 / 3.0,
        gamma=gamma,
        max_torque=[drive.peak for drive in drives],
        dt=DT,
    )
    return hurcules.JointPid(options)


def led(model: mujoco.MjModel, qpos: Array, drives: list[Drive], q: Array, qd: Array) -> Followed:
    """Leads the robot along a reference.

    Args:
        model: the robot, with what it carries.
        qpos: (nq,) where it starts, at rest.
        drives: its motors.
        q: (ticks, n) [rad] the reference.
        qd: (ticks, n) [rad/s] its velocity.
    """
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_forward(model, data)
    pid = servo(drives)
    motors, places, dofs = (
        np.array([getattr(drive, name) for drive in drives]) for name in ("motor", "qpos", "dof")
    )
    led_by = np.array([drive.coordinate for drive in drives])
    factor = np.array([drive.factor for drive in drives]) * (led_by >= 0)
    gear = model.actuator_gear[motors, 0]
    # a joint follows its coordinate from where it started
    offset = data.qpos[places] - factor * q[0, led_by]
    errors, saturated = np.zeros((len(q), len(drives))), np.zeros(len(q), dtype=bool)
    peaks = np.array([drive.peak if drive.coordinate >= 0 else np.inf for drive in drives])
    start = data.qpos[:2].copy()
    for i in range(len(q)):
        errors[i] = offset + factor * q[i, led_by] - data.qpos[places]
        data.ctrl[motors] = pid.compute(errors[i], factor * qd[i, led_by] - data.qvel[dofs]) / gear
        saturated[i] = np.any(np.abs(pid.demand) > peaks)
        hurcules.step(model, data)
    slipped = float(np.linalg.norm(data.qpos[:2] - start))
    names = [drive.name for drive in drives]
    return Followed(
        names, np.asarray(DT * np.arange(len(q)), dtype=np.float64), errors, saturated, slipped
    )
