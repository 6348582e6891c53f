"""Helpers of the scene tests: a robot that holds its joints, and what touches it."""

from dataclasses import dataclass

import mujoco
import numpy as np

import hurcules

BRAKE = (
    [0.004, 1.0],
    [0.9999, 0.9999, 0.001, 0.5, 2.0],
)  # [robot#joints] friction that holds


@dataclass(frozen=True)
class Stay:
    """What happened while a robot stood."""

    moved: float  # [m] the base
    deepest: float  # [m] largest overlap of the robot with anything
    warnings: int
    finite: bool


def motor_peak(model: mujoco.MjModel, joint: int) -> float:
    """Peak torque or force of a joint's motor, that of the drive for belts without one."""
    motors = np.flatnonzero(model.actuator_trnid[:, 0] == joint)
    return float(model.actuator_forcerange[motors[0], 1]) if len(motors) else 600.0


def brake(model: mujoco.MjModel, factor: float = 1.2) -> None:
    """Holds all joints of the robot by friction of `factor` times their peak torque, belts too.

    Not the springs of the suspension.
    """
    root = model.body("upper_legs").id
    for joint in range(model.njnt):
        body = model.jnt_bodyid[joint]
        if model.body_rootid[body] != root or model.jnt_type[joint] == mujoco.mjtJoint.mjJNT_FREE:
            continue
        if "_spring" in model.joint(joint).name:  # the suspension has no brakes
            continue
        dof = model.jnt_dofadr[joint]
        belt = model.joint(joint).name.endswith("_belt")
        model.dof_frictionloss[dof] = factor * motor_peak(model, joint) * (3 if belt else 1)
        model.dof_solref[dof], model.dof_solimp[dof] = BRAKE


def robot_geoms(model: mujoco.MjModel) -> np.ndarray:
    """For each geom whether it is the robot's."""
    return model.body_rootid[model.geom_bodyid] == model.body("upper_legs").id


def overlap(model: mujoco.MjModel, data: mujoco.MjData) -> float:
    """Deepest contact of the robot [m], 0 for none."""
    touches = robot_geoms(model)[data.contact.geom].any(axis=1)
    return float(-data.contact.dist[touches].min(initial=0.0))


def stand(model: mujoco.MjModel, key: str, seconds: float = 0.5) -> Stay:
    """Puts the robot into a keyframe and lets it stand there with its brakes on."""
    brake(model)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key(key).id)
    mujoco.mj_forward(model, data)
    start, deepest = data.body("upper_legs").xpos.copy(), overlap(model, data)
    for _ in range(round(seconds / model.opt.timestep / 10)):
        hurcules.step(model, data, 10)
        deepest = max(deepest, overlap(model, data))
    moved = float(np.linalg.norm(data.body("upper_legs").xpos - start))
    warnings = int(data.warning.number.sum())
    return Stay(moved, deepest, warnings, bool(np.isfinite(data.qpos).all()))
