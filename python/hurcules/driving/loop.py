"""The closed loop of a robot on tracks."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

import mujoco
from numpy.typing import ArrayLike

from hurcules._core import (
    DriveOptions,
    FallOptions,
    MonitorOptions,
    ParkingOptions,
    VelocityControllerOptions,
)
from hurcules.postures import joint_controller
from hurcules.simulation import Simulation

__all__ = ["drive_options", "simulation"]

# [m] of the drive pose: forward of the knee axis, where turns in place were measured to be about
TURN_CENTRE = -0.42


def drive_options(model: mujoco.MjModel) -> DriveOptions:
    """The options of a robot's drive controller.

    A transmission that keeps its motor at w_g lets P = w_g F through at speed, driving and braking,
    F the torque of the motor; of the drive train in cpp/hurcules/sim/drive_train.hpp.

    Args:
        model: with a robot.
    """
    root, options = model.body("upper_legs").id, DriveOptions()
    options.mass = float(model.body_subtreemass[root])
    options.max_torque = float(model.actuator_forcerange[model.actuator("L_drive").id, 1])
    options.parking = ParkingOptions(turn_centre=TURN_CENTRE)
    low, high, _, _, governed = model.numeric("transmission_L_lower_belt").data
    speed = model.numeric("velocity_limit_L_lower_belt").data[0]
    options.max_braking_power = float(governed * speed * high * options.max_torque / low)
    options.max_power = min(options.max_power, options.max_braking_power)
    return options


def simulation(
    model: mujoco.MjModel,
    qpos: ArrayLike | None = None,
    *,
    steps: int = 2,
    channels: Mapping[str, Any] | None = None,
    support: str = "",
    fall: FallOptions | None = None,
) -> Simulation:
    """A closed loop of a robot on tracks; every brake is shut, no stack rules.

    The drive controller shuts and opens the brakes of the tracks. A joint is moved by a channel
    `JointRates`, at once at the rate that is commanded, while its brake is open
    (`simulation.brakes`). Without a channel `Drive` the drive controller takes its commands itself:
    `simulation.controller.drive.drive(speed, yaw_rate)`, or `.park(x, y, yaw)`.

    Args:
        model: a scene with the robot.
        qpos: (nq,) where everything starts, at rest; by default the keyframe "drive".
        steps: of the physics in a tick.
        channels: by name, as `WholeBodyController` takes them.
        support: the body whose tilt `fall` watches; by default the root.
        fall: when the robot counts as fallen; None: never.

    Raises:
        Error: a motor for which the model has no servo, a channel of an unknown
            joint, or a model without the robot's tracks.
    """
    controller = joint_controller(
        model,
        model.key("drive").qpos if qpos is None else qpos,
        channels=dict(channels or {}),
        dt=steps * float(model.opt.timestep),
        support=support,
        drive=drive_options(model),
        velocity=VelocityControllerOptions(max_acceleration=math.inf),
    )
    made = Simulation(
        model=model,
        controller=controller,
        record=False,
        monitors=MonitorOptions(on=False),
        fall=fall,
    )
    controller.move_joints()
    made.brakes.reset(True)
    return made
