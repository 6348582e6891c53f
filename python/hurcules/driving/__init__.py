"""Driving a robot in the closed loop: its tracks are commanded, its joints rest behind brakes.

simulation = driving.simulation(model, channels={"drive": hurcules.Drive(1.0, 0.5)})
simulation.step(500, {"drive": [0.5, 0.2]})
"""

from hurcules.driving.loop import drive_options, simulation

__all__ = ["drive_options", "simulation"]

_GONE = ("BeltBrakes", "Chassis", "hold_joints", "release_joint", "yaw_of")


def __getattr__(name: str) -> object:
    """Says what took the place of a name that is gone."""
    if name in _GONE:
        raise ImportError(
            f"hurcules.driving.{name} is gone: hurcules.driving.simulation(model) is a closed loop "
            "with drives and brakes"
        )
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
