"""The driver of the test methods: keeps to a line and to a speed, or parks, as an operator would.

All joints are on their brakes; the drive controller gets what its sensors measure.
"""

from __future__ import annotations

import math

import mujoco

from hurcules.driving import Chassis, drive_options
from hurcules_studies.field_tests.course import Path, Place, Straight

__all__ = ["LineDriver"]

CORNERING = 0.7  # of the sideways acceleration that the controller allows
TURN_BEGIN, TURN_END = 0.7, 0.05  # [rad] off the path: a turn in place begins, ends
TURN_RATE = 0.5  # [rad/s]
BRAKING = 0.4  # of its deceleration: the jerk limit and the controller's lag want room


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
