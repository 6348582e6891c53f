"""The driver of the test methods: keeps to a line and to a speed, as an operator would."""

from __future__ import annotations

import math

import mujoco

from hurcules import DriveOptions
from hurcules_studies.field_tests.course import Path, Place, Straight

__all__ = ["LineDriver", "yaw_of"]

CORNERING = 0.7  # of the sideways acceleration that the controller allows
TURN_BEGIN, TURN_END = 0.7, 0.05  # [rad] off the path: a turn in place begins, ends
TURN_RATE = 0.5  # [rad/s]
BRAKING = 0.4  # of its deceleration: the jerk limit and the controller's lag want room


class LineDriver:
    """Keeps to a path, forward or backward."""

    def __init__(
        self,
        options: DriveOptions,
        path: Path | None = None,
        line_gain: float = 0.5,
        yaw_gain: float = 1.5,
    ) -> None:
        """Takes over a robot.

        Args:
            options: of its drive controller.
            path: to keep to; by default the line y = 0.
            line_gain: [rad/m] heading against the offset from the path.
            yaw_gain: [1/s].
        """
        self.path = path or Straight()
        self.line_gain, self.yaw_gain = line_gain, yaw_gain
        self._options = options
        self._turning = False

    def __call__(
        self, model: mujoco.MjModel, data: mujoco.MjData, speed: float
    ) -> tuple[float, float]:
        """What the drives are commanded: speed [m/s] and yaw rate [rad/s].

        Args:
            model: with the robot.
            data: its state.
            speed: [m/s] along the path, < 0 backward; 0 to stand.
        """
        turn = 0.0
        if speed != 0.0:
            x, y, yaw = float(data.qpos[0]), float(data.qpos[1]), yaw_of(data)
            place = self.path.at(x, y)
            speed = math.copysign(min(abs(speed), self._most(place)), speed)
            way = speed * self._lag(speed)
            ahead = self.path.at(x + way * math.cos(yaw), y + way * math.sin(yaw))
            lean = -self.line_gain * place.offset * math.copysign(1.0, speed)
            error = place.heading + min(max(lean, -0.3), 0.3) - yaw
            error = math.remainder(error, 2 * math.pi)
            turn = self.yaw_gain * error + ahead.curvature * speed
            if self._turns(error):
                speed, turn = 0.0, math.copysign(min(abs(turn), TURN_RATE), turn)
        return speed, turn

    def _lag(self, speed: float) -> float:
        """Half the time [s] that the profile takes to the yaw rate of a curve at this speed."""
        turning = self._options.turning
        rate = abs(speed) / self.path.radius
        return 0.5 * (rate / turning.acceleration + turning.acceleration / turning.jerk)

    def _turns(self, error: float) -> bool:
        """Whether the robot looks so far off that it turns in place first."""
        self._turning = abs(error) > (TURN_END if self._turning else TURN_BEGIN)
        return self._turning

    def _most(self, place: Place) -> float:
        """The speed [m/s] from which the next curve can be taken."""
        options = self._options
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
