"""Motors for a model that has none, as one out of a URDF."""

from __future__ import annotations

from pathlib import Path

import mujoco
import numpy as np

from hurcules._core import Error

__all__ = ["with_motors"]

_MOVING = (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_BALL)


def with_motors(
    model: str | Path | mujoco.MjSpec, peak: float | None = None, armature: float | None = None
) -> mujoco.MjModel:
    """A model with a motor, named after its joint, at each hinge and slide that has no actuator.

    A ball joint gets three, NAME_rx, NAME_ry and NAME_rz, about the axes of its body. Joints that
    equality constraints couple (mimic joints of a URDF) have one motor together, at the joint that
    leads, and none where one of them has an actuator. Joints without a name get one.
    A motor gives as much as the joint allows: `actuatorfrcrange` in MJCF, `effort` in a URDF.

    Args:
        model: file (MJCF or URDF), or a specification, which keeps the motors.
        peak: [N m] or [N] of a joint that says nothing; None: no limit.
        armature: [kg m^2] or [kg] of the rotor at a joint that has none; None: none.

    Raises:
        Error: a file that MuJoCo cannot read, or a number that is not above 0.
    """
    for name, number in (("peak", peak), ("armature", armature)):
        if number is not None and not number > 0.0:
            raise Error(f"with_motors: {name} wants a number above 0, got {number!r}")
    try:
        spec = model if isinstance(model, mujoco.MjSpec) else mujoco.MjSpec.from_file(str(model))
        for number, joint in enumerate(spec.joints):
            if joint.type in _MOVING and not joint.name:
                joint.name = f"joint{number}"  # as Robot calls it
        driven = {each.target for each in spec.actuators if _is_at_joint(each)}
        led = _led(spec, driven)
        for joint in spec.joints:
            if joint.type not in _MOVING or joint.name in driven or joint.name in led:
                continue
            if joint.type == mujoco.mjtJoint.mjJNT_BALL:
                for axis, part in enumerate(("_rx", "_ry", "_rz")):
                    motor = _add_motor(spec, joint, peak, part)
                    motor.gear = np.eye(6)[axis]
            else:
                _add_motor(spec, joint, peak)
            if armature is not None and joint.armature == 0.0:
                joint.armature = armature
        return spec.compile()
    except ValueError as error:
        raise Error(f"with_motors: {error}") from error


def _led(spec: mujoco.MjSpec, driven: set[str]) -> set[str]:
    """Joints that another one, which has or gets an actuator, moves by an equality constraint."""
    groups: dict[str, list[str]] = {}  # by each of its joints, the one that leads first
    for equality in spec.equalities:
        follower, leader = equality.name1, equality.name2
        if equality.type != mujoco.mjtEq.mjEQ_JOINT or not equality.active or not leader:
            continue
        group = groups.get(leader, [leader])
        group += [name for name in groups.get(follower, [follower]) if name not in group]
        groups.update(dict.fromkeys(group, group))
    return {
        name for name, group in groups.items() if name != group[0] or not driven.isdisjoint(group)
    }


def _is_at_joint(actuator: mujoco.MjsActuator) -> bool:
    return actuator.trntype in (
        mujoco.mjtTrn.mjTRN_JOINT,
        mujoco.mjtTrn.mjTRN_JOINTINPARENT,
    )


def _add_motor(
    spec: mujoco.MjSpec, joint: mujoco.MjsJoint, peak: float | None, part: str = ""
) -> mujoco.MjsActuator:
    motor = spec.add_actuator(name=joint.name + part, target=joint.name)
    motor.trntype = mujoco.mjtTrn.mjTRN_JOINT
    motor.set_to_motor()
    # what a <default> of the model says is meant for its own actuators: control in -1 to 1, say
    motor.gear = np.eye(6)[0]
    motor.ctrllimited = motor.actlimited = mujoco.mjtLimited.mjLIMITED_FALSE
    lower, upper = joint.actfrcrange
    if not lower < upper and peak is not None:
        lower, upper = -peak, peak
    limited = mujoco.mjtLimited
    motor.forcerange = [lower, upper]
    motor.forcelimited = limited.mjLIMITED_TRUE if lower < upper else limited.mjLIMITED_FALSE
    return motor
