"""Hierarchical optimal control of the rescue robot Hurcules, simulated in MuJoCo."""

import sys
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
    _pickles,
    _reprs,
    _subclasses,
    cameras,
    casualties,
    disposal,
    driving,
    lift,
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
    Condition,
    ContactOptions,
    ContactState,
    ContactTask,
    ControlRate,
    ControlSolution,
    Coordinate,
    CustomTask,
    DampingTask,
    Delta,
    DistanceTask,
    Drive,
    DriveController,
    DrivenJoint,
    DriveOptions,
    DriveState,
    Ending,
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
    JointRates,
    Lead,
    LevelDiagnostics,
    ManipulabilityTask,
    Measure,
    MissionSetup,
    MissionTable,
    MonitorOptions,
    OrientationTask,
    Park,
    ParkingOptions,
    ParkingPhase,
    Phase,
    Plant,
    PointTask,
    PoseTask,
    PositionTask,
    Posture,
    PostureKey,
    PostureTask,
    PowerMeter,
    Quantities,
    RangeFinder,
    Reaction,
    RelativePoseTask,
    Robot,
    SensorFault,
    SensorModel,
    SensorOptions,
    Shortfall,
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
    Trouble,
    Twist,
    ValueTask,
    VelocityController,
    VelocityControllerOptions,
    WholeBodyController,
    ZeroMomentTask,
    inverse_kinematics,
    largest_stiffness,
    mode_ranges,
    obstacles,
    self_collision,
    servo_table,
    sole_points,
    step,
)
from hurcules.detour import Detour  # noqa: E402
from hurcules.jacobian_check import check_jacobian  # noqa: E402
from hurcules.mission_table import Mission  # noqa: E402
from hurcules.motors import with_motors  # noqa: E402
from hurcules.simulation import Simulation, SimulationBatch, missions  # noqa: E402
from hurcules.support import support_polygon  # noqa: E402
from hurcules.urdf import load_urdf, on_floor, urdf_spec  # noqa: E402
from hurcules.view import film, watch  # noqa: E402

_reprs.install()

_pickles.install()

_subclasses.install()

_moved.install()


# by old names, which go with the next release
_RENAMED = {"LevelNote": "LevelDiagnostics", "Physics": "Plant", "ShortTask": "Shortfall"}


def __getattr__(name: str) -> Any:
    """What has moved, or has another name now."""
    if name in _RENAMED:
        new = _RENAMED[name]
        text = f"hurcules.{name} is called hurcules.{new}; the old name goes with the next release"
        warnings.warn(text, DeprecationWarning, stacklevel=2)
        return globals()[new]
    if _moved.new_name(f"hurcules.{name}"):
        globals()[name] = _moved.forward(f"hurcules.{name}", 3)
        return globals()[name]
    text = f"module 'hurcules' has no attribute {name!r}"
    raise AttributeError(text, name=name, obj=sys.modules[__name__])  # Python says what is near


def __dir__() -> list[str]:
    """What is meant to be used, for whoever completes names."""
    return __all__


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
    "Condition",
    "ContactOptions",
    "ContactState",
    "ContactTask",
    "ControlRate",
    "ControlSolution",
    "Coordinate",
    "CustomTask",
    "DampingTask",
    "Delta",
    "Detour",
    "DistanceTask",
    "Drive",
    "DriveController",
    "DriveOptions",
    "DriveState",
    "DrivenJoint",
    "Ending",
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
    "JointRates",
    "Lead",
    "LevelDiagnostics",
    "ManipulabilityTask",
    "Measure",
    "Mission",
    "MissionSetup",
    "MissionTable",
    "MonitorOptions",
    "OrientationTask",
    "Park",
    "ParkingOptions",
    "ParkingPhase",
    "Phase",
    "Plant",
    "PointTask",
    "PoseTask",
    "PositionTask",
    "Posture",
    "PostureKey",
    "PostureTask",
    "PowerMeter",
    "Quantities",
    "RangeFinder",
    "Reaction",
    "RelativePoseTask",
    "Robot",
    "SensorFault",
    "SensorModel",
    "SensorOptions",
    "Shortfall",
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
    "Trouble",
    "Twist",
    "ValueTask",
    "VelocityController",
    "VelocityControllerOptions",
    "WholeBodyController",
    "ZeroMomentTask",
    "__version__",
    "cameras",
    "casualties",
    "check_jacobian",
    "disposal",
    "driving",
    "film",
    "inverse_kinematics",
    "largest_stiffness",
    "lift",
    "load_urdf",
    "missions",
    "mode_ranges",
    "models",
    "obstacles",
    "on_floor",
    "postures",
    "rhqp",
    "scenes",
    "self_collision",
    "sensors",
    "servo_table",
    "sole_points",
    "step",
    "support_polygon",
    "transfer_bed",
    "urdf_spec",
    "watch",
    "with_motors",
]
