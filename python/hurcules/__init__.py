"""Hierarchical optimal control of the rescue robot Hurcules, simulated in MuJoCo."""

from types import ModuleType

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
    ContactOptions,
    ContactState,
    ControlSolution,
    Coordinate,
    DistanceTask,
    DriveController,
    DrivenJoint,
    DriveOptions,
    Error,
    FaultKind,
    ForceGains,
    ForceLoop,
    ForceTask,
    GazeTask,
    JointLimits,
    JointPid,
    JointPidOptions,
    LevelNote,
    MonitorOptions,
    OrientationTask,
    ParkingOptions,
    ParkingPhase,
    Physics,
    PointTask,
    PositionTask,
    PostureTask,
    PowerMeter,
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
    Task,
    TorqueLimits,
    ValueTask,
    VelocityController,
    VelocityControllerOptions,
    largest_stiffness,
    missions,
    mode_ranges,
    servo_table,
    step,
)
from hurcules.simulation import Simulation  # noqa: E402

_reprs.install()

_moved.install()


def __getattr__(name: str) -> ModuleType:
    """A module of this package that has moved."""
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
    "ContactOptions",
    "ContactState",
    "ControlSolution",
    "Coordinate",
    "DistanceTask",
    "DriveController",
    "DriveOptions",
    "DrivenJoint",
    "Error",
    "FaultKind",
    "ForceGains",
    "ForceLoop",
    "ForceTask",
    "GazeTask",
    "JointLimits",
    "JointPid",
    "JointPidOptions",
    "LevelNote",
    "MonitorOptions",
    "OrientationTask",
    "ParkingOptions",
    "ParkingPhase",
    "Physics",
    "PointTask",
    "PositionTask",
    "PostureTask",
    "PowerMeter",
    "RangeFinder",
    "Robot",
    "SensorFault",
    "SensorModel",
    "SensorOptions",
    "ShortTask",
    "Simulation",
    "SimulationOptions",
    "SpeedLimits",
    "SpringForce",
    "Stack",
    "StackLevel",
    "StiffnessOptions",
    "SwivelTask",
    "Task",
    "TorqueLimits",
    "ValueTask",
    "VelocityController",
    "VelocityControllerOptions",
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
