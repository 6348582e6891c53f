"""A robot standing on its tracks in the closed loop, its joints led along a reference.

The servo is that of the missions: the gains stand in the models, and no load changes them.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

import hurcules
from hurcules import postures
from hurcules_studies.thesis.measures.problems import Array

__all__ = ["DT", "Followed", "led"]

DT = 1e-3  # [s]


@dataclass(frozen=True)
class Followed:
    """What the physics made of a reference; (ticks,), (ticks, joints).

    Attributes:
        names: of the joints with a motor.
        moved: how many of them, the first, follow the reference; the others hold their places.
        time: [s].
        error: [rad], reference minus measured.
        saturated: (ticks,) whether a motor that follows wanted more than its peak.
        slipped: [m] that the base moved in the end.
    """

    names: list[str]
    moved: int
    time: Array
    error: Array
    saturated: NDArray[np.bool_]
    slipped: float

    def of(self, *prefixes: str) -> Array:
        """The errors of the joints whose names begin so, (ticks, some)."""
        return self.error[:, [i for i, name in enumerate(self.names) if name.startswith(prefixes)]]


def led(model: mujoco.MjModel, qpos: Array, q: Array, qd: Array) -> Followed:
    """Leads the robot along a reference.

    Args:
        model: the robot, with what it carries.
        qpos: (nq,) where it starts, at rest.
        q: (ticks, n) [rad] the reference.
        qd: (ticks, n) [rad/s] its velocity.
    """
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    simulation = postures.joint_loop(model, data)
    controller = simulation.controller
    names = controller.joints
    pairs = [
        (i, joint.factor, model.joint(joint.joint).name)
        for i, coordinate in enumerate(hurcules.Robot(model).coordinates)
        for joint in coordinate.joints
    ]
    moved = len(pairs)
    assert [name for _, _, name in pairs] == names[:moved]
    of, factor = [i for i, _, _ in pairs], np.array([factor for _, factor, _ in pairs])
    place, speed = controller.joint_places, np.zeros(len(names))
    # a joint follows its coordinate from where it started
    offset = place[:moved] - factor * q[0, of]
    actuated = model.actuator_trnid[: model.nu, 0].tolist()
    motors = [actuated.index(model.joint(name).id) for name in names[:moved]]
    peak = model.actuator_forcerange[motors, 1]
    errors, saturated = np.zeros((len(q), len(names))), np.zeros(len(q), dtype=bool)
    start = data.qpos[:2].copy()
    for i in range(len(q)):
        place[:moved], speed[:moved] = offset + factor * q[i, of], factor * qd[i, of]
        controller.move_all(place, speed)
        if not simulation.step(1):
            raise hurcules.Error(f"the run is over: {simulation.reason}")
        errors[i] = controller.joint_error
        saturated[i] = np.any(np.abs(controller.demand[:moved]) > peak)
    slipped = float(np.linalg.norm(data.qpos[:2] - start))
    time = np.asarray(DT * np.arange(len(q)), dtype=np.float64)
    return Followed(names, moved, time, errors, saturated, slipped)
