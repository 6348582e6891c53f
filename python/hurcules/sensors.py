"""Typical sensors of such a robot, to be given to `hurcules.Simulation(..., sensors=...)`.

The thesis names the sensors (LIDAR, cameras, IMU, GPS, encoders) but no types and no figures. All
numbers are assumptions after common data sheets, with the reason beside each in
cpp/hurcules/sim/realistic_sensors.cpp.
"""

from __future__ import annotations

from hurcules import _core
from hurcules._core import Error, Robot, SensorOptions

__all__ = ["realistic"]


def realistic(robot: Robot | None = None) -> SensorOptions:
    """The sensors of a robot of this kind, with noise, bias, delay and quantisation.

    Args:
        robot: that has them, an inertial unit and a scanner only where its model names them;
            None: all that Hurcules has.

    Returns:
        SensorOptions; change what you know better, e.g.
        `options.models = options.models | {"imu_rate": hurcules.SensorModel(noise=0.01)}`.

    Raises:
        Error: it is no robot.
    """
    if not isinstance(robot, Robot | None):
        raise Error(f"sensors.realistic wants a Robot, or nothing; got {robot!r}")
    return _core.realistic_sensors() if robot is None else _core.realistic_sensors(robot)
