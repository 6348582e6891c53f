"""The driver of the test methods: the robot's drive controller, fed with what its sensors tell.

It stands in for an operator: keeps to a line and to a speed, or parks, with all joints on their
brakes. `Chassis` is what anyone needs who drives a robot in plain physics.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import mujoco
import numpy as np

from hurcules._core import DriveController, DriveOptions, ParkingOptions
from hurcules.trials.brakes import BeltBrakes
from hurcules.trials.course import Path, Place, Straight

__all__ = ["Chassis", "LineDriver", "Motion", "drive_options", "yaw_of"]

CORNERING = 0.7  # of the sideways acceleration that the controller allows
TURN_BEGIN, TURN_END = 0.7, 0.05  # [rad] off the path: a turn in place begins, ends
TURN_RATE = 0.5  # [rad/s]
BRAKING = 0.4  # of its deceleration: the jerk limit and the controller's lag want room

# [m] of the drive pose: forward of the knee axis, where turns in place were measured to be about
TURN_CENTRE = -0.42


@dataclass(frozen=True)
class Motion:
    """What the drive controller measures."""

    left: float  # [rad/s] of the driven belts
    right: float
    yaw_rate: float  # [rad/s] about the vertical
    speed: float  # [m/s] over ground along the heading
    pose: tuple[float, float, float]  # x, y [m] of the knee axis, heading [rad]


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
        self.controller = DriveController(options)
        self._brakes = BeltBrakes(model)
        self._body = model.body("upper_legs").id
        dofs = [model.jnt_dofadr[model.joint(f"{side}_lower_belt").id] for side in "LR"]
        self._left, self._right = (int(dof) for dof in dofs)
        self._motors = [model.actuator(f"{side}_drive").id for side in "LR"]

    def sense(self, data: mujoco.MjData) -> Motion:
        """What belts, gyro and localisation tell, without noise."""
        axes = data.xmat[self._body]
        # the track axle is level however the legs are folded: forward is at right angles to it
        forward = np.array([axes[4], -axes[1]]) / math.hypot(axes[1], axes[4])
        x, y, _ = data.xpos[self._body]
        # of the free joint: velocity in the world, rates in the body
        rate = float(axes[6:9] @ data.qvel[3:6])
        return Motion(
            float(data.qvel[self._left]),
            float(data.qvel[self._right]),
            rate,
            float(forward @ data.qvel[0:2]),
            (float(x), float(y), math.atan2(forward[1], forward[0])),
        )

    def act(self, data: mujoco.MjData, motion: Motion) -> None:
        """One period of the controller; writes torques and brakes."""
        torques = self.controller.compute(
            motion.left, motion.right, motion.yaw_rate, motion.speed, motion.pose
        )
        data.ctrl[self._motors] = torques
        self._brakes.set(self.controller.braked)


class LineDriver:
    """Keeps to a path, forward or backward, and stands on its brakes at speed 0.

    Attributes:
        chassis: the drives.
    """

    def __init__(
        self,
        model: mujoco.MjModel,
        steps: int,
        path: Path | None = None,
        line_gain: float = 0.5,
        yaw_gain: float = 1.5,
    ) -> None:
        """Takes over a robot.

        Args:
            model: with a robot.
            steps: of the physics between two calls.
            path: to keep to; by default the line y = 0.
            line_gain: [rad/m] heading against the offset from the path.
            yaw_gain: [1/s].
        """
        self.chassis = Chassis(model, drive_options(model, steps))
        self.path = path or Straight()
        self.line_gain, self.yaw_gain = line_gain, yaw_gain
        self._turning = False

    def __call__(self, model: mujoco.MjModel, data: mujoco.MjData, speed: float) -> None:
        """Writes torques and brakes of the drives.

        Args:
            model: with the robot.
            data: its state; `ctrl` is written.
            speed: [m/s] along the path, < 0 backward.
        """
        motion = self.chassis.sense(data)
        turn = 0.0
        if speed != 0.0:
            x, y, yaw = motion.pose
            place = self.path.at(x, y)
            speed = math.copysign(min(abs(speed), self._most(place)), speed)
            lean = -self.line_gain * place.offset * math.copysign(1.0, speed)
            error = place.heading + min(max(lean, -0.3), 0.3) - yaw
            error = math.remainder(error, 2 * math.pi)
            turn = self.yaw_gain * error + place.curvature * speed
            if self._turns(error):
                speed, turn = 0.0, math.copysign(min(abs(turn), TURN_RATE), turn)
        self.chassis.controller.drive(speed, turn)
        self.chassis.act(data, motion)

    def _turns(self, error: float) -> bool:
        """Whether the robot looks so far off that it turns in place first."""
        self._turning = abs(error) > (TURN_END if self._turning else TURN_BEGIN)
        return self._turning

    def _most(self, place: Place) -> float:
        """The speed [m/s] from which the next curve can be taken."""
        options = self.chassis.controller.options
        if place.curvature:
            return math.sqrt(CORNERING * options.max_sideways / abs(place.curvature))
        if math.isinf(place.straight):
            return math.inf
        # all curves of a path are alike: this is what they allow, and braking comes before them
        tightest = CORNERING * options.max_sideways * self.path.radius
        return math.sqrt(tightest + BRAKING * 2 * options.forward.acceleration * place.straight)


def yaw_of(data: mujoco.MjData) -> float:
    """Returns where the robot looks [rad], 0 along x."""
    axes = data.body("upper_legs").xmat
    return math.atan2(-axes[1], axes[4])
