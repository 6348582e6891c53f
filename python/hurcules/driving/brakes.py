"""Brakes as friction: of the joints, which hold a posture, and of the belts, which hold a place."""

from __future__ import annotations

import mujoco
import numpy as np

__all__ = ["BeltBrakes", "hold_joints", "release_joint"]

# friction that holds: docs/design/robot.md#joints
BRAKE_SOLREF, BRAKE_SOLIMP = (0.004, 1.0), (0.9999, 0.9999, 0.001, 0.5, 2.0)
BRAKE_FACTOR = 1.2  # of the peak torque


def hold_joints(model: mujoco.MjModel) -> None:
    """Puts the robot's joints, not its belts, on their brakes: friction beyond the peak torque."""
    root = model.body("upper_legs").id
    for motor in range(model.nu):
        joint = int(model.actuator_trnid[motor, 0])
        mine = model.body_rootid[model.jnt_bodyid[joint]] == root
        if mine and not model.joint(joint).name.endswith("_belt"):
            _set_friction(
                model, model.jnt_dofadr[joint], BRAKE_FACTOR * model.actuator_forcerange[motor, 1]
            )


def release_joint(model: mujoco.MjModel, joint: str, braked: bool) -> None:
    """Opens or shuts the brake of one joint with a motor; open, 3 % friction stays."""
    motor = int(np.flatnonzero(model.actuator_trnid[:, 0] == model.joint(joint).id)[0])
    peak = model.actuator_forcerange[motor, 1]
    factor = BRAKE_FACTOR if braked else 0.03
    _set_friction(model, model.jnt_dofadr[model.joint(joint).id], factor * peak)


class BeltBrakes:
    """The brakes of both drives; the friction that the ground gives the belts stays."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._dofs = [model.jnt_dofadr[model.joint(f"{s}_lower_belt").id] for s in "LR"]
        self._open = [float(model.dof_frictionloss[dof]) for dof in self._dofs]
        self._shut = [
            BRAKE_FACTOR * model.actuator_forcerange[model.actuator(f"{s}_drive").id, 1]
            for s in "LR"
        ]
        self._braked = False

    def set(self, braked: bool) -> None:
        """Shuts or opens both."""
        if braked == self._braked:
            return
        self._braked = braked
        for dof, torque in zip(self._dofs, self._shut if braked else self._open, strict=True):
            _set_friction(self._model, dof, torque)


def _set_friction(model: mujoco.MjModel, dof: int, torque: float) -> None:
    model.dof_frictionloss[dof] = torque
    model.dof_solref[dof], model.dof_solimp[dof] = BRAKE_SOLREF, BRAKE_SOLIMP
