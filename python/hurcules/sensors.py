"""Typical sensors of such a robot, to be given to `hurcules.Simulation(..., sensors=...)`.

The thesis names the sensors (LIDAR, cameras, IMU, GPS, encoders) but no types and no figures. All
numbers here are assumptions after common data sheets, with the reason beside each.
"""

from __future__ import annotations

import math

from hurcules._core import RangeFinder, SensorModel, SensorOptions

__all__ = ["ENCODER_BITS", "realistic"]

ENCODER_BITS = 19  # of an absolute encoder at the joint, a turn
_STEP = 2 * math.pi / 2**ENCODER_BITS  # [rad]
_GRAVITY = 9.81  # [m/s^2]
_SAMPLES = 500  # [Hz] bandwidth of the inertial sensors, Nyquist of 1 kHz


def realistic() -> SensorOptions:
    """The sensors of a robot of this kind, with noise, bias, delay and quantisation.

    Returns:
        SensorOptions; change what you know better, e.g.
        `options.models = options.models | {"imu_rate": hurcules.SensorModel(noise=0.01)}`.
    """
    return SensorOptions(models=_models(), range=_scanner())


def _models() -> dict[str, SensorModel]:
    density = _GRAVITY * 100e-6  # [m/s^2/sqrt(Hz)] MEMS: 100 ug/sqrt(Hz)
    gyro = math.radians(0.01)  # [rad/s/sqrt(Hz)] MEMS: 0.01 deg/s/sqrt(Hz)
    return {
        # 19 bits a turn, one bit of noise; one cycle of EtherCAT until it is read
        "encoder_position": SensorModel(noise=_STEP, step=_STEP, delay=1),
        # as a drive reckons it: differences of its own faster samples, filtered to 1 mrad/s
        "encoder_speed": SensorModel(noise=1e-3, delay=1),
        "imu_acceleration": SensorModel(
            noise=density * math.sqrt(_SAMPLES), bias=0.02, drift=5e-4, delay=1
        ),
        "imu_rate": SensorModel(
            noise=gyro * math.sqrt(_SAMPLES), bias=math.radians(0.2), drift=1e-5, delay=1
        ),
        # load cells: 0.2 % of 5 kN
        "load": SensorModel(noise=10.0, bias=20.0, step=1.0, delay=1),
        # from the encoder of the sprocket
        "track_speed": SensorModel(noise=5e-3, delay=1),
        # satellite positions with carrier phase, fused with the IMU; 20 ms until they are there
        "pose_position": SensorModel(noise=2e-3, bias=0.01, drift=1e-3, delay=20),
        "pose_rotation": SensorModel(noise=5e-4, bias=1e-3, delay=5),
        "pose_velocity": SensorModel(noise=0.02, delay=20),
        "pose_rate": SensorModel(noise=gyro * math.sqrt(_SAMPLES), delay=1),
    }


def _scanner() -> RangeFinder:
    """A scanner of 270 degrees, 0.75 degrees a ray, 40 Hz, 30 m, 1 cm."""
    return RangeFinder(rays=361, period=25, model=SensorModel(noise=0.01, step=0.001))
