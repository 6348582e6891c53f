"""Hierarchical optimal control of the rescue robot Hurcules, simulated in MuJoCo."""

import warnings
from typing import Any

from hurcules._version import NOT_COMPILED, __version__, require_mujoco

# before anything else imports MuJoCo
require_mujoco()

try:
    import hurcules._core  # noqa: F401  tried for the error below
except ModuleNotFoundError as error:
    if error.name != "hurcules._core":
        raise
    raise ImportError(NOT_COMPILED) from None

from hurcules import (  # noqa: E402
    _moved,
    _reprs,
    cameras,
    casualties,
    driving,
    models,
    postures,
    rhqp,
    scenes,
    sensors,
    transfer_bed,
)
from hurcules._core import (  # noqa: E402
    AccelerationController,
    AccelerationControllerOptions,
    AngleKind,
    AngleTask,
    BalanceTask,
    BaseSource,
    Battery,
    Brakes,
    CenterOfMassTask,
    Channel,
    ContactOptions,
    ContactState,
    ControlSolution,
    Coordinate,
    Delta,
    DistanceTask,
    Drive,
    DriveController,
    DrivenJoint,
    DriveOptions,
    DriveState,
    Error,
    FallOptions,
    FaultKind,
    ForceGains,
    ForceLoop,
    ForceReference,
    ForceTask,
    GazeTask,
    JointLimits,
    JointPid,
    JointPidOptions,
    JointRate,
    LevelNote,
    MonitorOptions,
    OrientationTask,
    ParkingOptions,
    ParkingPhase,
    Plant,
    PointTask,
    PositionTask,
    PostureTask,
    PowerMeter,
    Quantities,
    RangeFinder,
    Robot,
    SensorFault,
    SensorModel,
    SensorOptions,
    ShortTask,
    SimulationOptions,
    SpeedLimits,
    SpringForce,
    Stack,
    StackLevel,
    StiffnessOptions,
    SwivelTask,
    Target,
    Task,
    TorqueLimits,
    TrackDrive,
    Twist,
    ValueTask,
    VelocityController,
    VelocityControllerOptions,
    WholeBodyController,
    largest_stiffness,
    missions,
    mode_ranges,
    servo_table,
    step,
)
from hurcules.simulation import Simulation, SimulationBatch  # noqa: E402

_reprs.install()

_moved.install()


def __getattr__(name: str) -> Any:
    """What has moved, or has another name now."""
    if name == "Physics":
        text = "hurcules.Physics is called hurcules.Plant; the old name goes with the next release"
        warnings.warn(text, DeprecationWarning, stacklevel=2)
        return Plant
    if _moved.new_name(f"hurcules.{name}"):
        globals()[name] = _moved.forward(f"hurcules.{name}", 3)
        return globals()[name]
    raise AttributeError(f"module 'hurcules' has no attribute {name!r}")


__all__ = [
    "AccelerationController",
    "AccelerationControllerOptions",
    "AngleKind",
    "AngleTask",
    "BalanceTask",
    "BaseSource",
    "Battery",
    "Brakes",
    "CenterOfMassTask",
    "Channel",
    "ContactOptions",
    "ContactState",
    "ControlSolution",
    "Coordinate",
    "Delta",
    "DistanceTask",
    "Drive",
    "DriveController",
    "DriveOptions",
    "DriveState",
    "DrivenJoint",
    "Error",
    "FallOptions",
    "FaultKind",
    "ForceGains",
    "ForceLoop",
    "ForceReference",
    "ForceTask",
    "GazeTask",
    "JointLimits",
    "JointPid",
    "JointPidOptions",
    "JointRate",
    "LevelNote",
    "MonitorOptions",
    "OrientationTask",
    "ParkingOptions",
    "ParkingPhase",
    "Plant",
    "PointTask",
    "PositionTask",
    "PostureTask",
    "PowerMeter",
    "Quantities",
    "RangeFinder",
    "Robot",
    "SensorFault",
    "SensorModel",
    "SensorOptions",
    "ShortTask",
    "Simulation",
    "SimulationBatch",
    "SimulationOptions",
    "SpeedLimits",
    "SpringForce",
    "Stack",
    "StackLevel",
    "StiffnessOptions",
    "SwivelTask",
    "Target",
    "Task",
    "TorqueLimits",
    "TrackDrive",
    "Twist",
    "ValueTask",
    "VelocityController",
    "VelocityControllerOptions",
    "WholeBodyController",
    "__version__",
    "cameras",
    "casualties",
    "driving",
    "largest_stiffness",
    "missions",
    "mode_ranges",
    "models",
    "postures",
    "rhqp",
    "scenes",
    "sensors",
    "servo_table",
    "step",
    "transfer_bed",
]
